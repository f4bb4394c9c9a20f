//! Random draws by which chance is measured.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// How often something is drawn, and from which random numbers. Draws are independent of one
/// another and of the order in which they are made.
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
    /// A single draw, for what is asked of the statistic alone.
    pub fn once(self) -> Self {
        Self { draws: 1, ..self }
    }

    /// The random numbers of a draw.
    pub fn random(&self, draw: usize) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(draw as u64);
        random
    }
}
