//! Geodesics on a bicubic Bézier patch and on a NURBS patch, as limits of paths on their control polyhedra.
//!
//! What one sees: the bicubic patch as four polyhedra of flat facets, each twice as fine as the one before, with the path
//! that the coarser one suggests (dark) and the geodesic (red), which lie closer together each time; then both smooth
//! patches with four geodesics each, of four colours. The charts show one of the paths in the parameter plane, level by
//! level, and the errors of all against the solutions of the geodesic equation, which fall by four from level to level.

use anyhow::Result;
use geodesic::bezier_mass::{BSplineSurface, BezierPatch, Knots, MassPoint};
use geodesic::{LevelPath, PatchLevels, SmoothGeodesic, SmoothSurface, geodesic_between};
use glam::{DAffine3, DVec2, DVec3};

use crate::color::{BLUE, Color, GREEN, GREY, INK, MIST, ORANGE, VERMILION};
use crate::demo::{Context, Demo};
use crate::figure::{Figure, Marker, Plot};
use crate::mesh::Mesh;
use crate::render::{Camera, Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct GeodesicSurface {
    /// Subdivisions of the control polyhedra [default: 6, with --quick 5]
    #[arg(long, value_parser = clap::value_parser!(u32).range(3..=8))]
    levels: Option<u32>,
}

const COLORS: [Color; 4] = [VERMILION, BLUE, GREEN, ORANGE];

/// Ends of the paths on the bicubic patch, in its parameters.
const BICUBIC: [[[f64; 2]; 2]; 4] = [
    [[0.0, 0.0], [1.0, 0.875]],
    [[0.125, 0.875], [0.875, 0.25]],
    [[0.0, 0.5], [1.0, 0.375]],
    [[0.375, 0.0], [0.625, 1.0]],
];

/// Ends of the paths on the NURBS patch: three of them set out from the same point.
const NURBS: [[[f64; 2]; 2]; 4] = [
    [[0.25, 0.1875], [2.75, 1.75]],
    [[0.25, 0.1875], [2.875, 0.75]],
    [[0.25, 0.1875], [0.75, 1.875]],
    [[0.125, 1.5], [2.5, 0.1875]],
];

impl Demo for GeodesicSurface {
    const NAME: &'static str = "geodesic-surface";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 2.6 and 2.7";
    const ABOUT: &'static str =
        "Geodesics on Bézier and NURBS patches, from polyhedron to polyhedron";

    fn run(&self, context: &mut Context) -> Result<()> {
        let levels = self.levels.unwrap_or(context.pick(6, 5)) as usize;
        let bicubic = bicubic()?;
        let nurbs = nurbs()?;
        let on_bicubic = carry(&PatchLevels::new(&bicubic), &bicubic, BICUBIC, levels)?;
        let on_nurbs = carry(&PatchLevels::of_spline(&nurbs), &nurbs, NURBS, levels)?;
        let all: Vec<&Carried> = on_bicubic.iter().chain(&on_nurbs).collect();
        measure(context, &all, levels);
        draw_parameters(context, &bicubic, &on_bicubic[0])?;
        draw_errors(context, &on_bicubic, &on_nurbs, levels)?;
        render_levels(context, &bicubic, &on_bicubic[0])?;
        render(
            context,
            "render",
            &bicubic,
            [[0.0, 1.0]; 2],
            &on_bicubic,
            "Four geodesics on a bicubic Bézier patch.",
        )?;
        render(
            context,
            "render-nurbs",
            &nurbs,
            nurbs.knots().each_ref().map(Knots::domain),
            &on_nurbs,
            "Four geodesics on a rational B-spline patch of degrees 3 and 2 with three by two spans.",
        )
    }
}

/// A path on every level, and the geodesic of the smooth surface that they tend to.
struct Carried {
    paths: Vec<LevelPath>,
    smooth: SmoothGeodesic,
}

impl Carried {
    /// Errors of the lengths.
    fn errors(&self) -> Vec<f64> {
        let error = |path: &LevelPath| (path.length - self.smooth.length).abs();
        self.paths.iter().map(error).collect()
    }
}

fn carry(
    surface: &PatchLevels,
    smooth: &impl SmoothSurface,
    ends: [[[f64; 2]; 2]; 4],
    levels: usize,
) -> Result<Vec<Carried>> {
    ends.iter()
        .map(|&[from, to]| {
            let paths = surface.clone().paths(from.into(), to.into(), levels)?;
            let smooth = geodesic_between(smooth, &paths[levels].parameters, 1e-10)?;
            anyhow::ensure!(smooth.inside, "the geodesic leaves the patch");
            Ok(Carried { paths, smooth })
        })
        .collect()
}

fn measure(context: &mut Context, all: &[&Carried], levels: usize) {
    let largest = |level: usize| {
        let errors = all.iter().map(|carried| carried.errors()[level]);
        errors.fold(0.0, f64::max)
    };
    let errors: Vec<f64> = (0..=levels).map(largest).collect();
    // The last two levels of each path.
    let orders: Vec<f64> = all
        .iter()
        .map(|carried| {
            let errors = carried.errors();
            (errors[levels - 1] / errors[levels]).log2()
        })
        .collect();
    let order = (errors[levels - 1] / errors[levels]).log2();
    let lengths: Vec<f64> = all.iter().map(|carried| carried.smooth.length).collect();
    let residual = all.iter().map(|carried| carried.smooth.residual);
    let conjugate: usize = all.iter().map(|c| c.smooth.conjugate_points).sum();
    context.number("levels", (0..=levels).collect::<Vec<_>>(), Target::Free);
    context.number("error_by_level", errors, Target::Free);
    context.number("order", order, Target::within(2.0, 0.2));
    context.number("orders", orders, Target::Free);
    context.number("lengths", lengths, Target::Free);
    context.number(
        "ode_residual",
        residual.fold(0.0, f64::max),
        Target::AtMost(1e-10),
    );
    context.number("conjugate_points", conjugate, Target::exactly(0));
}

/// A bicubic patch with a hill and a hollow.
fn bicubic() -> Result<BezierPatch<DVec3>> {
    let heights = [
        [0.0, 0.9, -0.3, 0.2],
        [0.7, 2.9, 0.4, -0.6],
        [-0.2, 0.6, -2.2, 0.5],
        [0.4, -0.5, 0.8, 0.3],
    ];
    let net: Vec<DVec3> = (0..16)
        .map(|k| {
            let (i, j) = (k / 4, k % 4);
            DVec3::new(i as f64, j as f64, heights[i][j])
        })
        .collect();
    Ok(BezierPatch::polynomial([3, 3], &net)?)
}

/// A vaulted roof: cubic in u, quadratic in v, with unequal weights and knots.
fn nurbs() -> Result<BSplineSurface<DVec3>> {
    let knots = [
        Knots::clamped(3, &[0.0, 1.0, 2.0, 3.0])?,
        Knots::clamped(2, &[0.0, 1.5, 2.0])?,
    ];
    let control = (0..24)
        .map(|k| {
            let (i, j) = ((k / 4) as f64, (k % 4) as f64);
            let (x, y) = (i - 2.5, 1.3 * (j - 1.5));
            let vault = 1.6 - 0.16 * x * x - 0.2 * y * y;
            let wave = 0.75 * (1.9 * x).sin() * (1.1 * y + 0.4).cos();
            let weight = 1.0 + 0.8 * f64::from(u8::from((k / 4 + k % 4) % 3 == 0));
            MassPoint::point(DVec3::new(x, y, vault + wave), weight)
        })
        .collect();
    Ok(BSplineSurface::new(knots, control)?)
}

/// One path in the parameter plane, with the grid of each level.
fn draw_parameters(
    context: &mut Context,
    patch: &BezierPatch<DVec3>,
    carried: &Carried,
) -> Result<()> {
    let rays = carried.smooth.rays(patch, 8)?;
    let smooth: Vec<DVec2> = rays.iter().map(|ray| ray.uv).collect();
    let plots = (0..4)
        .map(|level| {
            let path = &carried.paths[level];
            let mut plot = Plot::geometry(&format!(
                "level {level}: length {:.4}",
                carried.paths[level].length
            ));
            let cells = 3 << level;
            let line = GREY.alpha(0.45).line().width(0.5);
            for k in 0..=cells {
                let t = f64::from(k) / f64::from(cells);
                plot.segment(DVec2::new(t, 0.0), DVec2::new(t, 1.0), line.clone());
                plot.segment(DVec2::new(0.0, t), DVec2::new(1.0, t), line.clone());
                plot.segment(DVec2::new(t, 0.0), DVec2::new(1.0, 1.0 - t), line.clone());
                plot.segment(DVec2::new(0.0, t), DVec2::new(1.0 - t, 1.0), line.clone());
            }
            let start = match level {
                0 => vec![
                    path.parameters[0],
                    path.parameters[path.parameters.len() - 1],
                ],
                _ => carried.paths[level - 1].parameters.clone(),
            };
            plot.polyline(&start, INK.line().width(1.0).dashed());
            plot.polyline(&smooth, BLUE.line().width(1.0));
            plot.polyline(&path.parameters, VERMILION.line().width(2.0));
            plot
        })
        .collect();
    context.figure(
        "figure",
        &Figure::grid(2, plots).aspect(1.0),
        "A path in the parameter plane: dashed where it begins on each level, red the geodesic of the polyhedron, blue that \
         of the smooth patch.",
        "Four square grids, each finer than the one before, with a red line that tends to a blue one.",
    )
}

/// Errors against the step.
fn draw_errors(
    context: &mut Context,
    bicubic: &[Carried],
    nurbs: &[Carried],
    levels: usize,
) -> Result<()> {
    let mut plot = Plot::chart(
        "lengths against the geodesic equation",
        "subdivisions",
        "error of the length",
    );
    plot.log_y();
    let series = |errors: &[f64]| -> Vec<DVec2> {
        errors
            .iter()
            .enumerate()
            .map(|(level, &error)| DVec2::new(level as f64, error))
            .collect()
    };
    for (carried, color, name) in [(bicubic, VERMILION, "bicubic"), (nurbs, BLUE, "NURBS")] {
        for (k, path) in carried.iter().enumerate() {
            let points = series(&path.errors());
            let style = color.line().width(1.4);
            let style = if k == 0 { style.label(name) } else { style };
            plot.polyline(&points, style);
            plot.points(&points, Marker::Disc, color.fill());
        }
    }
    let slope: Vec<f64> = (0..=levels)
        .map(|k| 0.5 * 0.25_f64.powi(k as i32))
        .collect();
    plot.polyline(&series(&slope), GREY.line().dashed().label("order 2"));
    context.figure(
        "figure-errors",
        &Figure::new(plot),
        "Lengths on the polyhedra against the geodesic equation, for eight paths.",
        "A chart with eight falling lines, parallel to a dashed one of slope 2 in the end.",
    )
}

/// The polyhedra of the first four levels side by side, with the path that each began from and its geodesic.
fn render_levels(
    context: &mut Context,
    patch: &BezierPatch<DVec3>,
    carried: &Carried,
) -> Result<()> {
    let mut levels = PatchLevels::new(patch);
    let mut scene = Scene::new();
    let mut around = Vec::new();
    let towards_eye = DVec3::new(0.1, -1.0, 1.25);
    for level in 0..4 {
        if level > 0 {
            levels.subdivide()?;
        }
        let mesh = levels.mesh()?;
        let facets = Mesh::faceted(mesh.positions(), mesh.faces());
        let lowest = facets.bounds().map_or(0.0, |[low, _]| low.z);
        let place = DAffine3::from_translation(DVec3::new(
            4.0 * (level % 2) as f64,
            -4.2 * (level / 2) as f64,
            -lowest,
        ));
        let facets = facets.transformed(place);
        around.extend(facets.positions.iter().copied());
        scene.add(facets, Material::matte(MIST))?;
        let path = &carried.paths[level];
        let begin = match level {
            0 => vec![
                path.parameters[0],
                path.parameters[path.parameters.len() - 1],
            ],
            _ => carried.paths[level - 1].parameters.clone(),
        };
        let mut initial = Vec::new();
        for uv in dense(&begin) {
            initial.push(mesh.point_position(levels.point(uv)?)?);
        }
        for (points, radius, color) in [
            (initial, 0.022, INK),
            (path.positions.clone(), 0.04, VERMILION),
        ] {
            let mut points: Vec<DVec3> =
                points.iter().map(|p| place.transform_point3(*p)).collect();
            points.dedup_by(|a, b| a.distance(*b) < 1e-3);
            scene.add(Mesh::tube(&points, radius, false), Material::glossy(color))?;
        }
    }
    scene.ground_below();
    let camera = Camera::fit(&around, towards_eye, context.aspect());
    context.render(
        "render-levels",
        &scene,
        &camera,
        "The control polyhedra of a bicubic patch after 0 to 3 subdivisions; dark: the path of the level before, carried \
         over by the parameters (at first a straight line there); red: the geodesic.",
        "Four faceted surfaces, from coarse to fine, each crossed by a dark and a red line.",
    )
}

/// A polyline with its segments cut in many parts.
fn dense(points: &[DVec2]) -> Vec<DVec2> {
    let mut fine = vec![points[0]];
    for ends in points.windows(2) {
        fine.extend((1..=60).map(|k| ends[0].lerp(ends[1], f64::from(k) / 60.0)));
    }
    fine
}

/// A smooth patch with its geodesics.
fn render(
    context: &mut Context,
    name: &str,
    surface: &impl SmoothSurface,
    domain: [[f64; 2]; 2],
    carried: &[Carried],
    caption: &str,
) -> Result<()> {
    let [[u0, u1], [v0, v1]] = domain;
    let mut scene = Scene::new();
    let body = Mesh::grid(200, 160, |u, v| {
        let jet = surface.jet(DVec2::new(u0 + (u1 - u0) * u, v0 + (v1 - v0) * v));
        (jet.point, jet.normal())
    });
    scene.add(body, Material::matte(MIST))?;
    for (path, color) in carried.iter().zip(COLORS) {
        let points = path.smooth.positions(surface, 12)?;
        let (first, last) = (points[0], points[points.len() - 1]);
        scene.add(Mesh::tube(&points, 0.025, false), Material::glossy(color))?;
        for end in [first, last] {
            scene.add(Mesh::sphere(end, 0.045, 1e-4), Material::glossy(INK))?;
        }
    }
    scene.ground_below();
    let camera = scene.camera(DVec3::new(0.45, -1.0, 0.9), context.aspect_or(1.5));
    context.render(
        name,
        &scene,
        &camera,
        caption,
        "A curved sheet with four coloured curves from edge to edge.",
    )
}
