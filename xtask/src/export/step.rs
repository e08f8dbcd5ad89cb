//! STEP (ISO 10303-21, application protocol 242) with exact rational surfaces.
//!
//! CAD programs read a torus patch or a blend as it is, not as triangles. The subset written here is one
//! open shell of faces; each face is a rational B-spline surface bounded by its four boundary curves, and
//! neighbours share edges and vertices. `xtask/scripts/read_step.py` reads a file back with OpenCascade.

mod shell;
mod surface;
mod writer;

use anyhow::{Context, Result, bail};
use bezier_mass::{BSplineSurface, BezierPatch};
use glam::DVec3;

use surface::Surface;

/// How often a patch is halved so that its weights become positive, which STEP asks for.
const MOST_HALVINGS: u32 = 8;

/// A model: exact surfaces, written as one open shell.
#[derive(Clone, Debug)]
pub struct Step {
    name: String,
    surfaces: Vec<Surface>,
}

impl Step {
    /// An empty model under a name.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self {
            name: name.into(),
            surfaces: Vec::new(),
        }
    }

    /// Adds a rational patch. One with vectors or negative weights among its control points, or with
    /// coinciding opposite sides, is halved until STEP can express it; the surface stays exact.
    ///
    /// # Errors
    /// A patch that reaches infinity.
    pub fn patch(&mut self, patch: &BezierPatch<DVec3>) -> Result<&mut Self> {
        let before = self.surfaces.len();
        if let Err(error) = self.add(patch, MOST_HALVINGS) {
            self.surfaces.truncate(before);
            return Err(error).context("STEP cannot express the patch");
        }
        Ok(self)
    }

    fn add(&mut self, patch: &BezierPatch<DVec3>, halvings: u32) -> Result<()> {
        if let Some(surface) = Surface::from_patch(patch) {
            let [u_closed, v_closed] = surface.closed();
            if !u_closed && !v_closed {
                self.surfaces.push(surface);
                return Ok(());
            }
            let (first, second) = if u_closed {
                patch.subdivide_u(0.5)
            } else {
                patch.subdivide_v(0.5)
            };
            self.add(&first, halvings)?;
            return self.add(&second, halvings);
        }
        if halvings == 0 {
            bail!("a weight vanishes on it");
        }
        // Cut across the direction in which the weights change their kind.
        let [_, n] = patch.degrees();
        let across_v = patch
            .rows()
            .any(|row| is_mixed(row.iter().map(|m| m.weight)));
        let across_u =
            (0..=n).any(|j| is_mixed(patch.rows().filter_map(|row| row.get(j)).map(|m| m.weight)));
        let (first, second) = if across_u || !across_v {
            patch.subdivide_u(0.5)
        } else {
            patch.subdivide_v(0.5)
        };
        self.add(&first, halvings - 1)?;
        self.add(&second, halvings - 1)
    }

    /// Adds a rational B-spline surface: as it is if it is clamped, open and of positive weights, as its
    /// Bézier patches otherwise.
    ///
    /// # Errors
    /// A surface that reaches infinity.
    pub fn surface(&mut self, surface: &BSplineSurface<DVec3>) -> Result<&mut Self> {
        if let Some(whole) =
            Surface::from_spline(surface).filter(|whole| whole.closed() == [false; 2])
        {
            self.surfaces.push(whole);
            return Ok(self);
        }
        let before = self.surfaces.len();
        for piece in surface.pieces() {
            if let Err(error) = self.patch(&piece.patch) {
                self.surfaces.truncate(before);
                return Err(error);
            }
        }
        Ok(self)
    }

    /// Number of faces so far.
    #[must_use]
    pub const fn face_count(&self) -> usize {
        self.surfaces.len()
    }

    /// The file.
    #[must_use]
    pub fn text(&self) -> String {
        shell::text(&self.name, &self.surfaces)
    }
}

/// Whether weights differ in sign, zero being a sign of its own.
fn is_mixed(mut weights: impl Iterator<Item = f64>) -> bool {
    let sign = |weight: f64| if weight == 0.0 { 0.0 } else { weight.signum() };
    let first = weights.next().map(sign);
    weights.any(|weight| Some(sign(weight)) != first)
}

#[cfg(test)]
mod tests;
