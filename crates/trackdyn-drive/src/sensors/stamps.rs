//! When a sensor looks, and what time it writes down.

use crate::random::{Purpose, stream};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::real;

/// Largest standard deviation of stamps, per interval: a uniform scatter of this one spans √12 ·
/// 0.25 =
/// 0.87 intervals, so that stamps keep their order.
pub(super) const MAX_JITTER: f64 = 0.25;

/// Moments at equal intervals from the start of a motion to its end.
///
/// An end that lies on the grid but for rounding is still seen.
pub(super) fn moments([start, end]: [f64; 2], interval: f64) -> impl Iterator<Item = f64> {
    (0..)
        .map(move |k| start + real(k) * interval)
        .take_while(move |t| *t <= end + 1e-9 * interval.max(1.0))
        .map(move |t| t.min(end))
}

/// A clock that stamps late, and never quite regularly.
pub(super) struct Stamper {
    random: ChaCha8Rng,
    delay: f64,
    jitter: f64,
}

impl Stamper {
    pub(super) fn new(seed: u64, run: i64, purpose: Purpose, delay: f64, jitter: f64) -> Self {
        Self { random: stream(seed, run, purpose), delay, jitter }
    }

    /// The stamp of what was seen at a time.
    pub(super) fn stamp(&mut self, t: f64) -> f64 {
        // uniform of unit variance
        let scatter = 12.0_f64.sqrt() * (self.random.random::<f64>() - 0.5);
        t + self.delay + self.jitter * scatter
    }
}
