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

use std::collections::VecDeque;

use glam::{DMat3, DVec2, DVec3, DVec4};

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

/// A reflected ray with its derivatives along two tangents of the incoming normal.
struct Tube {
    point: DVec3,
    normal: DVec3,
    tangents: [DVec3; 2],
    point_changes: [DVec3; 2],
    normal_changes: [DVec3; 2],
}

/// Patches along each side to begin with.
const FIRST_COLUMNS: usize = 8;
/// Where patches are compared with rays, as shares of their sides.
const INSIDE: [DVec2; 3] = [
    DVec2::new(0.5, 0.5),
    DVec2::new(0.2, 0.7),
    DVec2::new(0.8, 0.3),
];
/// Newton's method for the incoming normal doubles its digits; from a neighbour it needs four steps.
const STEPS: usize = 24;
/// It has arrived when the outgoing normal is as close as this.
const ARRIVED: f64 = 1e-13;
/// The normals fold where their map's determinant falls below this share of the middle ray's.
const FOLD: f64 = 1e-3;

impl Tube {
    /// The reflection of the ray with an incoming normal, set back behind the mirror by the way to it.
    fn new(surface: &DualSurface, mirror: &Mirror, incoming: DVec3) -> Option<Self> {
        let across = incoming.any_orthonormal_vector();
        let tangents = [across, incoming.cross(across)];
        let start = super::SpacePoint {
            point: surface.point(incoming),
            normal: incoming,
        };
        let (way, facing) = mirror.hit(start)?;
        let hit = start.point + way * incoming;
        let inverse = mirror.gradient(hit).length().recip();
        let across = incoming.dot(facing);
        let normal = incoming - 2.0 * across * facing;
        let changes = tangents.map(|turn| {
            let drift = surface.point_change(incoming, turn) + way * turn;
            let delay = -facing.dot(drift) / across;
            let place = drift + delay * incoming;
            let bend = mirror.gradient_change(place) * inverse;
            let bend = bend - bend.dot(facing) * facing;
            let change = turn.dot(facing) + incoming.dot(bend);
            let normal_change = turn - 2.0 * (change * facing + across * bend);
            (place - delay * normal - way * normal_change, normal_change)
        });
        let tube = Self {
            point: hit - way * normal,
            normal,
            tangents,
            point_changes: changes.map(|(point, _)| point),
            normal_changes: changes.map(|(_, normal)| normal),
        };
        (tube.point.is_finite() && tube.normal.is_finite()).then_some(tube)
    }

    /// How the sphere of incoming normals is mapped to that of the outgoing ones: the factor of small areas, with its sign.
    fn determinant(&self) -> f64 {
        let [one, two] = self.normal_changes;
        one.cross(two).dot(self.normal)
    }

    /// The change of the incoming normal, as shares of the two tangents, that changes the outgoing one by a tangent vector.
    fn shares(&self, change: DVec3) -> DVec2 {
        let [one, two] = self.normal_changes;
        DVec2::new(
            change.cross(two).dot(self.normal),
            one.cross(change).dot(self.normal),
        ) / self.determinant()
    }
}

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

    /// Finds the incoming normal for each node, from the middle outwards.
    fn trace(&mut self, surface: &DualSurface, mirror: &Mirror, aim: DVec3, determinant: f64) {
        let middle = self.columns / 2;
        let mut waiting = VecDeque::from([([middle, middle], aim)]);
        while let Some(([column, row], start)) = waiting.pop_front() {
            let index = row * (self.columns + 1) + column;
            if self.nodes[index].is_some() {
                continue;
            }
            let place = self.place([column as f64, row as f64]);
            let Some((incoming, tube)) = self.incoming(surface, mirror, place, start, determinant)
            else {
                continue;
            };
            self.nodes[index] = Some(Node {
                data: self.data(place, &tube),
                incoming,
            });
            let steps = [[1, 0], [0, 1], [-1, 0], [0, -1]];
            for [right, up] in steps {
                let next = (column.checked_add_signed(right), row.checked_add_signed(up));
                if let (Some(column), Some(row)) = next
                    && column <= self.columns
                    && row <= self.columns
                {
                    waiting.push_back(([column, row], incoming));
                }
            }
        }
    }

    /// The incoming normal whose ray is reflected to the normal at a place, by Newton's method.
    fn incoming(
        &self,
        surface: &DualSurface,
        mirror: &Mirror,
        place: DVec2,
        start: DVec3,
        determinant: f64,
    ) -> Option<(DVec3, Tube)> {
        let wanted = self.normal(place);
        let mut incoming = start;
        for _ in 0..STEPS {
            let tube = Tube::new(surface, mirror, incoming)?;
            if tube.determinant() / determinant < FOLD {
                return None;
            }
            let missing = wanted - tube.normal;
            if missing.length() <= ARRIVED {
                return Some((incoming, tube));
            }
            let shares = tube.shares(missing);
            // Far from the solution a step must not leave the sphere's neighbourhood.
            let shares = shares.clamp_length_max(0.5);
            incoming =
                (incoming + shares.x * tube.tangents[0] + shares.y * tube.tangents[1]).normalize();
        }
        None
    }

    /// f and its derivatives at a place, from the ray that has its normal.
    fn data(&self, place: DVec2, tube: &Tube) -> [f64; 4] {
        let [n, by_u, by_v] = planes(place);
        let point = self.frame * tube.point;
        // The normal turns by the part of n_v / |n| across it, and the point of the ray changes with it.
        let normal = n / (1.0 + place.length_squared());
        let turn = (by_v - by_v.dot(normal) * normal) / (1.0 + place.length_squared());
        let shares = tube.shares(self.frame.transpose() * turn);
        let change = shares.x * tube.point_changes[0] + shares.y * tube.point_changes[1];
        [
            n.dot(point),
            by_u.dot(point),
            by_v.dot(point),
            by_u.dot(self.frame * change),
        ]
    }

    /// The largest distance of each patch from rays inside it; none for a patch without rays at its corners.
    fn errors(&self, surface: &DualSurface, mirror: &Mirror, determinant: f64) -> Vec<Option<f64>> {
        let error = |index: usize| {
            let cell = [index % self.columns, index / self.columns];
            let start = self.corners(cell)?[0].incoming;
            let away = INSIDE.map(|share| {
                let place = self.coordinates(cell, share);
                let ray = self.incoming(surface, mirror, place, start, determinant);
                match (ray, self.point(cell, share)) {
                    (Some((_, tube)), Some(point)) => point.distance(tube.point),
                    _ => f64::INFINITY,
                }
            });
            Some(away.into_iter().fold(0.0, f64::max))
        };
        (0..self.kept.len()).map(error).collect()
    }

    /// Leaves out what has no rays or misses the tolerance.
    fn keep(&mut self, errors: &[Option<f64>], tolerance: f64) {
        for (index, error) in errors.iter().enumerate() {
            match *error {
                Some(error) if error <= tolerance => self.error = self.error.max(error),
                other => {
                    self.kept[index] = false;
                    self.omissions.push(Omission {
                        cell: [index % self.columns, index / self.columns],
                        excess: other.map(|error| error / tolerance),
                    });
                }
            }
        }
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

    /// The control planes `(n, f)` of a patch, `<n, X> = f` in the coordinates of space, for `B_i(s) B_j(t)` at `[j][i]`; none
    /// for a patch that is left out.
    #[must_use]
    pub fn control_planes(&self, cell: [usize; 2]) -> Option<[[DVec4; 4]; 4]> {
        let control = self.control(cell)?;
        let to_space = self.frame.transpose();
        Some(control.map(|row| row.map(|plane| (to_space * plane.truncate()).extend(plane.w))))
    }

    /// The same in the frame. A polynomial of the second degree is its own Hermite interpolant: n is exact.
    fn control(&self, cell: [usize; 2]) -> Option<[[DVec4; 4]; 4]> {
        let nodes = self.corners(cell)?;
        let third = self.step() / 3.0;
        let mut control = [[DVec4::ZERO; 4]; 4];
        for (corner, node) in nodes.iter().enumerate() {
            let (right, up) = (corner % 2, corner / 2);
            let place = self.place([(cell[0] + right) as f64, (cell[1] + up) as f64]);
            let [n, by_u, by_v] = planes(place);
            let [f, f_u, f_v, f_uv] = node.data;
            let run = self.distance;
            let value = n.extend(f + run * (1.0 + place.length_squared()));
            let u = third * by_u.extend(f_u + 2.0 * run * place.x);
            let v = third * by_v.extend(f_v + 2.0 * run * place.y);
            let both = third * third * DVec3::ZERO.extend(f_uv);
            let (i, inner_i, left) = if right == 0 {
                (0, 1, 1.0)
            } else {
                (3, 2, -1.0)
            };
            let (j, inner_j, down) = if up == 0 { (0, 1, 1.0) } else { (3, 2, -1.0) };
            control[j][i] = value;
            control[j][inner_i] = value + left * u;
            control[inner_j][i] = value + down * v;
            control[inner_j][inner_i] = value + left * u + down * v + left * down * both;
        }
        Some(control)
    }

    /// The point of a patch at shares of its sides; none for a patch that is left out.
    #[must_use]
    pub fn point(&self, cell: [usize; 2], share: DVec2) -> Option<DVec3> {
        Some(self.tangents(cell, share)?.0)
    }

    /// The point of a patch at shares of its sides, with its derivatives by u and v.
    #[must_use]
    pub fn tangents(&self, cell: [usize; 2], share: DVec2) -> Option<(DVec3, [DVec3; 2])> {
        let control = self.control(cell)?;
        let (s, t) = (basis(share.x), basis(share.y));
        let step = self.step();
        let sum = |order_u: usize, order_v: usize| {
            let rows = control.iter().zip(t[order_v]);
            let value: f64 = rows
                .map(|(row, b)| {
                    let along = row.iter().zip(s[order_u]);
                    b * along.map(|(plane, a)| a * plane.w).sum::<f64>()
                })
                .sum();
            value / step.powi((order_u + order_v) as i32)
        };
        let place = self.place([cell[0] as f64 + share.x, cell[1] as f64 + share.y]);
        let (u, v, length) = (place.x, place.y, 1.0 + place.length_squared());
        let (f, f_u, f_v) = (sum(0, 0), sum(1, 0), sum(0, 1));
        let (f_uu, f_uv, f_vv) = (sum(2, 0), sum(1, 1), sum(0, 2));
        let z = (f - u * f_u - v * f_v) / length;
        let z_u = -(u * f_uu + v * f_uv + 2.0 * u * z) / length;
        let z_v = -(u * f_uv + v * f_vv + 2.0 * v * z) / length;
        let to_space = self.frame.transpose();
        Some((
            to_space * DVec3::new(0.5 * f_u + u * z, 0.5 * f_v + v * z, z),
            [
                to_space * DVec3::new(0.5 * f_uu + z + u * z_u, 0.5 * f_uv + v * z_u, z_u),
                to_space * DVec3::new(0.5 * f_uv + u * z_v, 0.5 * f_vv + z + v * z_v, z_v),
            ],
        ))
    }

    /// The patch that has a unit normal, and the shares of its sides; none for a normal outside the square or one that is left
    /// out.
    #[must_use]
    pub fn cell_of(&self, normal: DVec3) -> Option<([usize; 2], DVec2)> {
        let image = self.frame * normal;
        let place = image.truncate() / (1.0 + image.z);
        let scaled = (place + self.half_width) / self.step();
        let whole = scaled
            .floor()
            .clamp(DVec2::ZERO, DVec2::splat(self.columns as f64 - 1.0));
        let (cell, share) = ([whole.x as usize, whole.y as usize], scaled - whole);
        let inside = share.cmpge(DVec2::ZERO).all() && share.cmple(DVec2::ONE).all();
        (inside && self.corners(cell).is_some()).then_some((cell, share))
    }

    /// The stereographic coordinates at shares of a patch's sides.
    #[must_use]
    pub fn coordinates(&self, cell: [usize; 2], share: DVec2) -> DVec2 {
        self.place([cell[0] as f64 + share.x, cell[1] as f64 + share.y])
    }

    /// The largest angle between the tangent planes of neighbouring patches along their common edges, from the derivatives on
    /// both sides, and the largest gap between them: the G1 contact, measured at `count` places an edge.
    #[must_use]
    pub fn joint_errors(&self, count: usize) -> (f64, f64) {
        let (mut angle, mut gap) = (0.0_f64, 0.0_f64);
        for [column, row] in self.cells() {
            for next in [[column + 1, row], [column, row + 1]] {
                for i in 0..count {
                    let along = (i as f64 + 0.5) / count as f64;
                    let (here, there) = if next[0] > column {
                        (DVec2::new(1.0, along), DVec2::new(0.0, along))
                    } else {
                        (DVec2::new(along, 1.0), DVec2::new(along, 0.0))
                    };
                    let (Some((p, [p_u, p_v])), Some((q, [q_u, q_v]))) = (
                        self.tangents([column, row], here),
                        self.tangents(next, there),
                    ) else {
                        continue;
                    };
                    let (n, m) = (p_u.cross(p_v), q_u.cross(q_v));
                    // Planes, not normals: behind a focus the surface is turned over.
                    angle = angle.max(n.cross(m).length().atan2(n.dot(m).abs()));
                    gap = gap.max(p.distance(q));
                }
            }
        }
        (angle, gap)
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

/// The cubic Bernstein polynomials with their first and second derivatives.
fn basis(t: f64) -> [[f64; 4]; 3] {
    let s = 1.0 - t;
    [
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
        [
            -3.0 * s * s,
            3.0 * s * (s - 2.0 * t),
            3.0 * t * (2.0 * s - t),
            3.0 * t * t,
        ],
        [6.0 * s, 6.0 * (t - 2.0 * s), 6.0 * (s - 2.0 * t), 6.0 * t],
    ]
}
