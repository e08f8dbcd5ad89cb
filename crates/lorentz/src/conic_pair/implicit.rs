use bezier_mass::Parameter;
use glam::DVec3;

use crate::tolerance::DECISION;
use crate::{LorentzVector, SphereCurve};

/// The implicit equation `F(x) = v1^2 - v0 v2 = 0` of a cyclide, `vi = Xi . (e_o + x + |x|^2/2 e_inf)`.
///
/// A quartic in general, a cubic or a quadric if infinity lies on the surface. On the surface the quadratic
/// `(1-t)^2 v0 + 2t(1-t) v1 + t^2 v2` has a double zero at the parameter of the sphere that touches there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImplicitCyclide {
    control: [LorentzVector; 3],
}

/// Which sphere of the own family touches the surface in a given point of it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum OwnParameter {
    /// The sphere at this parameter, possibly infinite.
    At(Parameter),
    /// All of them: the point is a singular point of the second family.
    Every,
}

impl SphereCurve {
    /// The implicit equation of the envelope.
    #[must_use]
    pub fn implicit(&self) -> ImplicitCyclide {
        ImplicitCyclide {
            control: self.control().map(|b| b.weighted),
        }
    }
}

impl ImplicitCyclide {
    /// The three products `vi`.
    #[must_use]
    pub fn products(&self, x: DVec3) -> [f64; 3] {
        let p = LorentzVector::new(1.0, x, 0.5 * x.length_squared());
        self.control.map(|control| control.product(p))
    }

    /// The value `F(x)`.
    #[must_use]
    pub fn value(&self, x: DVec3) -> f64 {
        let [v0, v1, v2] = self.products(x);
        v1 * v1 - v0 * v2
    }

    /// The gradient of F, normal to the surface.
    #[must_use]
    pub fn gradient(&self, x: DVec3) -> DVec3 {
        let [v0, v1, v2] = self.products(x);
        let [g0, g1, g2] = self.control.map(|control| control.v - control.o * x);
        2.0 * v1 * g1 - v0 * g2 - v2 * g0
    }

    /// `F(x)` relative to the terms that were added: a plain number, zero on the surface to rounding.
    #[must_use]
    pub fn residual(&self, x: DVec3) -> f64 {
        let [t0, t1, t2] = self.terms(x);
        let terms = t1 * t1 + t0 * t2;
        if terms == 0.0 {
            0.0
        } else {
            self.value(x) / terms
        }
    }

    /// Whether the point lies on the surface, to 1e-10 of the terms.
    #[must_use]
    pub fn contains(&self, x: DVec3) -> bool {
        self.residual(x).abs() <= DECISION
    }

    /// The own sphere that touches the surface in its point `x`.
    #[must_use]
    pub fn parameter(&self, x: DVec3) -> OwnParameter {
        let (v, terms) = (self.products(x), self.terms(x));
        // On the surface v1 is the geometric mean of v0 and v2, and its square root of precision is theirs.
        let scale = terms.into_iter().fold(0.0, f64::max);
        let [v0, v1, v2] = v;
        if v0.abs().max(v2.abs()) <= DECISION * scale {
            return OwnParameter::Every;
        }
        let parameter = if v0.abs() >= v2.abs() {
            Parameter::new(v0, v0 - v1)
        } else {
            Parameter::new(v1, v1 - v2)
        };
        let Ok(parameter) = parameter else {
            return OwnParameter::Every;
        };
        // The difference of two products that agree to rounding is zero: the parameter infinity.
        let difference = if v0.abs() >= v2.abs() {
            v0 - v1
        } else {
            v1 - v2
        };
        if difference.abs() <= 16.0 * f64::EPSILON * scale {
            return OwnParameter::At(Parameter::INFINITY);
        }
        OwnParameter::At(parameter)
    }

    /// The magnitudes of the terms of the three products.
    fn terms(&self, x: DVec3) -> [f64; 3] {
        let (length, half_square) = (x.length(), 0.5 * x.length_squared());
        self.control.map(|control| {
            control.v.length() * length + control.o.abs() * half_square + control.inf.abs()
        })
    }
}
