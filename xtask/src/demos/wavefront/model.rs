//! The model as a file describes it, and its curved interfaces.

use anyhow::{Result, ensure};
use bezier_mass::BezierCurve;
use glam::{DVec2, dvec2};
use serde::Deserialize;
use wavefront::Interface;

/// What the model's file holds.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    #[serde(rename = "box")]
    pub(super) corners: [[f64; 2]; 2],
    pub(super) media: Vec<MediumDescription>,
    pub(super) interfaces: Vec<InterfaceDescription>,
    pub(super) source: [f64; 2],
    pub(super) receivers: [[f64; 2]; 2],
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum MediumDescription {
    Isotropic {
        speed: f64,
    },
    Elliptical {
        semi_axes: [f64; 2],
        #[serde(default)]
        angle: f64,
    },
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum InterfaceDescription {
    Line([[f64; 2]; 2]),
    Graph(Vec<[f64; 2]>),
}

impl Description {
    /// Three media in metres and seconds, a valley in the first interface and waves in the second.
    pub(super) fn valleys() -> Self {
        let samples = |f: fn(f64) -> f64| {
            let place = |i: i32| {
                let x = 125.0 * f64::from(i);
                [x, f(x)]
            };
            InterfaceDescription::Graph((-16..=16).map(place).collect())
        };
        Self {
            corners: [[-2000.0, -2000.0], [2000.0, 60.0]],
            media: [1500.0, 2200.0, 3100.0]
                .map(|speed| MediumDescription::Isotropic { speed })
                .into(),
            interfaces: vec![
                samples(|x| -650.0 - 260.0 * (-((x - 250.0) / 520.0).powi(2)).exp() + 0.05 * x),
                samples(|x| -1420.0 + 110.0 * (x / 420.0).sin()),
            ],
            source: [-200.0, 0.0],
            receivers: [[-1600.0, 0.0], [1600.0, 0.0]],
        }
    }
}

/// A natural cubic spline through samples, straight beyond them.
#[derive(Debug)]
pub(super) struct Graph {
    pub(super) samples: Vec<DVec2>,
    /// Second derivatives at the samples.
    bends: Vec<f64>,
}

impl Graph {
    pub(super) fn new(samples: Vec<DVec2>) -> Result<Self> {
        let count = samples.len();
        ensure!(count >= 2, "an interface has at least two samples");
        ensure!(
            samples.iter().all(|p| p.is_finite()),
            "a sample of an interface is not finite"
        );
        ensure!(
            samples.windows(2).all(|pair| pair[0].x < pair[1].x),
            "the samples of an interface have increasing x"
        );
        let width = |i: usize| samples[i + 1].x - samples[i].x;
        let slope = |i: usize| (samples[i + 1].y - samples[i].y) / width(i);
        // Elimination in the tridiagonal system of the second derivatives.
        let (mut upper, mut right) = (vec![0.0; count], vec![0.0; count]);
        for i in 1..count - 1 {
            let pivot = 2.0 * (width(i - 1) + width(i)) - width(i - 1) * upper[i - 1];
            upper[i] = width(i) / pivot;
            right[i] = (6.0 * (slope(i) - slope(i - 1)) - width(i - 1) * right[i - 1]) / pivot;
        }
        let mut bends = vec![0.0; count];
        for i in (1..count - 1).rev() {
            bends[i] = right[i] - upper[i] * bends[i + 1];
        }
        Ok(Self { samples, bends })
    }

    /// Height and slope.
    pub(super) fn at(&self, x: f64) -> (f64, f64) {
        let i = self
            .samples
            .partition_point(|p| p.x <= x)
            .clamp(1, self.samples.len() - 1)
            - 1;
        let (a, b) = (self.samples[i], self.samples[i + 1]);
        let inside = x.clamp(a.x, b.x);
        let width = b.x - a.x;
        let (p, q) = ((b.x - inside) / width, (inside - a.x) / width);
        let (m, n) = (self.bends[i], self.bends[i + 1]);
        let height =
            p * a.y + q * b.y + ((p * p * p - p) * m + (q * q * q - q) * n) * width * width / 6.0;
        let slope =
            (b.y - a.y) / width + ((3.0 * q * q - 1.0) * n - (3.0 * p * p - 1.0) * m) * width / 6.0;
        (height + slope * (x - inside), slope)
    }

    /// The same curve in Bézier pieces, over the whole box.
    pub(super) fn interface(&self, [low, high]: [DVec2; 2]) -> Result<Interface, wavefront::Error> {
        let margin = high.x - low.x;
        let (first, last) = (self.samples[0].x, self.samples[self.samples.len() - 1].x);
        let mut knots = vec![first.min(low.x) - margin];
        knots.extend(self.samples.iter().map(|p| p.x));
        knots.push(last.max(high.x) + margin);
        let piece = |ends: &[f64]| {
            let third = (ends[1] - ends[0]) / 3.0;
            let ((y0, s0), (y1, s1)) = (self.at(ends[0]), self.at(ends[1]));
            BezierCurve::polynomial(&[
                dvec2(ends[0], y0),
                dvec2(ends[0] + third, y0 + third * s0),
                dvec2(ends[1] - third, y1 - third * s1),
                dvec2(ends[1], y1),
            ])
        };
        let pieces: Vec<_> = knots.windows(2).map(piece).collect::<Result<_, _>>()?;
        Interface::curve(pieces)
    }
}
