//! The blends of two cones, on random pairs of every class.

mod common;
use common::pairs::{CONSTRUCTIONS, Random, expected, pair};
use cyclide::{Family, classify, contact_residual};

/// Pairs of each construction.
const PAIRS: u32 = 10_000;

/// A parameter of the order of the data, not at a boundary between two types.
fn parameter(family: &Family, scale: f64, random: &mut Random) -> f64 {
    loop {
        let parameter = random.sign() * scale * random.between(0.2, 3.0);
        let coordinate = if family.pairing() == 0 {
            parameter
        } else {
            1.0 / parameter
        };
        let near_end = family.intervals().iter().any(|interval| {
            [interval.from, interval.to]
                .iter()
                .any(|end| (end - coordinate).abs() < 1e-3 * coordinate.abs())
        });
        if !near_end {
            return parameter;
        }
    }
}

#[test]
fn every_class_classifies_blends_and_predicts_the_type() {
    for construction in CONSTRUCTIONS {
        let mut random = Random(7);
        let (is_expected, families) = expected(construction);
        let (mut worst_residual, mut worst_angle, mut worst_distance) = (0.0_f64, 0.0_f64, 0.0_f64);
        for index in 0..PAIRS {
            let (raw, scale) = pair(construction, &mut random);
            let [first, second] = raw.map(|cone| cone.cone());
            let found = classify(&first, &second);
            assert!(
                is_expected(found.class()),
                "{construction} {index}: {} for {raw:?}",
                found.class()
            );
            assert_eq!(found.families().len(), families, "{construction} {index}");
            for family in found.families() {
                let t = parameter(family, scale, &mut random);
                let blend = family.blend(t).unwrap_or_else(|error| {
                    panic!("{construction} {index} t = {t}: {error}, {raw:?}")
                });
                let coordinate = if family.pairing() == 0 { t } else { 1.0 / t };
                let intervals = family.intervals();
                let predicted = intervals
                    .iter()
                    .find(|interval| interval.contains(coordinate))
                    .map(|interval| interval.kind);
                assert_eq!(
                    predicted,
                    Some(blend.kind()),
                    "{construction} {index} t = {t}: {intervals:?}"
                );
                worst_residual = worst_residual.max(blend.residual());
                let (distance, angle) = blend.sampled_error(3);
                (worst_distance, worst_angle) =
                    (worst_distance.max(distance), worst_angle.max(angle));
            }
        }
        println!(
            "{construction}: residual {worst_residual:.1e}, angle {worst_angle:.1e}, distance {worst_distance:.1e}"
        );
        assert!(
            worst_residual < 1e-9,
            "{construction}: residual {worst_residual:e}"
        );
        assert!(worst_angle < 1e-7, "{construction}: angle {worst_angle:e}");
    }
}

#[test]
fn pairs_off_their_class_are_refused_or_fall_into_another() {
    for construction in CONSTRUCTIONS {
        let mut random = Random(11);
        let mut refused = 0_u32;
        for index in 0..PAIRS {
            let (mut raw, scale) = pair(construction, &mut random);
            match index % 4 {
                0 => raw[1].point += 1e-3 * scale * random.direction(),
                1 => raw[1].axis = (raw[1].axis + 1e-3 * random.direction()).normalize(),
                2 if raw[1].half_angle > 0.0 => raw[1].half_angle += 1e-3 * random.sign(),
                2 => raw[1].radius *= 1.0 + 1e-3 * random.sign(),
                _ => {
                    raw[1].point += 1e-3 * scale * raw[1].axis;
                    raw[1].axis = (raw[1].axis + 1e-3 * random.direction()).normalize();
                }
            }
            let cones = raw.map(|cone| cone.cone());
            let found = classify(&cones[0], &cones[1]);
            refused += u32::from(found.families().is_empty());
            for family in found.families() {
                let Ok(blend) = family.blend(parameter(family, scale, &mut random)) else {
                    continue;
                };
                for (contact, cone) in blend.contacts().iter().zip(&cones) {
                    let residual = contact_residual(
                        blend.surface(),
                        blend.contact_family(),
                        contact.parameter,
                        cone,
                    );
                    assert!(
                        residual <= 1e-8,
                        "{construction} {index}: residual {residual:e} for {raw:?}"
                    );
                }
            }
        }
        println!("{construction}: {refused} of {PAIRS} refused");
    }
}
