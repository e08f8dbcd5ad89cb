//! The pictures of the patches, and their files.

use anyhow::Result;
use bezier_mass::{BezierCurve, BezierPatch};
use glam::{DAffine3, DVec3, dvec3};
use reconstruct::{CoonsPatch, Curvatures, Curve, Surface, TrianglePatch, tessellate_triangle};

use crate::color::{BLUE, Color, ColorMap, GREEN, INK, ORANGE, VERMILION};
use crate::demo::Context;
use crate::export::{Part, Step};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

/// What the pictures show.
pub(super) struct Drawn<'a> {
    pub(super) patches: &'a [CoonsPatch],
    pub(super) degree7: &'a BezierPatch<DVec3>,
    pub(super) curves: &'a [BezierCurve<DVec3>; 4],
    pub(super) rational: &'a BezierPatch<DVec3>,
    pub(super) quintics: &'a [BezierCurve<DVec3>; 4],
    pub(super) triangle: &'a TrianglePatch,
}

impl Drawn<'_> {
    pub(super) fn render(&self, context: &mut Context) -> Result<()> {
        self.render_criteria(context)?;
        self.render_bezier(context)?;
        self.render_curvature(context)?;
        self.render_triangle(context)
    }

    /// Fig. 3.20: one boundary under the three criteria, side by side.
    fn render_criteria(&self, context: &mut Context) -> Result<()> {
        let steps = steps(context);
        let apart = |mesh: Mesh, k: usize| {
            mesh.transformed(DAffine3::from_translation(DVec3::X * 4.0 * k as f64))
        };
        let mut three = Scene::new();
        for (k, patch) in self.patches.iter().enumerate() {
            three.add(apart(patch_mesh(patch, steps), k), Material::zebra())?;
            three.add(
                apart(boundary_tubes(self.curves), k),
                Material::matte(VERMILION),
            )?;
        }
        three.ground_below();
        let camera = three.camera(dvec3(0.08, -1.0, 1.2), context.aspect_or(2.4));
        context.render(
            "render-criteria",
            &three,
            &camera,
            "One boundary of degree 7 under criteria 1, 2 and 3 (Fig. 3.20): speed variation, Dirichlet, thin plate.",
            "Three saddle-like patches side by side in zebra stripes, each framed by four red tubes.",
        )
    }

    /// Figs 3.23, 3.24 and 3.26: the Bézier patches.
    fn render_bezier(&self, context: &mut Context) -> Result<()> {
        let steps = steps(context);
        let mut built = Scene::new();
        built.add(
            patch_mesh(self.degree7, steps),
            Material::glossy(Color::hex(0x7fb2d9)),
        )?;
        built.add(boundary_tubes(self.curves), Material::matte(VERMILION))?;
        add_polygons(&mut built, self.curves)?;
        let offset = DAffine3::from_translation(DVec3::X * 4.2);
        built.add(
            patch_mesh(self.rational, steps).transformed(offset),
            Material::glossy(Color::hex(0xf0c987)),
        )?;
        built.add(
            boundary_tubes(self.quintics).transformed(offset),
            Material::matte(VERMILION),
        )?;
        built.ground_below();
        let camera = built.camera(dvec3(0.1, -1.0, 1.05), context.aspect_or(1.9));
        context.render(
            "render-bezier",
            &built,
            &camera,
            "Left the bidegree-13 patch on boundaries of degree 7 with their control polygons (Figs 3.23, 3.24), right the rational one on quintics (Fig. 3.26).",
            "A blue and a golden patch with red boundaries; thin dark polygons with beads run beside the blue one.",
        )
    }

    /// The Gaussian curvature of the thin-plate patch.
    fn render_curvature(&self, context: &mut Context) -> Result<()> {
        let steps = steps(context);
        let mut coloured = Scene::new();
        // `Mesh::grid` runs along u first; so do the numbers.
        let (mesh, bound) =
            with_curvature(patch_mesh(&self.patches[2], steps), &self.patches[2], steps);
        coloured.add(
            mesh,
            Material::scalar(ColorMap::Diverging, -bound, bound).isolines(bound / 4.0),
        )?;
        coloured.add(boundary_tubes(self.curves), Material::matte(INK))?;
        coloured.layer("curvature.K").ground_below();
        let camera = coloured.camera(dvec3(0.25, -1.0, 1.0), context.aspect_or(1.5));
        context.render(
            "render-curvature",
            &coloured,
            &camera,
            "Gaussian curvature of the thin-plate patch, blue negative and red positive; the numbers are in the EXR layer curvature.K.",
            "A patch coloured from blue to red with dark isolines, framed by black tubes.",
        )
    }

    /// Fig. 3.21: the triangle of great circles.
    fn render_triangle(&self, context: &mut Context) -> Result<()> {
        let steps = steps(context);
        let mut ball = Scene::new();
        let mesh = triangle_mesh(self.triangle, steps)?;
        let off_sphere = mesh
            .positions
            .iter()
            .map(|p| (p.length() - 1.0).abs())
            .fold(0.0, f64::max);
        context.number("triangle_off_sphere_max", off_sphere, Target::AtMost(0.01));
        ball.add(mesh, Material::zebra())?;
        let sides: Vec<DVec3> = (0..=240)
            .map(|i| {
                let (k, t) = ((i / 80) % 3, f64::from(i % 80) / 80.0);
                let strips = self.triangle.triangle().strips();
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
            &format!(
                "A triangle of three great circles after smoothing (Fig. 3.21): it has found the sphere again to {off_sphere:.1e} of its radius."
            ),
            "A bulging three-sided patch in zebra stripes with red sides.",
        )
    }

    /// Files for other programs.
    pub(super) fn export(&self, context: &mut Context) -> Result<()> {
        let steps = context.pick(60, 20);
        let (a, b) = (
            patch_mesh(self.degree7, steps),
            patch_mesh(self.rational, steps),
        );
        let c = triangle_mesh(self.triangle, steps)?;
        context.meshes(
            "patches",
            &[
                Part::new("degree7", &a, BLUE),
                Part::new("rational5", &b, ORANGE),
                Part::new("triangle", &c, GREEN),
            ],
        )?;
        let mut step = Step::new("geodesic patches");
        step.patch(self.degree7)?.patch(self.rational)?;
        context.step("patches", &step)
    }
}

/// Cells of a tessellation along each side.
fn steps(context: &Context) -> usize {
    context.pick(160, 40)
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
