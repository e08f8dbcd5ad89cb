//! Time per call, robust against a busy machine.

use std::hint::black_box;
use std::time::Duration;

/// Times work: batches long enough for the clock, the median over batches.
///
/// The clock is the CPU time of the calling thread where the system has one (wall time elsewhere), so
/// that other programs on the machine disturb little.
#[derive(Clone, Copy, Debug)]
pub struct Timer {
    /// Time to spend on each piece of work.
    budget: Duration,
}

/// Batches over which the median is taken; odd, so that the median was measured.
const BATCHES: usize = 11;

impl Timer {
    /// Spends about `budget` on each piece of work; a piece that takes longer is done three times.
    #[must_use]
    pub const fn new(budget: Duration) -> Self {
        Self { budget }
    }

    /// The median time of a call in nanoseconds, on the calling thread.
    pub fn nanoseconds<T>(&self, work: impl FnMut() -> T) -> f64 {
        self.median(work, thread_time)
    }

    /// The median time of a call in nanoseconds, of all threads of the program together.
    pub fn nanoseconds_of_all_threads<T>(&self, work: impl FnMut() -> T) -> f64 {
        self.median(work, process_time)
    }

    fn median<T>(&self, mut work: impl FnMut() -> T, clock: fn() -> f64) -> f64 {
        let batch = self.budget.as_secs_f64() / BATCHES as f64;
        let mut calls = 1_u64;
        // Double the batch until its length is worth timing; the doubling warms the caches too.
        let first = loop {
            let seconds = seconds(calls, &mut work, clock);
            if seconds >= 0.5 * batch || calls >= 1 << 40 {
                break seconds;
            }
            calls *= if seconds < 0.05 * batch { 8 } else { 2 };
        };
        // Work far longer than the budget is done three times, not eleven.
        let batches = if first > 2.0 * self.budget.as_secs_f64() {
            3
        } else {
            BATCHES
        };
        let mut times: Vec<f64> = (0..batches)
            .map(|_| seconds(calls, &mut work, clock))
            .collect();
        times.sort_by(f64::total_cmp);
        times[batches / 2] * 1e9 / calls as f64
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

fn seconds<T>(calls: u64, work: &mut impl FnMut() -> T, clock: fn() -> f64) -> f64 {
    let start = clock();
    for _ in 0..calls {
        black_box(work());
    }
    clock() - start
}

#[cfg(unix)]
fn clock(id: rustix::time::ClockId) -> f64 {
    let time = rustix::time::clock_gettime(id);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

#[cfg(unix)]
fn thread_time() -> f64 {
    clock(rustix::time::ClockId::ThreadCPUTime)
}

#[cfg(unix)]
fn process_time() -> f64 {
    clock(rustix::time::ClockId::ProcessCPUTime)
}

#[cfg(not(unix))]
fn thread_time() -> f64 {
    use std::sync::OnceLock;
    use std::time::Instant;
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

#[cfg(not(unix))]
fn process_time() -> f64 {
    thread_time()
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
