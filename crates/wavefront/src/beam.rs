//! What a whole interval of rays can meet: enclosures that tell where a wave has surely no ray.
//!
//! ```text
//!    start      a beam: all rays that start in a box, with normals between two. Its wedge meets some parts
//!    +--+       of an interface; each part, a box with the tangents in it, scatters the beam into another
//!    +--+\      one. The true rays are among those of the beams, so that an interval whose beams all end
//!      \  \     (they pass by the interface, or are totally reflected) has no ray with the code.
//!    ===+===+=== part
//! ```

use glam::DVec2;

use crate::{Fan, Medium, Mode, Source};

/// Angles are widened by this, against rounding.
const ROUNDING: f64 = 1e-12;
/// Wider beams are not followed: halves are.
const WIDEST: f64 = 1.5;
/// The cosine of the angle between the outer rays is at least this.
const NARROW: f64 = 0.07;
/// So many parts are followed for one interval before it counts as not excluded.
const MOST_PARTS: u32 = 100;

/// Rays that start in a box with normals from an angle on (radians, counter-clockwise).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    low: DVec2,
    high: DVec2,
    angle: f64,
    turn: f64,
}

/// The plane region before a beam.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wedge {
    centre: DVec2,
    half: DVec2,
    first: DVec2,
    last: DVec2,
}

/// A part of an interface: a box around it, and the angle of its tangents to a spread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    pub(crate) tangent: f64,
    pub(crate) spread: f64,
}

impl Beam {
    /// The rays of a source between two parameters; none for a source that is not enclosed (a curve).
    fn of_source(source: &Source, [from, to]: [f64; 2], medium: &Medium) -> Option<Self> {
        match source {
            Source::Point { position, angles } => {
                let angle = |t: f64| angles[0] + (angles[1] - angles[0]) * t;
                let (one, two) = (angle(from), angle(to));
                Some(Self {
                    low: *position,
                    high: *position,
                    angle: one.min(two) - ROUNDING,
                    turn: (two - one).abs() + 2.0 * ROUNDING,
                })
            }
            Source::Plane { .. } => {
                let (one, two) = (source.ray(from, medium).ok()?, source.ray(to, medium).ok()?);
                Some(Self {
                    low: one.point.min(two.point),
                    high: one.point.max(two.point),
                    angle: one.slowness.to_angle() - ROUNDING,
                    turn: 2.0 * ROUNDING,
                })
            }
            Source::Reflector { .. } | Source::Front(_) => None,
        }
    }

    fn middle(&self) -> f64 {
        self.angle + 0.5 * self.turn
    }

    /// Where its rays run: between the velocities of the outer normals. None for a beam that is too wide.
    fn wedge(&self, medium: &Medium) -> Option<Wedge> {
        let direction = |angle: f64| {
            let slowness = medium.slowness(DVec2::from_angle(angle));
            medium.group_velocity(slowness).normalize()
        };
        let (first, last) = (direction(self.angle), direction(self.angle + self.turn));
        if self.turn > WIDEST || first.dot(last) < NARROW || first.perp_dot(last) < -ROUNDING {
            return None;
        }
        let margin = DVec2::new(1.0, 2.0 * ROUNDING);
        Some(Wedge {
            centre: 0.5 * (self.low + self.high),
            half: 0.5 * (self.high - self.low),
            first: first.rotate(DVec2::new(margin.x, -margin.y)),
            last: margin.rotate(last),
        })
    }

    /// The beams into which a part of an interface scatters this one: at most two, if some rays may come from either side.
    fn scatter(
        &self,
        part: &Part,
        mode: Mode,
        [medium, beyond]: [&Medium; 2],
    ) -> Option<[Option<Self>; 2]> {
        let wedge = self.wedge(medium)?;
        let tangent = DVec2::from_angle(part.tangent);
        // The component of the slowness along the interface, with all that the normals and the tangents may add.
        let [largest, steepest] = medium.slowness_bounds()?;
        let [largest_beyond, _] = beyond.slowness_bounds()?;
        let slowness = medium.slowness(DVec2::from_angle(self.middle()));
        let error = 0.5 * steepest * self.turn + (largest + largest_beyond) * part.spread;
        let along = slowness.dot(tangent);
        let (least, most) = (
            along - error - ROUNDING * largest,
            along + error + ROUNDING * largest,
        );
        // Along the interface the component is as large as it can be.
        let grazing = beyond.slowness_along(tangent).ok()?;
        let limit = grazing.dot(tangent);
        if least > limit || most < -limit {
            return Some([None, None]);
        }
        let side = |direction: DVec2| tangent.perp_dot(direction);
        let slack = part.spread + 4.0 * ROUNDING;
        let from_left = side(wedge.first).min(side(wedge.last)) <= slack;
        let from_right = side(wedge.first).max(side(wedge.last)) >= -slack;
        let beam = |onwards: f64| {
            let normal = onwards * tangent.perp();
            // Where the tangent turns, the grazing ray's normal turns with it, and rays close to that may be on its other side.
            let bend = slack * beyond.stretch();
            let angle = |component: f64| {
                if component.abs() < limit * (1.0 - bend * bend)
                    && let Ok(slowness) =
                        beyond.slowness_behind(component, tangent, normal, DVec2::ZERO)
                {
                    return (slowness.to_angle(), slack);
                }
                ((component.signum() * grazing).to_angle(), 2.0 * bend)
            };
            let (one, two) = (angle(least), angle(most));
            // From the tangent's back to its front, on the side of the normal.
            let (start, end) = if onwards > 0.0 {
                (two, one)
            } else {
                (one, two)
            };
            let turn = (end.0 - start.0).rem_euclid(std::f64::consts::TAU);
            // Two angles that agree but for rounding.
            let turn = if turn > 4.0 { 0.0 } else { turn };
            Self {
                low: part.low,
                high: part.high,
                angle: start.0 - start.1,
                turn: turn + start.1 + end.1,
            }
        };
        // A ray that comes from the left of the tangent runs to the right.
        let sense = if mode == Mode::Transmit { 1.0 } else { -1.0 };
        Some([
            from_left.then(|| beam(-sense)),
            from_right.then(|| beam(sense)),
        ])
    }
}

/// Straight parts are narrowed to the wedge by so many halvings.
const HALVINGS: u32 = 20;

impl Part {
    /// Calls `found` with what a wedge may meet of a straight part between two points.
    pub(crate) fn narrowed(
        self,
        start: DVec2,
        end: DVec2,
        wedge: &Wedge,
        found: &mut dyn FnMut(Option<Self>),
    ) {
        if let (Some(one), Some(two)) = (
            first_met(start, end, wedge, HALVINGS),
            first_met(end, start, wedge, HALVINGS),
        ) {
            found(Some(Self {
                low: one.min(two),
                high: one.max(two),
                ..self
            }));
        }
    }
}

/// Where a segment enters a wedge at the earliest, if it may meet it.
fn first_met(start: DVec2, end: DVec2, wedge: &Wedge, halvings: u32) -> Option<DVec2> {
    if !wedge.may_meet(start.min(end), start.max(end)) {
        return None;
    }
    if halvings == 0 {
        return Some(start);
    }
    let middle = 0.5 * (start + end);
    first_met(start, middle, wedge, halvings - 1)
        .or_else(|| first_met(middle, end, wedge, halvings - 1))
}

impl Wedge {
    /// Whether a ray of the beam may meet a box.
    #[inline]
    pub(crate) fn may_meet(&self, low: DVec2, high: DVec2) -> bool {
        let centre = 0.5 * (low + high) - self.centre;
        let half = 0.5 * (high - low) + self.half;
        let reach = |direction: DVec2| direction.abs().dot(half);
        let across = |direction: DVec2| direction.perp_dot(centre);
        let reach_across = |direction: DVec2| direction.abs().dot(DVec2::new(half.y, half.x));
        let ahead = self.first + self.last;
        // Not all on the wrong side of the outer rays, and not all behind. Infinite boxes pass.
        let right = across(self.first) + reach_across(self.first) < 0.0;
        let left = across(self.last) - reach_across(self.last) > 0.0;
        let behind = ahead.dot(centre) + reach(ahead) < 0.0;
        !(right || left || behind)
    }
}

impl Fan<'_> {
    /// Whether no ray between two parameters of the source can have this code, for certain.
    pub(crate) fn excludes(&self, range: [f64; 2]) -> bool {
        let mut parts = MOST_PARTS;
        Beam::of_source(self.source(), range, self.first_medium())
            .is_some_and(|beam| !self.may_pass(&beam, 0, &mut parts))
    }

    fn may_pass(&self, beam: &Beam, index: usize, parts: &mut u32) -> bool {
        let Some(step) = self.code().steps.get(index) else {
            return true;
        };
        let medium = |leg: usize| &self.model().media()[self.layers()[leg]];
        let Some(wedge) = beam.wedge(medium(index)) else {
            return true;
        };
        let interface = &self.model().interfaces()[step.interface];
        let mut possible = false;
        interface.visit_parts(&wedge, self.model().corners(), &mut |part| {
            let Some(part) = part.filter(|_| *parts > 0) else {
                possible = true;
                return;
            };
            if possible {
                return;
            }
            *parts -= 1;
            let beams = beam.scatter(&part, step.mode, [medium(index), medium(index + 1)]);
            possible = beams.is_none_or(|beams| {
                let mut beams = beams.into_iter().flatten();
                beams.any(|beam| self.may_pass(&beam, index + 1, parts))
            });
        });
        possible
    }
}
