//! The patches as a surface: control planes, points, tangents, joints.

use glam::{DVec2, DVec3, DVec4};

use super::{FrontPatches, planes};

impl FrontPatches {
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
