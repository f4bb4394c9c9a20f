//! Confidence intervals from blocks of a recording ([`Blocks`](trackdyn_recording::Blocks)).
//!
//! # Law
//! Delete-one-block jackknife: σ² = (B − 1)/B Σ (θ₋ᵦ − θ̄)², interval θ ± t₀.₉₇₅(B − 1) σ. For the
//! mean over blocks of equal size this is Student's interval over the block means.
//!
//! # Sources
//! Efron and Tibshirani, An Introduction to the Bootstrap, 1993, chapter 11.

use trackdyn_core::real;

/// Fewer blocks have no interval.
pub const FEWEST: usize = 5;

/// A number with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number over all blocks.
    pub value: f64,
    /// Half the width of the interval; none where there are fewer than [`FEWEST`] blocks.
    pub half_width: Option<f64>,
}

impl Estimate {
    /// Both ends of the interval.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.half_width.map(|half| [self.value - half, self.value + half])
    }
}

/// Sums of one block, of which statistics are functions.
pub(crate) type Sums<const N: usize> = [f64; N];

/// A statistic of the sums over all blocks, with its interval; blocks without samples are left out
/// before.
pub(crate) fn estimate<const N: usize>(
    blocks: &[Sums<N>],
    statistic: impl Fn(&Sums<N>) -> f64,
) -> Estimate {
    let total =
        blocks.iter().fold([0.0; N], |total, block| std::array::from_fn(|k| total[k] + block[k]));
    let value = statistic(&total);
    let count = blocks.len();
    if count < FEWEST {
        return Estimate { value, half_width: None };
    }
    let without: Vec<f64> = blocks
        .iter()
        .map(|block| statistic(&std::array::from_fn(|k| total[k] - block[k])))
        .collect();
    let mean = without.iter().sum::<f64>() / real(count);
    let scatter: f64 = without.iter().map(|value| (value - mean) * (value - mean)).sum();
    // σ² = (B − 1)/B Σ (θ₋ᵦ − θ̄)²
    let sigma = (scatter * real(count - 1) / real(count)).sqrt();
    let half = student_975(count - 1) * sigma;
    Estimate { value, half_width: half.is_finite().then_some(half) }
}

/// The 97.5 % point of Student's t, to 0.1 %.
///
/// # Sources
/// Abramowitz and Stegun, 26.7.5.
fn student_975(degrees: usize) -> f64 {
    const FEW: [f64; 6] = [f64::INFINITY, 12.706, 4.303, 3.182, 2.776, 2.571];
    const Z: f64 = 1.959_963_984_540_054;
    if let Some(value) = FEW.get(degrees) {
        return *value;
    }
    let n = real(degrees);
    let (z3, z5, z7) = (Z.powi(3), Z.powi(5), Z.powi(7));
    Z + (z3 + Z) / (4.0 * n)
        + (5.0 * z5 + 16.0 * z3 + 3.0 * Z) / (96.0 * n * n)
        + (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * Z) / (384.0 * n.powi(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Abramowitz and Stegun, table 26.10.
        for (degrees, value) in [(1, 12.706), (6, 2.447), (10, 2.228), (30, 2.042), (120, 1.980)] {
            assert!((student_975(degrees) / value - 1.0).abs() < 1e-3, "{degrees}");
        }
    }

    #[test]
    fn equal_blocks_give_the_interval_of_student_over_their_means() {
        let means = [1.0, 2.0, 4.0, 3.0, 5.0, 3.0];
        let blocks: Vec<Sums<2>> = means.iter().map(|mean| [10.0, 10.0 * mean]).collect();
        let Estimate { value, half_width } = estimate(&blocks, |[count, sum]| sum / count);
        assert!((value - 3.0).abs() < 1e-12);
        // s² = (4 + 1 + 1 + 0 + 4 + 0)/5 = 2, standard error √(2/6)
        let half = student_975(5) * (2.0_f64 / 6.0).sqrt();
        assert!((half_width.expect("enough blocks") - half).abs() < 1e-12);
        assert_eq!(estimate(&blocks[..4], |[count, sum]| sum / count).half_width, None);
    }
}
