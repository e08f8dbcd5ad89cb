//! Three ways to ask for a curve, and a plane curve from its angles, with noise.

use std::f64::consts::TAU;

use anyhow::Result;
use glam::{DMat2, DVec2, dvec2};
use reconstruct::{EndCondition, PlanarRibbon};

use super::{FINE, LENGTH, angle, largest, places, planar, trace};
use crate::color::{BLUE, GREEN, GREY, INK, SKY, VERMILION};
use crate::demo::Context;
use crate::figure::{Figure, Marker, Plot};
use crate::random::Random;
use crate::report::Target;

/// Standard deviation of the angles in the noisy picture, radians (half a degree).
const SIGMA: f64 = 0.5 * TAU / 360.0;
/// That of the drawn bundle, so that it can be seen.
const DRAWN_SIGMA: f64 = 3.0 * TAU / 360.0;
/// Fig. 3.2: Hermite interpolation, dual interpolation, and interpolation by sensors.
pub(super) fn draw_problems(context: &mut Context) -> Result<()> {
    let truth = planar(FINE, EndCondition::NotAKnot)?;
    let sensors = planar(8, EndCondition::NotAKnot)?;
    let at = |i: usize| truth.points()[i * FINE / 8];
    let directions: Vec<DVec2> = (0..=8)
        .map(|i| DVec2::from_angle(angle(LENGTH * i as f64 / 8.0)))
        .collect();
    let curve = |plot: &mut Plot| {
        plot.polyline(
            truth.points(),
            SKY.line().width(2.0).label("curve to be found"),
        );
    };
    let mut hermite = Plot::geometry("Hermite: points and tangents");
    let mut dual = Plot::geometry("dual: tangent lines");
    let mut ribbon = Plot::geometry("sensors: directions and lengths");
    for plot in [&mut hermite, &mut dual] {
        curve(plot);
    }
    for (i, direction) in directions.iter().enumerate() {
        hermite.arrow(
            at(i),
            at(i) + *direction * 0.35,
            VERMILION.line().label("given"),
        );
        dual.segment(
            at(i) - *direction * 0.45,
            at(i) + *direction * 0.45,
            VERMILION.line().label("given"),
        );
        // The directions only, each in its place on the straightened ribbon below.
        let place = dvec2(LENGTH * i as f64 / 8.0 * 0.62, -0.9);
        ribbon.arrow(
            place,
            place + *direction * 0.3,
            VERMILION.line().label("given"),
        );
    }
    hermite.points(
        &(0..=8).map(at).collect::<Vec<_>>(),
        Marker::Disc,
        INK.fill(),
    );
    ribbon.segment(dvec2(0.0, -0.9), dvec2(LENGTH * 0.62, -0.9), GREY.line());
    ribbon.polyline(
        &trace(|s| sensors.point(s))?,
        GREEN.line().width(2.0).label("reconstructed"),
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
pub(super) fn draw(context: &mut Context) -> Result<()> {
    let truth = planar(FINE, EndCondition::NotAKnot)?;
    let ribbon = planar(16, EndCondition::NotAKnot)?;
    let mut left = Plot::geometry("17 sensors");
    left.polyline(truth.points(), SKY.line().width(5.0).label("true curve"));
    left.polyline(
        &trace(|s| ribbon.point(s))?,
        INK.line().label("reconstructed"),
    );
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
    let mut noise = Random::new(context.seed());
    for _ in 0..context.pick(40, 12) {
        let s = places(32);
        let angles: Vec<f64> = s
            .iter()
            .map(|s| angle(*s) + DRAWN_SIGMA * noise.gaussian())
            .collect();
        let drawn = PlanarRibbon::new(&s, &angles, EndCondition::NotAKnot)?;
        noisy.polyline(
            &trace(|s| drawn.point(s))?,
            GREY.alpha(0.4).line().label("noisy readings"),
        );
    }
    noisy.polyline(
        &trace(|s| exact.point(s))?,
        BLUE.line().width(2.0).label("without noise"),
    );
    let covariance = exact.covariance(DRAWN_SIGMA);
    for i in [8, 16, 24, 32] {
        noisy.polygon(
            &ellipse(exact.points()[i], covariance[i], 2.0),
            VERMILION.line().label("2σ, predicted"),
        );
    }
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
fn simulated_sigma(noise: &mut Random, exact: &PlanarRibbon, runs: usize) -> Result<f64> {
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
