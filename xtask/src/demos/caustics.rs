//! Caustics of circles and an ellipse: cardioid, nephroid, a focus, and the caustic of a refracted beam.
//!
//! What one sees: four mirrors or lenses with their rays in pale grey, the fronts at a few times in blue and the caustic,
//! the evolute of the fronts, bold in red. Light from a point of a circle is reflected onto a heart-shaped curve with one
//! cusp, parallel light onto half a kidney-shaped one; an ellipse gathers all rays from one focus in the other; a beam that
//! enters a disc of refractive index two narrows to a cusp on the far side.

use std::f64::consts::PI;

use anyhow::{Context as _, Result};
use glam::{DVec2, dvec2};
use wavefront::{
    Code, Fan, FanOptions, Front, FrontTolerance, Interface, Medium, Mode, Model, Source, Step,
    Trace,
};

use crate::color::{BLUE, GREEN, GREY, INK, MIST, VERMILION};
use crate::demo::{Context, Demo};
use crate::figure::{Figure, Marker, Path, Plot};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Caustics {
    /// Refractive index of the disc that the beam enters
    #[arg(long, default_value_t = 2.0, value_parser = index)]
    index: f64,
}

/// An index at which the paraxial focus is not behind the beam.
fn index(text: &str) -> Result<f64, String> {
    let index: f64 = text.parse().map_err(|error| format!("{error}"))?;
    if (1.1..=20.0).contains(&index) {
        Ok(index)
    } else {
        Err("the index lies between 1.1 and 20".into())
    }
}

impl Demo for Caustics {
    const NAME: &'static str = "caustics";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Chapter 5";
    const ABOUT: &'static str =
        "Cardioid, nephroid, elliptical mirror and the caustic of a refracted beam";

    fn run(&self, context: &mut Context) -> Result<()> {
        let optics = [
            cardioid()?,
            nephroid()?,
            ellipse()?,
            refraction(self.index)?,
        ];
        let plots = optics.iter().map(Optics::plot).collect::<Result<_>>()?;
        context.figure(
            "figure",
            &Figure::grid(2, plots).aspect(1.0),
            "Rays (grey), fronts (blue) and caustics (red): a circle with the source on it, a circle in parallel light, an \
             ellipse with the source in a focus, a beam that enters a disc.",
            "Four round outlines with pale rays; red curves with one cusp in three of them, a red point in the ellipse.",
        )?;

        let count = context.pick(2000, 200);
        let (mut caustic, mut cusp, mut focus, mut front_cusp) =
            (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        for optics in &optics {
            let fan = optics.fan()?;
            let exact = optics.caustic_error(&fan, count)?;
            match optics.closed_form {
                ClosedForm::Focus { .. } => focus = focus.max(exact),
                ClosedForm::Curve { cusp: place, .. } => {
                    caustic = caustic.max(exact);
                    cusp = cusp.max(optics.cusp(&fan)?.distance(place));
                    front_cusp = front_cusp.max(optics.front_cusp_error(&fan, count)?);
                }
            }
        }
        context.number("cusp_position_max_error", cusp, Target::AtMost(1e-9));
        context.number("focus_max_error", focus, Target::AtMost(1e-9));
        context.number("caustic_max_error", caustic, Target::AtMost(1e-9));
        context.number("front_cusp_max_error", front_cusp, Target::AtMost(1e-4));
        Ok(())
    }
}

/// One boundary of size one with a wave that it bends.
struct Optics {
    title: &'static str,
    model: Model,
    source: Source,
    mode: Mode,
    closed_form: ClosedForm,
    /// The times of the fronts that are drawn.
    times: Vec<f64>,
}

/// What is known of the caustic.
enum ClosedForm {
    /// The point of the caustic on the ray that is bent at a point of the boundary, and the cusp.
    Curve {
        at: Box<dyn Fn(DVec2) -> DVec2>,
        cusp: DVec2,
    },
    /// All rays meet in a point at a time.
    Focus { point: DVec2, time: f64 },
}

/// Media outside and inside a closed boundary, in a box around it.
fn model(boundary: Interface, inside: f64) -> Result<Model> {
    let media = vec![Medium::isotropic(1.0)?, Medium::isotropic(inside)?];
    Ok(Model::try_new(
        DVec2::splat(-2.0),
        DVec2::splat(2.0),
        media,
        vec![boundary],
    )?)
}

/// The source lies on the circle: a cardioid.
fn cardioid() -> Result<Optics> {
    // With the source in (-1, 0) and the point of reflection at the angle a: (2 cos a - cos 2a, 2 sin a - sin 2a) / 3.
    // The source is in (0, -1), so that everything is turned by a quarter.
    let at = |hit: DVec2| {
        let turned = hit.rotate(-DVec2::Y);
        let square = turned.rotate(turned);
        (2.0 * turned - square).rotate(DVec2::Y) / 3.0
    };
    Ok(Optics {
        title: "a source on a circle: the cardioid",
        model: model(Interface::circle(DVec2::ZERO, 1.0)?, 1.0)?,
        source: Source::Point {
            position: -DVec2::Y,
            angles: [0.03, PI - 0.03],
        },
        mode: Mode::Reflect,
        closed_form: ClosedForm::Curve {
            at: Box::new(at),
            cusp: dvec2(0.0, 1.0 / 3.0),
        },
        times: vec![1.6, 2.0, 2.4, 2.8, 3.2],
    })
}

/// Parallel light: a nephroid.
fn nephroid() -> Result<Optics> {
    let at = |hit: DVec2| {
        let cube = hit.rotate(hit).rotate(hit);
        0.75 * hit - 0.25 * cube
    };
    Ok(Optics {
        title: "parallel light in a circle: the nephroid",
        model: model(Interface::circle(DVec2::ZERO, 1.0)?, 1.0)?,
        source: Source::Plane {
            ends: [dvec2(0.0, -0.9995), dvec2(0.0, 0.9995)],
            towards: DVec2::X,
        },
        mode: Mode::Reflect,
        closed_form: ClosedForm::Curve {
            at: Box::new(at),
            cusp: dvec2(0.5, 0.0),
        },
        times: vec![0.3, 0.7, 1.1, 1.5, 1.9],
    })
}

/// From focus to focus, in the time that light needs along the long axis.
fn ellipse() -> Result<Optics> {
    let (a, b) = (1.2_f64, 0.95_f64);
    let focus = dvec2((a * a - b * b).sqrt(), 0.0);
    Ok(Optics {
        title: "an ellipse: from focus to focus",
        model: model(
            Interface::ellipse(DVec2::ZERO, a * DVec2::X, b * DVec2::Y)?,
            1.0,
        )?,
        source: Source::point(-focus),
        mode: Mode::Reflect,
        closed_form: ClosedForm::Focus {
            point: focus,
            time: 2.0 * a,
        },
        times: vec![0.9, 1.2, 1.5, 1.8, 2.1],
    })
}

/// Parallel light enters a disc of the given index.
fn refraction(index: f64) -> Result<Optics> {
    // Coddington's equation for a bundle from infinity: n cos²(b) / q = n cos b - cos a.
    let at = move |hit: DVec2| {
        let cos_in = -hit.x;
        let sin_out = hit.y / index;
        let cos_out = (1.0 - sin_out * sin_out).sqrt();
        let along = index * cos_out * cos_out / (index * cos_out - cos_in);
        // Inwards along the normal -hit, turned by the angle of refraction towards the axis of the beam.
        hit + along * (-hit).rotate(dvec2(cos_out, sin_out))
    };
    let paraxial = dvec2(index / (index - 1.0) - 1.0, 0.0);
    Ok(Optics {
        title: "a beam that enters a disc",
        model: model(Interface::circle(DVec2::ZERO, 1.0)?, 1.0 / index)?,
        source: Source::Plane {
            ends: [dvec2(-1.5, -0.9995), dvec2(-1.5, 0.9995)],
            towards: DVec2::X,
        },
        mode: Mode::Transmit,
        closed_form: ClosedForm::Curve {
            at: Box::new(at),
            cusp: paraxial,
        },
        times: (1..=6).map(|i| 0.5 + 0.34 * index * f64::from(i)).collect(),
    })
}

impl Optics {
    fn fan(&self) -> Result<Fan<'_>> {
        let code = Code {
            steps: vec![Step {
                interface: 0,
                mode: self.mode,
            }],
        };
        Ok(Fan::new(
            &self.model,
            self.source.clone(),
            code,
            FanOptions::default(),
        )?)
    }

    /// The medium behind the boundary's bend.
    fn medium<'a>(&'a self, fan: &Fan<'_>) -> &'a Medium {
        &self.model.media()[fan.last_layer()]
    }

    /// Parameters inside the illuminated part of the source.
    fn parameters(fan: &Fan<'_>, count: usize) -> Vec<f64> {
        let inside = |[start, end]: [f64; 2]| {
            (0..count).map(move |i| start + (end - start) * (i as f64 + 0.5) / count as f64)
        };
        fan.illuminated().flat_map(inside).collect()
    }

    /// The largest distance of the rays' caustic points from the closed form; at a focus also that of the front.
    fn caustic_error(&self, fan: &Fan<'_>, count: usize) -> Result<f64> {
        let mut largest = 0.0_f64;
        for parameter in Self::parameters(fan, count) {
            let trace = fan.trace(parameter)?;
            let (ray, impact) = last(&trace)?;
            let found = ray.caustic_point(self.medium(fan));
            let error = match &self.closed_form {
                ClosedForm::Curve { at, .. } => found.distance(at(impact)),
                ClosedForm::Focus { point, time } => {
                    let arrived = ray.after(time - ray.time, self.medium(fan)).point;
                    found.distance(*point).max(arrived.distance(*point))
                }
            };
            largest = largest.max(error);
        }
        if let ClosedForm::Focus { point, time } = self.closed_form {
            for front in fan.fronts(FrontTolerance::time(1e-11))? {
                for piece in 0..front.pieces().len() {
                    for step in 0..=8 {
                        let place = front.point(piece, f64::from(step) / 8.0, time);
                        largest = largest.max(place.distance(point));
                    }
                }
            }
        }
        Ok(largest)
    }

    /// The cusp of the caustic, where its distance along the rays is stationary: golden section on the axis' neighbours.
    fn cusp(&self, fan: &Fan<'_>) -> Result<DVec2> {
        let radius = |parameter: f64| -> Result<(f64, DVec2)> {
            let trace = fan.trace(parameter)?;
            let (ray, _) = last(&trace)?;
            let point = ray.caustic_point(self.medium(fan));
            Ok((ray.time_at(point), point))
        };
        let best = |values: &[f64]| -> Result<f64> {
            let mut latest = (f64::NEG_INFINITY, 0.5);
            for &parameter in values {
                let time = radius(parameter)?.0;
                latest = if time > latest.0 {
                    (time, parameter)
                } else {
                    latest
                };
            }
            Ok(latest.1)
        };
        // The cusp is the caustic's latest point; narrow a grid of 16 around it.
        let (mut middle, mut half) = (best(&Self::parameters(fan, 64))?, 1.0 / 64.0);
        while half > 1e-9 {
            let grid: Vec<f64> = (-8..=8)
                .map(|i| middle + half * f64::from(i) / 8.0)
                .collect();
            middle = best(&grid)?;
            half /= 4.0;
        }
        Ok(radius(middle)?.1)
    }

    /// The largest distance of the fitted fronts' cusps from the caustic.
    fn front_cusp_error(&self, fan: &Fan<'_>, count: usize) -> Result<f64> {
        let ClosedForm::Curve { at, .. } = &self.closed_form else {
            return Ok(0.0);
        };
        let caustic: Vec<DVec2> = Self::parameters(fan, 4 * count)
            .into_iter()
            .map(|parameter| Ok(at(last(&fan.trace(parameter)?)?.1)))
            .collect::<Result<_>>()?;
        let mut largest = 0.0_f64;
        for front in fan.fronts(FrontTolerance::time(1e-9))? {
            for time in &self.times {
                for cusp in front.cusps(*time) {
                    let away = |ends: &[DVec2]| to_segment(cusp.point, ends[0], ends[1]);
                    largest =
                        largest.max(caustic.windows(2).map(away).fold(f64::INFINITY, f64::min));
                }
            }
        }
        Ok(largest)
    }

    fn plot(&self) -> Result<Plot> {
        let fan = self.fan()?;
        let mut plot = Plot::geometry(self.title);
        plot.view(dvec2(-1.62, -1.3), dvec2(1.3, 1.3));
        let outline =
            self.model.interfaces()[0].polyline(DVec2::splat(-2.0), DVec2::splat(2.0), 400);
        let shade = if self.mode == Mode::Transmit {
            MIST.alpha(0.6)
        } else {
            MIST.alpha(0.25)
        };
        plot.polygon(&outline, shade.fill().stroke(INK).width(1.6));
        for parameter in Self::parameters(&fan, 48) {
            let trace = fan.trace(parameter)?;
            let (ray, impact) = last(&trace)?;
            let velocity = self.medium(&fan).group_velocity(ray.slowness);
            let wall = self.model.interfaces()[0].first_impact(ray.point, velocity, 1e-9);
            let mut points = vec![trace.legs[0].point, impact];
            points.extend(wall.map(|wall| wall.point));
            plot.polyline(&points, GREY.alpha(0.55).line().width(0.5));
        }
        for front in fan.fronts(FrontTolerance::time(1e-7))? {
            self.draw_front(&mut plot, &front);
        }
        match self.closed_form {
            ClosedForm::Focus { point, .. } => {
                plot.points(&[point], Marker::Disc, VERMILION.fill().label("focus"));
                plot.points(&[-point], Marker::Disc, INK.fill().label("source"));
            }
            ClosedForm::Curve { cusp, .. } => {
                plot.points(&[cusp], Marker::Disc, GREEN.fill().label("cusp"));
                if let Source::Point { position, .. } = self.source {
                    plot.points(&[position], Marker::Disc, INK.fill().label("source"));
                }
            }
        }
        Ok(plot)
    }

    fn draw_front(&self, plot: &mut Plot, front: &Front) {
        for time in &self.times {
            // What has run out of the boundary again is of no interest here.
            for stretch in front.snapshot_inside(&self.model, *time, 32) {
                plot.polyline(&stretch, BLUE.line().width(1.0).label("fronts"));
            }
        }
        if let ClosedForm::Curve { .. } = self.closed_form {
            for (points, _) in front.caustic() {
                let mut path = Path::new();
                path.move_to(points[0]);
                path.cubic_to(points[1], points[2], points[3]);
                plot.path(path, VERMILION.line().width(2.2).label("caustic"));
            }
        }
    }
}

/// The ray after the bend, and where it was bent.
fn last(trace: &Trace) -> Result<(wavefront::Ray, DVec2)> {
    let ray = trace.last().context("a traced ray has legs")?;
    let impact = trace.impacts.last().context("the ray was bent")?;
    Ok((*ray, impact.point))
}

/// The distance of a point from a segment.
fn to_segment(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance(from + share * along)
}
