//! Items a: evaluation, implicit forms, types, axes, distances, rays, Villarceau circles, areas, parabolic cyclides.

use super::input::{array, quartic, surface, up_to_sign, vector};
use cyclide::glam::DVec3;
use cyclide::{CurvatureCircle, Error, Frame, Kind, Quartic, tolerance};
use integration_tests::Case;
use serde_json::{Value, json};

pub(crate) fn evaluate(case: &Case<'_>) -> Result<(), Error> {
    let (surface, theta, psi) = (surface(case)?, case.number("theta"), case.number("psi"));
    let [along_theta, along_psi] = surface.principal_curvatures(theta, psi);
    case.compare("point", array(surface.point(theta, psi)));
    case.compare("normal", array(surface.normal(theta, psi)));
    case.compare("curvature_along_psi", along_psi);
    case.compare("curvature_along_theta", along_theta);
    case.compare("area_density", surface.area_density(theta, psi));
    Ok(())
}

pub(crate) fn implicit(case: &Case<'_>) -> Result<(), Error> {
    let surface = quartic(case)?;
    let point = vector(&case.input()["local_point"]);
    let [first, second] = surface.implicit_forms(point);
    case.compare("F3", first);
    case.compare("F4", second);
    case.compare("grad", array(surface.gradient(point)));
    Ok(())
}

pub(crate) fn kind(case: &Case<'_>) -> Result<(), Error> {
    let [a, c, mu] = ["a", "c", "mu"].map(|key| case.number(key));
    let kind = Kind::of_quartic(a, c, mu, tolerance::EXACT_KIND);
    case.compare("kind", kind.name());
    let surface = match Quartic::new(a, c, mu, Frame::WORLD) {
        Ok(surface) => surface,
        Err(error) => {
            case.require(
                matches!(error, Error::TwoSpheres { .. }) && kind == Kind::TwoSpheres,
                &error.to_string(),
            );
            case.compare("singular_points", json!([]));
            return Ok(());
        }
    };
    case.require(
        surface.kind() == kind,
        "the surface has another kind than its numbers",
    );
    compare_set(case, "singular_points", &surface.singular_points());
    let circle = |circle: CurvatureCircle| json!({"centre": circle.centre.to_array(), "radius": circle.radius});
    let [psi_zero, psi_pi, theta_zero, theta_pi] = surface.principal_circles().map(circle);
    let circles = json!({"Pz_psi0": psi_zero, "Pz_psipi": psi_pi, "Py_theta0": theta_zero, "Py_thetapi": theta_pi});
    case.compare("principal_circles", circles);
    Ok(())
}

/// Compares a set of points: each expected one with the nearest that was found.
fn compare_set(case: &Case<'_>, key: &str, points: &[DVec3]) {
    let wanted: Vec<DVec3> = case.expected()[key]
        .as_array()
        .into_iter()
        .flatten()
        .map(vector)
        .collect();
    let nearest = |want: &DVec3| {
        points
            .iter()
            .min_by(|p, q| p.distance(*want).total_cmp(&q.distance(*want)))
            .copied()
    };
    let ordered: Vec<Value> = wanted.iter().filter_map(nearest).map(array).collect();
    case.require(
        points.len() == wanted.len(),
        &format!("{key}: {} points, expected {}", points.len(), wanted.len()),
    );
    case.compare(key, ordered);
}

pub(crate) fn axes(case: &Case<'_>) -> Result<(), Error> {
    let surface = quartic(case)?;
    let (theta, psi) = (
        surface.theta_axis(),
        surface.psi_axis().expect("an axis at a finite place"),
    );
    for (key, axis) in [("delta_theta", theta), ("delta_psi", psi)] {
        let want = vector(&case.expected()[key]["direction"]);
        let direction = if axis.direction.dot(want) < 0.0 {
            -axis.direction
        } else {
            axis.direction
        };
        case.compare(
            key,
            json!({"point": axis.point.to_array(), "direction": direction.to_array()}),
        );
    }
    case.compare("power_at_delta_theta", theta.power);
    case.compare("power_at_delta_psi", psi.power);
    for angle in [0.3, 1.9, 4.0] {
        let powers = [
            surface.theta_circle(angle).power(theta.point),
            surface.psi_circle(angle).power(psi.point),
        ];
        case.compare("power_at_delta_theta", powers[0]);
        case.compare("power_at_delta_psi", powers[1]);
    }
    Ok(())
}

pub(crate) fn distance(case: &Case<'_>) -> Result<(), Error> {
    let (surface, point) = (surface(case)?, vector(&case.input()["point"]));
    let closest = surface.closest(point)?;
    case.compare("distance", closest.distance.abs());
    case.compare("offset_roots", quartic(case)?.offset_roots(point).to_vec());
    let size = 1.0 + point.length();
    case.require(
        closest.point.distance(point) - closest.distance.abs() < 1e-9 * size,
        "the foot is at another distance",
    );
    case.require(
        surface.signed_distance(closest.point)?.abs() < 1e-9 * size,
        "the foot is off the surface",
    );
    Ok(())
}

pub(crate) fn ray(case: &Case<'_>) -> Result<(), Error> {
    let (origin, direction) = (
        vector(&case.input()["origin"]),
        vector(&case.input()["direction"]),
    );
    let hits = surface(case)?.intersect(origin, direction)?;
    case.compare("s", hits.iter().map(|hit| hit.s).collect::<Vec<_>>());
    Ok(())
}

pub(crate) fn villarceau(case: &Case<'_>) -> Result<(), Error> {
    let circle = quartic(case)?.villarceau_circle(case.number("phi"), case.number("sign"))?;
    case.compare("centre", array(circle.centre()));
    case.compare("radius", circle.radius());
    case.compare(
        "normal_up_to_sign",
        up_to_sign(case, "normal_up_to_sign", circle.axis()),
    );
    Ok(())
}

pub(crate) fn area(case: &Case<'_>) -> Result<(), Error> {
    let spans = ["theta", "psi"].map(|name| super::input::span(case, name));
    case.compare("area", surface(case)?.area(spans[0], spans[1])?);
    Ok(())
}

pub(crate) fn parabolic(case: &Case<'_>) -> Result<(), Error> {
    let surface = surface(case)?;
    let (u, v, query) = (
        case.number("u"),
        case.number("v"),
        vector(&case.input()["query"]),
    );
    case.compare("point", array(surface.point(u, v)));
    case.compare("normal", array(surface.normal(u, v)));
    case.compare("kind", surface.kind().name());
    let local: Vec<DVec3> = surface
        .singular_points()
        .iter()
        .map(|&point| surface.frame().point_to_local(point))
        .collect();
    compare_set(case, "singular_points_local", &local);
    case.compare("cubic_at_query", surface.implicit(query));
    case.compare("distance_at_query", surface.signed_distance(query)?.abs());
    // A singular point has a whole circle of parameters.
    if surface.area_density(u, v) > 1e-6 {
        let [found_u, found_v] = surface.parameters_at(surface.point(u, v));
        case.require(
            (found_u - u).abs() + (found_v - v).abs() < 1e-9 * (1.0 + u.abs() + v.abs()),
            "the parameters are not recovered",
        );
    }
    Ok(())
}
