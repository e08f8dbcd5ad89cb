//! Exact rational biquadratic Bézier patches of cyclides.

use crate::frame::finite;
use crate::{Dupin, Error, Parabolic, Quartic};
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A rectangle of lines of curvature on a cyclide, with its exact rational biquadratic Bézier net.
///
/// Row `i` of the net follows the first parameter (`theta` or `u`), column `j` the second. The controls are mass points: weights
/// may vanish or be negative, also for spans below `pi` (on a surface with `c > 0` an edge weight vanishes where the *arc* is a
/// semicircle, and that is not at span `pi`).
///
/// With the feature `serde` it is stored as the surface and the bounds, and the net is made again.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "PatchData", into = "PatchData")
)]
pub struct CyclidePatch {
    surface: Dupin,
    first: [f64; 2],
    second: [f64; 2],
    net: Biquadratic<DVec3>,
}

/// The control coefficients of the three basis functions of one parameter: `(1, cos, sin)` or `(1, u, u²)` on one span.
pub(crate) type Row = [f64; 3];

impl Dupin {
    /// The patch between two values of each parameter.
    ///
    /// On a quartic the spans may have either direction and any length below `2 pi`. On a parabolic cyclide one bound of a span may
    /// be infinite: the control points there are on the straight line of the surface, or vectors.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::Span`].
    pub fn patch(&self, first: [f64; 2], second: [f64; 2]) -> Result<CyclidePatch, Error> {
        let control = match self {
            Self::Quartic(surface) => surface.controls(arc_rows(first)?, arc_rows(second)?),
            Self::Parabolic(surface) => surface.controls(line_rows(first)?, line_rows(second)?),
        };
        let frame = self.frame();
        let control = control.map(|row| {
            row.map(|local| {
                local
                    .map_linear(|weighted| frame.vector_to_world(weighted))
                    .translated(frame.origin())
            })
        });
        Ok(CyclidePatch {
            surface: *self,
            first,
            second,
            net: Biquadratic::new(control)?,
        })
    }

    /// Patches that cover a rectangle and have ordinary weights, all at least `margin` times the largest (`margin` is clamped to
    /// at most 0.5): spans are halved until it holds. [`crate::tolerance::POSITIVE_WEIGHT`] suits most software. Spans up to a
    /// full turn are allowed here, and an infinite bound for one parameter of a parabolic cyclide.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::Span`], also for a rectangle with a corner at infinity, whose weight is zero.
    pub fn positive_patches(
        &self,
        first: [f64; 2],
        second: [f64; 2],
        margin: f64,
    ) -> Result<Vec<CyclidePatch>, Error> {
        let margin = finite("margin", margin)?.clamp(f64::MIN_POSITIVE, 0.5);
        let turning = self.as_quartic().is_some();
        let longest = if turning {
            TAU * (1.0 + f64::EPSILON)
        } else {
            f64::INFINITY
        };
        for [from, to] in [first, second] {
            let short_enough = (to - from).abs() <= longest;
            if from == to || !short_enough {
                return Err(Error::Span { from, to });
            }
        }
        if let (Some(&from), Some(&to)) = (
            first.iter().find(|bound| bound.is_infinite()),
            second.iter().find(|bound| bound.is_infinite()),
        ) {
            return Err(Error::Span { from, to });
        }
        // The line u = tan(angle) is halved by its angle, so that infinity is an ordinary bound.
        let angle = |bound: f64| if turning { bound } else { bound.atan() };
        let length = |[from, to]: [f64; 2]| (angle(to) - angle(from)).abs();
        let middle = |[from, to]: [f64; 2]| {
            let angle = 0.5 * (angle(from) + angle(to));
            if turning { angle } else { angle.tan() }
        };
        let mut found = Vec::new();
        let mut waiting = vec![(first, second)];
        while let Some((first, second)) = waiting.pop() {
            // A span of a full turn is not one patch.
            let too_long = turning && length(first).max(length(second)) > 1.5 * PI;
            let patch = if too_long {
                None
            } else {
                Some(self.patch(first, second)?).filter(|patch| patch.has_weights_above(margin))
            };
            match patch {
                Some(patch) => found.push(patch),
                // The weights of a patch tend to one another as its spans shrink, so this ends.
                None if length(first) >= length(second) => {
                    let middle = middle(first);
                    waiting.extend([([middle, first[1]], second), ([first[0], middle], second)]);
                }
                None => {
                    let middle = middle(second);
                    waiting.extend([(first, [middle, second[1]]), (first, [second[0], middle])]);
                }
            }
        }
        Ok(found)
    }

    /// Patches that cover the whole surface: three by three thirds of a turn on a quartic; on a parabolic cyclide the three spans
    /// between minus infinity, -1, 1 and infinity of each parameter, those at infinity with vectors as controls.
    ///
    /// # Errors
    ///
    /// Only if a control point overflows: [`Error::Mass`].
    pub fn atlas(&self) -> Result<Vec<CyclidePatch>, Error> {
        let bounds = match self {
            Self::Quartic(_) => [0.0, TAU / 3.0, 2.0 * TAU / 3.0, TAU],
            Self::Parabolic(_) => [f64::NEG_INFINITY, -1.0, 1.0, f64::INFINITY],
        };
        let spans = [
            [bounds[0], bounds[1]],
            [bounds[1], bounds[2]],
            [bounds[2], bounds[3]],
        ];
        spans
            .iter()
            .flat_map(|&first| spans.iter().map(move |&second| self.patch(first, second)))
            .collect()
    }
}

/// Controls of `(1, cos t, sin t)` over a span: the standard arc with end weights 1 and middle weight `cos(span/2)`.
pub(crate) fn arc_rows([from, to]: [f64; 2]) -> Result<[Row; 3], Error> {
    finite("patch bound", from)?;
    finite("patch bound", to)?;
    let half = 0.5 * (to - from);
    if !(half != 0.0 && half.abs() < PI) {
        return Err(Error::Span { from, to });
    }
    let ((sin_from, cos_from), (sin_to, cos_to)) = (from.sin_cos(), to.sin_cos());
    let (sin_middle, cos_middle) = (0.5 * (from + to)).sin_cos();
    Ok([
        [1.0, cos_from, sin_from],
        [half.cos(), cos_middle, sin_middle],
        [1.0, cos_to, sin_to],
    ])
}

/// Controls of `(1, u, u²)` over a span, by blossoming in homogeneous parameters.
pub(crate) fn line_rows([from, to]: [f64; 2]) -> Result<[Row; 3], Error> {
    let homogeneous = |bound: f64| match bound {
        f64::INFINITY => (0.0, 1.0),
        f64::NEG_INFINITY => (0.0, -1.0),
        bound => (1.0, bound),
    };
    if from.is_nan() || to.is_nan() || from == to || (from.is_infinite() && to.is_infinite()) {
        return Err(Error::Span { from, to });
    }
    let ((s, u), (t, v)) = (homogeneous(from), homogeneous(to));
    Ok([
        [s * s, s * u, u * u],
        [s * t, 0.5 * (s * v + t * u), u * v],
        [t * t, t * v, v * v],
    ])
}

fn tensor(
    rows: [Row; 3],
    columns: [Row; 3],
    control: impl Fn(Row, Row) -> MassPoint<DVec3>,
) -> [[MassPoint<DVec3>; 3]; 3] {
    rows.map(|row| columns.map(|column| control(row, column)))
}

impl Quartic {
    /// Local controls; exact because the parametrisation is a bilinear combination of `(1, cos, sin)` in both angles.
    fn controls(&self, rows: [Row; 3], columns: [Row; 3]) -> [[MassPoint<DVec3>; 3]; 3] {
        let mu = self.mu();
        // The double sphere has a = b = c = 0 and only their ratios count.
        let (a, b, c) = if self.a() > 0.0 {
            (self.a(), self.b(), self.c())
        } else {
            (1.0, self.minor_ratio(), self.eccentricity())
        };
        tensor(
            rows,
            columns,
            |[one, cos, sin], [other_one, other_cos, other_sin]| {
                let (ones, cosines) = (one * other_one, cos * other_cos);
                MassPoint::from_homogeneous(
                    a * ones - c * cosines,
                    DVec3::new(
                        mu * (c * ones - a * cosines) + self.b() * self.b() * cos * other_one,
                        b * sin * (self.a() * other_one - mu * other_cos),
                        b * other_sin * (self.c() * cos - mu * one),
                    ),
                )
            },
        )
    }
}

impl Parabolic {
    fn controls(&self, rows: [Row; 3], columns: [Row; 3]) -> [[MassPoint<DVec3>; 3]; 3] {
        let (f, k) = (self.f(), self.k());
        tensor(rows, columns, |[one, u, uu], [other_one, v, vv]| {
            let (ones, first, second) = (one * other_one, uu * other_one, one * vv);
            MassPoint::from_homogeneous(
                ones + first + second,
                DVec3::new(
                    f * (first - second) + k * (ones - first - second),
                    2.0 * u * (f * vv + (f / 2.0 - k) * other_one),
                    2.0 * v * (f * uu + (f / 2.0 + k) * one),
                ),
            )
        })
    }
}

impl CyclidePatch {
    /// The whole surface of which this is a part.
    #[must_use]
    pub const fn surface(&self) -> &Dupin {
        &self.surface
    }

    /// Bounds of the first parameter (`theta` or `u`), at rows 0 and 2.
    #[must_use]
    pub const fn first(&self) -> [f64; 2] {
        self.first
    }

    /// Bounds of the second parameter (`psi` or `v`), at columns 0 and 2.
    #[must_use]
    pub const fn second(&self) -> [f64; 2] {
        self.second
    }

    /// The control net, with the weights that the formulas give.
    #[must_use]
    pub const fn net(&self) -> &Biquadratic<DVec3> {
        &self.net
    }

    /// The net reparametrised to corner weights `w00 = w02 = w20 = 1`.
    ///
    /// # Errors
    ///
    /// [`Error::CornerWeights`] where a corner is a vector (a parabolic patch at infinity).
    pub fn normalised_net(&self) -> Result<Biquadratic<DVec3>, Error> {
        normalise(&self.net)
    }

    /// Whether all nine weights have one sign and are at least `margin` times the largest.
    #[must_use]
    pub fn has_weights_above(&self, margin: f64) -> bool {
        let weights = self
            .net
            .control()
            .as_flattened()
            .iter()
            .map(|control| control.weight);
        let largest = weights.clone().fold(0.0, |largest: f64, weight| {
            if weight.abs() > largest.abs() {
                weight
            } else {
                largest
            }
        });
        weights.into_iter().all(|weight| weight / largest >= margin)
    }
}

/// Scales the rows and columns of a net, which is a homographic change of its parameters, so that `w00 = w02 = w20 = 1`. Two nets
/// describe one patch with the same directions exactly if their normalised nets agree.
///
/// # Errors
///
/// [`Error::CornerWeights`] unless the corner weights have one sign.
pub fn normalise(net: &Biquadratic<DVec3>) -> Result<Biquadratic<DVec3>, Error> {
    let control = net.control();
    let weights = [
        control[0][0].weight,
        control[0][2].weight,
        control[2][0].weight,
        control[2][2].weight,
    ];
    let [corner, along_row, along_column, _] = weights;
    if !(weights.iter().all(|&weight| weight > 0.0) || weights.iter().all(|&weight| weight < 0.0)) {
        return Err(Error::CornerWeights { weights });
    }
    let (row_ratio, column_ratio) = ((corner / along_column).sqrt(), (corner / along_row).sqrt());
    let row_factors = [1.0, row_ratio, row_ratio * row_ratio];
    let column_factors = [1.0, column_ratio, column_ratio * column_ratio];
    let scaled = [0, 1, 2]
        .map(|i| [0, 1, 2].map(|j| control[i][j] * (row_factors[i] * column_factors[j] / corner)));
    Ok(Biquadratic::new(scaled)?)
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct PatchData {
    surface: Dupin,
    first: [f64; 2],
    second: [f64; 2],
}

#[cfg(feature = "serde")]
impl TryFrom<PatchData> for CyclidePatch {
    type Error = Error;

    fn try_from(data: PatchData) -> Result<Self, Error> {
        data.surface.patch(data.first, data.second)
    }
}

#[cfg(feature = "serde")]
impl From<CyclidePatch> for PatchData {
    fn from(patch: CyclidePatch) -> Self {
        let CyclidePatch {
            surface,
            first,
            second,
            ..
        } = patch;
        Self {
            surface,
            first,
            second,
        }
    }
}
