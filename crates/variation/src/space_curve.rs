//! Space curves and planes: hits, and bounds for their number.

use glam::DVec3;

use crate::Error;
use crate::arithmetic::roots_of;
use crate::bound::{ChainBound, chain_bound};
use crate::curve::check_weights;
use crate::line::{Plane, PlaneForm, check_finite};
use crate::root::{Interval, Roots};
use crate::solver::Solver;

fn check(points: &[DVec3], weights: Option<&[f64]>) -> Result<(), Error> {
    if points.is_empty() {
        return Err(Error::NoControlPoints);
    }
    for p in points {
        check_finite(p.to_array())?;
    }
    weights.map_or(Ok(()), |weights| check_weights(points.len(), weights))
}

/// The parameters at which a space curve, polynomial or rational, meets a plane.
///
/// # Errors
/// [`Error::NoControlPoints`], [`Error::NotFinite`], [`Error::WeightCount`], [`Error::WeightNotPositive`];
/// [`Error::LiesOn`] for a curve in the plane.
pub fn meet_plane(points: &[DVec3], weights: Option<&[f64]>, plane: Plane) -> Result<Roots, Error> {
    check(points, weights)?;
    let form = PlaneForm {
        points,
        weights,
        plane,
    };
    match roots_of(&form, Interval::UNIT, &mut Solver::new()) {
        Err(Error::IdenticallyZero) => Err(Error::LiesOn),
        found => found.map(Roots::from_slice),
    }
}

/// A bound for the number of points in which a space curve, polynomial or rational, meets a plane, without solving, by a
/// chain of poles. The polygon is that of the values `w_i (n . P_i + d)`, whose sign changes are the crossings of the control
/// polygon; decided in `f64`, so it holds for these numbers rounded.
///
/// ```
/// use variation::{Plane, glam::DVec3, plane_bound};
/// // The control polygon crosses the plane z = 0 twice; one pole shows that the curve misses it.
/// let points = [(0.0, 3.0), (1.0, -1.0), (2.0, 3.0)].map(|(x, z)| DVec3::new(x, 0.0, z));
/// let plane = Plane::try_new(DVec3::Z, 0.0)?;
/// assert_eq!(plane_bound(&points, None, plane, &[])?.best, 2);
/// assert_eq!(plane_bound(&points, None, plane, &[0.5])?.best, 0);
/// # Ok::<(), variation::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoControlPoints`], [`Error::NotFinite`], [`Error::WeightCount`], [`Error::WeightNotPositive`],
/// [`Error::TooManyPoles`], [`Error::PoleOutside`].
pub fn plane_bound(
    points: &[DVec3],
    weights: Option<&[f64]>,
    plane: Plane,
    poles: &[f64],
) -> Result<ChainBound<f64>, Error> {
    check(points, weights)?;
    let values: Vec<f64> = points
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let weight = weights.map_or(1.0, |weights| weights[i]);
            weight * (plane.normal().dot(*p) + plane.offset())
        })
        .collect();
    chain_bound(&values, poles)
}
