//! Items e to j of the reference file: ribbons, surfaces through two curves, rectangles, triangles, Bézier patches.

use bezier_mass::{BezierCurve, MassPoint};
use core::array::from_fn;
use glam::{DVec2, DVec3};
use integration_tests::{Case, Tolerance, judge, list_at, number, numbers, read, rows};
use reconstruct::{
    AnalyticCurve, BezierStrip, CornerData, Corners, Criterion, Curve, Degree7Shape, EndCondition,
    EndField, EndInvariants, Error, FrenetFrame, GeodesicStrip, HermiteArc, PlanarRibbon,
    Rectangle, RibbonLayout, ScalarFunction, Sensor, SensorKind, Series, SpatialRibbon, Strip,
    Surface, TangentMethod, ThirdDerivative, Triangle, TwoCurveSurface, Violation, WorldFields,
    barycentric_gradients, boundary_geodesic_curvature, check_rectangle, crossing_residual,
    degree7_boundaries, geodesic_curvature, quintic_end_invariants, quintic_weights,
};
use serde_json::{Map, Value, json};

#[test]
fn fixtures_geodesic_and_reconstruction_surfaces() {
    let file = read("geodesic-and-reconstruction");
    let all = list_at(&file, "cases");
    // Items a to d, and unknown ones, are judged with the paths.
    let items = ["e", "f", "g", "h", "i", "j"];
    let mine: Vec<&Value> = all
        .iter()
        .filter(|case| items.contains(&case["item"].as_str().unwrap_or_default()))
        .collect();
    if mine.is_empty() && !all.is_empty() {
        println!("reconstruction: the file holds paths only");
        return;
    }
    let cases = mine.into_iter().map(|case| {
        let text = |key: &str| case[key].as_str().unwrap_or_default();
        let tolerance = Tolerance::ComponentwiseMax(case["tol"].as_f64().unwrap_or(0.0));
        Case::new(text("name"), text("kind"), &case["input"])
            .expecting(&case["expected"], tolerance)
    });
    judge("reconstruction", cases, |case| {
        case.seen("note");
        match case.kind() {
            "planar_ribbon" => planar_ribbon(case),
            "spatial_ribbon" => spatial_ribbon(case),
            "sensors_to_tangents" => sensors_to_tangents(case),
            "two_curve_surface" => two_curve_surface(case),
            "hermite_bending" => hermite_bending(case),
            "crossing_identity" => crossing_identity(case),
            "check_rectangle" => check(case),
            "coons_rectangle" => coons_rectangle(case),
            "coons_optimise" => coons_optimise(case),
            "degree7_boundaries" => degree7(case),
            "bezier_patch" => bezier_patch(case),
            "rational5_weights" => rational5_weights(case),
            "rational_end" => rational_end(case),
            "triangle_patch" => triangle_patch(case),
            "barycentric_gradients" => gradients(case),
            _ => case.unknown_kind(),
        }
    });
}

fn vector(row: &[f64]) -> DVec3 {
    DVec3::from_slice(row)
}

fn vectors(case: &Case<'_>, key: &str) -> Vec<DVec3> {
    case.rows(key).iter().map(|row| vector(row)).collect()
}

fn point(case: &Case<'_>, key: &str) -> DVec3 {
    vector(&case.numbers(key))
}

fn lists(points: impl IntoIterator<Item = DVec3>) -> Value {
    points.into_iter().map(|p| json!(p.to_array())).collect()
}

fn word<'a>(case: &Case<'a>, key: &str) -> &'a str {
    case.get(key).and_then(Value::as_str).unwrap_or_default()
}

/// The parameters at which the file states points: part of what it expects.
fn places(case: &Case<'_>, key: &str) -> Vec<Vec<f64>> {
    case.seen(key);
    case.expected()
        .get(key)
        .or(case.get(key))
        .and_then(rows)
        .expect("places of the points")
}

/// Whether the words of the file mean this error.
fn means(error: &Error, words: &str) -> bool {
    let has = |parts: &[&str]| parts.iter().any(|part| words.contains(part));
    match error {
        Error::NotIncreasing { .. } => has(&["increas"]),
        Error::AntipodalTangents { .. } => has(&["antipodal"]),
        Error::TooFew { .. } => has(&["few", "at least"]),
        Error::ZeroVector { .. } => has(&["zero"]),
        Error::NonFinite { .. } => has(&["finite", "NaN", "nan"]),
        Error::NotUniform { .. } => has(&["uniform", "spac"]),
        Error::TangentLost { .. } => has(&["near 0", "near zero", "vanish"]),
        Error::LengthMismatch { .. } => has(&["length", "number", "match", "differ"]),
        Error::AmbiguousTurn { .. } => has(&["jump", "ambig", "half"]),
        Error::ParallelFields { .. } => has(&["parallel"]),
        Error::TorsionSign { .. } => has(&["torsion"]),
        Error::Inflection { .. } => has(&["inflection", "straight", "collinear"]),
        Error::Conditions(violations) => violations
            .first()
            .is_some_and(|first| words.contains(first.name())),
        Error::IrregularBoundary { .. } => has(&["irregular"]),
        Error::CornerData { .. } => has(&["corner", "tangent", "normal", "curvature", "parallel"]),
        Error::DegenerateEnergy => has(&["degenerate", "positive definite"]),
        Error::Bezier(_) => has(&["finite", "NaN", "nan", "weight"]),
        Error::OutOfRange { .. } => has(&["positive", "range", "weight", "curvature"]),
        Error::Reading { .. } => has(&["reading", "satur", "field", "finite"]),
        _ => false,
    }
}

fn refuse(case: &Case<'_>, error: &Error) {
    case.refuse(&error.to_string(), |words| means(error, words));
}

/// The value, or the refusal in the crate's words.
fn or_refuse<T>(case: &Case<'_>, result: Result<T, Error>) -> Option<T> {
    result.inspect_err(|error| refuse(case, error)).ok()
}

fn end_condition(case: &Case<'_>) -> EndCondition {
    match word(case, "end_condition") {
        "natural" => EndCondition::Natural,
        "not-a-knot" => EndCondition::NotAKnot,
        other => panic!("end condition {other}"),
    }
}

fn planar_ribbon(case: &Case<'_>) {
    match PlanarRibbon::new(
        &case.numbers("s"),
        &case.numbers("alpha"),
        end_condition(case),
    ) {
        Ok(ribbon) => {
            let points: Value = ribbon
                .points()
                .iter()
                .map(|p| json!(p.to_array()))
                .collect();
            case.compare("points", points);
        }
        Err(error) => refuse(case, &error),
    }
}

fn spatial_ribbon(case: &Case<'_>) {
    let method = match word(case, "method") {
        "projected" => TangentMethod::Projected,
        "slerp-bspline" => TangentMethod::SphericalSpline,
        other => panic!("method {other}"),
    };
    let (s, tangents) = (case.numbers("s"), vectors(case, "tangents"));
    match SpatialRibbon::with_method(&s, &tangents, method, end_condition(case)) {
        Ok(ribbon) => {
            case.compare("points", lists(ribbon.points().iter().copied()));
            case.compare("end", json!(ribbon.points()[s.len() - 1].to_array()));
            // The end of the smooth curve that the data come from; not to be met.
            case.seen("exact_end");
        }
        Err(error) => refuse(case, &error),
    }
}

fn sensors_to_tangents(case: &Case<'_>) {
    let rows_read = case.rows("readings");
    let kinds = word(case, "kind")
        .chars()
        .zip(&rows_read)
        .map(|(kind, row)| match (kind, row.len()) {
            ('a', 3) => SensorKind::Accelerometer,
            ('m', 3) => SensorKind::Magnetometer,
            ('m', 2) => SensorKind::MagnetometerTwoAxis,
            other => panic!("sensor kind {other:?}"),
        });
    let readings: Vec<DVec3> = rows_read
        .iter()
        .map(|r| DVec3::new(r[0], r[1], r.get(2).copied().unwrap_or(0.0)))
        .collect();
    let sensors = case
        .numbers("s")
        .into_iter()
        .zip(kinds)
        .map(|(s, kind)| Sensor::new(s, kind));
    let found = WorldFields::new(point(case, "up"), point(case, "magnetic"))
        .and_then(|world| RibbonLayout::new(sensors, world))
        .and_then(|layout| layout.tangents(&readings));
    match found {
        Ok(tangents) => {
            case.compare("tangents", lists(tangents.values().iter().copied()));
            case.seen("true_tangents");
            if let Some(truth) = case.expected().get("true_tangents").and_then(rows) {
                let pairs = tangents
                    .values()
                    .iter()
                    .zip(truth.iter().map(|row| vector(row)));
                let largest = pairs
                    .map(|(a, b)| a.cross(b).length().atan2(a.dot(b)))
                    .fold(0.0, f64::max);
                case.compare("max_angle_error", largest);
            }
        }
        Err(error) => refuse(case, &error),
    }
}

/// A function of `u` read from a formula such as `0.3 sin u` or `1.5 + -0.2 u`.
#[derive(Clone, Debug)]
enum Formula {
    Number(f64),
    Parameter,
    Call(String, Box<Formula>),
    Binary(char, Box<Formula>, Box<Formula>),
}

impl Formula {
    fn read(text: &str) -> Self {
        let characters: Vec<char> = text.chars().collect();
        let mut tokens: Vec<String> = Vec::new();
        let mut i = 0;
        while i < characters.len() {
            let start = i;
            let numeric = |c: char| c.is_ascii_digit() || c == '.';
            i += 1;
            if numeric(characters[start]) {
                while i < characters.len() && numeric(characters[i]) {
                    i += 1;
                }
            } else if characters[start].is_alphabetic() {
                while i < characters.len() && characters[i].is_alphabetic() {
                    i += 1;
                }
            }
            let token: String = characters[start..i].iter().collect();
            if !token.trim().is_empty() {
                tokens.push(token);
            }
        }
        let mut parser = Parser { tokens, at: 0 };
        let formula = parser.sum();
        assert_eq!(parser.at, parser.tokens.len(), "formula {text}");
        formula
    }

    fn value(&self, u: Series) -> Series {
        match self {
            Self::Number(value) => Series::constant(*value),
            Self::Parameter => u,
            Self::Call(name, argument) => {
                let x = argument.value(u);
                match name.as_str() {
                    "sin" => x.sin(),
                    "cos" => x.cos(),
                    "exp" => x.exp(),
                    "sqrt" => x.sqrt(),
                    other => panic!("function {other}"),
                }
            }
            Self::Binary(operator, a, b) => {
                let (a, b) = (a.value(u), b.value(u));
                match operator {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    '^' => (1..b.value() as usize).fold(a, |power, _| power * a),
                    other => panic!("operator {other}"),
                }
            }
        }
    }
}

/// Recursive descent; factors side by side are multiplied.
struct Parser {
    tokens: Vec<String>,
    at: usize,
}

impl Parser {
    fn peek(&self) -> &str {
        self.tokens.get(self.at).map_or("", String::as_str)
    }

    fn take(&mut self) -> String {
        self.at += 1;
        self.tokens.get(self.at - 1).cloned().unwrap_or_default()
    }

    fn sum(&mut self) -> Formula {
        let mut left = self.product();
        while matches!(self.peek(), "+" | "-") {
            let operator = if self.take() == "+" { '+' } else { '-' };
            left = Formula::Binary(operator, Box::new(left), Box::new(self.product()));
        }
        left
    }

    fn product(&mut self) -> Formula {
        let mut left = self.power();
        loop {
            let operator = match self.peek() {
                "" | "+" | "-" | ")" => return left,
                "/" => '/',
                _ => '*',
            };
            if matches!(self.peek(), "*" | "/") {
                self.at += 1;
            }
            left = Formula::Binary(operator, Box::new(left), Box::new(self.power()));
        }
    }

    fn power(&mut self) -> Formula {
        let base = self.atom();
        if self.peek() == "^" {
            self.at += 1;
            return Formula::Binary('^', Box::new(base), Box::new(self.atom()));
        }
        base
    }

    fn atom(&mut self) -> Formula {
        let token = self.take();
        match token.as_str() {
            "-" => Formula::Binary('-', Box::new(Formula::Number(0.0)), Box::new(self.power())),
            "+" => self.power(),
            "(" => {
                let inner = self.sum();
                assert_eq!(self.take(), ")");
                inner
            }
            "u" | "t" => Formula::Parameter,
            "pi" => Formula::Number(core::f64::consts::PI),
            name if name.chars().all(char::is_alphabetic) => {
                Formula::Call(name.to_owned(), Box::new(self.power()))
            }
            number => Formula::Number(number.parse().unwrap_or_else(|_| panic!("number {number}"))),
        }
    }
}

fn formula(case: &Case<'_>, key: &str) -> ScalarFunction {
    let value = case.get(key).unwrap_or_else(|| panic!("no {key}"));
    if let Some(constant) = value.as_f64() {
        return constant.into();
    }
    let formula = Formula::read(value.as_str().unwrap_or_default());
    ScalarFunction::formula(move |u| formula.value(u))
}

/// The strip of the curve with these coordinate formulas whose vector across has a positive z component.
fn upward_strip(case: &Case<'_>, key: &str) -> Result<GeodesicStrip, Error> {
    let text = word(case, key).trim();
    let inner = text
        .strip_prefix('(')
        .and_then(|t| t.strip_suffix(')'))
        .expect("coordinates in parentheses");
    let parts: Vec<Formula> = inner.split(',').map(Formula::read).collect();
    let parts: [Formula; 3] = parts.try_into().expect("three coordinates");
    let curve = AnalyticCurve::new(move |u| from_fn(|k| parts[k].value(u)));
    let strip = GeodesicStrip::new(curve)?;
    Ok(if strip.sample(0.5).across[0].z < 0.0 {
        strip.flipped()
    } else {
        strip
    })
}

fn two_curve_surface(case: &Case<'_>) {
    assert!(
        word(case, "binormals").contains("positive z"),
        "binormals are chosen otherwise"
    );
    let field = |i: usize| EndField::Polar {
        angle: formula(case, &format!("alpha{i}")),
        length: formula(case, &format!("lambda{i}")),
    };
    let strips = upward_strip(case, "f0").and_then(|f0| Ok([f0, upward_strip(case, "f1")?]));
    let Some(strips) = or_refuse(case, strips) else {
        return;
    };
    let surface = TwoCurveSurface::from_oriented(strips)
        .unwrap()
        .with_fields([field(0), field(1)]);
    let uv = places(case, "uv");
    case.compare(
        "points",
        lists(uv.iter().map(|p| surface.point(p[0], p[1]))),
    );
    let curvature = |u: f64, v: f64| {
        let at = surface.partials(u, v);
        geodesic_curvature(at.du, at.duu, at.du.cross(at.dv)).abs()
    };
    let worst = uv
        .iter()
        .map(|p| curvature(p[0], 0.0).max(curvature(p[0], 1.0)))
        .fold(0.0, f64::max);
    case.compare("geodesic_curvature_of_both_curves", worst);
}

fn hermite_bending(case: &Case<'_>) {
    let [p0, p1, t0, t1] = ["P0", "P1", "T0", "T1"].map(|key| point(case, key));
    let minimum = HermiteArc::new([p0, p1], [t0, t1]).least_bending();
    case.compare("lambda0", minimum.magnitudes[0]);
    case.compare("lambda1", minimum.magnitudes[1]);
    case.compare("energy", minimum.energy);
}

fn crossing_identity(case: &Case<'_>) {
    let frame = |i: usize| {
        let get = |name: &str| point(case, &format!("{name}{i}"));
        let (tangent, normal) = (get("e"), get("n"));
        FrenetFrame {
            point: DVec3::ZERO,
            tangent,
            normal,
            binormal: tangent.cross(normal),
            curvature: case.number(&format!("k{i}")),
            torsion: case.number(&format!("tau{i}")),
            speed: 1.0,
        }
    };
    let (normal, first, second) = (point(case, "N"), frame(1), frame(2));
    case.compare("residual", crossing_residual(normal, &first, &second));
    let flipped = FrenetFrame {
        torsion: -second.torsion,
        ..second
    };
    case.compare(
        "residual_if_tau2_sign_flipped",
        crossing_residual(normal, &first, &flipped),
    );
}

/// Geodesics of the unit cylinder or sphere between pairs of corners.
fn analytic_strips<const N: usize>(
    case: &Case<'_>,
    pairs: [[usize; 2]; N],
) -> Result<[GeodesicStrip; N], Error> {
    let kind = word(case, "curves");
    let keys = ["corners_theta_z", "corners", "vertices"];
    let corners = keys
        .into_iter()
        .find_map(|key| case.get(key))
        .and_then(rows)
        .expect("corners");
    let strip = |[a, b]: [usize; 2]| {
        let (a, b) = (corners[a].clone(), corners[b].clone());
        if kind.contains("cylinder") {
            GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
                let [theta, z] = [0, 1].map(|k| t * (b[k] - a[k]) + a[k]);
                let (sin, cos) = theta.sin_cos();
                [cos, sin, z]
            }))
        } else {
            assert!(
                kind.contains("sphere") || kind.contains("great"),
                "curves {kind}"
            );
            let (a, b) = (vector(&a).normalize(), vector(&b).normalize());
            let across = (b - a * a.dot(b)).normalize();
            let angle = a.cross(b).length().atan2(a.dot(b));
            GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
                let (sin, cos) = (t * angle).sin_cos();
                from_fn(|k| cos * a[k] + sin * across[k])
            }))
        }
    };
    collected(pairs.into_iter().map(strip))
}

/// As many strips as are asked for, or the first refusal.
fn collected<S, const N: usize>(
    strips: impl Iterator<Item = Result<S, Error>>,
) -> Result<[S; N], Error> {
    let strips: Vec<S> = strips.collect::<Result<_, _>>()?;
    Ok(strips
        .try_into()
        .unwrap_or_else(|_| panic!("another number of curves")))
}

/// `r1, r2, r3, r4` between the corners 00, 10, 01, 11.
const RECTANGLE: [[usize; 2]; 4] = [[0, 1], [0, 2], [2, 3], [1, 3]];
const NAMES: [&str; 4] = ["00", "10", "01", "11"];

fn bezier_strips(case: &Case<'_>, key: &str) -> Result<[BezierStrip; 4], Error> {
    let nets = case
        .get(key)
        .and_then(Value::as_array)
        .expect("control points");
    let strip = |net: &Value| {
        let points: Vec<DVec3> = rows(net)
            .expect("points")
            .iter()
            .map(|row| vector(row))
            .collect();
        BezierStrip::new(BezierCurve::polynomial(&points)?)
    };
    collected(nets.iter().map(strip))
}

fn check(case: &Case<'_>) {
    let Tolerance::ComponentwiseMax(tolerance) = case.tolerance() else {
        panic!("tolerance")
    };
    let report = if case.get("control_points").is_some() {
        bezier_strips(case, "control_points").map(|strips| check_rectangle(&strips, tolerance))
    } else {
        analytic_strips(case, RECTANGLE).map(|strips| check_rectangle(&strips, tolerance))
    };
    let Some(report) = or_refuse(case, report) else {
        return;
    };
    case.compare("reversals", report.reversals);
    let wanted_words = case.expected()["errors"].to_string();
    let entry = |violation: &Violation| match violation {
        Violation::C2 { reversals } => json!(["C2", reversals]),
        // The specification calls it an inflection at the corner.
        Violation::InflectionAtCorner { corner, .. }
            if wanted_words.contains("inflection at corner") =>
        {
            json!(["inflection at corner", corner.to_string()])
        }
        other => json!([
            other.name(),
            other.corner().map(|corner| corner.to_string())
        ]),
    };
    case.compare(
        "errors",
        report.violations.iter().map(entry).collect::<Value>(),
    );
}

fn coons_rectangle(case: &Case<'_>) {
    let twists = case.rows("twist_components");
    let built = analytic_strips(case, RECTANGLE).and_then(|strips| {
        let rectangle = Rectangle::new(strips)?;
        let patch = rectangle.patch(from_fn(|k| [twists[k][0], twists[k][1]]))?;
        Ok((rectangle.twist_normals(), patch))
    });
    let Some((normals, patch)) = or_refuse(case, built) else {
        return;
    };
    case.compare(
        "points",
        lists(places(case, "uv").iter().map(|p| patch.point(p[0], p[1]))),
    );
    let named: Map<String, Value> = (0..4)
        .map(|k| (NAMES[k].to_owned(), json!(normals[k])))
        .collect();
    case.compare("corner_twist_normal_component", named);
    case.compare("dirichlet", patch.energy(Criterion::Dirichlet));
    case.compare("thinplate", patch.energy(Criterion::ThinPlate));
    case.compare("speed_variation", patch.energy(Criterion::SpeedVariation));
    geodesic_boundaries(case, &patch);
}

/// Sharper than the file: the boundary curves have exact derivatives here.
fn geodesic_boundaries(case: &Case<'_>, patch: &impl Surface) {
    let curvature = boundary_geodesic_curvature(patch, 40);
    case.compare("max_boundary_geodesic_curvature", curvature);
    case.require(curvature < 1e-8, "a boundary is no geodesic");
}

fn criterion(case: &Case<'_>) -> Criterion {
    match word(case, "energy") {
        "dirichlet" => Criterion::Dirichlet,
        "thinplate" => Criterion::ThinPlate,
        "speed" | "speed_variation" => Criterion::SpeedVariation,
        other => panic!("energy {other}"),
    }
}

fn coons_optimise(case: &Case<'_>) {
    let smoothed = analytic_strips(case, RECTANGLE)
        .and_then(Rectangle::new)
        .and_then(|rectangle| rectangle.least_energy(criterion(case)));
    let Some(smoothed) = or_refuse(case, smoothed) else {
        return;
    };
    case.compare("twist_components", json!(smoothed.patch.twists()));
    case.compare("energy", smoothed.energy);
    case.compare("energy_at_zero", smoothed.energy_at_zero);
    case.compare("normal_matrix_eigenvalues", json!(smoothed.eigenvalues));
    case.compare(
        "point_centre",
        json!(smoothed.patch.point(0.5, 0.5).to_array()),
    );
    geodesic_boundaries(case, &smoothed.patch);
}

fn corner_data(case: &Case<'_>) -> Result<Corners, Error> {
    let get = |key: &str, name: &str| {
        case.get(key)
            .and_then(|map| map.get(name))
            .unwrap_or_else(|| panic!("{key} {name}"))
    };
    let sign = case.number("principal_normal_sign");
    let at = |i: usize, j: usize| {
        let name = format!("{i}{j}");
        let direction = |key: &str| vector(&numbers(get(key, &name)).expect("a vector"));
        let curvature = |key: &str| sign * number(get(key, &name)).expect("a number");
        CornerData::new(
            direction("corners"),
            direction("normals"),
            [direction("tangent_u"), direction("tangent_v")],
            [curvature("curvature_u"), curvature("curvature_v")],
        )
    };
    Ok([[at(0, 0)?, at(0, 1)?], [at(1, 0)?, at(1, 1)?]])
}

fn positions(control: &[MassPoint<DVec3>]) -> Value {
    lists(control.iter().filter_map(|h| h.position()))
}

fn degree7(case: &Case<'_>) {
    let free = case.numbers("third_derivative_tangential_and_normal");
    assert!(
        word(case, "torsion_rule").contains("equal split"),
        "another split of the torsions"
    );
    let shape = Degree7Shape {
        speed: case.get("speed").and_then(number),
        speed_derivative: case.number("speed_derivative"),
        third_derivative: ThirdDerivative::Given([free[0], free[1]]),
    };
    let built =
        corner_data(case).and_then(|corners| Ok((corners, degree7_boundaries(&corners, &shape)?)));
    let Some((corners, curves)) = or_refuse(case, built) else {
        return;
    };
    case.compare(
        "control_points",
        curves
            .iter()
            .map(|curve| positions(curve.control()))
            .collect::<Value>(),
    );
    let torsion = |k: usize| {
        (
            NAMES[k].to_owned(),
            json!(corners[k % 2][k / 2].torsions()[0]),
        )
    };
    case.compare("torsions", (0..4).map(torsion).collect::<Map<_, _>>());
    let report = check_rectangle(
        &curves.map(|curve| BezierStrip::new(curve).expect("curvature")),
        1e-8,
    );
    case.compare(
        "check_errors",
        report
            .violations
            .iter()
            .map(|v| json!([v.name()]))
            .collect::<Value>(),
    );
    case.compare("reversals", report.reversals);
}

fn bezier_patch(case: &Case<'_>) {
    // The reference is the free minimum, whether or not it is regular at the boundary.
    let smoothed = bezier_strips(case, "boundary_control_points")
        .and_then(Rectangle::new)
        .and_then(|rectangle| rectangle.least_energy(criterion(case)));
    let Some(smoothed) = or_refuse(case, smoothed) else {
        return;
    };
    let bezier = smoothed.patch.to_bezier().expect("finite control points");
    case.compare("bidegree", json!(bezier.degrees()));
    case.compare("twist_components", json!(smoothed.patch.twists()));
    case.compare("energy", smoothed.energy);
    case.compare("energy_at_zero", smoothed.energy_at_zero);
    case.compare(
        "control_net",
        bezier.rows().map(positions).collect::<Value>(),
    );
    geodesic_boundaries(case, &bezier);
    case.seen("xy_hermite_bernstein_note");
}

fn six_points(case: &Case<'_>) -> [DVec3; 6] {
    vectors(case, "control_points")
        .try_into()
        .expect("six points")
}

fn rational5_weights(case: &Case<'_>) {
    let end = |i: usize| EndInvariants {
        curvature: case.number(&format!("k{i}")),
        torsion: case.number(&format!("tau{i}")),
    };
    match quintic_weights(&six_points(case), [end(0), end(1)]) {
        Ok(weights) => case.compare("weights", json!(weights)),
        Err(error) => refuse(case, &error),
    }
}

fn rational_end(case: &Case<'_>) {
    let (points, weights) = (
        six_points(case),
        case.numbers("weights").try_into().expect("six weights"),
    );
    let ends = match quintic_end_invariants(&points, &weights) {
        Ok(ends) => ends,
        Err(error) => return refuse(case, &error),
    };
    let control = points
        .iter()
        .zip(weights)
        .map(|(p, w)| MassPoint::point(*p, w))
        .collect();
    let curve = BezierCurve::new(control).expect("a curve");
    for (i, end) in ends.iter().enumerate() {
        case.compare(&format!("k{i}"), end.curvature);
        case.compare(&format!("tau{i}"), end.torsion);
        // The formulas against the derivatives of the curve.
        let frame = FrenetFrame::of(&curve.series(i as f64), i as f64).expect("a frame");
        let curvature = (frame.curvature - end.curvature).abs() < 1e-11 * (1.0 + end.curvature);
        case.require(curvature, "the curvature differs from the curve's");
        let torsion = (frame.torsion - end.torsion).abs() < 1e-10 * (1.0 + end.torsion.abs());
        case.require(torsion, "the torsion differs from the curve's");
    }
}

fn triangle_patch(case: &Case<'_>) {
    let twists = case.rows("twist_components");
    let built = analytic_strips(case, [[1, 2], [2, 0], [0, 1]]).and_then(|strips| {
        let triangle = Triangle::new(strips)?;
        let patch = triangle.patch(from_fn(|k| [twists[k][0], twists[k][1]]))?;
        Ok((triangle, patch))
    });
    let Some((triangle, patch)) = or_refuse(case, built) else {
        return;
    };
    case.compare(
        "points",
        lists(
            places(case, "bary")
                .iter()
                .map(|l| patch.at([l[0], l[1], l[2]])),
        ),
    );
    case.compare("corner_angles", json!(triangle.interior_angles()));
    case.compare("total_curvature", triangle.total_curvature());
    case.compare("corner_normal_twists", json!(triangle.twist_normals()));
    case.require(
        patch.boundary_geodesic_curvature(40) < 1e-8,
        "a side is no geodesic",
    );
}

fn gradients(case: &Case<'_>) {
    let corners: Vec<DVec2> = case
        .rows("triangle")
        .iter()
        .map(|p| DVec2::from_slice(p))
        .collect();
    let gradients = barycentric_gradients(corners.try_into().expect("three corners"));
    let Some(gradients) = or_refuse(case, gradients) else {
        return;
    };
    case.compare("gradients", json!(gradients.map(|g| g.to_array())));
    case.compare(
        "gram",
        json!(gradients.map(|a| gradients.map(|b| a.dot(b)))),
    );
}
