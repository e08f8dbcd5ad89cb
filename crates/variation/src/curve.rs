//! Bézier curves met by lines, rays, segments, circles and implicit curves; extrema and inflections.

use glam::{DVec2, DVec3};

use crate::Error;
use crate::arithmetic::{self, Form, Number, add, binomial, convolve, roots_of, subtract};
use crate::bound::{ChainBound, chain_bound};
use crate::line::{
    ChordForm, CircleForm, ImplicitCurve, ImplicitForm, Line, LineForm, check_finite,
};
use crate::root::{Interval, Root, Roots};
use crate::solver::Solver;

/// A plane Bézier curve over `[0, 1]`, polynomial or rational with positive weights; a view of the caller's points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve<'a> {
    points: &'a [DVec2],
    weights: Option<&'a [f64]>,
}

/// A hit: a root of the reduced polynomial, with the multiplicity of the contact, and the point there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit {
    /// The parameter, enclosed. A tangency is one hit of multiplicity 2.
    pub root: Root,
    /// The point of the curve at [`Root::value`].
    pub point: DVec2,
}

impl<'a> Curve<'a> {
    /// The polynomial curve with these control points.
    ///
    /// # Errors
    /// [`Error::NoControlPoints`], [`Error::NotFinite`].
    pub fn polynomial(points: &'a [DVec2]) -> Result<Self, Error> {
        if points.is_empty() {
            return Err(Error::NoControlPoints);
        }
        for (i, p) in points.iter().enumerate() {
            check_finite([p.x, p.y]).map_err(|error| match error {
                Error::NotFinite { index, value } => Error::NotFinite {
                    index: 2 * i + index,
                    value,
                },
                other => other,
            })?;
        }
        Ok(Self {
            points,
            weights: None,
        })
    }

    /// The rational curve with these control points (affine, not multiplied by the weights) and positive weights.
    ///
    /// # Errors
    /// As [`Curve::polynomial`]; [`Error::WeightCount`], [`Error::NotFinite`], [`Error::WeightNotPositive`].
    pub fn rational(points: &'a [DVec2], weights: &'a [f64]) -> Result<Self, Error> {
        let curve = Self::polynomial(points)?;
        check_weights(points.len(), weights)?;
        Ok(Self {
            weights: Some(weights),
            ..curve
        })
    }

    /// The degree.
    #[must_use]
    pub fn degree(self) -> usize {
        self.points.len() - 1
    }

    /// The control points.
    #[must_use]
    pub fn points(self) -> &'a [DVec2] {
        self.points
    }

    /// The weights, unless all are 1.
    #[must_use]
    pub fn weights(self) -> Option<&'a [f64]> {
        self.weights
    }

    pub(crate) fn weighted_points(self) -> impl Iterator<Item = (DVec2, f64)> + 'a {
        let weights = self.weights.unwrap_or(&[]);
        self.points
            .iter()
            .enumerate()
            .map(move |(i, p)| (*p, weights.get(i).copied().unwrap_or(1.0)))
    }

    /// The point at `t` in `[0, 1]`, by de Casteljau's algorithm.
    #[must_use]
    pub fn point(self, t: f64) -> DVec2 {
        let mut row: Vec<DVec3> = self
            .weighted_points()
            .map(|(p, w)| (p * w).extend(w))
            .collect();
        while row.len() > 1 {
            for i in 0..row.len() - 1 {
                row[i] = row[i] * (1.0 - t) + row[i + 1] * t;
            }
            row.pop();
        }
        row.first().map_or(DVec2::NAN, |p| p.truncate() / p.z)
    }

    /// All hits with a line, by ascending parameter; a tangency is one hit of multiplicity 2, an end is hit once.
    ///
    /// # Errors
    /// [`Error::LiesOn`] if the whole curve lies on the line.
    ///
    /// # Examples
    /// ```
    /// use glam::DVec2;
    /// use variation::{Curve, Line};
    /// let points = [(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 0.0)].map(DVec2::from);
    /// let hits = Curve::polynomial(&points)?.meet_line(Line::try_new(0.0, 1.0, 0.0)?)?;
    /// assert_eq!(hits.len(), 3);
    /// assert!((hits[1].point - DVec2::new(1.5, 0.0)).length() < 1e-11);
    /// # Ok::<(), variation::Error>(())
    /// ```
    pub fn meet_line(self, line: Line) -> Result<Vec<Hit>, Error> {
        self.hits(&LineForm { curve: self, line })
    }

    /// All hits with the ray from `origin` in `direction`, which are taken exactly.
    ///
    /// A hit within rounding of the origin counts.
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::ZeroNormal`] for a zero direction; [`Error::LiesOn`] if the curve lies on the line of the ray.
    pub fn meet_ray(self, origin: DVec2, direction: DVec2) -> Result<Vec<Hit>, Error> {
        check_finite([origin.x, origin.y, direction.x, direction.y])?;
        let form = ChordForm {
            curve: self,
            from: origin,
            to: direction,
            base: DVec2::ZERO,
        };
        self.meet_chord(&form, |share| share >= 0.0)
    }

    /// All hits with the segment from `from` to `to`, ends included.
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::ZeroNormal`] for equal ends; [`Error::LiesOn`] if the curve lies on the line of the segment.
    pub fn meet_segment(self, from: DVec2, to: DVec2) -> Result<Vec<Hit>, Error> {
        check_finite([from.x, from.y, to.x, to.y])?;
        let form = ChordForm {
            curve: self,
            from,
            to,
            base: from,
        };
        self.meet_chord(&form, |share| (0.0..=1.0).contains(&share))
    }

    /// The hits whose share along the chord is kept. A hit within rounding of an end counts.
    fn meet_chord(
        self,
        form: &ChordForm<'_>,
        keep: impl Fn(f64) -> bool,
    ) -> Result<Vec<Hit>, Error> {
        if form.to == form.base {
            return Err(Error::ZeroNormal);
        }
        let along = form.to - form.base;
        let size = self
            .points
            .iter()
            .fold(form.from.abs(), |m, p| m.max(p.abs()))
            .max_element();
        // A point moves by at most twice the degree times its size over the unit interval.
        let reach = 2.0 * self.degree() as f64 * size + along.length();
        let mut hits = self.hits(form)?;
        hits.retain(|hit| {
            let share = (hit.point - form.from).dot(along) / along.length_squared();
            let slack = reach * (hit.root.width() + 8.0 * f64::EPSILON) / along.length();
            keep(share) || keep(share - slack) || keep(share + slack)
        });
        Ok(hits)
    }

    /// All hits with the circle about `centre`.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::Radius`]; [`Error::LiesOn`] if the curve is an arc of the circle;
    /// [`Error::DegreeTooHigh`] beyond degree 60.
    pub fn meet_circle(self, centre: DVec2, radius: f64) -> Result<Vec<Hit>, Error> {
        check_finite([centre.x, centre.y, radius])?;
        if radius <= 0.0 {
            return Err(Error::Radius { radius });
        }
        self.hits(&CircleForm {
            curve: self,
            centre,
            radius,
        })
    }

    /// All hits with an implicit curve of degree `m`: the roots of a polynomial of degree `n m`.
    ///
    /// # Errors
    /// [`Error::LiesOn`]; [`Error::DegreeTooHigh`] beyond `n m = 120`.
    pub fn meet_implicit(self, implicit: &ImplicitCurve) -> Result<Vec<Hit>, Error> {
        self.hits(&ImplicitForm {
            curve: self,
            implicit,
        })
    }

    fn hits(self, form: &impl Form) -> Result<Vec<Hit>, Error> {
        let mut solver = Solver::new();
        let roots = roots_of(form, Interval::UNIT, &mut solver).map_err(|error| match error {
            Error::IdenticallyZero => Error::LiesOn,
            other => other,
        })?;
        Ok(roots
            .iter()
            .map(|root| Hit {
                root: *root,
                point: self.point(root.value()),
            })
            .collect())
    }

    /// The polynomial `w_i (a x_i + b y_i + c)` whose roots are the hits with a line; its [`crate::sign_changes`] are the
    /// crossings of the control polygon. Rounded.
    #[must_use]
    pub fn line_coefficients(self, line: Line) -> Vec<f64> {
        self.weighted_points()
            .map(|(p, w)| w * line.value(p))
            .collect()
    }

    /// The polynomial whose roots are the hits with an implicit curve. Rounded.
    ///
    /// # Errors
    /// [`Error::DegreeTooHigh`].
    pub fn implicit_coefficients(self, implicit: &ImplicitCurve) -> Result<Vec<f64>, Error> {
        Ok(arithmetic::coefficients(&ImplicitForm {
            curve: self,
            implicit,
        })?
        .0)
    }

    /// A bound for the number of hits with a line, without solving, by a chain of poles. Decided in `f64`, so it holds for the
    /// rounded [`Curve::line_coefficients`].
    ///
    /// # Errors
    /// As [`chain_bound`].
    pub fn line_bound(self, line: Line, poles: &[f64]) -> Result<ChainBound<f64>, Error> {
        chain_bound(&self.line_coefficients(line), poles)
    }

    /// Parameters where the curve has a tangent across `direction`: the extrema of `direction . P(t)`, and its ends if the
    /// derivative vanishes there.
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::IdenticallyZero`] where `direction . P` is constant; [`Error::DegreeTooHigh`].
    pub fn extrema(self, direction: DVec2) -> Result<Roots, Error> {
        check_finite([direction.x, direction.y])?;
        if self.degree() == 0 {
            return Err(Error::IdenticallyZero);
        }
        let mut solver = Solver::new();
        roots_of(
            &ExtremaForm {
                curve: self,
                direction,
            },
            Interval::UNIT,
            &mut solver,
        )
        .map(Roots::from_slice)
    }

    /// Parameters where the curvature changes sign or the curve has a cusp.
    ///
    /// # Errors
    /// [`Error::IdenticallyZero`] for a straight curve; [`Error::DegreeTooHigh`].
    pub fn inflections(self) -> Result<Roots, Error> {
        if self.degree() < 2 {
            return Err(Error::IdenticallyZero);
        }
        let mut solver = Solver::new();
        roots_of(&InflectionForm { curve: self }, Interval::UNIT, &mut solver)
            .map(Roots::from_slice)
    }
}

pub(crate) fn check_weights(points: usize, weights: &[f64]) -> Result<(), Error> {
    if weights.len() != points {
        return Err(Error::WeightCount {
            points,
            weights: weights.len(),
        });
    }
    for (index, &weight) in weights.iter().enumerate() {
        if !weight.is_finite() {
            return Err(Error::NotFinite {
                index,
                value: weight,
            });
        }
        if weight <= 0.0 {
            return Err(Error::WeightNotPositive { index, weight });
        }
    }
    Ok(())
}

/// The numerator of the derivative of `direction . P`.
struct ExtremaForm<'a> {
    curve: Curve<'a>,
    direction: DVec2,
}

impl Form for ExtremaForm<'_> {
    fn degree(&self) -> usize {
        let n = self.curve.degree();
        if self.curve.weights.is_some() {
            2 * n - 2
        } else {
            n - 1
        }
    }

    /// Polynomial: differences. Rational, `F / G` with homogeneous `F(u, v)`, `G(u, v)` and `v = 1 - u`: by Euler's relation
    /// `F' G - F G' = (F_u G_v - F_v G_u) / n`.
    fn scaled<N: Number>(&self) -> Vec<N> {
        let n = self.curve.degree();
        let height = |p: DVec2| {
            N::exactly(self.direction.x)
                .product(&N::exactly(p.x))
                .sum(&N::exactly(self.direction.y).product(&N::exactly(p.y)))
        };
        if self.curve.weights.is_none() {
            let heights: Vec<N> = self.curve.points.iter().map(|p| height(*p)).collect();
            let difference =
                |(i, pair): (usize, &[N])| pair[1].difference(&pair[0]).times(binomial(n - 1, i));
            return heights.windows(2).enumerate().map(difference).collect();
        }
        let f = crate::line::weighted(self.curve, height);
        let g = crate::line::weighted(self.curve, |_| N::exactly(1.0));
        let by_u = |c: &[N]| (1..=n).map(|i| c[i].times(i as u128)).collect::<Vec<N>>();
        let by_v = |c: &[N]| {
            (0..n)
                .map(|i| c[i].times((n - i) as u128))
                .collect::<Vec<N>>()
        };
        subtract(
            &convolve(&by_u(&f), &by_v(&g)),
            &convolve(&by_v(&f), &by_u(&g)),
        )
    }
}

/// `P' x P''` up to a positive factor.
struct InflectionForm<'a> {
    curve: Curve<'a>,
}

impl InflectionForm<'_> {
    /// The scaled polynomial of degree `n - 2` with the values from number `k` on.
    fn part<N: Number>(&self, values: &[N], k: usize) -> Vec<N> {
        let size = self.curve.degree() - 1;
        let part = values.iter().skip(k).take(size);
        part.enumerate()
            .map(|(i, v)| v.times(binomial(size - 1, i)))
            .collect()
    }
}

impl Form for InflectionForm<'_> {
    fn degree(&self) -> usize {
        let n = self.curve.degree();
        if self.curve.weights.is_some() {
            3 * (n - 2)
        } else {
            2 * (n - 2)
        }
    }

    /// Polynomial: with `d_k = sum B_i^(n-2) (P_(i+k+1) - P_(i+k))`, `P'` and `P''` are combinations of `d_0` and `d_1`, and
    /// their product is that of `d_0` and `d_1`. Rational: likewise the determinant of the three points before the last
    /// two steps of de Casteljau, in homogeneous coordinates.
    fn scaled<N: Number>(&self) -> Vec<N> {
        let exactly = |f: &dyn Fn(DVec2, f64) -> (f64, f64)| -> Vec<N> {
            self.curve
                .weighted_points()
                .map(|(p, w)| {
                    let (a, b) = f(p, w);
                    N::exactly(a).product(&N::exactly(b))
                })
                .collect()
        };
        let x = exactly(&|p, w| (p.x, w));
        let y = exactly(&|p, w| (p.y, w));
        if self.curve.weights.is_none() {
            let differences = |c: &[N]| {
                c.windows(2)
                    .map(|p| p[1].difference(&p[0]))
                    .collect::<Vec<N>>()
            };
            let (x, y) = (differences(&x), differences(&y));
            let cross = |i: usize, j: usize| convolve(&self.part(&x, i), &self.part(&y, j));
            return subtract(&cross(0, 1), &cross(1, 0));
        }
        let w = exactly(&|_, w| (w, 1.0));
        let [x, y, w] = [x, y, w].map(|c| [0, 1, 2].map(|k| self.part(&c, k)));
        let minor = |i: usize, j: usize| subtract(&convolve(&x[i], &y[j]), &convolve(&y[i], &x[j]));
        let product = |k: usize, i: usize, j: usize| convolve(&w[k], &minor(i, j));
        subtract(
            &add(&product(0, 1, 2), &product(2, 0, 1)),
            &product(1, 0, 2),
        )
    }
}
