//! Residuals of a recording in which nothing is missing.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use trackdyn_diagnose::Evidence;

/// What the whitened residuals are.
#[derive(Clone, Copy, Debug)]
pub enum Noise {
    /// As they are taken to be.
    White,
    /// Student's t of three degrees of freedom with unit variance: outliers.
    HeavyTailed,
    /// White, and as large a slip of the moment that is forgotten after five segments.
    Coloured,
    /// White, and up to three times as large in some blocks as in others.
    Uneven,
}

impl Noise {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::White, Self::HeavyTailed, Self::Coloured, Self::Uneven];

    /// A residual per sample.
    pub fn draw(self, evidence: &Evidence, seed: u64) -> Vec<Vector3<f64>> {
        /// Part of a slip that is left after a segment.
        const KEPT_SHARE: f64 = 0.8;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(self as u64);
        let sizes: Vec<f64> =
            (0..evidence.blocks()).map(|_| 1.0 + 2.0 * random.random::<f64>()).collect();
        let mut slip = Vector3::zeros();
        let mut run = usize::MAX;
        let samples = evidence.samples().iter();
        samples
            .map(|sample| {
                let mut white = || Vector3::<f64>::from_fn(|_, _| random.sample(StandardNormal));
                let z = white();
                match self {
                    Self::White => z,
                    Self::HeavyTailed => {
                        // t = z √(ν/χ²), of variance ν/(ν − 2)
                        let chi2 = white().norm_squared();
                        z / chi2.sqrt()
                    }
                    Self::Coloured => {
                        let kick = white();
                        slip = if sample.run == run {
                            slip * KEPT_SHARE + kick * (1.0 - KEPT_SHARE * KEPT_SHARE).sqrt()
                        } else {
                            kick
                        };
                        run = sample.run;
                        z + slip
                    }
                    Self::Uneven => z * sizes[sample.block],
                }
            })
            .collect()
    }
}
