//! Curvature elements and their interpolation by two arcs of class 3 with a common evolute.

use glam::DVec2;

use crate::t_cubic::corner_reach;
use crate::{Error, G1Ends, LineElement, TQuartic};

/// Relative difference of two radii below which they count as equal: the evolute is then so short that its
/// length minus the distance of its ends has no digits left, and the G1 arc is the better answer.
pub(crate) const EQUAL_RADII: f64 = 1e-9;

/// A point of a curve with its unit normal and signed radius of curvature.
///
/// The centre of curvature is `point - radius * normal`; the radius is positive where the normal is the
/// outward one. It is finite and not zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "StoredElement", into = "StoredElement")
)]
pub struct CurvatureElement {
    line: LineElement,
    radius: f64,
}

impl CurvatureElement {
    /// The element at `point` with the direction of `normal` and the signed `radius`.
    ///
    /// # Errors
    /// As [`LineElement::new`]; [`Error::NoCurvatureElement`] for a radius that is zero or not finite.
    pub fn new(point: DVec2, normal: DVec2, radius: f64) -> Result<Self, Error> {
        let line = LineElement::new(point, normal)?;
        if !radius.is_finite() || radius == 0.0 {
            return Err(Error::NoCurvatureElement {
                r0: radius,
                r1: radius,
            });
        }
        Ok(Self { line, radius })
    }

    pub(crate) const fn from_unit(point: DVec2, normal: DVec2, radius: f64) -> Self {
        Self {
            line: LineElement::from_unit(point, normal),
            radius,
        }
    }

    /// Point and normal.
    #[must_use]
    pub const fn line(&self) -> LineElement {
        self.line
    }

    /// The point.
    #[must_use]
    pub const fn point(&self) -> DVec2 {
        self.line.point()
    }

    /// The unit normal.
    #[must_use]
    pub const fn normal(&self) -> DVec2 {
        self.line.normal()
    }

    /// The signed radius of curvature.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Centre of curvature.
    #[must_use]
    pub fn centre(&self) -> DVec2 {
        self.point() - self.radius * self.normal()
    }
}

/// The form in which a curvature element is serialized.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredElement {
    line: LineElement,
    radius: f64,
}

#[cfg(feature = "serde")]
impl From<CurvatureElement> for StoredElement {
    fn from(CurvatureElement { line, radius }: CurvatureElement) -> Self {
        Self { line, radius }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredElement> for CurvatureElement {
    type Error = Error;

    fn try_from(stored: StoredElement) -> Result<Self, Error> {
        let element = Self::new(stored.line.point(), stored.line.normal(), stored.radius)?;
        Ok(Self {
            line: stored.line,
            ..element
        })
    }
}

/// The triangle in which the evolute between two curvature elements must lie: its corners are the two
/// centres of curvature and the common point of the two normals.
///
/// `0` denotes the end of larger radius.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EvoluteTriangle {
    /// Distance from the centre of the larger circle along its normal to the apex.
    pub lambda0: f64,
    /// Distance from the apex to the centre of the smaller circle along that normal.
    pub lambda1: f64,
    /// Distance of the two centres.
    pub centre_distance: f64,
    /// Length of the evolute: the difference of the radii.
    pub evolute_length: f64,
    /// `lambda0 + lambda1 - centre_distance`, without cancellation.
    longest_minus_shortest: f64,
    /// `lambda0 + lambda1 - evolute_length`, without cancellation.
    longest_minus_evolute: f64,
}

impl EvoluteTriangle {
    /// The triangle of two elements in either order.
    ///
    /// # Errors
    /// [`Error::NoCurvatureElement`] for radii of opposite sign; as [`G1Ends::new`].
    pub fn new(start: &CurvatureElement, end: &CurvatureElement) -> Result<Self, Error> {
        Ok(Ordered::new(start, end)?.triangle)
    }

    /// Whether a convex arc of continuous monotone curvature that turns by less than pi joins the two
    /// elements: `lambda0, lambda1 > 0` and `centre_distance < evolute_length < lambda0 + lambda1`.
    ///
    /// Source: Guggenheimer and Ostrowski's theorem (Theorem 2), whose bounds on the individual base
    /// angles are not needed, and whose orientation condition holds for one sense of travel only.
    #[must_use]
    pub fn is_admissible(&self) -> bool {
        self.lambda0 > 0.0
            && self.lambda1 > 0.0
            && self.longest_minus_evolute > 0.0
            && self.longest_minus_evolute < self.longest_minus_shortest
    }
}

/// Two elements in the order of decreasing radius, with positive radii.
struct Ordered {
    large: CurvatureElement,
    small: CurvatureElement,
    swapped: bool,
    triangle: EvoluteTriangle,
}

impl Ordered {
    fn new(start: &CurvatureElement, end: &CurvatureElement) -> Result<Self, Error> {
        let (r0, r1) = (start.radius, end.radius);
        if r0 * r1 <= 0.0 {
            return Err(Error::NoCurvatureElement { r0, r1 });
        }
        let outward = |e: &CurvatureElement| {
            CurvatureElement::from_unit(e.point(), e.normal() * e.radius.signum(), e.radius.abs())
        };
        let swapped = r0.abs() < r1.abs();
        let (large, small) = if swapped {
            (outward(end), outward(start))
        } else {
            (outward(start), outward(end))
        };
        let ends = G1Ends::new(large.line, small.line)?;
        let (leg0, leg1) = ends.legs();
        let (cosine, sine) = ends.half_turning();
        let (cosine2, sine2) = (cosine * cosine - sine * sine, 2.0 * sine * cosine);
        // Q1 - Q0 = lambda0 N0 + lambda1 N1, from the tangent legs of the arc itself.
        let lambda0 = large.radius - (cosine2 * leg0 + leg1) / sine2;
        let lambda1 = (leg0 + cosine2 * leg1) / sine2 - small.radius;
        let sum = lambda0 + lambda1;
        let excess = 4.0 * lambda0 * lambda1 * sine * sine;
        let centre_distance = (sum * sum - excess).max(0.0).sqrt();
        let triangle = EvoluteTriangle {
            lambda0,
            lambda1,
            centre_distance,
            evolute_length: large.radius - small.radius,
            longest_minus_shortest: excess / (sum + centre_distance),
            longest_minus_evolute: (leg0 - leg1) * sine / cosine,
        };
        Ok(Self {
            large,
            small,
            swapped,
            triangle,
        })
    }
}

/// Two arcs of class 3 with monotone curvature that join two curvature elements with G2 contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct G2Pair {
    /// The arcs, from the first element to the joint and from the joint to the second.
    pub arcs: [TQuartic; 2],
    /// The element in which they meet.
    pub joint: CurvatureElement,
    /// The parameter alpha of Theorem 3: 0 puts the evolute on the legs of its triangle, 1 on the base.
    pub alpha: f64,
}

impl G2Pair {
    /// The two arcs between `start` and `end` with tension `beta` in (0, 1), counted from `start`; 1/2 is
    /// the value of highest order.
    ///
    /// Elements on one circle give the two halves of the circular arc.
    ///
    /// ```
    /// use ph_curves::{CurvatureElement, G2Pair, glam::DVec2};
    /// // Two elements of the logarithmic spiral r = e^(theta/5).
    /// let element = |theta: f64| {
    ///     let r = (0.2 * theta).exp();
    ///     let normal = DVec2::new(1.0, -0.2).rotate(DVec2::from_angle(theta));
    ///     CurvatureElement::new(DVec2::from_angle(theta) * r, normal, r * 1.04_f64.sqrt())
    /// };
    /// let pair = G2Pair::new(&element(0.0)?, &element(1.2)?, 0.5)?;
    /// let [first, second] = pair.arcs;
    /// assert!((first.radius(1.0) - second.radius(0.0)).abs() < 1e-12);
    /// assert!((second.radius(1.0) - element(1.2)?.radius()).abs() < 1e-12);
    /// # Ok::<(), ph_curves::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::TensionOutOfRange`]; [`Error::EqualRadii`]; [`Error::NotAdmissible`] with the numbers of the
    /// condition; and as [`EvoluteTriangle::new`].
    pub fn new(start: &CurvatureElement, end: &CurvatureElement, beta: f64) -> Result<Self, Error> {
        if !(beta > 0.0 && beta < 1.0) {
            return Err(Error::TensionOutOfRange { beta });
        }
        let ordered = Ordered::new(start, end)?;
        let triangle = ordered.triangle;
        if triangle.evolute_length <= EQUAL_RADII * ordered.large.radius {
            return circular(start, end);
        }
        if !triangle.is_admissible() {
            return Err(Error::NotAdmissible {
                centre_distance: triangle.centre_distance,
                evolute_length: triangle.evolute_length,
                lambda0: triangle.lambda0,
                lambda1: triangle.lambda1,
            });
        }
        Ok(ordered.interpolate(if ordered.swapped { 1.0 - beta } else { beta }, start, end))
    }
}

/// The circular arc between two elements of equal radius, in two halves.
fn circular(start: &CurvatureElement, end: &CurvatureElement) -> Result<G2Pair, Error> {
    let ends = G1Ends::new(start.line, end.line)?;
    if ends
        .t_connected([start.radius, end.radius], EQUAL_RADII)
        .is_none()
    {
        return Err(Error::EqualRadii {
            radius: start.radius,
        });
    }
    let (first, second) = ends.arc_of_positive(1.0).split_inside(0.5);
    let middle = first.contact(1.0);
    Ok(G2Pair {
        arcs: [first, second],
        joint: CurvatureElement::from_unit(middle.point, middle.normal, middle.radius),
        alpha: 0.5,
    })
}

/// One of the two corners of the evolute polygon: the T-cubic in the triangle of a normal and the base.
struct Corner {
    /// Squared cosine of half the angle of the corner.
    cosine_squared: f64,
    /// Length along the normal at alpha = 0.
    lambda: f64,
    /// Length along the base at alpha = 1.
    base: f64,
}

impl Corner {
    /// Sides of the triangle at `alpha`: along the normal and along the base.
    fn sides(&self, alpha: f64) -> (f64, f64) {
        ((1.0 - alpha) * self.lambda, alpha * self.base)
    }

    /// Distance of the inner control points from the corner, and its derivative by alpha.
    fn reach(&self, alpha: f64) -> (f64, f64) {
        let (c, a) = self.sides(alpha);
        let sine_squared = 1.0 - self.cosine_squared;
        let root = ((a - c) * (a - c) + 16.0 * a * c * sine_squared).sqrt();
        let denominator = a + c + root;
        let reach = 2.0 * a * c / denominator;
        let d_product = self.base * c - a * self.lambda;
        let d_root = ((a - c) * (self.base + self.lambda) + 8.0 * sine_squared * d_product) / root;
        (
            reach,
            (2.0 * d_product - reach * (self.base - self.lambda + d_root)) / denominator,
        )
    }

    /// `|w0| / |w1|` of the cubic from the normal to the base: the square root of the ratio of its end legs.
    fn shape(&self, alpha: f64) -> f64 {
        let (c, a) = self.sides(alpha);
        let reach = corner_reach(a, c, 1.0 - self.cosine_squared);
        ((c - reach) / (a - reach)).sqrt()
    }
}

/// The steps after which the iteration for alpha ends in any case; Newton needs about four.
const MOST_STEPS: usize = 60;

impl Ordered {
    /// Theorem 3: the one alpha for which the two T-cubics together have the length of the evolute.
    fn interpolate(&self, beta: f64, start: &CurvatureElement, end: &CurvatureElement) -> G2Pair {
        let EvoluteTriangle {
            lambda0,
            lambda1,
            centre_distance,
            ..
        } = self.triangle;
        let (n0, n1) = (self.large.normal(), self.small.normal());
        // Direction of the base less the normal: (Q1 - Q0) / |Q1 - Q0| - N0 without cancellation.
        let from_n0 =
            ((n1 - n0) * lambda1 + n0 * self.triangle.longest_minus_shortest) / centre_distance;
        let from_n1 =
            ((n0 - n1) * lambda0 + n1 * self.triangle.longest_minus_shortest) / centre_distance;
        let base = n0 + from_n0;
        let corner = |difference: DVec2, lambda: f64, share: f64| Corner {
            cosine_squared: 0.25 * difference.length_squared(),
            lambda,
            base: share * centre_distance,
        };
        let corners = [
            corner(from_n0, lambda0, beta),
            corner(from_n1, lambda1, 1.0 - beta),
        ];
        let alpha = self.evolute_parameter(&corners);

        let (side, _) = corners[0].sides(alpha);
        let (reach, _) = corners[0].reach(alpha);
        let shortening = 2.0 * reach * corners[0].cosine_squared;
        let length = side + corners[0].sides(alpha).1 - shortening;
        let radius = self.large.radius - length;
        let point = self.large.point() + from_n0 * (self.large.radius - side) + base * shortening;
        let sign = start.radius.signum();
        let joint = CurvatureElement::from_unit(point, base.normalize() * sign, radius * sign);

        let shapes = [corners[0].shape(alpha), corners[1].shape(alpha).recip()];
        let (first, second) = if self.swapped {
            (shapes[1].recip(), shapes[0].recip())
        } else {
            (shapes[0], shapes[1])
        };
        let arc = |from: LineElement, to: LineElement, shape: f64| {
            G1Ends::between(from, to).arc_of_positive(shape)
        };
        G2Pair {
            arcs: [
                arc(start.line, joint.line, first),
                arc(joint.line, end.line, second),
            ],
            joint,
            alpha,
        }
    }

    /// Newton's iteration, safeguarded by bisection: the length decreases strictly with alpha. The
    /// equation is written for the excess over the legs, where small turning costs no digits.
    fn evolute_parameter(&self, corners: &[Corner; 2]) -> f64 {
        let (excess, target) = (
            self.triangle.longest_minus_shortest,
            self.triangle.longest_minus_evolute,
        );
        let (mut low, mut high) = (0.0, 1.0);
        let mut alpha = 0.5;
        for _ in 0..MOST_STEPS {
            let (mut value, mut slope) = (alpha * excess - target, excess);
            for corner in corners {
                let (reach, rate) = corner.reach(alpha);
                value += 2.0 * reach * corner.cosine_squared;
                slope += 2.0 * rate * corner.cosine_squared;
            }
            if value > 0.0 {
                high = alpha
            } else {
                low = alpha
            }
            let newton = alpha - value / slope;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let step = (next - alpha).abs();
            alpha = next;
            if step <= 4.0 * f64::EPSILON {
                break;
            }
        }
        alpha
    }
}

/// Theorem 4: the external centre of similarity of the two end circles of a T-connected pair, through which
/// the inner Bézier lines of the arc pass (the second through `P0`, the third through `P1`).
///
/// `centres` and `radii` are those of the two elements.
///
/// # Errors
/// [`Error::EqualRadii`] if the radii are equal: the centre is at infinity.
pub fn similarity_centre(centres: [DVec2; 2], radii: [f64; 2]) -> Result<DVec2, Error> {
    let difference = radii[1] - radii[0];
    if difference == 0.0 {
        return Err(Error::EqualRadii { radius: radii[0] });
    }
    let centre = (centres[0] * radii[1] - centres[1] * radii[0]) / difference;
    if centre.is_finite() {
        Ok(centre)
    } else {
        Err(Error::NonFinite {
            what: "a centre or a radius",
        })
    }
}
