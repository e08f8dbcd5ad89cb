//! The rays at the corners of the patches, and those inside with which they are compared.

use std::collections::VecDeque;

use glam::{DVec2, DVec3};

use super::tube::Tube;
use super::{FrontPatches, Node, Omission, planes};
use crate::space::{DualSurface, Mirror};

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

impl FrontPatches {
    /// Finds the incoming normal for each node, from the middle outwards.
    pub(super) fn trace(
        &mut self,
        surface: &DualSurface,
        mirror: &Mirror,
        aim: DVec3,
        determinant: f64,
    ) {
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
    pub(super) fn errors(
        &self,
        surface: &DualSurface,
        mirror: &Mirror,
        determinant: f64,
    ) -> Vec<Option<f64>> {
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
    pub(super) fn keep(&mut self, errors: &[Option<f64>], tolerance: f64) {
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
}
