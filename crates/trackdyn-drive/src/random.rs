//! Random numbers: a stream for each purpose of each run.
//!
//! Switching one noise off does not change the others, and a run does not depend on those before
//! it.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// What random numbers are for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    /// The hand of a driver.
    Hand = 0,
    /// The order of manoeuvres.
    Order = 1,
    /// Where encoders stand at the start.
    EncoderPhase = 2,
    /// Stamps of encoder readings.
    EncoderStamp = 3,
    /// Frame of the poses.
    PoseFrame = 4,
    /// Stamps of poses.
    PoseStamp = 5,
    /// White noise of poses.
    PoseWhite = 6,
    /// Walk of poses.
    PoseWalk = 7,
    /// Outlying poses.
    PoseOutlier = 8,
    /// Missing poses.
    PoseDropout = 9,
    /// Stamps of the IMU.
    ImuStamp = 10,
    /// Bias of the IMU.
    ImuBias = 11,
    /// White noise of the IMU.
    ImuWhite = 12,
}

/// Purposes that a run has room for.
const PURPOSES: u64 = 64;

/// The stream of a run for a purpose.
pub(crate) fn stream(seed: u64, run: i64, purpose: Purpose) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(run.cast_unsigned().wrapping_mul(PURPOSES).wrapping_add(purpose as u64));
    random
}

/// A number from the standard normal distribution.
pub(crate) fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}
