//! The types of the members of a family, from their shape: no member is built.

use super::{Conic, Family, Structure};
use crate::{Kind, tolerance};

/// A part of a family in which all members have one type.
///
/// The coordinate is `1/t` for families with a common sphere (so infinity on the diagonal, `1/t = 0`, is an ordinary place and the
/// common sphere is at both ends) and `s` for parallel axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TypeInterval {
    /// The type of all members inside.
    pub kind: Kind,
    /// Lower end, perhaps minus infinity.
    pub from: f64,
    /// Upper end, perhaps infinity.
    pub to: f64,
}

/// The shape of the members, freed from scale: every member of a family is a multiple of one ellipse or hyperbola, and its mean
/// radius depends linearly on `1/t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// `a / |t|`, or `a` for parallel axes. 1/2 for a cubic.
    pub(crate) outer: f64,
    /// `c / |t|`, or `c` for parallel axes. 0 for a cubic.
    pub(crate) inner: f64,
    /// Mean radius over `t` is `slope * (1/t) + offset`; mean radius is `slope * s + offset` for parallel axes.
    pub(crate) slope: f64,
    pub(crate) offset: f64,
}

impl Family {
    pub(crate) fn shape(&self) -> Shape {
        let [first, second] = &self.lines;
        let (tan, other_tan) = (first.tan(), second.tan());
        match self.structure {
            Structure::Meet {
                sphere,
                pairing,
                product,
            } => {
                let pairing = f64::from(pairing);
                if self.conic == Conic::Parabola {
                    let sum = tan + pairing * other_tan;
                    return Shape {
                        outer: 0.5,
                        inner: 0.0,
                        slope: sphere.radius * sum,
                        offset: pairing * tan * other_tan - 0.5,
                    };
                }
                let b = ((1.0 - pairing * product) / (1.0 + pairing * product))
                    .abs()
                    .sqrt();
                let tilt = (tan * tan + other_tan * other_tan - 2.0 * product * tan * other_tan)
                    / (1.0 - product * product);
                let offset = (tan + pairing * other_tan) / (1.0 + pairing * product);
                Shape {
                    slope: sphere.radius,
                    offset,
                    ..self.half_axes(b, tilt)
                }
            }
            Structure::Parallel { step, square } => {
                let b = square.abs().sqrt() / 2.0;
                // The radius-free direction in the plane of the lines, orthogonal to it the direction of the axis x.
                let tilt = tan * tan + step.radius * step.radius / square;
                Shape {
                    slope: first.sin,
                    offset: first.radius + step.radius / 2.0,
                    ..self.half_axes(b, tilt)
                }
            }
        }
    }

    /// Half axes of the conic from `b` and from the square of the time-like coordinate of the unit vector along its axis.
    fn half_axes(&self, b: f64, tilt: f64) -> Shape {
        let (outer, inner) = if self.conic == Conic::Ellipse {
            let inner = b * tilt.max(0.0).sqrt();
            (inner.hypot(b), inner)
        } else {
            let outer = b * (-tilt).max(1.0).sqrt();
            (outer, ((outer - b) * (outer + b)).sqrt())
        };
        let inner = if self.one_axis { 0.0 } else { inner };
        Shape {
            outer,
            inner,
            slope: 0.0,
            offset: 0.0,
        }
    }

    /// The type of the member at a parameter, from its place between the boundaries; the member is not built.
    #[must_use]
    pub fn kind_at(&self, parameter: f64) -> Kind {
        let coordinate = match self.structure {
            Structure::Meet { .. } => 1.0 / parameter,
            Structure::Parallel { .. } => parameter,
        };
        let shape = self.shape();
        self.kind_of(&shape, shape.slope * coordinate + shape.offset)
    }

    fn kind_of(&self, shape: &Shape, mean_radius: f64) -> Kind {
        if self.conic == Conic::Parabola {
            Kind::of_parabolic(1.0, mean_radius, tolerance::RECOVERED_KIND)
        } else {
            Kind::of_quartic(
                shape.outer,
                shape.inner,
                mean_radius.abs(),
                tolerance::RECOVERED_KIND,
            )
        }
    }

    /// The parameters at which the type changes, with the value of `mu / t` (`mu` for parallel axes) that they belong to:
    /// `a`, `-a`, `c`, `-c`, each divided by `|t|`. `None` at infinity on the diagonal, or if the boundary is not in the family.
    #[must_use]
    pub fn boundaries(&self) -> [Option<f64>; 4] {
        let shape = self.shape();
        [shape.outer, -shape.outer, shape.inner, -shape.inner]
            .map(|mean_radius| self.parameter_of_mean(&shape, mean_radius))
    }

    /// The parameters in the middle of the two ring intervals, where the mean radius is half way between `a` and `c` (first) and minus that
    /// (second): there the narrowest part of tube and hole is widest in proportion. `None` where such a middle is at infinity or not in the
    /// family.
    #[must_use]
    pub fn ring_parameters(&self) -> [Option<f64>; 2] {
        let shape = self.shape();
        if self.conic == Conic::Parabola {
            return [self.parameter_of_mean(&shape, 0.0), None];
        }
        let middle = 0.5 * (shape.outer + shape.inner);
        [middle, -middle].map(|mean_radius| self.parameter_of_mean(&shape, mean_radius))
    }

    /// The parameter at which the scale-free mean radius has the given value.
    pub(crate) fn parameter_of_mean(&self, shape: &Shape, mean_radius: f64) -> Option<f64> {
        let difference = mean_radius - shape.offset;
        match self.structure {
            Structure::Meet { .. } => {
                let at_infinity =
                    difference.abs() <= tolerance::CLASS * shape.outer.max(shape.offset.abs());
                (!at_infinity && shape.slope != 0.0).then(|| shape.slope / difference)
            }
            Structure::Parallel { .. } => (shape.slope != 0.0).then(|| difference / shape.slope),
        }
    }

    /// The family cut into intervals of one type, in the order of their coordinate. Shene's five intervals of a diagonal, with the
    /// common sphere between the first and the last; fewer for tori and cubics, one where the type cannot change.
    #[must_use]
    pub fn intervals(&self) -> Vec<TypeInterval> {
        let shape = self.shape();
        if shape.slope == 0.0 {
            return vec![TypeInterval {
                kind: self.kind_of(&shape, shape.offset),
                from: f64::NEG_INFINITY,
                to: f64::INFINITY,
            }];
        }
        let bounds = [-shape.outer, -shape.inner, shape.inner, shape.outer];
        let mut ends: Vec<f64> = bounds
            .iter()
            .map(|bound| (bound - shape.offset) / shape.slope)
            .collect();
        if shape.inner == 0.0 {
            // Tori and cubics: the inner boundaries are none.
            ends = vec![ends[0], ends[3]];
        }
        ends.sort_by(f64::total_cmp);
        ends.insert(0, f64::NEG_INFINITY);
        ends.push(f64::INFINITY);
        ends.windows(2)
            .filter_map(|end| {
                let &[from, to] = end else { return None };
                let inside = match (from.is_finite(), to.is_finite()) {
                    (true, true) => 0.5 * (from + to),
                    (false, _) => to - (1.0 + to.abs()),
                    (_, false) => from + (1.0 + from.abs()),
                };
                Some(TypeInterval {
                    kind: self.kind_of(&shape, shape.slope * inside + shape.offset),
                    from,
                    to,
                })
            })
            .collect()
    }
}

impl TypeInterval {
    /// Whether the member with this coordinate (`1/t`, or `s` for parallel axes) is strictly inside.
    #[must_use]
    pub fn contains(&self, coordinate: f64) -> bool {
        self.from < coordinate && coordinate < self.to
    }
}
