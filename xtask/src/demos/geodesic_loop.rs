//! Closed geodesics on toroidal surfaces, and fibres on nested surfaces of revolution.
//!
//! What one sees: a torus with three coloured loops that wind around it as taut strings do, each beside the thin dark line
//! that it was tightened from; a lopsided ring, a model of the right ventricle, with two such loops; and three glass
//! cups, one in the other, models of the left ventricle, with fibres that swing between two heights on each.

use std::f64::consts::{PI, TAU};

use anyhow::{Context as _, Result, ensure};
use geodesic::{
    GeodesicLoop as Loop, LoopFinder, Mesh as Surface, Straightest, SubdivisionSurface,
    SurfacePoint, TorusClasses, closed_torus_geodesic, shapes,
};
use glam::{DVec2, DVec3};

use crate::color::{BLUE, Color, GREEN, INK, MIST, ORANGE, SKY, VERMILION};
use crate::demo::{BadInput, Context, Demo};
use crate::figure::{Figure, Marker, Plot};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct GeodesicLoop {
    /// Radius of the torus
    #[arg(long, default_value_t = 2.0)]
    major: f64,
    /// Radius of its tube
    #[arg(long, default_value_t = 0.7)]
    minor: f64,
}

/// Classes (p, q): p turns along the parallels, q around the tube.
const CLASSES: [(u32, u32); 3] = [(1, 1), (1, 2), (1, 3)];
const COLORS: [Color; 3] = [VERMILION, BLUE, GREEN];

impl Demo for GeodesicLoop {
    const NAME: &'static str = "geodesic-loop";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 2.9 to 2.12";
    const ABOUT: &'static str =
        "Closed geodesics on toroidal surfaces, fibres on nested surfaces of revolution";

    fn run(&self, context: &mut Context) -> Result<()> {
        self.torus(context)?;
        ventricle(context)?;
        fibres(context)
    }
}

impl GeodesicLoop {
    fn torus(&self, context: &mut Context) -> Result<()> {
        ensure!(
            self.major.is_finite() && 0.05 * self.major <= self.minor && self.minor < self.major,
            BadInput("--minor has to lie between a twentieth of --major and --major".into())
        );
        let (around, tube) = context.pick((144, 72), (72, 36));
        let mesh = shapes::torus(self.major, self.minor, around, tube)?;
        let parallel: Vec<SurfacePoint> = (0..around).map(SurfacePoint::Vertex).collect();
        let meridian: Vec<SurfacePoint> = (0..tube)
            .map(|j| SurfacePoint::Vertex(j * around))
            .collect();
        let mut classes = TorusClasses::new(&mesh, &parallel, &meridian)?;
        let mut scene = Scene::new();
        scene.add(self.smooth_torus(), Material::matte(MIST))?;
        let (mut errors, mut spread, mut lengths) = (Vec::new(), 0.0_f64, Vec::new());
        for ((p, q), color) in CLASSES.into_iter().zip(COLORS) {
            let initial = slanted(around, tube, p, q);
            let tight = LoopFinder::new(&mesh).tighten(&initial)?;
            let found = classes.class_of(&tight.path().points()[1..])?;
            ensure!(found == [p as i32, q as i32], "the loop left its class");
            ensure!(
                tight.certify(&mesh)?.is_geodesic(),
                "the loop is not a geodesic"
            );
            let smooth = closed_torus_geodesic(self.major, self.minor, p, q)?;
            errors.push((tight.length() / smooth.length - 1.0).abs());
            lengths.push(tight.length());
            spread = spread.max(clairaut_deviation(
                tight.path().positions(),
                smooth.clairaut,
            ));
            scene.add(
                slanted_line(p, q, |u, v| self.point(u, v)),
                Material::matte(INK),
            )?;
            scene.add(ring(&tight, 0.022), Material::glossy(color))?;
        }
        scene.ground_below();
        let camera = scene.camera(DVec3::new(-0.2, -1.0, 0.9), context.aspect());
        context.number("loop_lengths", lengths, Target::Free);
        context.number("loop_length_error", errors, Target::AtMost(1e-3));
        context.number("loop_clairaut_deviation", spread, Target::AtMost(0.05));
        context.render(
            "render",
            &scene,
            &camera,
            "Loops of the classes (1, 1), (1, 2) and (1, 3) on a torus: dark where they began, coloured when tight.",
            "A torus with three coloured closed curves that wind around it, each beside a thin dark one.",
        )
    }

    fn point(&self, u: f64, v: f64) -> DVec3 {
        let rho = self.major + self.minor * v.cos();
        DVec3::new(rho * u.cos(), rho * u.sin(), self.minor * v.sin())
    }

    fn smooth_torus(&self) -> Mesh {
        Mesh::grid(192, 96, |u, v| {
            let (u, v) = (TAU * u, TAU * v);
            let normal = DVec3::new(u.cos() * v.cos(), u.sin() * v.cos(), v.sin());
            // A little inside the curves drawn on it.
            (self.point(u, v) - 0.004 * self.minor * normal, normal)
        })
    }
}

/// Vertices of a grid along the line of slope q/p in its parameters.
fn slanted(around: u32, tube: u32, p: u32, q: u32) -> Vec<SurfacePoint> {
    let steps = 4 * (p + q);
    (0..steps)
        .map(|k| {
            let t = f64::from(k) / f64::from(steps);
            let index =
                |turns: u32, count: u32| (t * f64::from(turns * count)).round() as u32 % count;
            SurfacePoint::Vertex(index(q, tube) * around + index(p, around))
        })
        .collect()
}

/// The closed curve of slope q/p in the parameters of a surface, as a thin tube: where a loop begins.
fn slanted_line(p: u32, q: u32, surface: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let points: Vec<DVec3> = (0..400 * q)
        .map(|k| TAU * f64::from(k) / f64::from(400 * q))
        .map(|t| surface(f64::from(p) * t, f64::from(q) * t))
        .collect();
    Mesh::tube(&points, 0.009, true)
}

/// Largest relative deviation of ρ cos ψ from Clairaut's constant along a curve about the z axis.
fn clairaut_deviation(points: &[DVec3], constant: f64) -> f64 {
    points
        .windows(2)
        .filter(|ends| ends[0].distance(ends[1]) > 1e-6)
        .map(|ends| {
            let direction = (ends[1] - ends[0]).normalize();
            let middle = 0.5 * (ends[0] + ends[1]);
            ((middle.x * direction.y - middle.y * direction.x).abs() / constant - 1.0).abs()
        })
        .fold(0.0, f64::max)
}

/// A loop as a tube.
fn ring(tight: &Loop, radius: f64) -> Mesh {
    let mut points = tight.path().positions().to_vec();
    points.pop();
    points.dedup_by(|a, b| a.distance(*b) < 0.2 * radius);
    Mesh::tube(&points, radius, true)
}

/// A lopsided ring: the tube swells on one side and is flattened, as the right ventricle is.
fn lopsided(u: f64, v: f64) -> DVec3 {
    let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
    let tube = 0.62 + 0.26 * (u - 0.6).cos();
    let rho = 1.75 + 0.3 * (2.0 * u).cos() + tube * cv;
    DVec3::new(
        1.15 * rho * cu,
        0.9 * rho * su,
        tube * (1.2 + 0.25 * su) * sv + 0.25 * (u + 0.4).sin(),
    )
}

/// Catmull and Clark's surface of a coarse net of that ring.
fn lopsided_surface(around: u32, tube: u32) -> Result<SubdivisionSurface> {
    let angle = |k: u32, n: u32| TAU * f64::from(k) / f64::from(n);
    let (mut positions, mut quads) = (Vec::new(), Vec::new());
    for j in 0..tube {
        for i in 0..around {
            positions.push(lopsided(angle(i, around), angle(j, tube)));
            let vertex = |i: u32, j: u32| j % tube * around + i % around;
            quads.push([(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(i, j)));
        }
    }
    let surface = SubdivisionSurface::catmull_clark(&positions, &quads)?;
    Ok(surface.with_vertices_on_limit(true)?)
}

/// The closed curve of slope q/p on the net, as points of its mesh: quadrilateral `k` consists of the triangles `2 k`, on
/// the side of its second corner, and `2 k + 1`.
fn slanted_on_net(around: u32, tube: u32, [p, q]: [u32; 2], steps: u32) -> Vec<SurfacePoint> {
    (0..steps)
        .map(|k| {
            let place = |turns: u32, count: u32| {
                let t = f64::from(turns * count) * (f64::from(k) + 0.31) / f64::from(steps);
                (t.floor() as u32 % count, t.fract())
            };
            let ((i, s), (j, t)) = (place(p, around), place(q, tube));
            let quad = j * around + i;
            let (face, barycentric) = if s >= t {
                (2 * quad, [1.0 - s, s - t, t])
            } else {
                (2 * quad + 1, [1.0 - t, s, t - s])
            };
            SurfacePoint::Face { face, barycentric }
        })
        .collect()
}

/// A closed curve on the ring: where it began, carried along, and what it is tightened to on each level.
struct Winding {
    class: [u32; 2],
    initial: Vec<SurfacePoint>,
    tight: Vec<SurfacePoint>,
}

/// Loops on the lopsided ring, carried from level to level of its subdivision.
fn ventricle(context: &mut Context) -> Result<()> {
    let levels = context.pick(5, 4);
    let (around, tube) = (14, 8);
    let mut surface = lopsided_surface(around, tube)?;
    let mut windings = [[1, 1], [1, 2]].map(|class| Winding {
        class,
        initial: slanted_on_net(around, tube, class, 600),
        tight: slanted_on_net(around, tube, class, 4 * (class[0] + class[1])),
    });
    let (mut turning, mut lengths, mut loops) = (Vec::new(), Vec::new(), Vec::new());
    for level in 0..levels {
        if level > 0 {
            for points in windings
                .iter_mut()
                .flat_map(|w| [&mut w.initial, &mut w.tight])
            {
                for point in points.iter_mut() {
                    *point = surface.carry(*point)?;
                }
            }
            surface = surface.refined()?;
        }
        let mut worst = 0.0_f64;
        lengths.clear();
        loops.clear();
        for winding in &mut windings {
            let tight = LoopFinder::new(surface.mesh()).tighten(&winding.tight)?;
            ensure!(
                tight.certify(surface.mesh())?.is_geodesic(),
                "the loop {:?} is not a geodesic",
                winding.class
            );
            worst = worst.max(largest_turn(&tight));
            winding.tight = tight.path().points()[1..].to_vec();
            lengths.push(tight.length());
            loops.push(tight);
        }
        turning.push(worst);
    }
    let mesh = surface.mesh();
    let mut scene = Scene::new();
    scene.add(
        Mesh::smooth(mesh.positions().to_vec(), mesh.faces().to_vec()),
        Material::matte(MIST),
    )?;
    for ((winding, tight), color) in windings.iter().zip(&loops).zip([ORANGE, BLUE]) {
        let initial: Vec<DVec3> = winding
            .initial
            .iter()
            .map(|point| mesh.point_position(*point))
            .collect::<Result<_, _>>()?;
        scene.add(Mesh::tube(&initial, 0.009, true), Material::matte(INK))?;
        scene.add(ring(tight, 0.022), Material::glossy(color))?;
    }
    let falls = turning.windows(2).all(|pair| pair[1] < pair[0]);
    context.number("ventricle_loop_lengths", lengths, Target::Free);
    context.number("max_turning_rad", turning.clone(), Target::Free);
    context.number("max_turning_falls", falls, Target::exactly(true));
    scene.ground_below();
    let camera = scene.camera(DVec3::new(-0.4, -1.0, 0.9), context.aspect());
    context.render(
        "render-ventricle",
        &scene,
        &camera,
        "Two closed geodesics on a subdivision surface, a model of the right ventricle; dark: the closed curves that they were \
         tightened from.",
        "A lopsided ring with an orange and a blue closed curve around it.",
    )?;
    let mut plot = Plot::chart(
        "loops on finer and finer meshes",
        "vertices around",
        "largest turn between segments (rad)",
    );
    plot.log_x().log_y();
    let series: Vec<DVec2> = turning
        .iter()
        .enumerate()
        .map(|(level, &turn)| DVec2::new(f64::from(around << level), turn))
        .collect();
    plot.polyline(&series, BLUE.line().width(2.0));
    plot.points(&series, Marker::Disc, BLUE.fill());
    context.figure(
        "figure",
        &Figure::new(plot),
        "The loops become smooth curves: the largest turn between neighbouring segments halves with the edges.",
        "A chart with a falling line.",
    )
}

/// Largest angle between neighbouring segments of a loop in space.
fn largest_turn(tight: &Loop) -> f64 {
    let mut points = tight.path().positions().to_vec();
    points.dedup_by(|a, b| a.distance(*b) < 1e-6);
    points
        .windows(3)
        .map(|p| (p[1] - p[0]).angle_between(p[2] - p[1]))
        .fold(0.0, f64::max)
}

/// Nested cups with fibres.
fn fibres(context: &mut Context) -> Result<()> {
    let mut scene = Scene::new();
    let mut deviation = 0.0_f64;
    for (radius, color) in [(1.0, VERMILION), (0.78, ORANGE), (0.56, BLUE)] {
        // The lower part of an ellipsoid, open above and below.
        let (around, rows) = context.pick((160, 120), (96, 72));
        let height = 1.6 * radius + 0.2;
        let latitude = |j: f64| -1.25 + (1.25 + 0.62) * j / f64::from(rows);
        let point = |p: DVec2| {
            let ((su, cu), (sv, cv)) = (
                (TAU * p.x / f64::from(around)).sin_cos(),
                latitude(p.y).sin_cos(),
            );
            DVec3::new(radius * cu * cv, radius * su * cv, height * sv)
        };
        let normal = |p: DVec3| (p / DVec3::new(radius, radius, height).powf(2.0)).normalize();
        let mesh = closed_sheet(around, rows, point)?;
        let normals: Vec<DVec3> = mesh.positions().iter().map(|p| normal(*p)).collect();
        let tracer = Straightest::new(&mesh).with_normals(&normals)?;
        let shell = Mesh::smooth(mesh.positions().to_vec(), mesh.faces().to_vec());
        scene.add(shell, Material::glass(SKY))?;
        // From the equator, at angles that turn back below the upper rim.
        let equator = (1.25 / (1.25 + 0.62) * f64::from(rows)).round() as u32;
        let mut tubes = Mesh::default();
        for k in 0..10 {
            let v = equator * around + k * around / 10;
            let here = mesh.positions()[v as usize];
            let (east, up) = (DVec3::Z.cross(here).normalize(), DVec3::Z);
            let angle = 0.55_f64;
            let direction = angle.cos() * east + angle.sin() * up;
            let from = SurfacePoint::Vertex(v);
            let face = tracer
                .face_towards(from, direction)
                .context("a face in this direction")?;
            let trace = tracer.trace(from, face, direction, 2.6 * PI * radius)?;
            let constant = here.truncate().length() * angle.cos();
            deviation = deviation.max(clairaut_deviation(&trace.positions, constant));
            let mut points = trace.positions;
            points.dedup_by(|a, b| a.distance(*b) < 2e-3);
            tubes.append(Mesh::tube(&points, 0.011, false));
        }
        scene.add(tubes, Material::glossy(color))?;
    }
    context.number("clairaut_max_deviation", deviation, Target::AtMost(0.02));
    scene.ground_below();
    let camera = scene.camera(DVec3::new(-0.3, -1.0, 0.55), context.aspect());
    context.render(
        "render-fibres",
        &scene,
        &camera,
        "Geodesic fibres on nested surfaces of revolution, a model of the left ventricle: each swings between two parallels.",
        "Three nested glass cups with red, orange and blue curves winding around them.",
    )
}

/// A sheet closed around: column `around` is column 0.
fn closed_sheet(around: u32, rows: u32, point: impl Fn(DVec2) -> DVec3) -> Result<Surface> {
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..around {
            positions.push(point(DVec2::new(f64::from(i), f64::from(j))));
            if j < rows {
                let (a, b) = (j * around + i, j * around + (i + 1) % around);
                faces.extend([[a, b, b + around], [a, b + around, a + around]]);
            }
        }
    }
    Ok(Surface::new(&positions, &faces)?)
}
