//! Ovals and rosettes of constant width, and a cam made for a given motion.
//!
//! One sees a rounded triangle with its offsets around the three Tschirnhausen cubics that are its evolute; a rosette of
//! index three around a pentagon; an oval through given curvature elements beside the circle of its width; an oval of class
//! 6 whose Bézier lines were moved; and, animated, a cam that turns between the two sides of its frame, which stay in
//! touch with it while the frame's height follows the wanted curve.

use std::f64::consts::{PI, TAU};

use anyhow::Result;
use glam::DVec2;
use ph_curves::{
    Antisymmetric, Cam, Contact, EvolutePolygon, HarmonicLift, PhArc, Rosette, SupportJet, TCubic,
    antipodal_arc, hermite_arc, interpolate_constant_width,
};

use crate::color::{BLUE, GREEN, GREY, INK, MIST, ORANGE, VERMILION};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::figure::{Figure, Marker, Plot};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Ovals {
    /// Arcs of the cam's profile on each half turn
    #[arg(long, default_value_t = 12)]
    arcs: usize,
}

impl Demo for Ovals {
    const NAME: &'static str = "ovals";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 1.11, 1.13, 1.15, 1.16";
    const ABOUT: &'static str =
        "Ovals and rosettes of constant width, and a cam for a given motion";

    fn run(&self, context: &mut Context) -> Result<()> {
        let triangle = polygon(&[(0.0, 0.0), (4.0, 0.0), (1.5, 3.0)])?;
        let pentagon = polygon(&PENTAGON)?;
        let oval = triangle.rosette(1.25 * triangle.minimum_width())?;
        let rosette = pentagon.rosette(1.4 * pentagon.minimum_width())?;
        let interpolating = interpolate_constant_width(WIDTH, &ELEMENTS)?;
        let moved = moved_lines()?;

        let plots = vec![
            evolute_plot(
                "an oval around a triangle, and its offsets",
                &triangle,
                &oval,
                &[0.0, 2.0, 4.0],
            ),
            evolute_plot(
                "a rosette of index 3 around a pentagon",
                &pentagon,
                &rosette,
                &[0.0],
            ),
            interpolation_plot(&interpolating)?,
            lines_plot(&moved),
        ];
        context.figure(
            "figure",
            &Figure::grid(2, plots).aspect(1.15),
            "Involutes of chains of Tschirnhausen cubics, an oval through six curvature elements beside the circle of its \
             width, and an oval whose Bézier lines were moved off that circle's.",
            "Four plots: a rounded triangle with two parallel curves and three cusped cubics inside; a five-lobed closed \
             curve winding three times; an oval close to a dashed circle through marked points; an oval with its tangent lines.",
        )?;

        let cam = self.cam()?;
        context.figure(
            "figure-lift",
            &lift_figure(&cam),
            "The lift asked for and what the cam's support gives: one line, the error is in the report.",
            "A periodic curve of three waves over one turn.",
        )?;
        let frames = context.pick(60, 6);
        let width = context.pick(640, 160);
        let images: Vec<_> = (0..frames)
            .map(|i| frame(&cam, TAU * f64::from(i) / f64::from(frames)).image(width))
            .collect();
        context.animation(
            "figure-cam",
            &images,
            25,
            "The cam turns uniformly between two parallel sides; the frame moves as asked and never loses touch.",
            "An animated oval turning inside a rectangular frame that moves up and down.",
        )?;
        report(context, &oval, &rosette, &interpolating, &cam);
        Ok(())
    }
}

const PENTAGON: [(f64, f64); 5] = [
    (1.0, 0.0),
    (0.31, 0.96),
    (-0.79, 0.57),
    (-0.84, -0.61),
    (0.29, -0.90),
];

/// The width of the interpolating oval, and its elements over half a turn.
const WIDTH: f64 = 10.0;
const ELEMENTS: [(f64, SupportJet); 3] = [
    (
        0.3,
        SupportJet {
            support: 5.35,
            slope: 0.25,
            bend: -2.6,
        },
    ),
    (
        1.2,
        SupportJet {
            support: 4.80,
            slope: -0.20,
            bend: 2.2,
        },
    ),
    (
        2.4,
        SupportJet {
            support: 5.20,
            slope: 0.10,
            bend: -1.8,
        },
    ),
];

fn polygon(vertices: &[(f64, f64)]) -> Result<EvolutePolygon> {
    Ok(EvolutePolygon::try_new(
        &vertices
            .iter()
            .map(|&(x, y)| DVec2::new(x, y))
            .collect::<Vec<_>>(),
    )?)
}

/// The recipe of Fig. 1.16: over half a turn three arcs of class 6 that keep the circle's jets at their ends and have the
/// one free Bézier line in the middle moved; the other half is the inner offset at the width.
fn moved_lines() -> Result<Rosette<7>> {
    let circle = SupportJet {
        support: 0.5 * WIDTH,
        slope: 0.0,
        bend: 0.0,
    };
    let nodes = [(0.0, circle), (1.0, circle), (2.1, circle), (PI, circle)];
    let half = nodes
        .windows(2)
        .zip([0.5, -0.4, 0.45])
        .map(|(ends, shift)| {
            let still: PhArc<6> = hermite_arc(ends[0], ends[1], &[])?;
            let middle = bezier_mass::bernstein::elevate(still.coefficients())[3];
            Ok(hermite_arc::<7>(ends[0], ends[1], &[middle + shift])?)
        });
    let half = half.collect::<Result<Vec<_>>>()?;
    let antipodes = half
        .iter()
        .map(|arc| Ok(antipodal_arc(arc, WIDTH)?))
        .collect::<Result<Vec<_>>>()?;
    Ok(Rosette::try_new(
        half.into_iter().chain(antipodes).collect(),
    )?)
}

fn outline<const N: usize>(rosette: &Rosette<N>) -> impl Fn(f64) -> DVec2 + '_ {
    |psi| rosette.contact(psi).point
}

fn evolute_plot(
    title: &str,
    polygon: &EvolutePolygon,
    rosette: &Rosette<4>,
    offsets: &[f64],
) -> Plot {
    let mut plot = Plot::geometry(title);
    for &distance in offsets {
        if let Ok(parallel) = rosette.offset(distance) {
            let style = if distance == 0.0 {
                BLUE.line().width(2.0).label("constant width")
            } else {
                BLUE.alpha(0.45).line().label("offsets")
            };
            plot.trace(outline(&parallel), 0.0, parallel.period(), style);
        }
    }
    for cubic in polygon.cubics() {
        plot.polyline(cubic.points(), MIST.line());
        plot.trace(
            |t| cubic.point(t),
            0.0,
            1.0,
            VERMILION.line().label("evolute"),
        );
    }
    let cusps: Vec<DVec2> = polygon
        .cubics()
        .iter()
        .map(|cubic: &TCubic| cubic.points()[0])
        .collect();
    plot.points(&cusps, Marker::Disc, VERMILION.fill());
    let joints: Vec<DVec2> = rosette.arcs().iter().map(|arc| arc.point(0.0)).collect();
    plot.points(&joints, Marker::Disc, BLUE.fill());
    plot
}

fn interpolation_plot(oval: &Rosette<6>) -> Result<Plot> {
    let mut plot = Plot::geometry("through given curvature elements");
    plot.circle(
        DVec2::ZERO,
        0.5 * WIDTH,
        GREY.line().dashed().label("circle of the width"),
    );
    for element in elements() {
        let contact = oval.contact(element.0 - ELEMENTS[0].0);
        let toward = contact.centre();
        plot.segment(contact.point, toward, ORANGE.line());
        plot.arc(
            toward,
            contact.radius,
            element.0 - 0.35,
            element.0 + 0.35,
            ORANGE.line().width(3.0).label("elements"),
        );
    }
    plot.trace(outline(oval), 0.0, TAU, BLUE.line().width(2.0));
    let at: Vec<DVec2> = elements()
        .map(|element| oval.contact(element.0 - ELEMENTS[0].0).point)
        .collect();
    plot.points(&at, Marker::Disc, ORANGE.fill());
    Ok(plot)
}

/// The given elements and their antipodes.
fn elements() -> impl Iterator<Item = (f64, SupportJet)> {
    ELEMENTS
        .into_iter()
        .chain(ELEMENTS.map(|(angle, jet)| (angle + PI, jet.antipode(WIDTH))))
}

fn lines_plot(oval: &Rosette<7>) -> Plot {
    let mut plot = Plot::geometry("of class 6, by moved Bézier lines");
    plot.circle(
        DVec2::ZERO,
        0.5 * WIDTH,
        GREY.line().dashed().label("circle of the width"),
    );
    for arc in oval.arcs() {
        for vector in arc.control_vectors() {
            let normal = DVec2::new(vector.y, vector.z);
            let foot = -vector.x * normal / normal.length_squared();
            let along = normal.perp().normalize() * 1.6;
            plot.segment(
                foot - along,
                foot + along,
                GREEN.alpha(0.6).line().label("Bézier lines"),
            );
        }
    }
    plot.trace(outline(oval), 0.0, TAU, BLUE.line().width(2.0));
    plot
}

impl Ovals {
    /// A motion with three dwells a turn, made antisymmetric: what a cam between two parallel sides can do.
    fn cam(&self) -> Result<Cam> {
        Cam::try_new(&lift(), self.arcs).or_bad_input("--arcs")
    }
}

fn lift() -> Antisymmetric<HarmonicLift> {
    let harmonics = vec![
        (0.0, 0.0),
        (0.0, 0.0),
        (0.38, 0.0),
        (0.0, 0.0),
        (0.0, 0.06),
        (0.0, 0.0),
        (0.02, 0.0),
    ];
    Antisymmetric {
        lift: HarmonicLift {
            mean: 5.0,
            harmonics,
        },
        width: WIDTH,
    }
}

fn lift_figure(cam: &Cam) -> Figure {
    use ph_curves::Lift;
    let mut plot = Plot::chart("motion of the frame", "angle of the cam (rad)", "lift");
    plot.graph(
        |psi| lift().jet(psi)[0],
        0.0,
        TAU,
        ORANGE.line().width(4.0).label("asked for"),
    );
    plot.graph(
        |psi| cam.profile.contact(psi).support,
        0.0,
        TAU,
        BLUE.line().label("the cam"),
    );
    Figure::new(plot).aspect(2.2)
}

/// The cam turned by `angle`, and the frame: the two sides are its tangents with vertical normals.
fn frame(cam: &Cam, angle: f64) -> Figure {
    let turn = DVec2::from_angle(angle);
    let mut plot = Plot::geometry("");
    let reach = 0.62 * cam.width;
    plot.view(
        DVec2::new(-1.12 * reach, -reach),
        DVec2::new(1.12 * reach, reach),
    );
    let profile: Vec<DVec2> = (0..400)
        .map(|i| turn.rotate(cam.profile.contact(TAU * f64::from(i) / 400.0).point))
        .collect();
    let top = 0.25 * TAU - angle;
    let contact = |psi: f64| -> Contact { cam.profile.contact(psi) };
    let (upper, lower) = (contact(top).support, -contact(top + PI).support);
    let corners = |half: f64, below: f64, above: f64| {
        [
            DVec2::new(-half, below),
            DVec2::new(half, below),
            DVec2::new(half, above),
            DVec2::new(-half, above),
        ]
    };
    plot.polygon(
        &corners(1.08 * reach, lower - 0.6, upper + 0.6),
        GREY.fill(),
    );
    plot.polygon(&corners(reach, lower, upper), crate::color::WHITE.fill());
    plot.polygon(&profile, BLUE.alpha(0.25).fill().stroke(BLUE));
    plot.segment(DVec2::ZERO, turn * 0.3 * cam.width, INK.line());
    plot.points(&[DVec2::ZERO], Marker::Disc, INK.fill());
    let touching = [
        turn.rotate(contact(top).point),
        turn.rotate(contact(top + PI).point),
    ];
    plot.points(&touching, Marker::Disc, VERMILION.fill());
    Figure::new(plot).aspect(1.12)
}

fn report(
    context: &mut Context,
    oval: &Rosette<4>,
    rosette: &Rosette<4>,
    interpolating: &Rosette<6>,
    cam: &Cam,
) {
    let samples = context.pick(10_000, 1_000);
    let deviation = |(least, most): (f64, f64)| (most - least) / most;
    let widths = [
        oval.width_range(samples),
        rosette.width_range(samples),
        interpolating.width_range(samples),
    ];
    let worst = widths.into_iter().map(deviation).fold(0.0, f64::max);
    context.number("width_max_deviation", worst, Target::AtMost(1e-11));

    let radii: Vec<f64> = oval.arcs().iter().flat_map(|arc| arc.end_radii()).collect();
    let ratio = radii.iter().copied().fold(0.0, f64::max)
        / radii.iter().copied().fold(f64::INFINITY, f64::min);
    context.number("radius_ratio", ratio, Target::AtLeast(1.5));

    let barbier =
        |perimeter: f64, index: usize, width: f64| perimeter / (index as f64 * PI * width) - 1.0;
    let perimeters = [
        barbier(oval.perimeter(), oval.index(), oval.width(0.0)),
        barbier(rosette.perimeter(), rosette.index(), rosette.width(0.0)),
        barbier(cam.profile.perimeter(), cam.profile.index(), cam.width),
    ];
    let worst = perimeters
        .into_iter()
        .fold(0.0, |most: f64, error| most.max(error.abs()));
    context.number(
        "perimeter_over_k_pi_d_minus_1",
        worst,
        Target::AtMost(1e-11),
    );
    context.number("rosette_index", rosette.index(), Target::exactly(3));

    let miss = |(angle, jet): (f64, SupportJet)| {
        let contact = interpolating.contact(angle - ELEMENTS[0].0);
        let slope = contact.point.dot(contact.normal.perp());
        let errors = [
            contact.support - jet.support,
            slope - jet.slope,
            contact.radius - jet.radius(),
        ];
        errors
            .into_iter()
            .fold(0.0, |most: f64, error| most.max(error.abs()))
    };
    let error = elements().map(miss).fold(0.0, f64::max);
    context.number("interpolation_max_error", error, Target::AtMost(1e-10));
    context.number("cam_lift_max_error", cam.lift_error, Target::AtMost(1e-4));
    context.number("cam_least_radius", cam.least_radius, Target::AtLeast(0.0));
}
