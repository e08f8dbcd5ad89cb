//! From the design data to curves of spheres, and from these to meshes.

use std::f64::consts::TAU;

use anyhow::{Context as _, Result, ensure};
use glam::{DAffine3, DMat3, DVec3};
use lorentz::construct::{circle_to_point, circle_to_sphere, cone_between_radii};
use lorentz::{
    CanalChain, CanalCurve, CharacteristicCircle, LorentzMap, Pencil, Plane, Point, Sphere,
    SphereVector,
};
use serde::Deserialize;

use crate::mesh::{Mesh, chord_steps};

/// The design: what the curves of spheres have to pass through. Lengths in units of the model, angles in radians.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Design {
    tail_tip: [f64; 3],
    tail_circle: TailCircle,
    spheres: Vec<Ball>,
    dorsal_fin: Fin,
    eyes: Vec<Ball>,
    coronet: Coronet,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TailCircle {
    centre: [f64; 3],
    radius: f64,
    /// The axis is (cos, 0, sin) of this angle.
    axis_angle: f64,
    /// Angle of the first sphere in the pencil of spheres through the circle.
    pencil_angle: f64,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ball {
    centre: [f64; 3],
    radius: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Fin {
    vertex: [f64; 3],
    sphere: Ball,
    radii: [f64; 2],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Coronet {
    centre: [f64; 3],
    semi_axes: [f64; 3],
}

/// The seahorse as surfaces.
#[derive(Debug)]
pub(super) struct Seahorse {
    /// Tail, body and head, from the tip of the tail to the snout.
    pub(super) body: CanalChain,
    /// A piece of a cone (Algorithm 1, Lemma 2).
    pub(super) fin: CanalCurve,
    pub(super) eyes: Vec<Sphere>,
    coronet: DAffine3,
}

impl Ball {
    fn sphere(self) -> Result<Sphere> {
        Ok(Sphere::new(self.centre.into(), self.radius)?)
    }
}

impl Seahorse {
    /// Builds every curve from the previous one, as in Section 4.2 of the paper.
    pub(super) fn new(design: &Design) -> Result<Self> {
        let fin = &design.dorsal_fin;
        let coronet = &design.coronet;
        Ok(Self {
            body: body(design)?,
            fin: cone_between_radii(fin.vertex.into(), fin.sphere.sphere()?, fin.radii)?.curve,
            eyes: design
                .eyes
                .iter()
                .map(|eye| eye.sphere())
                .collect::<Result<_>>()?,
            coronet: DAffine3::from_translation(coronet.centre.into())
                * DAffine3::from_scale(coronet.semi_axes.into()),
        })
    }

    /// The mirror image in a plane: every curve of spheres mapped by a reflection of the Lorentz space.
    pub(super) fn mirrored(&self, plane: Plane) -> Result<Self> {
        let map = LorentzMap::inversion(plane.into());
        let body = self
            .body
            .arcs()
            .iter()
            .map(|arc| arc.mapped(&map))
            .collect::<Result<_, _>>()?;
        let mirror = |sphere: &Sphere| -> Result<Sphere> {
            let image = map.map_sphere((*sphere).into()).object()?;
            image
                .sphere()
                .context("the mirror image of a sphere is a sphere")
        };
        let n = plane.normal();
        let reflection = DMat3::IDENTITY - 2.0 * DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        Ok(Self {
            body: CanalChain::new(body)?,
            fin: self.fin.mapped(&map)?,
            eyes: self.eyes.iter().map(mirror).collect::<Result<_>>()?,
            coronet: DAffine3::from_mat3_translation(reflection, 2.0 * plane.offset() * n)
                * self.coronet,
        })
    }

    /// The direction in which the snout points, level.
    pub(super) fn forward(&self) -> DVec3 {
        let ends = self
            .body
            .arcs()
            .last()
            .map(|arc| [0.0, 1.0].map(|t| arc.at(t).circle()));
        match ends {
            Some(
                [
                    Ok(CharacteristicCircle::Circle(from)),
                    Ok(CharacteristicCircle::Circle(to)),
                ],
            ) => (to.centre() - from.centre())
                .with_z(0.0)
                .normalize_or(DVec3::NEG_X),
            _ => DVec3::NEG_X,
        }
    }

    /// The whole body as one mesh, with the snout and the end of the fin closed by caps of their last spheres.
    pub(super) fn body_mesh(&self, tolerance: f64) -> Result<Mesh> {
        let mut mesh = Mesh::default();
        for arc in self.body.arcs() {
            mesh.append(Mesh::canal(arc, [0.0, 1.0], tolerance)?);
        }
        Ok(mesh)
    }

    pub(super) fn fin_mesh(&self, tolerance: f64) -> Result<Mesh> {
        let mut mesh = Mesh::canal(&self.fin, [0.0, 1.0], tolerance)?;
        mesh.append(disc(&self.fin, tolerance)?);
        Ok(mesh)
    }

    pub(super) fn mouth_mesh(&self, tolerance: f64) -> Result<Mesh> {
        match self.body.arcs().last() {
            Some(last) => disc(last, tolerance),
            None => Ok(Mesh::default()),
        }
    }

    pub(super) fn coronet_mesh(&self, tolerance: f64) -> Mesh {
        let stretch = (self.coronet.matrix3 * DVec3::ONE).abs();
        Mesh::sphere(DVec3::ZERO, 1.0, tolerance / stretch.max_element()).transformed(self.coronet)
    }
}

/// The chain of cyclide pieces: the tail from its tip to the circle, then from each circle to the next sphere.
fn body(design: &Design) -> Result<CanalChain> {
    ensure!(!design.spheres.is_empty(), "the design has no spheres");
    let ring = &design.tail_circle;
    let great = Sphere::new(ring.centre.into(), ring.radius)?;
    let axis = DVec3::new(ring.axis_angle.cos(), 0.0, ring.axis_angle.sin());
    let pencil = Pencil::new(great.into(), Plane::new(axis, great.centre())?.into())?;
    let mut sphere = pencil.member(ring.pencil_angle);
    let mut derivative = SphereVector::along(pencil.derivative(ring.pencil_angle))?;
    let tip = Point::new(design.tail_tip.into())?;
    let mut arcs = vec![circle_to_point(sphere, derivative, tip)?.curve.reversed()];
    for ball in &design.spheres {
        let next = SphereVector::from(ball.sphere()?);
        let arc = circle_to_sphere(sphere, derivative, next)?;
        ensure!(
            arc.is_good_joint(),
            "the arc to the sphere about {:?} passes a singular point",
            ball.centre
        );
        derivative = arc.curve.at(1.0).derivative_sphere().unwrap_or(derivative);
        sphere = next;
        arcs.push(arc.curve);
    }
    Ok(CanalChain::new(arcs)?)
}

/// The disc in the last circle of a canal surface.
fn disc(curve: &CanalCurve, tolerance: f64) -> Result<Mesh> {
    let Some(circle) = curve.at(1.0).circle()?.circle() else {
        return Ok(Mesh::default());
    };
    let (u, v) = circle.frame(curve.reference())?;
    let steps = chord_steps(circle.radius(), TAU * circle.radius(), tolerance);
    Ok(Mesh::grid(steps, 1, |turn, out| {
        let (sin, cos) = (TAU * turn).sin_cos();
        (
            circle.centre() + out * circle.radius() * (cos * u + sin * v),
            circle.axis(),
        )
    }))
}
