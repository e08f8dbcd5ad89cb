//! Closed geodesics: tightening a loop (Section 2.3 of the thesis, Figs. 2.10 to 2.12).

mod cycle;
mod rebase;
mod through;
mod tighten;

pub(crate) use cycle::strip_along;
pub use through::DirectedLoop;
pub use tighten::LoopFinder;

use crate::mesh::Mesh;
use crate::path::{Certificate, GeodesicPath, certify};
use crate::{Error, SurfacePoint};

/// A closed curve on a mesh, made by [`LoopFinder`]: a path that ends where it begins.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GeodesicLoop {
    path: GeodesicPath,
    turn: f64,
}

impl GeodesicLoop {
    /// The loop as a path from its first point round to the same point.
    #[must_use]
    pub fn path(&self) -> &GeodesicPath {
        &self.path
    }

    /// Length of the loop.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.path.length
    }

    /// How far the smaller side angle at the first point falls short of π, in radians: 0 for a closed geodesic, the
    /// closing corner for a loop held at a point.
    #[must_use]
    pub fn turn(&self) -> f64 {
        self.turn
    }

    /// All vertices that the loop passes, the first point included if it is one.
    #[must_use]
    pub fn vertices(&self) -> Vec<u32> {
        let first = match self.path.points.first() {
            Some(&SurfacePoint::Vertex(v)) => Some(v),
            _ => None,
        };
        first
            .into_iter()
            .chain(self.path.pivots.iter().map(|pivot| pivot.vertex))
            .collect()
    }

    /// Examines the loop anew, from its points alone: as [`GeodesicPath::certify`], through the first point as well.
    ///
    /// # Errors
    ///
    /// As for [`GeodesicPath::certify`].
    pub fn certify(&self, mesh: &Mesh) -> Result<Certificate, Error> {
        // Twice round: every point is then passed once between two others.
        let mut points = self.path.points.clone();
        points.extend(self.path.points.iter().skip(1));
        let faces = [self.path.faces(), self.path.faces()].concat();
        let certificate = certify(mesh, &points, &faces)?;
        Ok(Certificate {
            length: certificate.length / 2.0,
            ..certificate
        })
    }
}
