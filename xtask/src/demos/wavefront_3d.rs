//! A front in space: offsets of an ellipsoid, reflected by a bowl.
//!
//! What one sees: upper left an orange ellipsoid, the front at time zero. Four square sheets, blue and growing, are parts of
//! its offsets on their way down into a grey bowl, a paraboloid. To the right, four sheets in red tones rise again: they
//! shrink to something like a line where they pass the caustic, and open again turned over. They are smooth patches, fine lines
//! along some of their edges. Thin grey tubes are the rays through their corners.

use anyhow::{Context as _, Result};
use glam::{DMat3, DVec2, DVec3, dvec2, dvec3};
use wavefront::{DualSurface, FrontPatches, Mirror, PatchOptions, SampledSurface, SpacePoint};

use crate::color::{BLUE, Color, GREY, ORANGE, SKY, VERMILION, YELLOW};
use crate::demo::{Context, Demo};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Wavefront3d {
    /// Half the width of the beam at unit distance
    #[arg(long, default_value_t = 0.32)]
    opening: f64,
}

/// The ellipsoid from which the wave starts: its centre and half axes along the coordinates.
const CENTRE: DVec3 = dvec3(-2.3, 0.0, 2.6);
const AXES: DVec3 = dvec3(0.5, 0.42, 0.34);
/// The ways that the drawn fronts have run, down into the bowl and up again.
const FALLING: [f64; 4] = [0.75, 1.3, 1.85, 2.4];
const RISING: [f64; 4] = [4.2, 5.1, 6.0, 6.9];
/// The patches cover this share of the beam's normals.
const INSET: f64 = 0.8;
/// The bowl is z = BEND (x² + y²).
const BEND: f64 = 0.2;

impl Demo for Wavefront3d {
    const NAME: &'static str = "wavefront-3d";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Chapter 5, continued into space";
    const ABOUT: &'static str = "Offsets of an ellipsoid and their reflection in a bowl";

    fn run(&self, context: &mut Context) -> Result<()> {
        let front = DualSurface::ellipsoid(
            CENTRE,
            [AXES.x * DVec3::X, AXES.y * DVec3::Y, AXES.z * DVec3::Z],
        )?;
        let count = context.pick(60, 16);
        context.number(
            "offset_max_error",
            offset_error(&front, count),
            Target::AtMost(1e-12),
        );
        let reflected = self
            .bowl_error(&front, count)?
            .max(plane_error(&front, count)?)
            .max(focus_error(count)?);
        context.number("reflected_max_error", reflected, Target::AtMost(1e-9));
        let coarse = self
            .beam(&front, 2 * count)?
            .reflect(&bowl()?)?
            .normality_defect();
        let fine = self
            .beam(&front, 4 * count)?
            .reflect(&bowl()?)?
            .normality_defect();
        // The theorem of Malus and Dupin: the reflected rays are normal to a surface, so the defect is of the second order.
        context.number(
            "normality_order",
            (coarse / fine).log2(),
            Target::AtLeast(1.8),
        );
        let tolerance = context.pick(1e-6, 1e-4);
        let patches = self.patches(&front, tolerance)?;
        let (independent, compared) = self.patch_error(&front, &patches, count)?;
        context.number(
            "patch_max_error",
            independent,
            Target::AtMost(2.0 * tolerance),
        );
        context.number("patch_rays_compared", compared, Target::AtLeast(50.0));
        let bent = RISING.map(|run| patches.offset(run).joint_errors(1).0);
        context.number(
            "patch_g1_max_angle_rad",
            bent.into_iter().fold(0.0, f64::max),
            Target::AtMost(1e-8),
        );
        context.number("patches", patches.cells().count(), Target::AtLeast(16.0));
        self.draw(context, &front, &patches)
    }
}

fn bowl() -> Result<Mirror> {
    let form = DMat3::from_diagonal(dvec3(BEND, BEND, 0.0));
    Ok(Mirror::quadric(form, dvec3(0.0, 0.0, -0.5), 0.0)?)
}

/// Normals all over the sphere, those of a spiral.
fn normals(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count * count).map(move |i| {
        let z = 1.0 - 2.0 * (i as f64 + 0.5) / (count * count) as f64;
        let (sin, cos) = (2.399_963 * i as f64).sin_cos();
        dvec3((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    })
}

/// The distance of a point outside from an ellipsoid with its axes along the coordinates.
///
/// The foot is `a² x / (a² + t)` in each coordinate, with the root t of the ellipsoid's equation there, by bisection.
fn distance(from_centre: DVec3, axes: DVec3) -> f64 {
    let squares = axes * axes;
    let excess = |t: f64| (axes * from_centre / (squares + DVec3::splat(t))).length_squared() - 1.0;
    let (mut low, mut high) = (0.0, (axes * from_centre).length());
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    let foot = squares * from_centre / (squares + DVec3::splat(0.5 * (low + high)));
    from_centre.distance(foot)
}

/// Points of an offset have its distance from the ellipsoid.
fn offset_error(front: &DualSurface, count: usize) -> f64 {
    [0.1, 1.0, 5.0].into_iter().fold(0.0, |worst: f64, apart| {
        let offset = front.offset(apart);
        let error = |n: DVec3| (distance(offset.point(n) - CENTRE, AXES) / apart - 1.0).abs();
        normals(count).map(error).fold(worst, f64::max)
    })
}

/// Sampled rays, reflected in a plane and carried on, against the distance from the ellipsoid's mirror image.
fn plane_error(front: &DualSurface, count: usize) -> Result<f64> {
    let run = 7.0;
    let mirror = Mirror::plane(DVec3::Z, 0.0)?;
    let rays = front.sample(count, count, |u, v| dvec3(u - 0.5, v - 0.5, -1.0))?;
    let image = front.reflect(DVec3::Z, 0.0)?.offset(run);
    let reflected = rays.reflect(&mirror)?.offset(run);
    let error = |ray: &SpacePoint| {
        let from_image = ray.point - CENTRE * dvec3(1.0, 1.0, -1.0);
        let exact = image.point(ray.normal).distance(ray.point) / run;
        exact.max((distance(from_image, AXES) / run - 1.0).abs())
    };
    Ok(reflected.rays().iter().map(error).fold(0.0, f64::max))
}

/// A point source in a focus of an ellipsoid: everything is in the other one when the long axis has been run.
fn focus_error(count: usize) -> Result<f64> {
    let (long, short) = (2.0_f64, 1.5_f64);
    let focus = DVec3::X * (long * long - short * short).sqrt();
    let inverse = dvec3(long, short, short).powf(-2.0);
    let mirror = Mirror::quadric(DMat3::from_diagonal(inverse), DVec3::ZERO, -1.0)?;
    let source = DualSurface::sphere(-focus, 0.0)?;
    let rays = SampledSurface::new(count, count, |u, v| {
        let normal = dvec3(2.0 * u - 1.0, 2.0 * v - 1.0, 0.3).try_normalize()?;
        Some(SpacePoint {
            point: source.point(normal),
            normal,
        })
    })?;
    let arrived = rays.reflect(&mirror)?.offset(2.0 * long);
    Ok(arrived
        .rays()
        .iter()
        .map(|ray| ray.point.distance(focus) / long)
        .fold(0.0, f64::max))
}

impl Wavefront3d {
    /// The part of the front that runs to the bottom of the bowl.
    fn beam(&self, front: &DualSurface, count: usize) -> Result<SampledSurface> {
        let middle = -CENTRE.normalize();
        let (across, up) = (DVec3::Y, middle.cross(DVec3::Y));
        let normal = |u: f64, v: f64| {
            middle + self.opening * ((2.0 * u - 1.0) * across + (2.0 * v - 1.0) * up)
        };
        Ok(front.sample(count, count, normal)?)
    }

    /// The front behind the bowl against Fermat's principle: of all paths over the bowl the one that was found is
    /// stationary, and as long as the front has run. The paths start on the ellipsoid by its distance function.
    fn bowl_error(&self, front: &DualSurface, count: usize) -> Result<f64> {
        // When all rays have left the bowl, and when they are long past their caustic.
        let mut largest = 0.0_f64;
        let beam = self.beam(front, count)?;
        let at_zero = beam.reflect(&bowl()?)?;
        for run in [5.2, 8.0] {
            let reflected = at_zero.offset(run);
            for (start, end) in beam.rays().iter().zip(reflected.rays()) {
                let hit = bowl_hit(*start);
                let path = |x: f64, y: f64| {
                    let place = dvec3(x, y, BEND * (x * x + y * y));
                    distance(place - CENTRE, AXES) + place.distance(end.point)
                };
                let step = 1e-4;
                let slope = |dx: f64, dy: f64| {
                    let difference = |h: f64| {
                        path(hit.x + h * dx, hit.y + h * dy) - path(hit.x - h * dx, hit.y - h * dy)
                    };
                    // Fourth order: the step's error is far below rounding over the step.
                    (8.0 * difference(step) - difference(2.0 * step)) / (12.0 * step)
                };
                let stationary = slope(1.0, 0.0).abs().max(slope(0.0, 1.0).abs());
                largest = largest
                    .max(stationary)
                    .max((path(hit.x, hit.y) / run - 1.0).abs());
            }
        }
        Ok(largest)
    }

    /// The reflected front as smooth patches, over the square of normals inside those of the beam.
    fn patches(&self, front: &DualSurface, tolerance: f64) -> Result<FrontPatches> {
        let corners = self.beam(front, 3)?.reflect(&bowl()?)?;
        let middle = corners.rays()[4].normal;
        // The stereographic coordinate of a normal at an angle is the tangent of half of it.
        let half = |ray: &SpacePoint| (0.5 * ray.normal.angle_between(middle)).tan();
        let sides = [1, 3, 5, 7].map(|side| half(&corners.rays()[side]));
        // Towards one side of the beam the normals fold.
        let half_width = INSET * sides.into_iter().fold(f64::INFINITY, f64::min);
        let options = PatchOptions {
            tolerance,
            ..PatchOptions::default()
        };
        let aim = -CENTRE.normalize();
        let patches = FrontPatches::reflected(front, &bowl()?, aim, half_width, options)?;
        Ok(patches)
    }

    /// The largest distance of the patches, at all times that are drawn, from rays that are traced by bisection from normals of
    /// their own; and how many rays that are.
    fn patch_error(
        &self,
        front: &DualSurface,
        patches: &FrontPatches,
        count: usize,
    ) -> Result<(f64, usize)> {
        let moved = RISING.map(|run| patches.offset(run));
        let (mut largest, mut compared) = (0.0_f64, 0);
        for start in self.beam(front, count)?.rays() {
            let hit = bowl_hit(*start);
            let facing = dvec3(-2.0 * BEND * hit.x, -2.0 * BEND * hit.y, 1.0).normalize();
            let normal = start.normal - 2.0 * start.normal.dot(facing) * facing;
            let Some((cell, share)) = patches.cell_of(normal) else {
                continue;
            };
            compared += 1;
            for (front, run) in moved.iter().zip(RISING) {
                let exact = hit + (run - hit.distance(start.point)) * normal;
                let point = front.point(cell, share).context("the patch is there")?;
                largest = largest.max(point.distance(exact));
            }
        }
        Ok((largest, compared))
    }

    fn draw(
        &self,
        context: &mut Context,
        front: &DualSurface,
        patches: &FrontPatches,
    ) -> Result<()> {
        // The part of the incoming front that is reflected to the patches.
        let last = patches.columns();
        let nodes = (0..=last).flat_map(|row| (0..=last).map(move |column| [column, row]));
        let normals = nodes
            .map(|node| patches.incoming_normal(node))
            .collect::<Option<Vec<_>>>()
            .context("the beam is too wide: its normals fold")?;
        let moved = RISING.map(|run| patches.offset(run));
        let scene = |tolerance: f64| -> Result<Scene> {
            let mut scene = Scene::new();
            let radius = 1.9;
            let wall = |u: f64, v: f64| {
                let (sin, cos) = (std::f64::consts::TAU * u).sin_cos();
                let (x, y) = (radius * v * cos, radius * v * sin);
                let normal = dvec3(-2.0 * BEND * x, -2.0 * BEND * y, 1.0).normalize();
                (dvec3(x, y, BEND * (x * x + y * y)), normal)
            };
            scene.add(
                Mesh::surface(wall, |_| tolerance),
                Material::glossy(GREY.mix(Color::hex(0xffffff), 0.45)),
            )?;
            let body = |u: f64, v: f64| {
                let ((sin, cos), (height, width)) = (
                    (std::f64::consts::TAU * u).sin_cos(),
                    (std::f64::consts::PI * (v - 0.5)).sin_cos(),
                );
                let normal = dvec3(width * cos, width * sin, height);
                (front.point(normal), normal)
            };
            scene.add(Mesh::surface(body, |_| tolerance), Material::glossy(ORANGE))?;
            for (i, run) in FALLING.into_iter().enumerate() {
                let color = SKY.mix(BLUE, i as f32 / 3.0);
                let moved = front.offset(run);
                let points = normals.iter().map(|normal| moved.point(*normal)).collect();
                let sheet = Mesh::from_rows(last + 1, points, normals.clone());
                scene.add(sheet, Material::glossy(color))?;
            }
            for (i, front) in moved.iter().enumerate() {
                let color = YELLOW.mix(VERMILION, 0.35 + 0.65 * i as f32 / 3.0);
                scene.add(patched(front), Material::glossy(color))?;
                scene.add(edges(front), Material::matte(GREY.mix(color, 0.3)))?;
            }
            for corner in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                let node = corner.map(|end| end * last);
                let normal = patches
                    .incoming_normal(node)
                    .context("a corner has a ray")?;
                let start = SpacePoint {
                    point: front.point(normal),
                    normal,
                };
                let cell = corner.map(|end| end * (last - 1));
                let share = dvec2(corner[0] as f64, corner[1] as f64);
                let end = moved[3].point(cell, share).context("and a patch")?;
                let path = [start.point, bowl_hit(start), end];
                scene.add(Mesh::tube(&path, 0.009, false), Material::matte(GREY))?;
            }
            scene.ground_below();
            Ok(scene)
        };
        let camera = scene(0.02)?.camera(dvec3(0.25, -1.0, 0.42), context.aspect());
        let tolerance = camera.tolerance(DVec3::ZERO, context.height());
        context.render(
            "render",
            &scene(tolerance)?,
            &camera,
            "An ellipsoid's offsets (blue) run into a bowl; the reflected fronts (yellow to red) pass their caustic.",
            "An orange ellipsoid, blue curved square sheets descending to a grey bowl, warm-coloured sheets rising from it.",
        )
    }
}

/// Where a ray meets the bowl, by bisection.
fn bowl_hit(ray: SpacePoint) -> DVec3 {
    let above = |s: f64| {
        let p = ray.point + s * ray.normal;
        p.z - BEND * (p.x * p.x + p.y * p.y)
    };
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if above(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    ray.point + 0.5 * (low + high) * ray.normal
}

/// All patches as one mesh.
fn patched(front: &FrontPatches) -> Mesh {
    // A few hundred facets across, whatever the number of patches.
    let steps = (256 / front.columns()).max(1) as u32;
    let patch = |cell: [usize; 2]| {
        let (mut points, mut normals) = (Vec::new(), Vec::new());
        for j in 0..=steps {
            for i in 0..=steps {
                let share = dvec2(f64::from(i), f64::from(j)) / f64::from(steps);
                points.extend(front.point(cell, share));
                normals.push(front.normal(front.coordinates(cell, share)));
            }
        }
        Mesh::from_rows(steps as usize + 1, points, normals)
    };
    Mesh::merged(front.cells().map(patch))
}

/// Thin lines along some edges of the patches, eight across.
fn edges(front: &FrontPatches) -> Mesh {
    const STEPS: u32 = 2;
    let apart = (front.columns() / 8).max(1);
    let lines = front.cells().flat_map(|[column, row]| {
        let upright = (column % apart == 0).then_some((DVec2::ZERO, DVec2::Y));
        let level = (row % apart == 0).then_some((DVec2::ZERO, DVec2::X));
        let edges = upright.into_iter().chain(level);
        edges.map(move |ends| ([column, row], ends))
    });
    Mesh::merged(lines.map(|(cell, (from, to))| {
        let place = |i: u32| front.point(cell, from.lerp(to, f64::from(i) / f64::from(STEPS)));
        let path: Vec<DVec3> = (0..=STEPS).filter_map(place).collect();
        Mesh::tube(&path, 0.004, false)
    }))
}
