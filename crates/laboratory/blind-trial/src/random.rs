//! Random numbers: a stream for each purpose of each case, so that cases can be made in any order.

use crate::key::Root;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// What random numbers are for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    /// Which case is of which stratum.
    Plan = 0,
    /// The robot.
    Machine = 1,
    /// What its owner takes it for.
    Owner = 2,
    /// Schedules and starts.
    Driving = 3,
    /// Sensors and the errors of their mounts and clocks.
    Instruments = 4,
    /// What is concealed.
    Concealed = 5,
    /// Noise of the recording.
    Noise = 6,
    /// Places of shoes.
    Shoes = 7,
    /// Noise of what is recorded when a case is visited once more.
    Revisit = 8,
}

/// Purposes that a case has room for.
const PURPOSES: u64 = 64;

/// The stream of a case for a purpose; a case that has to be drawn anew takes another attempt.
pub(crate) fn stream(root: &Root, case: u64, attempt: u64, purpose: Purpose) -> ChaCha8Rng {
    const ATTEMPTS: u64 = 64;
    root.stream((case * ATTEMPTS + attempt) * PURPOSES + purpose as u64)
}

/// A number between two, uniform in its logarithm.
pub(crate) fn log_uniform(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.random::<f64>())
}

/// A number between two.
pub(crate) fn uniform(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.random::<f64>()
}

/// A number from the standard normal distribution.
pub(crate) fn normal(random: &mut ChaCha8Rng) -> f64 {
    random.sample(StandardNormal)
}

/// A whole number.
pub(crate) fn whole(random: &mut ChaCha8Rng) -> u32 {
    random.random()
}

/// Plus or minus one.
pub(crate) fn sign(random: &mut ChaCha8Rng) -> f64 {
    if random.random::<bool>() { 1.0 } else { -1.0 }
}

/// Whether something of this probability happens.
pub(crate) fn happens(random: &mut ChaCha8Rng, probability: f64) -> bool {
    random.random::<f64>() < probability
}
