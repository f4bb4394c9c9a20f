//! What forms are drawn from.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Random numbers of a form.
#[derive(Clone, Debug)]
pub struct Draws(ChaCha8Rng);

impl Draws {
    /// Those that follow from a number.
    pub(super) fn of(number: u32) -> Self {
        Self(ChaCha8Rng::seed_from_u64(u64::from(number)))
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Between two positive numbers, uniform in the logarithm.
    pub fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.0.random::<f64>())
    }

    /// A whole number between two, both included.
    pub fn whole(&mut self, low: u32, high: u32) -> u32 {
        self.0.random_range(low..=high)
    }

    /// Whether something of this probability happens.
    pub fn happens(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    /// Positive parts of a whole, none below a fifth of an even one.
    pub fn shares(&mut self, parts: u32) -> Vec<f64> {
        let drawn: Vec<f64> = (0..parts).map(|_| self.between(0.2, 1.0)).collect();
        let sum: f64 = drawn.iter().sum();
        drawn.into_iter().map(|part| part / sum).collect()
    }
}
