//! Fronts in space: surfaces given by their support function, propagated and reflected.
//!
//! In space as in the plane a front is the envelope of its tangent planes, and propagation adds the time to their
//! distances. The support functions here are those of spheres and ellipsoids; a reflection in a plane maps planes to
//! planes and is exact. A reflection in a quadric has no such form: it is sampled ray by ray, exactly, on a grid.

use bezier_mass::BezierPatch;
use glam::{DMat3, DVec3};

use crate::Error;

/// A convex surface by the support function of its tangent planes: `p(N) = <centre, N> + |half_axes^T N| + distance`.
///
/// A sphere (no half axes), an ellipsoid, their offsets, and the mirror images of all these: rational in a rational
/// parametrisation of the normals wherever the ellipsoid is a sphere, and dual-quadratic before the offset otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredSurface",
        into = "crate::stored::StoredSurface"
    )
)]
pub struct DualSurface {
    centre: DVec3,
    half_axes: DMat3,
    distance: f64,
}

/// A point of a surface with its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpacePoint {
    /// The point.
    pub point: DVec3,
    /// The unit normal, the direction in which the front runs.
    pub normal: DVec3,
}

/// A mirror in space: `xᵀ form x + 2 <linear, x> + constant = 0`, a plane if the form vanishes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredMirror",
        into = "crate::stored::StoredMirror"
    )
)]
pub struct Mirror {
    form: DMat3,
    linear: DVec3,
    constant: f64,
}

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

impl DualSurface {
    /// The front of a point source after the time in which it runs `radius` (0 for the point itself).
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn sphere(centre: DVec3, radius: f64) -> Result<Self, Error> {
        if !(centre.is_finite() && radius.is_finite()) {
            return Err(Error::NonFinite { what: "a sphere" });
        }
        Ok(Self {
            centre,
            half_axes: DMat3::ZERO,
            distance: radius,
        })
    }

    /// An ellipsoid with three conjugate half axes.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::OutOfRange`] with their volume if the half axes lie in a plane.
    pub fn ellipsoid(centre: DVec3, half_axes: [DVec3; 3]) -> Result<Self, Error> {
        let half_axes = DMat3::from_cols(half_axes[0], half_axes[1], half_axes[2]);
        if !(centre.is_finite() && half_axes.is_finite()) {
            return Err(Error::NonFinite {
                what: "an ellipsoid",
            });
        }
        let volume = half_axes.determinant().abs();
        if volume == 0.0 {
            return Err(Error::OutOfRange {
                what: "the volume of an ellipsoid's half axes",
                value: volume,
            });
        }
        Ok(Self {
            centre,
            half_axes,
            distance: 0.0,
        })
    }

    /// The distance of the tangent plane with this unit normal from the origin.
    #[must_use]
    pub fn support(&self, normal: DVec3) -> f64 {
        self.centre.dot(normal) + (self.half_axes.transpose() * normal).length() + self.distance
    }

    /// The point with this unit normal: the gradient of the support function.
    #[must_use]
    pub fn point(&self, normal: DVec3) -> DVec3 {
        let image = self.half_axes.transpose() * normal;
        self.centre + self.half_axes * image.normalize_or_zero() + self.distance * normal
    }

    /// The front after running `distance` along its normals; negative to run back, through every focus.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        Self {
            distance: self.distance + distance,
            ..*self
        }
    }

    /// The front after reflection in the plane `<normal, x> = height`: the mirror image, exactly.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] for a normal without length.
    pub fn reflect(&self, normal: DVec3, height: f64) -> Result<Self, Error> {
        let unit = normal.try_normalize().ok_or(Error::ZeroDirection {
            what: "the normal of a mirror",
        })?;
        let height = height / normal.length();
        let image = |v: DVec3| v - 2.0 * v.dot(unit) * unit;
        let half_axes = DMat3::from_cols(
            image(self.half_axes.x_axis),
            image(self.half_axes.y_axis),
            image(self.half_axes.z_axis),
        );
        Ok(Self {
            centre: image(self.centre) + 2.0 * height * unit,
            half_axes,
            distance: self.distance,
        })
    }

    /// The rays of the part with normals `normal(u, v)` over the unit square, on a grid.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for less than two rows or columns; [`Error::ZeroDirection`] for a normal without length.
    pub fn sample(
        &self,
        columns: usize,
        rows: usize,
        normal: impl Fn(f64, f64) -> DVec3,
    ) -> Result<SampledSurface, Error> {
        SampledSurface::new(columns, rows, |u, v| {
            let normal = normal(u, v).try_normalize()?;
            Some(SpacePoint {
                point: self.point(normal),
                normal,
            })
        })
    }
}

impl Mirror {
    /// The plane `<normal, x> = height`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`].
    pub fn plane(normal: DVec3, height: f64) -> Result<Self, Error> {
        if normal == DVec3::ZERO {
            return Err(Error::ZeroDirection {
                what: "the normal of a mirror",
            });
        }
        Self::quadric(DMat3::ZERO, 0.5 * normal, -height)
    }

    /// The quadric `xᵀ form x + 2 <linear, x> + constant = 0` with a symmetric form.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn quadric(form: DMat3, linear: DVec3, constant: f64) -> Result<Self, Error> {
        if !(form.is_finite() && linear.is_finite() && constant.is_finite()) {
            return Err(Error::NonFinite { what: "a mirror" });
        }
        Ok(Self {
            form,
            linear,
            constant,
        })
    }

    /// The distance along a ray to the mirror, and the mirror's unit normal there; none for a ray that misses.
    #[must_use]
    pub fn hit(&self, ray: SpacePoint) -> Option<(f64, DVec3)> {
        let gradient = |x: DVec3| self.form * x + self.linear;
        let a = ray.normal.dot(self.form * ray.normal);
        let b = ray.normal.dot(gradient(ray.point));
        let c = ray.point.dot(gradient(ray.point) + self.linear) + self.constant;
        let first = if a == 0.0 {
            -c / (2.0 * b)
        } else {
            let root = (b * b - a * c).sqrt();
            let larger = -(b + root.copysign(b));
            let roots = [larger / a, c / larger];
            roots
                .into_iter()
                .filter(|s| *s > 0.0)
                .fold(f64::INFINITY, f64::min)
        };
        let normal = gradient(ray.point + first * ray.normal).try_normalize()?;
        (first > 0.0 && first.is_finite()).then_some((first, normal))
    }
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
        if columns < 2 || rays.len() < 2 * columns || rays.len() % columns != 0 {
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

#[cfg(feature = "serde")]
impl From<DualSurface> for crate::stored::StoredSurface {
    fn from(surface: DualSurface) -> Self {
        Self {
            centre: surface.centre,
            half_axes: surface.half_axes,
            distance: surface.distance,
        }
    }
}

#[cfg(feature = "serde")]
impl From<Mirror> for crate::stored::StoredMirror {
    fn from(mirror: Mirror) -> Self {
        Self {
            form: mirror.form,
            linear: mirror.linear,
            constant: mirror.constant,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn directions() -> impl Iterator<Item = DVec3> {
        (0..50).map(|i| {
            let (angle, height) = (2.4 * f64::from(i), (f64::from(i) + 0.5) / 25.0 - 1.0);
            let radius = (1.0 - height * height).sqrt();
            DVec3::new(radius * angle.cos(), radius * angle.sin(), height)
        })
    }

    fn ellipsoid() -> DualSurface {
        let axes = [
            DVec3::new(2.0, 0.3, 0.0),
            DVec3::new(-0.1, 1.0, 0.2),
            DVec3::new(0.0, -0.3, 0.7),
        ];
        DualSurface::ellipsoid(DVec3::new(0.5, -1.0, 2.0), axes).unwrap()
    }

    #[test]
    fn a_point_lies_on_its_tangent_plane_and_is_the_gradient_of_the_support() {
        for surface in [
            ellipsoid(),
            ellipsoid().offset(-0.4),
            DualSurface::sphere(DVec3::ONE, 0.3).unwrap(),
        ] {
            for normal in directions() {
                let point = surface.point(normal);
                assert!((point.dot(normal) - surface.support(normal)).abs() < 1e-14);
                let step = 1e-6 * normal.any_orthonormal_vector();
                let (before, after) = ((normal - step).normalize(), (normal + step).normalize());
                let slope = (surface.support(after) - surface.support(before)) / 2e-6;
                assert!((slope - point.dot(step * 1e6)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_plane_mirror_is_exact_and_agrees_with_rays() {
        let (normal, height) = (DVec3::new(1.0, 2.0, -0.5), 3.0);
        let mirrored = ellipsoid().reflect(normal, height).unwrap();
        let mirror = Mirror::plane(normal, height).unwrap();
        let unit = normal.normalize();
        for direction in directions() {
            let ray = SpacePoint {
                point: ellipsoid().point(direction),
                normal: direction,
            };
            let Some((distance, _)) = mirror.hit(ray) else {
                continue;
            };
            let turned = direction - 2.0 * direction.dot(unit) * unit;
            let expected = ray.point + distance * direction - distance * turned;
            assert!((mirrored.point(turned) - expected).length() < 1e-13);
        }
    }

    #[test]
    fn all_rays_from_one_focus_of_an_ellipsoid_meet_in_the_other() {
        let (a, b) = (2.0_f64, 1.2_f64);
        let focus = DVec3::X * (a * a - b * b).sqrt();
        let form = DMat3::from_diagonal(DVec3::new(1.0 / (a * a), 1.0 / (b * b), 1.0 / (b * b)));
        let mirror = Mirror::quadric(form, DVec3::ZERO, -1.0).unwrap();
        let source = DualSurface::sphere(-focus, 0.0).unwrap();
        let cap = |u: f64, v: f64| DVec3::new(0.3, u - 0.5, v - 0.5);
        let front = source
            .sample(20, 20, cap)
            .unwrap()
            .reflect(&mirror)
            .unwrap();
        for ray in front.offset(2.0 * a).rays() {
            assert!((ray.point - focus).length() < 1e-13);
        }
    }

    #[test]
    fn reflected_rays_stay_normal_to_a_front() {
        let form = DMat3::from_diagonal(DVec3::new(0.1, 0.2, 0.0));
        let mirror = Mirror::quadric(form, DVec3::Z * 0.5, 2.0).unwrap();
        let cap = |u: f64, v: f64| DVec3::new(0.6 * (u - 0.5), 0.6 * (v - 0.5), -1.0);
        let defect = |count: usize| {
            let front = ellipsoid()
                .sample(count, count, cap)
                .unwrap()
                .reflect(&mirror)
                .unwrap();
            front.offset(8.0).normality_defect()
        };
        // The asymptotic order is 2.
        let order = (defect(60) / defect(120)).log2();
        assert!((order - 2.0).abs() < 0.2, "order {order}");
    }

    #[test]
    fn hostile_input_is_refused() {
        assert!(DualSurface::sphere(DVec3::NAN, 1.0).is_err());
        assert!(DualSurface::ellipsoid(DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::X]).is_err());
        assert!(ellipsoid().reflect(DVec3::ZERO, 1.0).is_err());
        assert!(Mirror::plane(DVec3::ZERO, 1.0).is_err());
        let mirror = Mirror::plane(DVec3::Z, -100.0).unwrap();
        let up = ellipsoid().sample(3, 3, |_, _| DVec3::Z).unwrap();
        assert!(matches!(up.reflect(&mirror), Err(Error::Miss { .. })));
        assert!(ellipsoid().sample(1, 3, |_, _| DVec3::Z).is_err());
        assert!(ellipsoid().sample(3, 3, |_, _| DVec3::ZERO).is_err());
    }
}
