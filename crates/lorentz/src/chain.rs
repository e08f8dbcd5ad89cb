use crate::{CanalCurve, Course, Error, Joint};

/// Canal curves one after the other, each starting where the previous one ends: a G1 spline of cyclide pieces.
///
/// The chain does not insist on G1 joints; [`joints`](Self::joints) measures them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<CanalCurve>", into = "Vec<CanalCurve>")
)]
pub struct CanalChain {
    arcs: Vec<CanalCurve>,
}

impl CanalChain {
    /// The chain of these arcs.
    ///
    /// # Errors
    /// [`Error::EmptyChain`].
    pub fn new(arcs: Vec<CanalCurve>) -> Result<Self, Error> {
        if arcs.is_empty() {
            Err(Error::EmptyChain)
        } else {
            Ok(Self { arcs })
        }
    }

    /// The arcs in order.
    #[must_use]
    pub fn arcs(&self) -> &[CanalCurve] {
        &self.arcs
    }

    /// Every joint between an arc and the next one.
    ///
    /// # Errors
    /// [`Error::SingularJoint`] if two arcs meet in a vertex.
    pub fn joints(&self) -> Result<Vec<Joint>, Error> {
        self.arcs
            .iter()
            .zip(self.arcs.iter().skip(1))
            .map(|(arc, next)| arc.joint_with(next))
            .collect()
    }

    /// Whether every joint is G1 and continues.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        self.joints()
            .is_ok_and(|joints| joints.iter().all(|joint| joint.course == Course::Continues))
    }

    /// The chain run backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            arcs: self.arcs.iter().rev().map(CanalCurve::reversed).collect(),
        }
    }
}

impl TryFrom<Vec<CanalCurve>> for CanalChain {
    type Error = Error;
    fn try_from(arcs: Vec<CanalCurve>) -> Result<Self, Error> {
        Self::new(arcs)
    }
}

impl From<CanalChain> for Vec<CanalCurve> {
    fn from(chain: CanalChain) -> Self {
        chain.arcs
    }
}
