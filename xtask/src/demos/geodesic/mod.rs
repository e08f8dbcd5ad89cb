//! Locally shortest paths on a mesh: what each pivot update does, the faces laid flat, and the distance from a point.
//!
//! What one sees: the cube of the thesis cut open, a straight line across two of its faces; a terrain from above on which
//! a path, first bound to the edges, pulls itself straight update by update, its faces laid flat before and after; and the
//! terrain (or the mesh given) in the ray tracer, coloured by the exact distance from the first start point with a line at
//! every further step, and red paths that cross these lines at right angles.

mod figures;
mod shapes;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Result, ensure};
use geodesic::{DistanceField, GeodesicPath, Mesh as Surface, PathFinder, Sweep};
use glam::DVec3;

use crate::color::{BLUE, ColorMap, INK, VERMILION};
use crate::demo::{BadInput, Context, Demo, OrBadInput};
use crate::mesh::Mesh;
use crate::random::Random;
use crate::render::{Material, Scene};
use crate::report::Target;

/// The meshes that come with the demo.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Shape {
    /// The unit cube
    Cube,
    /// A sphere with bumps
    Bumpy,
    /// A rounded plate with two holes
    Genus2,
    /// A terrain over scattered points with a ridge
    Terrain,
}

#[derive(clap::Args, Debug)]
pub(super) struct Geodesic {
    /// An OBJ file instead of a built-in mesh
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
    /// A built-in mesh
    #[arg(long, value_enum, default_value_t = Shape::Terrain)]
    shape: Shape,
    /// First vertex of a single path, numbered from 0 in file order
    #[arg(long, value_name = "V", requires = "to", conflicts_with = "pairs")]
    from: Option<u32>,
    /// Last vertex of a single path
    #[arg(long, value_name = "V", requires = "from")]
    to: Option<u32>,
    /// Vertex pairs, `[[v0, v1], ...]` [default: 20 random ones]
    #[arg(long, value_name = "FILE")]
    pairs: Option<PathBuf>,
    /// Measure the exact distances of the pairs beside the paths
    #[arg(long)]
    exact: bool,
}

impl Demo for Geodesic {
    const NAME: &'static str = "geodesic";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 2.1, 2.2 and 2.5";
    const ABOUT: &'static str = "Locally shortest paths on a mesh, update by update, and distances";

    fn run(&self, context: &mut Context) -> Result<()> {
        let mesh = self.surface(context)?;
        let pairs = self.pairs(&mesh, context.seed())?;
        let paths = measure(context, &mesh, &pairs)?;
        if self.exact {
            measure_exact(context, &mesh, &pairs, &paths)?;
        }
        figures::draw_cube(context)?;
        figures::draw_updates(context)?;
        render(context, &mesh, &pairs, &paths)
    }
}

impl Geodesic {
    fn surface(&self, context: &Context) -> Result<Surface> {
        if let Some(path) = &self.mesh {
            return Surface::read_obj(path).or_bad_input("--mesh");
        }
        Ok(match self.shape {
            Shape::Cube => geodesic::shapes::cube()?,
            Shape::Bumpy => shapes::bumpy(context.pick(5, 4))?,
            Shape::Genus2 => geodesic::shapes::plate(2, context.pick(4, 3))?,
            Shape::Terrain => shapes::terrain(context.pick(4000, 1200), context.seed())?,
        })
    }

    fn pairs(&self, mesh: &Surface, seed: u64) -> Result<Vec<[u32; 2]>> {
        let pairs: Vec<[u32; 2]> = match (&self.pairs, self.from.zip(self.to)) {
            (Some(path), _) => {
                let text = std::fs::read_to_string(path).or_bad_input("--pairs")?;
                serde_json::from_str(&text).or_bad_input("--pairs")?
            }
            (None, Some((from, to))) => vec![[from, to]],
            (None, None) => {
                let mut random = Random::new(seed);
                let mut vertex = || (random.unit() * mesh.vertex_count() as f64) as u32;
                // The same start for all, so that the picture shows them against the distance from it.
                let start = vertex();
                (0..20).map(|_| [start, vertex()]).collect()
            }
        };
        for v in pairs.iter().flatten() {
            mesh.vertex_point(*v).or_bad_input("the vertex pairs")?;
        }
        ensure!(
            !pairs.is_empty(),
            BadInput("there are no vertex pairs".into())
        );
        Ok(pairs)
    }
}

/// Finds the paths and records what was asked about them.
fn measure(context: &mut Context, mesh: &Surface, pairs: &[[u32; 2]]) -> Result<Vec<GeodesicPath>> {
    let mut finder = PathFinder::new(mesh);
    let (mut paths, mut times) = (Vec::new(), Vec::new());
    let mut not_geodesic = 0;
    for &[from, to] in pairs {
        // Once to warm up, once for the clock.
        finder
            .shortest(from.into(), to.into())
            .or_bad_input("the vertex pairs")?;
        let start = Instant::now();
        let path = finder.shortest(from.into(), to.into())?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
        not_geodesic += usize::from(!path.certify(mesh)?.is_geodesic());
        paths.push(path.clone());
    }
    times.sort_by(f64::total_cmp);
    let lengths: Vec<f64> = paths.iter().map(GeodesicPath::length).collect();
    context.number("triangles", mesh.face_count(), Target::Free);
    context.number("pairs", pairs.len(), Target::Free);
    match lengths[..] {
        [length] => context.number("length", length, Target::Free),
        _ => context.number("lengths", lengths, Target::Free),
    }
    context.number("not_geodesic", not_geodesic, Target::exactly(0));
    context.number("median_ms_local", times[times.len() / 2], Target::Free);
    Ok(paths)
}

/// Measures the exact distance of every pair, and how much longer the paths are.
fn measure_exact(
    context: &mut Context,
    mesh: &Surface,
    pairs: &[[u32; 2]],
    paths: &[GeodesicPath],
) -> Result<()> {
    let mut sweep = Sweep::new(mesh);
    let (mut exact, mut times, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    for (&[from, to], path) in pairs.iter().zip(paths) {
        let start = Instant::now();
        let distance = sweep.distance(from.into(), to.into())?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
        // A point is as far from itself by any path.
        let equal = distance == 0.0 && path.length() == 0.0;
        ratios.push(if equal { 1.0 } else { path.length() / distance });
        exact.push(distance);
    }
    times.sort_by(f64::total_cmp);
    let smallest = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = ratios.iter().copied().fold(0.0, f64::max);
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    context.number("exact_lengths", exact, Target::Free);
    context.number("median_ms_exact", times[times.len() / 2], Target::Free);
    context.number("min_ratio_to_exact", smallest, Target::AtLeast(1.0 - 1e-12));
    context.number("mean_ratio_to_exact", mean, Target::Free);
    context.number("max_ratio_to_exact", largest, Target::Free);
    Ok(())
}

/// The mesh coloured by distance, with the paths on it.
fn render(
    context: &mut Context,
    mesh: &Surface,
    pairs: &[[u32; 2]],
    paths: &[GeodesicPath],
) -> Result<()> {
    let mut sweep = Sweep::new(mesh);
    let field = sweep.from_points(&[pairs[0][0].into()])?;
    // 0 where there is no way.
    let reached = |d: &f64| if d.is_finite() { *d } else { 0.0 };
    let distances: Vec<f64> = field.vertex_distances().iter().map(reached).collect();
    let farthest = distances.iter().copied().fold(0.0, f64::max);
    let size = mesh.diameter();
    let body =
        Mesh::smooth(mesh.positions().to_vec(), mesh.faces().to_vec()).with_scalar(distances);
    let mut scene = Scene::new();
    scene.add(body, Material::scalar(ColorMap::Sequential, 0.0, farthest))?;
    let lines = isolines(context, &field, farthest, size)?;
    if !lines.positions.is_empty() {
        scene.add(lines, Material::glossy(INK))?;
    }
    let mut tubes = Mesh::default();
    for path in paths.iter().take(24) {
        let mut points = path.positions().to_vec();
        points.dedup_by(|a, b| a.distance(*b) < 1e-9 * size);
        if points.len() > 1 {
            tubes.append(Mesh::tube(&points, 3.5e-3 * size, false));
        }
    }
    let count = tubes.positions.len();
    scene.add(
        tubes.with_scalar(vec![0.0; count]),
        Material::glossy(VERMILION),
    )?;
    let marks = Mesh::sphere(
        mesh.positions()[pairs[0][0] as usize],
        8e-3 * size,
        1e-4 * size,
    );
    let count = marks.positions.len();
    scene.add(marks.with_scalar(vec![0.0; count]), Material::glossy(BLUE))?;
    scene.layer("geodesic.D");
    scene.ground_below();
    let camera = scene.camera(DVec3::new(-0.35, -1.0, 0.85), context.aspect());
    context.render(
        "render",
        &scene,
        &camera,
        "Distance from the blue point, a dark line at every sixteenth of the largest, and paths from it.",
        "A surface coloured by distance with dark rings around a blue point and red paths leaving it.",
    )
}

/// Thin tubes along the lines of equal distance, fifteen levels of them.
fn isolines(
    context: &mut Context,
    field: &DistanceField<'_, '_>,
    farthest: f64,
    size: f64,
) -> Result<Mesh> {
    let (mut tubes, mut count, mut worst) = (Mesh::default(), 0, 0.0_f64);
    for k in 1..16 {
        let level = farthest * f64::from(k) / 16.0;
        for line in field.isolines(level, 1e-4 * size)? {
            count += 1;
            for &point in &line.points {
                worst = worst.max((field.distance(point)? - level).abs() / farthest);
            }
            let mut points = line.positions;
            points.dedup_by(|a, b| a.distance(*b) < 2e-3 * size);
            // Of their own distance, for the layer in the EXR file.
            let tube = Mesh::tube(&points, 1e-3 * size, line.is_closed);
            tubes.append(tube.with_scalar_at(|_| level));
        }
    }
    context.number("isolines", count, Target::Free);
    context.number("isoline_max_error", worst, Target::AtMost(1e-9));
    Ok(tubes)
}
