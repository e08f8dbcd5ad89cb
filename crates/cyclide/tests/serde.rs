//! Values survive being written and read, and what could not have been constructed cannot be read.

#![cfg(feature = "serde")]

use cyclide::glam::{DVec3, dvec3};
use cyclide::{
    Blend, Classification, Cone, Conversion, CyclidePatch, Dupin, Family, Frame, Quartic,
    RingPreference, Tube, classify, convert,
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
