//! An exploding reflector in an elliptical medium, beside the isotropic one.
//!
//! What one sees: a bold valley that radiates everywhere at one moment, its rays in pale grey and its fronts in blue,
//! coloured later to darker. On the left the rays stand upright on the fronts; on the right, where the wave runs faster
//! along a slanted direction, they cross the fronts obliquely, and the red caustic of the valley's bottom is sheared. The
//! little curve in the corner is the front of a point source after a unit of time: a circle, an ellipse. The second figure
//! shows the arrival times along the line of receivers: where the caustic has passed, each receiver hears three waves.

use anyhow::{Context as _, Result};
use bezier_mass::BezierCurve;
use glam::{DVec2, dvec2};
use wavefront::{Code, Fan, FanOptions, Front, FrontTolerance, Medium, Model, Source};

use crate::color::{BLUE, GREY, INK, ORANGE, SKY, VERMILION};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::figure::{Figure, Marker, Path, Plot, Side};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Anisotropic {
    /// Speed along the fast direction; one across
    #[arg(long, default_value_t = 1.6)]
    fast: f64,
    /// The fast direction, in degrees from the horizontal
    #[arg(long, default_value_t = 35.0)]
    angle: f64,
}

/// The reflector, by its Bézier points.
const REFLECTOR: [DVec2; 4] = [
    dvec2(-2.6, 0.35),
    dvec2(-0.9, -1.05),
    dvec2(0.9, -1.05),
    dvec2(2.6, 0.35),
];
/// The receivers lie at this height.
const HEIGHT: f64 = 3.2;
/// Fronts fit this, a time.
const TOLERANCE: FrontTolerance = FrontTolerance::time(1e-9);

impl Demo for Anisotropic {
    const NAME: &'static str = "anisotropic";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Section 1.4 and Chapter 5";
    const ABOUT: &'static str =
        "An exploding reflector in an elliptical medium, beside the isotropic one";

    fn run(&self, context: &mut Context) -> Result<()> {
        let angle = self.angle.to_radians();
        let settings = [
            Setting::new("isotropic", [1.0, 1.0], 0.0)?,
            Setting::new("elliptical", [self.fast, 1.0], angle)
                .or_bad_input("--fast V, --angle DEGREES")?,
        ];
        let plots = settings.iter().map(Setting::plot).collect::<Result<_>>()?;
        context.figure(
            "figure",
            &Figure::grid(2, plots).aspect(0.95),
            "Fronts (blue), rays (grey) and caustic (red) of an exploding reflector: isotropic, and with an elliptical \
             indicatrix, where rays are not normal to the fronts.",
            "Two plots of a valley with rising curved fronts; in the right one everything leans to the right.",
        )?;
        let mut chart = Plot::chart("arrivals at the receivers", "x", "time");
        for (setting, color) in settings.iter().zip([SKY, VERMILION]) {
            let fan = setting.fan()?;
            let arrivals: Vec<DVec2> = receivers(context.pick(401, 81))
                .flat_map(|point| {
                    fan.arrivals(point)
                        .into_iter()
                        .map(move |a| dvec2(point.x, a.time))
                })
                .collect();
            chart.points(&arrivals, Marker::Disc, color.fill().label(setting.title));
        }
        context.figure(
            "figure-arrivals",
            &Figure::new(chart).aspect(1.7),
            "All arrivals of the two media at the line of receivers.",
            "Two curves of arrival times, each turning back at a cusp where the caustic is crossed, one of them shifted to the right.",
        )?;

        let count = context.pick(101, 21);
        let (mut error, mut missed, mut indicatrix) = (0.0_f64, 0, 0.0_f64);
        for setting in &settings {
            let (worst, lost) = setting.arrival_error(count)?;
            (error, missed) = (error.max(worst), missed + lost);
            indicatrix = indicatrix.max(setting.indicatrix_error()?);
        }
        context.number("arrival_max_error", error, Target::AtMost(1e-10));
        context.number("missed_arrivals", missed, Target::exactly(0));
        context.number("indicatrix_max_error", indicatrix, Target::AtMost(1e-12));
        Ok(())
    }
}

fn receivers(count: usize) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |i| dvec2(-2.5 + 5.0 * i as f64 / (count - 1) as f64, HEIGHT))
}

/// A medium with the model that consists of it.
struct Setting {
    title: &'static str,
    axes: [f64; 2],
    angle: f64,
    model: Model,
}

impl Setting {
    fn new(title: &'static str, axes: [f64; 2], angle: f64) -> Result<Self> {
        let medium = Medium::elliptical(axes[0], axes[1], angle)?;
        let model = Model::try_new(dvec2(-3.0, -1.5), dvec2(3.0, 4.0), vec![medium], Vec::new())?;
        Ok(Self {
            title,
            axes,
            angle,
            model,
        })
    }

    fn medium(&self) -> &Medium {
        &self.model.media()[0]
    }

    fn fan(&self) -> Result<Fan<'_>> {
        let source = Source::Reflector {
            curve: BezierCurve::polynomial(&REFLECTOR)?,
            left: true,
        };
        Ok(Fan::new(
            &self.model,
            source,
            Code::default(),
            FanOptions::default(),
        )?)
    }

    /// The vector in the axes of the ellipse and in units of them: its length is the travel time.
    fn scaled(&self, vector: DVec2) -> DVec2 {
        vector.rotate(DVec2::from_angle(-self.angle)) / DVec2::from_array(self.axes)
    }

    /// The largest error of the arrivals against the travel times that are stationary over the reflector, found by bisection
    /// on a fine grid; and how many of those are missing.
    fn arrival_error(&self, count: usize) -> Result<(f64, usize)> {
        let fan = self.fan()?;
        let (mut largest, mut missed) = (0.0_f64, 0);
        for receiver in receivers(count) {
            let found: Vec<f64> = fan
                .arrivals(receiver)
                .iter()
                .map(|arrival| arrival.time)
                .collect();
            for time in self.stationary_times(receiver) {
                let error = found
                    .iter()
                    .map(|other| (other / time - 1.0).abs())
                    .fold(f64::INFINITY, f64::min);
                if error < 1e-6 {
                    largest = largest.max(error);
                } else {
                    missed += 1;
                }
            }
        }
        Ok((largest, missed))
    }

    fn stationary_times(&self, receiver: DVec2) -> Vec<f64> {
        const GRID: u32 = 2000;
        let away = |t: f64| self.scaled(receiver - reflector(t).0);
        let slope = |t: f64| -away(t).dot(self.scaled(reflector(t).1));
        let parameter = |i: u32| f64::from(i) / f64::from(GRID);
        (0..GRID)
            .map(|i| [parameter(i), parameter(i + 1)])
            .filter(|&[low, high]| (slope(low) <= 0.0) != (slope(high) <= 0.0))
            .map(|[mut low, mut high]| {
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if (slope(middle) <= 0.0) == (slope(low) <= 0.0) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                away(0.5 * (low + high)).length()
            })
            .collect()
    }

    /// How far the front of a point source at time one is from the ellipse: the travel time to its points, minus one; and
    /// the same for the velocities of its rays.
    fn indicatrix_error(&self) -> Result<f64> {
        let place = dvec2(0.4, -0.3);
        let front = Front::from_point(self.medium(), 0, place, [0.0, std::f64::consts::TAU])?;
        let mut largest = 0.0_f64;
        for piece in 0..front.pieces().len() {
            for step in 0..=64 {
                let point = front.point(piece, f64::from(step) / 64.0, 1.0);
                largest = largest.max((self.scaled(point - place).length() - 1.0).abs());
            }
        }
        let fan = Fan::new(
            &self.model,
            Source::point(place),
            Code::default(),
            FanOptions::default(),
        )?;
        for trace in fan.traces() {
            let ray = trace.last().context("a ray has a leg")?;
            let point = ray.after(1.0, self.medium()).point;
            largest = largest.max((self.scaled(point - place).length() - 1.0).abs());
        }
        Ok(largest)
    }

    fn plot(&self) -> Result<Plot> {
        let fan = self.fan()?;
        let mut plot = Plot::geometry(self.title);
        plot.view(dvec2(-3.0, -1.5), dvec2(3.0, 4.0));
        for i in 0..=60 {
            let trace = fan.trace(f64::from(i) / 60.0)?;
            let ray = trace.last().context("a ray has a leg")?;
            let end = ray.after(6.0, self.medium()).point;
            plot.segment(ray.point, end, GREY.alpha(0.45).line().width(0.5));
        }
        for front in fan.fronts(TOLERANCE)? {
            for i in 1..=9 {
                let color = SKY.mix(BLUE, f64::from(i) as f32 / 9.0);
                for stretch in front.snapshot(0.42 * f64::from(i), 24) {
                    plot.polyline(&stretch, color.line().width(1.3));
                }
            }
            for (points, _) in front.caustic() {
                let mut path = Path::new();
                path.move_to(points[0]);
                path.cubic_to(points[1], points[2], points[3]);
                plot.path(path, VERMILION.line().width(2.2).label("caustic"));
            }
        }
        plot.trace(
            |t| reflector(t).0,
            0.0,
            1.0,
            INK.line().width(3.0).label("reflector"),
        );
        plot.points(
            &receivers(21).collect::<Vec<_>>(),
            Marker::Square,
            ORANGE.fill().label("receivers"),
        );
        let corner = dvec2(-2.2, -0.85);
        let across = DVec2::from_angle(self.angle);
        let indicatrix = |t: f64| {
            corner + 0.4 * (DVec2::from_angle(t) * DVec2::from_array(self.axes)).rotate(across)
        };
        plot.trace(
            indicatrix,
            0.0,
            std::f64::consts::TAU,
            INK.line().width(1.2),
        );
        plot.text(corner, "V", Side::Right);
        plot.points(&[corner], Marker::Disc, INK.fill());
        Ok(plot)
    }
}

/// The reflector and its derivative.
fn reflector(t: f64) -> (DVec2, DVec2) {
    let s = 1.0 - t;
    let [a, b, c, d] = REFLECTOR;
    let point = s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
    let velocity = 3.0 * (s * s * (b - a) + 2.0 * s * t * (c - b) + t * t * (d - c));
    (point, velocity)
}
