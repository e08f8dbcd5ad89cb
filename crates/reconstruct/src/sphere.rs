//! Cubic splines on the unit sphere.
//!
//! G. M. Nielson's scheme as the thesis uses it (Section 3.2, "Spatial curves"): de Boor's algorithm for the
//! uniform cubic B-spline with straight segments replaced by great-circle arcs.

use crate::Error;
use glam::DVec3;

/// The point at `t` of the great circle arc from `a` to `b`, both unit, beyond the ends too.
pub(crate) fn slerp(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    exponential(a, logarithm(a, b) * t)
}

/// The tangent vector at `a` that leads along the shorter great circle to `b`.
pub(crate) fn logarithm(a: DVec3, b: DVec3) -> DVec3 {
    let across = b - a * a.dot(b);
    let sine = across.length();
    if sine == 0.0 {
        DVec3::ZERO
    } else {
        across * (sine.atan2(a.dot(b)) / sine)
    }
}

/// The end of the great circle that leaves `a` with velocity `v`, after unit time.
pub(crate) fn exponential(a: DVec3, v: DVec3) -> DVec3 {
    let angle = v.length();
    if angle == 0.0 {
        return a;
    }
    (a * angle.cos() + v * (angle.sin() / angle)).normalize()
}

/// A spline of unit vectors at equally spaced parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SphereSpline {
    start: f64,
    spacing: f64,
    /// Control points with a ghost at either end, reflected on the sphere: natural-like ends.
    controls: Vec<DVec3>,
}

/// Largest deviation of the spacing, relative to it: data written with six digits still count as uniform.
const UNIFORM: f64 = 1e-6;
/// Angle between the spline and a datum accepted, radians: rounding of a chain of ten arcs.
const INTERPOLATED: f64 = 1e-14;
/// Sweeps allowed; the corrected iteration takes about ten on smooth data.
const SWEEPS: usize = 200;

impl SphereSpline {
    /// The spline through unit `data` at `knots`, which must be equally spaced.
    pub(crate) fn new(knots: &[f64], data: &[DVec3]) -> Result<Self, Error> {
        let n = data.len() - 1;
        let spacing = (knots[n] - knots[0]) / n as f64;
        for (index, pair) in knots.windows(2).enumerate() {
            if ((pair[1] - pair[0]) / spacing - 1.0).abs() > UNIFORM {
                return Err(Error::NotUniform {
                    index,
                    spacing: pair[1] - pair[0],
                    expected: spacing,
                });
            }
        }
        let mut spline = Self {
            start: knots[0],
            spacing,
            controls: vec![DVec3::ZERO; n + 3],
        };
        spline.controls[1..=n + 1].copy_from_slice(data);
        let mut corrections = vec![DVec3::ZERO; n + 1];
        for _ in 0..SWEEPS {
            spline.reflect_ghosts();
            let mut worst: f64 = 0.0;
            for i in 0..=n {
                let value = spline.at(i.min(n - 1), if i == n { 1.0 } else { 0.0 });
                corrections[i] = logarithm(value, data[i]);
                worst = worst.max(corrections[i].length());
            }
            if worst <= INTERPOLATED {
                return Ok(spline);
            }
            solve_flat_spline(&mut corrections);
            for (control, correction) in spline.controls[1..=n + 1].iter_mut().zip(&corrections) {
                *control = exponential(*control, *correction - *control * control.dot(*correction));
            }
        }
        Err(Error::NoConvergence {
            what: "the spline on the sphere",
            steps: SWEEPS,
        })
    }

    fn reflect_ghosts(&mut self) {
        let last = self.controls.len() - 1;
        self.controls[0] = slerp(self.controls[1], self.controls[2], -1.0);
        self.controls[last] = slerp(self.controls[last - 1], self.controls[last - 2], -1.0);
    }

    pub(crate) fn value(&self, s: f64) -> DVec3 {
        let x = (s - self.start) / self.spacing;
        // A saturating conversion: what lies before the start belongs to the first segment.
        let i = (x as usize).min(self.controls.len() - 4);
        self.at(i, x - i as f64)
    }

    /// De Boor's algorithm on segment `i` at the local parameter `t`.
    fn at(&self, i: usize, t: f64) -> DVec3 {
        let d = &self.controls[i..i + 4];
        let a = [0, 1, 2].map(|k| slerp(d[k], d[k + 1], (t + (2 - k) as f64) / 3.0));
        let b = [0, 1].map(|k| slerp(a[k], a[k + 1], (t + (1 - k) as f64) / 2.0));
        slerp(b[0], b[1], t)
    }
}

/// Solves `(c[i-1] + 4 c[i] + c[i+1]) / 6 = right[i]` with reflected ends (`c[0] = right[0]`) in place: the
/// system of the same spline in flat space, which is nearly the right correction on the sphere.
fn solve_flat_spline(right: &mut [DVec3]) {
    let n = right.len() - 1;
    if n < 2 {
        return;
    }
    right[1] = right[1] * 6.0 - right[0];
    for value in &mut right[2..n] {
        *value *= 6.0;
    }
    right[n - 1] -= right[n];
    let mut upper = vec![0.0; n];
    for i in 1..n {
        let pivot = 1.0 / (4.0 - upper[i - 1]);
        upper[i] = pivot;
        let before = if i == 1 { DVec3::ZERO } else { right[i - 1] };
        right[i] = (right[i] - before) * pivot;
    }
    for i in (1..n - 1).rev() {
        let after = right[i + 1];
        right[i] -= after * upper[i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_and_logarithms() {
        let (a, b) = (DVec3::X, DVec3::new(0.6, 0.8, 0.0));
        assert!((slerp(a, b, 1.0) - b).length() < 1e-15);
        assert!((slerp(a, b, -1.0) - DVec3::new(0.6, -0.8, 0.0)).length() < 1e-15);
        assert_eq!(slerp(a, a, 0.3), a);
    }

    #[test]
    fn the_spline_interpolates() {
        let knots: Vec<f64> = (0..9).map(|i| 0.5 * f64::from(i)).collect();
        let data: Vec<DVec3> = knots
            .iter()
            .map(|s| DVec3::new(s.cos(), (1.3 * s).sin(), 0.4 + 0.2 * s).normalize())
            .collect();
        let spline = SphereSpline::new(&knots, &data).unwrap();
        for (s, d) in knots.iter().zip(&data) {
            assert!((spline.value(*s) - *d).length() < 3e-14);
        }
        let two = SphereSpline::new(&knots[..2], &data[..2]).unwrap();
        assert!((two.value(0.25) - slerp(data[0], data[1], 0.5)).length() < 1e-14);
    }
}
