//! Closed curves of positive curvature, made of rational PH arcs.

use std::f64::consts::PI;

use bezier_mass::bernstein;
use glam::DVec2;

use crate::{Contact, Error, PhArc};

/// A positively oriented rosette: a closed G2 curve with positive curvature, made of arcs of one class. Its normal makes
/// `index` full turns; with one turn it is an oval.
///
/// Everything is a function of the normal angle `psi` in radians, counted from the normal at the start of the first
/// arc and periodic with period `2π index`. Normals point outwards.
///
/// A rosette has *constant width* if the width function does not depend on `psi`; then its index is odd, each of its
/// points belongs to an orthodiameter pair, and its perimeter is `π index` times the width (Barbier).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<PhArc<N>>", into = "Vec<PhArc<N>>")
)]
pub struct Rosette<const N: usize> {
    arcs: Vec<PhArc<N>>,
    /// Normal angle at the start of each arc, and at the end of the last one.
    angles: Vec<f64>,
    index: usize,
}

/// Two points of a rosette with opposite parallel tangents, half the period of the normal apart.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Diameter {
    /// The two points.
    pub points: [DVec2; 2],
    /// The width `δ*`: their distance across the two tangents.
    pub width: f64,
    /// Their distance along the tangents, `Δ*`. The pair is an orthodiameter (both points have the same normal line)
    /// where it vanishes; it is also the derivative of the width.
    pub slide: f64,
}

/// Joints must agree in position, and in radius, to this share of the curve's size: far above the rounding of the
/// constructions (1e-13), far below anything that shows.
const JOINT_TOLERANCE: f64 = 1e-8;
/// The radii of an arc that turns little while its parameter changes scale are lost in the rounding of its coefficients,
/// its points are not; so far that may go.
const ROUNDING_OF_RADII: f64 = 1e-5;

impl<const N: usize> TryFrom<Vec<PhArc<N>>> for Rosette<N> {
    type Error = Error;

    fn try_from(arcs: Vec<PhArc<N>>) -> Result<Self, Error> {
        Self::try_new(arcs)
    }
}

impl<const N: usize> From<Rosette<N>> for Vec<PhArc<N>> {
    fn from(rosette: Rosette<N>) -> Self {
        rosette.arcs
    }
}

impl<const N: usize> Rosette<N> {
    /// Closes a chain of arcs.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] without arcs; [`Error::NotRegular`] with the first arc that turns right or whose radius of
    /// curvature is not proved positive; [`Error::Gap`] with the first joint that is not G2 (the seam included), the
    /// distance being that of the points, or the difference of radii beyond rounding if larger.
    pub fn try_new(arcs: Vec<PhArc<N>>) -> Result<Self, Error> {
        let (Some(first), Some(last)) = (arcs.first(), arcs.last()) else {
            return Err(Error::TooFew {
                what: "arcs of a rosette",
                given: 0,
                needed: 2,
            });
        };
        for (index, arc) in arcs.iter().enumerate() {
            if arc.turning() <= 0.0 || !arc.is_regular() {
                return Err(Error::NotRegular {
                    index,
                    radii: arc.end_radii(),
                });
            }
        }
        let size = arcs
            .iter()
            .map(|arc| arc.radius(0.0).max(arc.radius(1.0)))
            .fold(0.0, f64::max);
        // Radii cannot be told apart within the rounding of the arcs' coefficients.
        let rounding = |before: &PhArc<N>, after: &PhArc<N>| {
            (before.radius_noise() + after.radius_noise()).min(ROUNDING_OF_RADII * size)
        };
        let following = arcs.iter().skip(1).chain([first]);
        for (index, (before, after)) in arcs.iter().zip(following).enumerate() {
            let (end, start) = (before.contact(1.0), after.contact(0.0));
            let turned = end.normal.distance(start.normal) * size;
            let distance = end
                .point
                .distance(start.point)
                .max((end.radius - start.radius).abs() - rounding(before, after))
                .max(turned);
            if distance.is_nan() || distance > JOINT_TOLERANCE * size {
                return Err(Error::Gap { index, distance });
            }
        }
        let mut angles = vec![0.0];
        let mut angle = 0.0;
        angles.extend(arcs.iter().map(|arc| {
            angle += arc.turning();
            angle
        }));
        // The joints close, so that the turning is a multiple of a full turn up to rounding.
        let index = (angle / (2.0 * PI)).round() as usize;
        debug_assert!(last.turning() > 0.0);
        Ok(Self {
            arcs,
            angles,
            index,
        })
    }

    /// The arcs in order.
    #[must_use]
    pub fn arcs(&self) -> &[PhArc<N>] {
        &self.arcs
    }

    /// The number of turns of the normal: 1 for an oval.
    #[must_use]
    pub fn index(&self) -> usize {
        self.index
    }

    /// The period of all functions of the normal angle.
    #[must_use]
    pub fn period(&self) -> f64 {
        2.0 * PI * self.index as f64
    }

    /// The arc and its parameter with the normal angle `psi`.
    #[must_use]
    pub fn locate(&self, psi: f64) -> (usize, f64) {
        let psi = psi.rem_euclid(self.period());
        let arc = self
            .angles
            .partition_point(|&angle| angle <= psi)
            .saturating_sub(1)
            .min(self.arcs.len() - 1);
        let start = self.arcs[arc].normal(0.0);
        let normal = start.rotate(DVec2::from_angle(psi - self.angles[arc]));
        (arc, self.arcs[arc].parameter_beyond(normal).clamp(0.0, 1.0))
    }

    /// Point, normal, support and radius at the normal angle `psi`.
    #[must_use]
    pub fn contact(&self, psi: f64) -> Contact {
        let (arc, t) = self.locate(psi);
        self.arcs[arc].contact(t)
    }

    /// The two points with parallel tangents at `psi` and half a period on. For even index the two normals agree.
    #[must_use]
    pub fn diameter(&self, psi: f64) -> Diameter {
        let (here, there) = (self.contact(psi), self.contact(psi + 0.5 * self.period()));
        let chord = there.point - here.point;
        Diameter {
            points: [here.point, there.point],
            width: -chord.dot(here.normal),
            slide: chord.dot(here.normal.perp()),
        }
    }

    /// The width function `δ*` at `psi`.
    #[must_use]
    pub fn width(&self, psi: f64) -> f64 {
        self.diameter(psi).width
    }

    /// Smallest and largest width over `samples` equal steps of the normal angle.
    #[must_use]
    pub fn width_range(&self, samples: usize) -> (f64, f64) {
        let step = 0.5 * self.period() / samples.max(1) as f64;
        (0..samples.max(1))
            .map(|i| self.width(step * i as f64))
            .fold((f64::INFINITY, 0.0), |(least, most), width| {
                (least.min(width), width.max(most))
            })
    }

    /// The perimeter, in closed form.
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        self.arcs.iter().map(PhArc::signed_length).sum()
    }

    /// The number of arcs' normal lines that pass through a point far outside: `k` if the family of normal lines is
    /// `k`-simple, which it is with `k = index` for a rosette of constant width.
    ///
    /// Counted on the lines themselves, one for each diameter: the sign changes of `<X - C, T>` over half a period.
    #[must_use]
    pub fn normal_covering(&self) -> usize {
        let reach = self.perimeter();
        let far = self.arcs[0].point(0.0) + reach * reach.max(1.0) * DVec2::new(0.6, 0.8);
        let samples = 64 * self.arcs.len();
        let step = 0.5 * self.period() / samples as f64;
        let side = |i: usize| {
            let contact = self.contact(step * i as f64);
            (far - contact.point).dot(contact.normal.perp()) > 0.0
        };
        (0..samples).filter(|&i| side(i) != side(i + 1)).count()
    }

    /// The parallel rosette at the signed distance along the outward normal; exact.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::NotRegular`] if an inner offset reaches a centre of curvature.
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        if !distance.is_finite() {
            return Err(Error::NonFinite {
                what: "offset distance",
            });
        }
        let arcs: Vec<_> = self.arcs.iter().map(|arc| arc.offset(distance)).collect();
        match arcs.iter().position(|arc| !arc.is_regular()) {
            Some(index) => Err(Error::NotRegular {
                index,
                radii: arcs[index].end_radii(),
            }),
            None => Ok(Self {
                arcs,
                ..self.clone()
            }),
        }
    }
}

impl<const N: usize> PhArc<N> {
    /// Whether the radius of curvature is positive on the whole arc, proved by the signs of the Bernstein coefficients of
    /// the radius polynomial on parts of it.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        keeps_positive(&self.radius_polynomial(), 0)
    }
}

/// Halvings after which a polynomial that is positive at the ends of its parts, but not certified, counts as touching zero.
const CERTIFICATE_DEPTH: u32 = 48;

/// Whether a polynomial is positive on `[0, 1]`, by the signs of its Bernstein coefficients on parts.
pub(crate) fn keeps_positive(coefficients: &[f64], depth: u32) -> bool {
    let ends = [coefficients.first(), coefficients.last()];
    if depth > CERTIFICATE_DEPTH
        || ends
            .iter()
            .any(|end| !end.is_some_and(|value| *value > 0.0))
    {
        return false;
    }
    if coefficients.iter().all(|&coefficient| coefficient > 0.0) {
        return true;
    }
    let (left, right) = bernstein::subdivide(coefficients, 0.5);
    keeps_positive(&left, depth + 1) && keeps_positive(&right, depth + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EvolutePolygon, SupportJet, interpolate_constant_width};

    fn triangle() -> EvolutePolygon {
        EvolutePolygon::try_new(&[DVec2::ZERO, DVec2::new(4.0, 0.0), DVec2::new(1.5, 3.0)]).unwrap()
    }

    #[test]
    fn positivity_is_decided_between_positive_ends() {
        assert!(keeps_positive(&[1.0, -0.9, 1.0], 0));
        assert!(!keeps_positive(&[1.0, -1.1, 1.0], 0));
        assert!(!keeps_positive(&[1.0, -1.0, 1.0], 0));
        assert!(!keeps_positive(&[f64::NAN, 1.0], 0));
    }

    #[test]
    fn an_involute_of_a_triangle_has_constant_width_and_barbiers_perimeter() {
        let polygon = triangle();
        for width in [1.01 * polygon.minimum_width(), polygon.rounded_width()] {
            let oval = polygon.rosette(width).unwrap();
            assert_eq!(
                (oval.index(), oval.arcs().len(), polygon.line_covering()),
                (1, 6, 1)
            );
            let (least, most) = oval.width_range(1000);
            assert!(most - least < 1e-12 * width && (most - width).abs() < 1e-12 * width);
            assert!((oval.perimeter() - PI * width).abs() < 1e-12 * width);
            assert_eq!(oval.normal_covering(), 1);
            for i in 0..50 {
                assert!(oval.diameter(0.13 * f64::from(i)).slide.abs() < 1e-12 * width);
            }
            // The inner offset at the width is the curve itself; here its half way circle-like neighbour.
            let wider = oval.offset(1.0).unwrap();
            assert!((wider.width(0.4) - width - 2.0).abs() < 1e-12 * width);
        }
        assert!(matches!(
            polygon.rosette(polygon.minimum_width()),
            Err(Error::WidthTooSmall { .. })
        ));
    }

    #[test]
    fn thin_triangles_give_an_oval_or_the_reason() {
        let thin = |base: f64| {
            let corners = [(0.0, 0.0), (base, 0.0), (0.4 * base, 1.0)];
            EvolutePolygon::try_new(&corners.map(|(x, y)| DVec2::new(x, y))).unwrap()
        };
        for base in [0.3, 0.1, 0.03, 0.015, 0.012, 0.01, 0.008] {
            let polygon = thin(base);
            let width = 10.0 * polygon.minimum_width();
            let (least, most) = polygon.rosette(width).unwrap().width_range(100);
            assert!(most - least < 1e-9 * width, "{base}: {least} {most}");
        }
        for base in [1e-3, 1e-4, 1e-7] {
            let polygon = thin(base);
            match polygon.rosette(10.0 * polygon.minimum_width()) {
                Err(Error::UncertainRadius { edge, .. }) => assert!(edge != 0),
                other => panic!("{base}: {other:?}"),
            }
        }
    }

    #[test]
    fn pentagons_give_rosettes_of_index_three_and_pentagrams_ovals() {
        for (star, index) in [(1, 3), (2, 1)] {
            let corner = |j: usize| {
                DVec2::from_angle(2.0 * PI * (star * j) as f64 / 5.0 + 0.02 * j as f64) * 3.0
            };
            let vertices: Vec<DVec2> = (0..5).map(corner).collect();
            let polygon = EvolutePolygon::try_new(&vertices).unwrap();
            let rosette = polygon.rosette(polygon.rounded_width()).unwrap();
            assert_eq!(
                (
                    rosette.index(),
                    polygon.line_covering(),
                    rosette.normal_covering()
                ),
                (index, index, index)
            );
            let (least, most) = rosette.width_range(500);
            assert!(most - least < 1e-11 * most);
        }
        // The same polygon the other way round gives the same curves.
        let backwards =
            EvolutePolygon::try_new(&[DVec2::new(1.5, 3.0), DVec2::new(4.0, 0.0), DVec2::ZERO])
                .unwrap();
        let oval = backwards.rosette(20.0).unwrap();
        assert!((oval.width(1.0) - 20.0).abs() < 1e-12);
    }

    #[test]
    fn polygons_without_a_chain_are_refused() {
        let polygon = |points: &[(f64, f64)]| {
            EvolutePolygon::try_new(
                &points
                    .iter()
                    .map(|&(x, y)| DVec2::new(x, y))
                    .collect::<Vec<_>>(),
            )
        };
        assert!(matches!(
            polygon(&[(0.0, 0.0), (1.0, 0.0)]),
            Err(Error::TooFew { .. })
        ));
        assert!(matches!(
            polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]),
            Err(Error::EvenPolygon { .. })
        ));
        assert!(matches!(
            polygon(&[(0.0, 0.0), (4.0, 0.0), (0.5, 0.3)]),
            Err(Error::NotCovered { .. })
        ));
        assert!(matches!(
            polygon(&[(0.0, 0.0), (4.0, 0.0), (4.0, 0.0)]),
            Err(Error::ZeroDirection { .. })
        ));
        assert!(matches!(
            polygon(&[(0.0, 0.0), (4.0, 0.0), (8.0, 0.0)]),
            Err(Error::NotLocallyConvex { .. })
        ));
        assert!(matches!(
            polygon(&[(0.0, 0.0), (4.0, 0.0), (f64::NAN, 0.0)]),
            Err(Error::NonFinite { .. })
        ));
    }

    #[test]
    fn given_curvature_elements_are_interpolated() {
        let jets = [
            (0.0, 5.2, 0.1, 4.6),
            (1.0, 5.1, -0.2, 5.3),
            (2.1, 4.9, -0.1, 4.8),
        ];
        let jets = jets.map(|(angle, support, slope, radius)| {
            (
                angle,
                SupportJet {
                    support,
                    slope,
                    bend: radius - support,
                },
            )
        });
        let oval = interpolate_constant_width(10.0, &jets).unwrap();
        for (angle, jet) in jets {
            let contact = oval.contact(angle);
            assert!((contact.support - jet.support).abs() < 1e-12);
            assert!((contact.radius - jet.radius()).abs() < 1e-11);
            assert!((contact.point.dot(contact.normal.perp()) - jet.slope).abs() < 1e-12);
        }
        let (least, most) = oval.width_range(500);
        assert!(most - least < 1e-12 && (most - 10.0).abs() < 1e-12);
        let wild = [
            (
                0.0,
                SupportJet {
                    support: 5.0,
                    slope: 0.0,
                    bend: 6.0,
                },
            ),
            jets[1],
        ];
        assert!(matches!(
            interpolate_constant_width(10.0, &wild),
            Err(Error::BadRadius { .. })
        ));
    }
}
