//! Items b to d: Bézier nets, the conditions on them, and both conversions.

use super::input::{array, refuse, span, surface, vector};
use bezier_mass::{Biquadratic, MassPoint};
use cyclide::glam::DVec3;
use cyclide::{Conversion, Dupin, Error, convert, convert_torus, inspect, solve_weights};
use integration_tests::Case;
use serde_json::{Value, json};

fn nine<T>(value: &Value, entry: impl Fn(&Value) -> T) -> [[T; 3]; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(&value[i][j])))
}

fn net(points: &Value, weights: &Value) -> Result<Biquadratic<DVec3>, Error> {
    let (points, weights) = (
        nine(points, vector),
        nine(weights, |weight| weight.as_f64().expect("a weight")),
    );
    let control =
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| MassPoint::point(points[i][j], weights[i][j])));
    Ok(Biquadratic::new(control)?)
}

fn compare_net(case: &Case<'_>, net: &Biquadratic<DVec3>) {
    let control = net.control();
    case.compare(
        "points",
        json!(control.map(|row| row.map(|mass_point| mass_point.position().map(|p| p.to_array())))),
    );
    compare_weights(case, net);
}

fn compare_weights(case: &Case<'_>, net: &Biquadratic<DVec3>) {
    case.compare(
        "weights",
        json!(
            net.control()
                .map(|row| row.map(|mass_point| mass_point.weight))
        ),
    );
}

pub(crate) fn bezier(case: &Case<'_>) -> Result<(), Error> {
    let surface = surface(case)?;
    let spans = if surface.as_parabolic().is_some() {
        ["u", "v"]
    } else {
        ["theta", "psi"]
    }
    .map(|name| span(case, name));
    let patch = surface.patch(spans[0], spans[1])?;
    let raw = patch
        .net()
        .control()
        .map(|row| row.map(|h| [h.weighted.x, h.weighted.y, h.weighted.z, h.weight]));
    case.compare("raw_homogeneous", json!(raw));
    if case.expected().get("points").is_some() {
        let net = patch.normalised_net()?;
        compare_net(case, &net);
        if let Some(uv) = case.expected().get("sample_uv") {
            case.seen("sample_uv");
            let at = |index: usize| uv[index].as_f64().expect("a parameter");
            case.compare("sample_point", array(net.point(at(0), at(1))?));
        }
    }
    Ok(())
}

pub(crate) fn weights(case: &Case<'_>) -> Result<(), Error> {
    let solved = solve_weights(&nine(&case.input()["points"], vector));
    case.compare("pg_ok", solved.is_ok());
    // Where the conditions fail the file may say no more than that.
    let net = match solved {
        Err(Error::NotAPatch { .. }) if case.expected()["pg_ok"] == json!(false) => return Ok(()),
        solved => solved?,
    };
    compare_weights(case, &net);
    let middle = net.middle_curves().map(|curve| {
        json!(curve.control().map(|barycentre| (
            barycentre.position().expect("a point").to_array(),
            barycentre.weight
        )))
    });
    let [along_u, along_v] = middle;
    case.compare("middle_curve_u", along_u);
    case.compare("middle_curve_v", along_v);
    Ok(())
}

pub(crate) fn invalid(case: &Case<'_>) -> Result<(), Error> {
    let net = net(&case.input()["points"], &case.input()["weights"])?;
    match inspect(&net).and_then(|report| report.check()) {
        Err(error @ Error::NotAPatch { .. }) => refuse(case, &error),
        other => case.fail(format!("no condition was found broken: {other:?}")),
    }
    case.require(convert(&net).is_err(), "the broken net was converted");
    Ok(())
}

pub(crate) fn algorithm1(case: &Case<'_>) -> Result<(), Error> {
    let net = net(&case.input()["points"], &case.input()["weights"])?;
    let hint = case
        .get("x_hint")
        .map(|x| [vector(x), vector(&case.input()["z_hint"])]);
    let found = convert_torus(&net, hint)?;
    let surface = found.surface.as_quartic().expect("a quartic");
    let frame = surface.frame();
    case.compare("kind", found.kind().name());
    case.compare("a", surface.a());
    case.compare("c", surface.c());
    case.compare("mu", surface.mu());
    case.compare("origin", array(frame.origin()));
    case.compare("k0_with_theta_increasing", array(frame.z()));
    case.compare("direction_of_theta0", array(frame.x()));
    case.compare("theta_span", found.first[1] - found.first[0]);
    case.compare("theta0", found.first[0]);
    case.compare("theta1", found.first[1]);
    case.compare("psi0", found.second[0]);
    case.compare("psi1", found.second[1]);
    Ok(())
}

pub(crate) fn convert_net(case: &Case<'_>) -> Result<(), Error> {
    let control = nine(&case.input()["homogeneous"], |entry| {
        let [x, y, z, w] = [0, 1, 2, 3].map(|index| entry[index].as_f64().expect("a number"));
        MassPoint::from_homogeneous(w, DVec3::new(x, y, z))
    });
    compare_conversion(case, &convert(&Biquadratic::new(control)?)?);
    Ok(())
}

fn compare_conversion(case: &Case<'_>, found: &Conversion) {
    let frame = found.surface.frame();
    case.compare("kind", found.kind().name());
    case.compare("origin", array(frame.origin()));
    case.compare("u_is_theta", found.rows_follow_first);
    case.require(
        found.rows_follow_first || found.surface.as_parabolic().is_none(),
        "the rows of a parabolic net follow the second parameter",
    );
    let (names, parameters) = match &found.surface {
        Dupin::Quartic(surface) => (
            ["theta0", "theta1", "psi0", "psi1"],
            vec![
                ("a", surface.a()),
                ("c", surface.c()),
                ("mu", surface.mu()),
                ("e", surface.eccentricity()),
            ],
        ),
        Dupin::Parabolic(surface) => (
            ["u0", "u1", "v0", "v1"],
            vec![("f", surface.f()), ("k", surface.k())],
        ),
    };
    for (key, value) in parameters {
        case.compare(key, value);
    }
    case.compare("x", array(frame.x()));
    case.compare("y", array(frame.y()));
    for (key, value) in names
        .into_iter()
        .zip(found.first.into_iter().chain(found.second))
    {
        case.compare(key, value);
    }
}
