//! Coloured noise: an Ornstein-Uhlenbeck process, or the random walk that it is without a memory's
//! end.
//!
//! # Law
//! dx = −x/τ dt + √q dW. Over a step h, x' = x e^(−h/τ) + ξ with Var ξ = q τ/2 (1 − e^(−2h/τ)),
//! exactly (Gillespie, Phys. Rev. E 54(2), 1996, 2084-2091). With a memory τ it starts in its
//! stationary state, Var x = q τ/2; a walk (τ = ∞, Var ξ = q h) starts at zero.

use crate::random::normal;
use rand_chacha::ChaCha8Rng;

/// The process of one coordinate.
pub(super) struct Process {
    /// √q, unit per √s.
    strength: f64,
    /// τ, s.
    memory: Option<f64>,
    value: f64,
}

impl Process {
    pub(super) fn new(strength: f64, memory: Option<f64>, random: &mut ChaCha8Rng) -> Self {
        let drawn = normal(random);
        let value = memory.map_or(0.0, |memory| strength * (memory / 2.0).sqrt() * drawn);
        Self { strength, memory, value }
    }

    /// The value after a step, s.
    pub(super) fn after(&mut self, step: f64, random: &mut ChaCha8Rng) -> f64 {
        let (keep, variance) = match self.memory {
            None => (1.0, step),
            // 1 − e^(−2h/τ) loses no digits for short steps
            Some(memory) => {
                ((-step / memory).exp(), -memory / 2.0 * (-2.0 * step / memory).exp_m1())
            }
        };
        self.value = keep * self.value + self.strength * variance.sqrt() * normal(random);
        self.value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, stream};

    #[test]
    fn variance_and_memory_are_those_of_the_law() {
        let mut random = stream(3, 0, Purpose::PoseWalk);
        let (strength, memory, step) = (0.02, 0.5, 0.1);
        let mut process = Process::new(strength, Some(memory), &mut random);
        let count = 200_000;
        let values: Vec<f64> = (0..count).map(|_| process.after(step, &mut random)).collect();
        let mean = |products: &mut dyn Iterator<Item = f64>| products.sum::<f64>() / 200_000.0;
        let variance = mean(&mut values.iter().map(|x| x * x));
        let next = mean(&mut values.windows(2).map(|pair| pair[0] * pair[1]));
        // Ten steps in two memories: 200 000 values are some 20 000 independent ones, which tell a
        // variance to 1 %. 4 % is four deviations.
        let expected = strength * strength * memory / 2.0;
        assert!((variance / expected - 1.0).abs() < 0.04, "{variance} {expected}");
        assert!((next / variance - (-step / memory).exp()).abs() < 0.02);
    }

    #[test]
    fn a_walk_grows_with_the_root_of_time() {
        let mut random = stream(4, 0, Purpose::PoseWalk);
        let ends: f64 = (0..4000)
            .map(|_| {
                let mut process = Process::new(0.01, None, &mut random);
                (0..25).map(|_| process.after(0.2, &mut random)).last().unwrap_or_default()
            })
            .map(|end| end * end)
            .sum();
        // 5 s; 4000 walks tell the variance to 2.2 %
        assert!((ends / 4000.0 / (1e-4 * 5.0) - 1.0).abs() < 0.09, "{ends}");
    }
}
