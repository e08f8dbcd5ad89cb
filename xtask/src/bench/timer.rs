//! Time per call, robust against a busy machine.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Times work: batches long enough for the clock, the median over batches.
#[derive(Clone, Copy, Debug)]
pub struct Timer {
    /// Time to spend on each piece of work.
    budget: Duration,
}

/// Batches over which the median is taken; odd, so that the median was measured.
const BATCHES: usize = 11;

impl Timer {
    /// Spends about `budget` on each piece of work, and at least [`BATCHES`] calls where one alone is longer.
    #[must_use]
    pub const fn new(budget: Duration) -> Self {
        Self { budget }
    }

    /// The median time of a call in nanoseconds.
    pub fn nanoseconds<T>(&self, mut work: impl FnMut() -> T) -> f64 {
        let batch = self.budget.as_secs_f64() / BATCHES as f64;
        let mut calls = 1_u64;
        // Double the batch until its length is worth timing; the doubling warms the caches too.
        loop {
            let seconds = seconds(calls, &mut work);
            if seconds >= 0.5 * batch || calls >= 1 << 40 {
                break;
            }
            calls *= if seconds < 0.05 * batch { 8 } else { 2 };
        }
        let mut times: Vec<f64> = (0..BATCHES).map(|_| seconds(calls, &mut work)).collect();
        times.sort_by(f64::total_cmp);
        times[BATCHES / 2] * 1e9 / calls as f64
    }

    /// The times of a piece of work and of its peer, in nanoseconds, and their ratio. The two take
    /// turns, so that a busy machine disturbs both.
    pub fn against<T, U>(
        &self,
        mut work: impl FnMut() -> T,
        mut peer: impl FnMut() -> U,
    ) -> (f64, f64, f64) {
        let third = Self::new(self.budget / 3);
        let mut turns: Vec<(f64, f64)> = (0..3)
            .map(|_| (third.nanoseconds(&mut work), third.nanoseconds(&mut peer)))
            .collect();
        turns.sort_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
        let (ours, theirs) = turns[1];
        (ours, theirs, ours / theirs)
    }
}

fn seconds<T>(calls: u64, work: &mut impl FnMut() -> T) -> f64 {
    let start = Instant::now();
    for _ in 0..calls {
        black_box(work());
    }
    start.elapsed().as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longer_work_takes_longer() {
        let timer = Timer::new(Duration::from_millis(5));
        let sum = |n: u64| move || (0..n).map(black_box).sum::<u64>();
        let (long, short, ratio) = timer.against(sum(4000), sum(100));
        assert!(long > short && ratio > 4.0, "{long} {short} {ratio}");
    }
}
