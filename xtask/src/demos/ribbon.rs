//! Curves from tangents alone (Figs 3.2 to 3.7 of the chapter on sensors).
//!
//! What one sees: first three ways to ask for a curve, by points with tangents, by tangent lines, and by tangent
//! directions at given arc lengths, which is what sensors know. Then a plane curve from 17 and 33 sensors over the true
//! one, with noisy readings and the ellipses in which the theory expects the points to scatter; a space curve in two
//! views; and how the error falls with the number of sensors, with slope 4 for not-a-knot ends and 3 for natural ones.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, Result, ensure};
use glam::{DMat2, DMat3, DVec2, DVec3, dvec2, dvec3};
use reconstruct::{
    EndCondition, PlanarRibbon, RibbonLayout, RibbonStream, Sensor, SensorKind, SpatialRibbon,
    TangentMethod, WorldFields,
};

use crate::color::{BLUE, GREEN, GREY, INK, ORANGE, SKY, VERMILION};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::export::Part;
use crate::figure::{Corner, Figure, Marker, Plot, Side};
use crate::mesh::Mesh;
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Ribbon {
    /// Readings of a real ribbon: lines `s,kind,x,y,z` with kind `a` (accelerometer) or `m` (magnetometer)
    #[arg(long, value_name = "FILE.csv")]
    readings: Option<PathBuf>,
    /// Dip of the magnetic field below the horizontal for --readings, in degrees
    #[arg(long, default_value_t = 62.0, allow_negative_numbers = true)]
    dip: f64,
}

/// Standard deviation of the angles in the noisy picture, radians (half a degree).
const SIGMA: f64 = 0.5 * TAU / 360.0;
/// That of the drawn bundle, so that it can be seen.
const DRAWN_SIGMA: f64 = 3.0 * TAU / 360.0;
/// Length of the test curves.
const LENGTH: f64 = 4.0;

impl Demo for Ribbon {
    const NAME: &'static str = "ribbon";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 3.2 to 3.7";
    const ABOUT: &'static str =
        "Plane and space curves reconstructed from orientation sensors on a ribbon";

    fn run(&self, context: &mut Context) -> Result<()> {
        if let Some(path) = &self.readings {
            draw_readings(context, path, self.dip)?;
        }
        draw_three_problems(context)?;
        draw_planar(context)?;
        draw_spatial(context)?;
        draw_orders(context)?;
        time_frames(context)
    }
}

/// The plane test curve: its tangent angle.
fn angle(s: f64) -> f64 {
    0.4 + 1.5 * (1.6 * s).sin() + 0.35 * s
}

/// The space test curve: its unit tangent.
fn tangent(s: f64) -> DVec3 {
    let (polar, azimuth) = (
        1.0 + 0.45 * (1.3 * s).sin(),
        0.3 + 1.2 * s + 0.2 * (2.1 * s).cos(),
    );
    dvec3(
        polar.sin() * azimuth.cos(),
        polar.sin() * azimuth.sin(),
        polar.cos(),
    )
}

fn places(intervals: usize) -> Vec<f64> {
    (0..=intervals)
        .map(|i| LENGTH * i as f64 / intervals as f64)
        .collect()
}

fn planar(intervals: usize, end: EndCondition) -> Result<PlanarRibbon> {
    let s = places(intervals);
    let angles: Vec<f64> = s.iter().map(|s| angle(*s)).collect();
    Ok(PlanarRibbon::new(&s, &angles, end)?)
}

fn spatial(intervals: usize, method: TangentMethod, end: EndCondition) -> Result<SpatialRibbon> {
    let s = places(intervals);
    let tangents: Vec<DVec3> = s.iter().map(|s| tangent(*s)).collect();
    Ok(SpatialRibbon::with_method(&s, &tangents, method, end)?)
}

/// Intervals of the reference, 4th order: its error is below 1e-12.
const FINE: usize = 4096;

/// Fig. 3.2: Hermite interpolation, dual interpolation, and interpolation by sensors.
fn draw_three_problems(context: &mut Context) -> Result<()> {
    let truth = planar(FINE, EndCondition::NotAKnot)?;
    let sensors = planar(8, EndCondition::NotAKnot)?;
    let at = |i: usize| truth.points()[i * FINE / 8];
    let directions: Vec<DVec2> = (0..=8)
        .map(|i| DVec2::from_angle(angle(LENGTH * i as f64 / 8.0)))
        .collect();
    let curve = |plot: &mut Plot| {
        plot.polyline(truth.points(), SKY.line().width(2.0));
    };
    let mut hermite = Plot::geometry("Hermite: points and tangents");
    let mut dual = Plot::geometry("dual: tangent lines");
    let mut ribbon = Plot::geometry("sensors: directions and lengths");
    for plot in [&mut hermite, &mut dual] {
        curve(plot);
    }
    for (i, direction) in directions.iter().enumerate() {
        hermite.arrow(at(i), at(i) + *direction * 0.35, VERMILION.line());
        dual.segment(
            at(i) - *direction * 0.45,
            at(i) + *direction * 0.45,
            VERMILION.line(),
        );
        // The directions only, each in its place on the straightened ribbon below.
        let place = dvec2(LENGTH * i as f64 / 8.0 * 0.62, -0.9);
        ribbon.arrow(place, place + *direction * 0.3, VERMILION.line());
    }
    hermite.points(
        &(0..=8).map(at).collect::<Vec<_>>(),
        Marker::Disc,
        INK.fill(),
    );
    ribbon.segment(dvec2(0.0, -0.9), dvec2(LENGTH * 0.62, -0.9), GREY.line());
    ribbon.polyline(
        &(0..=400)
            .map(|i| sensors.point(LENGTH * f64::from(i) / 400.0))
            .collect::<Result<Vec<_>, _>>()?,
        GREEN.line().width(2.0),
    );
    ribbon.points(sensors.points(), Marker::Dot, INK.fill());
    let figure = Figure::grid(3, vec![hermite, dual, ribbon]).aspect(0.8);
    context.figure(
        "figure-problems",
        &figure,
        "Three ways to ask for a curve (Fig. 3.2). Sensors know directions and the arc lengths between them, and no point.",
        "The same curve three times: with points and arrows, with tangent lines, and above a ribbon of arrows.",
    )
}

/// Figs 3.3 and 3.5: plane reconstruction, its angle function, and noise.
fn draw_planar(context: &mut Context) -> Result<()> {
    let truth = planar(FINE, EndCondition::NotAKnot)?;
    let ribbon = planar(16, EndCondition::NotAKnot)?;
    let mut left = Plot::geometry("17 sensors");
    left.polyline(truth.points(), SKY.line().width(5.0).label("true curve"));
    let trace: Vec<DVec2> = (0..=600)
        .map(|i| ribbon.point(LENGTH * f64::from(i) / 600.0))
        .collect::<Result<_, _>>()?;
    left.polyline(&trace, INK.line().label("reconstructed"));
    left.points(
        ribbon.points(),
        Marker::Dot,
        VERMILION.fill().label("sensors"),
    );
    let mut right = Plot::chart("its tangent angle", "arc length s", "angle α");
    right.graph(angle, 0.0, LENGTH, SKY.line().width(5.0));
    right.graph(|s| ribbon.angle(s), 0.0, LENGTH, INK.line());
    let s = places(16);
    right.points(
        &s.iter().map(|s| dvec2(*s, angle(*s))).collect::<Vec<_>>(),
        Marker::Dot,
        VERMILION.fill(),
    );
    let mut noisy = Plot::geometry("33 sensors, angles with σ = 3°");
    let exact = planar(32, EndCondition::NotAKnot)?;
    let mut noise = Noise(context.seed());
    for _ in 0..context.pick(40, 12) {
        let s = places(32);
        let angles: Vec<f64> = s
            .iter()
            .map(|s| angle(*s) + DRAWN_SIGMA * noise.gaussian())
            .collect();
        let drawn = PlanarRibbon::new(&s, &angles, EndCondition::NotAKnot)?;
        noisy.polyline(drawn.points(), GREY.alpha(0.4).line());
    }
    noisy.polyline(exact.points(), BLUE.line().width(2.0));
    let covariance = exact.covariance(DRAWN_SIGMA);
    for i in [8, 16, 24, 32] {
        noisy.polygon(
            &ellipse(exact.points()[i], covariance[i], 2.0),
            VERMILION.line(),
        );
    }
    let end = exact.points()[32];
    noisy.text(end + dvec2(0.05, 0.0), "2σ", Side::Right);
    let figure = Figure::grid(3, vec![left, right, noisy]).aspect(0.75);
    context.figure(
        "figure-planar",
        &figure,
        "A plane curve from its angles at 17 sensors (Figs 3.3, 3.5), and 33 noisy sensors with predicted 2σ ellipses.",
        "Left a curve covered by its reconstruction, middle the angle function, right a bundle of noisy curves with ellipses.",
    )?;
    let worst = largest(
        ribbon
            .points()
            .iter()
            .enumerate()
            .map(|(i, p)| p.distance(truth.points()[i * FINE / 16])),
    );
    context.number("max_position_error_17_sensors", worst, Target::AtMost(2e-3));
    let predicted = trace2(exact.covariance(SIGMA)[32]).sqrt();
    let measured = simulated_sigma(&mut noise, &exact, context.pick(4000, 400))?;
    context.number("noise_position_sigma", predicted, Target::AtMost(0.02));
    // The standard deviation of a standard deviation from n draws is about 1 / sqrt(2 n), some more as the two
    // coordinates differ: four of them for 400.
    context.number(
        "noise_simulated_over_predicted",
        measured / predicted,
        Target::within(1.0, 0.2),
    );
    Ok(())
}

fn trace2(m: DMat2) -> f64 {
    m.x_axis.x + m.y_axis.y
}

/// Root mean square distance of the end from where it should be, over noisy readings.
fn simulated_sigma(noise: &mut Noise, exact: &PlanarRibbon, runs: usize) -> Result<f64> {
    let s = places(32);
    let mut sum = 0.0;
    for _ in 0..runs {
        let angles: Vec<f64> = s
            .iter()
            .map(|s| angle(*s) + SIGMA * noise.gaussian())
            .collect();
        let drawn = PlanarRibbon::new(&s, &angles, EndCondition::NotAKnot)?;
        sum += drawn.points()[32].distance_squared(exact.points()[32]);
    }
    Ok((sum / runs as f64).sqrt())
}

/// The ellipse of a covariance at this many standard deviations.
fn ellipse(centre: DVec2, covariance: DMat2, deviations: f64) -> Vec<DVec2> {
    // The Cholesky factor maps the unit circle to it.
    let a = covariance.x_axis.x.max(0.0).sqrt();
    let b = if a > 0.0 {
        covariance.x_axis.y / a
    } else {
        0.0
    };
    let c = (covariance.y_axis.y - b * b).max(0.0).sqrt();
    (0..90)
        .map(|i| DVec2::from_angle(TAU * f64::from(i) / 90.0) * deviations)
        .map(|p| centre + dvec2(a * p.x, b * p.x + c * p.y))
        .collect()
}

/// Figs 3.6 and 3.7: a space curve in two views, and its tangents on the sphere.
fn draw_spatial(context: &mut Context) -> Result<()> {
    let truth = spatial(FINE, TangentMethod::Projected, EndCondition::NotAKnot)?;
    let projected = spatial(16, TangentMethod::Projected, EndCondition::NotAKnot)?;
    let sphere = spatial(16, TangentMethod::SphericalSpline, EndCondition::Natural)?;
    let views: [(&str, fn(DVec3) -> DVec2); 2] = [
        ("from above", |p| dvec2(p.x, p.y)),
        ("from the side", |p| dvec2(p.x, p.z)),
    ];
    let mut plots: Vec<Plot> = views
        .iter()
        .map(|(title, view)| {
            let mut plot = Plot::geometry(title);
            let flat = |points: &[DVec3]| points.iter().map(|p| view(*p)).collect::<Vec<_>>();
            plot.polyline(
                &flat(truth.points()),
                SKY.line().width(5.0).label("true curve"),
            );
            let trace = |ribbon: &SpatialRibbon| -> Result<Vec<DVec3>> {
                Ok((0..=400)
                    .map(|i| ribbon.point(LENGTH * f64::from(i) / 400.0))
                    .collect::<Result<_, _>>()?)
            };
            plot.polyline(
                &flat(&trace(&projected)?),
                INK.line().label("projected spline"),
            );
            plot.polyline(
                &flat(&trace(&sphere)?),
                ORANGE.line().dashed().label("spline on the sphere"),
            );
            plot.points(&flat(projected.points()), Marker::Dot, VERMILION.fill());
            Ok(plot)
        })
        .collect::<Result<_>>()?;
    let mut ball = Plot::geometry("tangents on the sphere");
    ball.circle(DVec2::ZERO, 1.0, GREY.line());
    // Seen from above: all of the curve lies on the near side.
    let (right, up) = (DVec3::X, DVec3::Y);
    let seen = |t: DVec3| dvec2(t.dot(right), t.dot(up));
    ball.polyline(
        &(0..=400)
            .map(|i| seen(tangent(LENGTH * f64::from(i) / 400.0)))
            .collect::<Vec<_>>(),
        SKY.line().width(5.0),
    );
    ball.polyline(
        &(0..=400)
            .map(|i| seen(projected.tangent(LENGTH * f64::from(i) / 400.0)))
            .collect::<Vec<_>>(),
        INK.line(),
    );
    ball.points(
        &projected
            .tangents()
            .iter()
            .map(|t| seen(*t))
            .collect::<Vec<_>>(),
        Marker::Dot,
        VERMILION.fill(),
    );
    plots.push(ball);
    let figure = Figure::grid(3, plots).aspect(0.75);
    context.figure(
        "figure-spatial",
        &figure,
        "A space curve from 17 unit tangents, by both methods, in two views; right, the tangents on the unit sphere (Figs 3.6, 3.7).",
        "Two views of a coiled curve with its reconstructions on top, and a circle with the tangent's path inside.",
    )?;
    let tube = Mesh::tube(truth.points(), 0.01, false);
    let beads = Mesh::tube(projected.points(), 0.02, false);
    context.meshes(
        "ribbon",
        &[
            Part::new("true", &tube, SKY),
            Part::new("sensors", &beads, VERMILION),
        ],
    )
}

/// The errors over the number of sensors.
fn draw_orders(context: &mut Context) -> Result<()> {
    let counts: Vec<usize> = context.pick(vec![8, 16, 32, 64, 128, 256], vec![8, 16, 32, 64, 128]);
    let plane = planar(FINE, EndCondition::NotAKnot)?;
    let space = spatial(FINE, TangentMethod::Projected, EndCondition::NotAKnot)?;
    let planar_error = |n: usize, end| -> Result<f64> {
        let ribbon = planar(n, end)?;
        Ok(largest((0..=n).map(|i| {
            ribbon.points()[i].distance(plane.points()[i * FINE / n])
        })))
    };
    let spatial_error = |n: usize, method, end| -> Result<f64> {
        let ribbon = spatial(n, method, end)?;
        Ok(largest((0..=n).map(|i| {
            ribbon.points()[i].distance(space.points()[i * FINE / n])
        })))
    };
    let mut plot = Plot::chart(
        "largest position error",
        "intervals between sensors",
        "error",
    );
    plot.log_x().log_y().legend(Corner::BottomLeft);
    let mut orders = Vec::new();
    let (natural, knot) = (EndCondition::Natural, EndCondition::NotAKnot);
    let series: [(&str, crate::color::Color, &dyn Fn(usize) -> Result<f64>); 5] = [
        ("plane, not-a-knot", BLUE, &|n| planar_error(n, knot)),
        ("plane, natural", SKY, &|n| planar_error(n, natural)),
        ("space, projected, not-a-knot", VERMILION, &|n| {
            spatial_error(n, TangentMethod::Projected, knot)
        }),
        ("space, projected, natural", ORANGE, &|n| {
            spatial_error(n, TangentMethod::Projected, natural)
        }),
        ("space, on the sphere", GREEN, &|n| {
            spatial_error(n, TangentMethod::SphericalSpline, natural)
        }),
    ];
    for (label, color, error) in series {
        let points: Vec<DVec2> = counts
            .iter()
            .map(|n| Ok(dvec2(*n as f64, error(*n)?)))
            .collect::<Result<_>>()?;
        plot.polyline(&points, color.line().label(label));
        plot.points(&points, Marker::Dot, color.fill());
        let [a, b] = [points[points.len() - 2], points[points.len() - 1]];
        orders.push((a.y / b.y).log2());
    }
    context.figure(
        "figure-order",
        &Figure::new(plot),
        "The position error over the number of sensors: order 4 with not-a-knot ends, 3 with the natural ends of the thesis.",
        "Five falling straight lines in a doubly logarithmic chart, two steeper than the others.",
    )?;
    let default_ends =
        planar_error(32, knot)?.max(spatial_error(32, TangentMethod::Projected, knot)?);
    context.number("max_position_error", default_ends, Target::AtMost(1e-4));
    context.number("order", orders[0].min(orders[2]), Target::AtLeast(3.7));
    context.number("orders", orders, Target::AtLeast(2.7));
    Ok(())
}

/// The demonstrator's work: 32 alternating sensors, frame after frame.
fn time_frames(context: &mut Context) -> Result<()> {
    let world = WorldFields::with_dip(1.08)?;
    let kind = |i: usize| {
        if i.is_multiple_of(2) {
            SensorKind::Accelerometer
        } else {
            SensorKind::Magnetometer
        }
    };
    let layout = RibbonLayout::new(
        (0..32).map(|i| Sensor::new(LENGTH * i as f64 / 31.0, kind(i))),
        world,
    )?;
    let readings: Vec<DVec3> = layout
        .sensors()
        .iter()
        .map(|sensor| {
            let x = tangent(sensor.s);
            let y = DVec3::Z.cross(x).normalize();
            let field = if sensor.kind == SensorKind::Accelerometer {
                world.up()
            } else {
                world.magnetic()
            };
            DMat3::from_cols(x, y, x.cross(y)).transpose() * field
        })
        .collect();
    let mut stream = RibbonStream::new(layout)?;
    let frames = context.pick(20_000, 2_000);
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        for _ in 0..frames / 5 {
            std::hint::black_box(stream.frame(std::hint::black_box(&readings))?);
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e6 / f64::from(frames / 5));
    }
    // The target is that of an optimised build; a development build and a busy machine get room.
    context.number(
        "frame_microseconds",
        best,
        Target::AtMost(if cfg!(debug_assertions) { 1000.0 } else { 50.0 }),
    );
    Ok(())
}

/// A ribbon from a file of readings.
fn draw_readings(context: &mut Context, path: &Path, dip: f64) -> Result<()> {
    let text =
        std::fs::read_to_string(path).or_bad_input(format!("--readings {}", path.display()))?;
    let (sensors, readings) =
        parse(&text).or_bad_input(format!("--readings {}", path.display()))?;
    let reconstructed = || -> Result<_> {
        let layout = RibbonLayout::new(sensors, WorldFields::with_dip(dip.to_radians())?)?;
        let tangents = layout.tangents(&readings)?;
        let ribbon = tangents.ribbon()?;
        let covariance = tangents.position_covariance(&ribbon, 0.005)?;
        Ok((ribbon, covariance))
    };
    let (ribbon, covariance) = reconstructed().or_bad_input("--readings")?;
    let points = ribbon.points();
    let plots = [("from above", 0, 1), ("from the side", 0, 2)].map(|(title, x, y)| {
        let mut plot = Plot::geometry(title);
        let flat: Vec<DVec2> = points.iter().map(|p| dvec2(p[x], p[y])).collect();
        plot.polyline(&flat, BLUE.line().width(2.0));
        plot.points(&flat, Marker::Dot, VERMILION.fill());
        plot
    });
    context.figure(
        "figure-readings",
        &Figure::grid(2, plots.to_vec()),
        "The ribbon of the given readings, from above and from the side.",
        "Two views of a curve with dots at its sensors.",
    )?;
    let size = largest(points.iter().map(|p| p.length()));
    let tube = Mesh::tube(points, 0.01 * size, false);
    context.meshes("readings", &[Part::new("ribbon", &tube, BLUE)])?;
    let end = covariance.last().context("a ribbon has points")?;
    let sigma = (end.x_axis.x + end.y_axis.y + end.z_axis.z).sqrt();
    context.number("readings_end_sigma_at_0.005", sigma, Target::Free);
    Ok(())
}

/// Lines `s,kind,x,y,z`; empty lines, comments (`#`) and a heading are skipped.
fn parse(text: &str) -> Result<(Vec<Sensor>, Vec<DVec3>)> {
    let (mut sensors, mut readings) = (Vec::new(), Vec::new());
    for (number, line) in (1..).zip(text.lines()) {
        let cells: Vec<&str> = line.split([',', ';', '\t']).map(str::trim).collect();
        let heading = sensors.is_empty() && cells[0].parse::<f64>().is_err();
        if line.trim().is_empty() || line.starts_with('#') || heading {
            continue;
        }
        ensure!(
            cells.len() == 5,
            "line {number} has {} cells, not s,kind,x,y,z",
            cells.len()
        );
        let value = |k: usize| {
            cells[k]
                .parse::<f64>()
                .with_context(|| format!("line {number}: {:?} is not a number", cells[k]))
        };
        let kind = match cells[1] {
            "a" => SensorKind::Accelerometer,
            "m" => SensorKind::Magnetometer,
            other => anyhow::bail!("line {number}: the kind {other:?} is neither a nor m"),
        };
        sensors.push(Sensor::new(value(0)?, kind));
        readings.push(dvec3(value(2)?, value(3)?, value(4)?));
    }
    Ok((sensors, readings))
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// A small deterministic generator (SplitMix64) of normal deviates.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn gaussian(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_files_are_read_or_refused_with_the_line() {
        let (sensors, readings) =
            parse("s,kind,x,y,z\n0,a,0,0,1\n\n# noise\n0.1,m,0,0.5,-0.8\n").unwrap();
        assert_eq!((sensors.len(), readings[1]), (2, dvec3(0.0, 0.5, -0.8)));
        for bad in ["0,a,0,0,1\n1,b,0,0,1", "0,a,0,0", "0,a,0,0,1\n1,a,zero,0,1"] {
            assert!(
                parse(bad).is_err_and(|error| error.to_string().contains("line")),
                "{bad}"
            );
        }
    }
}
