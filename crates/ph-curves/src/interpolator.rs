//! Real-time interpolation: the points that a tool passes at equal times, at a given feed rate along a PH path.

use glam::DVec2;

use crate::{Error, PhSpline};

/// The speed of a tool along its path, in length per unit of time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FeedRate {
    /// Always the same.
    Constant(f64),
    /// `start + acceleration * time`.
    LinearInTime {
        /// Speed at time 0.
        start: f64,
        /// Change per unit of time; a feed that comes to rest before the end of the path stops there.
        acceleration: f64,
    },
    /// From `start` to `end` in proportion to the length covered: an exponential in time.
    LinearInLength {
        /// Speed at the start of the path.
        start: f64,
        /// Speed at its end.
        end: f64,
    },
}

impl FeedRate {
    /// The length covered at `time`, on a path of length `total`; exact, by the closed integral of the law.
    #[must_use]
    pub fn length_covered(&self, time: f64, total: f64) -> f64 {
        match *self {
            Self::Constant(feed) => feed * time,
            Self::LinearInTime {
                start,
                acceleration,
            } => {
                let until_rest = if acceleration < 0.0 {
                    -start / acceleration
                } else {
                    f64::INFINITY
                };
                let time = time.min(until_rest);
                (start + 0.5 * acceleration * time) * time
            }
            Self::LinearInLength { start, end } => {
                let rate = (end - start) / total;
                if rate == 0.0 {
                    start * time
                } else {
                    start * (rate * time).exp_m1() / rate
                }
            }
        }
    }

    fn is_valid(&self) -> bool {
        let positive = |feed: f64| feed > 0.0 && feed.is_finite();
        match *self {
            Self::Constant(feed) => positive(feed),
            Self::LinearInTime {
                start,
                acceleration,
            } => {
                start >= 0.0
                    && start.is_finite()
                    && acceleration.is_finite()
                    && (start > 0.0 || acceleration > 0.0)
            }
            Self::LinearInLength { start, end } => positive(start) && positive(end),
        }
    }
}

/// One reference point of the interpolator.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FeedPoint {
    /// Time since the start.
    pub time: f64,
    /// Parameter on the path: span number plus parameter of the span.
    pub parameter: f64,
    /// The point.
    pub point: DVec2,
    /// The length covered, as commanded by the feed rate.
    pub length: f64,
    /// The length at the parameter found minus the commanded one: the error of the steps so far, in length units.
    pub length_error: f64,
}

/// The reference points at the times `0, period, 2 period, ...` until the end of the path: the iterator that a machine
/// control runs, one cheap and exact step at a time. On a path whose arc length is a polynomial the feed rate is met to
/// rounding, where other curves have to be integrated or approximated by Taylor steps.
#[derive(Clone, Debug)]
pub struct FeedInterpolator<'a> {
    path: &'a PhSpline,
    feed: FeedRate,
    period: f64,
    step: u64,
    span: usize,
    before: f64,
    resting: f64,
}

impl<'a> FeedInterpolator<'a> {
    /// Starts at the beginning of the path; `period` is the time between two points.
    ///
    /// # Errors
    ///
    /// [`Error::BadFeed`] unless the period is positive and finite and the feed rate is positive (zero is allowed at the
    /// start of an acceleration).
    pub fn try_new(path: &'a PhSpline, feed: FeedRate, period: f64) -> Result<Self, Error> {
        if !(feed.is_valid() && period > 0.0 && period.is_finite()) {
            return Err(Error::BadFeed { feed, period });
        }
        Ok(Self {
            path,
            feed,
            period,
            step: 0,
            span: 0,
            before: 0.0,
            resting: -1.0,
        })
    }
}

impl Iterator for FeedInterpolator<'_> {
    type Item = FeedPoint;

    fn next(&mut self) -> Option<FeedPoint> {
        let time = self.step as f64 * self.period;
        let length = self.feed.length_covered(time, self.path.length());
        // Past the end, or no longer moving: a feed that comes to rest would repeat its last point for ever.
        if length > self.path.length() || length <= self.resting {
            return None;
        }
        let mut arc = self.path.spans().get(self.span)?.arc_length();
        while length > self.before + arc.total() && self.span + 1 < self.path.spans().len() {
            self.before += arc.total();
            self.span += 1;
            arc = self.path.spans()[self.span].arc_length();
        }
        let within = (length - self.before).clamp(0.0, arc.total());
        let t = arc.parameter_at(within).ok()?;
        (self.resting, self.step) = (length, self.step + 1);
        Some(FeedPoint {
            time,
            parameter: self.span as f64 + t,
            point: self.path.spans()[self.span].point(t),
            length,
            length_error: self.before + arc.up_to(t) - length,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SplineEnds;

    fn path() -> PhSpline {
        let points = [(0.0, 0.0), (1.0, 0.5), (2.0, 1.2), (3.0, 0.3), (4.0, -0.5)]
            .map(|(x, y)| DVec2::new(x, y));
        let (start_derivative, end_derivative) = (DVec2::new(1.2, 0.4), DVec2::new(1.0, -0.8));
        PhSpline::interpolate(
            &points,
            SplineEnds::Clamped {
                start_derivative,
                end_derivative,
            },
        )
        .unwrap()
    }

    #[test]
    fn every_law_is_met_to_rounding() {
        let path = path();
        let laws = [
            FeedRate::Constant(0.7),
            FeedRate::LinearInTime {
                start: 0.0,
                acceleration: 0.3,
            },
            FeedRate::LinearInTime {
                start: 1.5,
                acceleration: -0.05,
            },
            FeedRate::LinearInLength {
                start: 0.2,
                end: 2.0,
            },
        ];
        for feed in laws {
            let points: Vec<FeedPoint> = FeedInterpolator::try_new(&path, feed, 0.01)
                .unwrap()
                .collect();
            assert!(points.len() > 100, "{feed:?}: {}", points.len());
            for pair in points.windows(2) {
                assert!(pair[1].length_error.abs() < 4.0 * f64::EPSILON * path.length());
                assert!(pair[1].parameter > pair[0].parameter);
                // The law itself, by the mean speed of a step.
                let speed = (pair[1].length - pair[0].length) / 0.01;
                let expected = match feed {
                    FeedRate::Constant(feed) => feed,
                    FeedRate::LinearInTime {
                        start,
                        acceleration,
                    } => start + acceleration * (pair[0].time + 0.005),
                    FeedRate::LinearInLength { start, end } => {
                        start
                            + (end - start) * 0.5 * (pair[0].length + pair[1].length)
                                / path.length()
                    }
                };
                assert!((speed - expected).abs() < 1e-4 * expected);
            }
            let rest = path.length() - points.last().unwrap().length;
            assert!((0.0..0.03).contains(&rest), "{feed:?} stops {rest} short");
        }
    }

    #[test]
    fn a_feed_that_comes_to_rest_ends() {
        let path = path();
        let feed = FeedRate::LinearInTime {
            start: 1.0,
            acceleration: -1.0,
        };
        let points: Vec<FeedPoint> = FeedInterpolator::try_new(&path, feed, 0.01)
            .unwrap()
            .collect();
        assert!((points.last().unwrap().length - 0.5).abs() < 1e-3);
    }

    #[test]
    fn hostile_feeds_are_refused() {
        let path = path();
        for (feed, period) in [
            (FeedRate::Constant(0.0), 1.0),
            (FeedRate::Constant(f64::NAN), 1.0),
            (FeedRate::Constant(1.0), 0.0),
            (
                FeedRate::LinearInTime {
                    start: 0.0,
                    acceleration: -1.0,
                },
                1.0,
            ),
            (
                FeedRate::LinearInLength {
                    start: 1.0,
                    end: 0.0,
                },
                1.0,
            ),
        ] {
            assert!(FeedInterpolator::try_new(&path, feed, period).is_err());
        }
    }
}
