//! Exact distances, smooth surfaces and surfaces of revolution.

use bezier_mass::{BezierPatch, MassPoint};
use geodesic::glam::{DVec2, DVec3};
use geodesic::{
    Error, Mesh, PatchLevels, SmoothSurface, SurfacePoint, SurfaceRay, Sweep, TorusSurface,
    closed_torus_geodesic, geodesic_between, trace_smooth,
};
use integration_tests::{Case, Tolerance};

/// The exact distance, where the file states it.
pub(crate) fn shortest(case: &Case<'_>, mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) {
    case.seen("exact_shortest");
    case.seen("closed_form");
    let mut sweep = Sweep::new(mesh);
    let found = sweep
        .shortest_path(from, to)
        .and_then(|path| Ok((path.length(), sweep.distance(from, to)?)));
    for key in ["exact_shortest", "closed_form"] {
        if !case.expected()[key].is_number() {
            continue;
        }
        match &found {
            Ok((traced, distance)) => {
                case.compare(key, *distance);
                case.compare(key, *traced);
            }
            Err(error) => case.fail(format!("{key}: {error}")),
        }
    }
}

/// Answers a case, or says that its kind is another's.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let answered = match case.kind() {
        "parametric_geodesic" => parametric_geodesic(case),
        "torus_closed_geodesic" => torus_closed_geodesic(case),
        "surface_ivp" => surface_ivp(case),
        _ => return false,
    };
    if let Err(error) = answered {
        case.refuse(&error.to_string(), |_| true);
    }
    true
}

fn pair(case: &Case<'_>, key: &str) -> DVec2 {
    let numbers = case.numbers(key);
    DVec2::new(numbers[0], numbers[1])
}

/// The control net of a case: that of one Bézier patch, or of an array of them.
fn net(case: &Case<'_>) -> Vec<Vec<MassPoint<DVec3>>> {
    let net = case.input()["control_net"]
        .as_array()
        .expect("a control net");
    let weights = case.get("weights").and_then(integration_tests::rows);
    net.iter()
        .enumerate()
        .map(|(i, row)| {
            let points = integration_tests::rows(row).expect("a row of points");
            let weight = |j: usize| weights.as_ref().map_or(1.0, |rows| rows[i][j]);
            let mass = |(j, p): (usize, &Vec<f64>)| {
                MassPoint::point(DVec3::new(p[0], p[1], p[2]), weight(j))
            };
            points.iter().enumerate().map(mass).collect()
        })
        .collect()
}

fn parametric_geodesic(case: &Case<'_>) -> Result<(), Error> {
    let net = net(case);
    let degrees = case.numbers("degree");
    let degrees = [degrees[0] as usize, degrees[1] as usize];
    let (from, to) = (pair(case, "start_uv"), pair(case, "end_uv"));
    let levels = PatchLevels::of_patches(degrees, &net)?;
    let paths = levels.paths(from, to, case.number("levels") as usize)?;
    let lengths: Vec<f64> = paths.iter().map(|path| path.length).collect();
    case.compare("lengths", lengths.clone());
    case.compare(
        "faces",
        paths.iter().map(|path| path.faces).collect::<Vec<_>>(),
    );
    // What follows is derived from the lengths and the file's own reference.
    case.seen("reference_length");
    let Some(reference) = case.expected()["reference_length"].as_f64() else {
        return Ok(());
    };
    // The differential equation agrees, where its geodesic stays on the patch.
    if let Ok(patch) = BezierPatch::from_rows(&net)
        && patch.degrees() == degrees
        && let Some(path) = paths.last()
    {
        let smooth = geodesic_between(&patch, &path.parameters, 1e-10)?;
        if smooth.inside {
            case.compare_within("reference_length", smooth.length, Tolerance::Absolute(1e-6));
        }
    }
    let errors: Vec<f64> = lengths.iter().map(|length| length - reference).collect();
    if case.expected()["errors"].is_array() {
        case.compare("errors", errors.clone());
    }
    if case.expected()["last_order"].is_number() {
        let order = (errors[errors.len() - 2] / errors[errors.len() - 1]).log2();
        case.compare_within("last_order", order, Tolerance::Absolute(1e-4));
    }
    Ok(())
}

fn torus_closed_geodesic(case: &Case<'_>) -> Result<(), Error> {
    let (p, q) = (case.number("p") as u32, case.number("q") as u32);
    let closed = closed_torus_geodesic(case.number("R"), case.number("r"), p, q)?;
    case.compare("clairaut_constant", closed.clairaut);
    case.compare("length", closed.length);
    Ok(())
}

fn surface_ivp(case: &Case<'_>) -> Result<(), Error> {
    let torus = TorusSurface {
        major: case.number("R"),
        minor: case.number("r"),
    };
    let start = SurfaceRay {
        uv: pair(case, "uv"),
        direction: pair(case, "duv"),
    };
    let end = trace_smooth(&torus, start, case.number("length"), 1e-13)?;
    let point = torus.jet(end.uv).point;
    case.compare("end_uv", vec![end.uv.x, end.uv.y]);
    case.compare("end_point", vec![point.x, point.y, point.z]);
    case.compare("clairaut", torus.clairaut(start.uv, start.direction));
    case.compare("clairaut_at_end", torus.clairaut(end.uv, end.direction));
    Ok(())
}
