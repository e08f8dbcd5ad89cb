//! How the error falls with the number of sensors.

use anyhow::Result;
use glam::{DVec2, dvec2};
use reconstruct::{EndCondition, TangentMethod};

use super::{FINE, largest, planar, spatial};
use crate::color::{BLUE, Color, GREEN, ORANGE, SKY, VERMILION};
use crate::demo::Context;
use crate::figure::{Corner, Figure, Marker, Plot};
use crate::report::Target;

/// The errors over the number of sensors.
pub(super) fn draw(context: &mut Context) -> Result<()> {
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
    let series: [(&str, Color, &dyn Fn(usize) -> Result<f64>); 5] = [
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
