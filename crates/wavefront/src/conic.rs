//! Conics as interfaces: where rays meet them, in closed form.

use glam::{DMat2, DVec2};

use crate::beam::{Part, Wedge};
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

/// A discriminant below this share of its terms has lost digits.
const CANCELLED: f64 = 1e-2;
/// Parts are looked for in a box that is widened by this share of its size, against rounding.
const PART_MARGIN: f64 = 1e-8;
/// The box is quartered at least and at most so often, and until the tangents turn by so much (radians) to either side.
const LEAST_QUARTERS: u32 = 5;
const MOST_QUARTERS: u32 = 24;
const SMALL_TURN: f64 = 0.05;

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
        // Where the roots are close to each other, at a small or grazed conic, its place between them is known far better than
        // the discriminant: they are sought from there.
        let between = -b / a;
        let (shift, roots) = if (b * b - a * c).abs() < CANCELLED * b * b {
            let start = start + between * velocity;
            let gradient = self.form * start + self.linear;
            let (b, c) = (
                velocity.dot(gradient),
                start.dot(gradient + self.linear) + self.constant,
            );
            (between, quadratic_roots(a, b, c))
        } else {
            (0.0, quadratic_roots(a, b, c))
        };
        let times = roots.into_iter().flatten().map(|time| shift + time);
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

    /// Calls `found` with the parts in a box that rays of a wedge may meet: the box is quartered until its parts are off the
    /// conic, or the gradient turns little in them.
    pub(crate) fn visit_parts(
        &self,
        wedge: &Wedge,
        [low, high]: [DVec2; 2],
        found: &mut dyn FnMut(Option<Part>),
    ) {
        let half = 0.5 * (high - low);
        self.visit_quarter(wedge, low + half, half * (1.0 + PART_MARGIN), 0, found);
    }

    fn visit_quarter(
        &self,
        wedge: &Wedge,
        centre: DVec2,
        half: DVec2,
        depth: u32,
        found: &mut dyn FnMut(Option<Part>),
    ) {
        let (low, high) = (centre - half, centre + half);
        let place = centre - self.centre;
        let gradient = self.form * place + self.linear;
        let value = place.dot(gradient + self.linear) + self.constant;
        let entries = [self.form.x_axis.abs(), self.form.y_axis.abs()];
        // The gradient changes by this much at most in the box, and the value by what follows from it.
        let change = half.x * entries[0] + half.y * entries[1];
        let reach = 2.0 * gradient.abs().dot(half) + half.dot(change);
        if value.abs() > reach || !wedge.may_meet(low, high) {
            return;
        }
        let spread = (change.length() / gradient.length()).min(1.0).asin();
        if depth >= MOST_QUARTERS || (depth >= LEAST_QUARTERS && spread <= SMALL_TURN) {
            let known = spread < std::f64::consts::FRAC_PI_2;
            found(known.then(|| Part {
                low,
                high,
                tangent: gradient.perp().to_angle(),
                spread,
            }));
            return;
        }
        let quarter = 0.5 * half;
        for corner in [
            DVec2::NEG_ONE,
            DVec2::new(1.0, -1.0),
            DVec2::new(-1.0, 1.0),
            DVec2::ONE,
        ] {
            self.visit_quarter(wedge, centre + corner * quarter, quarter, depth + 1, found);
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
