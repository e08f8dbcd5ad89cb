//! Plane vectors read as complex numbers.
//!
//! glam already multiplies (`a.rotate(b)`), turns by a quarter (`perp`) and takes determinants
//! (`a.perp_dot(b)` is `Im(conj(a) b)`); these are the operations that it lacks.

use glam::DVec2;

use crate::Error;

/// Complex conjugate.
#[inline]
pub(crate) fn conj(z: DVec2) -> DVec2 {
    DVec2::new(z.x, -z.y)
}

/// Complex square.
#[inline]
pub(crate) fn square(z: DVec2) -> DVec2 {
    DVec2::new((z.x - z.y) * (z.x + z.y), 2.0 * z.x * z.y)
}

/// Complex quotient.
pub(crate) fn divide(a: DVec2, b: DVec2) -> DVec2 {
    conj(b).rotate(a) / b.length_squared()
}

/// The complex number of length 1 with the argument of `turn`, whatever its size.
pub(crate) fn unit(turn: DVec2) -> Result<DVec2, Error> {
    if !turn.is_finite() {
        return Err(Error::NonFinite { what: "a turn" });
    }
    let size = turn.abs().max_element();
    if size == 0.0 {
        return Err(Error::ZeroDirection { what: "a turn" });
    }
    Ok((turn / size).normalize())
}

/// Whether a vector has length 1 to rounding.
#[cfg(feature = "serde")]
pub(crate) fn is_unit(vector: DVec2) -> bool {
    (vector.length_squared() - 1.0).abs() <= 8.0 * f64::EPSILON
}

/// Principal square root (non-negative real part), without overflow or cancellation.
#[inline]
pub(crate) fn sqrt(z: DVec2) -> DVec2 {
    let length = z.length();
    if length == 0.0 {
        return DVec2::ZERO;
    }
    let larger = (0.5 * (length + z.x.abs())).sqrt();
    let smaller = 0.5 * z.y.abs() / larger;
    if z.x >= 0.0 {
        DVec2::new(larger, smaller.copysign(z.y))
    } else {
        DVec2::new(smaller, larger.copysign(z.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_principal_root_squares_back() {
        for z in [
            (3.0, 4.0),
            (-3.0, 4.0),
            (-3.0, -4.0),
            (0.0, -2.0),
            (-1.0, 0.0),
            (1e-200, 1e-200),
        ] {
            let z = DVec2::new(z.0, z.1);
            let root = sqrt(z);
            assert!(root.x >= 0.0);
            assert!((square(root) - z).length() <= 4.0 * f64::EPSILON * z.length());
        }
        assert_eq!(sqrt(DVec2::ZERO), DVec2::ZERO);
    }

    #[test]
    fn division_undoes_multiplication() {
        let (a, b) = (DVec2::new(1.5, -0.3), DVec2::new(-0.2, 2.0));
        assert!((divide(a.rotate(b), b) - a).length() < 1e-15);
    }
}
