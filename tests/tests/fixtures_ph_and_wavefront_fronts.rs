//! The reference file on fronts, reflection, refraction and arrivals (item h of `ph-and-wavefront.json`).

use integration_tests::{Case, Tolerance, judge, read};
use ph_curves::{DualCurve, Ellipse, G1Ends, Line, LineElement, Support, SupportJet, TQuartic};
use serde_json::{Value, json};
use wavefront::glam::DVec2;
use wavefront::{
    Code, Error, Fan, FanOptions, Front, FrontTolerance, Impact, Interface, Medium, Mode, Model,
    PieceShape, Ray, Source, Step,
};

#[test]
fn fixtures_ph_and_wavefront_fronts() {
    let file = read("ph-and-wavefront");
    let cases = file["cases"]
        .as_array()
        .expect("a list of cases")
        .iter()
        .filter(|case| case["item"] == "h")
        .map(|case| {
            let tolerance = Tolerance::Componentwise(case["tol"].as_f64().unwrap_or(0.0));
            let text = |key: &str| case[key].as_str().unwrap_or_default().to_owned();
            Case::new(&text("name"), &text("op"), &case["input"])
                .expecting(&case["expect"], tolerance)
        });
    judge("wavefronts", cases, |case| {
        let result = match case.kind() {
            "reflect" => interact(case, Mode::Reflect),
            "refract" => interact(case, Mode::Transmit),
            "arrival_times" => arrival_times(case),
            "mirror_dual_lines" => mirror_dual_lines(case),
            "two_layer_time" => two_layer_time(case),
            "reflect_front" => reflect_front(case),
            "aniso_interact" => aniso_interact(case),
            "aniso_front" => aniso_front(case),
            "class3_cusp" => class3_cusp(case),
            "class3_arrivals" => class3_arrivals(case),
            "fit_class3" => fit_class3(case),
            "propagate_class3" => propagate_class3(case),
            _ => return case.unknown_kind(),
        };
        if let Err(error) = result {
            case.refuse(&error.to_string(), |_| true);
        }
    });
}

fn vec2(numbers: &[f64]) -> DVec2 {
    DVec2::new(numbers[0], numbers[1])
}

fn point(case: &Case<'_>, key: &str) -> DVec2 {
    vec2(&case.numbers(key))
}

fn xy(p: DVec2) -> Value {
    json!([p.x, p.y])
}

fn reflect(interface: usize) -> Code {
    Code {
        steps: vec![Step {
            interface,
            mode: Mode::Reflect,
        }],
    }
}

/// The interface of a case: a circle or ellipse about the origin, the parabola `x² = 4 f y`, or `y = 0`.
fn interface(case: &Case<'_>) -> Result<Interface, Error> {
    if case.get("circle_radius").is_some() {
        return Interface::circle(DVec2::ZERO, case.number("circle_radius"));
    }
    if case.get("ellipse").is_some() {
        let axes = case.numbers("ellipse");
        return Interface::ellipse(DVec2::ZERO, DVec2::X * axes[0], DVec2::Y * axes[1]);
    }
    if case.get("parabola_focal_length").is_some() {
        let focal = case.number("parabola_focal_length");
        return Interface::conic([1.0, 0.0, 0.0, 0.0, -4.0 * focal, 0.0]);
    }
    let words = case
        .get("interface")
        .or(case.get("mirror"))
        .and_then(Value::as_str)
        .unwrap_or_default();
    let height: f64 = words
        .trim_start_matches("y=")
        .parse()
        .expect("a horizontal interface");
    Interface::horizontal(height)
}

fn interact(case: &Case<'_>, mode: Mode) -> Result<(), Error> {
    let shape = interface(case)?;
    let (first, second) = match mode {
        Mode::Reflect => (case.number("speed"), case.number("speed")),
        Mode::Transmit => (case.number("v1"), case.number("v2")),
    };
    let (medium, beyond) = (Medium::isotropic(first)?, Medium::isotropic(second)?);
    let slowness = medium.slowness_along(point(case, "direction"))?;
    let plane_wave = case.get("plane_wave_from").is_some();
    let ray = if plane_wave {
        let start = point(case, "plane_wave_from");
        let ends = [start, start + point(case, "direction").perp()];
        Source::Plane {
            ends,
            towards: point(case, "direction"),
        }
        .ray(0.0, &medium)?
    } else {
        Ray::from_point(point(case, "source"), slowness, &medium)
    };
    // A ray that starts on the interface itself does not hit it there.
    let velocity = medium.group_velocity(slowness);
    let impact = shape
        .first_impact(ray.point, velocity, 1e-9)
        .ok_or(Error::Miss { from: ray.point })?;
    let arrived = ray.arrive(&impact, &medium);
    let left = arrived.scatter(&impact, mode, &medium, &beyond)?;

    case.compare("hit", xy(impact.point));
    case.compare("time", arrived.time);
    case.compare("direction", xy(left.normal()));
    case.compare(
        "support_at_time_zero",
        left.normal().dot(left.point) - second * left.time,
    );
    let radius = left.front_radius(&beyond);
    case.compare("radius_after", radius);
    case.compare("caustic", xy(left.caustic_point(&beyond)));
    if case.expected().get("plane_wave").is_some() {
        case.seen("plane_wave");
        case.require(radius.abs() > 1e12, "the reflected wave is not plane");
    }
    if let Some(focus) = case
        .expected()
        .get("passes_through")
        .and_then(integration_tests::numbers)
    {
        case.seen("passes_through");
        let focus = vec2(&focus);
        case.require(
            left.normal().perp_dot(focus - left.point).abs() < 1e-10,
            "the ray misses the focus",
        );
        case.compare("focus_time", left.time_at(focus));
    }
    // The conic of the virtual front: its support at time zero is p0² = eta² A² Ny² - (1 - eta²) A² Nx².
    if case.expected().get("virtual_front_conic").is_some() {
        case.seen("virtual_front_conic");
        let (eta, height) = (second / first, ray.point.y);
        let (n, p) = (
            left.normal(),
            left.normal().dot(left.point) - second * left.time,
        );
        let squared = (eta * height * n.y).powi(2) - (1.0 - eta * eta) * (height * n.x).powi(2);
        case.require(
            (p * p - squared).abs() < 1e-11,
            "the front is not tangent to the conic",
        );
    }
    Ok(())
}

/// A model of one interface in a large box.
fn model(shape: Interface, above: Medium, below: Medium) -> Result<Model, Error> {
    Model::try_new(
        DVec2::splat(-20.0),
        DVec2::splat(20.0),
        vec![above, below],
        vec![shape],
    )
}

fn arrival_times(case: &Case<'_>) -> Result<(), Error> {
    let speed = case.number("speed");
    let model = model(
        interface(case)?,
        Medium::isotropic(speed)?,
        Medium::isotropic(speed)?,
    )?;
    let source = if case.get("plane_wave_x").is_some() {
        let (x, range) = (case.number("plane_wave_x"), case.numbers("y_range"));
        let radius = case.number("circle_radius");
        // Cut to the part of the line inside the circle.
        let inside = (radius * radius - x * x).max(0.0).sqrt() * (1.0 - 1e-12);
        let ends = [range[0].max(-inside), range[1].min(inside)].map(|y| DVec2::new(x, y));
        Source::Plane {
            ends,
            towards: DVec2::X,
        }
    } else {
        Source::point(point(case, "source"))
    };
    let fan = Fan::new(&model, source, reflect(0), FanOptions::default())?;
    let times: Vec<f64> = fan
        .arrivals(point(case, "receiver"))
        .iter()
        .map(|arrival| arrival.time)
        .collect();
    case.compare("times", times);
    Ok(())
}

fn two_layer_time(case: &Case<'_>) -> Result<(), Error> {
    let media = (
        Medium::isotropic(case.number("v1"))?,
        Medium::isotropic(case.number("v2"))?,
    );
    let model = model(interface(case)?, media.0, media.1)?;
    let code = Code {
        steps: vec![Step {
            interface: 0,
            mode: Mode::Transmit,
        }],
    };
    let fan = Fan::new(
        &model,
        Source::point(point(case, "source")),
        code,
        FanOptions::default(),
    )?;
    let arrivals = fan.arrivals(point(case, "receiver"));
    case.require(
        arrivals.len() == 1,
        "there is one ray through a plane interface",
    );
    let Some(arrival) = arrivals.first() else {
        return Ok(());
    };
    case.compare("time", arrival.time);
    case.compare("crossing", xy(arrival.ray.point));
    Ok(())
}

fn mirror_dual_lines(case: &Case<'_>) -> Result<(), Error> {
    let nu = point(case, "nu");
    let mirror = Line::new(-case.number("c"), nu.x, nu.y)?;
    let lines = case.rows("lines");
    let image: Value = lines
        .iter()
        .map(|row| {
            let image = Line::new(row[0], row[1], row[2])?
                .reflect(mirror)?
                .coordinates();
            Ok(json!([image.x, image.y, image.z]))
        })
        .collect::<Result<Vec<_>, Error>>()?
        .into();
    case.compare("lines", image);
    let curve = DualCurve::new(
        &lines
            .iter()
            .map(|row| Line::new(row[0], row[1], row[2]))
            .collect::<Result<Vec<_>, _>>()?,
    )?;
    case.require(curve.class() + 1 == lines.len(), "the class of the curve");
    Ok(())
}

/// A plane wave along +x, reflected inside a circle, its front fitted on equal parts of the wave.
fn reflect_front(case: &Case<'_>) -> Result<(), Error> {
    let (x, range, pieces) = (
        case.number("plane_wave_x"),
        case.numbers("y_range"),
        case.number("pieces") as usize,
    );
    let medium = Medium::isotropic(1.0)?;
    let model = model(interface(case)?, medium.clone(), medium.clone())?;
    let ends = [range[0], range[1]].map(|y| DVec2::new(x, y));
    let fan = Fan::new(
        &model,
        Source::Plane {
            ends,
            towards: DVec2::X,
        },
        reflect(0),
        FanOptions::default(),
    )?;
    let ray = |t: f64| {
        fan.trace(t)?
            .last()
            .copied()
            .ok_or(Error::Miss { from: DVec2::NAN })
    };
    let breaks: Vec<f64> = (0..=pieces).map(|i| i as f64 / pieces as f64).collect();
    // One fitted ray in the middle of each piece, as the reference has it; the tolerance lets no piece be halved.
    let front = Front::fit(
        &medium,
        1,
        &breaks,
        ray,
        FrontTolerance {
            time: 1e-3,
            samples: 1,
        },
    )?;
    let arcs: Vec<TQuartic> = front.propagated(0.0).collect();
    case.compare(
        "alpha",
        arcs.iter().map(TQuartic::alpha).collect::<Vec<_>>(),
    );
    case.compare(
        "radii_at_time_zero",
        arcs.iter()
            .map(|arc| json!(arc.end_radii()))
            .collect::<Value>(),
    );
    let intervals: Value = front
        .caustic()
        .map(|(_, [a, b])| json!([a.min(b), a.max(b)]))
        .collect();
    case.compare("cusp_time_intervals", intervals);
    if let Some(want) = case.expected().get("support_error").and_then(Value::as_f64) {
        // Densely: the reference's largest error over many rays a piece, to 2 percent.
        let mut worst: f64 = 0.0;
        for (piece, arc) in arcs.iter().enumerate() {
            for i in 1..64 {
                let t = breaks[piece] + (breaks[piece + 1] - breaks[piece]) * f64::from(i) / 64.0;
                let ray = ray(t)?;
                let support = ray.normal().dot(ray.point) - ray.time;
                let found = arc
                    .parameter_of_normal(ray.normal())
                    .map_or(f64::NAN, |t| arc.support(t));
                worst = worst.max((found - support).abs());
            }
        }
        case.compare_within("support_error", worst, Tolerance::Absolute(0.02 * want));
    }
    Ok(())
}

fn aniso_interact(case: &Case<'_>) -> Result<(), Error> {
    let medium = |key: &str| {
        let axes = case.numbers(key);
        Medium::elliptical(axes[0], axes[1], 0.0)
    };
    let (first, second) = (medium("semi_axes_1")?, medium("semi_axes_2")?);
    let ray = Ray::from_point(point(case, "start"), point(case, "slowness"), &first);
    let velocity = first.group_velocity(ray.slowness);
    let impact: Impact = interface(case)?
        .first_impact(ray.point, velocity, 0.0)
        .ok_or(Error::Miss { from: ray.point })?;
    let reflects = case.get("mode").and_then(Value::as_str) == Some("reflect");
    let (mode, beyond) = if reflects {
        (Mode::Reflect, &first)
    } else {
        (Mode::Transmit, &second)
    };
    let left = ray
        .arrive(&impact, &first)
        .scatter(&impact, mode, &first, beyond)?;
    case.compare("hit", xy(impact.point));
    case.compare("time", left.time);
    case.compare("slowness", xy(left.slowness));
    case.compare("group_velocity", xy(beyond.group_velocity(left.slowness)));
    Ok(())
}

/// An exploding reflector with the support `2 + 0.2 cos 3s` in an elliptical medium: supports add.
fn aniso_front(case: &Case<'_>) -> Result<(), Error> {
    assert_eq!(
        case.get("reflector_support").and_then(Value::as_str),
        Some("2 + 0.2 cos 3s"),
        "the reflector's form"
    );
    let (axes, s, time) = (
        case.numbers("semi_axes"),
        case.number("s"),
        case.number("time"),
    );
    let medium = Medium::elliptical(axes[0], axes[1], 0.0)?;
    let reflector = |psi: f64| {
        let (sine, cosine) = (3.0 * psi).sin_cos();
        SupportJet {
            support: 2.0 + 0.2 * cosine,
            slope: -0.6 * sine,
            bend: -1.8 * cosine,
        }
    };
    let normal = DVec2::from_angle(s);
    let ray = Ray::from_point(reflector.contact(s).point, medium.slowness(normal), &medium)
        .after(time, &medium);
    case.compare("point", xy(ray.point));
    case.compare("support", normal.dot(ray.point));
    let ellipse = Ellipse {
        a: axes[0],
        b: axes[1],
    };
    let sum = reflector.jet(s).support + time * ellipse.jet(s).support;
    case.require(
        (normal.dot(ray.point) - sum).abs() < 1e-12,
        "the supports do not add up",
    );
    Ok(())
}

fn ends(case: &Case<'_>) -> Result<G1Ends, Error> {
    let start = LineElement::new(point(case, "p0"), point(case, "n0"))?;
    Ok(G1Ends::new(
        start,
        LineElement::new(point(case, "p1"), point(case, "n1"))?,
    )?)
}

fn class3_cusp(case: &Case<'_>) -> Result<(), Error> {
    let arc = ends(case)?.arc(case.number("alpha"))?;
    let offset = arc.offset(case.number("d"));
    let cusp = offset.cusp();
    case.compare("cusps", f64::from(u8::from(cusp.is_some())));
    if let Some(t) = cusp {
        case.compare("normal", xy(offset.normal(t)));
        case.compare("point", xy(offset.point(t)));
        case.compare("evolute_point", xy(arc.contact(t).centre()));
    }
    Ok(())
}

fn class3_arrivals(case: &Case<'_>) -> Result<(), Error> {
    let speed = case.number("speed");
    let arc = ends(case)?.arc(case.number("alpha"))?;
    // The arc itself is the front: its own rays, fitted by one arc exactly.
    let medium = Medium::isotropic(speed)?;
    let ray = |t: f64| {
        let contact = arc.contact(t);
        Ok(Ray::from_point(
            contact.point,
            medium.slowness(contact.normal),
            &medium,
        ))
    };
    let front = Front::fit(&medium, 0, &[0.0, 1.0], ray, FrontTolerance::time(1e-13))?;
    let arrivals = front.arrivals(point(case, "receiver"))?;
    case.compare(
        "times",
        arrivals.iter().map(|arrival| arrival.0).collect::<Vec<_>>(),
    );
    case.compare(
        "normals",
        arrivals
            .iter()
            .map(|arrival| xy(arrival.1))
            .collect::<Value>(),
    );
    Ok(())
}

fn fit_class3(case: &Case<'_>) -> Result<(), Error> {
    let (points, normals) = (case.rows("points"), case.rows("normals"));
    let samples: Vec<(DVec2, DVec2)> = points
        .iter()
        .zip(&normals)
        .map(|(p, n)| (vec2(p), vec2(n)))
        .collect();
    let front = Front::from_samples(&Medium::isotropic(1.0)?, 0, &samples, samples.len() - 1)?;
    let PieceShape::Arc(arc) = front.pieces()[0].shape else {
        panic!("an arc")
    };
    case.compare("alpha", arc.alpha());
    let errors = samples.iter().map(|(p, n)| {
        let t = if *n == samples[0].1 {
            0.0
        } else {
            arc.parameter_of_normal(*n).unwrap_or(1.0)
        };
        arc.support(t) - n.dot(*p)
    });
    case.compare("support_errors", errors.collect::<Vec<_>>());
    let [start, end] = arc.end_radii();
    case.compare("radius0", start);
    case.compare("radius1", end);
    Ok(())
}

fn propagate_class3(case: &Case<'_>) -> Result<(), Error> {
    let arc = ends(case)?.arc(case.number("alpha"))?;
    let moved = arc.offset(case.number("speed") * case.number("time"));
    for (key, t) in [("p0", 0.0), ("point_half", 0.5), ("p1", 1.0)] {
        case.compare(key, xy(moved.point(t)));
    }
    let [start, end] = moved.end_radii();
    case.compare("radius0", start);
    case.compare("radius1", end);
    Ok(())
}
