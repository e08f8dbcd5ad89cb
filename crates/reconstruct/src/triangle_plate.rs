//! The triangular patch of least thin-plate energy.

use crate::Error;
use crate::quadrature;
use crate::strip::Strip;
use crate::triangle::Triangle;
use crate::triangle_patch::{BarycentricJet, TrianglePatch, TwistStep};
use core::array::from_fn;
use glam::{DVec2, DVec3};
use nalgebra::{SMatrix, SVector};

/// The triangular patch of least energy.
#[derive(Clone, Debug)]
pub struct SmoothedTriangle<S> {
    /// The patch.
    pub patch: TrianglePatch<S>,
    /// Its thin-plate energy.
    pub energy: f64,
    /// The energy with all tangential twists zero.
    pub energy_at_zero: f64,
    /// Eigenvalues of the matrix of the quadratic form, ascending.
    pub eigenvalues: [f64; 6],
}

impl<S: Strip> Triangle<S> {
    /// The patch of least thin-plate energy over a domain triangle, whose shape says how the parameters are to be
    /// measured. The energy is quadratic in the six free numbers.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a domain triangle without area; [`Error::DegenerateEnergy`];
    /// [`Error::IrregularBoundary`] when the minimum folds at a boundary.
    pub fn smoothest(&self, domain: [DVec2; 3]) -> Result<SmoothedTriangle<S>, Error> {
        let plate = ThinPlate::new(domain)?;
        let flat = self.patch([[0.0; 2]; 3])?;
        // The construction is affine in the twists: the steps are a basis of what they do.
        let steps: [TwistStep; 6] = from_fn(|k| flat.step(k));
        let (mut matrix, mut gradient) =
            (SMatrix::<f64, 6, 6>::zeros(), SVector::<f64, 6>::zeros());
        let mut energy_at_zero = 0.0;
        for (l, weight) in &plate.rule {
            let samples = flat.samples(*l);
            let base = plate.integrand(&flat.jet(*l, &samples));
            let basis: [[DVec3; 3]; 6] = from_fn(|k| plate.integrand(&steps[k].jet(*l, &samples)));
            let dot = |a: &[DVec3; 3], b: &[DVec3; 3]| (0..3).map(|n| a[n].dot(b[n])).sum::<f64>();
            energy_at_zero += weight * dot(&base, &base);
            for k in 0..6 {
                gradient[k] += weight * dot(&base, &basis[k]);
                for m in 0..6 {
                    matrix[(k, m)] += weight * dot(&basis[k], &basis[m]);
                }
            }
        }
        let w = matrix
            .cholesky()
            .ok_or(Error::DegenerateEnergy)?
            .solve(&-gradient);
        let mut eigenvalues: [f64; 6] = matrix.symmetric_eigenvalues().into();
        eigenvalues.sort_by(f64::total_cmp);
        let patch = self.patch(from_fn(|i| [w[2 * i], w[2 * i + 1]]))?;
        Ok(SmoothedTriangle {
            patch,
            energy: energy_at_zero + gradient.dot(&w),
            energy_at_zero,
            eigenvalues,
        })
    }
}

impl<S: Strip> TrianglePatch<S> {
    /// The thin-plate energy over a domain triangle.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a domain triangle without area.
    pub fn thin_plate_energy(&self, domain: [DVec2; 3]) -> Result<f64, Error> {
        let plate = ThinPlate::new(domain)?;
        let density = |l: [f64; 3]| {
            plate
                .integrand(&self.jet(l, &self.samples(l)))
                .iter()
                .map(|x| x.length_squared())
                .sum::<f64>()
        };
        Ok(plate.rule.iter().map(|(l, w)| w * density(*l)).sum())
    }
}

/// The gradients of the barycentric coordinates of a domain triangle.
///
/// # Errors
/// [`Error::OutOfRange`] for a triangle without area, [`Error::NonFinite`].
pub fn barycentric_gradients(triangle: [DVec2; 3]) -> Result<[DVec2; 3], Error> {
    if let Some(index) = triangle.iter().position(|p| !p.is_finite()) {
        return Err(Error::NonFinite {
            what: "domain point",
            index,
        });
    }
    let [a, b, c] = triangle;
    // Edges only, in units of the longest coordinate: neither place nor scale matters.
    let edges = [c - b, a - c, b - a];
    let size = edges
        .iter()
        .fold(0.0, |m: f64, edge| m.max(edge.abs().max_element()));
    let edges = edges.map(|edge| edge / size);
    let twice_area = edges[0].perp_dot(edges[1]);
    let gradients = edges.map(|edge| edge.perp() / twice_area / size);
    if !(twice_area.abs() > 1e-12 && gradients.iter().all(|g| g.is_finite())) {
        return Err(Error::OutOfRange {
            what: "area of the domain triangle",
            value: 0.5 * twice_area * size * size,
            range: [0.0, f64::INFINITY],
        });
    }
    Ok(gradients)
}

/// Gauss points in either direction of the collapsed square: exact to degree 22.
const NODES: usize = 12;

/// The thin-plate energy on a domain triangle: `Hess R = sum_ij R_ij g_i g_j^T`.
struct ThinPlate {
    gradients: [DVec2; 3],
    rule: Vec<([f64; 3], f64)>,
}

impl ThinPlate {
    fn new(domain: [DVec2; 3]) -> Result<Self, Error> {
        let gradients = barycentric_gradients(domain)?;
        let twice_area = (domain[1] - domain[0])
            .perp_dot(domain[2] - domain[0])
            .abs();
        let rule = quadrature::triangle(NODES)
            .into_iter()
            .map(|(l, w)| (l, w * twice_area))
            .collect();
        Ok(Self { gradients, rule })
    }

    /// `R_xx`, `sqrt(2) R_xy`, `R_yy` in the domain's Cartesian coordinates.
    fn integrand(&self, jet: &BarycentricJet) -> [DVec3; 3] {
        let g = &self.gradients;
        let mut hessian = [DVec3::ZERO; 3];
        for m in 0..3 {
            for n in 0..3 {
                let second = jet.second[m][n];
                hessian[0] += second * (g[m].x * g[n].x);
                hessian[1] += second * (g[m].x * g[n].y * core::f64::consts::SQRT_2);
                hessian[2] += second * (g[m].y * g[n].y);
            }
        }
        hessian
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_depend_on_neither_place_nor_scale() {
        let wanted = [DVec2::NEG_ONE, DVec2::X, DVec2::Y];
        for (place, size) in [(0.0, 1.0), (1e9, 1.0), (0.0, 1e-200), (0.0, 1e200)] {
            let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
            let corners = corners.map(|p| p * size + DVec2::splat(place));
            let gradients = barycentric_gradients(corners).unwrap();
            for (g, w) in gradients.into_iter().zip(wanted) {
                assert!((g * size - w).length() < 1e-14, "{place} {size}");
            }
        }
        let line = [DVec2::ZERO, DVec2::X, DVec2::X * 2.0];
        assert!(matches!(
            barycentric_gradients(line),
            Err(Error::OutOfRange { .. })
        ));
    }
}
