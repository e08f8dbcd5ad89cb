//! A surface found again from five geodesics on it (Figs 3.10 to 3.15 of the chapter on sensors).
//!
//! What one sees: a hill-like model with five geodesics that were traced on its mesh; the surface made of four strips
//! between them, each a Hermite blend with both curves as geodesics, in zebra stripes that run on across the joints; and a
//! pair of curves filled three times with other lengths and angles of the free vectors. The figure shows where the
//! reconstruction differs from the model.

use anyhow::{Context as _, Result};
use geodesic::{Mesh as Triangles, Straightest, shapes};
use glam::{DVec2, DVec3, dvec2, dvec3};
use reconstruct::{
    Curve, EndField, Freedom, GeodesicStrip, LocalCriterion, SampledCurve, ScalarFunction,
    StripChain, Surface, TwoCurveSurface, geodesic_curvature,
};

use crate::color::{BLUE, Color, GREEN, VERMILION};
use crate::demo::{Context, Demo};
use crate::export::Part;
use crate::figure::{Figure, Plot};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct RibbonSurface {
    /// Cells of the model's mesh along each side [default: 160, quick 60]
    #[arg(long, value_parser = clap::value_parser!(u32).range(16..=1000))]
    cells: Option<u32>,
    /// Spans of the splines through the traced points
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u16).range(2..=40))]
    spans: u16,
}

impl Demo for RibbonSurface {
    const NAME: &'static str = "ribbon-surface";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 3.10 to 3.15";
    const ABOUT: &'static str =
        "Five geodesics traced on a model, and the surface of four strips through them";

    fn run(&self, context: &mut Context) -> Result<()> {
        let cells = self.cells.unwrap_or(context.pick(160, 60));
        let mesh = model_mesh(cells)?;
        let traces = trace_geodesics(&mesh, cells)?;
        let spans = usize::from(self.spans);
        let fits: Vec<SampledCurve> = traces
            .iter()
            .map(|trace| SampledCurve::fit(trace, spans))
            .collect::<Result<_, _>>()?;
        let strips: Vec<GeodesicStrip> = fits
            .iter()
            .map(|fit| GeodesicStrip::new(fit.clone()))
            .collect::<Result<_, _>>()?;
        let chain = StripChain::new(strips.clone(), &[1.0; 4])?;
        measure(context, &fits, &chain, spans)?;
        draw_strips(context, &mesh, &fits, &chain)?;
        draw_free_functions(context, [strips[1].clone(), strips[3].clone()])?;
        draw_error(context, &chain)
    }
}

/// The model: a dome with a gentle swell over the square `[-1, 1]²`, bent everywhere along the way of the ribbons.
fn height(p: DVec2) -> f64 {
    0.55 - 0.28 * p.x * p.x - 0.16 * p.y * p.y + 0.05 * (2.1 * p.y + 0.8 * p.x).sin()
}

fn gradient(p: DVec2) -> DVec2 {
    let swell = 0.05 * (2.1 * p.y + 0.8 * p.x).cos();
    dvec2(-0.56 * p.x + 0.8 * swell, -0.32 * p.y + 2.1 * swell)
}

fn lift(p: DVec2) -> DVec3 {
    p.extend(height(p))
}

fn model_mesh(cells: u32) -> Result<Triangles> {
    let scale = 2.6 / f64::from(cells);
    Ok(shapes::sheet(cells, cells, |p| {
        lift(p * scale - DVec2::splat(1.3))
    })?)
}

/// Five geodesics that start on the line x = -1.2, each straight ahead, traced with the model's normals.
fn trace_geodesics(mesh: &Triangles, cells: u32) -> Result<Vec<Vec<DVec3>>> {
    let normals: Vec<DVec3> = mesh
        .positions()
        .iter()
        .map(|p| {
            let slope = gradient(p.truncate());
            dvec3(-slope.x, -slope.y, 1.0)
        })
        .collect();
    let tracer = Straightest::new(mesh).with_normals(&normals)?;
    (0..5)
        .map(|k| {
            let start = dvec2(-1.2, -0.9 + 0.45 * f64::from(k));
            let heading = dvec2(1.0, 0.05 - 0.03 * f64::from(k));
            // The cell of the sheet that holds the start, and its face below or above the diagonal.
            let place = (start + DVec2::splat(1.3)) * f64::from(cells) / 2.6;
            let (cell, inside) = (place.floor(), place.fract());
            let upper = inside.y > inside.x;
            let face = 2 * (cell.y as u32 * cells + cell.x as u32) + u32::from(upper);
            let barycentric = if upper {
                [1.0 - inside.y, inside.x, inside.y - inside.x]
            } else {
                [1.0 - inside.x, inside.x - inside.y, inside.y]
            };
            let from = mesh.face_point(face, barycentric)?;
            let direction = heading.extend(gradient(start).dot(heading));
            // A start on an edge leaves through the face that the direction leads into.
            let face = tracer.face_towards(from, direction).unwrap_or(face);
            let trace = tracer.trace(from, face, direction, 2.5)?;
            Ok(thinned(&trace.positions))
        })
        .collect()
}

/// Without the crossings that nearly coincide with the one before: their steps say nothing about the direction.
fn thinned(points: &[DVec3]) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::with_capacity(points.len());
    for point in points {
        if kept
            .last()
            .is_none_or(|last: &DVec3| last.distance(*point) > 1e-4)
        {
            kept.push(*point);
        }
    }
    kept
}

fn measure(
    context: &mut Context,
    fits: &[SampledCurve],
    chain: &StripChain,
    spans: usize,
) -> Result<()> {
    let mut curvature: f64 = 0.0;
    let mut error: f64 = 0.0;
    for surface in chain.surfaces() {
        for i in 0..=60 {
            let u = f64::from(i) / 60.0;
            for v in [0.0, 1.0] {
                let at = surface.partials(u, v);
                let bend = at.du.cross(at.duu).length() / at.du.length().powi(3);
                let sideways = geodesic_curvature(at.du, at.duu, at.du.cross(at.dv)).abs();
                curvature = curvature.max(sideways / (1.0 / at.du.length() + bend));
            }
            for j in 0..=12 {
                error = error.max(distance_to_model(surface.point(u, f64::from(j) / 12.0)));
            }
        }
    }
    context.number(
        "boundary_geodesic_curvature_max",
        curvature,
        Target::AtMost(1e-8),
    );
    context.number("surface_max_error", error, Target::AtMost(1e-2));
    context.number(
        "strip_joint_max_angle_rad",
        chain.joint_angle(60),
        Target::AtMost(1e-10),
    );
    let residual = fits.iter().map(SampledCurve::residual).fold(0.0, f64::max);
    context.number("curve_fit_residual", residual, Target::AtMost(1e-3));
    // The same curves with their binormals smoothed once more, as for noisy data: then the curves are nearly geodesics.
    let mut smoothed: f64 = 0.0;
    for fit in fits {
        let strip = fit.strip(spans)?;
        let worst = (0..=60).map(|i| strip.geodesic_curvature(f64::from(i) / 60.0).abs());
        smoothed = worst.fold(smoothed, f64::max);
    }
    context.number(
        "geodesic_curvature_smoothed_binormals",
        smoothed,
        Target::AtMost(0.2),
    );
    Ok(())
}

/// Distance to the graph, by its linearisation at the foot of the vertical: second order in the distance.
fn distance_to_model(p: DVec3) -> f64 {
    let foot = p.truncate();
    (p.z - height(foot)).abs() / (1.0 + gradient(foot).length_squared()).sqrt()
}

fn surface_mesh(surface: &impl Surface, steps: usize) -> Mesh {
    Mesh::grid(steps, steps, |u, v| {
        (surface.point(u, v), surface.normal(u, v))
    })
}

fn tube(curve: &impl Curve, radius: f64, offset: DVec3) -> Mesh {
    let points: Vec<DVec3> = (0..=120)
        .map(|i| curve.point(f64::from(i) / 120.0) + offset)
        .collect();
    Mesh::tube(&points, radius, false)
}

fn draw_strips(
    context: &mut Context,
    model: &Triangles,
    fits: &[SampledCurve],
    chain: &StripChain,
) -> Result<()> {
    let steps = context.pick(100, 30);
    let positions = model.positions().to_vec();
    let normals = positions
        .iter()
        .map(|p| {
            let slope = gradient(p.truncate());
            dvec3(-slope.x, -slope.y, 1.0).normalize()
        })
        .collect();
    let clay = Mesh::new(positions, normals, model.faces().to_vec());
    let aside = DVec3::X * 2.9;
    let mut scene = Scene::new();
    scene.add(clay, Material::matte(Color::hex(0xd8cfc0)))?;
    for fit in fits {
        scene.add(
            tube(fit, 0.014, DVec3::Z * 0.004),
            Material::matte(VERMILION),
        )?;
        scene.add(tube(fit, 0.010, aside), Material::matte(VERMILION))?;
    }
    let shift = glam::DAffine3::from_translation(aside);
    for surface in chain.surfaces() {
        scene.add(
            surface_mesh(surface, steps).transformed(shift),
            Material::zebra(),
        )?;
    }
    scene.ground_below();
    let camera = scene.camera(dvec3(0.1, -1.0, 0.9), context.aspect_or(2.0));
    context.render(
        "render",
        &scene,
        &camera,
        "Left a model with five geodesics traced on its mesh (Fig. 3.13), right the surface of four strips through them (Fig. 3.14).",
        "A clay-coloured dome with five red lines beside a striped dome with the same lines.",
    )?;
    let meshes: Vec<Mesh> = chain
        .surfaces()
        .iter()
        .map(|s| surface_mesh(s, context.pick(40, 16)))
        .collect();
    let names = ["S12", "S23", "S34", "S45"];
    let parts: Vec<Part<'_>> = names
        .iter()
        .zip(&meshes)
        .enumerate()
        .map(|(k, (name, mesh))| Part::new(name, mesh, Color::cycle(k)))
        .collect();
    context.meshes("strips", &parts)
}

/// Figs 3.10 to 3.12: the influence of the lengths and of the angles, and the criteria.
fn draw_free_functions(context: &mut Context, strips: [GeodesicStrip; 2]) -> Result<()> {
    let base = TwoCurveSurface::new(strips.clone())?;
    let field = |length: f64, angle: ScalarFunction| EndField::Polar {
        angle,
        length: length.into(),
    };
    let variants = [
        base.clone()
            .with_fields([field(0.7, 0.0.into()), field(0.7, 0.0.into())]),
        base.clone()
            .with_fields([field(2.6, 0.0.into()), field(0.7, 0.0.into())]),
        base.clone().with_fields([
            field(1.2, ScalarFunction::formula(|u| (u - 0.5) * 2.0)),
            field(1.2, ScalarFunction::formula(|u| (-u + 0.5) * 2.0)),
        ]),
        base.clone()
            .smoothed(LocalCriterion::Bending, Freedom::Lengths)?,
        base.clone()
            .smoothed(LocalCriterion::SpeedVariation, Freedom::Vectors)?,
        base.smoothed_globally(6)?,
    ];
    let steps = context.pick(80, 24);
    let mut scene = Scene::new();
    for (k, surface) in variants.iter().enumerate() {
        let offset = dvec3(2.9 * (k % 3) as f64, -1.7 * (k / 3) as f64, 0.0);
        let shift = glam::DAffine3::from_translation(offset);
        scene.add(
            surface_mesh(surface, steps).transformed(shift),
            Material::zebra(),
        )?;
        for strip in surface.strips() {
            let points: Vec<DVec3> = (0..=120)
                .map(|i| strip.curve().point(f64::from(i) / 120.0) + offset)
                .collect();
            scene.add(
                Mesh::tube(&points, 0.014, false),
                Material::matte(VERMILION),
            )?;
        }
    }
    scene.ground_below();
    let camera = scene.camera(dvec3(0.0, -1.0, 1.3), context.aspect_or(2.3));
    context.render(
        "render-free-functions",
        &scene,
        &camera,
        "Two geodesics, six surfaces: equal and unequal lengths, turned angles (Figs 3.10, 3.11); least bending, least speed variation, global thin plate (Fig. 3.12).",
        "Two rows of three striped strips of surface, each between the same two red curves.",
    )?;
    let energies: Vec<f64> = variants
        .iter()
        .map(TwoCurveSurface::thin_plate_energy)
        .collect();
    let least = energies.iter().copied().fold(f64::INFINITY, f64::min);
    let global = energies.last().copied().context("six variants")?;
    context.number(
        "global_criterion_is_least",
        u8::from(global <= least),
        Target::exactly(1),
    );
    Ok(())
}

/// Where the reconstruction leaves the model.
fn draw_error(context: &mut Context, chain: &StripChain) -> Result<()> {
    let mut plot = Plot::chart(
        "distance to the model",
        "across the five curves",
        "distance",
    );
    plot.log_y();
    for (u, color) in [(0.25, BLUE), (0.5, GREEN), (0.75, VERMILION)] {
        let points: Vec<DVec2> = (0..=200)
            .map(|i| {
                let at = 4.0 * f64::from(i) / 200.0;
                let k = (at as usize).min(3);
                let p = chain.surfaces()[k].point(u, at - k as f64);
                dvec2(at + 1.0, distance_to_model(p).max(1e-8))
            })
            .collect();
        plot.polyline(&points, color.line().label(format!("u = {u}")));
    }
    context.figure(
        "figure-error",
        &Figure::new(plot),
        "The distance of the reconstructed surface from the model, along three lines across the five geodesics.",
        "Three curves of the distance over the strips 1 to 5, some thousandths at most, with dips where it changes its sign.",
    )?;
    Ok(())
}
