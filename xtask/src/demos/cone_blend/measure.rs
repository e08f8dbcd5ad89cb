//! Random pairs of every construction, judged without the construction.

use std::collections::BTreeSet;

use anyhow::Result;
use cyclide::{Blend, Class, Cone, Dupin, Family, Kind, RingPreference, classify};
use lorentz::CyclideKind;

use super::pairs::{CONSTRUCTIONS, Random, pair};
use super::search;
use crate::demo::Context;
use crate::report::Target;

/// Pairs of each construction that can be blended: classes, families against the planar search, residuals, types, rings.
pub(super) fn measure(context: &mut Context) -> Result<()> {
    let count = context.pick(100, 12);
    let mut random = Random(context.seed());
    let mut classes = BTreeSet::new();
    let (mut pairs, mut mismatches, mut type_mismatches, mut found, mut absent, mut unexplained) =
        (0_u32, 0_u32, 0_u32, 0_u32, 0_u32, 0_u32);
    let (mut residual, mut angle) = (0.0_f64, 0.0_f64);
    for construction in CONSTRUCTIONS {
        for _ in 0..count {
            let (raw, scale) = pair(construction, &mut random);
            let cones = raw.map(|cone| cone.cone());
            let classification = classify(&cones[0], &cones[1]);
            classes.insert(
                classification
                    .class()
                    .to_string()
                    .split(": ")
                    .next()
                    .unwrap_or_default()
                    .to_owned()
                    + &classification
                        .obstacle()
                        .map_or(String::new(), |obstacle| format!(": {obstacle}")),
            );
            pairs += 1;
            mismatches += u32::from(!families_agree(&cones, &classification, scale, &mut random));
            for family in classification.families() {
                let t = parameter(family, scale, &mut random);
                let blend = family.blend(t)?;
                residual = residual.max(blend.residual());
                angle = angle.max(blend.sampled_error(12).1);
                type_mismatches += u32::from(!type_agrees(family, t, &blend)?);
                match family.ring_blend(RingPreference::Widest) {
                    Ok(ring) => {
                        found += 1;
                        residual = residual.max(ring.residual());
                    }
                    Err(_) => {
                        absent += 1;
                        unexplained += u32::from(
                            !matches!(classification.class(), Class::CommonVertex { .. })
                                && family.only_kind().is_none(),
                        );
                    }
                }
            }
        }
    }
    context.number("classes", classes.len(), Target::exactly(11));
    context.number("pairs", pairs, Target::exactly(15 * count));
    context.number("family_mismatches", mismatches, Target::exactly(0));
    context.number("g1_max_residual", residual, Target::AtMost(1e-9));
    context.number("g1_max_angle_rad", angle, Target::AtMost(1e-7));
    context.number("type_mismatches", type_mismatches, Target::exactly(0));
    context.number("ring_blends_found", found, Target::AtLeast(1.0));
    context.number("ring_blends_absent", absent, Target::Free);
    context.number(
        "ring_blends_absent_where_types_change",
        unexplained,
        Target::exactly(0),
    );
    Ok(())
}

/// A parameter of the order of the data and away from the ends of the types.
fn parameter(family: &Family, scale: f64, random: &mut Random) -> f64 {
    loop {
        let parameter = random.sign() * scale * random.between(0.2, 3.0);
        let coordinate = if family.pairing() == 0 {
            parameter
        } else {
            1.0 / parameter
        };
        let close = |end: &f64| (end - coordinate).abs() < 1e-3 * coordinate.abs();
        if !family
            .intervals()
            .iter()
            .any(|interval| close(&interval.from) || close(&interval.to))
        {
            return parameter;
        }
    }
}

/// Whether the planar search finds the members of all families, and no other, for one circle of the first cone.
fn families_agree(
    cones: &[Cone; 2],
    classification: &cyclide::Classification,
    scale: f64,
    random: &mut Random,
) -> bool {
    let Some(family) = classification.families().first() else {
        return true;
    };
    let height = scale * random.sign() * random.between(0.4, 2.5);
    let Ok(blends) = classification.blends_at_height(height) else {
        return false;
    };
    let mut expected: Vec<f64> = blends
        .iter()
        .map(|blend| (blend.contacts()[1].circle.centre - cones[1].point()).dot(cones[1].axis()))
        .collect();
    let mut found: Vec<f64> = search::search(
        [&cones[0], &cones[1]],
        family.axial_plane_normal(),
        height,
        scale,
    )
    .iter()
    .map(|found| found.height)
    .collect();
    expected.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    expected.len() == found.len()
        && expected
            .iter()
            .zip(&found)
            .all(|(one, other)| (one - other).abs() <= 1e-6 * (scale + one.abs()))
}

/// Whether the type that the interval of the family predicts is the one that the space of spheres gives for the built surface.
fn type_agrees(family: &Family, t: f64, blend: &Blend) -> Result<bool> {
    let coordinate = if family.pairing() == 0 { t } else { 1.0 / t };
    let predicted = family
        .intervals()
        .into_iter()
        .find(|interval| interval.contains(coordinate))
        .map(|interval| interval.kind);
    let frame = cyclide::Frame::WORLD;
    // The classification of a whole conic does not depend on its place and size, so it is taken where it keeps its digits.
    let canal = match blend.surface() {
        Dupin::Quartic(surface) => Dupin::quartic(
            1.0,
            surface.eccentricity(),
            surface.mu() / surface.a(),
            frame,
        )?
        .first_canal([0.2, 2.2])?,
        Dupin::Parabolic(surface) => {
            Dupin::parabolic(1.0, surface.k() / surface.f(), frame)?.first_canal([-0.7, 0.9])?
        }
    };
    let measured = match lorentz::Classification::of(*canal.control())?.kind {
        CyclideKind::RingTorus => Kind::RingTorus,
        CyclideKind::HornTorus => Kind::HornTorus,
        CyclideKind::SpindleTorus => Kind::SpindleTorus,
        CyclideKind::RingCyclide => Kind::Ring,
        CyclideKind::SinglyHornedCyclide => Kind::SinglyHorned,
        CyclideKind::HornedCyclide => Kind::DoublyHorned,
        CyclideKind::OneSingularitySpindleCyclide => Kind::OneSingularitySpindle,
        CyclideKind::SpindleCyclide => Kind::TwoSingularitySpindle,
        CyclideKind::ParabolicRingCyclide => Kind::ParabolicRing,
        CyclideKind::ParabolicCyclideWithOneSingularPoint => Kind::ParabolicOneSingularity,
        CyclideKind::ParabolicCyclideWithTwoSingularPoints => Kind::ParabolicTwoSingularities,
        _ => return Ok(false),
    };
    Ok(predicted == Some(measured))
}
