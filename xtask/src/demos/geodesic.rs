//! Locally shortest paths on a mesh: what each pivot update does, the faces laid flat, and the distance from a point.
//!
//! What one sees: the cube of the thesis cut open, a straight line across two of its faces; a terrain from above on which
//! a path, first bound to the edges, pulls itself straight update by update, its faces laid flat before and after; and the
//! terrain (or the mesh given) in the ray tracer, coloured by the exact distance from the first start point with a line at
//! every further step, and red paths that cross these lines at right angles.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Result, ensure};
use geodesic::{
    DistanceField, GeodesicPath, Mesh as Surface, PathFinder, Start, Sweep, TriangleSoup, shapes,
};
use glam::{DVec2, DVec3};
use serde_json::json;

use crate::color::ColorMap;
use crate::color::{BLUE, GREY, INK, MIST, SKY, VERMILION};
use crate::demo::{BadInput, Context, Demo, OrBadInput};
use crate::figure::{Figure, Marker, Plot, Side};
use crate::mesh::Mesh;
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
        draw_cube(context)?;
        draw_updates(context)?;
        render(context, &mesh, &pairs, &paths)
    }
}

impl Geodesic {
    fn surface(&self, context: &Context) -> Result<Surface> {
        if let Some(path) = &self.mesh {
            return Surface::read_obj(path).or_bad_input("--mesh");
        }
        Ok(match self.shape {
            Shape::Cube => shapes::cube()?,
            Shape::Bumpy => bumpy(context.pick(5, 4))?,
            Shape::Genus2 => shapes::plate(2, context.pick(4, 3))?,
            Shape::Terrain => terrain(context.pick(4000, 1200), context.seed())?,
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
                let mut random = Random(seed);
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

/// The cube of Fig. 2.1: the path between opposite corners, and another geodesic that is longer.
fn draw_cube(context: &mut Context) -> Result<()> {
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
        unfolded(&cube, &opposite, "from corner to corner: √5"),
        unfolded(
            &cube,
            &round,
            &format!(
                "a geodesic of length {:.3}; the shortest: {direct:.3}",
                round.length()
            ),
        ),
    ];
    context.figure(
        "figure-cube",
        &Figure::grid(1, plots).aspect(3.0),
        "Faces of a cube laid flat with geodesics: straight lines.",
        "Two strips of triangles, each crossed by a straight red line.",
    )
}

/// A path in the plane of its faces.
fn unfolded(mesh: &Surface, path: &GeodesicPath, title: &str) -> Plot {
    let mut flat = path.unfold(mesh);
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
    plot
}

/// A path on a terrain seen from above, from the edges to the geodesic, and its faces before and after.
fn draw_updates(context: &mut Context) -> Result<()> {
    let mesh = terrain(160, 3)?;
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
    let shown = 4.min(stages.len());
    let mut plots = Vec::new();
    for k in 0..shown {
        let index = k * (stages.len() - 1) / (shown - 1).max(1);
        let stage = &stages[index];
        let mut plot = Plot::geometry(&match index {
            0 => format!("initial sequence: {:.3}", stage.length()),
            _ => format!("after {index} updates: {:.3}", stage.length()),
        });
        let faces = stage.unfold(&mesh).faces;
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
        "A path on a terrain, seen from above, from the initial sequence of faces (blue) to the geodesic; black: pivots.",
        "Four plans of a triangulated terrain with a red path that straightens from one to the next.",
    )?;
    let last = stages.len() - 1;
    let strips = vec![
        unfolded(&mesh, &stages[0], "the initial sequence laid flat"),
        unfolded(&mesh, &stages[last], "the final one"),
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

/// A sphere with bumps.
fn bumpy(level: u32) -> Result<Surface> {
    let mut soup = TriangleSoup::from(shapes::sphere(level)?);
    for p in &mut soup.positions {
        *p *= 1.0
            + 0.12 * (7.0 * p.x).sin() * (6.0 * p.y).cos()
            + 0.1 * (5.0 * p.z + 2.0 * p.x).sin();
    }
    Ok(soup.try_into()?)
}

/// A terrain of 10 by 10 over scattered points, with a ridge among its edges.
fn terrain(points: usize, seed: u64) -> Result<Surface> {
    let height = |p: DVec2| {
        let hills = 0.7 * (1.1 * p.x).sin() * (0.9 * p.y + 0.5).cos()
            + 0.25 * (2.3 * p.x - 1.7 * p.y).sin();
        let ridge = (-(p.y - 0.6 * p.x - 2.0).powi(2) / 0.5).exp();
        hills + 1.4 * ridge
    };
    let mut random = Random(seed);
    let mut plan: Vec<DVec2> = Vec::new();
    let side = (points as f64).sqrt().ceil() as u32;
    for k in 0..side {
        let t = 10.0 * f64::from(k) / f64::from(side);
        plan.extend([
            DVec2::new(t, 0.0),
            DVec2::new(10.0, t),
            DVec2::new(10.0 - t, 10.0),
            DVec2::new(0.0, 10.0 - t),
        ]);
    }
    // One point in each cell, so that no triangle is too thin.
    for cell in 0..side * side {
        let corner = DVec2::new(f64::from(cell % side), f64::from(cell / side));
        let inside = 0.15 + 0.7 * DVec2::new(random.unit(), random.unit());
        plan.push((corner + inside) * 10.0 / f64::from(side));
    }
    let first = plan.len() as u32;
    let ridge = 24;
    plan.extend((1..ridge).map(|k| {
        let x = 10.0 * f64::from(k) / f64::from(ridge);
        DVec2::new(x, 0.6 * x + 2.0)
    }));
    let breaklines: Vec<[u32; 2]> = (first..first + ridge - 2).map(|v| [v, v + 1]).collect();
    let points: Vec<DVec3> = plan.iter().map(|p| p.extend(height(*p))).collect();
    Ok(Surface::terrain(&points, &breaklines)?)
}

/// A small generator of random numbers: the same on every machine.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
