//! Items e: classes, types along a family, members, refusals.

use super::input::{array, cones, vector};
use cyclide::glam::DVec3;
use cyclide::{Blend, Class, Conic, ContactFamily, Dupin, Error, Family, classify};
use integration_tests::Case;
use serde_json::{Value, json};

pub(crate) fn classify_pair(case: &Case<'_>) -> Result<(), Error> {
    let [first, second] = cones(case)?;
    let found = classify(&first, &second);
    let class = found.class().to_string();
    if case.error().is_some() {
        case.require(
            matches!(found.class(), Class::NotBlendable(_) | Class::Coincident),
            "the class is blendable",
        );
        case.require(
            found.families().is_empty(),
            "a class that is not blendable has families",
        );
        case.refuse(&class, |words| words == class);
        return Ok(());
    }
    case.compare("class", class);
    case.compare("families", found.families().len());
    Ok(())
}

/// The family that the case names.
fn family(case: &Case<'_>) -> Result<Family, Error> {
    let [first, second] = cones(case)?;
    let wanted = case.get("family").expect("a family");
    let sign = |key: &str| wanted[key].as_i64().expect("a sign");
    let found = classify(&first, &second);
    let conic = match wanted["conic"].as_str() {
        Some("E") => Conic::Ellipse,
        Some("H") => Conic::Hyperbola,
        _ => Conic::Parabola,
    };
    Ok(*found
        .families()
        .iter()
        .find(|family| {
            i64::from(family.orientation()) == sign("orientation_of_cone2")
                && i64::from(family.pairing()) == sign("eps")
                && family.conic() == conic
        })
        .unwrap_or_else(|| panic!("no family {wanted} among {:?}", found.families())))
}

pub(crate) fn types(case: &Case<'_>) -> Result<(), Error> {
    let family = family(case)?;
    let diagonal = family.diagonal().expect("a diagonal");
    let found = diagonal.diagonal_points.map(|point| point.position());
    let wanted: Vec<Option<DVec3>> = case.expected()["diagonal_points"]
        .as_array()
        .expect("two points")
        .iter()
        .map(|value| (!value.is_null()).then(|| vector(value)))
        .collect();
    // A set of two: the other order if it is nearer.
    let gap = |order: [Option<DVec3>; 2]| {
        order
            .iter()
            .zip(&wanted)
            .map(|(got, want)| got.zip(*want).map_or(0.0, |(got, want)| got.distance(want)))
            .sum::<f64>()
    };
    let found = if gap(found) <= gap([found[1], found[0]]) {
        found
    } else {
        [found[1], found[0]]
    };
    case.compare(
        "diagonal_points",
        json!(found.map(|point| point.map(|p| p.to_array()))),
    );

    let boundaries = family.boundaries();
    let labels = ["mu=+a", "mu=-a", "mu=+c", "mu=-c"];
    let table = |entry: &dyn Fn(f64) -> Value| -> Value {
        labels
            .iter()
            .zip(boundaries)
            .map(|(label, t)| ((*label).to_owned(), t.map_or(Value::Null, entry)))
            .collect::<serde_json::Map<_, _>>()
            .into()
    };
    case.compare("t_boundaries", table(&|t| json!(t)));
    case.compare(
        "X_boundaries",
        table(&|t| json!(family.diagonal_point_of(t).position().map(|p| p.to_array()))),
    );
    let middles = family.ring_parameters();
    case.compare("ring_t", json!(middles));
    Ok(())
}

pub(crate) fn blend(case: &Case<'_>) -> Result<(), Error> {
    let family = family(case)?;
    let t = case.number("t_or_s");
    let blend = family.blend(t)?;
    if let Some(x) = case.get("X") {
        let same = family.blend_at(vector(x))?;
        case.require(
            (same.parameter() - t).abs() <= 1e-9 * t.abs().max(1.0),
            "X selects another member",
        );
    }
    case.require(
        blend.residual() < 1e-9,
        &format!("G1 residual {:e}", blend.residual()),
    );
    let [first, second] = cones(case)?;
    for (contact, cone) in blend.contacts().iter().zip([first, second]) {
        let residual = cyclide::contact_residual(
            blend.surface(),
            blend.contact_family(),
            contact.parameter,
            &cone,
        );
        case.require(
            residual < 1e-9,
            &format!("residual against the cone as given {residual:e}"),
        );
    }
    case.compare("kind", blend.kind().name());
    case.require(
        family.kind_at(t) == blend.kind(),
        "the type predicted on the diagonal is not that of the member",
    );
    let frame = blend.surface().frame();
    case.compare("origin", array(frame.origin()));
    case.compare(
        "x",
        if case.expected()["x"].is_null() {
            Value::Null
        } else {
            array(frame.x())
        },
    );
    match blend.surface() {
        Dupin::Quartic(surface) => {
            case.compare("a", surface.a());
            case.compare("c", surface.c());
            case.compare("mu", surface.mu());
        }
        Dupin::Parabolic(surface) => {
            case.compare("f", surface.f());
            case.compare("k", surface.k());
        }
    }
    compare_contacts(case, &family, &blend);
    Ok(())
}

fn compare_contacts(case: &Case<'_>, family: &Family, blend: &Blend) {
    case.compare(
        "contact_family",
        match blend.contact_family() {
            ContactFamily::Theta => "theta",
            ContactFamily::Psi => "psi",
            ContactFamily::U => "u",
            ContactFamily::V => "v",
        },
    );
    for (key, contact) in ["contact1", "contact2"].into_iter().zip(blend.contacts()) {
        case.compare(
            key,
            json!({"centre": contact.circle.centre.to_array(), "radius": contact.circle.radius}),
        );
    }
    let parallel = case.expected()["axial_plane_normal"].is_null();
    case.compare(
        "axial_plane_normal",
        if parallel {
            Value::Null
        } else {
            array(family.axial_plane_normal())
        },
    );
    case.compare("usable", blend.is_usable());
    // The order of the two pairs is free.
    let mut sides = blend.tubes().map(|tubes| tubes.map(|tube| tube.sides()));
    if let (Some(sides), Some(first)) = (&mut sides, case.expected()["tube_sides"].get(0))
        && json!(sides[0]) != *first
    {
        sides.swap(0, 1);
    }
    case.compare("tube_sides", json!(sides));
}

pub(crate) fn error(case: &Case<'_>) -> Result<(), Error> {
    let [first, second] = cones(case)?;
    let x = vector(case.get("X").expect("a point"));
    let blends = classify(&first, &second).blends_at(x)?;
    case.fail(format!("{} blends at a point that has none", blends.len()));
    Ok(())
}
