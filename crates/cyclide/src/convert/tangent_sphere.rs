//! Spheres that touch a net along its iso-curves.

use super::POLE;
use crate::tolerance;
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;
use lorentz::Cycle;

/// A sphere or plane that touches the patch along an iso-curve: weight, weighted centre and weighted radius.
#[derive(Clone, Copy)]
pub(super) struct HomogeneousSphere {
    weight: f64,
    centre: DVec3,
    radius: f64,
}

impl HomogeneousSphere {
    /// From one point of the iso-curve with its normal, and the chord to another.
    /// `None` where the iso-curve has shrunk to a point or has no normal.
    pub(super) fn along(net: &Biquadratic<DVec3>, u: f64, flipped: bool) -> Option<Self> {
        // The next start is tried where the patch has no normal, at a singular corner.
        for start in [0.0, 0.5, 1.0] {
            let jet = net.jet(u, start);
            let Some(point) = jet.value.position() else {
                continue;
            };
            let along = |partial: MassPoint<DVec3>| {
                (partial.weighted - partial.weight * point) / jet.value.weight
            };
            let (along_u, along_v) = (along(jet.du), along(jet.dv));
            let cross = if flipped {
                along_v.cross(along_u)
            } else {
                along_u.cross(along_v)
            };
            let lengths = [along_u.length(), along_v.length()];
            if lengths[0].min(lengths[1]) <= POLE
                || cross.length() <= tolerance::TANGENT_SPHERES * lengths[0] * lengths[1]
            {
                continue;
            }
            let Some(normal) = cross.try_normalize() else {
                continue;
            };
            let chord = [0.0, 0.5, 1.0]
                .into_iter()
                .filter_map(|v| net.point(u, v).ok())
                .map(|other| other - point)
                .max_by(|one, other| one.length_squared().total_cmp(&other.length_squared()))
                .unwrap_or_default();
            let square = chord.length_squared();
            // The net has size one.
            if square <= POLE * POLE {
                return None;
            }
            let weight = normal.dot(chord);
            return Some(Self {
                weight,
                centre: weight * point + 0.5 * square * normal,
                radius: -0.5 * square,
            });
        }
        None
    }

    pub(super) fn is_plane(&self) -> bool {
        // The weight is the sine of the angle between chord and tangent plane, times the chord.
        self.weight.abs() <= tolerance::TANGENT_SPHERES * (2.0 * self.radius.abs()).sqrt()
    }

    pub(super) fn cycle(&self) -> Cycle {
        Cycle::new(self.centre / self.weight, self.radius / self.weight)
    }
}
