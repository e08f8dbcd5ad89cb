//! The vectors that control points are made of.

use core::fmt::Debug;
use glam::{DVec2, DVec3, DVec4};

/// A finite-dimensional real vector space, as far as a Bézier curve needs to know it.
///
/// Implemented for `f64`, glam's `DVec2`, `DVec3`, `DVec4`, every array `[f64; N]`, and for
/// [`MassPoint`](crate::MassPoint) itself: mass points form a vector space, which is why every
/// algorithm of this crate is plain Bernstein arithmetic with no case for weights. A type of your own
/// (complex numbers, line coordinates, the 5-vectors of spheres) takes part by five short items.
pub trait VectorSpace: Copy + PartialEq + Debug {
    /// The zero vector.
    const ZERO: Self;

    /// `self + other`.
    #[must_use]
    fn plus(self, other: Self) -> Self;

    /// `factor * self`.
    #[must_use]
    fn times(self, factor: f64) -> Self;

    /// The largest absolute value of a coordinate: the scale that relative tolerances refer to.
    #[must_use]
    fn magnitude(self) -> f64;

    /// Whether every coordinate is finite.
    #[must_use]
    fn is_finite(self) -> bool;

    /// `self - other`.
    #[inline]
    #[must_use]
    fn minus(self, other: Self) -> Self {
        self.plus(other.times(-1.0))
    }

    /// `(1 - t) self + t other`.
    #[inline]
    #[must_use]
    fn lerp(self, other: Self, t: f64) -> Self {
        self.times(1.0 - t).plus(other.times(t))
    }
}

impl VectorSpace for f64 {
    const ZERO: Self = 0.0;

    #[inline]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    #[inline]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline]
    fn magnitude(self) -> f64 {
        self.abs()
    }

    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

macro_rules! impl_for_glam {
    ($($vector:ty),*) => {$(
        impl VectorSpace for $vector {
            const ZERO: Self = <$vector>::ZERO;

            #[inline]
            fn plus(self, other: Self) -> Self {
                self + other
            }

            #[inline]
            fn times(self, factor: f64) -> Self {
                self * factor
            }

            #[inline]
            fn minus(self, other: Self) -> Self {
                self - other
            }

            #[inline]
            fn magnitude(self) -> f64 {
                self.abs().max_element()
            }

            #[inline]
            fn is_finite(self) -> bool {
                <$vector>::is_finite(self)
            }
        }
    )*};
}
impl_for_glam!(DVec2, DVec3, DVec4);

impl<const N: usize> VectorSpace for [f64; N] {
    const ZERO: Self = [0.0; N];

    #[inline]
    fn plus(mut self, other: Self) -> Self {
        for (x, y) in self.iter_mut().zip(other) {
            *x += y;
        }
        self
    }

    #[inline]
    fn times(mut self, factor: f64) -> Self {
        for x in &mut self {
            *x *= factor;
        }
        self
    }

    #[inline]
    fn minus(mut self, other: Self) -> Self {
        for (x, y) in self.iter_mut().zip(other) {
            *x -= y;
        }
        self
    }

    #[inline]
    fn magnitude(self) -> f64 {
        self.iter().fold(0.0, |largest, x| x.abs().max(largest))
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.iter().all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec2, dvec3};

    /// The vector-space laws that the algorithms rely on, on one exact example per type.
    fn laws<V: VectorSpace>(x: V, y: V) {
        assert_eq!(x.plus(V::ZERO), x);
        assert_eq!(x.plus(y), y.plus(x));
        assert_eq!(x.plus(y).minus(y), x);
        assert_eq!(x.plus(y).times(2.0), x.times(2.0).plus(y.times(2.0)));
        assert_eq!(x.lerp(y, 0.0), x);
        assert_eq!(x.lerp(y, 1.0), y);
        assert_eq!(x.times(-4.0).magnitude(), 4.0 * x.magnitude());
        assert!(x.is_finite());
        assert!(!x.times(f64::NAN).is_finite());
    }

    #[test]
    fn every_space_obeys_the_laws() {
        laws(3.0, -5.0);
        laws(dvec2(1.0, -2.0), dvec2(0.5, 8.0));
        laws(dvec3(1.0, -2.0, 4.0), dvec3(0.5, 8.0, 1.0));
        laws(DVec4::new(1.0, -2.0, 4.0, 3.0), DVec4::ONE);
        laws([1.0, 2.0, -3.0, 4.0, 5.0], [5.0, 4.0, 3.0, 2.0, 1.0]);
    }
}
