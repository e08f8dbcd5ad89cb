//! Six panels. Above, two semicircles share their end points and differ by the sign of the vector
//! in the middle, and an arc of 120 degrees stands with its control triangle beside the major arc
//! that the negative middle weight draws. In the middle row a short hyperbola arc (thick) goes on
//! to infinity along a dashed asymptote and comes back on the other branch, to its start reflected
//! in the centre; beside it a branch whose two ends are vectors, with foci, vertices and
//! directrices. Below, half an ellipse with its foci and directrices, and a parabola from one point
//! and two vectors; the pale curves are the complementary arcs.

use std::f64::consts::PI;

use anyhow::{Context as _, Result};
use bezier_mass::{Conic, Half, Homography, Line, MassPoint, MassPointKind, Quadratic};
use glam::{DVec2, dvec2};

use crate::color::{BLUE, GREEN, GREY, INK, ORANGE, SKY, VERMILION};
use crate::demo::{Context, Demo, OrBadInput};
use crate::figure::{Figure, Marker, Plot, Side, Style};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct MassPoints {
    /// Middle weight of the hyperbola arc of Fig. 2, above one
    #[arg(long, default_value_t = 1.25)]
    weight: f64,
}

/// Residuals and errors are rounding; the worst condition, the middle of an almost full circle, costs five digits.
const EXACT: Target = Target::AtMost(1e-9);

impl Demo for MassPoints {
    const NAME: &'static str = "mass-points";
    const PAPER: &'static str = "mass-points-and-spheres, Figs. 1 and 2";
    const ABOUT: &'static str = "Conic arcs whose control points are points and vectors";

    fn run(&self, context: &mut Context) -> Result<()> {
        let points = [dvec2(1.0, 0.6), dvec2(1.9, 1.9), dvec2(3.6, 2.5)];
        let half = Quadratic::hyperbola_as_semicircle(points, self.weight, Half::Along)
            .or_bad_input("--weight W")?;
        let arc = quadratic([(points[0], 1.0), (points[1], self.weight), (points[2], 1.0)])?;
        let plots = vec![
            semicircles()?,
            both_arcs()?,
            hyperbola_as_semicircle(&arc, &half)?,
            branch_between_vectors()?,
            half_ellipse()?,
            parabola()?,
        ];
        context.figure(
            "figure",
            &Figure::grid(2, plots).aspect(1.25),
            "Rational quadratic curves with mass control points: points, and vectors as arrows. \
             A vector in the middle gives a semicircle, half an ellipse, or a hyperbola through \
             infinity; vectors at the ends give a whole branch or half a parabola.",
            "Six plots of conic arcs with their control points and control vectors: two \
             semicircles, a minor and a major arc, two hyperbolas with asymptotes, an ellipse and \
             a parabola with foci and directrices.",
        )?;

        let count = context.pick(400, 40);
        context.number("circle_max_residual", circle_residual(count)?, EXACT);
        context.number("hyperbola_max_residual", hyperbola_residual(count)?, EXACT);
        context.number("reparam_max_error", reparametrisation_error(count)?, EXACT);
        context.number("asymptote_max_error", asymptote_error(count)?, EXACT);
        Ok(())
    }
}

/// Fig. 1: one pair of end points, two opposite vectors.
fn semicircles() -> Result<Plot> {
    let ends = [dvec2(-2.0, -0.3), dvec2(2.0, 0.3)];
    let upper = Quadratic::circular_arc(DVec2::ZERO, ends, [1.0, 1.0])?;
    let lower = upper.complement();
    let mut plot = Plot::geometry("semicircles: a vector in the middle");
    for (curve, color, name, side) in [
        (upper, BLUE, "v", Side::Right),
        (lower, VERMILION, "−v", Side::Right),
    ] {
        let vector = curve.control()[1].weighted;
        trace(&mut plot, &curve, color.line().width(2.4));
        plot.arrow(DVec2::ZERO, vector, color.line());
        plot.colored_text(0.6 * vector, name, side, color.line());
    }
    plot.segment(ends[0], ends[1], GREY.line().dashed());
    plot.point(ends[0], "P₀", Side::Left, INK.fill());
    plot.point(ends[1], "P₂", Side::Right, INK.fill());
    Ok(plot)
}

/// Theorem 1: the minor arc, and the major arc by the opposite middle weight.
fn both_arcs() -> Result<Plot> {
    let ends = [PI / 6.0, 5.0 * PI / 6.0].map(DVec2::from_angle);
    let minor = Quadratic::circular_arc(DVec2::ZERO, ends, [1.0, 1.0])?;
    let top = minor.control()[1].position().context("P1 is a point")?;
    let weight = minor.control()[1].weight;
    let mut plot = Plot::geometry("Theorem 1: both arcs of a circle");
    plot.polyline(&[ends[0], top, ends[1]], GREY.line().dashed());
    trace(&mut plot, &minor, BLUE.line().width(2.4));
    trace(&mut plot, &minor.complement(), VERMILION.line().width(2.4));
    plot.point(ends[0], "P₀", Side::Right, INK.fill());
    plot.point(ends[1], "P₂", Side::Left, INK.fill());
    plot.point(top, "P₁", Side::Right, INK.fill());
    plot.colored_text(
        0.62 * DVec2::Y,
        &format!("w₁ = {weight:.2}"),
        Side::Centre,
        BLUE.line(),
    );
    plot.colored_text(
        -0.62 * DVec2::Y,
        &format!("w₁ = −{weight:.2}"),
        Side::Centre,
        VERMILION.line(),
    );
    Ok(plot)
}

/// Fig. 2: the arc, and its conic as a semicircle that passes through infinity.
fn hyperbola_as_semicircle(arc: &Quadratic<DVec2>, half: &Quadratic<DVec2>) -> Result<Plot> {
    let centre = half
        .centre()
        .position()
        .context("a hyperbola has a centre")?;
    let [start, _, end] = half.control().map(MassPoint::position);
    let (start, end) = (
        start.context("Q0 is a point")?,
        end.context("Q2 is a point")?,
    );
    let vector = half.control()[1].weighted;
    let reach = DVec2::splat(2.2 * (start - centre).length().max(vector.length()));
    let mut plot = Plot::geometry("Theorem 2: a hyperbola as a semicircle");
    plot.view(centre - reach, centre + reach);
    asymptotes(&mut plot, &half.conic());
    trace(&mut plot, half, SKY.line().width(2.0));
    trace(&mut plot, arc, BLUE.line().width(4.0));
    plot.arrow(centre, centre + vector, VERMILION.line());
    plot.colored_text(centre + 0.7 * vector, "Q₁", Side::Right, VERMILION.line());
    plot.point(start, "Q₀ (weight 1)", Side::Right, INK.fill());
    plot.point(end, "Q₂ (weight −1)", Side::Left, INK.fill());
    plot.points(&[centre], Marker::Cross, GREY.line());
    Ok(plot)
}

/// A branch from asymptote to asymptote: vectors at both ends.
fn branch_between_vectors() -> Result<Plot> {
    let (centre, first, last) = (dvec2(1.0, 2.0), dvec2(2.0, 1.6), dvec2(2.0, -1.4));
    let branch = Quadratic::new([
        MassPoint::vector(first),
        MassPoint::point(centre, 1.0),
        MassPoint::vector(last),
    ])?;
    let mut plot = Plot::geometry("a branch between two vectors");
    plot.view(centre - DVec2::splat(4.5), centre + DVec2::splat(4.5));
    let conic = branch.conic();
    asymptotes(&mut plot, &conic);
    features(&mut plot, &conic);
    trace(&mut plot, &branch, BLUE.line().width(2.4));
    trace(&mut plot, &branch.complement(), SKY.line().width(2.0));
    for (vector, name, side) in [
        (first, "P₀", Side::AboveLeft),
        (last, "P₂", Side::BelowLeft),
    ] {
        plot.arrow(centre, centre + vector, VERMILION.line());
        plot.colored_text(centre + 0.55 * vector, name, side, VERMILION.line());
    }
    plot.point(centre, "P₁", Side::Left, INK.fill());
    Ok(plot)
}

/// Half an ellipse from conjugate semi-diameters.
fn half_ellipse() -> Result<Plot> {
    let (end, vector) = (dvec2(2.6, 0.7), dvec2(0.5, 1.6));
    let half = Quadratic::new([
        MassPoint::point(end, 1.0),
        MassPoint::vector(vector),
        MassPoint::point(-end, 1.0),
    ])?;
    let mut plot = Plot::geometry("half an ellipse: conjugate semi-diameters");
    plot.view(dvec2(-4.2, -3.2), dvec2(4.2, 3.2));
    features(&mut plot, &half.conic());
    trace(&mut plot, &half.complement(), SKY.line().width(2.0));
    trace(&mut plot, &half, BLUE.line().width(2.4));
    plot.arrow(DVec2::ZERO, vector, VERMILION.line());
    plot.colored_text(vector, "P₁", Side::Above, VERMILION.line());
    plot.point(end, "P₀", Side::Right, INK.fill());
    plot.point(-end, "P₂", Side::Left, INK.fill());
    Ok(plot)
}

/// Half a parabola from a point and two vectors.
fn parabola() -> Result<Plot> {
    let (start, tangent, axis) = (dvec2(-1.0, 0.0), dvec2(1.3, -1.0), dvec2(1.2, 2.4));
    let half = Quadratic::new([
        MassPoint::point(start, 1.0),
        MassPoint::vector(tangent),
        MassPoint::vector(axis),
    ])?;
    let mut plot = Plot::geometry("a parabola: a point and two vectors");
    plot.view(dvec2(-3.5, -2.2), dvec2(4.0, 4.2));
    features(&mut plot, &half.conic());
    trace(&mut plot, &half.complement(), SKY.line().width(2.0));
    trace(&mut plot, &half, BLUE.line().width(2.4));
    for (vector, name, side) in [(tangent, "P₁", Side::Below), (axis, "P₂", Side::Right)] {
        plot.arrow(start, start + vector, VERMILION.line());
        plot.colored_text(start + vector, name, side, VERMILION.line());
    }
    plot.point(start, "P₀", Side::Left, INK.fill());
    Ok(plot)
}

/// The curve over its parameter interval, interrupted where it is at infinity.
fn trace(plot: &mut Plot, curve: &Quadratic<DVec2>, style: Style) {
    // What is beyond this is far outside every plot.
    const FAR: f64 = 60.0;
    let position = |t: f64| curve.point(t).ok().filter(|p| p.length() < FAR);
    plot.trace(|t| position(t).unwrap_or(DVec2::NAN), 0.0, 1.0, style);
}

/// Foci, vertices and directrices of a conic.
fn features(plot: &mut Plot, conic: &Conic) {
    let (foci, vertices, directrices) = match conic {
        Conic::Ellipse(conic) | Conic::Hyperbola(conic) => (
            conic.foci().to_vec(),
            conic.vertices().to_vec(),
            conic.directrices().to_vec(),
        ),
        Conic::Parabola(parabola) => (
            vec![parabola.focus],
            vec![parabola.vertex()],
            vec![parabola.directrix],
        ),
        Conic::Circle(_) | Conic::Degenerate(_) => return,
    };
    for line in directrices {
        straight(plot, line, ORANGE.line().label("directrix"));
    }
    plot.points(&vertices, Marker::Square, GREY.fill().label("vertex"));
    plot.points(&foci, Marker::Disc, GREEN.fill().label("focus"));
}

fn straight(plot: &mut Plot, line: Line, style: Style) {
    let (foot, along) = (line.normal * line.offset, line.normal.perp() * 50.0);
    plot.segment(foot - along, foot + along, style);
}

fn asymptotes(plot: &mut Plot, conic: &Conic) {
    if let Conic::Hyperbola(hyperbola) = conic {
        for direction in hyperbola.asymptotes().into_iter().flatten() {
            let along = direction * 50.0;
            let [from, to] = [hyperbola.centre - along, hyperbola.centre + along];
            plot.segment(from, to, GREY.line().dashed().label("asymptote"));
        }
    }
}

fn quadratic(control: [(DVec2, f64); 3]) -> Result<Quadratic<DVec2>> {
    Ok(Quadratic::new(control.map(|(position, weight)| {
        MassPoint::point(position, weight)
    }))?)
}

/// The largest relative distance of arcs of every opening and their complements from the circle.
fn circle_residual(count: usize) -> Result<f64> {
    let centre = dvec2(1.3, -0.4);
    let mut largest = 0.0_f64;
    for i in 1..=count {
        let (radius, opening) = (0.1 * i as f64, PI * i as f64 / count as f64);
        let ends = [0.3, 0.3 + opening].map(|angle| centre + radius * DVec2::from_angle(angle));
        let arc = Quadratic::circular_arc(centre, ends, [1.0 + 0.01 * i as f64, 0.7])?;
        for curve in [arc, arc.complement()] {
            for step in 0..=64 {
                let distance = curve.point(f64::from(step) / 64.0)?.distance(centre);
                largest = largest.max((distance / radius - 1.0).abs());
            }
        }
    }
    Ok(largest)
}

/// A family of hyperbola arcs with middle weights from 1.01 to 5, and their semicircles.
fn hyperbolas(count: usize) -> impl Iterator<Item = Result<[Quadratic<DVec2>; 2]>> {
    (0..count).map(move |i| {
        let share = i as f64 / count as f64;
        let points = [
            dvec2(1.0, share),
            dvec2(2.0 - share, 2.0),
            dvec2(4.0, -1.0 - share),
        ];
        let weight = 1.01 * (5.0_f64 / 1.01).powf(share);
        let arc = quadratic([(points[0], 1.0), (points[1], weight), (points[2], 1.0)])?;
        let half = if i % 2 == 0 {
            Half::Along
        } else {
            Half::Against
        };
        Ok([
            arc,
            Quadratic::hyperbola_as_semicircle(points, weight, half)?,
        ])
    })
}

/// The largest residual of the semicircles in the equation of the hyperbola that they are made from, relative to the size
/// of the equation's terms.
fn hyperbola_residual(count: usize) -> Result<f64> {
    let mut largest = 0.0_f64;
    for pair in hyperbolas(count) {
        let [arc, half] = pair?;
        let conic = arc.conic();
        let Conic::Hyperbola(hyperbola) = conic else {
            anyhow::bail!("the arc is no hyperbola: {conic:?}")
        };
        let [along, across] = hyperbola.semi_axes();
        for step in 0..=64 {
            if let MassPointKind::Point { position, .. } = half.at(f64::from(step) / 64.0).kind() {
                let from_centre = (position - hyperbola.centre).length_squared();
                let terms = 1.0 + from_centre / along.min(across).powi(2);
                let residual = conic.implicit(position).context("a proper conic")?;
                largest = largest.max(residual.abs() / terms);
            }
        }
    }
    Ok(largest)
}

/// The largest relative distance between a reparametrised curve and the curve at the changed parameter.
fn reparametrisation_error(count: usize) -> Result<f64> {
    let curve = quadratic([
        (dvec2(0.0, 0.0), 1.0),
        (dvec2(1.0, 2.0), 0.5),
        (dvec2(3.0, 1.0), 2.0),
    ])?;
    let mut largest = 0.0_f64;
    for i in 0..count {
        let angle = 2.0 * PI * i as f64 / count as f64;
        let [a, c] = DVec2::from_angle(angle).to_array();
        let [b, d] = DVec2::from_angle(2.0 * angle + 1.0).to_array();
        // Nearly coincident ends make a short arc and lose the digits that they agree in.
        if (a * d - b * c).abs() < 0.05 {
            continue;
        }
        let homography = Homography::new(a, b, c, d)?;
        let changed = curve.reparametrised(homography);
        for step in 0..=32 {
            let u = f64::from(step) / 32.0;
            let (here, there) = (changed.point(u)?, curve.at_parameter(homography.apply(u)));
            let there = there.position().context("the ellipse is bounded")?;
            largest = largest.max(here.distance(there) / (1.0 + there.length()));
        }
    }
    Ok(largest)
}

/// The largest angle between the vector at the vanishing weight, the direction of travel there, and the asymptote of the
/// conic.
fn asymptote_error(count: usize) -> Result<f64> {
    let mut largest = 0.0_f64;
    for pair in hyperbolas(count) {
        let [arc, half] = pair?;
        let Conic::Hyperbola(hyperbola) = arc.conic() else {
            anyhow::bail!("the arc is no hyperbola")
        };
        let asymptotes = hyperbola
            .asymptotes()
            .context("a hyperbola has asymptotes")?;
        let MassPointKind::Vector(value) = half.at(0.5).kind() else {
            anyhow::bail!("the weight does not vanish in the middle")
        };
        let travel = half
            .tangent_direction(0.5)
            .context("a direction of travel")?;
        for direction in [value, travel] {
            let off = asymptotes.map(|a| a.perp_dot(direction).atan2(a.dot(direction).abs()).abs());
            largest = largest.max(off[0].min(off[1]));
        }
    }
    Ok(largest)
}
