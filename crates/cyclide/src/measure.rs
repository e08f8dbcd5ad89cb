//! Bounding box, area and volume.

use crate::frame::length;
use crate::{Dupin, Error, Quartic};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Relative accuracy of areas and volumes, which are one-dimensional integrals of smooth functions.
const QUADRATURE: f64 = 1e-13;

impl Dupin {
    /// The smallest box with edges along the world's axes that contains the surface, as its low and high corner; `None` for a
    /// parabolic cyclide, which is unbounded.
    ///
    /// Exact: the extreme points in a direction are those whose normal has this direction, and the Gauss map has a closed inverse.
    #[must_use]
    pub fn bounding_box(&self) -> Option<[DVec3; 2]> {
        let surface = self.as_quartic()?;
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for axis in DVec3::AXES {
            for normal in [axis, -axis] {
                let [theta, psi] =
                    surface.parameters_of_normal(surface.frame().vector_to_local(normal));
                for point in [
                    surface.point(theta, psi),
                    surface.point(theta + PI, PI - psi),
                ] {
                    low = low.min(point);
                    high = high.max(point);
                }
            }
        }
        for point in self.singular_points() {
            low = low.min(point);
            high = high.max(point);
        }
        Some([low, high])
    }

    /// The area of a rectangle of parameters, counted without sign. On a quartic spans of `2 pi` give the whole surface, and longer ones
    /// count it again. Relative accuracy about 1e-13.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::LengthOutOfRange`] for a bound beyond 1e70.
    pub fn area(&self, first: [f64; 2], second: [f64; 2]) -> Result<f64, Error> {
        for bound in first.into_iter().chain(second) {
            length("parameter bound", bound)?;
        }
        Ok(match self {
            Self::Quartic(surface) => {
                let mut total = 0.0;
                for (turns, theta) in turns_and_rest(first) {
                    for (again, psi) in turns_and_rest(second) {
                        total += turns * again * surface.rectangle_area(theta, psi);
                    }
                }
                total
            }
            Self::Parabolic(surface) => {
                let (f, k) = (surface.f(), surface.k());
                let zeros = |square: f64| {
                    if square > 0.0 {
                        vec![square.sqrt(), -square.sqrt()]
                    } else {
                        Vec::new()
                    }
                };
                let cuts = |span: [f64; 2], square: f64| {
                    let mut cuts = zeros(square);
                    // The singularities of the integrand are as far away as the origin: pieces may grow with the distance from it.
                    let reach = span[0].abs().max(span[1].abs());
                    let doubling = std::iter::successors(Some(1.0), |x| Some(2.0 * x));
                    for x in doubling.take_while(|&x| x < reach) {
                        cuts.extend([x, -x]);
                    }
                    pieces(span, &cuts)
                };
                let outer = cuts(first, -k / f - 0.5);
                let inner = cuts(second, k / f - 0.5);
                integrate(&outer, |u| {
                    let strip = integrate(&inner, |v| {
                        surface.v_radius(v).abs() * 4.0 / (1.0 + u * u + v * v).powi(2)
                    });
                    surface.u_radius(u).abs() * strip
                })
            }
        })
    }

    /// The volume inside a ring cyclide or ring torus.
    ///
    /// # Errors
    ///
    /// [`Error::NoVolume`] for surfaces of other kinds.
    pub fn volume(&self) -> Result<f64, Error> {
        match self {
            Self::Quartic(surface) if surface.kind().is_ring() => Ok(surface.ring_volume()),
            _ => Err(Error::NoVolume { kind: self.kind() }),
        }
    }
}

impl Quartic {
    fn rectangle_area(&self, theta: [f64; 2], psi: [f64; 2]) -> f64 {
        let (a, c, mu, q) = (self.a(), self.c(), self.mu(), self.minor_ratio());
        // Signs change where a tangent sphere is a point: c cos theta = mu, mu cos psi = a.
        let theta_pieces = pieces(theta, &periodic_zeros(theta, mu / c));
        let psi_pieces = pieces(psi, &periodic_zeros(psi, a / mu));
        let area = integrate(&theta_pieces, |theta| {
            let strip: f64 = psi_pieces
                .iter()
                .map(|&piece| self.strip(theta, piece).abs())
                .sum();
            (mu - c * theta.cos()).abs() * strip
        });
        q * q * area
    }

    /// The integral of `(a - mu cos psi) / (1 - m cos psi)²` with `m = e cos theta`, in closed form.
    fn strip(&self, theta: f64, [from, to]: [f64; 2]) -> f64 {
        let (a, mu) = (self.a(), self.mu());
        let m = self.eccentricity() * theta.cos();
        let root = ((1.0 - m) * (1.0 + m)).sqrt();
        let stretch = ((1.0 + m) / (1.0 - m)).sqrt();
        let antiderivative = |psi: f64| {
            // The integral of 1 / (1 - m cos psi), continued over full turns.
            let turns = (psi / TAU).round();
            let within = psi - turns * TAU;
            let angle = 2.0 * (stretch * (0.5 * within).tan()).atan() + turns * TAU;
            (a * m - mu) * psi.sin() / (1.0 - m * psi.cos()) + (a - mu * m) * angle / root
        };
        (antiderivative(to) - antiderivative(from)) / (root * root)
    }

    /// Steiner's formula along the parallel surfaces: the area grows in proportion to `mu` because the integrals of mean and Gaussian
    /// curvature that would bend it vanish by the symmetry `(theta, psi) -> (theta + pi, pi - psi)`. The rest is the (signed) volume
    /// of the surface `mu = 0`.
    fn ring_volume(&self) -> f64 {
        // All lengths divided by a: the volume of a surface of any allowed size is in range, the powers inside need not be.
        let (e, q, mu) = (
            self.eccentricity(),
            self.minor_ratio(),
            self.mu() / self.a(),
        );
        let whole = [[0.0, TAU]];
        let growth = integrate(&whole, |t| {
            let square = (e * t.cos()).powi(2);
            (1.0 + square) / (1.0 - square).powf(1.5)
        });
        let core = integrate(&whole, |t| {
            let square = (e * t.cos()).powi(2);
            square / (1.0 - square).powf(2.5)
        });
        PI * q * q * (growth * mu * mu + q * q * core) * self.a().powi(3)
    }
}

/// A span as a number of full turns and what is left, each with how often it counts.
fn turns_and_rest([from, to]: [f64; 2]) -> [(f64, [f64; 2]); 2] {
    let span = (to - from).abs();
    let turns = (span / TAU).floor();
    let start = from.min(to);
    [
        (turns, [start, start + TAU]),
        (1.0, [start, start + (span - turns * TAU)]),
    ]
    .map(|(count, [from, to])| {
        // A huge start has no digits left for the angle; any start serves then.
        let start = from.rem_euclid(TAU);
        (count, [start, start + (to - from).clamp(0.0, TAU)])
    })
}

/// Where `cos t = value` inside a span.
fn periodic_zeros([from, to]: [f64; 2], value: f64) -> Vec<f64> {
    if value.is_nan() || value.abs() >= 1.0 {
        return Vec::new();
    }
    let (low, high) = (from.min(to), from.max(to));
    let mut zeros = Vec::new();
    for zero in [value.acos(), -value.acos()] {
        let mut t = low + (zero - low).rem_euclid(TAU);
        while t < high {
            zeros.push(t);
            t += TAU;
        }
    }
    zeros
}

/// A span cut at the given places, ascending.
fn pieces([from, to]: [f64; 2], cuts: &[f64]) -> Vec<[f64; 2]> {
    let (low, high) = (from.min(to), from.max(to));
    let mut bounds: Vec<f64> = cuts
        .iter()
        .copied()
        .filter(|&cut| low < cut && cut < high)
        .chain([low, high])
        .collect();
    bounds.sort_by(f64::total_cmp);
    bounds
        .windows(2)
        .filter_map(|bound| {
            if let &[from, to] = bound {
                Some([from, to])
            } else {
                None
            }
        })
        .collect()
}

/// The integral of a function that is smooth on each piece: Gauss-Legendre with eight points, halved until it agrees with its halves.
fn integrate(pieces: &[[f64; 2]], function: impl Fn(f64) -> f64) -> f64 {
    // The stack holds pieces with the value of the rule on the whole of each.
    let mut waiting: Vec<([f64; 2], f64, u32)> = Vec::new();
    for &piece in pieces {
        waiting.push((piece, gauss(piece, &function), 0));
    }
    let scale: f64 = waiting.iter().map(|(_, value, _)| value.abs()).sum();
    let mut total = 0.0;
    while let Some(([from, to], whole, depth)) = waiting.pop() {
        let middle = 0.5 * (from + to);
        let halves = [[from, middle], [middle, to]];
        let values = halves.map(|half| gauss(half, &function));
        let sum = values[0] + values[1];
        if (sum - whole).abs() <= QUADRATURE * scale.max(sum.abs()) || depth >= 24 {
            total += sum;
        } else {
            waiting.extend([
                (halves[0], values[0], depth + 1),
                (halves[1], values[1], depth + 1),
            ]);
        }
    }
    total
}

/// Nodes and weights of the eight-point rule on `[-1, 1]`, positive half.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

fn gauss([from, to]: [f64; 2], function: &impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    half * GAUSS
        .iter()
        .map(|&(node, weight)| {
            weight * (function(middle - half * node) + function(middle + half * node))
        })
        .sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Frame;

    #[test]
    fn gauss_is_exact_for_degree_fifteen() {
        assert!((gauss([0.0, 1.0], &|x: f64| 16.0 * x.powi(15)) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn long_spans_count_the_surface_again() {
        let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD).unwrap();
        let once = ring.area([0.0, TAU], [0.0, 1.0]).unwrap();
        let often = ring.area([0.3, 0.3 + 1000.0 * TAU], [0.0, 1.0]).unwrap();
        assert!((often / once - 1000.0).abs() < 1e-9);
        let part = ring.area([0.3, 1.1], [0.2, 0.9]).unwrap();
        let more = ring.area([0.3, 1.1 + TAU], [0.2, 0.9]).unwrap();
        let strip = ring.area([0.0, TAU], [0.2, 0.9]).unwrap();
        assert!((more - part - strip).abs() < 1e-12);
        assert!(ring.area([0.0, 1e60], [0.0, 1.0]).unwrap().is_finite());
        // A parabolic cyclide is like a plane far out: its area grows with the square of the reach.
        let surface = Dupin::parabolic(1.0, 0.2, Frame::WORLD).unwrap();
        let [near, far] = [1e9, 2e9].map(|reach| surface.area([0.0, reach], [0.0, reach]).unwrap());
        assert!((far / near - 4.0).abs() < 1e-6, "{near} {far}");
        assert!(matches!(
            ring.area([0.0, 1e80], [0.0, 1.0]),
            Err(Error::LengthOutOfRange { .. })
        ));
    }

    #[test]
    fn the_whole_ring_has_the_printed_area() {
        let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD).unwrap();
        let area = ring.area([0.0, TAU], [0.3, 0.3 + TAU]).unwrap();
        assert!((area - 243.497_262_034_861).abs() < 1e-10, "{area}");
    }

    /// The flux of P/3 through the surface, by the trapezoid rule, which converges geometrically on periodic functions.
    #[test]
    fn the_volume_is_the_flux_of_the_position() {
        for (a, c, mu) in [(3.0, 1.0, 2.0), (3.0, 0.0, 1.0), (3.0, 1.5, 1.6)] {
            let ring = Dupin::quartic(a, c, mu, Frame::WORLD).unwrap();
            let steps = 128;
            let step = TAU / f64::from(steps);
            let mut flux = 0.0;
            for i in 0..steps {
                for j in 0..steps {
                    let (theta, psi) = (step * f64::from(i), step * f64::from(j));
                    flux += ring.point(theta, psi).dot(ring.normal(theta, psi))
                        * ring.area_density(theta, psi)
                        * step
                        * step
                        / 3.0;
                }
            }
            let volume = ring.volume().unwrap();
            assert!((volume - flux).abs() < 1e-10 * volume, "{volume} {flux}");
        }
        let torus = Dupin::torus(3.0, 1.0, Frame::WORLD).unwrap();
        assert!((torus.volume().unwrap() - TAU * PI * 3.0).abs() < 1e-11);
    }

    #[test]
    fn the_volume_grows_with_the_cube_of_the_size() {
        let volume = |scale: f64| {
            let ring =
                Dupin::quartic(3.0 * scale, scale, 2.0 * scale, Frame::WORLD).expect("a ring");
            ring.volume().expect("a ring has one")
        };
        let unit = volume(1.0);
        for exponent in [-69, -60, -45, -10, 10, 40, 50, 60, 69] {
            let scale = 10_f64.powi(exponent);
            let share = volume(scale) / scale.powi(3) / unit;
            assert!((share - 1.0).abs() < 1e-12, "{scale:e}: {share}");
        }
    }

    #[test]
    fn the_box_touches_sampled_points() {
        let frame = Frame::from_directions(
            DVec3::new(1.0, -2.0, 0.5),
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::Y,
        )
        .unwrap();
        for (a, c, mu) in [
            (3.0, 1.0, 2.0),
            (3.0, 2.0, 1.0),
            (3.0, 1.0, 4.5),
            (3.0, 0.0, 1.0),
        ] {
            let surface = Dupin::quartic(a, c, mu, frame).unwrap();
            let [low, high] = surface.bounding_box().unwrap();
            let (mut inner_low, mut inner_high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for i in 0..400 {
                for j in 0..400 {
                    let point =
                        surface.point(f64::from(i) * TAU / 400.0, f64::from(j) * TAU / 400.0);
                    inner_low = inner_low.min(point);
                    inner_high = inner_high.max(point);
                }
            }
            assert!(
                (low - inner_low).max_element() <= 1e-12
                    && (inner_high - high).max_element() <= 1e-12
            );
            assert!(
                (inner_low - low).max_element() < 2e-3 && (high - inner_high).max_element() < 2e-3
            );
        }
    }
}
