//! The names of the surfaces, decided from their numbers.

use std::fmt;

/// What a Dupin cyclide looks like: its type in the classical list, by the number and the place of its real singular
/// points.
///
/// The quartic types are told apart by `a`, `c` and `mu` (Shene, Fig. 1, with two corrections: a surface with
/// `mu = a` is singular at `(c, 0, 0)` and is no ring, and the sphere counted twice is `a = c = 0`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Kind {
    /// `0 < c < mu < a`: smooth everywhere.
    Ring,
    /// `0 < c = mu`: two horns that meet in one point.
    SinglyHorned,
    /// `0 <= mu < c`: a large and a small horn that meet in two points.
    DoublyHorned,
    /// `0 < c, mu = a`: the hole of the ring is closed at one point.
    OneSingularitySpindle,
    /// `0 < c, mu > a`: it passes through itself, two singular points on one axis.
    TwoSingularitySpindle,
    /// `c = 0, mu < a`.
    RingTorus,
    /// `c = 0, mu = a`.
    HornTorus,
    /// `c = 0, mu > a`.
    SpindleTorus,
    /// `a = c = 0`: a sphere of radius `mu`, counted twice.
    DoubleSphere,
    /// `a = c > 0`: two spheres that touch. No cyclide, but the limit of some.
    TwoSpheres,
    /// A cubic surface without singular points.
    ParabolicRing,
    /// A cubic surface with one singular point.
    ParabolicOneSingularity,
    /// A cubic surface with two singular points.
    ParabolicTwoSingularities,
}

impl Kind {
    /// The kind of the quartic with the parameters `a >= c >= 0` and `mu >= 0`; lengths count as equal within
    /// `tolerance` times the larger of `a` and `mu` ([`crate::tolerance::EXACT_KIND`] for numbers as designed,
    /// [`crate::tolerance::RECOVERED_KIND`] for numbers recovered from other geometry).
    #[must_use]
    pub fn of_quartic(a: f64, c: f64, mu: f64, tolerance: f64) -> Self {
        let near = tolerance * a.max(mu);
        if a <= near {
            Self::DoubleSphere
        } else if a - c <= near {
            Self::TwoSpheres
        } else if c <= near {
            match mu {
                mu if (mu - a).abs() <= near => Self::HornTorus,
                mu if mu < a => Self::RingTorus,
                _ => Self::SpindleTorus,
            }
        } else if (mu - a).abs() <= near {
            Self::OneSingularitySpindle
        } else if (mu - c).abs() <= near {
            Self::SinglyHorned
        } else if mu < c {
            Self::DoublyHorned
        } else if mu < a {
            Self::Ring
        } else {
            Self::TwoSingularitySpindle
        }
    }

    /// The kind of the parabolic (cubic) cyclide with focal parameter `f > 0` and offset `k` of either sign.
    #[must_use]
    pub fn of_parabolic(f: f64, k: f64, tolerance: f64) -> Self {
        let near = tolerance * f.max(k.abs());
        if (k.abs() - f / 2.0).abs() <= near {
            Self::ParabolicOneSingularity
        } else if k.abs() < f / 2.0 {
            Self::ParabolicRing
        } else {
            Self::ParabolicTwoSingularities
        }
    }

    /// Number of real singular points; 0 for the two spheres, which are no cyclides.
    #[must_use]
    pub const fn singular_point_count(self) -> usize {
        match self {
            Self::Ring
            | Self::RingTorus
            | Self::ParabolicRing
            | Self::DoubleSphere
            | Self::TwoSpheres => 0,
            Self::SinglyHorned
            | Self::OneSingularitySpindle
            | Self::HornTorus
            | Self::ParabolicOneSingularity => 1,
            _ => 2,
        }
    }

    /// Whether the whole surface is free of singular points: ring cyclide, ring torus, parabolic ring cyclide.
    #[must_use]
    pub const fn is_ring(self) -> bool {
        matches!(self, Self::Ring | Self::RingTorus | Self::ParabolicRing)
    }

    /// Whether it is a surface of revolution of a circle: one of the three tori.
    #[must_use]
    pub const fn is_torus(self) -> bool {
        matches!(self, Self::RingTorus | Self::HornTorus | Self::SpindleTorus)
    }

    /// Whether the surface is cubic and contains two straight lines.
    #[must_use]
    pub const fn is_parabolic(self) -> bool {
        matches!(
            self,
            Self::ParabolicRing | Self::ParabolicOneSingularity | Self::ParabolicTwoSingularities
        )
    }

    /// The name in lower case with hyphens, as in `two-singularity-spindle`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ring => "ring",
            Self::SinglyHorned => "singly-horned",
            Self::DoublyHorned => "doubly-horned",
            Self::OneSingularitySpindle => "one-singularity-spindle",
            Self::TwoSingularitySpindle => "two-singularity-spindle",
            Self::RingTorus => "ring-torus",
            Self::HornTorus => "horn-torus",
            Self::SpindleTorus => "spindle-torus",
            Self::DoubleSphere => "double-sphere",
            Self::TwoSpheres => "two-spheres",
            Self::ParabolicRing => "parabolic-ring",
            Self::ParabolicOneSingularity => "parabolic-one-singularity",
            Self::ParabolicTwoSingularities => "parabolic-two-singularities",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}
