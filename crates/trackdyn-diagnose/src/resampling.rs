//! Random draws of the bootstrap.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Number of bootstrap draws and their seed. Each draw has its own random stream, independent of
/// the order of evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resampling {
    /// Number of draws.
    pub draws: usize,
    /// Seed of all of them.
    pub seed: u64,
}

impl Default for Resampling {
    fn default() -> Self {
        Self { draws: 2000, seed: 1 }
    }
}

impl Resampling {
    /// A single draw, where only the statistic is needed, not its p value.
    pub fn once(self) -> Self {
        Self { draws: 1, ..self }
    }

    /// Random stream of a draw.
    pub fn random(&self, draw: usize) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(draw as u64);
        random
    }
}
