//! Fronts in space as grids of exact rays.

use bezier_mass::BezierPatch;
use glam::DVec3;

use super::{Mirror, SpacePoint};
use crate::Error;

/// A front as a grid of rays: points and normals at time zero, which may lie behind their mirror.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredGrid",
        into = "crate::stored::StoredGrid"
    )
)]
pub struct SampledSurface {
    columns: usize,
    points: Vec<SpacePoint>,
}

impl SampledSurface {
    /// The rays `ray(u, v)` over the unit square, on a grid.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for less than two rows or columns; [`Error::ZeroDirection`] where there is no ray.
    pub fn new(
        columns: usize,
        rows: usize,
        ray: impl Fn(f64, f64) -> Option<SpacePoint>,
    ) -> Result<Self, Error> {
        if columns < 2 || rows < 2 {
            return Err(Error::OutOfRange {
                what: "the number of rows and columns",
                value: columns.min(rows) as f64,
            });
        }
        let share = |i: usize, count: usize| i as f64 / (count - 1) as f64;
        let at = |i: usize| {
            ray(share(i % columns, columns), share(i / columns, rows)).ok_or(Error::ZeroDirection {
                what: "the normal of a front",
            })
        };
        Ok(Self {
            columns,
            points: (0..columns * rows).map(at).collect::<Result<_, _>>()?,
        })
    }

    /// Rays that are given row by row.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for less than two rows or columns, or an incomplete row.
    pub fn from_rays(columns: usize, rays: Vec<SpacePoint>) -> Result<Self, Error> {
        if columns < 2 || rays.len() < 2 * columns || !rays.len().is_multiple_of(columns) {
            return Err(Error::OutOfRange {
                what: "the number of rows and columns",
                value: rays.len() as f64 / columns as f64,
            });
        }
        Ok(Self {
            columns,
            points: rays,
        })
    }

    /// The rays of a patch along its normals.
    ///
    /// # Errors
    /// As [`SampledSurface::new`].
    pub fn of_patch(
        patch: &BezierPatch<DVec3>,
        columns: usize,
        rows: usize,
    ) -> Result<Self, Error> {
        Self::new(columns, rows, |u, v| {
            let jet = patch.jet(u, v);
            Some(SpacePoint {
                point: jet.position()?,
                normal: jet.normal()?,
            })
        })
    }

    /// Number of columns of the grid.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The rays, row by row.
    #[must_use]
    pub fn rays(&self) -> &[SpacePoint] {
        &self.points
    }

    /// The front after running `distance`.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        let moved = |ray: &SpacePoint| SpacePoint {
            point: ray.point + distance * ray.normal,
            ..*ray
        };
        Self {
            columns: self.columns,
            points: self.points.iter().map(moved).collect(),
        }
    }

    /// The front after reflection in a mirror, at time zero again: each ray exactly, set back behind the mirror by the
    /// distance that it ran to it.
    ///
    /// # Errors
    /// [`Error::Miss`] with the place (its x and y) of the first ray that does not meet the mirror.
    pub fn reflect(&self, mirror: &Mirror) -> Result<Self, Error> {
        let reflected = |ray: &SpacePoint| {
            let (distance, normal) = mirror.hit(*ray).ok_or(Error::Miss {
                from: ray.point.truncate(),
            })?;
            let hit = ray.point + distance * ray.normal;
            let turned = ray.normal - 2.0 * ray.normal.dot(normal) * normal;
            Ok(SpacePoint {
                point: hit - distance * turned,
                normal: turned,
            })
        };
        Ok(Self {
            columns: self.columns,
            points: self
                .points
                .iter()
                .map(reflected)
                .collect::<Result<_, Error>>()?,
        })
    }

    /// How far neighbouring rays are from being normal to one surface: the largest sine of the angle between a chord of the
    /// grid and the mean of the two normals. By the theorem of Malus and Dupin it falls with the square of the step.
    #[must_use]
    pub fn normality_defect(&self) -> f64 {
        let across = |a: &SpacePoint, b: &SpacePoint| {
            let mean = (a.normal + b.normal).normalize_or_zero();
            (b.point - a.point).normalize_or_zero().dot(mean).abs()
        };
        let rows = self.points.chunks(self.columns);
        let along = rows
            .clone()
            .flat_map(|row| row.windows(2))
            .map(|pair| across(&pair[0], &pair[1]));
        let between = self
            .points
            .iter()
            .zip(self.points.iter().skip(self.columns))
            .map(|(a, b)| across(a, b));
        along.chain(between).fold(0.0, f64::max)
    }
}
