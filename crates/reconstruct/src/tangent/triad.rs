//! The frame that gravity and the magnetic field fix, and how it depends on them.

use crate::spatial::outer;
use glam::{DMat3, DVec3};

/// The right-handed triad of two directions: the first, their normal, and the third.
pub(super) fn triad(a: DVec3, m: DVec3) -> DMat3 {
    let across = a.cross(m).normalize();
    DMat3::from_cols(a, across, a.cross(across))
}

/// The matrix of `v -> a x v`.
fn cross_matrix(a: DVec3) -> DMat3 {
    DMat3::from_cols(a.cross(DVec3::X), a.cross(DVec3::Y), a.cross(DVec3::Z))
}

/// The derivatives of the tangent by the two interpolated body fields.
pub(super) fn tangent_derivatives(world: DMat3, [gravity, magnetic]: [DVec3; 2]) -> [DMat3; 2] {
    let normalising = |v: DVec3| {
        let unit = v.normalize();
        (DMat3::IDENTITY - outer(unit, unit)) * (1.0 / v.length())
    };
    let (a, m) = (gravity.normalize(), magnetic.normalize());
    let cross = a.cross(m);
    let across = cross.normalize();
    [
        (normalising(gravity), DMat3::ZERO),
        (DMat3::ZERO, normalising(magnetic)),
    ]
    .map(|(da, dm)| {
        let d_across = normalising(cross) * (cross_matrix(a) * dm - cross_matrix(m) * da);
        let d_third = cross_matrix(a) * d_across - cross_matrix(across) * da;
        // The tangent is the sum of the world axes times the x components of the body axes.
        [
            (world.x_axis, da),
            (world.y_axis, d_across),
            (world.z_axis, d_third),
        ]
        .into_iter()
        .fold(DMat3::ZERO, |sum, (axis, d)| sum + outer(axis, d.row(0)))
    })
}
