//! Tubes of constant radius around spatial PH curves, as exact rational patches.

use std::f64::consts::FRAC_1_SQRT_2;

use bezier_mass::{BezierPatch, MassPoint, bernstein};
use glam::{DVec2, DVec3};

use super::{Quaternion, RationalFrameQuintic, SpatialPh};
use crate::Error;
use crate::rosette::keeps_positive;

/// The tube of this radius around a PH curve as four rational patches: `u` along the curve, `v` a quarter of the circle.
/// The lines `v = const` follow the Euler-Rodrigues frame. For a quintic the bidegree is (9, 2).
///
/// # Errors
///
/// [`Error::NonFinite`]; [`Error::TubeTooThick`] unless the radius is positive and proved to be smaller than every radius
/// of curvature of the curve, so that the surface is regular.
pub fn euler_rodrigues_tube(
    curve: &SpatialPh,
    radius: f64,
) -> Result<[BezierPatch<DVec3>; 4], Error> {
    tube(curve, radius, curve.preimage())
}

/// The same tube with the lines `v = const` along the rotation-minimising frame: both families of parameter lines are
/// lines of curvature. The bidegree is (13, 2).
///
/// # Errors
///
/// As for [`euler_rodrigues_tube`].
pub fn rotation_minimising_tube(
    quintic: &RationalFrameQuintic,
    radius: f64,
) -> Result<[BezierPatch<DVec3>; 4], Error> {
    tube(quintic.curve(), radius, &quintic.frame_preimage())
}

/// The tube `r + radius (cos f2 + sin f3)` with the frame `(B j B*, B k B*) / |B|²`.
fn tube(
    curve: &SpatialPh,
    radius: f64,
    frame: &[Quaternion],
) -> Result<[BezierPatch<DVec3>; 4], Error> {
    if !radius.is_finite() {
        return Err(Error::NonFinite {
            what: "radius of a tube",
        });
    }
    if radius <= 0.0 || !is_regular(curve, radius) {
        return Err(Error::TubeTooThick {
            radius,
            least_radius: least_radius_of_curvature(curve),
        });
    }
    let image =
        |axis: DVec3| bernstein::product_with(frame, frame, |a, b| a.polar_image_of(axis, *b));
    let weight = bernstein::product_with(frame, frame, |a, b| a.dot(*b));
    let spine = bernstein::product(&weight, curve.control_points());
    let degree = spine.len() - 1;
    let (second, third) = (image(DVec3::Y), image(DVec3::Z));
    let raised = |vectors: &[DVec3]| bernstein::elevate_to(vectors, degree);
    let (weight, second, third) = (
        bernstein::elevate_to(&weight, degree),
        raised(&second),
        raised(&third),
    );
    // Control points of a quarter circle, times their weights, and the weights.
    let quarter = [
        (DVec2::X, 1.0),
        (FRAC_1_SQRT_2 * DVec2::ONE, FRAC_1_SQRT_2),
        (DVec2::Y, 1.0),
    ];
    let patch = |turn: DVec2| {
        let row = |i: usize| {
            quarter.map(|(point, share)| {
                let around = turn.rotate(point);
                let offset = radius * (around.x * second[i] + around.y * third[i]);
                MassPoint::from_homogeneous(share * weight[i], share * spine[i] + offset)
            })
        };
        BezierPatch::from_rows(&(0..=degree).map(row).collect::<Vec<_>>())
    };
    Ok([
        patch(DVec2::X)?,
        patch(DVec2::Y)?,
        patch(DVec2::NEG_X)?,
        patch(DVec2::NEG_Y)?,
    ])
}

/// Whether `radius κ < 1` throughout: with `κ = 2 |(A* A')_jk| / |A|⁴`, whether the polynomial
/// `|A|⁸ - 4 radius² |(A* A')_jk|²` is positive.
fn is_regular(curve: &SpatialPh, radius: f64) -> bool {
    let preimage = curve.preimage();
    let speed = curve.arc_length().speed_coefficients();
    let square = bernstein::product(speed, speed);
    let fourth = bernstein::product(&square, &square);
    let bend = bernstein::product_with(preimage, &bernstein::derivative(preimage), |a, b| {
        a.transversal_product(*b)
    });
    let bend = bernstein::product_with(&bend, &bend, |a: &DVec2, b| a.dot(*b));
    let bend = bernstein::elevate_to(&bend, fourth.len() - 1);
    let margin: Vec<f64> = if bend.is_empty() {
        fourth
    } else {
        fourth
            .iter()
            .zip(&bend)
            .map(|(speed, bend)| speed - 4.0 * radius * radius * bend)
            .collect()
    };
    keeps_positive(&margin, 0)
}

/// The smallest radius of curvature on a fine grid, for the message of a refusal.
fn least_radius_of_curvature(curve: &SpatialPh) -> f64 {
    let radii = (0..=1000).map(|i| 1.0 / curve.curvature(f64::from(i) / 1000.0));
    radii.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpatialHermite;

    #[test]
    fn every_point_of_a_tube_has_its_distance_from_the_curve() {
        let (first, last) = (
            Quaternion::new(1.0, 0.2, -0.3, 0.1),
            Quaternion::new(0.7, 0.5, 0.4, -0.2),
        );
        let quintic =
            RationalFrameQuintic::from_ends(DVec3::new(1.0, 2.0, 3.0), first, last, 0.3).unwrap();
        let curve = quintic.curve();
        let tubes = [
            euler_rodrigues_tube(curve, 0.05).unwrap(),
            rotation_minimising_tube(&quintic, 0.05).unwrap(),
        ];
        for (patches, degree) in tubes.iter().zip([9, 13]) {
            for patch in patches {
                assert_eq!(patch.degrees(), [degree, 2]);
                for i in 0..100 {
                    let (u, v) = (f64::from(i % 10) / 9.0, f64::from(i / 10) / 9.0);
                    let spoke = patch.point(u, v).unwrap() - curve.point(u);
                    assert!((spoke.length() - 0.05).abs() < 1e-13);
                    assert!(spoke.dot(curve.velocity(u)).abs() < 1e-13);
                }
            }
        }
        // The lines v = 0 of the second tube follow the rotation-minimising frame: no turning about the tangent.
        let seam = tubes[1][0].point(0.7, 0.0).unwrap() - curve.point(0.7);
        assert!((seam / 0.05 - quintic.frame(0.7).unwrap().second).length() < 1e-12);
    }

    #[test]
    fn a_tube_thicker_than_its_bends_is_refused() {
        let data = SpatialHermite {
            start: DVec3::ZERO,
            start_derivative: DVec3::X,
            end: DVec3::Y,
            end_derivative: DVec3::NEG_X,
        };
        let curve = data.least_bending().unwrap();
        let Err(Error::TubeTooThick { least_radius, .. }) = euler_rodrigues_tube(&curve, 10.0)
        else {
            panic!("a tube of radius 10 around a bend of size 1");
        };
        assert!(euler_rodrigues_tube(&curve, 0.99 * least_radius).is_ok());
        assert!(euler_rodrigues_tube(&curve, 1.01 * least_radius).is_err());
        assert!(
            euler_rodrigues_tube(&curve, -1.0).is_err()
                && euler_rodrigues_tube(&curve, f64::NAN).is_err()
        );
        let straight =
            SpatialPh::try_new(DVec3::ZERO, [Quaternion::new(1.0, 0.0, 0.0, 0.0)]).unwrap();
        assert!(euler_rodrigues_tube(&straight, 5.0).is_ok());
    }
}
