//! All kinds of Dupin cyclides side by side, and Villarceau circles on one of them.
//!
//! What one sees: twelve surfaces in three rows before a light wall, coloured by their Gaussian curvature (blue where saddle shaped, red where
//! cap shaped), with thin dark lines of curvature, all of them circles, and their principal circles in green. Those that pass through
//! themselves are opened so that the inner sheet can be seen. In the second picture a ring cyclide of frosted glass carries the Villarceau circles
//! through one point and a pale ruled strip that touches it along one of them: its rulings do not meet in a point, it is no cone.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use anyhow::{Result, anyhow};
use cyclide::{Dupin, Frame, Kind, Quartic, convert};
use glam::{DAffine3, DQuat, DVec3, dvec3};

use crate::color::{BLUE, Color, ColorMap, GREEN, INK, VERMILION};
use crate::demo::{Context, Demo};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct CyclideZoo {}

/// A surface of the zoo with the rectangle of parameters that is shown.
struct Animal {
    surface: Dupin,
    first: [f64; 2],
    second: [f64; 2],
    kind: Kind,
}

impl Demo for CyclideZoo {
    const NAME: &'static str = "cyclide-zoo";
    const PAPER: &'static str =
        "blending-two-cones, Fig. 1 and Plate 1; biquadratic-to-torus, Figs 1 to 5";
    const ABOUT: &'static str =
        "Every kind of Dupin cyclide, with circles of curvature and Villarceau circles";

    fn run(&self, context: &mut Context) -> Result<()> {
        let zoo = zoo()?;
        measure(context, &zoo)?;
        draw_zoo(context, &zoo)?;
        draw_villarceau(context)
    }
}

fn zoo() -> Result<Vec<Animal>> {
    let whole = [0.0, TAU];
    // Opened towards the viewer, who looks along y.
    let opened = [-0.22 * PI, 1.22 * PI];
    let quartic = |a: f64, c: f64, mu: f64, first: [f64; 2]| -> Result<Animal> {
        let surface = Dupin::quartic(a, c, mu, Frame::WORLD)?;
        Ok(Animal {
            surface,
            first,
            second: whole,
            kind: surface.kind(),
        })
    };
    let parabolic = |k: f64| -> Result<Animal> {
        // x up: the two straight lines cross above each other.
        let frame = Frame::from_directions(DVec3::ZERO, DVec3::Z, DVec3::X)
            .ok_or_else(|| anyhow!("no frame"))?;
        let surface = Dupin::parabolic(1.0, k, frame)?;
        Ok(Animal {
            surface,
            first: [-1.5, 1.5],
            second: [-1.5, 1.5],
            kind: surface.kind(),
        })
    };
    let sphere: Dupin = Quartic::double_sphere(1.0, 0.5, Frame::WORLD)?.into();
    Ok(vec![
        quartic(3.0, 1.2, 1.9, whole)?,
        quartic(3.0, 1.2, 1.2, whole)?,
        quartic(3.0, 2.0, 0.9, whole)?,
        quartic(3.0, 1.2, 3.0, opened)?,
        quartic(3.0, 1.2, 4.2, opened)?,
        quartic(3.0, 0.0, 1.1, whole)?,
        quartic(2.0, 0.0, 2.0, opened)?,
        quartic(1.6, 0.0, 2.6, opened)?,
        Animal {
            surface: sphere,
            first: whole,
            second: [-0.5 * PI, 0.5 * PI],
            kind: sphere.kind(),
        },
        parabolic(0.1)?,
        parabolic(0.5)?,
        parabolic(1.1)?,
    ])
}

/// Kinds as recognised from a net of each surface, and residuals on samples.
fn measure(context: &mut Context, zoo: &[Animal]) -> Result<()> {
    let steps = context.pick(200, 40);
    let mut kinds = BTreeSet::new();
    let (mut implicit, mut circle_error) = (0.0_f64, 0.0_f64);
    for animal in zoo {
        // A patch knows nothing of the surface but its control points.
        let net = animal.surface.patch([0.2, 1.1], [0.7, 1.4])?;
        kinds.insert(convert(net.net())?.kind());
        let size = size(&animal.surface);
        let degree = if animal.surface.as_quartic().is_some() {
            4
        } else {
            3
        };
        let at =
            |[from, to]: [f64; 2], i: u32| from + (to - from) * f64::from(i) / f64::from(steps);
        for i in 0..=steps {
            let (first, second) = (at(animal.first, i), at(animal.second, i));
            let circles = [
                animal.surface.first_circle(first),
                animal.surface.second_circle(second),
            ];
            for j in 0..=steps {
                let points = [
                    animal.surface.point(first, at(animal.second, j)),
                    animal.surface.point(at(animal.first, j), second),
                ];
                for (point, circle) in points.into_iter().zip(circles) {
                    let offset = point - circle.centre;
                    let height = offset.dot(circle.axis);
                    let in_plane = (offset - height * circle.axis).length();
                    circle_error = circle_error.max(height.hypot(in_plane - circle.radius) / size);
                    implicit = implicit.max(
                        animal.surface.implicit(point).abs() / (size + point.length()).powi(degree),
                    );
                }
            }
        }
    }
    context.number("types", kinds.len(), Target::exactly(12));
    context.number("implicit_max_residual", implicit, Target::AtMost(1e-12));
    context.number(
        "curvature_circle_max_error",
        circle_error,
        Target::AtMost(1e-12),
    );
    let ring = plate_one()?;
    let mut villarceau = 0.0_f64;
    for i in 0..steps {
        for sign in [1.0, -1.0] {
            let circle = ring.villarceau_circle(TAU * f64::from(i) / f64::from(steps), sign)?;
            for j in 0..24 {
                let point = circle.point(
                    TAU * f64::from(j) / 24.0,
                    circle.axis().any_orthonormal_vector(),
                )?;
                villarceau = villarceau
                    .max(Dupin::from(ring).signed_distance(point)?.abs() / size(&ring.into()));
            }
        }
    }
    context.number("villarceau_max_residual", villarceau, Target::AtMost(1e-12));
    Ok(())
}

/// A length of the surface: the radius of a ball around it, or the focal parameter.
fn size(surface: &Dupin) -> f64 {
    match surface {
        Dupin::Quartic(quartic) => quartic.a() + quartic.c() + quartic.mu(),
        Dupin::Parabolic(parabolic) => parabolic.f() + parabolic.k().abs(),
    }
}

/// The rectangle of a surface with its Gaussian curvature, in units of its size.
fn painted(animal: &Animal, steps: usize) -> Mesh {
    let at = |[from, to]: [f64; 2], t: f64| from + (to - from) * t;
    let mesh = Mesh::grid(steps, steps, |u, v| {
        let (first, second) = (at(animal.first, u), at(animal.second, v));
        (
            animal.surface.point(first, second),
            animal.surface.normal(first, second),
        )
    });
    let size = size(&animal.surface);
    // The grid runs row by row, as Mesh::grid does.
    let curvature = (0..=steps)
        .flat_map(|j| (0..=steps).map(move |i| (i, j)))
        .map(|(i, j)| {
            let (u, v) = (i as f64 / steps as f64, j as f64 / steps as f64);
            let [one, other] = animal
                .surface
                .principal_curvatures(at(animal.first, u), at(animal.second, v));
            // Infinite at singular points.
            (one * other * size * size).clamp(-1e3, 1e3)
        })
        .collect();
    mesh.with_scalar(curvature)
}

/// Lines of curvature as thin tubes, and the principal circles as thicker ones.
fn circles(animal: &Animal, count: u32, thickness: f64) -> [Mesh; 2] {
    let span = |[from, to]: [f64; 2], i: f64| from + (to - from) * i;
    let line = |at: &dyn Fn(f64) -> DVec3, closed: bool, radius: f64| {
        let points: Vec<DVec3> = (0..=160).map(|i| at(f64::from(i) / 160.0)).collect();
        Mesh::tube(&points, radius, closed)
    };
    let is_full = |[from, to]: [f64; 2]| (to - from - TAU).abs() < 1e-9;
    let mut thin = Mesh::default();
    for i in 0..=count {
        let t = f64::from(i) / f64::from(count);
        let (first, second) = (span(animal.first, t), span(animal.second, t));
        if i < count || !is_full(animal.first) {
            thin.append(line(
                &|s| animal.surface.point(first, span(animal.second, s)),
                is_full(animal.second),
                thickness,
            ));
        }
        if i < count || !is_full(animal.second) {
            thin.append(line(
                &|s| animal.surface.point(span(animal.first, s), second),
                is_full(animal.first),
                thickness,
            ));
        }
    }
    let mut thick = Mesh::default();
    let inside = |[from, to]: [f64; 2], t: f64| from <= t && t <= to;
    let principal = if animal.surface.as_quartic().is_some() {
        vec![0.0, PI]
    } else {
        vec![0.0]
    };
    for t in principal {
        if inside(animal.second, t) {
            thick.append(line(
                &|s| animal.surface.point(span(animal.first, s), t),
                is_full(animal.first),
                2.2 * thickness,
            ));
        }
        if inside(animal.first, t) {
            thick.append(line(
                &|s| animal.surface.point(t, span(animal.second, s)),
                is_full(animal.second),
                2.2 * thickness,
            ));
        }
    }
    [thin, thick]
}

fn draw_zoo(context: &mut Context, zoo: &[Animal]) -> Result<()> {
    let steps = context.pick(200, 80);
    let mut scene = Scene::new();
    for (index, animal) in zoo.iter().enumerate() {
        let mesh = painted(animal, steps);
        let [low, high] = mesh.bounds().ok_or_else(|| anyhow!("an empty surface"))?;
        let scale = 1.0 / (high - low).x.max((high - low).y).max(0.9 * (high - low).z);
        let (column, row) = ((index % 4) as f64, 2.0 - (index / 4) as f64);
        // Rings lie tilted towards the viewer, so that their holes are seen.
        let tilt = DQuat::from_rotation_x(if animal.surface.as_quartic().is_some() {
            0.55
        } else {
            0.25
        });
        let middle = 0.5 * (low + high);
        let map = DAffine3::from_scale_rotation_translation(
            DVec3::splat(scale),
            tilt,
            dvec3(1.16 * column, 0.0, 1.06 * row) - scale * (tilt * middle),
        );
        let [thin, thick] = circles(animal, 12, 0.0035 / scale);
        scene.add(
            mesh.transformed(map),
            Material::scalar(ColorMap::Diverging, -12.0, 12.0),
        )?;
        scene.add(thin.transformed(map), Material::matte(INK))?;
        scene.add(thick.transformed(map), Material::matte(GREEN))?;
    }
    let towards_eye = dvec3(0.0, -1.0, 0.02);
    scene.layer("curvature.K").wall_behind(towards_eye);
    let camera = scene.camera(towards_eye, context.aspect());
    let names: Vec<&str> = zoo.iter().map(|animal| animal.kind.name()).collect();
    context.render(
        "render",
        &scene,
        &camera,
        &format!("The kinds of Dupin cyclides: {}. Colour: Gaussian curvature; dark: lines of curvature; green: principal circles.", names.join(", ")),
        "Twelve surfaces in three rows: rings, horned and spindle cyclides, tori, a sphere and three saddle-like cubic surfaces, covered with circles.",
    )
}

fn plate_one() -> Result<Quartic> {
    Ok(Quartic::new(3.0, 0.9, 1.7, Frame::WORLD)?)
}

/// A ring with the Villarceau circles through one point, and the surface of tangents conjugate to one of them.
fn draw_villarceau(context: &mut Context) -> Result<()> {
    let ring = plate_one()?;
    let surface = Dupin::from(ring);
    let steps = context.pick(420, 100);
    let mut scene = Scene::new();
    let body = Mesh::grid(steps, steps, |u, v| {
        (
            surface.point(TAU * u, TAU * v),
            surface.normal(TAU * u, TAU * v),
        )
    });
    scene.add(body, Material::matte(Color::hex(0xe9e4da)))?;
    let point = ring.point(-1.3, 2.3);
    let through = ring.villarceau_circles_at(point)?;
    let samples = 360_u32;
    let on = |circle: &lorentz::Circle| -> Result<Vec<DVec3>> {
        let start = circle.axis().any_orthonormal_vector();
        (0..samples)
            .map(|i| Ok(circle.point(TAU * f64::from(i) / f64::from(samples), start)?))
            .collect()
    };
    for (circle, color) in through.iter().zip([BLUE, VERMILION]) {
        scene.add(
            Mesh::tube(&on(circle)?, 0.035, true),
            Material::glossy(color),
        )?;
    }
    let lines = [ring.theta_circle(-1.3), ring.psi_circle(2.3)];
    for circle in lines {
        let points: Vec<DVec3> = (0..samples)
            .map(|i| circle.point(TAU * f64::from(i) / f64::from(samples)))
            .collect();
        scene.add(Mesh::tube(&points, 0.02, true), Material::matte(INK))?;
    }
    // Along the first circle: the ruling is the direction conjugate to the circle's tangent, II(tangent, ruling) = 0.
    let path = on(&through[0])?;
    let rulings: Vec<(DVec3, DVec3, DVec3)> = path
        .iter()
        .map(|&point| {
            let [theta, psi] = ring.parameters_at(point);
            let [along_theta, along_psi] = ring.principal_directions(theta, psi);
            let [kappa, other] = ring.principal_curvatures(theta, psi);
            let tangent = through[0].axis().cross(point - through[0].centre());
            let ruling = along_psi * (kappa * tangent.dot(along_theta))
                - along_theta * (other * tangent.dot(along_psi));
            (point, ruling.normalize_or_zero(), ring.normal(theta, psi))
        })
        .collect();
    // Where the circle's tangent is nearly asymptotic the ruling runs along the circle; the strip shows the longest part without.
    let is_steep = |&(point, ruling, _): &(DVec3, DVec3, DVec3)| {
        let tangent = through[0]
            .axis()
            .cross(point - through[0].centre())
            .normalize_or_zero();
        tangent.cross(ruling).length() > 0.55
    };
    let start = rulings
        .iter()
        .position(|ruling| !is_steep(ruling))
        .unwrap_or(0);
    let turned: Vec<_> = rulings
        .iter()
        .cycle()
        .skip(start)
        .take(rulings.len())
        .copied()
        .collect();
    let longest = turned
        .chunk_by(|one, other| is_steep(one) == is_steep(other))
        .filter(|run| run.first().is_some_and(is_steep))
        .max_by_key(|run| run.len())
        .unwrap_or_default();
    let mut previous = DVec3::ZERO;
    let mut positions = Vec::new();
    let mut normals = Vec::new();
    let width = 14;
    for &(point, ruling, normal) in longest {
        let ruling = if ruling.dot(previous) < 0.0 {
            -ruling
        } else {
            ruling
        };
        previous = ruling;
        for k in 0..=width {
            positions.push(
                point
                    + ruling * 1.1 * (2.0 * f64::from(k) / f64::from(width) - 1.0)
                    + 0.004 * normal,
            );
            normals.push(normal);
        }
    }
    scene.add(
        Mesh::from_rows(width as usize + 1, positions, normals),
        Material::glossy(Color::hex(0x9cc9c0)),
    )?;
    scene.ground_below();
    let camera = scene.camera(dvec3(0.25, -1.0, 0.75), context.aspect());
    context.render(
        "render-villarceau",
        &scene,
        &camera,
        "Four circles through a point of a ring cyclide: two lines of curvature (dark) and two Villarceau circles. The strip touches along one of them and is no cone.",
        "A pale ring with a blue and a red slanted circle crossing two dark circles; a green ruled band follows the blue circle and twists around the ring.",
    )
}
