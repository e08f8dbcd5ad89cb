//! When the rays of a piece of a front set out.

/// The departure time along a piece, as the quartic through five of its rays.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredDepartures",
        into = "crate::stored::StoredDepartures"
    )
)]
pub(crate) struct Departures {
    nodes: [f64; 5],
    /// Newton's divided differences.
    differences: [f64; 5],
}

impl Departures {
    #[cfg(feature = "serde")]
    pub(crate) const fn from_stored(nodes: [f64; 5], differences: [f64; 5]) -> Self {
        Self { nodes, differences }
    }

    /// All at one time.
    pub(crate) const fn at(time: f64) -> Self {
        Self {
            nodes: [0.0, 0.25, 0.5, 0.75, 1.0],
            differences: [time, 0.0, 0.0, 0.0, 0.0],
        }
    }

    /// Through five parameters with their times; where two parameters agree, the times at the first one.
    pub(crate) fn through(rays: [(f64, f64); 5]) -> Self {
        let nodes = rays.map(|(parameter, _)| parameter);
        let mut differences = rays.map(|(_, time)| time);
        for order in 1..5 {
            for i in (order..5).rev() {
                differences[i] =
                    (differences[i] - differences[i - 1]) / (nodes[i] - nodes[i - order]);
            }
        }
        if differences.iter().all(|difference| difference.is_finite()) {
            Self { nodes, differences }
        } else {
            Self::at(rays[0].1)
        }
    }

    /// The time at a parameter, and its derivative.
    pub(crate) fn jet(&self, t: f64) -> (f64, f64) {
        let terms = self.differences.iter().zip(&self.nodes).rev();
        terms.fold((0.0, 0.0), |(value, rate), (difference, node)| {
            (value * (t - node) + difference, rate * (t - node) + value)
        })
    }
}

#[cfg(feature = "serde")]
impl From<Departures> for crate::stored::StoredDepartures {
    fn from(departures: Departures) -> Self {
        Self {
            nodes: departures.nodes,
            differences: departures.differences,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quartic_and_its_slope_are_found_again() {
        let time = |t: f64| 3.0 + t * (1.0 - t * (2.0 - t * (0.5 + t)));
        let departures = Departures::through([0.0, 0.2, 0.45, 0.8, 1.0].map(|t| (t, time(t))));
        for i in 0..=10 {
            let t = 0.1 * f64::from(i);
            let (value, rate) = departures.jet(t);
            assert!((value - time(t)).abs() < 1e-14);
            assert!((rate - (1.0 - 4.0 * t + 1.5 * t * t + 4.0 * t * t * t)).abs() < 1e-13);
        }
        assert_eq!(Departures::through([(0.5, 2.0); 5]).jet(0.3), (2.0, 0.0));
    }
}
