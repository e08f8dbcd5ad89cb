//! Paths in the plane: on a cube cut open, and on a terrain from update to update.

use anyhow::{Context as _, Result, ensure};
use geodesic::{GeodesicPath, Mesh as Surface, PathFinder, Start, shapes};
use glam::{DVec2, DVec3};
use serde_json::json;

use super::shapes::terrain;
use crate::color::{GREY, INK, MIST, SKY, VERMILION};
use crate::demo::Context;
use crate::figure::{Figure, Marker, Plot, Side};
use crate::report::Target;

/// The cube of Fig. 2.1: the path between opposite corners, and another geodesic that is longer.
pub(super) fn draw_cube(context: &mut Context) -> Result<()> {
    let cube = shapes::cube()?;
    let mut finder = PathFinder::new(&cube);
    let opposite = finder.shortest(0.into(), 7.into())?.clone();
    // Once round the four sides, over the four edges that stand up.
    let mut guide = vec![cube.face_point(4, [0.6, 0.2, 0.2])?];
    for (low, high) in [(1, 5), (3, 7), (2, 6), (0, 4)] {
        guide.push(cube.edge_point(low, high, 0.5)?);
    }
    guide.push(cube.face_point(5, [0.1, 0.5, 0.4])?);
    let round = finder.guided(&guide)?.clone();
    let direct = finder.shortest(guide[0], guide[5])?.length();
    ensure!(
        round.certify(&cube)?.is_geodesic(),
        "the way round the cube is not a geodesic"
    );
    let plots = vec![
        unfolded(
            &cube,
            &opposite,
            &format!("from corner to corner: √{:.6}", opposite.length().powi(2)),
        )?,
        unfolded(
            &cube,
            &round,
            &format!(
                "a geodesic of length {:.3}; the shortest: {direct:.3}",
                round.length()
            ),
        )?,
    ];
    context.figure(
        "figure-cube",
        &Figure::grid(1, plots).aspect(3.0),
        "Faces of a cube laid flat with geodesics: straight lines.",
        "Two strips of triangles, each crossed by a straight red line.",
    )
}

/// A path in the plane of its faces.
fn unfolded(mesh: &Surface, path: &GeodesicPath, title: &str) -> Result<Plot> {
    let mut flat = path.unfold(mesh)?;
    // From left to right.
    let chord = flat.points[flat.points.len() - 1] - flat.points[0];
    let turn = DVec2::new(chord.x, -chord.y).normalize_or(DVec2::X);
    flat.points.iter_mut().for_each(|p| *p = turn.rotate(*p));
    flat.corners
        .iter_mut()
        .flatten()
        .for_each(|p| *p = turn.rotate(*p));
    let mut plot = Plot::geometry(title);
    for corners in &flat.corners {
        plot.polygon(corners, SKY.alpha(0.18).fill().stroke(GREY).width(0.6));
    }
    plot.polyline(&flat.points, VERMILION.line().width(2.2));
    let pivots: Vec<DVec2> = path
        .pivots()
        .iter()
        .map(|pivot| flat.points[pivot.index])
        .collect();
    plot.points(&pivots, Marker::Disc, INK.fill());
    let ends = [flat.points[0], flat.points[flat.points.len() - 1]];
    plot.point(ends[0], "X₀", Side::Left, VERMILION.fill());
    plot.point(ends[1], "X₁", Side::Right, VERMILION.fill());
    Ok(plot)
}

/// A small terrain, of some the one on which a path across takes the most updates, and that path after each.
fn longest_way() -> Result<(Surface, Vec<GeodesicPath>)> {
    let mut longest: Option<(Surface, Vec<GeodesicPath>)> = None;
    for seed in 0..24 {
        let mesh = terrain(160, seed)?;
        let nearest = |x: f64, y: f64| {
            let at = DVec2::new(x, y);
            let distance = |p: &DVec3| p.truncate().distance(at);
            let found = mesh
                .positions()
                .iter()
                .enumerate()
                .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
            found.map_or(0, |(v, _)| v as u32)
        };
        let (from, to) = (nearest(0.7, 0.9), nearest(9.2, 9.4));
        let mut finder = PathFinder::new(&mesh).with_start(Start::Faces);
        let stages = finder.stages(from.into(), to.into())?;
        if longest
            .as_ref()
            .is_none_or(|(_, other)| stages.len() > other.len())
        {
            longest = Some((mesh, stages));
        }
    }
    longest.context("there is no terrain")
}

/// A path on a terrain seen from above, from the edges to the geodesic, and its faces before and after.
pub(super) fn draw_updates(context: &mut Context) -> Result<()> {
    let (mesh, stages) = longest_way()?;
    let shown = 4.min(stages.len());
    let mut plots = Vec::new();
    for k in 0..shown {
        let index = k * (stages.len() - 1) / (shown - 1).max(1);
        let stage = &stages[index];
        let mut plot = Plot::geometry(&match index {
            0 => format!("initial sequence: {:.3}", stage.length()),
            _ if k + 1 == shown => {
                format!("the geodesic, after {index} updates: {:.3}", stage.length())
            }
            1 => format!("after one update: {:.3}", stage.length()),
            _ => format!("after {index} updates: {:.3}", stage.length()),
        });
        let faces = stage.unfold(&mesh)?.faces;
        for (f, face) in mesh.faces().iter().enumerate() {
            let corners = face.map(|v| mesh.positions()[v as usize].truncate());
            let fill = if faces.contains(&(f as u32)) {
                SKY.alpha(0.45)
            } else {
                MIST.alpha(0.25)
            };
            plot.polygon(&corners, fill.fill().stroke(GREY.alpha(0.6)).width(0.4));
        }
        let line: Vec<DVec2> = stage.positions().iter().map(|p| p.truncate()).collect();
        plot.polyline(&line, VERMILION.line().width(2.0));
        let pivots: Vec<DVec2> = stage
            .pivots()
            .iter()
            .map(|pivot| line[pivot.index])
            .collect();
        plot.points(&pivots, Marker::Disc, INK.fill());
        plots.push(plot);
    }
    context.figure(
        "figure",
        &Figure::grid(2, plots).aspect(1.0),
        "A path on a terrain, seen from above, from the initial sequence of faces (blue) to the geodesic; black: vertices that it turns at.",
        "Four plans of a triangulated terrain with a red path that straightens from one to the next.",
    )?;
    let last = stages.len() - 1;
    let strips = vec![
        unfolded(&mesh, &stages[0], "the initial sequence laid flat")?,
        unfolded(&mesh, &stages[last], "the final one")?,
    ];
    context.figure(
        "figure-strips",
        &Figure::grid(1, strips).aspect(2.2),
        "The faces of the first and of the last path laid flat: straight but for the pivots.",
        "Two long strips of triangles with a red path inside, bent in the upper and nearly straight in the lower.",
    )?;
    context.number("updates", json!(last), Target::Free);
    Ok(())
}
