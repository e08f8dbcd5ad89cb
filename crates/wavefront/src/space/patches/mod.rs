//! Fronts in space as dual patches that join smoothly: the reflection of a front in a quadric, re-approximated.
//!
//! ```text
//!    plane of the patch:   <n(u, v), X> = f(u, v),   n = (2u, 2v, 1 - u² - v²),   |n| = 1 + u² + v²
//!    its point:            X = (f_u / 2 + u z,  f_v / 2 + v z,  z),   z = (f - u f_u - v f_v) / |n|
//! ```
//!
//! The planes are given over the outgoing normal, in stereographic coordinates around the one of the middle ray: the unit
//! normal `n / |n|` is rational, and an offset by d adds `d |n|` to f, a polynomial. An exact ray tells f and its derivatives
//! by u, by v and by both at its normal. The bicubic patches through these data (Bogner, Fox and Schmit) make f continuously
//! differentiable; so the points, which depend on the first derivatives, are continuous, and the normal is `n / |n|` on both
//! sides of every edge: the surface is G1, exactly, at all times.

mod rays;
mod surface;
mod tube;

use glam::{DMat3, DVec2, DVec3};

use self::tube::Tube;
use super::{DualSurface, Mirror};
use crate::Error;

/// How closely a front is interpolated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PatchOptions {
    /// The largest distance between points of the patches and rays with the same normals that were not interpolated.
    pub tolerance: f64,
    /// The patches' number along each side is doubled no more than up to this.
    pub most_columns: usize,
}

impl Default for PatchOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            most_columns: 128,
        }
    }
}

/// A reflected front at time zero as dual bicubic patches over a square of outgoing normals.
#[derive(Clone, Debug)]
pub struct FrontPatches {
    /// The rows are the axes of the stereographic coordinates; the third one is the middle normal.
    frame: DMat3,
    half_width: f64,
    columns: usize,
    nodes: Vec<Option<Node>>,
    /// The cells that have a patch, if all of their corners have a ray.
    kept: Vec<bool>,
    distance: f64,
    error: f64,
    omissions: Vec<Omission>,
}

/// A patch that is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Omission {
    /// Its column and row.
    pub cell: [usize; 2],
    /// Its error over the tolerance, next to a fold of the normals; none where no ray is reflected to a normal of its corners,
    /// or they have folded.
    pub excess: Option<f64>,
}

/// f and its derivatives by u, v and both, at a node.
#[derive(Clone, Copy, Debug)]
struct Node {
    data: [f64; 4],
    /// The incoming normal that is reflected to this one.
    incoming: DVec3,
}

/// Patches along each side to begin with.
const FIRST_COLUMNS: usize = 8;
impl FrontPatches {
    /// The front of a surface after reflection in a mirror, around the ray with the incoming normal `aim`: over the square of
    /// outgoing normals with `half_width` in stereographic coordinates (the tangent of half the angle from the middle).
    ///
    /// The number of patches is doubled until rays that were not interpolated agree, or up to the most. Patches that do not
    /// agree then, next to a fold of the normals, are left out, as are those with normals that no ray is reflected to.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`]; [`Error::OutOfRange`] for a half width or a tolerance that is not positive and finite;
    /// [`Error::Miss`] if the middle ray does not meet the mirror (with the x and y of its start); [`Error::NotConverged`]
    /// with the error over the tolerance if no patch meets it.
    pub fn reflected(
        surface: &DualSurface,
        mirror: &Mirror,
        aim: DVec3,
        half_width: f64,
        options: PatchOptions,
    ) -> Result<Self, Error> {
        for (what, value) in [
            ("the half width of a front", half_width),
            ("the tolerance of a front", options.tolerance),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::OutOfRange { what, value });
            }
        }
        let aim = aim.try_normalize().ok_or(Error::ZeroDirection {
            what: "the normal of the middle ray",
        })?;
        let middle = Tube::new(surface, mirror, aim).ok_or(Error::Miss {
            from: surface.point(aim).truncate(),
        })?;
        let across = middle.normal.any_orthonormal_vector();
        let axes = DMat3::from_cols(across, middle.normal.cross(across), middle.normal);
        let (mut columns, mut depth) = (FIRST_COLUMNS, 0);
        loop {
            let mut front = Self {
                frame: axes.transpose(),
                half_width,
                columns,
                nodes: vec![None; (columns + 1) * (columns + 1)],
                kept: vec![true; columns * columns],
                distance: 0.0,
                error: 0.0,
                omissions: Vec::new(),
            };
            front.trace(surface, mirror, aim, middle.determinant());
            let errors = front.errors(surface, mirror, middle.determinant());
            let worst = errors.iter().flatten().copied().fold(0.0, f64::max);
            if worst <= options.tolerance || 2 * columns > options.most_columns {
                front.keep(&errors, options.tolerance);
                if front.cells().next().is_some() {
                    return Ok(front);
                }
                return Err(Error::NotConverged {
                    start: -half_width,
                    end: half_width,
                    excess: worst / options.tolerance,
                    depth,
                });
            }
            (columns, depth) = (2 * columns, depth + 1);
        }
    }

    /// The unit normal at stereographic coordinates.
    #[must_use]
    pub fn normal(&self, place: DVec2) -> DVec3 {
        let [n, _, _] = planes(place);
        self.frame.transpose() * (n / (1.0 + place.length_squared()))
    }

    fn step(&self) -> f64 {
        2.0 * self.half_width / self.columns as f64
    }

    fn place(&self, [column, row]: [f64; 2]) -> DVec2 {
        DVec2::splat(-self.half_width) + self.step() * DVec2::new(column, row)
    }

    /// The nodes of a patch: lower left and right, upper left and right.
    fn corners(&self, [column, row]: [usize; 2]) -> Option<[Node; 4]> {
        if column >= self.columns || !*self.kept.get(row * self.columns + column)? {
            return None;
        }
        let node = |right: usize, up: usize| {
            *self
                .nodes
                .get((row + up) * (self.columns + 1) + column + right)?
        };
        let nodes = (node(0, 0), node(1, 0), node(0, 1), node(1, 1));
        let (Some(a), Some(b), Some(c), Some(d)) = nodes else {
            return None;
        };
        Some([a, b, c, d])
    }

    /// The patches along each side of the square.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The largest distance of the patches' points from rays that were not interpolated.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The patches that are left out.
    #[must_use]
    pub fn omissions(&self) -> &[Omission] {
        &self.omissions
    }

    /// The cells with patches, column and row.
    pub fn cells(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let cell = |index: usize| [index % self.columns, index / self.columns];
        (0..self.columns * self.columns)
            .map(cell)
            .filter(|cell| self.corners(*cell).is_some())
    }

    /// The incoming normal whose ray is reflected to the normal at a node, its column and row from 0 to [`Self::columns`]; none
    /// where no ray is.
    #[must_use]
    pub fn incoming_normal(&self, [column, row]: [usize; 2]) -> Option<DVec3> {
        if column > self.columns {
            return None;
        }
        let node = self.nodes.get(row * (self.columns + 1) + column)?;
        node.map(|node| node.incoming)
    }

    /// The front after running `distance`, through every caustic: f changes by the distance times `1 + u² + v²`.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        Self {
            distance: self.distance + distance,
            ..self.clone()
        }
    }
}

/// The normal `n` of the plane at stereographic coordinates in their frame, and its derivatives by u and v.
fn planes(place: DVec2) -> [DVec3; 3] {
    let DVec2 { x: u, y: v } = place;
    [
        DVec3::new(2.0 * u, 2.0 * v, 1.0 - u * u - v * v),
        DVec3::new(2.0, 0.0, -2.0 * u),
        DVec3::new(0.0, 2.0, -2.0 * v),
    ]
}
