use bezier_mass::{Biquadratic, MassPoint, bernstein};
use glam::DVec3;

use crate::sphere_curve::lie_terms;
use crate::tolerance::ON_QUADRIC;
use crate::{Error, LorentzVector, SphereCurve, lie_product};

/// The points of contact of two curves of spheres, one of each family of a cyclide: a rational biquadratic patch.
///
/// The spheres at `s` and `t` touch in the light-like vector `y(s, t) = w2(t) X1(s) - w1(s) X2(t)`. Both families of parameter lines are curvature circles of the cyclide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPatch {
    net: [[LorentzVector; 3]; 3],
}

impl ContactPatch {
    /// The patch of `first` (parameter s) and `second` (parameter t).
    ///
    /// # Errors
    /// [`Error::NotTheSecondFamily`] unless every sphere of one touches every sphere of the other.
    pub fn new(first: &SphereCurve, second: &SphereCurve) -> Result<Self, Error> {
        let mut residual = 0.0_f64;
        for b in first.control() {
            for e in second.control() {
                let terms = lie_terms(*b, *e);
                if terms > 0.0 {
                    residual = residual.max(lie_product(*b, *e).abs() / terms);
                }
            }
        }
        if residual > ON_QUADRIC {
            return Err(Error::NotTheSecondFamily { residual });
        }
        let contact = |b: &crate::SphereMassPoint| {
            second
                .control()
                .map(|e| e.weight * b.weighted - b.weight * e.weighted)
        };
        let [b0, b1, b2] = first.control();
        Ok(Self {
            net: [contact(b0), contact(b1), contact(b2)],
        })
    }

    /// The Bernstein coefficients of the contact vector: first index along `first`, second along `second`.
    #[must_use]
    pub const fn net(&self) -> &[[LorentzVector; 3]; 3] {
        &self.net
    }

    /// The light-like contact vector at `(s, t)`; [`LorentzVector::recover`] gives the point and its scale.
    #[must_use]
    pub fn contact(&self, s: f64, t: f64) -> LorentzVector {
        bernstein::evaluate(&self.net.map(|row| bernstein::evaluate(&row, t)), s)
    }

    /// The rational biquadratic patch in space, with mass control points.
    ///
    /// # Errors
    /// [`Error::Bezier`] on overflow.
    pub fn surface(&self) -> Result<Biquadratic<DVec3>, Error> {
        Ok(Biquadratic::new(self.net.map(|row| {
            row.map(|y| MassPoint::from_homogeneous(y.o, y.v))
        }))?)
    }
}
