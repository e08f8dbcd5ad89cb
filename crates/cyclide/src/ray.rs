//! Intersections with lines: every real one, with an enclosure.

use crate::frame::{finite_vector, place};
use crate::{Dupin, Error, Parabolic, Quartic};
use glam::DVec3;
use std::ops::Deref;
use variation::{Interval, Root, Solver};

/// A point of a surface on a line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RayHit {
    /// The parameter: the point is `origin + s * direction`.
    pub s: f64,
    /// The root of the polynomial along the line is within this of `s`.
    pub error: f64,
    /// How often the line meets the surface here: 2 where it is tangent or passes through a singular point. 0 where doubles cannot decide
    /// and the crate `variation` was built without its exact path.
    pub multiplicity: u32,
}

/// The intersections with one line, ascending: at most four, stored in place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "HitsData")
)]
pub struct RayHits {
    hits: [RayHit; 4],
    len: usize,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct HitsData {
    hits: [RayHit; 4],
    len: usize,
}

#[cfg(feature = "serde")]
impl TryFrom<HitsData> for RayHits {
    type Error = &'static str;

    fn try_from(HitsData { hits, len }: HitsData) -> Result<Self, Self::Error> {
        let found = Self { hits, len };
        if len > found.hits.len() {
            return Err("a line meets a cyclide at most four times");
        }
        if found.windows(2).any(|pair| pair[0].s > pair[1].s) {
            return Err("the hits of a line are in ascending order");
        }
        Ok(found)
    }
}

impl Deref for RayHits {
    type Target = [RayHit];

    fn deref(&self) -> &[RayHit] {
        self.hits.get(..self.len).unwrap_or_default()
    }
}

impl RayHits {
    fn push(&mut self, hit: RayHit) {
        if let Some(slot) = self.hits.get_mut(self.len) {
            *slot = hit;
            self.len += 1;
        }
    }

    /// The first hit at a parameter above `from`.
    #[must_use]
    pub fn first_after(&self, from: f64) -> Option<RayHit> {
        self.iter().copied().find(|hit| hit.s > from)
    }
}

/// Intersects one surface with many lines, keeping the root finder's storage.
///
/// ```
/// use cyclide::{Dupin, Frame, RayCaster, glam::DVec3};
/// let mut caster = RayCaster::new(Dupin::torus(3.0, 1.0, Frame::WORLD)?);
/// let hits: usize = (0..100)
///     .map(|i| caster.intersect(DVec3::new(-9.0, 0.08 * f64::from(i) - 4.0, 0.1), DVec3::X).map_or(0, |hits| hits.len()))
///     .sum();
/// assert_eq!(hits, 300); // 51 lines meet the torus four times, 48 twice, one passes by
/// # Ok::<(), cyclide::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct RayCaster {
    surface: Dupin,
    solver: Solver,
}

impl RayCaster {
    /// A caster for one surface.
    #[must_use]
    pub const fn new(surface: Dupin) -> Self {
        Self {
            surface,
            solver: Solver::new(),
        }
    }

    /// The surface.
    #[must_use]
    pub const fn surface(&self) -> &Dupin {
        &self.surface
    }

    /// As [`Dupin::intersect`].
    ///
    /// # Errors
    ///
    /// As [`Dupin::intersect`].
    pub fn intersect(&mut self, origin: DVec3, direction: DVec3) -> Result<RayHits, Error> {
        place("ray origin", origin)?;
        finite_vector("ray direction", direction)?;
        let (unit, lengths) = crate::frame::direction(direction).ok_or(Error::Direction)?;
        let frame = self.surface.frame();
        let (origin, direction) = (frame.point_to_local(origin), frame.vector_to_local(unit));
        let mut hits = match &self.surface {
            Dupin::Quartic(surface) => {
                surface.intersect_local(&mut self.solver, origin, direction)?
            }
            Dupin::Parabolic(surface) => {
                surface.intersect_local(&mut self.solver, origin, direction)?
            }
        };
        for hit in &mut hits.hits {
            for length in lengths {
                hit.s /= length;
                hit.error /= length;
            }
            if !hit.s.is_finite() {
                return Err(Error::Direction);
            }
        }
        Ok(hits)
    }
}

impl Dupin {
    /// All intersections with the line `origin + s * direction`, for `s` of either sign, ascending. The direction need not be a unit vector.
    ///
    /// The polynomial of degree 4 (3 on a parabolic cyclide) along the line is formed about the point of the line nearest to the surface's
    /// centre and handed to the certified root finder of the crate `variation`: no real root of it is missed, tangency included. For many
    /// lines keep a [`RayCaster`].
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::LengthOutOfRange`] for the origin; [`Error::Direction`] for a zero direction, or one so short that the
    /// parameters overflow; [`Error::Root`] if the line lies on the surface.
    ///
    /// # Examples
    ///
    /// ```
    /// use cyclide::{Dupin, Frame, glam::DVec3};
    /// let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
    /// let hits = ring.intersect(DVec3::new(-10.0, 0.0, 0.0), DVec3::X)?;
    /// let x: Vec<f64> = hits.iter().map(|hit| (hit.s - 10.0).round()).collect();
    /// assert_eq!(x, [-6.0, 0.0, 2.0, 4.0]);
    /// # Ok::<(), cyclide::Error>(())
    /// ```
    pub fn intersect(&self, origin: DVec3, direction: DVec3) -> Result<RayHits, Error> {
        RayCaster::new(*self).intersect(origin, direction)
    }
}

impl Dupin {
    /// The intersections with many lines, given as origin and direction; on all cores with the feature `rayon`. Each line has its own result.
    #[must_use]
    pub fn intersect_all(&self, lines: &[(DVec3, DVec3)]) -> Vec<Result<RayHits, Error>> {
        #[cfg(feature = "rayon")]
        {
            use rayon::prelude::*;
            lines
                .par_iter()
                .map_init(
                    || RayCaster::new(*self),
                    |caster, &(origin, direction)| caster.intersect(origin, direction),
                )
                .collect()
        }
        #[cfg(not(feature = "rayon"))]
        {
            let mut caster = RayCaster::new(*self);
            lines
                .iter()
                .map(|&(origin, direction)| caster.intersect(origin, direction))
                .collect()
        }
    }
}

impl Quartic {
    /// The surface lies in the sphere about `(-c, 0, 0)` that touches it along `psi = pi`, or a concentric one around the larger horn.
    pub(crate) fn enclosing_radius(&self) -> f64 {
        (self.a() + self.mu()).max(self.a() + 2.0 * self.c() - self.mu())
    }

    fn intersect_local(
        &self,
        solver: &mut Solver,
        origin: DVec3,
        direction: DVec3,
    ) -> Result<RayHits, Error> {
        let centre = DVec3::new(-self.c(), 0.0, 0.0);
        let far_start = (centre - origin).dot(direction);
        let near = origin + far_start * direction;
        // From a distant origin the first step is rounded by more than the surface's size; the second is exact enough.
        let rest = (centre - near).dot(direction);
        let (start, nearest) = (far_start + rest, near + rest * direction);
        let distance = nearest - centre;
        let radius = self.enclosing_radius();
        let reach = (radius - distance.length()) * (radius + distance.length());
        if reach < 0.0 {
            return Ok(RayHits::default());
        }
        let half = rounded_up(reach.sqrt() + 1e-9 * radius);
        let mut hits = RayHits::default();
        if self.a() == 0.0 {
            // The sphere counted twice: every intersection is double.
            let multiplicity = if reach == 0.0 { 4 } else { 2 };
            let error = f64::EPSILON * (start.abs() + radius);
            for s in if reach == 0.0 {
                vec![start]
            } else {
                vec![start - reach.sqrt(), start + reach.sqrt()]
            } {
                hits.push(RayHit {
                    s,
                    error,
                    multiplicity,
                });
            }
            return Ok(hits);
        }
        let coefficients = bernstein_from_monomial_quartic(self.along(nearest, direction), half);
        // About the nearest point: from a distant origin the surface may lie between two neighbouring numbers.
        let interval = Interval::try_new(-half, half)?;
        for root in solver.roots_on(&coefficients, interval)? {
            let local = hit(root);
            let s = start + local.s;
            hits.push(RayHit {
                s,
                error: local.error + f64::EPSILON * s.abs(),
                ..local
            });
        }
        Ok(hits)
    }

    /// Coefficients of the implicit polynomial along a line with unit direction, in ascending powers.
    fn along(&self, p: DVec3, d: DVec3) -> [f64; 5] {
        let (a, b, c, mu) = (self.a(), self.b(), self.c(), self.mu());
        let linear = 2.0 * p.dot(d);
        let constant = p.length_squared() - (mu - b) * (mu + b);
        let (lever, lever_rate) = (2.0 * (a * p.x - c * mu), 2.0 * a * d.x);
        let (side, side_rate) = (2.0 * b * p.y, 2.0 * b * d.y);
        [
            constant * constant - lever * lever - side * side,
            2.0 * (linear * constant - lever * lever_rate - side * side_rate),
            linear * linear + 2.0 * constant - lever_rate * lever_rate - side_rate * side_rate,
            2.0 * linear,
            1.0,
        ]
    }
}

impl Parabolic {
    fn intersect_local(
        &self,
        solver: &mut Solver,
        origin: DVec3,
        direction: DVec3,
    ) -> Result<RayHits, Error> {
        let start = -origin.dot(direction);
        let p = origin + start * direction;
        let size = self.f() + self.k().abs() + p.length();
        let power = self.along(p / size, direction, size);
        let mut hits = RayHits::default();
        let hit_at = |root: &Root, s: f64, stretch: f64| RayHit {
            s: start + s * size,
            error: root.width() * stretch * size,
            ..hit(root)
        };
        // The line in three parts: beyond -1, between, beyond 1, the outer two by the reversed polynomial in 1/s.
        let reversed = [power[3], power[2], power[1], power[0]];
        let inside = bernstein_from_monomial_cubic(power);
        let outside = bernstein_from_monomial_cubic(reversed);
        let whole = Interval::try_new(-1.0, 1.0)?;
        let mut far = [RayHit::default(); 3];
        let mut far_len = 0;
        for (slot, root) in far.iter_mut().zip(
            solver
                .roots_on(&outside, whole)?
                .iter()
                .filter(|root| root.value().abs() < 1.0 && root.value() != 0.0),
        ) {
            let s = 1.0 / root.value();
            *slot = hit_at(root, s, s * s);
            far_len += 1;
        }
        // As the reciprocal grows from -1 to 1 the parameter falls from -1 and, beyond infinity, to 1.
        let far = far.get(..far_len).unwrap_or_default();
        for hit in far.iter().rev().filter(|hit| hit.s < start) {
            hits.push(*hit);
        }
        for root in solver.roots_on(&inside, whole)? {
            hits.push(hit_at(root, root.value(), 1.0));
        }
        for hit in far.iter().rev().filter(|hit| hit.s > start) {
            hits.push(*hit);
        }
        Ok(hits)
    }

    /// Coefficients of the cubic along a line, in ascending powers, all lengths divided by `size`.
    fn along(&self, p: DVec3, d: DVec3, size: f64) -> [f64; 4] {
        let (f, k) = (self.f() / size, self.k() / size);
        let product = |[a0, a1, a2]: [f64; 3], [b0, b1]: [f64; 2]| {
            [a0 * b0, a0 * b1 + a1 * b0, a1 * b1 + a2 * b0, a2 * b1]
        };
        let square = |q: f64, rate: f64| [q * q, 2.0 * q * rate, rate * rate];
        let (near, far) = ([p.x + k - f, d.x], [p.x + k + f, d.x]);
        let [y, z] = [square(p.y, d.y), square(p.z, d.z)];
        let both = product([near[0], near[1], 0.0], far);
        let terms = [
            product([both[0], both[1], both[2]], [p.x - k, d.x]),
            product(y, far),
            product(z, near),
        ];
        [0, 1, 2, 3].map(|power| terms[0][power] + terms[1][power] + terms[2][power])
    }
}

fn hit(root: &Root) -> RayHit {
    RayHit {
        s: root.value(),
        error: 0.5 * root.width(),
        multiplicity: root.multiplicity().unwrap_or(0),
    }
}

/// The next number with eight bits, so that data with few digits keep exact coefficients and a tangent line its double root. It is a little
/// beyond, and no root sits at the end of the interval by rounding.
fn rounded_up(half: f64) -> f64 {
    let unit = 2_f64.powi(half.log2().floor() as i32 - 7);
    if unit > 0.0 {
        (half / unit).ceil() * unit
    } else {
        half
    }
}

/// Three times the Bernstein coefficients on `[-half, half]` of a polynomial in ascending powers: the blossom at the ends, and nothing is
/// divided by three.
fn bernstein_from_monomial_quartic([c0, c1, c2, c3, c4]: [f64; 5], half: f64) -> [f64; 5] {
    let square = half * half;
    let (c1, c2, c3, c4) = (
        c1 * half,
        c2 * square,
        c3 * square * half,
        c4 * square * square,
    );
    let (even, odd) = (c0 + c2 + c4, c1 + c3);
    let (inner_even, inner_odd) = (c0 - c4, 0.5 * (c1 - c3));
    let middle = 3.0 * (c0 + c4) - c2;
    [
        3.0 * (even - odd),
        3.0 * (inner_even - inner_odd),
        middle,
        3.0 * (inner_even + inner_odd),
        3.0 * (even + odd),
    ]
}

/// The same for a cubic on `[-1, 1]`.
fn bernstein_from_monomial_cubic([c0, c1, c2, c3]: [f64; 4]) -> [f64; 4] {
    let (even, odd) = (3.0 * (c0 + c2), 3.0 * (c1 + c3));
    let (inner_even, inner_odd) = (3.0 * c0 - c2, c1 - 3.0 * c3);
    [
        even - odd,
        inner_even - inner_odd,
        inner_even + inner_odd,
        even + odd,
    ]
}
