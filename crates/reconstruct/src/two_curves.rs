//! Surfaces through two curves that are geodesics of them, and chains of such surfaces.
//!
//! Section 3.4 of the thesis chapter: `F(u,v) = H0 f0 + H1 X0 + H2 X1 + H3 f1` with end vectors
//! `X_i = lambda_i (cos alpha_i h_i + sin alpha_i e_i)` in the tangent planes. Both curves are geodesics for any
//! `alpha_i`, `lambda_i` as long as `lambda_i cos alpha_i` does not vanish.

use crate::hermite::hermite;
use crate::quadrature::SIX;
use crate::strip::{GeodesicStrip, Strip, StripSample};
use crate::{CubicSpline, EndCondition, Error, Series, Surface};
use bezier_mass::Partials;
use core::array::from_fn;
use core::fmt;
use glam::DVec3;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// A function of one parameter with its derivatives.
#[derive(Clone)]
pub enum ScalarFunction {
    /// A constant.
    Constant(f64),
    /// A cubic spline.
    Spline(CubicSpline<f64>),
    /// A formula.
    Formula(Arc<dyn Fn(Series) -> Series + Send + Sync>),
}

impl ScalarFunction {
    /// A function given by a formula.
    pub fn formula(formula: impl Fn(Series) -> Series + Send + Sync + 'static) -> Self {
        Self::Formula(Arc::new(formula))
    }

    /// Value and derivatives at `u`.
    #[must_use]
    pub fn at(&self, u: f64) -> Series {
        match self {
            Self::Constant(value) => Series::constant(*value),
            Self::Spline(spline) => spline.of_series(Series::parameter(u)),
            Self::Formula(formula) => formula(Series::parameter(u)),
        }
    }
}

impl fmt::Debug for ScalarFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => f.debug_tuple("Constant").field(value).finish(),
            Self::Spline(spline) => f.debug_tuple("Spline").field(spline).finish(),
            Self::Formula(_) => f.write_str("Formula(..)"),
        }
    }
}

impl From<f64> for ScalarFunction {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

/// The free functions of one curve: the vector `X` with which the surface leaves it (or arrives at it), always in the
/// direction of increasing `v`.
#[derive(Clone, Debug)]
pub enum EndField {
    /// Angle `alpha` from the direction across towards that along the curve, radians, and length `lambda`.
    Polar {
        /// The angle function.
        angle: ScalarFunction,
        /// The length function.
        length: ScalarFunction,
    },
    /// Components along the curve and across it.
    Components {
        /// The component along the tangent.
        along: ScalarFunction,
        /// The component along `h`, to be kept positive.
        across: ScalarFunction,
    },
}

impl EndField {
    /// The components along and across at `u`.
    fn components(&self, u: f64) -> [Series; 2] {
        match self {
            Self::Components { along, across } => [along.at(u), across.at(u)],
            Self::Polar { angle, length } => {
                let (sin, cos) = angle.at(u).sin_cos();
                let length = length.at(u);
                [sin * length, cos * length]
            }
        }
    }

    /// The end vector with two derivatives.
    fn at(&self, u: f64, sample: &StripSample) -> [DVec3; 3] {
        let [p, q] = self.components(u);
        let product = |c: Series, v: &[DVec3; 3]| {
            let c: [f64; 3] = from_fn(|k| c.derivative_at(k));
            [
                v[0] * c[0],
                v[0] * c[1] + v[1] * c[0],
                v[0] * c[2] + v[1] * (2.0 * c[1]) + v[2] * c[0],
            ]
        };
        let (a, b) = (product(p, &sample.along), product(q, &sample.across));
        from_fn(|k| a[k] + b[k])
    }
}

/// One interpolating curve: from `P0` with velocity `l0 T0` to `P1` with velocity `l1 T1`, both directions given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HermiteArc {
    points: [DVec3; 2],
    directions: [DVec3; 2],
}

/// The local criteria by which an interpolating curve is smooth; the thesis names none, these are the usual ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LocalCriterion {
    /// Criterion 1: `int |F_vv|² dv`.
    Bending,
    /// Criterion 2: `int |F_v|² dv`.
    Stretching,
    /// Criterion 3: `int (d|F_v|/dv)² dv`.
    SpeedVariation,
}

/// Which numbers a criterion may choose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Freedom {
    /// The lengths of the end vectors, their angles being given.
    #[default]
    Lengths,
    /// The end vectors altogether.
    Vectors,
}

/// The magnitudes that minimise a criterion, and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LeastMagnitudes {
    /// The lengths of the end velocities; negative where the free minimum turns one around.
    pub magnitudes: [f64; 2],
    /// The integral, without a factor 1/2.
    pub energy: f64,
}

impl HermiteArc {
    /// The arc between two points with unit end directions.
    #[must_use]
    pub fn new(points: [DVec3; 2], directions: [DVec3; 2]) -> Self {
        Self { points, directions }
    }

    /// The free minimum of `int |F''|²`: `[[8, 4c], [4c, 8]] l = 12 (D.T0, D.T1)`, `D = P1 - P0`, `c = T0.T1`.
    #[must_use]
    pub fn least_bending(&self) -> LeastMagnitudes {
        self.least(LocalCriterion::Bending)
    }

    /// The free minimum of a criterion over the two magnitudes.
    #[must_use]
    pub fn least(&self, criterion: LocalCriterion) -> LeastMagnitudes {
        let problem = EndVectorProblem {
            chord: self.points[1] - self.points[0],
            basis: vec![(0, self.directions[0]), (1, self.directions[1])],
        };
        let (values, energy) = problem.minimum(criterion);
        LeastMagnitudes {
            magnitudes: [values[0], values[1]],
            energy,
        }
    }
}

/// Minimise a criterion over end vectors `X_i = sum c_k b_k` (each basis vector belongs to one end).
struct EndVectorProblem {
    chord: DVec3,
    basis: Vec<(usize, DVec3)>,
}

/// Newton steps for the speed variation at one place.
const LOCAL_STEPS: usize = 40;

impl EndVectorProblem {
    fn minimum(&self, criterion: LocalCriterion) -> (Vec<f64>, f64) {
        match criterion {
            LocalCriterion::Bending => self.quadratic([12.0, 12.0, 4.0, 4.0]),
            LocalCriterion::Stretching => self.quadratic([1.2, 0.2, 2.0 / 15.0, -1.0 / 15.0]),
            LocalCriterion::SpeedVariation => self.least_speed_variation(),
        }
    }

    /// `E = a |D|² - b D.(X0 + X1) + c (|X0|² + |X1|²) + d X0.X1`.
    fn quadratic(&self, [a, b, c, d]: [f64; 4]) -> (Vec<f64>, f64) {
        let n = self.basis.len();
        let matrix = DMatrix::from_fn(n, n, |k, l| {
            let ((i, x), (j, y)) = (self.basis[k], self.basis[l]);
            x.dot(y) * if i == j { 2.0 * c } else { d }
        });
        let right = DVector::from_fn(n, |k, _| b * self.chord.dot(self.basis[k].1));
        let values = matrix
            .lu()
            .solve(&right)
            .unwrap_or_else(|| DVector::zeros(n));
        let energy = a * self.chord.length_squared() - 0.5 * right.dot(&values);
        (values.iter().copied().collect(), energy)
    }

    /// Damped Gauss-Newton on the residuals `F_v . F_vv / |F_v|` at Gauss points, from the stretching minimum.
    fn least_speed_variation(&self) -> (Vec<f64>, f64) {
        let n = self.basis.len();
        let (start, _) = self.minimum(LocalCriterion::Stretching);
        let mut values = DVector::from_vec(start);
        let model = |values: &DVector<f64>| {
            let (mut energy, mut gradient, mut matrix) =
                (0.0, DVector::zeros(n), DMatrix::zeros(n, n));
            // Four panels: the integrand is a quotient and peaks where the speed is small.
            let panels =
                (0..4).flat_map(|k| SIX.map(|(x, w)| (0.25 * (f64::from(k) + x), 0.25 * w)));
            for (node, weight) in panels {
                let h = hermite(node);
                let coefficient = |order: usize, end: usize| h[order][1 + end];
                let derivative = |order: usize| {
                    (0..n).fold(self.chord * h[order][3], |sum, k| {
                        let (end, vector) = self.basis[k];
                        sum + vector * (coefficient(order, end) * values[k])
                    })
                };
                let (first, second) = (derivative(1), derivative(2));
                let length = first.length().max(f64::MIN_POSITIVE);
                let unit = first / length;
                let residual = unit.dot(second);
                let slope = DVector::from_fn(n, |k, _| {
                    let (end, vector) = self.basis[k];
                    let (b1, b2) = (vector * coefficient(1, end), vector * coefficient(2, end));
                    unit.dot(b2) + (b1.dot(second) - unit.dot(b1) * residual) / length
                });
                energy += weight * residual * residual;
                matrix += &slope * slope.transpose() * weight;
                gradient += slope * (weight * residual);
            }
            (energy, gradient, matrix)
        };
        let (mut energy, mut gradient, mut matrix) = model(&values);
        let mut damping = 1e-3;
        for _ in 0..LOCAL_STEPS {
            let damped = &matrix + DMatrix::identity(n, n) * (damping * matrix.trace() / n as f64);
            let Some(step) = damped.lu().solve(&-&gradient) else {
                break;
            };
            let trial = &values + &step;
            let (e, g, m) = model(&trial);
            if e <= energy {
                let done = step.norm() <= 1e-12 * (1e-300 + values.norm());
                (values, energy, gradient, matrix) = (trial, e, g, m);
                damping *= 0.1;
                if done {
                    break;
                }
            } else {
                damping *= 10.0;
            }
        }
        (values.iter().copied().collect(), energy)
    }
}

/// A surface `F(u, v)` through two curves at `v = 0` and `v = 1`, both its geodesics.
///
/// ```
/// use reconstruct::{AnalyticCurve, GeodesicStrip, LocalCriterion, Surface, TwoCurveSurface};
/// let helix = |pitch: f64, z: f64| {
///     GeodesicStrip::new(AnalyticCurve::new(move |t| [t.cos(), t.sin(), t * pitch + z]))
/// };
/// let surface = TwoCurveSurface::new([helix(0.3, 0.0)?, helix(-0.2, 1.5)?])?
///     .smoothed(LocalCriterion::Bending, Default::default())?;
/// // Two geodesics of the unit cylinder: the surface stays near that cylinder.
/// assert!((surface.point(0.5, 0.5).truncate().length() - 1.0).abs() < 1e-2);
/// # Ok::<(), reconstruct::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct TwoCurveSurface {
    strips: [GeodesicStrip; 2],
    fields: [EndField; 2],
}

/// Smallest component across a curve that smoothing leaves, in parts of the local distance of the curves: a smaller
/// one would fold the surface back.
const LEAST_ACROSS: f64 = 0.05;
/// Places along the curves at which the local criteria are solved; a cubic spline joins them.
const PLACES: usize = 32;

impl TwoCurveSurface {
    /// The surface through two strips, with end vectors straight across of the length of the chord at the middle.
    /// The strips are turned so that `across` points from the first curve towards the second.
    ///
    /// # Errors
    /// [`Error::IrregularBoundary`] when a curve's `across` is orthogonal to the way to the other curve at its middle,
    /// so that the surface cannot leave it.
    pub fn new(strips: [GeodesicStrip; 2]) -> Result<Self, Error> {
        let [a, b] = [strips[0].sample(0.5), strips[1].sample(0.5)];
        let chord = b.point[0] - a.point[0];
        let mut oriented = Vec::with_capacity(2);
        for (side, (strip, sample)) in strips.into_iter().zip([a, b]).enumerate() {
            let towards = sample.across[0].dot(chord) / chord.length();
            if !(towards.abs() > 1e-6) {
                return Err(Error::IrregularBoundary {
                    side,
                    t: 0.5,
                    across: towards,
                });
            }
            oriented.push(if towards < 0.0 {
                strip.flipped()
            } else {
                strip
            });
        }
        let got = oriented.len();
        let strips = oriented.try_into().map_err(|_| Error::TooFew {
            what: "strips",
            needed: 2,
            got,
        })?;
        let field = EndField::Polar {
            angle: 0.0.into(),
            length: chord.length().into(),
        };
        Ok(Self {
            strips,
            fields: [field.clone(), field],
        })
    }

    /// The surface through two strips as they are oriented, with unit end vectors straight across.
    #[must_use]
    pub fn from_oriented(strips: [GeodesicStrip; 2]) -> Self {
        let field = EndField::Polar {
            angle: 0.0.into(),
            length: 1.0.into(),
        };
        Self {
            strips,
            fields: [field.clone(), field],
        }
    }

    /// The same curves with other free functions.
    #[must_use]
    pub fn with_fields(self, fields: [EndField; 2]) -> Self {
        Self { fields, ..self }
    }

    /// The strips.
    #[must_use]
    pub fn strips(&self) -> &[GeodesicStrip; 2] {
        &self.strips
    }

    /// The free functions.
    #[must_use]
    pub fn fields(&self) -> &[EndField; 2] {
        &self.fields
    }

    /// The surface with the free functions chosen by a local criterion, place by place over `[0, 1]`: the lengths of
    /// the end vectors at the angles that they have, or the vectors altogether. A component across a curve that would
    /// fall below 0.05 of the chord is held there.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for curves that are not finite.
    pub fn smoothed(self, criterion: LocalCriterion, freedom: Freedom) -> Result<Self, Error> {
        let places: Vec<f64> = (0..=PLACES).map(|i| i as f64 / PLACES as f64).collect();
        let mut components = [[const { Vec::new() }; 2], [const { Vec::new() }; 2]];
        for &u in &places {
            let samples = [self.strips[0].sample(u), self.strips[1].sample(u)];
            let chosen = self.local_minimum(u, &samples, criterion, freedom);
            for end in 0..2 {
                for axis in 0..2 {
                    components[end][axis].push(chosen[end][axis]);
                }
            }
        }
        let spline = |values: &Vec<f64>| {
            CubicSpline::new(&places, values, EndCondition::NotAKnot).map(ScalarFunction::Spline)
        };
        let [first, second] = &components;
        let field = |c: &[Vec<f64>; 2]| -> Result<EndField, Error> {
            Ok(EndField::Components {
                along: spline(&c[0])?,
                across: spline(&c[1])?,
            })
        };
        Ok(Self {
            fields: [field(first)?, field(second)?],
            ..self
        })
    }

    /// Components along and across of both end vectors at one place.
    fn local_minimum(
        &self,
        u: f64,
        samples: &[StripSample; 2],
        criterion: LocalCriterion,
        freedom: Freedom,
    ) -> [[f64; 2]; 2] {
        let chord = samples[1].point[0] - samples[0].point[0];
        let least = LEAST_ACROSS * chord.length();
        match freedom {
            Freedom::Lengths => {
                let directions: [[f64; 2]; 2] = from_fn(|end| {
                    let [p, q] = self.fields[end].components(u).map(|c| c.value());
                    let length = p.hypot(q);
                    [p / length, q / length]
                });
                let vector = |end: usize| {
                    samples[end].along[0] * directions[end][0]
                        + samples[end].across[0] * directions[end][1]
                };
                let arc = HermiteArc::new(
                    [samples[0].point[0], samples[1].point[0]],
                    [vector(0), vector(1)],
                );
                let magnitudes = arc.least(criterion).magnitudes;
                from_fn(|end| {
                    directions[end].map(|c| c * magnitudes[end].max(least / directions[end][1]))
                })
            }
            Freedom::Vectors => {
                let mut basis = Vec::with_capacity(4);
                for (end, sample) in samples.iter().enumerate() {
                    basis.extend([(end, sample.along[0]), (end, sample.across[0])]);
                }
                let (c, _) = EndVectorProblem { chord, basis }.minimum(criterion);
                [[c[0], c[1].max(least)], [c[2], c[3].max(least)]]
            }
        }
    }

    /// The surface of least thin-plate energy `int int |F_uu|² + 2 |F_uv|² + |F_vv|²` (criterion 4, global), over
    /// components of the end vectors that are cubic splines in `u` with `spans` spans: one linear system. Components
    /// across are held above 0.05 of the least chord by fixing spline coefficients there.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for no span or more than 256; [`Error::DegenerateEnergy`].
    pub fn smoothed_globally(self, spans: usize) -> Result<Self, Error> {
        if !(1..=256).contains(&spans) {
            return Err(Error::OutOfRange {
                what: "number of spans",
                value: spans as f64,
                range: [1.0, 256.0],
            });
        }
        let system = PlateSystem::assemble(&self.strips, spans);
        let coefficients = system.solve()?;
        let count = spans + 3;
        let component = |index: usize| {
            let c: Vec<f64> = (0..count)
                .map(|k| coefficients[index * count + k])
                .collect();
            ScalarFunction::Spline(CubicSpline::from_uniform_coefficients(&c))
        };
        let field = |end: usize| EndField::Components {
            along: component(2 * end),
            across: component(2 * end + 1),
        };
        Ok(Self {
            fields: [field(0), field(1)],
            ..self
        })
    }

    /// The energy of criterion 4, `int int |F_uu|² + 2 |F_uv|² + |F_vv|²` over the unit square.
    #[must_use]
    pub fn thin_plate_energy(&self) -> f64 {
        const PANELS: usize = 16;
        let mut sum = 0.0;
        for panel in 0..PANELS {
            for (x, wx) in SIX {
                let u = (panel as f64 + x) / PANELS as f64;
                for (v, wv) in SIX {
                    let at = self.partials(u, v);
                    let density = at.duu.length_squared()
                        + 2.0 * at.duv.length_squared()
                        + at.dvv.length_squared();
                    sum += wx * wv * density / PANELS as f64;
                }
            }
        }
        sum
    }
}

impl Surface for TwoCurveSurface {
    fn partials(&self, u: f64, v: f64) -> Partials<DVec3> {
        let samples = [self.strips[0].sample(u), self.strips[1].sample(u)];
        let vectors: [[DVec3; 3]; 2] = from_fn(|end| self.fields[end].at(u, &samples[end]));
        let functions = hermite(v);
        let derivative = |a: usize, b: usize| {
            let h = &functions[b];
            samples[0].point[a] * h[0]
                + vectors[0][a] * h[1]
                + vectors[1][a] * h[2]
                + samples[1].point[a] * h[3]
        };
        Partials {
            position: derivative(0, 0),
            du: derivative(1, 0),
            dv: derivative(0, 1),
            duu: derivative(2, 0),
            duv: derivative(1, 1),
            dvv: derivative(0, 2),
        }
    }
}

/// The normal equations of criterion 4: unknowns are the spline coefficients of the components along and across the
/// first curve, then of those of the second.
struct PlateSystem {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    count: usize,
    least_across: f64,
}

impl PlateSystem {
    fn assemble(strips: &[GeodesicStrip; 2], spans: usize) -> Self {
        let count = spans + 3;
        let unknowns = 4 * count;
        let (mut matrix, mut right) =
            (DMatrix::zeros(unknowns, unknowns), DVector::zeros(unknowns));
        let mut least_chord = f64::INFINITY;
        for span in 0..spans {
            for (x, wx) in SIX {
                let u = (span as f64 + x) / spans as f64;
                let samples = [strips[0].sample(u), strips[1].sample(u)];
                least_chord = least_chord.min(samples[0].point[0].distance(samples[1].point[0]));
                let basis = uniform_cubic(x, spans as f64);
                // The vectors b(u) e and b(u) h of each unknown of this span, with two derivatives.
                let local: Vec<(usize, usize, [DVec3; 3])> = (0..4)
                    .flat_map(|component| (0..4).map(move |k| (component, k)))
                    .map(|(component, k)| {
                        let sample = &samples[component / 2];
                        let v = if component % 2 == 0 {
                            &sample.along
                        } else {
                            &sample.across
                        };
                        let c = basis[k];
                        let vector = [
                            v[0] * c[0],
                            v[0] * c[1] + v[1] * c[0],
                            v[0] * c[2] + v[1] * (2.0 * c[1]) + v[2] * c[0],
                        ];
                        (component * count + span + k, component / 2, vector)
                    })
                    .collect();
                for (v, wv) in SIX {
                    let h = hermite(v);
                    let weight = wx * wv / spans as f64;
                    let fixed = |a: usize, b: usize| {
                        samples[0].point[a] * h[b][0] + samples[1].point[a] * h[b][3]
                    };
                    let orders = [([2, 0], 1.0), ([1, 1], 2.0), ([0, 2], 1.0)];
                    for ([a, b], factor) in orders {
                        for (row, end, x) in &local {
                            let left = x[a] * h[b][1 + end] * (factor * weight);
                            right[*row] -= left.dot(fixed(a, b));
                            for (column, other, y) in &local {
                                matrix[(*row, *column)] += left.dot(y[a] * h[b][1 + other]);
                            }
                        }
                    }
                }
            }
        }
        Self {
            matrix,
            right,
            count,
            least_across: LEAST_ACROSS * least_chord,
        }
    }

    /// Solves, fixing coefficients across a curve that fall below the least value until none does.
    fn solve(&self) -> Result<DVector<f64>, Error> {
        let n = self.right.len();
        let across = |k: usize| (k / self.count) % 2 == 1;
        let mut fixed = vec![false; n];
        loop {
            let (mut matrix, mut right) = (self.matrix.clone(), self.right.clone());
            for k in (0..n).filter(|k| fixed[*k]) {
                for row in 0..n {
                    right[row] -= matrix[(row, k)] * self.least_across;
                    (matrix[(row, k)], matrix[(k, row)]) = (0.0, 0.0);
                }
                (matrix[(k, k)], right[k]) = (1.0, self.least_across);
            }
            let solution = matrix
                .cholesky()
                .ok_or(Error::DegenerateEnergy)?
                .solve(&right);
            let violated: Vec<usize> = (0..n)
                .filter(|k| across(*k) && !fixed[*k] && solution[*k] < self.least_across)
                .collect();
            if violated.is_empty() {
                return Ok(solution);
            }
            for k in violated {
                fixed[k] = true;
            }
        }
    }
}

/// The four uniform cubic B-splines on a span at its local parameter, with derivatives by the global one.
fn uniform_cubic(x: f64, spans: f64) -> [[f64; 3]; 4] {
    let s = 1.0 - x;
    let values = [
        s * s * s,
        3.0 * x * x * x - 6.0 * x * x + 4.0,
        3.0 * s * s * s - 6.0 * s * s + 4.0,
        x * x * x,
    ];
    let firsts = [
        -3.0 * s * s,
        9.0 * x * x - 12.0 * x,
        -(9.0 * s * s - 12.0 * s),
        3.0 * x * x,
    ];
    let seconds = [6.0 * s, 18.0 * x - 12.0, 18.0 * s - 12.0, 6.0 * x];
    from_fn(|k| {
        [
            values[k] / 6.0,
            firsts[k] * spans / 6.0,
            seconds[k] * spans * spans / 6.0,
        ]
    })
}

/// Several strips joined to one C1 surface: consecutive two-curve surfaces that share the end vectors of their common
/// curve (Figs 3.13 to 3.15).
#[derive(Clone, Debug)]
pub struct StripChain {
    surfaces: Vec<TwoCurveSurface>,
    widths: Vec<f64>,
}

impl StripChain {
    /// The chain through three or more curves, with end vectors straight across whose lengths minimise the bending
    /// `int |F_vv|² dv` over the whole width, place by place; `widths` are the lengths of the intervals of `v`, one
    /// less than the curves. Along a fixed `u` this is the natural cubic spline through the curves whose slopes are
    /// held in their tangent planes.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::LengthMismatch`], [`Error::OutOfRange`] for a width that is not positive; those of
    /// [`TwoCurveSurface::new`].
    pub fn new(strips: Vec<GeodesicStrip>, widths: &[f64]) -> Result<Self, Error> {
        let n = strips.len();
        if n < 2 {
            return Err(Error::TooFew {
                what: "curves",
                needed: 2,
                got: n,
            });
        }
        if widths.len() != n - 1 {
            return Err(Error::LengthMismatch {
                what: "widths",
                expected: n - 1,
                got: widths.len(),
            });
        }
        if let Some(&value) = widths.iter().find(|w| !(**w > 0.0 && w.is_finite())) {
            return Err(Error::OutOfRange {
                what: "width",
                value,
                range: [0.0, f64::INFINITY],
            });
        }
        let strips = oriented_chain(strips)?;
        let places: Vec<f64> = (0..=PLACES).map(|i| i as f64 / PLACES as f64).collect();
        let mut lengths = vec![Vec::with_capacity(places.len()); n];
        for &u in &places {
            let samples: Vec<StripSample> = strips.iter().map(|strip| strip.sample(u)).collect();
            for (k, length) in chain_lengths(&samples, widths)?.into_iter().enumerate() {
                lengths[k].push(length);
            }
        }
        let splines: Vec<CubicSpline<f64>> = lengths
            .iter()
            .map(|values| CubicSpline::new(&places, values, EndCondition::NotAKnot))
            .collect::<Result<_, _>>()?;
        let field = |k: usize, width: f64| {
            let scaled: Vec<f64> = lengths[k].iter().map(|l| l * width).collect();
            // Splines are linear in their data: the scaled one is the same function times the width.
            CubicSpline::new(splines[k].knots(), &scaled, EndCondition::NotAKnot).map(|spline| {
                EndField::Components {
                    along: 0.0.into(),
                    across: ScalarFunction::Spline(spline),
                }
            })
        };
        let surfaces = (0..n - 1)
            .map(|k| {
                Ok(
                    TwoCurveSurface::from_oriented([strips[k].clone(), strips[k + 1].clone()])
                        .with_fields([field(k, widths[k])?, field(k + 1, widths[k])?]),
                )
            })
            .collect::<Result<_, Error>>()?;
        Ok(Self {
            surfaces,
            widths: widths.to_vec(),
        })
    }

    /// The surfaces, each over the unit square.
    #[must_use]
    pub fn surfaces(&self) -> &[TwoCurveSurface] {
        &self.surfaces
    }

    /// The largest angle between the normals of neighbouring surfaces along their common curves, radians, from
    /// `samples + 1` places each.
    #[must_use]
    pub fn joint_angle(&self, samples: usize) -> f64 {
        let n = samples.max(1);
        let mut worst: f64 = 0.0;
        for pair in self.surfaces.windows(2) {
            for i in 0..=n {
                let u = i as f64 / n as f64;
                let (a, b) = (pair[0].normal(u, 1.0), pair[1].normal(u, 0.0));
                worst = worst.max(a.cross(b).length().atan2(a.dot(b)));
            }
        }
        worst
    }

    /// The largest jump of the derivative across common curves, relative to it: zero for a C1 surface over the
    /// intervals of the given widths.
    #[must_use]
    pub fn joint_jump(&self, samples: usize) -> f64 {
        let n = samples.max(1);
        let mut worst: f64 = 0.0;
        for (pair, widths) in self.surfaces.windows(2).zip(self.widths.windows(2)) {
            for i in 0..=n {
                let u = i as f64 / n as f64;
                let (a, b) = (
                    pair[0].partials(u, 1.0).dv / widths[0],
                    pair[1].partials(u, 0.0).dv / widths[1],
                );
                worst = worst.max(a.distance(b) / a.length());
            }
        }
        worst
    }
}

/// Turns every strip so that `across` points on along the chain.
fn oriented_chain(strips: Vec<GeodesicStrip>) -> Result<Vec<GeodesicStrip>, Error> {
    let samples: Vec<StripSample> = strips.iter().map(|strip| strip.sample(0.5)).collect();
    let last = samples.len() - 1;
    strips
        .into_iter()
        .enumerate()
        .map(|(k, strip)| {
            let onward =
                samples[(k + 1).min(last)].point[0] - samples[k.saturating_sub(1)].point[0];
            let towards = samples[k].across[0].dot(onward) / onward.length();
            if !(towards.abs() > 1e-6) {
                return Err(Error::IrregularBoundary {
                    side: k,
                    t: 0.5,
                    across: towards,
                });
            }
            Ok(if towards < 0.0 {
                strip.flipped()
            } else {
                strip
            })
        })
        .collect()
}

/// The lengths `l_k` of the vectors `l_k h_k` (per unit of `v`) of least total bending
/// `sum (12 |D|² - 12 d D.(X + Y) + 4 d² (|X|² + X.Y + |Y|²)) / d³`, held above the least component across.
fn chain_lengths(samples: &[StripSample], widths: &[f64]) -> Result<Vec<f64>, Error> {
    let n = samples.len();
    let (mut matrix, mut right) = (DMatrix::<f64>::zeros(n, n), DVector::<f64>::zeros(n));
    let mut least = vec![f64::INFINITY; n];
    for (k, &d) in widths.iter().enumerate() {
        let chord = samples[k + 1].point[0] - samples[k].point[0];
        let [h0, h1] = [samples[k].across[0], samples[k + 1].across[0]];
        matrix[(k, k)] += 8.0 / d;
        matrix[(k + 1, k + 1)] += 8.0 / d;
        matrix[(k, k + 1)] += 4.0 * h0.dot(h1) / d;
        matrix[(k + 1, k)] += 4.0 * h0.dot(h1) / d;
        right[k] += 12.0 * chord.dot(h0) / (d * d);
        right[k + 1] += 12.0 * chord.dot(h1) / (d * d);
        for end in [k, k + 1] {
            least[end] = least[end].min(LEAST_ACROSS * chord.length() / d);
        }
    }
    let solution = matrix
        .cholesky()
        .ok_or(Error::DegenerateEnergy)?
        .solve(&right);
    Ok(solution
        .iter()
        .zip(least)
        .map(|(l, least)| l.max(least))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnalyticCurve, geodesic_curvature};

    fn helix(pitch: f64, z: f64) -> GeodesicStrip {
        GeodesicStrip::new(AnalyticCurve::new(move |t| {
            [t.cos(), t.sin(), t * pitch + z]
        }))
        .unwrap()
    }

    fn boundary(surface: &TwoCurveSurface) -> f64 {
        let places = (0..=20).map(|i| f64::from(i) / 20.0);
        places
            .flat_map(|u| [0.0, 1.0].map(|v| surface.partials(u, v)))
            .map(|at| geodesic_curvature(at.du, at.duu, at.du.cross(at.dv)).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn every_choice_of_the_free_functions_keeps_the_curves_geodesic() {
        let base = TwoCurveSurface::new([helix(0.3, 0.0), helix(-0.2, 1.5)]).unwrap();
        let polar = EndField::Polar {
            angle: ScalarFunction::formula(|u| u.sin() * 0.7),
            length: ScalarFunction::formula(|u| u * 0.4 + 1.0),
        };
        assert!(boundary(&base.clone().with_fields([polar.clone(), polar])) < 1e-14);
        for freedom in [Freedom::Lengths, Freedom::Vectors] {
            for criterion in [
                LocalCriterion::Bending,
                LocalCriterion::Stretching,
                LocalCriterion::SpeedVariation,
            ] {
                assert!(boundary(&base.clone().smoothed(criterion, freedom).unwrap()) < 1e-14);
            }
        }
        let global = base.clone().smoothed_globally(4).unwrap();
        assert!(boundary(&global) < 1e-14);
        // The global criterion is the least of its kind.
        let local = base
            .smoothed(LocalCriterion::Bending, Freedom::Vectors)
            .unwrap();
        assert!(global.thin_plate_energy() <= local.thin_plate_energy());
    }

    #[test]
    fn second_derivatives_are_those_of_the_surface() {
        let surface = TwoCurveSurface::new([helix(0.3, 0.0), helix(-0.2, 1.5)])
            .unwrap()
            .smoothed_globally(3)
            .unwrap();
        let (u, v, h) = (0.41, 0.3, 1e-5);
        let at = surface.partials(u, v);
        let [east, west] = [surface.partials(u + h, v), surface.partials(u - h, v)];
        assert!(((east.du - west.du) / (2.0 * h) - at.duu).length() < 1e-8);
        assert!(((east.dv - west.dv) / (2.0 * h) - at.duv).length() < 1e-8);
    }

    /// Minima against steps away from them, and the closed forms of the specification.
    #[test]
    fn local_criteria() {
        let arc = HermiteArc::new(
            [DVec3::ZERO, DVec3::new(1.5, 0.4, -0.2)],
            [
                DVec3::new(0.9, 0.3, 0.1).normalize(),
                DVec3::new(0.8, -0.4, 0.2).normalize(),
            ],
        );
        let energy = |criterion: LocalCriterion, [l0, l1]: [f64; 2]| {
            let rule = crate::quadrature::gauss(40);
            let density = |t: f64| {
                let h = hermite(t);
                let f = |o: usize| {
                    arc.points[1] * h[o][3]
                        + arc.directions[0] * (l0 * h[o][1])
                        + arc.directions[1] * (l1 * h[o][2])
                };
                match criterion {
                    LocalCriterion::Bending => f(2).length_squared(),
                    LocalCriterion::Stretching => f(1).length_squared(),
                    LocalCriterion::SpeedVariation => (f(1).dot(f(2)) / f(1).length()).powi(2),
                }
            };
            rule.iter().map(|(t, w)| w * density(*t)).sum::<f64>()
        };
        for criterion in [
            LocalCriterion::Bending,
            LocalCriterion::Stretching,
            LocalCriterion::SpeedVariation,
        ] {
            let LeastMagnitudes {
                magnitudes: [l0, l1],
                energy: least,
            } = arc.least(criterion);
            assert!(
                (energy(criterion, [l0, l1]) - least).abs() < 1e-6 * (1.0 + least),
                "{criterion:?}"
            );
            for (d0, d1) in [(1e-2, 0.0), (-1e-2, 0.0), (0.0, 1e-2), (0.0, -1e-2)] {
                assert!(
                    energy(criterion, [l0 + d0, l1 + d1]) > energy(criterion, [l0, l1]),
                    "{criterion:?}"
                );
            }
        }
    }

    #[test]
    fn a_chain_is_one_smooth_surface() {
        let strips = (0..5)
            .map(|k| helix(0.2 - 0.1 * f64::from(k), 0.8 * f64::from(k)))
            .collect();
        let chain = StripChain::new(strips, &[1.0, 0.9, 1.1, 1.0]).unwrap();
        assert_eq!(chain.surfaces().len(), 4);
        assert!(chain.joint_angle(16) < 1e-14 && chain.joint_jump(16) < 1e-13);
        for surface in chain.surfaces() {
            assert!(boundary(surface) < 1e-13);
            assert!((surface.point(0.4, 0.5).truncate().length() - 1.0).abs() < 1e-2);
        }
        assert!(matches!(
            StripChain::new(vec![helix(0.1, 0.0)], &[]),
            Err(Error::TooFew { .. })
        ));
        let two = || vec![helix(0.1, 0.0), helix(0.1, 1.0)];
        assert!(matches!(
            StripChain::new(two(), &[-1.0]),
            Err(Error::OutOfRange { .. })
        ));
        assert!(matches!(
            StripChain::new(two(), &[1.0, 1.0]),
            Err(Error::LengthMismatch { .. })
        ));
    }
}
