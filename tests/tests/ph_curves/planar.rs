//! Dual curves, class-3 arcs, Tschirnhausen cubics and the approximation by them (items a, b, c, d).

use integration_tests::{Case, Tolerance};
use ph_curves::glam::{DVec2, DVec3};
use ph_curves::{
    Approximation, CubicPath, CurvatureElement, DualCurve, Error, EvoluteTriangle, G1Ends, G2Pair,
    Line, LineElement, Piece, PlaneCurve, TCubic, TQuartic, TQuarticCoefficients, approximate,
    breakpoints, similarity_centre,
};
use serde_json::{Value, json};

/// Answers the case if its kind is one of this file.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let result = match case.kind() {
        "dual_eval" | "dual_eval_curvature" => dual_eval(case),
        "dual_subdivide" => dual_subdivide(case),
        "dual_elevate" => {
            dual(case).map(|curve| case.compare("lines", vectors(curve.elevate().vectors())))
        }
        "dual_farin" => dual(case).map(|curve| case.compare("farin", vectors(&curve.farin()))),
        "dual_from_farin" => dual_from_farin(case),
        "dual_to_point_control" => dual_to_point_control(case),
        "dual_arc_length" => dual_arc_length(case),
        "tquartic_abgd" => tquartic_abgd(case),
        "tquartic_offset_abgd" => tquartic_offset_abgd(case),
        "admissible" => admissible(case),
        "g2_two_tquartics" => g2_two_tquartics(case),
        "theorem4" => theorem4(case),
        "spiral_error" => spiral_error(case),
        "curve_breakpoints" => curve_breakpoints(case),
        "g2_approximate" => g2_approximate(case),
        "class3_g1" => class3_g1(case),
        "class3_alpha_interval" => class3_alpha_interval(case),
        "class3_offset" => class3_offset(case),
        "class3_split" => class3_split(case),
        "t_connected" => t_connected(case),
        "tcubic_test" => tcubic_test(case),
        "tcubic_triangle" => tcubic_triangle(case),
        "parabola_caustic" => parabola_caustic(case),
        _ => return false,
    };
    if let Err(error) = result {
        case.refuse(&error.to_string(), |_| true);
    }
    true
}

/// A yes/no test on rounded data.
const RECOGNITION: f64 = 1e-9;

fn point(case: &Case<'_>, key: &str) -> DVec2 {
    let [x, y] = case
        .numbers(key)
        .try_into()
        .expect("a point has two coordinates");
    DVec2::new(x, y)
}

fn xy(p: DVec2) -> Value {
    json!([p.x, p.y])
}

fn points(all: &[DVec2]) -> Value {
    all.iter().map(|p| xy(*p)).collect()
}

fn vectors(all: &[DVec3]) -> Value {
    all.iter().map(|u| json!([u.x, u.y, u.z])).collect()
}

fn lines(case: &Case<'_>, key: &str) -> Result<Vec<Line>, Error> {
    case.rows(key)
        .iter()
        .map(|u| Line::new(u[0], u[1], u[2]))
        .collect()
}

fn dual(case: &Case<'_>) -> Result<DualCurve, Error> {
    DualCurve::new(&lines(case, "lines")?)
}

fn dual_eval(case: &Case<'_>) -> Result<(), Error> {
    let (curve, t) = (dual(case)?, case.number("t"));
    let contact = curve.contact(t)?;
    case.compare("point", xy(contact.point));
    case.compare("normal", xy(contact.normal));
    case.compare("support", contact.support);
    case.compare("radius", contact.radius);
    case.compare("turn", curve.turn(t));
    Ok(())
}

fn dual_to_point_control(case: &Case<'_>) -> Result<(), Error> {
    let curve = dual(case)?;
    let control = curve.point_control();
    case.compare("degree", control.len() - 1);
    case.compare("control", vectors(&control));
    let (reduced, factors) = curve.reduced_points();
    case.compare("common_factor_degree", factors.len());
    case.compare("reduced_degree", reduced.len() - 1);
    case.compare("inflection_parameters", factors);
    Ok(())
}

fn dual_arc_length(case: &Case<'_>) -> Result<(), Error> {
    case.compare("length", dual(case)?.length()?);
    Ok(())
}

fn dual_subdivide(case: &Case<'_>) -> Result<(), Error> {
    let (left, right) = dual(case)?.split(case.number("t"))?;
    case.compare("left", vectors(left.vectors()));
    case.compare("right", vectors(right.vectors()));
    Ok(())
}

fn dual_from_farin(case: &Case<'_>) -> Result<(), Error> {
    let curve = DualCurve::from_farin(&lines(case, "lines")?, &lines(case, "farin")?)?;
    case.compare("lines", vectors(curve.vectors()));
    Ok(())
}

fn ends(case: &Case<'_>) -> Result<G1Ends, Error> {
    let element = |p: &str, n: &str| LineElement::new(point(case, p), point(case, n));
    G1Ends::new(element("p0", "n0")?, element("p1", "n1")?)
}

fn class3_arc(case: &Case<'_>) -> Result<TQuartic, Error> {
    ends(case)?.arc(case.number("alpha"))
}

fn class3_g1(case: &Case<'_>) -> Result<(), Error> {
    let ends = ends(case)?;
    let arc = ends.arc(case.number("alpha"))?;
    let (w0, w1) = arc.spinors();
    // The spinors are defined up to a common sign; the file uses the principal root for w0.
    let sign = if w0.x < 0.0 || (w0.x == 0.0 && w0.y < 0.0) {
        -1.0
    } else {
        1.0
    };
    case.compare("w0", xy(w0 * sign));
    case.compare("w1", xy(w1 * sign));
    case.compare("g", arc.coefficients().to_vec());
    case.compare("lines", vectors(&arc.control_vectors()));
    let [r0, r1] = arc.end_radii();
    case.compare("radius0", r0);
    case.compare("radius1", r1);
    case.compare("mid_point_of_parameter_half", xy(arc.point(0.5)));
    case.compare("regular", r0 * r1 > 0.0);
    case.compare("length", arc.length());
    case.compare("circle", (r0 - r1).abs() <= RECOGNITION * r0.abs());
    Ok(())
}

fn class3_alpha_interval(case: &Case<'_>) -> Result<(), Error> {
    let ends = ends(case)?;
    let (low, high) = ends.regular_alphas()?;
    let bound = |alpha: f64| {
        if alpha.is_finite() {
            json!(alpha)
        } else {
            Value::Null
        }
    };
    case.compare("interval", json!([bound(low), bound(high)]));
    case.compare("legs", json!([ends.legs().0, ends.legs().1]));
    Ok(())
}

fn class3_offset(case: &Case<'_>) -> Result<(), Error> {
    let offset = class3_arc(case)?.offset(case.number("d"));
    case.compare("lines", vectors(&offset.control_vectors()));
    case.compare("point_half", xy(offset.point(0.5)));
    case.compare("radius0", offset.end_radii()[0]);
    case.compare("radius1", offset.end_radii()[1]);
    Ok(())
}

fn class3_split(case: &Case<'_>) -> Result<(), Error> {
    let (left, right) = class3_arc(case)?.split(case.number("t"))?;
    case.compare("left_alpha", left.alpha());
    case.compare("right_alpha", right.alpha());
    case.compare("left_lines", vectors(&left.control_vectors()));
    case.compare("right_lines", vectors(&right.control_vectors()));
    Ok(())
}

fn t_connected(case: &Case<'_>) -> Result<(), Error> {
    let connected = ends(case)?.t_connected([case.number("r0"), case.number("r1")], RECOGNITION);
    case.compare("connected", connected.is_some());
    if let Some(alpha) = connected {
        case.compare("alpha", alpha);
    }
    Ok(())
}

fn tcubic_test(case: &Case<'_>) -> Result<(), Error> {
    let control: Vec<DVec2> = case
        .rows("control")
        .iter()
        .map(|p| DVec2::new(p[0], p[1]))
        .collect();
    let cubic = TCubic::new(control.try_into().expect("four control points"));
    case.compare("is_tcubic", cubic.is_ok());
    if let Ok(cubic) = cubic {
        case.compare("length", cubic.length());
    }
    Ok(())
}

fn tcubic_triangle(case: &Case<'_>) -> Result<(), Error> {
    let b = point(case, "b");
    let cubic = TCubic::in_triangle(point(case, "a"), b, point(case, "c"))?;
    case.compare("e", xy(cubic.points()[1]));
    case.compare("f", xy(cubic.points()[2]));
    case.compare("m", (cubic.points()[1] - b).length());
    case.compare("length", cubic.length());
    Ok(())
}

fn parabola_caustic(case: &Case<'_>) -> Result<(), Error> {
    let cubic = TCubic::parabola_caustic(0.25, point(case, "direction"), 0.0, 1.0)?;
    case.compare("bezier_on_0_1", points(cubic.points()));
    case.compare("is_tcubic", TCubic::new(*cubic.points()).is_ok());
    case.seen("parabola");
    Ok(())
}

fn coefficients(case: &Case<'_>) -> TQuarticCoefficients {
    let [alpha, beta, gamma, delta] =
        ["alpha", "beta", "gamma", "delta"].map(|key| case.number(key));
    TQuarticCoefficients {
        alpha,
        beta,
        gamma,
        delta,
    }
}

fn tquartic_abgd(case: &Case<'_>) -> Result<(), Error> {
    let arc = coefficients(case).arc(case.number("t0"), case.number("t1"))?;
    let ends = [arc.contact(0.0), arc.contact(1.0)];
    for (index, end) in ends.iter().enumerate() {
        case.compare(&format!("p{index}"), xy(end.point));
        case.compare(&format!("n{index}"), xy(end.normal));
        case.compare(&format!("support{index}"), end.support);
        case.compare(&format!("radius{index}"), end.radius);
    }
    case.compare("shape_alpha", arc.alpha());
    case.compare("length", arc.length());
    Ok(())
}

fn tquartic_offset_abgd(case: &Case<'_>) -> Result<(), Error> {
    let offset = coefficients(case).offset(case.number("d"));
    for (key, value) in [
        ("alpha", offset.alpha),
        ("beta", offset.beta),
        ("gamma", offset.gamma),
        ("delta", offset.delta),
    ] {
        case.compare(key, value);
    }
    Ok(())
}

/// A radius, which may be the word "inf".
fn radius(case: &Case<'_>, key: &str) -> f64 {
    match case.get(key).and_then(Value::as_str) {
        Some("inf") => f64::INFINITY,
        Some("-inf") => f64::NEG_INFINITY,
        _ => case.number(key),
    }
}

fn elements(case: &Case<'_>) -> Result<[CurvatureElement; 2], Error> {
    let element = |p: &str, n: &str, r: &str| {
        CurvatureElement::new(point(case, p), point(case, n), radius(case, r))
    };
    Ok([element("p0", "n0", "r0")?, element("p1", "n1", "r1")?])
}

fn admissible(case: &Case<'_>) -> Result<(), Error> {
    let [start, end] = elements(case)?;
    let triangle = EvoluteTriangle::new(&start, &end)?;
    case.compare("admissible", triangle.is_admissible());
    case.compare("lambda0", triangle.lambda0);
    case.compare("lambda1", triangle.lambda1);
    case.compare("evolute_length", triangle.evolute_length);
    case.compare("centre_distance", triangle.centre_distance);
    Ok(())
}

fn g2_two_tquartics(case: &Case<'_>) -> Result<(), Error> {
    let [start, end] = elements(case)?;
    let pair = G2Pair::new(&start, &end, case.number("beta"))?;
    case.compare("admissible", true);
    case.compare("alpha", pair.alpha);
    case.compare("joint_evolute", xy(pair.joint.centre()));
    case.compare("joint_point", xy(pair.joint.point()));
    case.compare("joint_normal", xy(pair.joint.normal()));
    case.compare("joint_radius", pair.joint.radius());
    for (index, arc) in pair.arcs.iter().enumerate() {
        let unit: Vec<DVec3> = arc
            .control_vectors()
            .iter()
            .map(|u| *u / DVec2::new(u.y, u.z).length())
            .collect();
        case.compare(
            &format!("arc{}_lines_normalised", index + 1),
            vectors(&unit),
        );
        case.compare(&format!("shape_alpha{}", index + 1), arc.alpha());
    }
    Ok(())
}

fn theorem4(case: &Case<'_>) -> Result<(), Error> {
    let centre = similarity_centre(
        [point(case, "q0"), point(case, "q1")],
        [case.number("rho0"), case.number("rho1")],
    )?;
    case.compare("s", xy(centre));
    Ok(())
}

/// The file's logarithmic spiral: one pair on each of `pieces` equal steps, the largest support difference.
fn spiral_error(case: &Case<'_>) -> Result<(), Error> {
    /// Samples of a piece at which the error is measured.
    const SAMPLES: usize = 60;
    let (b, range) = (case.number("b"), case.numbers("theta"));
    let spiral = |theta: f64| {
        let r = (b * theta).exp();
        let normal = DVec2::new(1.0, -b)
            .rotate(DVec2::from_angle(theta))
            .normalize();
        (
            DVec2::from_angle(theta) * r,
            normal,
            r * (1.0 + b * b).sqrt(),
        )
    };
    let element = |theta: f64| {
        let (point, normal, radius) = spiral(theta);
        CurvatureElement::new(point, normal, radius)
    };
    let wanted = case.expected()["rows"]
        .as_array()
        .expect("rows of beta, pieces, error");
    let mut rows = Vec::new();
    for row in wanted {
        let (beta, pieces) = (
            row[0].as_f64().expect("beta"),
            row[1].as_u64().expect("pieces"),
        );
        let step = (range[1] - range[0]) / pieces as f64;
        let mut error = 0.0_f64;
        for k in 0..pieces {
            let start = range[0] + step * k as f64;
            let pair = G2Pair::new(&element(start)?, &element(start + step)?, beta)?;
            for sample in 1..SAMPLES {
                let (point, normal, _) = spiral(start + step * sample as f64 / SAMPLES as f64);
                let support = pair
                    .arcs
                    .iter()
                    .find_map(|arc| arc.parameter_of_normal(normal).map(|t| arc.support(t)))
                    .expect("a normal between the ends");
                error = error.max((support - normal.dot(point)).abs());
            }
        }
        rows.push(error);
    }
    // The tolerance of this kind is relative.
    let Tolerance::Componentwise(relative) = case.tolerance() else {
        unreachable!("set by the reader")
    };
    for (row, error) in wanted.iter().zip(rows) {
        let want = row[2].as_f64().expect("an error");
        case.require(
            (error - want).abs() <= relative * want,
            &format!("row {row}: {error}"),
        );
    }
    case.seen("rows");
    Ok(())
}

fn bspline(case: &Case<'_>) -> Result<CubicPath, Error> {
    let control: Vec<DVec2> = case
        .rows("cubic_uniform_bspline")
        .iter()
        .map(|p| DVec2::new(p[0], p[1]))
        .collect();
    CubicPath::uniform_bspline(&control, false)
}

fn curve_breakpoints(case: &Case<'_>) -> Result<(), Error> {
    let found = breakpoints(&bspline(case)?)?;
    case.compare("inflections", found.inflections);
    case.compare("vertices", found.vertices);
    Ok(())
}

fn g2_approximate(case: &Case<'_>) -> Result<(), Error> {
    /// Samples of a source interval at which the support difference is measured.
    const SAMPLES: usize = 50;
    let curve = bspline(case)?;
    let result = approximate(&curve, &Approximation::quartics(case.number("tolerance")))?;
    let arcs: Vec<(TQuartic, [f64; 2])> = result
        .spline
        .pieces()
        .iter()
        .zip(&result.sources)
        .filter_map(|(piece, source)| match piece {
            Piece::Arc(arc) => Some((arc.arc(), *source)),
            _ => None,
        })
        .collect();
    let mut error = 0.0_f64;
    for (arc, source) in &arcs {
        for sample in 1..SAMPLES {
            let parameter = source[0] + (source[1] - source[0]) * sample as f64 / SAMPLES as f64;
            let span = (parameter as usize).min(curve.spans() - 1);
            let [point, first, _] = curve.jet(span, parameter - span as f64);
            let normal = -first.normalize().perp();
            // The arcs of a pair share their source; each answers for its own normals.
            if let Some(t) = arc.parameter_of_normal(normal) {
                error = error.max((arc.support(t) - normal.dot(point)).abs());
            }
        }
    }
    let most = case.expected()["max_support_error_at_most"]
        .as_f64()
        .expect("a bound");
    case.require(
        error <= most,
        &format!("support error {error} above {most}"),
    );
    case.require(
        error > 0.0 && result.error <= most,
        "the reported error is above the bound",
    );
    let count = case.expected()["arcs_at_most"].as_u64().expect("a bound") as usize;
    case.require(
        result.spline.pieces().len() <= count,
        &format!("{} arcs", result.spline.pieces().len()),
    );
    let regular = arcs.iter().all(|(arc, _)| {
        let [r0, r1] = arc.end_radii();
        r0 * r1 > 0.0
    });
    case.compare("all_regular", regular);
    for key in [
        "max_support_error_at_most",
        "arcs_at_most",
        "reference_arcs",
    ] {
        case.seen(key);
    }
    Ok(())
}
