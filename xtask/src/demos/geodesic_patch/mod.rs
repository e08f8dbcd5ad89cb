//! Patches whose boundaries are geodesics (Figs 3.18 to 3.26 of the chapter on sensors).
//!
//! What one sees: four curves with given tangent and osculating planes at the corners, filled under three criteria of
//! smoothness side by side; the one of degree 7 with its control points; a rational one of degree 5; a triangle of great
//! circles. Zebra stripes show that the surfaces are smooth, colours their Gaussian curvature, and thin tubes the
//! boundaries, which a strip of paper could be laid along.

mod boundaries;
mod draw;

use anyhow::Result;
use bezier_mass::{BezierCurve, BezierPatch};
use glam::{DVec2, DVec3, dvec2};
use reconstruct::{
    CoonsPatch, Corners, Criterion, Degree7Shape, Error, FrenetFrame, GeodesicStrip, Rectangle,
    Surface, boundary_geodesic_curvature, degree7_boundaries, rational_quintic_boundaries,
};

use boundaries::{bad_sets, corners, strips, triangle};
use draw::Drawn;

use crate::color::{BLUE, GREEN, VERMILION};
use crate::demo::{Context, Demo, OrBadInput};
use crate::figure::{Figure, Marker, Plot};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct GeodesicPatch {
    /// How strongly the model bends from which the corner data are read
    #[arg(long, default_value_t = 0.8)]
    bend: f64,
}

/// Places on a boundary at which its geodesic curvature is measured.
const PLACES: usize = 60;
const CRITERIA: [(Criterion, &str); 3] = [
    (Criterion::SpeedVariation, "speed variation"),
    (Criterion::Dirichlet, "Dirichlet"),
    (Criterion::ThinPlate, "thin plate"),
];

impl Demo for GeodesicPatch {
    const NAME: &'static str = "geodesic-patch";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 3.18 to 3.26";
    const ABOUT: &'static str =
        "Rectangles, triangles and Bézier patches whose boundary curves are geodesics";

    fn run(&self, context: &mut Context) -> Result<()> {
        let corners = corners(self.bend).or_bad_input("--bend")?;
        let curves =
            degree7_boundaries(&corners, &Degree7Shape::default()).or_bad_input("--bend")?;
        // The criteria are those of Section 3.6, with frames; the Bézier patches are those of Section 3.7.
        let frames = Rectangle::new(frame_strips(&curves)?).or_bad_input("--bend")?;
        let mut worst = Worst {
            curvature: 0.0,
            c3: frames.report().c3_residual,
        };
        let patches = criteria(context, &frames, &mut worst).or_bad_input("--bend")?;
        let degree7 = bezier_patch(&curves, &mut worst)?;
        let quintics = rational_quintic_boundaries(&corners)?;
        let rational = bezier_patch(&quintics, &mut worst)?;
        let error = corner_error(&corners, &curves)?.max(corner_error(&corners, &quintics)?);
        context.number("corner_data_error", error, Target::AtMost(1e-10));

        let triangle = triangle()?;
        worst.c3 = worst.c3.max(triangle.report().c3_residual);
        let domain = [DVec2::ZERO, dvec2(1.0, 0.0), dvec2(0.5, 0.75_f64.sqrt())];
        let filled = triangle.smoothest(domain)?.patch;
        worst.curvature = worst
            .curvature
            .max(filled.boundary_geodesic_curvature(PLACES));
        let residual = filled.integrated_curvature(24) - triangle.total_curvature();
        context.number(
            "gauss_bonnet_residual",
            residual.abs(),
            Target::AtMost(1e-9),
        );

        context.number(
            "boundary_geodesic_curvature_max",
            worst.curvature,
            Target::AtMost(1e-8),
        );
        context.number("c3_max_residual", worst.c3, Target::AtMost(1e-8));
        bad_sets(context, &corners, &curves)?;
        let drawn = Drawn {
            patches: &patches,
            degree7: &degree7,
            curves: &curves,
            rational: &rational,
            quintics: &quintics,
            triangle: &filled,
        };
        drawn.render(context)?;
        drawn.export(context)
    }
}

/// The worst that was measured over all constructions.
struct Worst {
    curvature: f64,
    c3: f64,
}

impl Worst {
    fn see(&mut self, surface: &impl Surface) {
        self.curvature = self
            .curvature
            .max(boundary_geodesic_curvature(surface, PLACES));
    }
}

fn frame_strips(curves: &[BezierCurve<DVec3>; 4]) -> Result<[GeodesicStrip; 4], Error> {
    let [a, b, c, d] = curves.clone().map(GeodesicStrip::new);
    Ok([a?, b?, c?, d?])
}

/// The exact patch on Bézier boundaries: of least thin-plate energy where that is regular at the boundary, otherwise
/// with the twists that always are.
fn bezier_patch(curves: &[BezierCurve<DVec3>; 4], worst: &mut Worst) -> Result<BezierPatch<DVec3>> {
    let rectangle = Rectangle::new(strips(curves)?)?;
    worst.c3 = worst.c3.max(rectangle.report().c3_residual);
    let patch = match rectangle.smoothest(Criterion::ThinPlate) {
        Ok(smoothed) => smoothed.patch,
        Err(Error::IrregularBoundary { .. }) => rectangle.patch(rectangle.regular_twists())?,
        Err(error) => return Err(error.into()),
    };
    let bezier = patch.to_bezier()?;
    worst.see(&patch);
    worst.see(&bezier);
    Ok(bezier)
}

/// Fig. 3.20: the same boundary under the three criteria.
fn criteria(
    context: &mut Context,
    rectangle: &Rectangle<GeodesicStrip>,
    worst: &mut Worst,
) -> Result<Vec<CoonsPatch>> {
    let mut table = Vec::new();
    let mut patches = Vec::new();
    for (criterion, _) in CRITERIA {
        let patch = rectangle.smoothest(criterion)?.patch;
        table.push(CRITERIA.map(|(measure, _)| patch.energy(measure)));
        worst.see(&patch);
        patches.push(patch);
    }
    let own = (0..3)
        .filter(|c| (0..3).all(|row| table[*c][*c] <= table[row][*c] * (1.0 + 1e-12)))
        .count();
    let rows: Vec<Vec<f64>> = table.iter().map(|row| row.to_vec()).collect();
    context.number("energy_by_criterion", rows, Target::Free);
    context.number("own_minimum_is_smallest", own, Target::exactly(3));
    let mut plot = Plot::chart(
        "energy over the least of its kind",
        "criterion that was minimised",
        "ratio",
    );
    for (c, color) in [VERMILION, BLUE, GREEN].into_iter().enumerate() {
        let least = table[c][c];
        let points: Vec<DVec2> = (0..3)
            .map(|row| dvec2(row as f64 + 1.0, table[row][c] / least))
            .collect();
        plot.polyline(&points, color.line().dotted().label(CRITERIA[c].1));
        plot.points(&points, Marker::Disc, color.fill());
    }
    plot.categories(&CRITERIA.map(|(_, name)| name));
    context.figure(
        "figure-energies",
        &Figure::new(plot),
        "Each patch measured by each criterion (colour), over that criterion's own minimum.",
        "Three dotted lines over three criteria, each at one where its own criterion was minimised.",
    )?;
    Ok(patches)
}

/// How far the curves are from the corner data: points, directions and curvature vectors.
fn corner_error(corners: &Corners, curves: &[BezierCurve<DVec3>; 4]) -> Result<f64> {
    let mut worst: f64 = 0.0;
    for (i, row) in corners.iter().enumerate() {
        for (j, corner) in row.iter().enumerate() {
            for (axis, (side, t)) in [(2 * j, i as f64), (1 + 2 * i, j as f64)]
                .into_iter()
                .enumerate()
            {
                let frame = FrenetFrame::at(&curves[side], t)?;
                let bend = corner.normal() * corner.curvatures()[axis];
                worst = worst
                    .max(frame.point.distance(corner.point()))
                    .max(frame.tangent.distance(corner.tangents()[axis]))
                    .max((frame.normal * frame.curvature).distance(bend));
            }
        }
    }
    Ok(worst)
}
