//! Pencils of spheres, the light cone with the paraboloid of points, and patches with two, one and no singular ends.
//!
//! What one sees: in the first figure three nets of circles that cross at right angles, sections of pencils of spheres
//! (blue) and of spheres orthogonal to all of them (grey): spheres through a common circle, cut in two points; spheres
//! that touch in one point; spheres that close in on two limit points. The second figure is the same three pencils on
//! the space of spheres, drawn in their own planes: a circle, a pair of parallel lines, a hyperbola. Beside the
//! hyperbola its dual, on which the tangent vectors lie, is dashed; both share the asymptotes, which are the two limit
//! points. The first rendering is the light cone of a lower-dimensional model, a pale glass cone that stands on its tip;
//! an orange parabola runs on it, the points of space, and every thin ray from the tip pierces it once, but for the red
//! one, infinity, to which the parabola's axis is parallel. The second rendering shows three pieces of Dupin cyclides in
//! a row: a yellow crescent with two sharp tips, a green horn with one tip and one round cut, and a blue elbow cut round
//! at both ends.

use std::f64::consts::{PI, TAU};

use anyhow::Result;
use glam::{DAffine3, DVec2, DVec3, dvec2, dvec3};
use lorentz::construct::{between_points, circle_to_point, circle_to_sphere};
use lorentz::{CanalCurve, Circle, Object, Pencil, Plane, Point, Sphere, SphereVector};

use crate::color::{BLUE, Color, GREEN, GREY, INK, ORANGE, VERMILION, YELLOW};
use crate::demo::{Context, Demo};
use crate::figure::{Figure, Marker, Plot, Style};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Pencils {}

impl Demo for Pencils {
    const NAME: &'static str = "pencils";
    const PAPER: &'static str = "mass-points-and-spheres, Figs 3, 4, A.11 to A.13";
    const ABOUT: &'static str =
        "The three pencils of spheres, the light cone, and patches with two, one, no singular ends";

    fn run(&self, context: &mut Context) -> Result<()> {
        let nets = [Net::through_circle()?, Net::tangent()?, Net::poncelet()?];
        let patches = patches()?;
        let singular_ends = patches.map(|patch| {
            [0.0, 1.0]
                .into_iter()
                .filter(|&t| patch.at(t).vertex().is_some())
                .count()
        });
        let error = nets
            .iter()
            .map(Net::orthogonality_error)
            .chain(patches.iter().map(derivative_error))
            .fold(0.0, f64::max);
        context.number("orthogonality_max_error", error, Target::AtMost(1e-9));
        context.number(
            "dual_circle_max_residual",
            dual_circle_residual(&nets[2].pencil),
            Target::AtMost(1e-9),
        );
        context.number(
            "singular_ends",
            singular_ends.to_vec(),
            Target::exactly(vec![2, 1, 0]),
        );
        draw_nets(context, &nets)?;
        draw_planes(context, &nets)?;
        draw_light_cone(context)?;
        draw_patches(context, &patches)
    }
}

/// A pencil and the pencil in its orthogonal complement that has the same symmetries.
struct Net {
    title: &'static str,
    pencil: Pencil,
    orthogonal: Pencil,
}

impl Net {
    /// Spheres through the unit circle of the plane z = 0.
    fn through_circle() -> Result<Self> {
        let pencil = Pencil::through(Circle::new(DVec3::ZERO, 1.0, DVec3::Z)?)?;
        Ok(Self {
            title: "through a circle",
            pencil,
            orthogonal: around_points(DVec3::X)?,
        })
    }

    /// Spheres that touch the plane z = 0 in the origin.
    fn tangent() -> Result<Self> {
        let touching = |normal: DVec3| -> Result<Pencil> {
            let plane = Plane::new(normal, DVec3::ZERO)?;
            Ok(Pencil::new(
                plane.into(),
                Sphere::new(normal, -1.0)?.into(),
            )?)
        };
        Ok(Self {
            title: "touching in a point",
            pencil: touching(DVec3::Z)?,
            orthogonal: touching(DVec3::X)?,
        })
    }

    /// Spheres around the points (0, 0, 1) and (0, 0, -1).
    fn poncelet() -> Result<Self> {
        let orthogonal = Pencil::through(Circle::new(DVec3::ZERO, 1.0, DVec3::X)?)?;
        Ok(Self {
            title: "around two points",
            pencil: around_points(DVec3::Z)?,
            orthogonal,
        })
    }

    /// Members at regular parameters, both lines or branches of the pencil where it has two.
    fn members(pencil: &Pencil) -> Vec<SphereVector> {
        match pencil.kind() {
            lorentz::PencilKind::BaseCircle(_) => (0..12)
                .map(|i| pencil.member(PI * f64::from(i) / 12.0))
                .collect(),
            lorentz::PencilKind::Tangent { .. } => (-8..=8)
                .map(|i| pencil.member(0.4 * f64::from(i)))
                .collect(),
            lorentz::PencilKind::Poncelet { .. } => (-7..=7)
                .flat_map(|i| [pencil.member(0.35 * f64::from(i))])
                .collect(),
        }
    }

    /// Largest product of a member with its derivative sphere, and of members of the two pencils.
    fn orthogonality_error(&self) -> f64 {
        let (members, others) = (Self::members(&self.pencil), Self::members(&self.orthogonal));
        let across = members
            .iter()
            .flat_map(|a| others.iter().map(|b| a.product(*b).abs()));
        let along = (0..60).map(|i| {
            let parameter = 0.05 * f64::from(i - 30);
            self.pencil
                .member(parameter)
                .vector()
                .product(self.pencil.derivative(parameter))
                .abs()
        });
        across.chain(along).fold(0.0, f64::max)
    }
}

/// The Poncelet pencil with the limit points `p` and `-p`, on the unit sphere.
fn around_points(p: DVec3) -> Result<Pencil> {
    // The plane between the points, and a sphere around one of them.
    let plane = Plane::new(p, DVec3::ZERO)?;
    Ok(Pencil::new(
        plane.into(),
        Sphere::new(1.25 * p, 0.75)?.into(),
    )?)
}

/// The tangent vectors of a Poncelet pencil form a circle of squared radius -1.
fn dual_circle_residual(pencil: &Pencil) -> f64 {
    (-40..=40)
        .map(|i| (pencil.derivative(0.05 * f64::from(i)).square() + 1.0).abs())
        .fold(0.0, f64::max)
}

/// Largest product of a sphere and its derivative sphere along a patch.
fn derivative_error(patch: &CanalCurve) -> f64 {
    (1..100)
        .filter_map(|i| {
            let member = patch.at(f64::from(i) / 100.0);
            Some(member.sphere()?.product(member.derivative_sphere()?).abs())
        })
        .fold(0.0, f64::max)
}

/// Appendix A.3: a patch between two points, from a circle to a point, from a circle to a sphere.
fn patches() -> Result<[CanalCurve; 3]> {
    let (left, right) = (dvec3(-1.6, 0.0, 0.0), dvec3(1.6, 0.0, 0.0));
    let middle = Sphere::new(dvec3(0.0, 0.0, 1.5), 0.55)?;
    let crescent = between_points(Point::new(left)?, Point::new(right)?, middle.into())?.curve;
    let start = Sphere::new(left, 0.55)?;
    let upward = Plane::new(dvec3(0.25, 0.0, 1.0), left)?;
    let horn = circle_to_point(start.into(), upward.into(), Point::new(right)?)?.curve;
    let elbow =
        circle_to_sphere(start.into(), upward.into(), Sphere::new(right, 0.8)?.into())?.curve;
    Ok([crescent, horn, elbow])
}

fn draw_nets(context: &mut Context, nets: &[Net; 3]) -> Result<()> {
    let plots = nets.iter().map(|net| -> Result<Plot> {
        let mut plot = Plot::geometry(net.title);
        plot.view(dvec2(-2.6, -2.6), dvec2(2.6, 2.6));
        for (pencil, style) in [
            (
                &net.orthogonal,
                GREY.line().width(0.7).label("orthogonal to them"),
            ),
            (&net.pencil, BLUE.line().width(1.5).label("members")),
        ] {
            for member in Net::members(pencil) {
                draw_section(&mut plot, member.object()?, style.clone());
            }
        }
        let marked: &[DVec2] = match net.pencil.kind() {
            lorentz::PencilKind::BaseCircle(_) => &[dvec2(-1.0, 0.0), dvec2(1.0, 0.0)],
            lorentz::PencilKind::Tangent { .. } => &[DVec2::ZERO],
            lorentz::PencilKind::Poncelet { .. } => &[dvec2(0.0, -1.0), dvec2(0.0, 1.0)],
        };
        plot.points(marked, Marker::Disc, VERMILION.fill());
        Ok(plot)
    });
    context.figure(
        "figure",
        &Figure::grid(3, plots.collect::<Result<_>>()?).aspect(0.85),
        "The three pencils of spheres (blue, in section) with spheres orthogonal to all of them (grey).",
        "Three nets of blue and grey circles that cross at right angles, with their common or limit points in red.",
    )
}

/// The section of a sphere or plane with the plane y = 0.
fn draw_section(plot: &mut Plot, object: Object, style: Style) {
    match object {
        Object::Sphere(sphere) => {
            plot.circle(
                dvec2(sphere.centre().x, sphere.centre().z),
                sphere.radius().abs(),
                style,
            );
        }
        Object::Plane(plane) => {
            let normal = dvec2(plane.normal().x, plane.normal().z);
            let foot = plane.offset() * normal;
            plot.segment(
                foot - 9.0 * normal.perp(),
                foot + 9.0 * normal.perp(),
                style,
            );
        }
        Object::Point { .. } | Object::Infinity { .. } => {}
    }
}

/// The planes of the pencils in L(4,1): axes along the first member and what the second adds to it.
fn draw_planes(context: &mut Context, nets: &[Net; 3]) -> Result<()> {
    let style = || BLUE.line().width(2.0);
    let mut circle = Plot::geometry("a circle");
    circle.circle(DVec2::ZERO, 1.0, style().label("members"));
    circle.arrow(DVec2::ZERO, dvec2(0.8, 0.6), INK.line().label("a member"));
    circle.arrow(
        dvec2(0.8, 0.6),
        dvec2(0.8, 0.6) + 0.8 * dvec2(-0.6, 0.8),
        VERMILION.line().width(1.4).label("derivative sphere"),
    );
    let mut lines = Plot::geometry("two parallel lines");
    for side in [1.0, -1.0] {
        lines.segment(
            dvec2(side, -2.0),
            dvec2(side, 2.0),
            style().label("members"),
        );
    }
    lines.arrow(
        DVec2::ZERO,
        dvec2(1.0, 0.0),
        INK.line().label("first member"),
    );
    lines.arrow(
        dvec2(1.0, 0.0),
        dvec2(1.0, 1.2),
        VERMILION
            .line()
            .width(1.4)
            .label("point of contact (light-like)"),
    );
    lines.view(dvec2(-2.2, -2.2), dvec2(2.2, 2.2));
    let mut hyperbola = Plot::geometry("a hyperbola and its dual");
    hyperbola.view(dvec2(-2.6, -2.6), dvec2(2.6, 2.6));
    for side in [1.0, -1.0] {
        let label = |style: Style, text: &str| if side > 0.0 { style.label(text) } else { style };
        hyperbola.segment(
            dvec2(-3.0, -3.0 * side),
            dvec2(3.0, 3.0 * side),
            label(GREY.line().width(0.8), "limit points (light-like)"),
        );
        let member =
            |s: f64| side * coordinates(&nets[2].pencil, nets[2].pencil.member(s).vector());
        let tangent = |s: f64| side * coordinates(&nets[2].pencil, nets[2].pencil.derivative(s));
        hyperbola.trace(member, -1.8, 1.8, label(style(), "members, square 1"));
        hyperbola.trace(
            tangent,
            -1.8,
            1.8,
            label(VERMILION.line().width(1.4).dashed(), "tangents, square −1"),
        );
    }
    context.figure(
        "figure-planes",
        &Figure::grid(3, vec![circle, lines, hyperbola]).aspect(0.8),
        "The pencils on the space of spheres: a unit circle, two lines, a hyperbola with its dual circle of square −1.",
        "A circle with a radius and a tangent arrow; two parallel lines; two hyperbolas with common asymptotes.",
    )
}

/// Coordinates in a Poncelet pencil along the first generator and along the tangent there.
fn coordinates(pencil: &Pencil, vector: lorentz::LorentzVector) -> DVec2 {
    let (first, tangent) = (pencil.generators().0.vector(), pencil.derivative(0.0));
    dvec2(vector.product(first), -vector.product(tangent))
}

/// L(2,1), the model of the points of a line: `x-` upward, `x1` across, `x+` in depth.
fn draw_light_cone(context: &mut Context) -> Result<()> {
    let place = |v: lorentz::LorentzVector| {
        let [minus, x, _, _, plus] = v.to_diagonal();
        dvec3(x, plus, minus)
    };
    let point = |x: f64| Point::new(dvec3(x, 0.0, 0.0)).map(|p| place(p.vector()));
    let height = 3.4;
    let scene = |tolerance: f64| -> Result<Scene> {
        let mut scene = Scene::new();
        let cone = Mesh::surface(
            |u, v| {
                let (sin, cos) = (TAU * u).sin_cos();
                (
                    v * height * dvec3(cos, sin, 1.0),
                    dvec3(cos, sin, -1.0).normalize(),
                )
            },
            |_| tolerance,
        );
        scene.add(cone, Material::glass(Color::hex(0xaebfcd)))?;
        let parabola = (-60..=60)
            .map(|i| point(f64::from(i) * 0.0505))
            .collect::<Result<Vec<_>, _>>()?;
        scene.add(
            Mesh::tube(&parabola, 0.055, false),
            Material::glossy(ORANGE),
        )?;
        for i in -5..=5 {
            let p = point(0.55 * f64::from(i))?;
            scene.add(
                Mesh::tube(&[DVec3::ZERO, p * (height / p.z)], 0.014, false),
                Material::matte(INK),
            )?;
            scene.add(Mesh::sphere(p, 0.085, tolerance), Material::glossy(BLUE))?;
        }
        let infinity = place(lorentz::LorentzVector::INFINITY);
        scene.add(
            Mesh::tube(
                &[DVec3::ZERO, infinity * (height / infinity.z)],
                0.035,
                false,
            ),
            Material::glossy(VERMILION),
        )?;
        scene.ground_below();
        Ok(scene)
    };
    let camera = scene(0.02)?.camera(dvec3(-0.9, -1.2, 0.75), context.aspect());
    let tolerance = camera.tolerance(DVec3::ZERO, context.height());
    context.render(
        "render",
        &scene(tolerance)?,
        &camera,
        "The light cone with the paraboloid of points (orange) and infinity (red), for the points of a line (Fig. 3).",
        "A glass cone on its tip with an orange parabola on it, dark rays through blue points, and one red ray.",
    )
}

fn draw_patches(context: &mut Context, patches: &[CanalCurve; 3]) -> Result<()> {
    let scene = |tolerance: f64| -> Result<Scene> {
        let mut scene = Scene::new();
        for (i, (patch, color)) in patches
            .iter()
            .zip([YELLOW.mix(ORANGE, 0.5), GREEN, BLUE])
            .enumerate()
        {
            let mesh = Mesh::canal(patch, [0.0, 1.0], tolerance)?;
            // Side by side, all on the ground.
            let bottom = mesh.bounds().map_or(0.0, |[low, _]| low.z);
            let shift = dvec3(4.1 * i as f64, 0.0, -bottom);
            scene.add(
                mesh.transformed(DAffine3::from_translation(shift)),
                Material::glossy(color),
            )?;
        }
        scene.ground_below();
        Ok(scene)
    };
    let camera = scene(0.02)?.camera(dvec3(-0.12, -1.0, 0.22), context.aspect_or(2.2));
    let tolerance = 0.25 * camera.tolerance(dvec3(4.1, 0.0, 0.0), context.height());
    context.render(
        "render-patches",
        &scene(tolerance)?,
        &camera,
        "Pieces of Dupin cyclides with two, one and no singular ends (Figs A.11 to A.13).",
        "A yellow crescent with two tips, a green horn with one tip and a cut end, a blue elbow with two cut ends.",
    )
}
