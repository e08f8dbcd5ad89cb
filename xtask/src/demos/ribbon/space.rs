//! A space curve from its tangents.

use anyhow::Result;
use glam::{DVec2, DVec3, dvec2};
use reconstruct::{EndCondition, TangentMethod};

use super::{FINE, LENGTH, spatial, tangent, trace};
use crate::color::{GREY, INK, ORANGE, SKY, VERMILION};
use crate::demo::Context;
use crate::export::Part;
use crate::figure::{Figure, Marker, Plot};
use crate::mesh::Mesh;

/// Figs 3.6 and 3.7: a space curve in two views, and its tangents on the sphere.
pub(super) fn draw(context: &mut Context) -> Result<()> {
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
            plot.polyline(
                &flat(&trace(|s| projected.point(s))?),
                INK.line().label("projected spline"),
            );
            plot.polyline(
                &flat(&trace(|s| sphere.point(s))?),
                ORANGE.line().dashed().label("spline on the sphere"),
            );
            plot.points(&flat(projected.points()), Marker::Dot, VERMILION.fill());
            Ok(plot)
        })
        .collect::<Result<_>>()?;
    let mut ball = Plot::geometry("tangents on the sphere");
    ball.circle(DVec2::ZERO, 1.0, GREY.line());
    // Seen from above: all of the curve lies on the near side.
    let seen = DVec3::truncate;
    ball.trace(|s| seen(tangent(s)), 0.0, LENGTH, SKY.line().width(5.0));
    ball.trace(|s| seen(projected.tangent(s)), 0.0, LENGTH, INK.line());
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
