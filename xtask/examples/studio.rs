//! One picture of every material: what the renderer's defaults look like.
//!
//! `cargo run --release -p xtask --example studio -- DIR`
use glam::DVec2;
use glam::DVec3;
use std::f64::consts::TAU;
use xtask::color::*;
use xtask::figure::*;
use xtask::mesh::Mesh;
use xtask::render::*;

fn torus(c: DVec3, r: f64, s: f64, tol: f64) -> Mesh {
    Mesh::surface(
        |u, v| {
            let ((su, cu), (sv, cv)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
            let n = DVec3::new(cu * cv, su * cv, sv);
            (c + DVec3::new(r * cu, r * su, 0.0) + s * n, n)
        },
        |_| tol,
    )
}

fn main() -> anyhow::Result<()> {
    let dir = std::env::args().nth(1).unwrap_or_else(|| "/tmp".into());
    let mut scene = Scene::new();
    let at = |i: f64, j: f64| DVec3::new(2.6 * i, 2.6 * j, 0.0);
    scene.add(torus(at(0.0, 0.0), 0.8, 0.35, 1e-3), Material::glossy(BLUE))?;
    scene.add(
        torus(at(1.0, 0.0), 0.8, 0.35, 1e-3),
        Material::matte(ORANGE),
    )?;
    scene.add(torus(at(2.0, 0.0), 0.8, 0.35, 1e-3), Material::zebra())?;
    scene.add(
        torus(at(0.0, 1.0), 0.8, 0.35, 1e-3).with_scalar_at(|p| p.x),
        Material::scalar(ColorMap::Sequential, -1.2, 1.2).isolines(0.2),
    )?;
    scene.add(torus(at(1.0, 1.0), 0.8, 0.35, 1e-3), Material::glass(SKY))?;
    scene.add(
        torus(at(2.0, 1.0), 0.8, 0.35, 1e-3)
            .with_scalar_at(|p| (p - at(2.0, 1.0)).truncate().length() - 0.8),
        Material::scalar(ColorMap::Diverging, -0.35, 0.35),
    )?;
    let knot: Vec<DVec3> = (0..400)
        .map(|i| {
            let t = TAU * f64::from(i) / 400.0;
            at(1.0, 1.0)
                + DVec3::new(
                    (2.0 * t).cos() * (0.8 + 0.2 * (3.0 * t).cos()),
                    (2.0 * t).sin() * (0.8 + 0.2 * (3.0 * t).cos()),
                    0.2 * (3.0 * t).sin(),
                )
        })
        .collect();
    scene.add(Mesh::tube(&knot, 0.03, true), Material::glossy(VERMILION))?;
    scene.add(
        Mesh::sphere(at(0.5, 0.5) + DVec3::Z * 0.1, 0.45, 1e-3),
        Material::glossy(WHITE),
    )?;
    scene.add(
        Mesh::sphere(at(1.5, 0.5) + DVec3::Z * 0.1, 0.45, 1e-3),
        Material::glossy(INK),
    )?;
    scene.ground_below();
    let camera = scene.camera(DVec3::new(-0.4, -1.6, 1.1), 4.0 / 3.0);
    let samples = std::env::args()
        .nth(2)
        .and_then(|s| s.parse().ok())
        .unwrap_or(32);
    let start = std::time::Instant::now();
    let picture = render(
        &scene,
        &camera,
        Options {
            width: 1280,
            height: 960,
            samples,
            seed: 1,
        },
        |_| (),
    );
    println!(
        "{} triangles, {:.2} s",
        scene.triangle_count(),
        start.elapsed().as_secs_f64()
    );
    picture
        .image()
        .write_png(std::fs::File::create(format!("{dir}/studio.png"))?)?;

    let mut drawing = Plot::geometry("Semicircle with a vector control point");
    let c = [DVec2::new(1.0, 0.0), DVec2::new(-1.0, 0.0)];
    drawing.polygon(
        &[
            DVec2::new(1.0, 0.0),
            DVec2::new(0.0, 1.0),
            DVec2::new(-1.0, 0.0),
        ],
        SKY.alpha(0.25).fill().label("region"),
    );
    drawing.circle(DVec2::ZERO, 1.0, GREY.line().dashed().label("whole circle"));
    drawing.arc(
        DVec2::ZERO,
        1.0,
        0.0,
        TAU / 2.0,
        BLUE.line().width(2.6).label("semicircle"),
    );
    drawing.arrow(
        DVec2::ZERO,
        DVec2::Y,
        VERMILION.line().width(2.0).label("vector (v₁; 0)"),
    );
    drawing.point(c[0], "P₀", Side::BelowRight, INK.fill());
    drawing.point(c[1], "P₂", Side::BelowLeft, INK.fill());
    drawing.points(&[DVec2::ZERO], Marker::Cross, INK.line());
    let mut chart = Plot::chart("Convergence", "steps", "largest error");
    chart.log_x().log_y();
    for (k, color) in [BLUE, VERMILION, GREEN].into_iter().enumerate() {
        let e: Vec<DVec2> = (2..9)
            .map(|i| DVec2::new(f64::from(1 << i), 0.5_f64.powi(i * (k as i32 + 2))))
            .collect();
        chart.polyline(&e, color.line().label(format!("order {}", k + 2)));
        chart.points(&e, Marker::Disc, color.fill());
    }
    let mut wave = Plot::chart("A wave and its zeros", "t", "f(t)");
    wave.graph(
        |t| (5.0 * t).sin() * (-0.3 * t).exp(),
        0.0,
        6.0,
        BLUE.line().width(2.2).label("f"),
    );
    let zeros: Vec<DVec2> = (0..10)
        .map(|k| DVec2::new(TAU / 10.0 * f64::from(k), 0.0))
        .collect();
    wave.points(&zeros, Marker::Ring, VERMILION.line().label("zeros"));
    let mut view = Plot::geometry("Asymptotes in a fixed view");
    view.axes("x", "y")
        .view(DVec2::splat(-3.0), DVec2::splat(3.0));
    view.trace(
        |t| DVec2::new(t, 1.0 / t),
        -4.0,
        4.0,
        BLUE.line().label("y = 1/x"),
    );
    view.segment(
        DVec2::new(-10.0, 0.0),
        DVec2::new(10.0, 0.0),
        GREY.line().dashed().label("asymptotes"),
    );
    view.segment(
        DVec2::new(0.0, -10.0),
        DVec2::new(0.0, 10.0),
        GREY.line().dashed(),
    );
    let figure = Figure::grid(2, vec![drawing, chart, wave, view])
        .title("What figures look like")
        .aspect(1.15);
    figure
        .image(1280)
        .write_png(std::fs::File::create(format!("{dir}/figure.png"))?)?;
    std::fs::write(format!("{dir}/figure.svg"), figure.svg("parts of figures"))?;
    Ok(())
}
