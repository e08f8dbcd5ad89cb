use bezier_mass::VectorSpace;

use crate::construct::ConicType;
use crate::tolerance::CLASSIFICATION;
use crate::{CharacteristicCircle, Error, LorentzMap, LorentzVector, SphereCurve, SphereMassPoint};

/// What a curve of spheres is the envelope of, found from its invariants (the whole conic, not the arc: a regular arc
/// can belong to a horned cyclide).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Classification {
    /// The kind of surface.
    pub kind: CyclideKind,
    /// The type of the curve's own conic; `None` if its controls are linearly dependent.
    pub conic: Option<ConicType>,
    /// The numbers behind it, if there is an envelope that is a surface.
    pub invariants: Option<Invariants>,
}

/// The numbers by which cyclides are told apart.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Invariants {
    /// The type of the second family's conic.
    pub second_conic: ConicType,
    /// Number of real singular points of the surface.
    pub singular_points: u8,
    /// Number of planes in the own family, 1 standing also for all.
    pub planes_own: u8,
    /// `D/K` with `D = w1^2 - w0 w2`: negative, zero, positive by the own conic; the second conic's is `-1 - D/K`.
    pub weight_discriminant_over_k: f64,
    /// `q = (f1^2 - f0 f2)/K` with `f = -X_o`: positive if the own family contains two planes. The second family has `-q`.
    pub plane_discriminant_over_k: f64,
    /// `det(Xi . Xj)`, the sign of which tells whether the circles of the arc pass singular points.
    pub gram_determinant: f64,
    /// Whether they do not.
    pub regular_arc: bool,
}

/// The kinds of envelopes of a conic on the space of spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[expect(missing_docs, reason = "the kinds are named by `name`")]
pub enum CyclideKind {
    RingTorus,
    HornTorus,
    SpindleTorus,
    RingCyclide,
    SinglyHornedCyclide,
    HornedCyclide,
    OneSingularitySpindleCyclide,
    SpindleCyclide,
    ParabolicRingCyclide,
    ParabolicCyclideWithOneSingularPoint,
    ParabolicCyclideWithTwoSingularPoints,
    CircularCone,
    CircularCylinder,
    /// All spheres through one circle: the envelope is that circle.
    PencilWithBaseCircle,
    /// Nested spheres around two limit points.
    PonceletPencil,
    /// Nested spheres otherwise.
    NoRealEnvelope,
    /// The controls are linearly dependent: a line of the space of spheres, or a point.
    DegenerateControlTriple,
}

impl CyclideKind {
    /// The name of the kind.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::RingTorus => "ring torus",
            Self::HornTorus => "horn torus",
            Self::SpindleTorus => "spindle torus",
            Self::RingCyclide => "ring cyclide",
            Self::SinglyHornedCyclide => "singly horned cyclide",
            Self::HornedCyclide => "horned cyclide",
            Self::OneSingularitySpindleCyclide => "one-singularity spindle cyclide",
            Self::SpindleCyclide => "spindle cyclide",
            Self::ParabolicRingCyclide => "parabolic ring cyclide",
            Self::ParabolicCyclideWithOneSingularPoint => {
                "parabolic cyclide with one singular point"
            }
            Self::ParabolicCyclideWithTwoSingularPoints => {
                "parabolic cyclide with two singular points"
            }
            Self::CircularCone => "circular cone",
            Self::CircularCylinder => "circular cylinder",
            Self::PencilWithBaseCircle => "pencil with base circle",
            Self::PonceletPencil => "poncelet pencil",
            Self::NoRealEnvelope => "no real envelope",
            Self::DegenerateControlTriple => "degenerate control triple",
        }
    }
}

impl std::fmt::Display for CyclideKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl Classification {
    /// The classification of three controls, which may be linearly dependent and then need not be a curve of spheres.
    ///
    /// # Errors
    /// [`Error::OffTheQuadric`] if they are independent and their curve leaves the space of spheres;
    /// [`Error::NonFinite`].
    pub fn of(control: [SphereMassPoint; 3]) -> Result<Self, Error> {
        if control.iter().all(|b| b.is_finite()) && !independent(control.map(flat)) {
            return Ok(Self::without_surface(
                CyclideKind::DegenerateControlTriple,
                None,
            ));
        }
        Ok(SphereCurve::new(control)?.classify())
    }

    const fn without_surface(kind: CyclideKind, conic: Option<ConicType>) -> Self {
        Self {
            kind,
            conic,
            invariants: None,
        }
    }
}

impl SphereCurve {
    /// The kind of the surface that this family envelops, with the invariants that tell it.
    #[must_use]
    pub fn classify(&self) -> Classification {
        let k = self.envelope_invariant();
        let none = Classification::without_surface;
        // K = 0 makes the three controls mutually Lie-orthogonal, which only two independent ones can be.
        if k == 0.0 || !independent(self.control().map(flat)) {
            return none(CyclideKind::DegenerateControlTriple, None);
        }
        let weight_discriminant_over_k = self.weight_discriminant() / k;
        let conic = ConicType::from_discriminant(
            self.weight_discriminant(),
            CLASSIFICATION * self.discriminant_terms(|b| b.weight),
        );
        let own = Some(conic);
        let local = self.in_local_frame().unwrap_or(*self);
        if !independent(
            local
                .control()
                .map(|b| flat(SphereMassPoint::vector(b.weighted))),
        ) {
            let kind = if k > 0.0 {
                CyclideKind::PencilWithBaseCircle
            } else {
                CyclideKind::PonceletPencil
            };
            return none(kind, own);
        }
        let (true, Ok(canal)) = (k > 0.0, local.canal()) else {
            return none(CyclideKind::NoRealEnvelope, own);
        };
        let second = canal.second_family().conic();
        let second_conic = ConicType::from_discriminant(
            -1.0 - weight_discriminant_over_k,
            CLASSIFICATION * (1.0 + weight_discriminant_over_k.abs()),
        );
        let singular_points = match (conic, second_conic) {
            (ConicType::Hyperbola, _) | (_, ConicType::Hyperbola) => 2,
            (ConicType::Parabola, _) | (_, ConicType::Parabola) => 1,
            _ => 0,
        };
        let planes = ConicType::from_discriminant(
            local.discriminant(|b| b.weighted.o),
            CLASSIFICATION * local.scale().powi(2),
        );
        let (planes_own, plane_sign) = match planes {
            ConicType::Ellipse => (0, -1),
            ConicType::Parabola => (1, 0),
            ConicType::Hyperbola => (2, 1),
        };
        let families = [Some(local), second.ok().map(|second| *second.curve())];
        let any = |test: fn(&Self) -> bool| families.iter().flatten().any(test);
        let points_in_own = conic != ConicType::Ellipse;
        let kind = if any(Self::consists_of_planes) {
            if singular_points == 2 {
                CyclideKind::CircularCone
            } else {
                CyclideKind::CircularCylinder
            }
        } else if any(Self::has_constant_radius) {
            [
                CyclideKind::RingTorus,
                CyclideKind::HornTorus,
                CyclideKind::SpindleTorus,
            ][usize::from(singular_points)]
        } else if plane_sign == 0 {
            [
                CyclideKind::ParabolicRingCyclide,
                CyclideKind::ParabolicCyclideWithOneSingularPoint,
                CyclideKind::ParabolicCyclideWithTwoSingularPoints,
            ][usize::from(singular_points)]
        } else {
            let horned = (plane_sign < 0) == points_in_own;
            match (singular_points, horned) {
                (0, _) => CyclideKind::RingCyclide,
                (1, true) => CyclideKind::SinglyHornedCyclide,
                (1, false) => CyclideKind::OneSingularitySpindleCyclide,
                (_, true) => CyclideKind::HornedCyclide,
                (_, false) => CyclideKind::SpindleCyclide,
            }
        };
        let invariants = Invariants {
            second_conic,
            singular_points,
            planes_own,
            weight_discriminant_over_k,
            plane_discriminant_over_k: self.discriminant(|b| b.weighted.o) / k,
            gram_determinant: -4.0 * k * k * (k + self.weight_discriminant()),
            regular_arc: second_conic == ConicType::Ellipse,
        };
        Classification {
            kind,
            conic: own,
            invariants: Some(invariants),
        }
    }

    /// `c1^2 - c0 c2` for one coordinate of the controls.
    fn discriminant(&self, coordinate: impl Fn(&SphereMassPoint) -> f64) -> f64 {
        let [c0, c1, c2] = self.control().each_ref().map(coordinate);
        c1 * c1 - c0 * c2
    }

    /// The magnitude of the terms of [`discriminant`](Self::discriminant).
    fn discriminant_terms(&self, coordinate: impl Fn(&SphereMassPoint) -> f64) -> f64 {
        let [c0, c1, c2] = self.control().each_ref().map(coordinate);
        c1 * c1 + (c0 * c2).abs()
    }

    /// The curve after the similarity that makes one of its circles the unit circle about the origin, or takes one of
    /// its lines through the origin: there every coordinate can be compared with one.
    fn in_local_frame(&self) -> Option<Self> {
        let canal = self.canal().ok()?;
        let circles = [0.5, 0.0, 1.0, 0.25, 0.75].map(|t| canal.at(t).circle().ok());
        let largest = circles
            .iter()
            .flatten()
            .filter_map(|circle| circle.circle())
            .max_by(|a, b| a.radius().total_cmp(&b.radius()));
        let (centre, size) = match (
            largest,
            circles
                .into_iter()
                .flatten()
                .find_map(CharacteristicCircle::line),
        ) {
            (Some(circle), _) => (circle.centre(), circle.radius()),
            (None, Some(line)) => (line.nearest_to_origin(), 1.0),
            (None, None) => return None,
        };
        let map = LorentzMap::scaling(1.0 / size).ok()? * LorentzMap::translation(-centre).ok()?;
        self.mapped(&map).ok()
    }

    /// The largest coordinate of the controls.
    fn scale(&self) -> f64 {
        self.control()
            .iter()
            .fold(0.0, |largest, b| largest.max(b.magnitude()))
    }

    fn consists_of_planes(&self) -> bool {
        let scale = CLASSIFICATION * self.scale();
        self.control().iter().all(|b| b.weighted.o.abs() <= scale)
    }

    /// Weight and curvature are proportional.
    fn has_constant_radius(&self) -> bool {
        let [b0, b1, b2] = self.control();
        let cross = |a: &SphereMassPoint, b: &SphereMassPoint| {
            (a.weight * b.weighted.o - b.weight * a.weighted.o).abs()
        };
        let scale = self.scale();
        cross(b0, b1).max(cross(b1, b2)).max(cross(b0, b2)) <= CLASSIFICATION * scale * scale
    }
}

/// The coordinates of a 6-vector in Euclidean space, scaled to length one.
fn flat(b: SphereMassPoint) -> [f64; 6] {
    let LorentzVector { o, v, inf } = b.weighted;
    [b.weight, o, v.x, v.y, v.z, inf].times(1.0 / b.magnitude().max(f64::MIN_POSITIVE))
}

/// Whether three vectors are linearly independent: what Gram-Schmidt leaves of each is more than rounding.
fn independent(vectors: [[f64; 6]; 3]) -> bool {
    let dot = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut basis: Vec<[f64; 6]> = Vec::with_capacity(3);
    for mut vector in vectors {
        for unit in &basis {
            vector = vector.minus(unit.times(dot(&vector, unit)));
        }
        let length = dot(&vector, &vector).sqrt();
        if length <= CLASSIFICATION {
            return false;
        }
        basis.push(vector.times(1.0 / length));
    }
    true
}
