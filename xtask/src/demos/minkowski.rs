//! The Minkowski plane, with an ellipse and with a rational curve that is no conic as its unit circle.
//!
//! One sees both indicatrices with their isoperimetrices; a curve with its two frames; its evolute and involute; general
//! offsets, which are the envelopes of the copies of the indicatrix drawn along the curve; the dual control lines of an
//! isoperimetric-hodograph curve, parallel to those of the indicatrix; and ovals of constant Minkowski width.

use std::f64::consts::{PI, TAU};

use anyhow::Result;
use glam::DVec2;
use ph_curves::{
    Bumped, DualCurve, Ellipse, Indicatrix, IsoperimetricArc, MinkowskiPlane, Support,
    constant_width_arcs,
};

use crate::color::{BLUE, GREEN, GREY, INK, MIST, ORANGE, VERMILION};
use crate::demo::{Context, Demo};
use crate::figure::{Figure, Marker, Plot};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Minkowski {
    /// Height of the bumps of the second indicatrix, below 1/15
    #[arg(long, default_value_t = 0.05)]
    bumps: f64,
}

impl Demo for Minkowski {
    const NAME: &'static str = "minkowski";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 1.17 to 1.23";
    const ABOUT: &'static str =
        "General offsets, frames and constant width with respect to an indicatrix";

    fn run(&self, context: &mut Context) -> Result<()> {
        let ellipse = Ellipse { a: 1.6, b: 0.9 };
        let bumped = Bumped { height: self.bumps };
        let ellipse_arc = ellipse.arc(-0.2, 1.9)?;
        let bumped_arc = bumped.arc(-0.2, 1.2)?;
        let first = Study {
            plane: MinkowskiPlane::new(Indicatrix::try_new(ellipse)?),
            arc: ellipse_arc,
            name: "ellipse",
            turn: 0.0,
        };
        let second = Study {
            plane: MinkowskiPlane::new(Indicatrix::try_new(bumped)?),
            arc: bumped_arc,
            name: "class 8",
            turn: 0.25 * PI,
        };
        let ovals = constant_width_arcs(bumped.dual()?.arcs(), 4.0, &moves())?;

        let mut plots = first.plots()?;
        plots.extend(second.plots()?);
        context.figure(
            "figure",
            &Figure::grid(4, plots).aspect(0.9),
            "Above for an ellipse, below for a rational curve of class 8: the indicatrix (blue) and its isoperimetrix \
             (orange); frames along a curve; its evolute (green) and an involute; the offset as the envelope of copies of \
             the indicatrix.",
            "Two rows of four plots of curves in a Minkowski plane.",
        )?;
        context.figure(
            "figure-dual",
            &Figure::grid(2, vec![second.control_plot()?, width_plot(&ovals, &bumped)?]),
            "Left: the Bézier lines of an isoperimetric-hodograph curve and of its offset are parallel to those of the \
             indicatrix. Right: an oval of constant Minkowski width with its copy of the indicatrix.",
            "A curve with its tangent control lines and a parallel curve; an oval beside a dashed curve.",
        )?;

        let dualities = [first.duality_error(), second.duality_error()];
        let duality = dualities.into_iter().fold(0.0, f64::max);
        context.number("duality_max_error", duality, Target::AtMost(1e-9));
        let samples = context.pick(6_000, 3_000);
        let gap = first.sum_gap(samples)?.max(second.sum_gap(samples)?);
        context.number("offset_vs_minkowski_sum_max_gap", gap, Target::AtMost(1e-6));
        context.number("indicatrices", dualities.len(), Target::exactly(2));
        let exact = first.dual_offset_error()?.max(second.dual_offset_error()?);
        context.number("dual_offset_max_error", exact, Target::AtMost(1e-10));
        context.number(
            "width_max_deviation",
            width_deviation(&ovals, &bumped)?,
            Target::AtMost(1e-11),
        );
        Ok(())
    }
}

/// One indicatrix: the plane it measures, and an exact arc of it.
struct Study<S> {
    plane: MinkowskiPlane<S>,
    arc: DualCurve,
    name: &'static str,
    /// The angle by which the curve is turned where its evolute is drawn: facing a sharp vertex of the indicatrix, its radii
    /// of curvature would be large.
    turn: f64,
}

/// A curve that is drawn, with its first two derivatives.
fn curve(t: f64) -> [DVec2; 3] {
    let (sine, cosine) = (1.3 * t).sin_cos();
    [
        DVec2::new(2.4 * t, 0.9 * sine),
        DVec2::new(2.4, 1.17 * cosine),
        DVec2::new(0.0, -1.521 * sine),
    ]
}
const SPAN: f64 = 2.1;

/// A convex curve whose offset is compared with a Minkowski sum: the support function `2.2 + 0.25 cos 2ψ + 0.04 sin 3ψ`.
fn body(psi: f64) -> ph_curves::SupportJet {
    ph_curves::SupportJet {
        support: 2.2 + 0.25 * (2.0 * psi).cos() + 0.04 * (3.0 * psi).sin(),
        slope: -0.5 * (2.0 * psi).sin() + 0.12 * (3.0 * psi).cos(),
        bend: -(2.0 * psi).cos() - 0.36 * (3.0 * psi).sin(),
    }
}
const DISTANCE: f64 = 0.7;

impl<S: Support> Study<S> {
    fn plots(&self) -> Result<Vec<Plot>> {
        let plane = &self.plane;
        let mut duality = Plot::geometry(&format!("U and U₀: {}", self.name));
        duality.trace(
            |psi| plane.indicatrix_point(psi),
            0.0,
            TAU,
            BLUE.line().width(2.0).label("U"),
        );
        duality.trace(
            |psi| plane.isoperimetrix_point(psi),
            0.0,
            TAU,
            ORANGE.line().width(2.0).label("U₀"),
        );
        for psi in [0.4, 2.0] {
            duality.arrow(DVec2::ZERO, plane.indicatrix_point(psi), BLUE.line());
            duality.arrow(DVec2::ZERO, plane.isoperimetrix_point(psi), ORANGE.line());
        }

        let mut frames = Plot::geometry("frames");
        frames.trace(|t| curve(t)[0], 0.0, SPAN, INK.line().width(2.0));
        let turned = |t: f64| curve(t).map(|v| DVec2::from_angle(self.turn).rotate(v));
        let mut bent = Plot::geometry("evolute and involute");
        bent.trace(|t| turned(t)[0], 0.0, SPAN, INK.line().width(2.0));
        for t in [0.25, 0.8, 1.35, 1.9] {
            let [point, derivative, _] = curve(t);
            let frame = plane.frame(derivative)?;
            frames.arrow(
                point,
                point + 0.7 * frame.tangent,
                BLUE.line().label("tangent"),
            );
            frames.arrow(
                point,
                point + 0.7 * frame.normal,
                ORANGE.line().label("normal"),
            );
        }
        let evolute = |t: f64| {
            let [point, derivative, second] = turned(t);
            plane
                .evolute_point(point, derivative, second)
                .unwrap_or(DVec2::NAN)
        };
        bent.trace(evolute, 0.45, SPAN - 0.15, GREEN.line().label("evolute"));
        let length = |t: f64| 0.4 + plane.arc_length(0.0, t, 2, |t| turned(t)[1]);
        let involute = |t: f64| {
            plane
                .involute_point(turned(t)[0], turned(t)[1], length(t))
                .unwrap_or(DVec2::NAN)
        };
        bent.trace(involute, 0.0, 1.1, VERMILION.line().label("involute"));

        let mut offset = Plot::geometry("general offset");
        let moved = |distance: f64| {
            move |t: f64| {
                plane
                    .offset_point(curve(t)[0], curve(t)[1], distance)
                    .unwrap_or(DVec2::NAN)
            }
        };
        for i in 0..=8 {
            let centre = curve(SPAN * f64::from(i) / 8.0)[0];
            offset.trace(
                |psi| centre + 0.45 * plane.indicatrix_point(psi),
                0.0,
                TAU,
                MIST.line().label("copies of U"),
            );
        }
        offset.trace(|t| curve(t)[0], 0.0, SPAN, INK.line().width(2.0));
        offset.trace(
            moved(0.45),
            0.0,
            SPAN,
            BLUE.line().width(2.0).label("offsets"),
        );
        offset.trace(moved(-0.45), 0.0, SPAN, BLUE.line().width(2.0));
        Ok(vec![duality, frames, bent, offset])
    }

    fn isoperimetric_arc(&self) -> Result<IsoperimetricArc> {
        let supports: Vec<f64> = self
            .arc
            .vectors()
            .iter()
            .enumerate()
            .map(|(i, line)| -2.0 * line.x + if i.abs_diff(4) < 2 { 0.06 } else { 0.0 })
            .collect();
        Ok(IsoperimetricArc::from_supports(
            self.arc.clone(),
            &supports,
        )?)
    }

    fn control_plot(&self) -> Result<Plot> {
        let mut plot = Plot::geometry("dual control of a curve and its offset");
        let arc = self.isoperimetric_arc()?;
        let offset = arc.offset(DISTANCE)?;
        for (curve, color, name) in [
            (arc.curve(), GREY, "IH curve"),
            (offset.curve(), BLUE, "its offset"),
            (&self.arc, ORANGE, "indicatrix"),
        ] {
            for vector in curve.vectors() {
                let normal = DVec2::new(vector.y, vector.z);
                let foot = -vector.x * normal / normal.length_squared();
                let along = 0.5 * normal.perp().normalize();
                plot.segment(foot - along, foot + along, color.alpha(0.45).line());
            }
            let point = |t: f64| curve.contact(t).map_or(DVec2::NAN, |contact| contact.point);
            plot.trace(point, 0.0, 1.0, color.line().width(2.5).label(name));
        }
        Ok(plot)
    }

    /// `det(u0, u) = 1`, `||u||_U = 1`, `||u0||_U0 = 1`, and the tangent of `U0` is parallel to `u`, by central differences.
    fn duality_error(&self) -> f64 {
        let errors = (0..360).map(|i| {
            let psi = PI * f64::from(i) / 180.0;
            let (u, u0) = (
                self.plane.indicatrix_point(psi),
                self.plane.isoperimetrix_point(psi),
            );
            let step = 1e-4;
            let along = self.plane.isoperimetrix_point(psi + step)
                - self.plane.isoperimetrix_point(psi - step);
            let errors = [
                u0.perp_dot(u) - 1.0,
                self.plane.norm(u) - 1.0,
                self.plane.dual_norm(u0) - 1.0,
                // Second order in the step: the curvature's change over 1e-4 squared.
                0.01 * along.normalize().perp_dot(u.normalize()),
            ];
            errors
                .into_iter()
                .fold(0.0, |most: f64, error| most.max(error.abs()))
        });
        errors.fold(0.0, f64::max)
    }

    /// The gap between the general offset of a convex body, point by point along its boundary, and the convex hull of the
    /// sums of points of both curves, measured as supports in directions between the samples.
    fn sum_gap(&self, samples: u32) -> Result<f64> {
        let angle = |i: u32| TAU * f64::from(i) / f64::from(samples);
        let boundary: Vec<DVec2> = (0..samples).map(|i| body.contact(angle(i)).point).collect();
        let unit: Vec<DVec2> = (0..samples)
            .map(|i| self.plane.indicatrix_point(angle(i)))
            .collect();
        let mut worst: f64 = 0.0;
        for i in 0..90 {
            let psi = TAU * (f64::from(i) + 0.37) / 90.0;
            let normal = DVec2::from_angle(psi);
            let most = |points: &[DVec2]| {
                points
                    .iter()
                    .map(|p| p.dot(normal))
                    .fold(f64::NEG_INFINITY, f64::max)
            };
            let sum = most(&boundary) + DISTANCE * most(&unit);
            let contact = body.contact(psi);
            // The body runs counter-clockwise: its left is inside.
            let offset =
                self.plane
                    .offset_point(contact.point, contact.normal.perp(), -DISTANCE)?;
            // A polygon of n points falls short of its curve by R (2π/n)² / 8.
            let radius = contact.radius + DISTANCE * self.plane.indicatrix().jet(psi).radius();
            let short = radius * (TAU / f64::from(samples)).powi(2) / 8.0;
            worst = worst.max((offset.dot(normal) - sum).abs() - short);
        }
        Ok(worst.max(0.0))
    }

    /// The exact offset by control lines against the pointwise definition.
    fn dual_offset_error(&self) -> Result<f64> {
        let arc = self.isoperimetric_arc()?;
        let offset = arc.offset(DISTANCE)?;
        let mut worst: f64 = 0.0;
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            let (here, there) = (arc.curve().contact(t)?, offset.curve().contact(t)?);
            let moved = self
                .plane
                .offset_point(here.point, here.normal.perp(), -DISTANCE)?;
            worst = worst.max(moved.distance(there.point));
        }
        Ok(worst)
    }
}

/// Moves of the middle lines of the two arcs of half an indicatrix of class 8.
fn moves() -> Vec<Vec<f64>> {
    let arc = |height: f64| {
        let mut moves = vec![0.0; 9];
        moves[3..6].copy_from_slice(&[height, 0.4 * height, -height]);
        moves
    };
    vec![arc(0.035), arc(-0.035)]
}

fn width_plot(ovals: &[IsoperimetricArc], bumped: &Bumped) -> Result<Plot> {
    let mut plot = Plot::geometry("constant Minkowski width");
    let mut joints = Vec::new();
    for arc in ovals {
        let point = |t: f64| {
            arc.curve()
                .contact(t)
                .map_or(DVec2::NAN, |contact| contact.point)
        };
        plot.trace(point, 0.0, 1.0, BLUE.line().width(2.5).label("oval"));
        joints.push(arc.curve().contact(0.0)?.point);
    }
    // Nearly the same curve: in another colour above it.
    plot.trace(
        |psi| 2.0 * bumped.contact(psi).point,
        0.0,
        TAU,
        ORANGE.line().dashed().label("2 U"),
    );
    plot.points(&joints, Marker::Disc, BLUE.fill());
    Ok(plot)
}

/// Supports of opposite arcs over the support of the indicatrix, against the width.
fn width_deviation(ovals: &[IsoperimetricArc], bumped: &Bumped) -> Result<f64> {
    let mut worst: f64 = 0.0;
    for (arc, opposite) in [(0, 2), (1, 3)] {
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            let (one, two) = (
                ovals[arc].curve().contact(t)?,
                ovals[opposite].curve().contact(t)?,
            );
            let unit = bumped.jet(one.normal.to_angle()).support;
            worst = worst.max(((one.support + two.support) / unit / 4.0 - 1.0).abs());
        }
    }
    Ok(worst)
}
