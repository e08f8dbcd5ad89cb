//! PH quintics, ovals, cams, Minkowski offsets and spatial curves (items c, e, f, g).

use std::f64::consts::PI;

use integration_tests::{Case, Tolerance};
use ph_curves::glam::{DVec2, DVec3};
use ph_curves::{
    Bumped, Cam, DualCurve, Ellipse, Error, EvolutePolygon, Frame, Hermite, Indicatrix,
    IsoperimetricArc, MinkowskiPlane, PhArc, PhSpline, PolynomialPh, Quaternion,
    RationalFrameQuintic, SpatialHermite, SpatialHermiteAngles, SpatialPh, SplineEnds, Support,
    SupportJet, hermite_arc, rotation_minimising_frames,
};
use serde_json::{Value, json};

/// Answers the case if its kind is one of this file.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let result = match case.kind() {
        "ph_quintic_hermite" => ph_quintic_hermite(case),
        "ph_quintic_offset" => ph_quintic_offset(case),
        "ph_quintic_spline" => ph_quintic_spline(case),
        "constant_width_from_polygon" => constant_width_from_polygon(case),
        "cam_from_lift" => cam_from_lift(case),
        "class5_hermite" => class5_hermite(case),
        "isoperimetrix_point" => isoperimetrix_point(case),
        "minkowski_norm" => minkowski_norm(case),
        "ih_offset_lines" => ih_offset_lines(case),
        "general_offset" => general_offset(case),
        "quaternion_sqrt" => quaternion_sqrt(case),
        "spatial_ph_hermite" => spatial_ph_hermite(case),
        "rrmf" => rrmf(case),
        "rmf_numeric" => rmf_numeric(case),
        _ => return false,
    };
    if let Err(error) = result {
        case.refuse(&error.to_string(), |_| true);
    }
    true
}

fn vec2(numbers: &[f64]) -> DVec2 {
    DVec2::new(numbers[0], numbers[1])
}

fn vec3(numbers: &[f64]) -> DVec3 {
    DVec3::new(numbers[0], numbers[1], numbers[2])
}

fn point(case: &Case<'_>, key: &str) -> DVec2 {
    vec2(&case.numbers(key))
}

fn points(all: &[DVec2]) -> Value {
    all.iter().map(|p| json!([p.x, p.y])).collect()
}

fn hermite(case: &Case<'_>) -> Hermite {
    Hermite {
        start: point(case, "p0"),
        start_derivative: point(case, "d0"),
        end: point(case, "p1"),
        end_derivative: point(case, "d1"),
    }
}

fn ph_quintic_hermite(case: &Case<'_>) -> Result<(), Error> {
    let solutions = hermite(case).quintics()?;
    if let Some(wanted) = case.expected()["solutions"].as_array() {
        // A set: each expected solution has its own counterpart.
        let describe = |curve: &PolynomialPh| json!({"control": points(curve.control_points()), "length": curve.arc_length().total()});
        let mut left: Vec<Value> = solutions.iter().map(describe).collect();
        for want in wanted {
            match left
                .iter()
                .position(|got| case.tolerance().compare(want, got).is_ok())
            {
                Some(found) => drop(left.swap_remove(found)),
                None => case.fail(format!("no solution like {want}")),
            }
        }
        case.require(left.is_empty(), "more solutions than expected");
        case.seen("solutions");
    }
    let best = hermite(case).least_bending()?;
    case.compare("best_control", points(best.control_points()));
    case.compare("best_length", best.arc_length().total());
    // The reference integrates with 40 points and says so: 1e-6.
    case.compare_within(
        "best_energy",
        best.bending_energy(),
        Tolerance::Componentwise(1e-6),
    );
    Ok(())
}

fn ph_quintic_offset(case: &Case<'_>) -> Result<(), Error> {
    let right = case.get("normal").and_then(Value::as_str) != Some("left");
    let distance = if right {
        case.number("d")
    } else {
        -case.number("d")
    };
    let offset = hermite(case).least_bending()?.offset(distance)?;
    case.compare("degree", offset.degree() as f64);
    case.compare(
        "weights",
        offset
            .control()
            .iter()
            .map(|mass| mass.weight)
            .collect::<Vec<_>>(),
    );
    let projected: Vec<DVec2> = offset
        .control()
        .iter()
        .filter_map(|mass| mass.position())
        .collect();
    case.compare("points", points(&projected));
    let half = offset.point(0.5)?;
    case.compare("point_half", vec![half.x, half.y]);
    Ok(())
}

fn ph_quintic_spline(case: &Case<'_>) -> Result<(), Error> {
    let through: Vec<DVec2> = case.rows("points").iter().map(|row| vec2(row)).collect();
    let ends = match case.get("d0") {
        Some(_) => SplineEnds::Clamped {
            start_derivative: point(case, "d0"),
            end_derivative: point(case, "d1"),
        },
        None => SplineEnds::Closed,
    };
    let spline = PhSpline::interpolate(&through, ends)?;
    let segments: Value = spline
        .spans()
        .iter()
        .map(|span| points(span.control_points()))
        .collect();
    case.compare("segments", segments);
    case.compare("total_length", spline.length());
    Ok(())
}

fn constant_width_from_polygon(case: &Case<'_>) -> Result<(), Error> {
    let vertices: Vec<DVec2> = case.rows("polygon").iter().map(|row| vec2(row)).collect();
    let polygon = EvolutePolygon::try_new(&vertices)?;
    let rosette = polygon.rosette(case.number("width"))?;
    let exterior: Vec<DVec2> = polygon
        .cubics()
        .iter()
        .map(|cubic| cubic.points()[0])
        .collect();
    case.compare("exterior_points", points(&exterior));
    case.compare(
        "cubic_lengths",
        polygon
            .cubics()
            .iter()
            .map(|cubic| cubic.length())
            .collect::<Vec<_>>(),
    );
    case.compare("turning_half", polygon.half_turnings().to_vec());
    case.compare("line_covering", polygon.line_covering() as f64);
    case.compare("min_width", polygon.minimum_width());
    case.compare("arcs", rosette.arcs().len() as f64);
    case.compare("perimeter", rosette.perimeter());
    // The reference runs along the cubics, also around a clockwise polygon.
    let arcs = polygon.arcs(case.number("width"))?;
    case.compare(
        "radii",
        arcs.iter().map(|arc| arc.radius(0.0)).collect::<Vec<_>>(),
    );
    case.compare(
        "points",
        points(&arcs.iter().map(|arc| arc.point(0.0)).collect::<Vec<_>>()),
    );
    Ok(())
}

/// `5 + c3 cos 3s + c5 sin 5s` and the like, read off the words that describe a lift.
fn lift(case: &Case<'_>) -> impl Fn(f64) -> [f64; 3] {
    let words = case
        .get("lift")
        .and_then(Value::as_str)
        .unwrap_or_default()
        .to_owned();
    let mut mean = f64::NAN;
    let mut waves = Vec::new();
    for (index, term) in words.split('+').enumerate() {
        let parts: Vec<&str> = term.split_whitespace().collect();
        match parts[..] {
            [number] if index == 0 => mean = number.parse().expect("the mean of a lift"),
            [factor, wave, argument] => {
                let height = factor.parse().unwrap_or_else(|_| case.number(factor));
                let frequency: f64 = argument
                    .trim_end_matches('s')
                    .parse()
                    .expect("the frequency of a wave");
                waves.push((
                    height,
                    frequency,
                    if wave == "sin" { -0.5 * PI } else { 0.0 },
                ));
            }
            _ => panic!("a lift of unknown form: {words}"),
        }
    }
    move |angle| {
        let mut jet = [mean, 0.0, 0.0];
        for (height, frequency, phase) in &waves {
            let (sine, cosine) = (frequency * angle + phase).sin_cos();
            jet[0] += height * cosine;
            jet[1] -= height * frequency * sine;
            jet[2] -= height * frequency * frequency * cosine;
        }
        jet
    }
}

fn cam_from_lift(case: &Case<'_>) -> Result<(), Error> {
    let arcs = case
        .get("arcs_per_half_turn")
        .and_then(Value::as_u64)
        .unwrap_or(6) as usize;
    let cam = Cam::try_new(&lift(case), arcs)?;
    case.require(
        (cam.width - case.number("width")).abs() < 1e-9,
        "another width",
    );
    let arcs = cam.profile.arcs();
    case.compare(
        "g",
        arcs.iter()
            .map(|arc| json!(arc.coefficients()))
            .collect::<Value>(),
    );
    case.compare(
        "radius_poly",
        arcs.iter()
            .map(|arc| json!(arc.radius_polynomial()))
            .collect::<Value>(),
    );
    let least = arcs
        .iter()
        .flat_map(PhArc::radius_polynomial)
        .fold(f64::INFINITY, f64::min);
    case.compare("min_radius_coefficient", least);
    case.compare("perimeter", cam.profile.perimeter());
    if let Some(want) = case.expected()["support_error"].as_f64() {
        case.compare_within(
            "support_error",
            cam.lift_error,
            Tolerance::Absolute(0.05 * want),
        );
    }
    Ok(())
}

fn class5_hermite(case: &Case<'_>) -> Result<(), Error> {
    let jet = |key: &str| {
        let numbers = case.numbers(key);
        SupportJet {
            support: numbers[0],
            slope: numbers[1],
            bend: numbers[2],
        }
    };
    let (start, end) = (
        (case.number("psi0"), jet("jet0")),
        (case.number("psi1"), jet("jet1")),
    );
    let arc: PhArc<6> = hermite_arc(start, end, &[])?;
    case.compare("g", arc.coefficients().to_vec());
    case.compare("radius_poly", arc.radius_polynomial().to_vec());
    for (key, t) in [("point0", 0.0), ("point_half", 0.5), ("point1", 1.0)] {
        let point = arc.point(t);
        case.compare(key, vec![point.x, point.y]);
    }
    case.compare("point_degree", arc.to_points()?.degree() as f64);
    Ok(())
}

/// The indicatrix of a case, as a support function in the normal angle.
fn indicatrix(case: &Case<'_>) -> Result<Box<dyn Fn(f64) -> SupportJet>, Error> {
    if case.get("ellipse").is_some() {
        let axes = case.numbers("ellipse");
        let ellipse = Indicatrix::try_new(Ellipse {
            a: axes[0],
            b: axes[1],
        })?;
        return Ok(Box::new(move |psi| ellipse.jet(psi)));
    }
    match case.get("indicatrix_support").and_then(Value::as_str) {
        Some("1 + eps cos 4s") => {
            let bumped = Indicatrix::try_new(Bumped {
                height: case.number("eps"),
            })?;
            Ok(Box::new(move |psi| bumped.jet(psi)))
        }
        Some("1 + 0.05 cos 3s") => {
            let wave = |psi: f64| {
                let (sine, cosine) = (3.0 * psi).sin_cos();
                SupportJet {
                    support: 1.0 + 0.05 * cosine,
                    slope: -0.15 * sine,
                    bend: -0.45 * cosine,
                }
            };
            Indicatrix::try_new(wave)?;
            Ok(Box::new(wave))
        }
        other => panic!("an indicatrix of unknown form: {other:?}"),
    }
}

fn isoperimetrix_point(case: &Case<'_>) -> Result<(), Error> {
    let plane = MinkowskiPlane::new(Indicatrix::try_new(indicatrix(case)?)?);
    let s = case.number("s");
    // For an ellipse s is the parameter of the point, whose normal is (cos s / a, sin s / b).
    let psi = match case.get("ellipse") {
        Some(_) => {
            let axes = case.numbers("ellipse");
            DVec2::new(s.cos() / axes[0], s.sin() / axes[1]).to_angle()
        }
        None => s,
    };
    let (u, u0) = (plane.indicatrix_point(psi), plane.isoperimetrix_point(psi));
    case.compare("u", vec![u.x, u.y]);
    case.compare("u0", vec![u0.x, u0.y]);
    case.compare("det_u0_u", u0.perp_dot(u));
    Ok(())
}

fn minkowski_norm(case: &Case<'_>) -> Result<(), Error> {
    let plane = MinkowskiPlane::new(Indicatrix::try_new(indicatrix(case)?)?);
    let v = point(case, "v");
    case.compare("norm_U", plane.norm(v));
    case.compare("norm_U0", plane.dual_norm(v));
    Ok(())
}

fn ih_offset_lines(case: &Case<'_>) -> Result<(), Error> {
    let dual = |key: &str| {
        DualCurve::from_vectors(
            &case
                .rows(key)
                .iter()
                .map(|row| vec3(row))
                .collect::<Vec<_>>(),
        )
    };
    let arc = IsoperimetricArc::try_new(dual("lines")?, &dual("indicatrix_lines")?)?;
    let offset = arc.offset(case.number("d"))?;
    let lines: Value = offset
        .curve()
        .vectors()
        .iter()
        .map(|u| json!([u.x, u.y, u.z]))
        .collect();
    case.compare("lines", lines);
    let half = offset.curve().contact(0.5)?.point;
    case.compare("point_half", vec![half.x, half.y]);
    Ok(())
}

fn general_offset(case: &Case<'_>) -> Result<(), Error> {
    let plane = MinkowskiPlane::new(Indicatrix::try_new(indicatrix(case)?)?);
    assert_eq!(
        case.get("curve_support").and_then(Value::as_str),
        Some("2 + 0.2 cos 3s"),
        "the curve's form"
    );
    let curve = |psi: f64| {
        let (sine, cosine) = (3.0 * psi).sin_cos();
        SupportJet {
            support: 2.0 + 0.2 * cosine,
            slope: -0.6 * sine,
            bend: -1.8 * cosine,
        }
    };
    let contact = plane
        .offset_support(&curve, case.number("d"))
        .contact(case.number("s"));
    case.compare("point", vec![contact.point.x, contact.point.y]);
    case.compare("support", contact.support);
    Ok(())
}

fn quaternion(numbers: &[f64]) -> Quaternion {
    Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3])
}

fn four(a: &Quaternion) -> Value {
    json!([a.scalar, a.vector.x, a.vector.y, a.vector.z])
}

fn rows_of(frame: &Frame) -> Value {
    [frame.tangent, frame.second, frame.third]
        .iter()
        .map(|v| json!([v.x, v.y, v.z]))
        .collect()
}

fn preimage(case: &Case<'_>) -> [Quaternion; 3] {
    ["a0", "a1", "a2"].map(|key| quaternion(&case.numbers(key)))
}

fn quaternion_sqrt(case: &Case<'_>) -> Result<(), Error> {
    let root = Quaternion::square_root(vec3(&case.numbers("v")), case.number("phi"))?;
    case.compare("a", four(&root));
    Ok(())
}

fn control3(curve: &SpatialPh) -> Value {
    curve
        .control_points()
        .iter()
        .map(|p| json!([p.x, p.y, p.z]))
        .collect()
}

fn spatial_ph_hermite(case: &Case<'_>) -> Result<(), Error> {
    let vector = |key: &str| vec3(&case.numbers(key));
    let data = SpatialHermite {
        start: vector("p0"),
        start_derivative: vector("d0"),
        end: vector("p1"),
        end_derivative: vector("d1"),
    };
    let phi = case.numbers("phi");
    let curve = data.quintic(SpatialHermiteAngles {
        start: phi[0],
        middle: phi[1],
        end: phi[2],
    })?;
    case.compare(
        "preimage",
        curve.preimage().iter().map(four).collect::<Value>(),
    );
    case.compare("control", control3(&curve));
    case.compare("length", curve.arc_length().total());
    case.compare("erf_half", rows_of(&curve.euler_rodrigues_frame(0.5)?));
    Ok(())
}

fn rrmf(case: &Case<'_>) -> Result<(), Error> {
    let preimage = preimage(case);
    let curve = SpatialPh::try_new(DVec3::ZERO, preimage)?;
    let found = RationalFrameQuintic::try_new(curve);
    case.compare("is_rrmf", found.is_ok());
    let residual = RationalFrameQuintic::residual(preimage);
    case.compare("residual", vec![residual.x, residual.y, residual.z]);
    let Ok(quintic) = found else { return Ok(()) };
    case.compare("w", points(&quintic.multiplier()));
    for (key, t) in [("rmf0", 0.0), ("rmf_half", 0.5), ("rmf1", 1.0)] {
        case.compare(key, rows_of(&quintic.frame(t)?));
    }
    case.compare("control", control3(quintic.curve()));
    Ok(())
}

fn rmf_numeric(case: &Case<'_>) -> Result<(), Error> {
    let curve = SpatialPh::try_new(DVec3::ZERO, preimage(case))?;
    // Order 4: 3e-8 at 200 steps and 2e-9 at 400 on the reference curve, whose tolerance is 1e-8.
    let steps = 2000;
    let samples = (0..=steps).map(|i| curve.point_and_tangent(f64::from(i) / f64::from(steps)));
    let samples = samples.collect::<Result<Vec<_>, Error>>()?;
    let frames = rotation_minimising_frames(curve.euler_rodrigues_frame(0.0)?, samples)?;
    let (end, reference) = (frames[frames.len() - 1], curve.euler_rodrigues_frame(1.0)?);
    case.compare("f2_end", vec![end.second.x, end.second.y, end.second.z]);
    case.compare("angle_from_erf", reference.angle_to(&end));
    let exact = curve.rotation_minimising_frame(1.0)?;
    case.require(
        exact.angle_to(&end).abs() < 1e-9,
        "quadrature and double reflection differ",
    );
    Ok(())
}
