//! G2 approximation by Tschirnhausen quartics, and offsets of the result.
//!
//! What one sees in the picture: on the left a logarithmic spiral under three approximations by two pairs of quartics
//! whose tensions differ; the middle one lies on the spiral, the others leave it to either side, and dots mark where the
//! arcs meet. In the middle a cubic B-spline, dark, with its exact offsets on both sides, blue outside and red inside,
//! where cusps and loops appear; on the right the same family without the loops. With `--svg FILE` a second figure and
//! `offset.svg` show the offset of the user's own path.

use std::path::PathBuf;

use anyhow::{Context as _, Result};
use glam::{DVec2, dvec2};
use kurbo::BezPath;
use ph_curves::{
    Approximated, Approximation, ArcSpline, CubicPath, CurvatureElement, G2Pair, Piece, PlaneCurve,
    approximate,
};

use crate::color::{BLUE, GREEN, GREY, INK, ORANGE, VERMILION};
use crate::demo::{BadInput, Context, Demo, OrBadInput as _};
use crate::figure::{Corner, Figure, Marker, Path, Plot};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct TQuartic {
    /// Largest distance between the B-spline and its approximation
    #[arg(long, default_value_t = 1e-4)]
    tolerance: f64,
    /// An SVG file, or SVG path data, whose paths are offset instead of the built-in one
    #[arg(long)]
    svg: Option<PathBuf>,
    /// Offset distance for --svg, to the right of travel if positive, in the units of the file
    #[arg(long, default_value_t = 5.0, allow_negative_numbers = true)]
    distance: f64,
}

/// Slope of the logarithmic spiral `r = e^(SLOPE theta)` and the angle it runs through.
const SLOPE: f64 = 0.2;
const ANGLE: f64 = 5.0;
/// Control points of the cubic B-spline (uniform, not clamped) with one inflection.
const CONTROL: [DVec2; 9] = [
    dvec2(-0.6, 0.4),
    dvec2(0.0, 0.0),
    dvec2(1.0, 1.6),
    dvec2(2.4, 1.2),
    dvec2(3.0, -0.8),
    dvec2(4.4, -1.0),
    dvec2(5.5, 0.6),
    dvec2(6.0, 2.0),
    dvec2(5.4, 3.2),
];
/// Distances of the family, and the one at which errors are measured.
const DISTANCES: [f64; 8] = [-1.2, -0.9, -0.6, -0.3, 0.3, 0.6, 0.9, 1.2];
const MEASURED: f64 = 0.35;

impl Demo for TQuartic {
    const NAME: &'static str = "t-quartic";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Fig. 1.6";
    const ABOUT: &'static str =
        "G2 approximation by Tschirnhausen quartics, with offsets trimmed and not";

    fn run(&self, context: &mut Context) -> Result<()> {
        let curve = CubicPath::uniform_bspline(&CONTROL, false)?;
        let how = Approximation::quartics(self.tolerance);
        let result = approximate(&curve, &how).or_bad_input("--tolerance")?;
        let samples = context.pick(400, 60);

        context.number("pieces", result.spline.pieces().len(), Target::Free);
        let hausdorff = largest_distance(&curve, &result, &result.spline, 0.0, samples);
        context.number("hausdorff", hausdorff, Target::AtMost(self.tolerance));
        let certified = result.certify(&curve, self.tolerance)?;
        context.number(
            "hausdorff_certified",
            certified,
            Target::AtMost(self.tolerance),
        );
        context.number("g2_max_jump", result.spline.g2_jump(), Target::AtMost(1e-8));
        context.number("g1_only_joints", result.g1_joints, Target::Free);
        let offset = result.spline.offset(MEASURED)?;
        let error = largest_distance(&curve, &result, &offset, MEASURED, samples);
        context.number("offset_max_error", error, Target::AtMost(self.tolerance));
        let exact = largest_own_error(&result.spline, &offset, MEASURED, samples);
        context.number("offset_of_spline_max_error", exact, Target::AtMost(1e-12));
        context.number("order", order()?, Target::within(5.0, 0.3));

        let plots = vec![
            spiral_plot()?,
            family_plot(&result.spline, false)?,
            family_plot(&result.spline, true)?,
        ];
        context.figure(
            "figure",
            &Figure::grid(3, plots).aspect(0.9),
            "A logarithmic spiral by two pairs of Tschirnhausen quartics for three tensions; a cubic B-spline with its \
             exact offsets, and the same offsets without their loops.",
            "Three plots: a spiral with three approximations, and a wavy curve with parallel curves on both sides, with \
             loops in the second plot and without them in the third.",
        )?;
        match &self.svg {
            Some(file) => self.offset_file(context, file),
            None => Ok(()),
        }
    }
}

/// Largest distance of points of the curve, moved by `distance` along its normal, from the pieces made there.
fn largest_distance(
    curve: &CubicPath,
    result: &Approximated,
    spline: &ArcSpline,
    distance: f64,
    samples: usize,
) -> f64 {
    let mut worst = 0.0_f64;
    for (index, [from, to]) in result.sources.iter().enumerate() {
        // The arcs of a pair share their source: the nearer one answers.
        let group: Vec<&Piece> = (result.sources.iter().zip(spline.pieces()))
            .filter(|(source, _)| **source == result.sources[index])
            .map(|(_, piece)| piece)
            .collect();
        for k in 0..=samples {
            let parameter = from + (to - from) * k as f64 / samples as f64;
            let span = (parameter as usize).min(curve.spans() - 1);
            let [point, first, _] = curve.jet(span, parameter - span as f64);
            let moved = point - first.normalize().perp() * distance;
            worst = worst.max(
                group
                    .iter()
                    .map(|piece| piece.distance(moved))
                    .fold(f64::INFINITY, f64::min),
            );
        }
    }
    worst
}

/// Largest distance between points of the offset and points of the spline moved along its normals.
fn largest_own_error(spline: &ArcSpline, offset: &ArcSpline, distance: f64, samples: usize) -> f64 {
    let mut worst = 0.0_f64;
    for (piece, moved) in spline.pieces().iter().zip(offset.pieces()) {
        for k in 0..=samples {
            let t = k as f64 / samples as f64;
            worst =
                worst.max((moved.point(t) - piece.point(t) - piece.normal(t) * distance).length());
        }
    }
    worst
}

fn spiral(theta: f64) -> DVec2 {
    DVec2::from_angle(theta) * (SLOPE * theta).exp()
}

fn element(theta: f64) -> Result<CurvatureElement> {
    let normal = dvec2(1.0, -SLOPE).rotate(DVec2::from_angle(theta));
    let radius = (SLOPE * theta).exp() * (1.0 + SLOPE * SLOPE).sqrt();
    Ok(CurvatureElement::new(spiral(theta), normal, radius)?)
}

/// The pairs over equal steps of the spiral's angle.
fn spiral_pairs(angle: f64, pieces: usize, beta: f64) -> Result<Vec<G2Pair>> {
    let at = |k: usize| element(angle * k as f64 / pieces as f64);
    (0..pieces)
        .map(|k| Ok(G2Pair::new(&at(k)?, &at(k + 1)?, beta)?))
        .collect()
}

/// Order of the support error for tension 1/2 when the steps are halved.
fn order() -> Result<f64> {
    const ANGLE: f64 = 3.0;
    let error = |pieces: usize| -> Result<f64> {
        let pairs = spiral_pairs(ANGLE, pieces, 0.5)?;
        let mut worst = 0.0_f64;
        for k in 0..pieces * 40 {
            let theta = ANGLE * (k as f64 + 0.5) / (pieces * 40) as f64;
            let normal = dvec2(1.0, -SLOPE)
                .rotate(DVec2::from_angle(theta))
                .normalize();
            let on_pair = pairs[k / 40]
                .arcs
                .iter()
                .find_map(|arc| arc.parameter_of_normal(normal).map(|t| arc.support(t)))
                .context("a normal of the spiral that the arcs lack")?;
            worst = worst.max((on_pair - normal.dot(spiral(theta))).abs());
        }
        Ok(worst)
    };
    Ok((error(8)? / error(16)?).log2())
}

fn spiral_plot() -> Result<Plot> {
    let mut plot = Plot::geometry("log spiral, tension β");
    plot.trace(spiral, 0.0, ANGLE, GREY.line().width(4.0).label("spiral"));
    for (beta, color) in [(0.1, VERMILION), (0.5, BLUE), (0.9, GREEN)] {
        let pairs = spiral_pairs(ANGLE, 2, beta)?;
        let label = format!("β = {beta}");
        for (k, arc) in pairs.iter().flat_map(|pair| pair.arcs).enumerate() {
            let style = color.line().width(1.2);
            let style = if k == 0 { style.label(&label) } else { style };
            plot.trace(|t| arc.point(t), 0.0, 1.0, style);
        }
        let joints: Vec<DVec2> = pairs.iter().map(|pair| pair.joint.point()).collect();
        plot.points(&joints, Marker::Dot, color.line());
    }
    plot.view(dvec2(-2.2, -3.1), dvec2(4.6, 2.2))
        .legend(Corner::TopRight);
    Ok(plot)
}

/// The path of a spline, fine enough for a figure.
fn drawn(spline: &ArcSpline) -> Result<Path> {
    let mut path = Path::new();
    let v = |p: kurbo::Point| dvec2(p.x, p.y);
    for element in spline.to_kurbo(1e-4)? {
        match element {
            kurbo::PathEl::MoveTo(p) => path.move_to(v(p)),
            kurbo::PathEl::LineTo(p) => path.line_to(v(p)),
            kurbo::PathEl::QuadTo(a, p) => path.quadratic_to(v(a), v(p)),
            kurbo::PathEl::CurveTo(a, b, p) => path.cubic_to(v(a), v(b), v(p)),
            kurbo::PathEl::ClosePath => path.close(),
        }
    }
    Ok(path)
}

fn family_plot(spline: &ArcSpline, trimmed: bool) -> Result<Plot> {
    let mut plot = Plot::geometry(if trimmed {
        "offsets, trimmed"
    } else {
        "offsets, exact"
    });
    for distance in DISTANCES {
        let color = if distance > 0.0 { BLUE } else { VERMILION };
        let chains = if trimmed {
            spline.trimmed_offset(distance)?
        } else {
            vec![spline.offset(distance)?]
        };
        for chain in &chains {
            plot.path(drawn(chain)?, color.line().width(1.0));
        }
    }
    plot.path(drawn(spline)?, INK.line().width(2.0));
    let joints: Vec<DVec2> = spline
        .pieces()
        .iter()
        .map(|piece| piece.point(0.0))
        .collect();
    plot.points(&joints, Marker::Dot, ORANGE.line());
    Ok(plot)
}

impl TQuartic {
    /// Offsets every path of a file and writes the result as SVG.
    fn offset_file(&self, context: &mut Context, file: &PathBuf) -> Result<()> {
        let text =
            std::fs::read_to_string(file).or_bad_input(format!("--svg {}", file.display()))?;
        let mut plot = Plot::geometry("");
        let (mut originals, mut offsets) = (String::new(), String::new());
        let mut size = kurbo::Rect::new(
            f64::INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        );
        for data in path_data(&text) {
            let path = BezPath::from_svg(data).or_bad_input("--svg: path data")?;
            let bounds = kurbo::Shape::bounding_box(&path);
            let tolerance = 1e-6 * bounds.width().max(bounds.height());
            for curve in CubicPath::from_kurbo(&path).or_bad_input("--svg")? {
                let spline = approximate(&curve, &Approximation::within(tolerance))
                    .or_bad_input("--svg")?
                    .spline;
                originals += &format!(
                    "<path d=\"{}\" stroke=\"#22262b\"/>\n",
                    spline.to_kurbo(tolerance)?.to_svg()
                );
                plot.path(drawn_within(&spline, tolerance)?, INK.line());
                for chain in spline
                    .trimmed_offset(self.distance)
                    .or_bad_input("--distance")?
                {
                    let outline = chain.to_kurbo(tolerance)?;
                    size = size.union(kurbo::Shape::bounding_box(&outline));
                    offsets += &format!("<path d=\"{}\" stroke=\"#0072b2\"/>\n", outline.to_svg());
                    plot.path(drawn_within(&chain, tolerance)?, BLUE.line());
                }
            }
            size = size.union(bounds);
        }
        if originals.is_empty() {
            return Err(
                BadInput(format!("--svg {}: no path with data in it", file.display())).into(),
            );
        }
        let size = size.inflate(0.02 * size.width(), 0.02 * size.height());
        let width = 0.003 * size.width().max(size.height());
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\" fill=\"none\" stroke-width=\"{width}\">\n\
             {originals}{offsets}</svg>\n",
            size.x0,
            size.y0,
            size.width(),
            size.height(),
        );
        context.text("offset.svg", &svg)?;
        context.figure(
            "figure-svg",
            &Figure::new(plot),
            &format!(
                "The paths of the file with their offsets at distance {} (y up).",
                self.distance
            ),
            "The user's paths and their parallel curves.",
        )
    }
}

fn drawn_within(spline: &ArcSpline, tolerance: f64) -> Result<Path> {
    let points: Vec<DVec2> = spline
        .to_kurbo(100.0 * tolerance)?
        .segments()
        .flat_map(|segment| {
            (0..=16).map(move |k| kurbo::ParamCurve::eval(&segment, f64::from(k) / 16.0))
        })
        .map(|p| dvec2(p.x, p.y))
        .collect();
    Ok(Path::polyline(&points, spline.is_closed()))
}

/// The `d` attributes of an SVG text, or the whole text if it has no elements.
fn path_data(text: &str) -> Vec<&str> {
    if !text.contains('<') {
        return vec![text.trim()];
    }
    text.split("<path")
        .skip(1)
        .filter_map(|element| {
            let element = element.split('>').next()?;
            let start = [" d=\"", "\nd=\"", "\td=\"", " d='"]
                .iter()
                .find_map(|key| element.find(key).map(|i| i + key.len()))?;
            element[start..].split(['"', '\'']).next()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::path_data;

    #[test]
    fn path_data_is_found_in_elements_and_alone() {
        assert_eq!(path_data("M0 0 L1 1\n"), ["M0 0 L1 1"]);
        let svg = "<svg><path id=\"a\" d=\"M0 0\"/><g><path fill='x' d='M1 1'/></g></svg>";
        assert_eq!(path_data(svg), ["M0 0", "M1 1"]);
    }
}
