//! What a root solver answers: enclosing intervals with what is known about each.

use std::fmt;
use std::ops::Deref;

use crate::Error;

/// A closed interval `[a, b]` with `a < b`, both finite.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "(f64, f64)", into = "(f64, f64)"))]
pub struct Interval {
    a: f64,
    b: f64,
}

impl Interval {
    /// `[0, 1]`.
    pub const UNIT: Self = Self { a: 0.0, b: 1.0 };

    /// The interval `[a, b]`.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for NaN and infinite ends, [`Error::EmptyInterval`] unless `a < b` with a finite `b - a`.
    pub fn try_new(a: f64, b: f64) -> Result<Self, Error> {
        for (index, value) in [a, b].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(Error::NotFinite { index, value });
            }
        }
        if a < b && (b - a).is_finite() {
            Ok(Self { a, b })
        } else {
            Err(Error::EmptyInterval { a, b })
        }
    }

    /// Left end.
    #[must_use]
    pub fn a(self) -> f64 {
        self.a
    }

    /// Right end.
    #[must_use]
    pub fn b(self) -> f64 {
        self.b
    }

    /// `b - a`.
    #[must_use]
    pub fn width(self) -> f64 {
        self.b - self.a
    }

    /// The parameter of `[0, 1]` that corresponds to `t`, outside `[0, 1]` if `t` lies outside.
    #[must_use]
    pub fn to_unit(self, t: f64) -> f64 {
        (t - self.a) / self.width()
    }

    /// Encloses the image of `[lo, hi]` in `[0, 1]` under `u -> a + (b - a) u`, rounded outward and kept within the ends.
    #[inline]
    pub(crate) fn image(self, lo: f64, hi: f64) -> (f64, f64) {
        if self == Self::UNIT {
            return (lo, hi);
        }
        // Three roundings, each at most half an ulp of `|a| + width`.
        let slack = 2.0 * f64::EPSILON * (self.a.abs() + self.width());
        let at = |u: f64, slack: f64| match u {
            0.0 => self.a,
            1.0 => self.b,
            _ => (self.a + self.width() * u + slack).clamp(self.a, self.b),
        };
        (at(lo, -slack), at(hi, slack))
    }
}

impl TryFrom<(f64, f64)> for Interval {
    type Error = Error;

    fn try_from((a, b): (f64, f64)) -> Result<Self, Error> {
        Self::try_new(a, b)
    }
}

impl From<Interval> for (f64, f64) {
    fn from(interval: Interval) -> Self {
        (interval.a, interval.b)
    }
}

/// How many roots an enclosure holds, counted with multiplicity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Count {
    /// One distinct root of exactly this multiplicity.
    Exactly(u32),
    /// Undecided in `f64`, and the exact path was not allowed: at most this many roots, perhaps none.
    AtMost(u32),
}

/// One distinct real root, enclosed: it lies in `[lo, hi]`, ends included.
///
/// Two distinct roots closer together than the spacing of `f64` are two entries with the same enclosure.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Root {
    /// Lower end of the enclosure.
    pub lo: f64,
    /// Upper end of the enclosure; equal to `lo` where the root is known exactly.
    pub hi: f64,
    /// What the enclosure holds.
    pub count: Count,
}

impl Root {
    pub(crate) const NONE: Self = Self {
        lo: 0.0,
        hi: 0.0,
        count: Count::AtMost(0),
    };

    #[inline]
    pub(crate) fn exactly(lo: f64, hi: f64, multiplicity: u32) -> Self {
        Self {
            lo,
            hi,
            count: Count::Exactly(multiplicity),
        }
    }

    /// The middle of the enclosure, the best single number for the root.
    #[must_use]
    pub fn value(&self) -> f64 {
        0.5 * self.lo + 0.5 * self.hi
    }

    /// Width of the enclosure: the certified error bound of [`Root::value`] is half of it.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.hi - self.lo
    }

    /// The multiplicity, or `None` for an undecided cluster.
    #[must_use]
    pub fn multiplicity(&self) -> Option<u32> {
        match self.count {
            Count::Exactly(multiplicity) => Some(multiplicity),
            Count::AtMost(_) => None,
        }
    }
}

/// Roots in the order of their discovery, mapped to the interval, in storage that the caller provides.
#[derive(Debug)]
pub(crate) struct List<'a> {
    slots: &'a mut [Root],
    len: usize,
    interval: Interval,
}

impl<'a> List<'a> {
    #[inline]
    pub(crate) fn new(slots: &'a mut [Root], interval: Interval) -> Self {
        Self {
            slots,
            len: 0,
            interval,
        }
    }

    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    #[inline]
    pub(crate) fn push(&mut self, root: Root) {
        if let Some(slot) = self.slots.get_mut(self.len) {
            let (lo, hi) = self.interval.image(root.lo, root.hi);
            *slot = Root {
                lo,
                hi,
                count: root.count,
            };
            self.len += 1;
        }
    }

    /// A simple root between two numbers.
    #[inline]
    pub(crate) fn push_simple(&mut self, (lo, hi): (f64, f64)) {
        self.push(Root::exactly(lo, hi, 1));
    }

    pub(crate) fn push_end(&mut self, at: f64, multiplicity: usize) {
        if multiplicity > 0 {
            self.push(Root::exactly(at, at, multiplicity as u32));
        }
    }
}

/// Roots up to this number are kept without allocation.
pub(crate) const INLINE: usize = 16;

/// The roots of one polynomial in ascending order; a slice of [`Root`] that is stored in place up to degree 16.
#[derive(Clone)]
pub struct Roots {
    inline: [Root; INLINE],
    len: usize,
    spill: Vec<Root>,
}

impl Roots {
    /// Up to [`INLINE`] roots that `write` puts in place, and counts.
    #[inline]
    pub(crate) fn written<E>(
        write: impl FnOnce(&mut [Root]) -> Result<usize, E>,
    ) -> Result<Self, E> {
        let mut inline = [Root::NONE; INLINE];
        let len = write(&mut inline)?;
        Ok(Self {
            inline,
            len,
            spill: Vec::new(),
        })
    }

    pub(crate) fn from_slice(roots: &[Root]) -> Self {
        let mut out = Self {
            inline: [Root::NONE; INLINE],
            len: roots.len(),
            spill: Vec::new(),
        };
        match out.inline.get_mut(..roots.len()) {
            Some(inline) => inline.copy_from_slice(roots),
            None => out.spill = roots.to_vec(),
        }
        out
    }
}

impl Deref for Roots {
    type Target = [Root];

    fn deref(&self) -> &[Root] {
        self.inline.get(..self.len).unwrap_or(&self.spill)
    }
}

impl fmt::Debug for Roots {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl PartialEq for Roots {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<'a> IntoIterator for &'a Roots {
    type Item = &'a Root;
    type IntoIter = std::slice::Iter<'a, Root>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
