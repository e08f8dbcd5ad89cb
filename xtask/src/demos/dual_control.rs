//! Dual control structures: Bézier and Farin lines, Tschirnhausen cubics, admissible elements, the width function.
//!
//! What one sees in the picture, left to right: the three grey Bézier lines and more of a dual curve with its dashed
//! Farin lines through their vertices, and the curve that touches the outer lines; Tschirnhausen cubics inside triangles,
//! their inner control points at equal distances from the corner; two curvature elements with their circles, the triangle
//! of the evolute and the pair of quartics between them; the inner Bézier lines of both arcs through the centre of
//! similarity of their end circles (Theorem 4); the cubics around a triangle whose involute is an oval of constant width;
//! the cubics around a pentagon, which meet in cusps on its sides; a circle whose arcs have chords as their middle lines in
//! class 2 and a polygon of Bézier lines in class 6; the width of an ellipse against the direction, a wave, and that of the
//! oval, a straight line.

use anyhow::Result;
use glam::{DVec2, DVec3, dvec2};
use ph_curves::{
    CurvatureElement, DualCurve, EvolutePolygon, G2Pair, Line, PhArc, TCubic, TQuartic,
    similarity_centre,
};

use crate::color::{BLUE, GREEN, GREY, INK, ORANGE, VERMILION};
use crate::demo::{Context, Demo};
use crate::figure::{Figure, Marker, Plot, Side};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct DualControl {}

impl Demo for DualControl {
    const NAME: &'static str = "dual-control";
    const PAPER: &'static str =
        "ph-geodesic-variation-wavefront, Figs 1.1 to 1.5, 1.9, 1.10, 1.12, 1.14";
    const ABOUT: &'static str =
        "Bézier and Farin lines, T-cubics, admissible elements, the width function";

    fn run(&self, context: &mut Context) -> Result<()> {
        let samples = context.pick(400, 60);
        let curve = dual_curve()?;
        let pair = pair()?;
        context.number(
            "dual_to_point_max_error",
            dual_to_point_error(&curve, &pair, samples)?,
            Target::AtMost(1e-12),
        );
        context.number(
            "theorem4_max_error",
            theorem4_error(&pair)?,
            Target::AtMost(1e-10),
        );
        let plots = vec![
            dual_plot(&curve)?,
            triangle_plot()?,
            element_plot(&pair)?,
            theorem4_plot(&pair)?,
            oval_plot()?,
            pentagon_plot()?,
            circle_plot()?,
            width_plot()?,
        ];
        context.figure(
            "figure",
            &Figure::grid(3, plots).aspect(0.95),
            "A dual Bézier curve of class 3 with its Farin lines; Tschirnhausen cubics in triangles; two admissible curvature \
             elements and the quartics between them; Theorem 4; an oval of constant width from a triangle; the cubics of a \
             pentagon; a circle by Bézier lines of class 2 and 6; width functions.",
            "Eight plots with curves, the lines that control them and, in the last one, two width functions.",
        )
    }
}

fn dual_curve() -> Result<DualCurve> {
    let lines = [
        (-1.0, 1.0, 0.1),
        (-1.5, 1.2, 0.8),
        (-1.2, 0.5, 1.3),
        (-1.1, -0.3, 1.0),
    ];
    let lines: Result<Vec<Line>, _> = lines.iter().map(|&(a, b, c)| Line::new(a, b, c)).collect();
    Ok(DualCurve::new(&lines?)?)
}

/// Elements of a logarithmic spiral a good quarter turn apart.
fn elements() -> Result<[CurvatureElement; 2]> {
    let element = |theta: f64| {
        let normal = dvec2(1.0, -0.35).rotate(DVec2::from_angle(theta));
        let r = (0.35 * theta).exp();
        CurvatureElement::new(DVec2::from_angle(theta) * r, normal, r * 1.1225_f64.sqrt())
    };
    Ok([element(0.2)?, element(2.2)?])
}

fn pair() -> Result<G2Pair> {
    let [start, end] = elements()?;
    Ok(G2Pair::new(&start, &end, 0.5)?)
}

/// Largest distance between points of the dual form and of the exact rational point form.
fn dual_to_point_error(curve: &DualCurve, pair: &G2Pair, samples: usize) -> Result<f64> {
    let mut worst = 0.0_f64;
    for dual in [
        curve.clone(),
        DualCurve::from(&pair.arcs[0]),
        DualCurve::from(&pair.arcs[1]),
    ] {
        let points = dual.to_points()?;
        for k in 0..=samples {
            let t = k as f64 / samples as f64;
            worst = worst.max((points.point(t)? - dual.contact(t)?.point).length());
        }
    }
    Ok(worst)
}

/// The centre of similarity of the end circles of an arc.
fn centre(arc: &TQuartic) -> Result<DVec2> {
    let ends = [arc.contact(0.0), arc.contact(1.0)];
    Ok(similarity_centre(
        ends.map(|end| end.centre()),
        ends.map(|end| end.radius),
    )?)
}

/// Largest distance of the centres of similarity from the inner Bézier lines.
fn theorem4_error(pair: &G2Pair) -> Result<f64> {
    let mut worst = 0.0_f64;
    for arc in &pair.arcs {
        let lines = arc.control_vectors();
        for vector in &lines[1..3] {
            worst = worst.max(
                Line::try_from(*vector)?
                    .signed_distance(centre(arc)?)?
                    .abs(),
            );
        }
    }
    Ok(worst)
}

/// Two points of a line, `reach` to both sides of its point nearest to `near`.
fn drawn_line(vector: DVec3, near: DVec2, reach: f64) -> Result<[DVec2; 2]> {
    let line = Line::try_from(vector)?;
    let normal = line.normal().normalize();
    let foot = near - normal * line.signed_distance(near)?;
    Ok([foot - normal.perp() * reach, foot + normal.perp() * reach])
}

fn dual_plot(curve: &DualCurve) -> Result<Plot> {
    let mut plot = Plot::geometry("dual Bézier curve");
    plot.view(dvec2(-0.9, -0.9), dvec2(1.9, 1.7));
    let middle = curve.contact(0.5)?.point;
    for (k, vector) in curve.vectors().iter().enumerate() {
        let [a, b] = drawn_line(*vector, middle, 3.0)?;
        let style = GREY.line();
        plot.segment(
            a,
            b,
            if k == 0 {
                style.label("Bézier lines")
            } else {
                style
            },
        );
    }
    for (k, vector) in curve.farin().iter().enumerate() {
        let [a, b] = drawn_line(*vector, middle, 3.0)?;
        let style = ORANGE.line().width(1.0).dashed();
        plot.segment(
            a,
            b,
            if k == 0 {
                style.label("Farin lines")
            } else {
                style
            },
        );
    }
    let point = |t: f64| curve.contact(t).map_or(DVec2::NAN, |contact| contact.point);
    plot.trace(point, 0.0, 1.0, BLUE.line().width(2.4).label("envelope"));
    let vertices: Vec<DVec2> = curve
        .vertices()
        .iter()
        .map(|x| dvec2(x.y, x.z) / x.x)
        .collect();
    plot.points(&vertices, Marker::Ring, INK.line());
    Ok(plot)
}

fn triangle_plot() -> Result<Plot> {
    let mut plot = Plot::geometry("T-cubics in triangles");
    for (corners, shift, beside_f) in [
        (
            [dvec2(0.0, 0.0), dvec2(2.0, 0.0), dvec2(1.4, 1.3)],
            DVec2::ZERO,
            Side::AboveRight,
        ),
        (
            [dvec2(0.0, 0.0), dvec2(2.0, 0.0), dvec2(3.5, 0.7)],
            dvec2(-0.6, -1.4),
            Side::BelowRight,
        ),
    ] {
        let [a, b, c] = corners.map(|corner| corner + shift);
        let cubic = TCubic::in_triangle(a, b, c)?;
        plot.polygon(&[a, b, c], GREY.line().dashed());
        plot.polyline(cubic.points(), ORANGE.line().width(1.2));
        plot.trace(|t| cubic.point(t), 0.0, 1.0, BLUE.line().width(2.4));
        plot.points(cubic.points(), Marker::Disc, INK.line());
        for (point, name, side) in [
            (a, "A", Side::BelowLeft),
            (b, "B", Side::BelowRight),
            (c, "C", Side::Above),
        ] {
            plot.text(point, name, side);
        }
        plot.text(cubic.points()[1], "E", Side::Below);
        plot.text(cubic.points()[2], "F", beside_f);
    }
    Ok(plot)
}

fn element_plot(pair: &G2Pair) -> Result<Plot> {
    let mut plot = Plot::geometry("elements and evolute");
    let [start, end] = elements()?;
    for (element, name, side) in [(start, "P₀", Side::Right), (end, "P₁", Side::Above)] {
        plot.circle(
            element.centre(),
            element.radius(),
            GREY.line().width(1.0).dotted(),
        );
        plot.segment(element.centre(), element.point(), GREY.line());
        plot.point(element.point(), name, side, INK.line());
    }
    for (arc, color) in pair.arcs.iter().zip([BLUE, VERMILION]) {
        plot.trace(|t| arc.point(t), 0.0, 1.0, color.line().width(2.4));
        let evolute = arc.evolute();
        plot.trace(|t| evolute.point(t), 0.0, 1.0, color.line());
    }
    plot.point(pair.joint.point(), "", Side::Above, GREEN.line());
    plot.segment(
        pair.joint.centre(),
        pair.joint.point(),
        GREEN.line().width(1.0).dashed(),
    );
    Ok(plot)
}

fn theorem4_plot(pair: &G2Pair) -> Result<Plot> {
    let mut plot = Plot::geometry("Theorem 4");
    let arc = &pair.arcs[1];
    let s = centre(arc)?;
    for t in [0.0, 1.0] {
        let contact = arc.contact(t);
        plot.circle(
            contact.centre(),
            contact.radius,
            GREY.line().width(1.0).dotted(),
        );
    }
    let lines = arc.control_vectors();
    for (k, vector) in lines.iter().enumerate() {
        let [a, b] = drawn_line(*vector, arc.point(0.5), 1.6)?;
        let inner = k == 1 || k == 2;
        plot.segment(a, b, if inner { ORANGE.line() } else { GREY.line() });
    }
    plot.trace(|t| arc.point(t), 0.0, 1.0, VERMILION.line().width(2.4));
    plot.point(s, "S", Side::AboveRight, INK.line());
    Ok(plot)
}

/// The acute triangle of the oval and its width.
fn oval() -> Result<(EvolutePolygon, f64)> {
    let polygon = EvolutePolygon::try_new(&[dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(0.45, 0.8)])?;
    let width = 1.6 * polygon.minimum_width();
    Ok((polygon, width))
}

fn oval_plot() -> Result<Plot> {
    let mut plot = Plot::geometry("oval of constant width");
    let (polygon, width) = oval()?;
    for cubic in polygon.cubics() {
        plot.polyline(cubic.points(), GREY.line().width(1.0));
        plot.trace(|t| cubic.point(t), 0.0, 1.0, ORANGE.line());
    }
    for arc in polygon.arcs(width)? {
        plot.trace(|t| arc.point(t), 0.0, 1.0, BLUE.line().width(2.4));
        plot.point(arc.point(0.0), "", Side::Above, INK.line());
    }
    Ok(plot)
}

fn pentagon_plot() -> Result<Plot> {
    let mut plot = Plot::geometry("cubics of a pentagon");
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(1.0, -0.1),
        dvec2(1.45, 0.75),
        dvec2(0.6, 1.45),
        dvec2(-0.3, 0.85),
    ];
    let polygon = EvolutePolygon::try_new(&corners)?;
    plot.polygon(&corners, GREY.line().dashed());
    for (k, cubic) in polygon.cubics().iter().enumerate() {
        plot.polyline(cubic.points(), GREY.line().width(1.0));
        plot.trace(|t| cubic.point(t), 0.0, 1.0, BLUE.line().width(2.4));
        plot.point(
            cubic.points()[0],
            ["P₁", "P₂", "P₃", "P₄", "P₅"][k % 5],
            [
                Side::BelowLeft,
                Side::Right,
                Side::Right,
                Side::Right,
                Side::Left,
            ][k % 5],
            INK.line(),
        );
    }
    Ok(plot)
}

/// A third of the unit circle in class `N - 1`.
fn circle_arc<const N: usize>(turn: f64) -> Result<PhArc<N>> {
    let spinor = |angle: f64| DVec2::from_angle(0.5 * angle);
    let third = std::f64::consts::TAU / 3.0;
    let point = PhArc::<N>::new(spinor(turn), spinor(turn + third), [0.0; N])?;
    Ok(point.offset(1.0))
}

fn circle_plot() -> Result<Plot> {
    let mut plot = Plot::geometry("a circle in class 2 and 6");
    for third in 0..3 {
        let turn = f64::from(third) * std::f64::consts::TAU / 3.0;
        let (low, high) = (circle_arc::<3>(turn)?, circle_arc::<7>(turn)?);
        for (curve, color, name) in [
            (DualCurve::from(&low), GREY, "class 2"),
            (DualCurve::from(&high), ORANGE, "class 6"),
        ] {
            let vertices: Vec<DVec2> = curve
                .vertices()
                .iter()
                .map(|x| dvec2(x.y, x.z) / x.x)
                .collect();
            let style = color.line();
            plot.polyline(
                &vertices,
                if third == 0 { style.label(name) } else { style },
            );
            plot.points(&vertices, Marker::Ring, color.line());
        }
        plot.trace(|t| high.point(t), 0.0, 1.0, BLUE.line().width(2.4));
        let joint = high.contact(0.0);
        let along = 0.5 * joint.normal.perp();
        plot.segment(joint.point - along, joint.point + along, GREY.line());
    }
    Ok(plot)
}

fn width_plot() -> Result<Plot> {
    let mut plot = Plot::chart("widths", "normal angle ψ", "width");
    let (polygon, width) = oval()?;
    let rosette = polygon.rosette(width)?;
    let (a, b) = (0.62 * width, 0.4 * width);
    let ellipse = |psi: f64| 2.0 * (a * psi.cos()).hypot(b * psi.sin());
    plot.graph(
        ellipse,
        0.0,
        std::f64::consts::TAU,
        VERMILION.line().label("ellipse"),
    );
    plot.graph(
        |psi| rosette.width(psi),
        0.0,
        std::f64::consts::TAU,
        BLUE.line().label("oval"),
    );
    Ok(plot)
}
