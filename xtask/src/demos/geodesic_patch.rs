//! Patches whose boundaries are geodesics (Figs 3.18 to 3.26 of the chapter on sensors).
//!
//! What one sees: four curves with given tangent and osculating planes at the corners, filled under three criteria of
//! smoothness side by side; the one of degree 7 with its control points; a rational one of degree 5; a triangle of great
//! circles. Zebra stripes show that the surfaces are smooth, colours their Gaussian curvature, and thin tubes the
//! boundaries, which a strip of paper could be laid along.

use std::array::from_fn;

use anyhow::{Result, ensure};
use bezier_mass::{BezierCurve, BezierPatch};
use glam::{DVec2, DVec3, dvec2, dvec3};
use reconstruct::{
    AnalyticCurve, BezierStrip, CoonsPatch, CornerData, Corners, Criterion, Curvatures, Curve,
    Degree7Shape, Error, FrenetFrame, GeodesicStrip, Rectangle, Series, Surface, Triangle,
    TrianglePatch, boundary_geodesic_curvature, degree7_boundaries, rational_quintic_boundaries,
    tessellate_triangle,
};

use crate::color::{BLUE, Color, ColorMap, GREEN, INK, ORANGE, VERMILION};
use crate::demo::{Context, Demo};
use crate::export::{Part, Step};
use crate::figure::{Figure, Plot};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
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
        let corners = corners(self.bend)?;
        let curves = degree7_boundaries(&corners, &Degree7Shape::default())?;
        // The criteria are those of Section 3.6, with frames; the Bézier patches are those of Section 3.7.
        let frames = Rectangle::new(frame_strips(&curves)?)?;
        let mut worst = Worst {
            curvature: 0.0,
            c3: frames.report().c3_residual,
        };
        let patches = criteria(context, &frames, &mut worst)?;
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
        draw(context, &drawn)?;
        export(context, &degree7, &rational, &filled)
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

/// Corner data read off the graph `z = h (x² / 4 - y² / 6) + x y / 12` at a crooked quadrangle; the
/// directions of the boundaries are chosen in the tangent planes.
fn corners(height: f64) -> Result<Corners, Error> {
    let at = |x: f64, y: f64, along_u: DVec2, along_v: DVec2| {
        let (a, b) = (height / 2.0, -height / 3.0);
        let z = 0.5 * (a * x * x + b * y * y) + x * y / 12.0;
        let (fx, fy) = (a * x + y / 12.0, b * y + x / 12.0);
        let second = [a, 1.0 / 12.0, b];
        let tangent = |d: DVec2| dvec3(d.x, d.y, fx * d.x + fy * d.y);
        let normal = dvec3(-fx, -fy, 1.0);
        // Normal curvature: second over first fundamental form.
        let curvature = |d: DVec2| {
            let bend = second[0] * d.x * d.x + 2.0 * second[1] * d.x * d.y + second[2] * d.y * d.y;
            bend / (normal.length() * tangent(d).length_squared())
        };
        let (u, v) = (tangent(along_u), tangent(along_v));
        CornerData::new(
            dvec3(x, y, z),
            normal,
            [u, v],
            [curvature(along_u), curvature(along_v)],
        )
    };
    Ok([
        [
            at(-1.5, -1.3, dvec2(1.0, 0.08), dvec2(-0.05, 1.0))?,
            at(-1.6, 1.4, dvec2(1.0, 0.1), dvec2(-0.1, 1.0))?,
        ],
        [
            at(1.6, -1.2, dvec2(1.0, -0.05), dvec2(0.05, 1.0))?,
            at(1.4, 1.6, dvec2(1.0, 0.02), dvec2(-0.08, 1.0))?,
        ],
    ])
}

fn strips(curves: &[BezierCurve<DVec3>; 4]) -> Result<[BezierStrip; 4], Error> {
    let [a, b, c, d] = curves.clone().map(BezierStrip::new);
    Ok([a?, b?, c?, d?])
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
        plot.polyline(&points, color.line().label(CRITERIA[c].1));
        plot.points(&points, crate::figure::Marker::Disc, color.fill());
    }
    plot.log_y();
    context.figure(
        "figure-energies",
        &Figure::new(plot),
        "Each patch measured by each criterion, over that criterion's own minimum: 1 (speed), 2 (Dirichlet), 3 (thin plate).",
        "Three lines over three criteria, each touching one where its own criterion was minimised.",
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

/// Three great circles of the unit sphere.
fn triangle() -> Result<Triangle, Error> {
    let corners = [
        dvec3(1.0, 0.0, -0.2),
        dvec3(0.1, 1.0, -0.1),
        dvec3(0.25, 0.3, 0.9),
    ]
    .map(DVec3::normalize);
    let side = |k: usize| {
        let (a, b) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let (across, angle) = ((b - a * a.dot(b)).normalize(), a.angle_between(b));
        GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
            let (sin, cos) = (t * angle).sin_cos();
            from_fn(|k| cos * a[k] + sin * across[k])
        }))
    };
    Triangle::new([side(0)?, side(1)?, side(2)?])
}

/// Boundaries that violate one condition each: every one must be refused, and by its name.
fn bad_sets(
    context: &mut Context,
    corners: &Corners,
    curves: &[BezierCurve<DVec3>; 4],
) -> Result<()> {
    let moved = |index: usize, offset: DVec3| -> Result<[BezierCurve<DVec3>; 4]> {
        let mut points: Vec<DVec3> = curves[0]
            .control()
            .iter()
            .filter_map(|h| h.position())
            .collect();
        points[index] += offset;
        let mut damaged = curves.clone();
        damaged[0] = BezierCurve::polynomial(&points)?;
        Ok(damaged)
    };
    let [_, along_v] = corners[0][0].tangents();
    // The bend of one corner turned around makes the normal reverse once more (Fig. 3.18, right).
    let mut reversed = *corners;
    let corner = &corners[1][1];
    let [k, l] = corner.curvatures();
    reversed[1][1] = CornerData::new(corner.point(), corner.normal(), corner.tangents(), [-k, l])?;
    let twice = [
        curves[0].clone(),
        curves[0].clone(),
        curves[2].clone(),
        curves[3].clone(),
    ];
    let sets = [
        ("corner mismatch", moved(0, along_v * 0.05)?),
        ("C1", moved(2, along_v * 0.05)?),
        ("C3", moved(3, along_v * 0.05)?),
        (
            "C2",
            degree7_boundaries(&reversed, &Degree7Shape::default())?,
        ),
        ("parallel tangents", twice),
    ];
    let mut refused = 0;
    for (name, set) in &sets {
        if let Err(Error::Conditions(violations)) = Rectangle::new(strips(set)?) {
            refused += usize::from(violations.iter().any(|v| v.name() == *name));
        }
    }
    context.number("bad_sets", sets.len(), Target::exactly(5));
    context.number("bad_sets_refused", refused, Target::exactly(sets.len()));
    Ok(())
}

fn patch_mesh(surface: &impl Surface, steps: usize) -> Mesh {
    Mesh::grid(steps, steps, |u, v| {
        (surface.point(u, v), surface.normal(u, v))
    })
}

fn triangle_mesh(patch: &TrianglePatch, steps: usize) -> Result<Mesh> {
    let mesh = tessellate_triangle(patch, steps);
    let index = |triangle: &[usize; 3]| triangle.map(|i| i as u32);
    let triangles = mesh.triangles.iter().map(index).collect();
    let made = Mesh::new(mesh.points, mesh.normals, triangles);
    made.check()?;
    Ok(made)
}

fn boundary_tubes<'a>(curves: impl IntoIterator<Item = &'a BezierCurve<DVec3>>) -> Mesh {
    Mesh::merged(curves.into_iter().map(|curve| {
        let points: Vec<DVec3> = (0..=80)
            .map(|i| Curve::point(curve, f64::from(i) / 80.0))
            .collect();
        Mesh::tube(&points, 0.018, false)
    }))
}

/// Gaussian curvature at the vertices of a grid.
fn with_curvature(mesh: Mesh, surface: &impl Surface, steps: usize) -> (Mesh, f64) {
    let parameter = |i: usize| i as f64 / steps as f64;
    let mut values = Vec::with_capacity((steps + 1) * (steps + 1));
    for j in 0..=steps {
        for i in 0..=steps {
            values.push(Curvatures::of(&surface.partials(parameter(i), parameter(j))).gaussian);
        }
    }
    let mut sizes: Vec<f64> = values.iter().map(|k| k.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    // A few extreme corners must not wash out the rest.
    let bound = sizes[sizes.len() * 49 / 50];
    (mesh.with_scalar(values), bound)
}

/// What the pictures show.
struct Drawn<'a> {
    patches: &'a [CoonsPatch],
    degree7: &'a BezierPatch<DVec3>,
    curves: &'a [BezierCurve<DVec3>; 4],
    rational: &'a BezierPatch<DVec3>,
    quintics: &'a [BezierCurve<DVec3>; 4],
    triangle: &'a TrianglePatch,
}

fn draw(context: &mut Context, drawn: &Drawn<'_>) -> Result<()> {
    let Drawn {
        patches,
        degree7,
        curves,
        rational,
        quintics,
        triangle,
    } = *drawn;
    let steps = context.pick(160, 40);
    let apart = |mesh: Mesh, k: usize| {
        mesh.transformed(glam::DAffine3::from_translation(DVec3::X * 4.0 * k as f64))
    };
    let mut three = Scene::new();
    for (k, patch) in patches.iter().enumerate() {
        three.add(apart(patch_mesh(patch, steps), k), Material::zebra())?;
        three.add(apart(boundary_tubes(curves), k), Material::matte(VERMILION))?;
    }
    three.ground_below();
    let camera = three.camera(dvec3(0.15, -1.0, 1.1), context.aspect());
    context.render(
        "render-criteria",
        &three,
        &camera,
        "One boundary of degree 7 under criteria 1, 2 and 3 (Fig. 3.20): speed variation, Dirichlet, thin plate.",
        "Three saddle-like patches side by side in zebra stripes, each framed by four red tubes.",
    )?;

    let mut built = Scene::new();
    built.add(
        patch_mesh(degree7, steps),
        Material::glossy(Color::hex(0x7fb2d9)),
    )?;
    built.add(boundary_tubes(curves), Material::matte(VERMILION))?;
    add_polygons(&mut built, curves)?;
    let offset = glam::DAffine3::from_translation(DVec3::X * 4.2);
    built.add(
        patch_mesh(rational, steps).transformed(offset),
        Material::glossy(Color::hex(0xf0c987)),
    )?;
    built.add(
        boundary_tubes(quintics).transformed(offset),
        Material::matte(VERMILION),
    )?;
    built.ground_below();
    let camera = built.camera(dvec3(0.2, -1.0, 1.0), context.aspect());
    context.render(
        "render-bezier",
        &built,
        &camera,
        "Left the bidegree-13 patch on boundaries of degree 7 with their control polygons (Figs 3.23, 3.24), right the rational one on quintics (Fig. 3.26).",
        "A blue and a golden patch with red boundaries; thin dark polygons with beads run beside the blue one.",
    )?;

    let mut coloured = Scene::new();
    // `Mesh::grid` runs along u first; so do the numbers.
    let (mesh, bound) = with_curvature(patch_mesh(&patches[2], steps), &patches[2], steps);
    ensure!(mesh.scalar.is_some(), "the mesh carries its curvature");
    coloured.add(
        mesh,
        Material::scalar(ColorMap::Diverging, -bound, bound).isolines(bound / 4.0),
    )?;
    coloured.add(boundary_tubes(curves), Material::matte(INK))?;
    coloured.layer("curvature.K").ground_below();
    let camera = coloured.camera(dvec3(0.25, -1.0, 1.0), context.aspect());
    context.render(
        "render-curvature",
        &coloured,
        &camera,
        "Gaussian curvature of the thin-plate patch, blue negative and red positive; the numbers are in the EXR layer curvature.K.",
        "A patch coloured from blue to red with dark isolines, framed by black tubes.",
    )?;

    let mut ball = Scene::new();
    ball.add(triangle_mesh(triangle, steps)?, Material::zebra())?;
    let sides: Vec<DVec3> = (0..=240)
        .map(|i| {
            let (k, t) = ((i / 80) % 3, f64::from(i % 80) / 80.0);
            let strips = triangle.triangle().strips();
            strips[k as usize].curve().point(t)
        })
        .collect();
    ball.add(
        Mesh::tube(&sides[..240], 0.008, true),
        Material::matte(VERMILION),
    )?;
    ball.ground_below();
    let camera = ball.camera(dvec3(1.0, 0.9, 0.6), context.aspect());
    context.render(
        "render-triangle",
        &ball,
        &camera,
        "A triangle of three great circles after smoothing (Fig. 3.21): it has found the sphere again to some thousandths.",
        "A bulging three-sided patch in zebra stripes with red sides.",
    )
}

/// Control polygons as thin tubes with beads.
fn add_polygons(scene: &mut Scene, curves: &[BezierCurve<DVec3>; 4]) -> Result<()> {
    for curve in curves {
        let points: Vec<DVec3> = curve
            .control()
            .iter()
            .filter_map(|h| h.position())
            .collect();
        scene.add(Mesh::tube(&points, 0.006, false), Material::matte(INK))?;
        let beads = points.iter().map(|p| Mesh::sphere(*p, 0.03, 1e-3));
        scene.add(Mesh::merged(beads), Material::glossy(ORANGE))?;
    }
    Ok(())
}

fn export(
    context: &mut Context,
    degree7: &BezierPatch<DVec3>,
    rational: &BezierPatch<DVec3>,
    triangle: &TrianglePatch,
) -> Result<()> {
    let steps = context.pick(60, 20);
    let (a, b) = (patch_mesh(degree7, steps), patch_mesh(rational, steps));
    let c = triangle_mesh(triangle, steps)?;
    context.meshes(
        "patches",
        &[
            Part::new("degree7", &a, BLUE),
            Part::new("rational5", &b, ORANGE),
            Part::new("triangle", &c, GREEN),
        ],
    )?;
    let mut step = Step::new("geodesic patches");
    step.patch(degree7)?.patch(rational)?;
    context.step("patches", &step)
}
