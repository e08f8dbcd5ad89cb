//! Arrivals: the rays of a fan that pass through given points.

use glam::DVec2;

use crate::fan::Run;
use crate::trace::Landing;
use crate::{Fan, Medium, Ray};

/// A wave's arrival at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Arrival {
    /// The arrival time.
    pub time: f64,
    /// The source's parameter of the ray.
    pub parameter: f64,
    /// The ray as it starts its last leg.
    pub ray: Ray,
    /// The width of the ray tube at the point, per unit of the source's parameter: the amplitude falls with its square root.
    pub tube_width: f64,
    /// How often the ray has touched a caustic on its way: each time the phase jumps by a quarter of a period.
    pub caustics: u32,
}

impl Arrival {
    /// The amplitude by ray-tube spreading, relative to that at unit distance from a point source of unit strength per
    /// radian, whose parameter covers `angles` radians. Infinite on a caustic, where ray theory ends.
    #[must_use]
    pub fn amplitude(&self, angles: f64) -> f64 {
        (angles.abs() / self.tube_width).sqrt()
    }
}

/// A ray that passes a receiver at less than this share of the model's size is carried through it by its own derivatives:
/// the time, corrected to second order, is then exact to rounding.
const NEAR: f64 = 1e-6;
/// The step of the parameter that does so is at most this share of a strip.
const SMALL_STEP: f64 = 1e-3;
/// On a caustic the last step may be large though the ray passes: at this share of the model's size it does.
const THROUGH: f64 = 1e-12;
/// A step of Newton's method on a strip's cubic this small (a share of the strip) leaves less than the exact ray needs.
const GOOD_START: f64 = 1e-2;
/// A receiver as close to the start of a ray's last leg as this share of the model's size is at it.
const AT_START: f64 = 1e-9;
/// Newton's method in a bracket, with a halving where it leaves or stalls.
const STEPS: usize = 60;

impl Fan<'_> {
    /// All arrivals at a point, by increasing time. For many points [`Fan::visit_arrivals`] is quicker.
    #[must_use]
    pub fn arrivals(&self, point: DVec2) -> Vec<Arrival> {
        let mut found = Vec::new();
        self.arrivals_in_any_order(point, |arrival| found.push(arrival));
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        found
    }

    /// The first arrival at a point.
    #[must_use]
    pub fn first_arrival(&self, point: DVec2) -> Option<Arrival> {
        let mut first: Option<Arrival> = None;
        self.arrivals_in_any_order(point, |arrival| {
            if first.is_none_or(|known| arrival.time < known.time) {
                first = Some(arrival);
            }
        });
        first
    }

    fn arrivals_in_any_order(&self, point: DVec2, mut found: impl FnMut(Arrival)) {
        if !point.is_finite() {
            return;
        }
        for run in self.runs() {
            for index in 0..run.strips.len() {
                let strip = &run.strips[index];
                if let Some(distances) = strip.distances_within(point, self.slack()) {
                    self.follow(run, index, false, distances, point, &mut found);
                }
            }
        }
    }

    /// Calls `found` for each arrival of a strip at a point that has these distances from its control lines.
    ///
    /// The distances are the Bernstein coefficients of the point's distance from the rays. Where they change sign there is a
    /// ray through the point, and their cubic's zero is its parameter but for the interpolation's error, which one step of
    /// Newton's method on the exact ray removes. Rays of a strip that is clear are known to meet no boundary.
    #[inline]
    pub(crate) fn follow(
        &self,
        run: &Run,
        index: usize,
        is_clear: bool,
        distances: [f64; 4],
        point: DVec2,
        found: &mut impl FnMut(Arrival),
    ) {
        let (start, end) = (run.parameters[index], run.parameters[index + 1]);
        let at = |share: f64| start + share * (end - start);
        let right = distances.map(|distance| distance <= 0.0);
        let changes = right.windows(2).filter(|pair| pair[0] != pair[1]).count();
        if changes == 1 {
            let guess = at(only_zero(distances));
            let bracket = Bracket {
                low: start,
                high: end,
                right_at_low: right[0],
                guess,
                is_clear,
            };
            self.refine(run, index, bracket, point, found);
            return;
        }
        // The rays nearest to the point lie between the arrivals, if there are several.
        let mut low = (start, right[0]);
        let high = (end, right[3]);
        let turns = stationary(distances).into_iter().flatten();
        for (parameter, is_right) in turns
            .filter_map(|share| {
                let landing = self.ray_near(run, index, at(share))?;
                let medium = self.last_medium();
                Some((at(share), landing.ray.side(point, medium).0 <= 0.0))
            })
            .chain([high])
        {
            if is_right != low.1 {
                let bracket = Bracket {
                    low: low.0,
                    high: parameter,
                    right_at_low: low.1,
                    guess: 0.5 * (low.0 + parameter),
                    is_clear,
                };
                self.refine(run, index, bracket, point, found);
            }
            low = (parameter, is_right);
        }
    }

    /// A receiver closer to a strip than this may have a ray in it that the strip's cubic does not show.
    #[inline]
    pub(crate) fn slack(&self) -> f64 {
        NEAR * self.model().size()
    }

    fn last_medium(&self) -> &Medium {
        &self.model().media()[self.last_layer()]
    }

    /// Finds the ray through the point inside a bracket, and reports it if it gets there.
    #[inline(always)]
    fn refine(
        &self,
        run: &Run,
        index: usize,
        mut bracket: Bracket,
        point: DVec2,
        found: &mut impl FnMut(Arrival),
    ) {
        let size = self.model().size();
        let small = SMALL_STEP * (run.parameters[index + 1] - run.parameters[index]);
        let mut parameter = bracket.guess;
        for round in 0..STEPS {
            let Some(landing) = self.ray_near(run, index, parameter) else {
                return;
            };
            let passage = Passage::new(&landing.ray, point, self.last_medium());
            let near = passage.distance.abs() <= NEAR * size && passage.step.abs() <= small;
            let stuck = bracket.high - bracket.low <= f64::EPSILON;
            if near || stuck || passage.distance.abs() <= THROUGH * size {
                let step = if near { passage.step } else { 0.0 };
                // On the interface that the wave leaves it arrives as it sets out.
                let at_start = landing.left.is_some()
                    && passage.way_after(&landing.ray, step).abs() <= AT_START * size;
                let reaches = at_start
                    || passage.travel > 0.0
                        && (bracket.is_clear
                            || self
                                .model()
                                .is_unblocked(&landing, self.last_layer(), point));
                if reaches {
                    found(passage.arrival(&landing, parameter, step, point));
                }
                return;
            }
            bracket.narrow(parameter, passage.distance <= 0.0);
            parameter = bracket.next(parameter + passage.step, round);
        }
    }
}

/// How a ray passes a point.
struct Passage {
    velocity: DVec2,
    inverse_speed: f64,
    /// The travel time from the ray's start to the place next to the point.
    travel: f64,
    /// The signed distance of the point, positive to the left.
    distance: f64,
    /// The step of the parameter to the ray through the point, to first order.
    step: f64,
    /// The width of the tube, signed, where the ray starts and at the point.
    widths: [f64; 2],
}

impl Passage {
    #[inline]
    fn new(ray: &Ray, point: DVec2, medium: &Medium) -> Self {
        let velocity = medium.group_velocity(ray.slowness);
        let change = medium.group_velocity_change(ray.slowness, ray.slowness_change);
        let way = point - ray.point;
        let inverse_square = velocity.length_squared().recip();
        let inverse_speed = inverse_square.sqrt();
        let travel = velocity.dot(way) * inverse_square;
        let distance = velocity.perp_dot(way) * inverse_speed;
        // The neighbours' places across the ray, where it starts and next to the point: what they gain there is what the
        // distance changes by.
        let start = ray.point_change.perp_dot(velocity) * inverse_speed;
        let end = start + travel * change.perp_dot(velocity) * inverse_speed;
        Self {
            velocity,
            inverse_speed,
            travel,
            distance,
            step: -distance / end,
            widths: [start, end],
        }
    }

    /// The way from the start of the ray to the point, after a small step of its parameter.
    fn way_after(&self, ray: &Ray, step: f64) -> f64 {
        let forward = self.inverse_speed * self.velocity.dot(ray.point_change);
        self.travel / self.inverse_speed - step * forward
    }

    /// The arrival by a ray that passes the point at a small distance, and through it after a `step` of its parameter.
    #[inline]
    fn arrival(&self, landing: &Landing, parameter: f64, step: f64, point: DVec2) -> Arrival {
        let ray = &landing.ray;
        // T(t) = time + <s, X - x> has the derivative <s', X - x>, which is proportional to the distance and to it alone:
        // the integral over the step is half of the product.
        let turning = ray.slowness_change.perp_dot(self.velocity) * self.inverse_speed;
        let rate = -turning * self.distance;
        let [start, end] = self.widths;
        Arrival {
            time: ray.time_at(point) + 0.5 * rate * step,
            parameter: parameter + step,
            ray: ray.moved(step),
            tube_width: end.abs(),
            caustics: landing.caustics + u32::from(start * end < 0.0),
        }
    }
}

/// Parameters between which the point changes from one side of the ray to the other.
struct Bracket {
    low: f64,
    high: f64,
    right_at_low: bool,
    /// Where to begin.
    guess: f64,
    /// Whether its rays are known to meet nothing on their last leg.
    is_clear: bool,
}

impl Bracket {
    fn narrow(&mut self, parameter: f64, is_right: bool) {
        if is_right == self.right_at_low {
            self.low = parameter;
        } else {
            self.high = parameter;
        }
    }

    /// Newton's guess if it lies inside, the middle otherwise and now and then.
    fn next(&self, guess: f64, round: usize) -> f64 {
        if guess > self.low && guess < self.high && round % 8 != 7 {
            guess
        } else {
            0.5 * (self.low + self.high)
        }
    }
}

/// The zero in `[0, 1]` of a cubic with Bernstein coefficients of one sign change, near enough for a start.
#[inline]
fn only_zero([a, b, c, d]: [f64; 4]) -> f64 {
    // Newton's method in powers of t from the chord's zero; the coefficients are close to a line's.
    let (slope, square, cube) = (
        3.0 * (b - a),
        3.0 * (a - 2.0 * b + c),
        d - a + 3.0 * (b - c),
    );
    let mut t = a / (a - d);
    for _ in 0..2 {
        let value = ((cube * t + square) * t + slope) * t + a;
        let step = value / ((3.0 * cube * t + 2.0 * square) * t + slope);
        let next = t - step;
        t = if next.is_nan() {
            0.5
        } else {
            next.clamp(0.0, 1.0)
        };
        if step.abs() < GOOD_START {
            break;
        }
    }
    t
}

/// The parameters in `(0, 1)` where a cubic in Bernstein form is stationary, in order.
fn stationary([a, b, c, d]: [f64; 4]) -> [Option<f64>; 2] {
    // p + 2 (q - p) t + (p - 2 q + r) t² for the slopes p, q, r.
    let (p, q, r) = (b - a, c - b, d - c);
    let (square, half, constant) = (p - 2.0 * q + r, q - p, p);
    let root = (half * half - square * constant).sqrt();
    let larger = -(half + root.copysign(half));
    let inside = |t: f64| (t > 0.0 && t < 1.0).then_some(t);
    let (one, two) = (inside(larger / square), inside(constant / larger));
    match (one, two) {
        (Some(s), Some(t)) if s > t => [Some(t), Some(s)],
        (Some(s), Some(t)) if s == t => [Some(s), None],
        (one, two) => [one, two],
    }
}
