//! What the sensors of a ribbon amount to.

use crate::{Error, SpatialRibbon};
use glam::{DMat3, DVec3};
use nalgebra::DMatrix;

/// Unit tangents at given arc lengths, with how they depend on the readings.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredTangents", into = "StoredTangents")
)]
pub struct Tangents {
    pub(super) s: Vec<f64>,
    pub(super) values: Vec<DVec3>,
    pub(super) sensitivity: DMatrix<f64>,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "Tangents")]
struct StoredTangents {
    s: Vec<f64>,
    values: Vec<DVec3>,
    /// Column by column, three rows a tangent.
    sensitivity: Vec<f64>,
}

#[cfg(feature = "serde")]
impl From<Tangents> for StoredTangents {
    fn from(tangents: Tangents) -> Self {
        Self {
            s: tangents.s,
            values: tangents.values,
            sensitivity: tangents.sensitivity.as_slice().to_vec(),
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredTangents> for Tangents {
    type Error = Error;

    fn try_from(stored: StoredTangents) -> Result<Self, Error> {
        let StoredTangents {
            s,
            values,
            sensitivity,
        } = stored;
        crate::spline::check_increasing(&s)?;
        if values.len() != s.len() {
            return Err(Error::LengthMismatch {
                what: "tangents",
                expected: s.len(),
                got: values.len(),
            });
        }
        if !values.iter().all(|t| t.is_normalized()) {
            return Err(Error::Stored {
                what: "lengths of unit tangents",
            });
        }
        // Three coordinates a tangent by three a sensor.
        let whole = sensitivity.len().is_multiple_of(9 * s.len());
        if !(whole && sensitivity.iter().all(|x| x.is_finite())) {
            return Err(Error::Stored {
                what: "derivatives by the readings",
            });
        }
        let columns = sensitivity.len() / (3 * s.len());
        let sensitivity = DMatrix::from_vec(3 * s.len(), columns, sensitivity);
        Ok(Self {
            s,
            values,
            sensitivity,
        })
    }
}

impl Tangents {
    /// The arc lengths.
    #[must_use]
    pub fn arc_lengths(&self) -> &[f64] {
        &self.s
    }

    /// The unit tangents in the world frame.
    #[must_use]
    pub fn values(&self) -> &[DVec3] {
        &self.values
    }

    /// The ribbon through these tangents.
    ///
    /// # Errors
    /// As [`SpatialRibbon::new`].
    pub fn ribbon(&self) -> Result<SpatialRibbon, Error> {
        SpatialRibbon::new(&self.s, &self.values)
    }

    /// The covariance of the position at every place of `ribbon` (which must come from
    /// [`Tangents::ribbon`]), when every coordinate of every reading, in units of its field, carries an
    /// independent error of standard deviation `sigma`. First order: readings to tangents to positions, each
    /// step by its exact derivative.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another ribbon.
    pub fn position_covariance(
        &self,
        ribbon: &SpatialRibbon,
        sigma: f64,
    ) -> Result<Vec<DMat3>, Error> {
        if ribbon.tangents().len() != self.values.len() {
            let (expected, got) = (self.values.len(), ribbon.tangents().len());
            return Err(Error::LengthMismatch {
                what: "tangents of the ribbon",
                expected,
                got,
            });
        }
        Ok(ribbon
            .positions_sensitivity()
            .iter()
            .map(|row| {
                let by_tangents =
                    DMatrix::from_fn(3, 3 * row.len(), |i, j| row[j / 3].col(j % 3)[i]);
                let by_readings = by_tangents * &self.sensitivity;
                let covariance = &by_readings * by_readings.transpose() * (sigma * sigma);
                DMat3::from_cols_array(&core::array::from_fn(|n| covariance[(n % 3, n / 3)]))
            })
            .collect())
    }
}
