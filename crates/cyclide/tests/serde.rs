//! Values survive being written and read, and what could not have been constructed cannot be read.

#![cfg(feature = "serde")]

mod common;
use common::pairs::{CONSTRUCTIONS, Random, pair};
use cyclide::glam::{DVec3, dvec3};
use cyclide::{
    Blend, Classification, Cone, Conversion, CyclidePatch, Dupin, Family, Frame, Quartic, RayHits,
    RingPreference, SphereLine, Tube, classify, convert,
};
use serde_json::{from_str, to_string};

#[test]
fn surfaces_and_patches_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let frame = Frame::around(dvec3(1.0, -2.0, 0.5), dvec3(1.0, 2.0, 3.0)).ok_or("no frame")?;
    for surface in [
        Dupin::quartic(3.0, 1.0, 2.0, frame)?,
        Dupin::torus(2.0, 0.7, frame)?,
        Quartic::double_sphere(1.5, 0.4, frame)?.into(),
        Dupin::parabolic(1.0, -0.2, frame)?,
    ] {
        let read: Dupin = from_str(&to_string(&surface)?)?;
        assert_eq!(read.kind(), surface.kind());
        // The frame is made orthonormal again on the way in: equal to rounding, not bit for bit.
        let (one, other) = (surface.point(0.4, 0.9), read.point(0.4, 0.9));
        assert!((one - other).length() <= 1e-15 * (1.0 + one.length()) * 8.0);
    }
    let patch = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?.patch([0.3, 1.7], [0.4, 1.9])?;
    // The text of a number is read to within its last bit.
    let read: CyclidePatch = from_str(&to_string(&patch)?)?;
    assert!(convert(read.net())?.residual < 1e-14);
    let found = convert(patch.net())?;
    let read: Conversion = from_str(&to_string(&found)?)?;
    assert_eq!((read.first, read.second), (found.first, found.second));
    Ok(())
}

#[test]
fn cones_and_blends_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let pipe = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0)?;
    let axis = dvec3(0.9, 0.0, 0.436).normalize();
    let funnel = Cone::new(-axis / 0.3_f64.sin(), axis, 0.3)?;
    let read: [Cone; 2] = from_str(&to_string(&[pipe, funnel])?)?;
    let found = classify(&read[0], &read[1]);
    let classification: Classification = from_str(&to_string(&found)?)?;
    assert_eq!(classification.class(), found.class());
    let family: Family = from_str(&to_string(&found.families()[0])?)?;
    let blend = family.ring_blend(RingPreference::Widest)?;
    let copy: Blend = from_str(&to_string(&blend)?)?;
    assert_eq!(copy.kind(), blend.kind());
    assert_eq!(copy.contacts(), blend.contacts());
    let tube = blend.tubes().ok_or("no tube")?[0];
    let copy: Tube = from_str(&to_string(&tube)?)?;
    assert_eq!(copy.patches()?.len(), tube.patches()?.len());
    Ok(())
}

#[test]
fn what_a_constructor_refuses_is_refused() -> Result<(), Box<dyn std::error::Error>> {
    let cone = to_string(&Cone::new(DVec3::ZERO, DVec3::Z, 0.5)?)?;
    assert!(from_str::<Cone>(&cone).is_ok());
    assert!(from_str::<Cone>(&cone.replace("0.5", "2.5")).is_err());
    let torus = to_string(&Dupin::torus(2.0, 0.75, Frame::WORLD)?)?;
    assert!(from_str::<Dupin>(&torus).is_ok());
    assert!(from_str::<Dupin>(&torus.replace("2.0", "-2.0")).is_err());
    Ok(())
}

/// Values with parts that could not go together are refused or made again from what determines them.
#[test]
fn parts_that_do_not_belong_together_are_refused() -> Result<(), Box<dyn std::error::Error>> {
    let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
    let patch = ring.patch([0.25, 1.5], [0.5, 1.75])?;
    let text = to_string(&patch)?;
    assert_eq!(from_str::<CyclidePatch>(&text)?.net(), patch.net());
    assert!(from_str::<CyclidePatch>(&text.replace("[0.25,1.5]", "[0.25,100.5]")).is_err());

    let mut found = convert(patch.net())?;
    assert!(from_str::<Conversion>(&to_string(&found)?).is_ok());
    found.residual = 0.5;
    assert!(from_str::<Conversion>(&to_string(&found)?).is_err());
    found.residual = 0.0;
    found.second = [0.5, 100.5];
    assert!(from_str::<Conversion>(&to_string(&found)?).is_err());

    let hits = ring.intersect(dvec3(-10.0, 0.0, 0.0), DVec3::X)?;
    let text = to_string(&hits)?;
    assert_eq!(from_str::<RayHits>(&text)?.len(), 4);
    assert!(from_str::<RayHits>(&text.replace("\"len\":4", "\"len\":5")).is_err());

    let line = Cone::cylinder(DVec3::ZERO, DVec3::Z, 0.75)?.spheres();
    let text = to_string(&line)?;
    assert_eq!(from_str::<SphereLine>(&text)?, line);
    assert!(from_str::<SphereLine>(&text.replace("\"cos\":1.0", "\"cos\":0.5")).is_err());
    Ok(())
}

/// A blend, a family and a tube in which one part was exchanged.
#[test]
fn blends_with_foreign_parts_are_refused() -> Result<(), Box<dyn std::error::Error>> {
    let pipe = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0)?;
    let axis = dvec3(0.9, 0.0, 0.436).normalize();
    let funnel = Cone::new(-axis / 0.3_f64.sin(), axis, 0.3)?;
    let found = classify(&pipe, &funnel);
    let family = found.families()[0];
    let blend = family.ring_blend(RingPreference::Widest)?;
    let tube = blend.tubes().ok_or("no tube")?[0];
    let changed = |value: &serde_json::Value, key: &str, part: serde_json::Value| {
        let mut value = value.clone();
        value[key] = part;
        value
    };
    let torus = serde_json::to_value(Dupin::torus(3.0, 1.0, Frame::WORLD)?)?;
    let parabolic = serde_json::to_value(Dupin::parabolic(3.0, 1.0, Frame::WORLD)?)?;

    let value = serde_json::to_value(blend)?;
    let refused = |value| serde_json::from_value::<Blend>(value).is_err();
    assert!(!refused(value.clone()));
    assert!(refused(changed(&value, "surface", torus)));
    assert!(refused(changed(&value, "surface", parabolic.clone())));
    assert!(refused(changed(&value, "parameter", 77.0.into())));
    assert!(refused(changed(&value, "residual", 0.5.into())));

    let value = serde_json::to_value(family)?;
    let refused = |value| serde_json::from_value::<Family>(value).is_err();
    assert!(!refused(value.clone()));
    assert!(refused(changed(&value, "orientation", 77.into())));
    assert!(refused(changed(&value, "size", (-1.0).into())));
    assert!(refused(changed(
        &value,
        "lines",
        serde_json::to_value([pipe.spheres(); 2])?
    )));

    let value = serde_json::to_value(tube)?;
    let refused = |value| serde_json::from_value::<Tube>(value).is_err();
    assert!(!refused(value.clone()));
    assert!(refused(changed(&value, "surface", parabolic)));
    assert!(refused(changed(&value, "sides", serde_json::json!([1, 3]))));
    Ok(())
}

/// No pair of cones is so special that its classification, families, blends and tubes cannot be read.
#[test]
fn every_construction_comes_back() -> Result<(), Box<dyn std::error::Error>> {
    let mut random = Random(51);
    for construction in CONSTRUCTIONS {
        for index in 0..100 {
            let (raw, _) = pair(construction, &mut random);
            let [one, other] = raw.map(|raw| raw.cone());
            let found = classify(&one, &other);
            let read: Classification = from_str(&to_string(&found)?)
                .map_err(|error| format!("{construction} {index}: {error}"))?;
            assert_eq!(read.families().len(), found.families().len());
            for family in read.families() {
                for share in [-3.0, 0.4, 1.7] {
                    let size = family.contact_spheres(1.0)[0].radius.abs().max(1e-3);
                    let Ok(blend) = family.blend(share * size) else {
                        continue;
                    };
                    let copy: Blend = from_str(&to_string(&blend)?)
                        .map_err(|error| format!("{construction} {index}: {error} {blend:?}"))?;
                    assert_eq!(copy.contact_family(), blend.contact_family());
                    for tube in blend.tubes().into_iter().flatten() {
                        from_str::<Tube>(&to_string(&tube)?)
                            .map_err(|error| format!("{construction} {index}: {error}"))?;
                    }
                }
            }
        }
    }
    Ok(())
}
