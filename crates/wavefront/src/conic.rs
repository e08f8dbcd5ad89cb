//! Conics as interfaces: where rays meet them, in closed form.

use glam::{DMat2, DVec2};

use crate::{Error, Impact};

/// `(x - centre)ᵀ form (x - centre) + 2 linear (x - centre) + constant = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Conic {
    centre: DVec2,
    form: DMat2,
    linear: DVec2,
    constant: f64,
}

/// A determinant below this share of the form's size belongs to a parabola, which has no centre.
const PARABOLIC: f64 = 1e-12;

impl Conic {
    pub(crate) fn new(
        centre: DVec2,
        form: DMat2,
        linear: DVec2,
        constant: f64,
    ) -> Result<Self, Error> {
        if !(centre.is_finite() && form.is_finite() && linear.is_finite() && constant.is_finite()) {
            return Err(Error::NonFinite {
                what: "a coefficient of a conic",
            });
        }
        if form == DMat2::ZERO {
            return Err(Error::BadInterface {
                interface: 0,
                reason: "the quadratic part of a conic vanishes",
            });
        }
        Ok(Self {
            centre,
            form,
            linear,
            constant,
        })
    }

    /// Calls `found` for every impact later than `after`, in no order.
    pub(crate) fn visit_impacts(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        mut found: impl FnMut(Impact),
    ) {
        let start = origin - self.centre;
        let gradient = self.form * start + self.linear;
        let a = velocity.dot(self.form * velocity);
        let b = velocity.dot(gradient);
        let c = start.dot(gradient + self.linear) + self.constant;
        let times = quadratic_roots(a, b, c).into_iter().flatten();
        for time in times.filter(|time| *time > after) {
            let point = origin + time * velocity;
            let gradient = self.form * (point - self.centre) + self.linear;
            let Some(tangent) = gradient.perp().try_normalize() else {
                continue;
            };
            let curvature = tangent.dot(self.form * tangent) / gradient.length();
            found(Impact {
                time,
                point,
                tangent,
                curvature,
                parameter: 0.0,
            });
        }
    }

    /// A point from which rays in all directions meet the conic: its centre, or some inner point of a parabola's box.
    pub(crate) fn heart(&self, low: DVec2, high: DVec2) -> DVec2 {
        let size = self.form.x_axis.length() * self.form.y_axis.length();
        if self.form.determinant().abs() > PARABOLIC * size {
            self.centre - self.form.inverse() * self.linear
        } else {
            0.5 * (low + high)
        }
    }
}

/// The real roots of `a x² + 2 b x + c`, without cancellation; a double root once.
fn quadratic_roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    if a == 0.0 {
        return [(b != 0.0).then(|| -c / (2.0 * b)), None];
    }
    let discriminant = b * b - a * c;
    if discriminant < 0.0 || discriminant.is_nan() {
        return [None, None];
    }
    let larger = -(b + discriminant.sqrt().copysign(b));
    if larger == 0.0 {
        return [Some(0.0), None];
    }
    [Some(larger / a), (discriminant > 0.0).then(|| c / larger)]
}

#[cfg(feature = "serde")]
impl From<Conic> for crate::stored::StoredInterface {
    fn from(conic: Conic) -> Self {
        Self::Conic {
            centre: conic.centre,
            form: conic.form,
            linear: conic.linear,
            constant: conic.constant,
        }
    }
}
