//! Five figures and an animation. A cubic with its polar derivative (Fig. 4.1); a polynomial with two roots whose two halves
//! of the control polygon, read as polynomials, have none (Fig. 4.2); a curve beside the bold one made of polygon, inner
//! Bézier curve and polygon, with lines and their bounds (Fig. 4.3); a pole at one third (Fig. 4.4); and chains of poles that
//! bring the bound from three to one (Fig. 4.5). In the animation the pole runs through the interval and the bold polygon
//! follows, with the bound that it gives.

mod measure;

use anyhow::{Context as _, Result, ensure};
use glam::{DVec2, dvec2};
use variation::{
    ChainBound, Curve, Line, PoleStrategy, chain_bound, chain_bound_by, corollary_bound,
    polar_derivative, roots, sign_changes,
};

use crate::color::{BLUE, GREEN, GREY, INK, MIST, ORANGE, VERMILION};
use crate::demo::{BadInput, Context, Demo};
use crate::figure::{Corner, Figure, Marker, Plot, Side};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Variation {
    /// Pole of the cubic's polar derivative in the first figure, in [0, 1]
    #[arg(long, default_value_t = 0.4)]
    pole: f64,
}

/// One root, three sign changes of the control polygon; the pole 1/2 shows that there is one root.
const THREE_TO_ONE: [f64; 6] = [-11.0, 7.0, -9.0, -5.0, -12.0, 12.0];

/// The many-pole example: poles at which the chain vanishes.
const VANISHING: [f64; 6] = [4.0, -2.0, 14.0, 3.0, -7.0, -5.0];

/// Two roots, but none in either half of the polygon.
const SUBPOLYNOMIALS: [f64; 6] = [12.0, -9.0, 7.0, -8.0, 7.0, 12.0];

/// The curve that lines meet in Figs. 4.3 and 4.4.
const CURVE: [DVec2; 7] = [
    dvec2(0.0, 0.6),
    dvec2(0.6, 2.9),
    dvec2(1.7, 3.6),
    dvec2(2.9, 2.7),
    dvec2(3.9, 3.9),
    dvec2(5.2, 3.1),
    dvec2(5.6, 0.4),
];

impl Demo for Variation {
    const NAME: &'static str = "variation";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs. 4.1 to 4.5";
    const ABOUT: &'static str = "Refined variation-diminishing bounds by poles";

    fn run(&self, context: &mut Context) -> Result<()> {
        ensure!(
            (0.0..=1.0).contains(&self.pole),
            BadInput(format!("--pole {} lies outside [0, 1]", self.pole))
        );
        context.figure(
            "figure1",
            &Figure::new(polar_cubic(self.pole)?),
            "A cubic and its polar derivative (Fig. 4.1): one edge point on each edge of the control polygon, at the share of \
             the pole. The two curves meet at the pole, with a common tangent.",
            "A cubic Bézier curve with its control polygon, and the control triangle and curve of its polar derivative.",
        )?;
        context.figure(
            "figure2",
            &Figure::new(subpolynomials()?),
            "The inequality does not add up over parts (Fig. 4.2): the polynomial has two roots, the polynomials of the first \
             three and of the last four coefficients have none.",
            "Graphs of a polynomial of degree five with its control polygon and of two polynomials of lower degree above the axis.",
        )?;
        context.figure(
            "figure3",
            &Figure::grid(1, vec![inner_curve()?, pole_third()?]).aspect(2.0),
            "Above (Fig. 4.3): no line meets the curve more often than the bold line of polygon, inner curve P₁..P₄ and polygon. \
             Below (Fig. 4.4): the same with the polygon of the polar derivative at ζ = 1/3.",
            "Two plots of a Bézier curve with its control polygon, a bold refinement, and lines labelled by their bounds and hits.",
        )?;
        context.figure(
            "figure4",
            &Figure::grid(2, vec![three_to_one()?, vanishing()?]).aspect(1.15),
            "From three to one. Left: the control polygon changes sign three times, the bold polygon of the pole 1/2 once. \
             Right (Fig. 4.5): poles at which end values of the chain vanish; parity decides the zeros.",
            "Two graphs of polynomials of degree five with their control polygons in grey and refined polygons in bold.",
        )?;
        animation(context)?;
        measure::record(context)
    }
}

/// The points of a polynomial's control polygon over [0, 1].
fn control_polygon(coefficients: &[f64]) -> Vec<DVec2> {
    let degree = (coefficients.len() - 1).max(1) as f64;
    coefficients
        .iter()
        .enumerate()
        .map(|(i, p)| dvec2(i as f64 / degree, *p))
        .collect()
}

/// The polygon of a chain: the abscissae are the same chain of `i / n`.
fn chain_polygon(bound: &ChainBound<f64>, degree: usize, poles: &[f64]) -> Result<Vec<DVec2>> {
    let abscissae: Vec<f64> = (0..=degree).map(|i| i as f64 / degree as f64).collect();
    let x = chain_bound(&abscissae, poles)?.polygon;
    Ok(x.into_iter()
        .zip(&bound.polygon)
        .map(|(x, y)| dvec2(x, *y))
        .collect())
}

fn graph(coefficients: &[f64], t: f64) -> f64 {
    variation::blossom(coefficients, &vec![t; coefficients.len() - 1]).unwrap_or(f64::NAN)
}

fn polar_cubic(pole: f64) -> Result<Plot> {
    let p = [(0.0, 0.0), (0.7, 2.2), (3.2, 2.6), (4.4, 0.3)].map(DVec2::from);
    let q = polar_derivative(&p, &pole)?;
    let (curve, polar) = (Curve::polynomial(&p)?, Curve::polynomial(&q)?);
    let mut plot = Plot::geometry(&format!("a cubic and its polar derivative, pole {pole}"));
    plot.polyline(&p, GREY.line().dashed());
    plot.polyline(&q, VERMILION.line().dashed());
    plot.trace(
        |t| curve.point(t),
        0.0,
        1.0,
        BLUE.line().width(2.4).label("F"),
    );
    plot.trace(
        |t| polar.point(t),
        0.0,
        1.0,
        VERMILION.line().width(2.4).label("F_ζ"),
    );
    let names = [
        "p₀ = f(a,a,a)",
        "p₁ = f(a,a,b)",
        "p₂ = f(a,b,b)",
        "p₃ = f(b,b,b)",
    ];
    let sides = [Side::BelowRight, Side::Above, Side::Above, Side::BelowLeft];
    for ((at, name), side) in p.into_iter().zip(names).zip(sides) {
        plot.point(at, name, side, INK.fill());
    }
    let names = ["q₀ = f(a,a,ζ)", "q₁ = f(a,b,ζ)", "q₂ = f(b,b,ζ)"];
    let sides = [Side::Left, Side::Above, Side::Right];
    for ((at, name), side) in q.iter().zip(names).zip(sides) {
        plot.point(*at, name, side, VERMILION.fill());
    }
    plot.point(
        curve.point(pole),
        "F(ζ) = F_ζ(ζ)",
        Side::BelowRight,
        GREEN.fill(),
    );
    plot.legend(Corner::BottomRight);
    Ok(plot)
}

fn subpolynomials() -> Result<Plot> {
    let mut plot = Plot::chart("two roots, but none in either part", "t", "");
    plot.view(dvec2(-0.04, -11.0), dvec2(1.04, 20.0));
    let polygon = control_polygon(&SUBPOLYNOMIALS);
    plot.segment(dvec2(0.0, 0.0), dvec2(1.0, 0.0), INK.line().width(0.8));
    plot.polyline(&polygon, GREY.line().dashed().label("control polygon of F"));
    for (part, color, name) in [
        (&SUBPOLYNOMIALS[..], BLUE, "F: p₀ .. p₅"),
        (&SUBPOLYNOMIALS[..3], GREEN, "F₁: p₀ p₁ p₂"),
        (&SUBPOLYNOMIALS[2..], ORANGE, "F₂: p₂ p₃ p₄ p₅"),
    ] {
        let label = format!("{name}, {} roots", roots(part)?.len());
        plot.graph(
            |t| graph(part, t),
            0.0,
            1.0,
            color.line().width(2.4).label(label),
        );
    }
    plot.points(&polygon, Marker::Ring, INK.line());
    let found: Vec<DVec2> = roots(&SUBPOLYNOMIALS)?
        .iter()
        .map(|root| dvec2(root.value(), 0.0))
        .collect();
    plot.points(&found, Marker::Disc, BLUE.fill());
    plot.legend(Corner::TopRight);
    Ok(plot)
}

/// Two lines that cross the curve twice and one that misses it.
fn lines() -> Result<Vec<(Line, [DVec2; 2])>> {
    [
        [dvec2(-0.3, 2.92), dvec2(6.2, 3.02)],
        [dvec2(-0.3, 1.5), dvec2(6.2, 1.9)],
        [dvec2(-0.3, 3.35), dvec2(6.2, 3.6)],
    ]
    .into_iter()
    .map(|[p, q]| Ok((Line::through(p, q)?, [p, q])))
    .collect()
}

/// A line with its number of hits, the bound of the bold line and that of the control polygon.
fn draw_lines(
    plot: &mut Plot,
    curve: Curve<'_>,
    refined: impl Fn(&[f64]) -> Result<usize>,
) -> Result<()> {
    for (k, (line, [p, q])) in lines()?.into_iter().enumerate() {
        let coefficients = curve.line_coefficients(line);
        let hits = curve.meet_line(line)?;
        plot.segment(p, q, GREEN.line());
        let points: Vec<DVec2> = hits.iter().map(|hit| hit.point).collect();
        plot.points(&points, Marker::Disc, GREEN.fill());
        let counts = format!(
            "Δ{}: {} ≤ {} ≤ {}",
            k + 1,
            hits.len(),
            refined(&coefficients)?,
            sign_changes(&coefficients)
        );
        plot.colored_text(q, &counts, Side::Right, GREEN.line());
    }
    Ok(())
}

fn curve_with_polygon(title: &str) -> Result<(Plot, Curve<'static>)> {
    let curve = Curve::polynomial(&CURVE)?;
    let mut plot = Plot::geometry(title);
    plot.view(dvec2(-0.6, 0.2), dvec2(8.2, 4.2));
    plot.polyline(&CURVE, GREY.line().dashed().label("control polygon"));
    plot.trace(
        |t| curve.point(t),
        0.0,
        1.0,
        BLUE.line().width(2.4).label("curve"),
    );
    Ok((plot, curve))
}

fn inner_curve() -> Result<Plot> {
    let (k, l) = (1, 4);
    let (mut plot, curve) =
        curve_with_polygon("polygon, inner curve P₁..P₄, polygon: hits ≤ bold ≤ polygon")?;
    let inner = Curve::polynomial(&CURVE[k..=l])?;
    let bold = VERMILION.line().width(3.0);
    plot.polyline(&CURVE[..=k], bold.clone());
    plot.trace(|t| inner.point(t), 0.0, 1.0, bold.clone());
    plot.polyline(&CURVE[l..], bold.label("bold line"));
    draw_lines(&mut plot, curve, |p| {
        let bound = corollary_bound(p, k, l)?;
        let inside = roots(&bound.middle)?
            .iter()
            .filter_map(|root| root.multiplicity())
            .sum::<u32>();
        Ok(bound.total(inside as usize))
    })?;
    plot.points(&CURVE, Marker::Disc, INK.fill());
    Ok(plot)
}

fn pole_third() -> Result<Plot> {
    let pole = 1.0 / 3.0;
    let (mut plot, curve) = curve_with_polygon("one pole at 1/3: hits ≤ bold ≤ polygon")?;
    let inner = polar_derivative(&CURVE, &pole)?;
    let [first, .., last] = CURVE;
    let bold: Vec<DVec2> = std::iter::once(first)
        .chain(inner.iter().copied())
        .chain([last])
        .collect();
    plot.polyline(&bold, VERMILION.line().width(3.0).label("bold line"));
    draw_lines(&mut plot, curve, |p| Ok(chain_bound(p, &[pole])?.best))?;
    plot.points(&CURVE, Marker::Disc, INK.fill());
    plot.points(&inner, Marker::Square, VERMILION.fill());
    Ok(plot)
}

/// Graph, control polygon and the polygon of a chain.
fn chain_plot(title: &str, coefficients: &[f64], poles: &[f64]) -> Result<Plot> {
    let degree = coefficients.len() - 1;
    let bound = chain_bound(coefficients, poles)?;
    let bold = chain_polygon(&bound, degree, poles)?;
    let polygon = control_polygon(coefficients);
    let mut plot = Plot::chart(title, "t", "");
    plot.segment(dvec2(0.0, 0.0), dvec2(1.0, 0.0), INK.line().width(0.8));
    let changes = sign_changes(coefficients);
    plot.polyline(
        &polygon,
        GREY.line()
            .dashed()
            .label(format!("control polygon: at most {changes}")),
    );
    let label = format!("with poles: at most {}", bound.best);
    plot.polyline(&bold, VERMILION.line().width(3.0).label(label));
    let found = roots(coefficients)?;
    let label = format!(
        "F: {} root{}",
        found.len(),
        if found.len() == 1 { "" } else { "s" }
    );
    plot.graph(
        |t| graph(coefficients, t),
        0.0,
        1.0,
        BLUE.line().width(2.4).label(label),
    );
    plot.points(&polygon, Marker::Ring, INK.line());
    plot.points(&bold, Marker::Dot, VERMILION.fill());
    let at: Vec<DVec2> = found.iter().map(|root| dvec2(root.value(), 0.0)).collect();
    plot.points(&at, Marker::Disc, BLUE.fill());
    plot.legend(Corner::TopRight);
    Ok(plot)
}

fn three_to_one() -> Result<Plot> {
    let mut plot = chain_plot("one pole at 1/2", &THREE_TO_ONE, &[0.5])?;
    plot.view(dvec2(-0.04, -14.0), dvec2(1.04, 26.0));
    plot.legend(Corner::TopLeft);
    Ok(plot)
}

fn vanishing() -> Result<Plot> {
    // f(0,0,0,0,z1) = 0 and f(0,1,1,z1,z2) = 0, then the end b three times.
    let mut plot = chain_plot(
        "poles where the chain vanishes",
        &VANISHING,
        &[2.0 / 3.0, 20.0 / 31.0, 1.0, 1.0, 1.0],
    )?;
    plot.view(dvec2(-0.04, -9.0), dvec2(1.04, 28.0));
    Ok(plot)
}

/// The pole runs from 0 to 1 and back.
fn animation(context: &mut Context) -> Result<()> {
    let frames = context.pick(60_u32, 8);
    let width = context.width().min(960);
    let images = (0..frames)
        .map(|k| {
            let phase = f64::from(k) / f64::from(frames);
            let pole = 0.5 - 0.5 * (std::f64::consts::TAU * phase).cos();
            let mut plot = chain_plot(&format!("pole {pole:.2}"), &THREE_TO_ONE, &[pole])?;
            plot.view(dvec2(-0.04, -14.0), dvec2(1.04, 26.0));
            plot.segment(dvec2(pole, -14.0), dvec2(pole, 26.0), MIST.line());
            plot.points(
                &[dvec2(pole, graph(&THREE_TO_ONE, pole))],
                Marker::Disc,
                GREEN.fill().label("F(ζ)"),
            );
            plot.legend(Corner::TopLeft);
            Ok(Figure::new(plot).image(width))
        })
        .collect::<Result<Vec<_>>>()?;
    context.animation(
        "figure5",
        &images,
        15,
        "The pole runs through the interval: the bold polygon cuts the corners of the control polygon, and its bound falls from \
         three to one and rises again.",
        "Animated graph of a polynomial of degree five with its control polygon; a bold polygon changes with a moving pole.",
    )?;
    let middle = chain_bound(&THREE_TO_ONE, &[0.5])?;
    let greedy = chain_bound_by(&THREE_TO_ONE, 1, PoleStrategy::Greedy)?;
    let exactly = |n: usize| Target::exactly(n);
    context.number(
        "example_polygon_changes",
        sign_changes(&THREE_TO_ONE),
        exactly(3),
    );
    context.number(
        "example_refined_bound",
        middle.best.min(greedy.best),
        exactly(1),
    );
    context.number(
        "example_roots",
        roots(&THREE_TO_ONE).context("the example has roots")?.len(),
        exactly(1),
    );
    Ok(())
}
