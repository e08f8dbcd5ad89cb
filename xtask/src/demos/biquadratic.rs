//! Biquadratic Bézier patches recognised as pieces of cyclides.
//!
//! What one sees: four glazed patches, each with its dark control net, its two middle curves in red and blue, and the whole surface that was
//! recovered from the net as a shell of glass: a spindle torus (the printed example), a ring torus, a sphere and a general ring cyclide. The
//! figure shows how exactly the parameters come back as the surface nears the limit where its ellipse of centres becomes a parabola.

use std::f64::consts::TAU;

use anyhow::{Result, anyhow};
use bezier_mass::{Biquadratic, MassPoint};
use cyclide::{
    Condition, Conversion, Dupin, Error, Frame, Quartic, convert, convert_torus, inspect,
};
use glam::{DAffine3, DQuat, DVec3, dvec3};

use crate::color::{BLUE, Color, INK, VERMILION};
use crate::demo::{Context, Demo};
use crate::export::Step;
use crate::figure::{Figure, Marker, Plot};
use crate::mesh::Mesh;
use crate::random::Random;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct BiquadraticDemo {}

/// The printed spindle torus: `a`, `mu`, then the four bounds.
const PRINTED: [f64; 6] = [
    1.63,
    4.32,
    2.526_112_925,
    3.757_072_362,
    2.427_868_285,
    3.855_317_02,
];

impl Demo for BiquadraticDemo {
    const NAME: &'static str = "biquadratic";
    const PAPER: &'static str = "biquadratic-to-torus, Figs 1 to 11";
    const ABOUT: &'static str =
        "Rational biquadratic patches converted to tori, spheres and cyclides";

    fn run(&self, context: &mut Context) -> Result<()> {
        measure_printed(context)?;
        measure_round_trip(context)?;
        measure_refusals(context)?;
        draw_patches(context)?;
        draw_accuracy(context)
    }
}

/// The printed example has coordinates in the frame of its torus; they are rounded to ten digits, so its net is built from the printed
/// parameters and recovered from control points and weights alone.
fn printed_net() -> Result<Biquadratic<DVec3>> {
    let torus = Dupin::torus(PRINTED[0], PRINTED[1], Frame::WORLD)?;
    let patch = torus.patch([PRINTED[2], PRINTED[3]], [PRINTED[4], PRINTED[5]])?;
    // Rows are the parallel circles in the paper.
    Ok(patch.normalised_net()?.transposed())
}

fn measure_printed(context: &mut Context) -> Result<()> {
    let found = convert_torus(&printed_net()?, Some([DVec3::X, DVec3::Z]))?;
    let torus = found
        .surface
        .as_quartic()
        .ok_or_else(|| anyhow!("not a quartic"))?;
    let got = [
        torus.a(),
        torus.mu(),
        found.first[0],
        found.first[1],
        found.second[0],
        found.second[1],
    ];
    for ((key, value), printed) in ["a", "mu", "theta0", "theta1", "psi0", "psi1"]
        .into_iter()
        .zip(got)
        .zip(PRINTED)
    {
        context.number(key, value, Target::within(printed, 1e-9));
    }
    Ok(())
}

fn random_frame(random: &mut Random) -> Frame {
    loop {
        if let Some(frame) =
            Frame::from_directions(random.direction(), random.direction(), random.direction())
        {
            return frame;
        }
    }
}

/// A patch of a random quartic that keeps clear of singular points, with `c / a` as given.
fn random_patch(random: &mut Random, ratio: f64) -> Result<(Dupin, Biquadratic<DVec3>)> {
    loop {
        let a = random.between(0.5, 3.0);
        let (c, mu) = (a * ratio, random.between(0.05, 4.0));
        let surface = Dupin::quartic(a, c, mu, random_frame(random))?;
        let span = |random: &mut Random| {
            let from = random.between(0.0, TAU);
            [from, from + random.between(0.3, 2.5)]
        };
        let (first, second) = (span(random), span(random));
        let at = |[from, to]: [f64; 2], i: i32| from + (to - from) * f64::from(i) / 16.0;
        let one_sign = |radius: &dyn Fn(i32) -> f64| {
            (0..=16).all(|i| radius(i) > 0.05 * a) || (0..=16).all(|i| radius(i) < -0.05 * a)
        };
        if one_sign(&|i| mu - c * at(first, i).cos()) && one_sign(&|i| a - mu * at(second, i).cos())
        {
            return Ok((surface, *surface.patch(first, second)?.net()));
        }
    }
}

fn measure_round_trip(context: &mut Context) -> Result<()> {
    let mut random = Random::new(context.seed() ^ 0x5eed_5eed);
    let mut worst = 0.0_f64;
    for _ in 0..context.pick(10_000, 500) {
        let ratio = random.between(0.0, 0.998);
        let (_, net) = random_patch(&mut random, ratio)?;
        worst = worst.max(convert(&net)?.residual);
    }
    context.number("roundtrip_max_error", worst, Target::AtMost(1e-8));
    Ok(())
}

/// Nets with one broken condition each: all must be refused, and for that condition.
fn measure_refusals(context: &mut Context) -> Result<()> {
    let mut random = Random::new(context.seed() ^ 0xbad_bad);
    let (mut rejected, mut wrong_reason, mut broken) = (0_u32, 0_u32, 0_u32);
    for _ in 0..context.pick(300, 30) {
        let ratio = random.between(0.1, 0.9);
        let (_, net) = random_patch(&mut random, ratio)?;
        let net = cyclide::normalise(&net)?;
        if net
            .control()
            .as_flattened()
            .iter()
            .any(|control| control.weight.abs() < 0.2)
        {
            continue;
        }
        for condition in [
            Condition::ConcyclicCorners,
            Condition::EqualEdges,
            Condition::RightAngles,
            Condition::CornerPlanes,
            Condition::FourthCornerWeight,
            Condition::EdgeWeights,
            Condition::CentralWeight,
        ] {
            let spoilt = spoil(&net, condition, &mut random)?;
            broken += 1;
            match convert(&spoilt) {
                Err(Error::NotAPatch {
                    condition: named, ..
                }) => {
                    rejected += 1;
                    wrong_reason += u32::from(named != condition);
                }
                Err(_) => {
                    // Refused before the conditions were asked: they have to name it all the same.
                    rejected += 1;
                    let named = inspect(&spoilt).and_then(|report| report.check());
                    wrong_reason += u32::from(
                        !matches!(named, Err(Error::NotAPatch { condition: named, .. }) if named == condition),
                    );
                }
                Ok(_) => {}
            }
        }
    }
    context.number("not_convertible", broken, Target::AtLeast(100.0));
    context.number(
        "not_convertible_rejected",
        rejected,
        Target::exactly(broken),
    );
    context.number("wrong_reason", wrong_reason, Target::exactly(0));
    Ok(())
}

/// The net with one condition violated and those before it kept.
fn spoil(
    net: &Biquadratic<DVec3>,
    condition: Condition,
    random: &mut Random,
) -> Result<Biquadratic<DVec3>> {
    let mut points = net
        .control()
        .map(|row| row.map(|control| control.position().unwrap_or_default()));
    let mut weights = net.control().map(|row| row.map(|control| control.weight));
    let amount = random.between(0.01, 0.1);
    let [p00, p01, p02] = points[0];
    match condition {
        Condition::ConcyclicCorners => {
            points[2][2] += amount * p00.distance(points[2][2]) * random.direction()
        }
        Condition::EqualEdges => points[0][1] += amount * (p02 - p00),
        Condition::RightAngles => {
            // About the chord: the distances to both ends stay.
            let turn = DQuat::from_axis_angle((p02 - p00).normalize(), 2.0 * amount);
            points[0][1] = p00 + turn * (p01 - p00);
        }
        Condition::CornerPlanes => {
            let normal = (p01 - p00).cross(points[1][0] - p00).normalize();
            points[1][1] += amount * p00.distance(points[2][2]) * normal;
        }
        Condition::FourthCornerWeight => weights[2][2] *= 1.0 + amount,
        Condition::EdgeWeights => weights[0][1] *= 1.0 + amount,
        _ => weights[1][1] *= 1.0 + amount,
    }
    let control =
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| MassPoint::point(points[i][j], weights[i][j])));
    Ok(Biquadratic::new(control)?)
}

/// A net, the surface that was recovered from it, and how much of it is shown.
struct Exhibit {
    net: Biquadratic<DVec3>,
    found: Conversion,
    shown: [[f64; 2]; 2],
}

fn exhibits() -> Result<Vec<Exhibit>> {
    let whole = [0.0, TAU];
    let printed = printed_net()?;
    let torus = Dupin::torus(3.0, 1.1, Frame::WORLD)?
        .patch([-2.3, -0.9], [1.9, 3.9])?
        .normalised_net()?
        .transposed();
    let sphere: Dupin = Quartic::double_sphere(2.0, 0.35, Frame::WORLD)?.into();
    let sphere = sphere.patch([-2.4, -1.0], [-0.9, 0.5])?.normalised_net()?;
    let ring = Dupin::quartic(3.0, 1.1, 1.8, Frame::WORLD)?
        .patch([-2.2, -0.6], [2.0, 4.0])?
        .normalised_net()?;
    let general = convert(&ring)?;
    let on_sphere = convert(&sphere)?;
    Ok(vec![
        Exhibit {
            net: printed,
            found: convert_torus(&printed, Some([DVec3::X, DVec3::Z]))?,
            shown: [whole; 2],
        },
        Exhibit {
            net: torus,
            found: convert_torus(&torus, None)?,
            shown: [whole; 2],
        },
        Exhibit {
            net: sphere,
            found: on_sphere,
            shown: [whole; 2],
        },
        Exhibit {
            net: ring,
            found: general,
            shown: [whole; 2],
        },
    ])
}

fn draw_patches(context: &mut Context) -> Result<()> {
    let exhibits = exhibits()?;
    let steps = context.pick(240, 60);
    let mut scene = Scene::new();
    let mut step = Step::new("biquadratic");
    for (index, exhibit) in exhibits.iter().enumerate() {
        let surface = exhibit.found.surface;
        let at = |[from, to]: [f64; 2], t: f64| from + (to - from) * t;
        let shell = Mesh::grid(steps, steps, |u, v| {
            let (first, second) = (at(exhibit.shown[0], u), at(exhibit.shown[1], v));
            (surface.point(first, second), surface.normal(first, second))
        });
        let [low, high] = shell.bounds().ok_or_else(|| anyhow!("an empty surface"))?;
        let scale = 1.0 / (high - low).max_element();
        let middle = 0.5 * (low + high);
        // Two patches are on the far side of their surfaces.
        let spin = TAU * [0.3, 0.0, 0.5, 0.0][index];
        let turn = DQuat::from_rotation_x(0.35) * DQuat::from_rotation_z(spin);
        let place = dvec3(1.25 * (index % 2) as f64, 0.0, -1.02 * (index / 2) as f64);
        let map = DAffine3::from_scale_rotation_translation(
            DVec3::splat(scale),
            turn,
            place - scale * (turn * middle),
        );
        let thickness = 0.008 / scale;
        let point = |u: f64, v: f64| exhibit.net.point(u, v).unwrap_or_default();
        // A thin plate about the patch, so that it does not flicker with the surface that it is part of.
        let plate = Mesh::merged([0.5, -0.5].map(|side| {
            Mesh::grid(steps / 2, steps / 2, |u, v| {
                let jet = exhibit.net.jet(u, v);
                let along = |partial: MassPoint<DVec3>| {
                    (partial.weighted - partial.weight * point(u, v)) / jet.value.weight
                };
                let normal = along(jet.du).cross(along(jet.dv)).normalize_or(DVec3::Z);
                (point(u, v) + side * thickness * normal, normal)
            })
        }));
        let mut net = Mesh::default();
        let controls = exhibit
            .net
            .control()
            .map(|row| row.map(|control| control.position().unwrap_or_default()));
        for (i, row) in controls.iter().enumerate() {
            net.append(Mesh::tube(row, 0.6 * thickness, false));
            net.append(Mesh::tube(
                &[controls[0][i], controls[1][i], controls[2][i]],
                0.6 * thickness,
                false,
            ));
        }
        for control in controls.as_flattened() {
            net.append(Mesh::sphere(*control, 1.8 * thickness, 0.1 * thickness));
        }
        let [along_u, along_v] = exhibit.net.middle_curves();
        scene.add(
            shell.transformed(map),
            Material::glass(Color::hex(0x8fb6d8)),
        )?;
        scene.add(
            plate.transformed(map),
            Material::glossy(Color::hex(0xf0c46a)),
        )?;
        scene.add(net.transformed(map), Material::matte(INK))?;
        for (curve, color) in [(along_u, VERMILION), (along_v, BLUE)] {
            let points: Vec<DVec3> = (0..=80)
                .filter_map(|i| curve.point(f64::from(i) / 80.0).ok())
                .collect();
            scene.add(
                Mesh::tube(&points, thickness, false).transformed(map),
                Material::glossy(color),
            )?;
        }
        step.patch(&exhibit.net.into())?;
    }
    context.step("patches", &step)?;
    let towards_eye = dvec3(0.0, -1.0, 0.12);
    scene.wall_behind(towards_eye);
    let camera = scene.camera(towards_eye, context.aspect());
    context.render(
        "render",
        &scene,
        &camera,
        "Control nets (dark), patches, middle curves (red, blue), and the surfaces recovered from them: spindle torus, ring torus, sphere, ring cyclide.",
        "Four translucent blue surfaces, each with a yellow patch on it, a dark grid of control points around the patch and two coloured curves across it.",
    )
}

/// The worst error of `a`, `c`, `mu` (relative) against `1 - c/a`, where the ellipse of centres nears a parabola.
fn draw_accuracy(context: &mut Context) -> Result<()> {
    let mut random = Random::new(context.seed() ^ 0xacc);
    let trials = context.pick(60, 10);
    let (mut parameters, mut nets) = (Vec::new(), Vec::new());
    for step in 0..=20 {
        let gap = 10_f64.powf(-4.0 * f64::from(step) / 20.0);
        let (mut worst, mut worst_net) = (1e-17_f64, 1e-17_f64);
        for _ in 0..trials {
            let (surface, net) = random_patch(&mut random, 1.0 - gap)?;
            let Ok(found) = convert(&net) else { continue };
            let (Some(one), Some(other)) = (surface.as_quartic(), found.surface.as_quartic())
            else {
                continue;
            };
            let errors = [
                one.a() - other.a(),
                one.c() - other.c(),
                one.mu() - other.mu(),
            ];
            worst = errors
                .into_iter()
                .fold(worst, |worst, error| worst.max(error.abs() / one.a()));
            worst_net = worst_net.max(found.residual);
        }
        parameters.push(glam::dvec2(gap, worst));
        nets.push(glam::dvec2(gap, worst_net));
    }
    let mut plot = Plot::chart(
        "what comes back, and how exactly",
        "1 − c/a",
        "largest relative error",
    );
    plot.log_x().log_y();
    plot.polyline(&parameters, VERMILION.line().label("a, c, μ"));
    plot.points(&parameters, Marker::Dot, VERMILION.fill());
    plot.polyline(&nets, BLUE.line().label("rebuilt net"));
    plot.points(&nets, Marker::Dot, BLUE.fill());
    context.figure(
        "figure",
        &Figure::new(plot),
        "Towards the parabolic limit c = a the parameters run to infinity together and lose digits; the net that is rebuilt from them loses fewer.",
        "Two jagged curves over a logarithmic axis of 1 - c/a: both errors grow to the left, that of the parameters mostly a factor of ten above that of the net.",
    )
}
