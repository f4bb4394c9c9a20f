//! Intervals of 95 % from the scatter between blocks of a recording ([`Blocks`](crate::Blocks)).
//!
//! # Sources
//! Efron and Tibshirani, An Introduction to the Bootstrap, 1993, chapter 11.

use statrs::distribution::{ContinuousCDF, StudentsT};
use trackdyn_core::real;

/// z₀.₉₇₅ of the normal distribution: half of a 95 % interval, in standard deviations.
pub const NORMAL_QUANTILE: f64 = 1.959_964;

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Student's interval by the jackknife. `without` holds the number with each block left out in
    /// turn: one value more than there are degrees of freedom. None with fewer than two blocks. For
    /// the mean over blocks of equal size it is Student's interval over the block means.
    ///
    /// θ ± t₀.₉₇₅(B − 1) σ, σ² = (B − 1)/B Σ (θ₋ᵦ − θ̄)²
    pub fn of_jackknife(value: f64, without: &[f64]) -> Option<Self> {
        if without.len() < 2 {
            return None;
        }
        let blocks = real(without.len());
        let mean = without.iter().sum::<f64>() / blocks;
        let scatter: f64 = without.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (scatter * (blocks - 1.0) / blocks).sqrt();
        Some(Self::new(value, deviation, without.len(), 1)).filter(|_| deviation.is_finite())
    }

    /// Student's interval; the degrees of freedom are the blocks less the parameters.
    pub fn new(value: f64, deviation: f64, blocks: usize, parameters: usize) -> Self {
        let freedom = real(blocks.saturating_sub(parameters).max(1));
        let quantile = StudentsT::new(0.0, 1.0, freedom)
            .map_or(NORMAL_QUANTILE, |student| student.inverse_cdf(0.975));
        let half = quantile * deviation;
        Self { value, deviation, low: value - half, high: value + half }
    }

    /// The interval of `numerator` over this number, which is above 0: χ = L/(x_r − x_l) has its
    /// low end at the high end of the distance, and no high end where the distance may be 0.
    pub fn dividing(&self, numerator: f64) -> Self {
        let Self { value, deviation, low, high } = *self;
        Self {
            value: numerator / value,
            deviation: numerator / value.powi(2) * deviation,
            low: numerator / high,
            high: if low > 0.0 { numerator / low } else { f64::INFINITY },
        }
    }

    /// This interval, widened by an independent normal error of this standard deviation.
    #[must_use]
    pub fn with_error(&self, deviation: f64) -> Self {
        let Self { value, deviation: own, low, high } = *self;
        let half = |half: f64| half.hypot(NORMAL_QUANTILE * deviation);
        let (low, high) = (value - half(value - low), value + half(high - value));
        Self { value, deviation: own.hypot(deviation), low, high }
    }

    /// Half its width.
    pub fn half_width(&self) -> f64 {
        (self.high - self.low) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, table 26.10.
    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (freedom, value) in [(1, 12.706), (6, 2.447), (10, 2.228), (30, 2.042), (120, 1.980)] {
            let half = Interval::new(0.0, 1.0, freedom + 1, 1).half_width();
            assert!((half - value).abs() < 5e-4, "{freedom}: {half}");
        }
    }

    #[test]
    fn an_error_beside_widens_by_the_sum_of_squares() {
        let found = Interval::new(2.0, 0.03, 7, 1).with_error(0.0);
        assert_eq!(found, Interval::new(2.0, 0.03, 7, 1));
        let wide = found.with_error(0.04);
        // t₀.₉₇₅(6) = 2.447, z₀.₉₇₅ = 1.960
        let half = (2.447_f64 * 0.03).hypot(1.960 * 0.04);
        assert!((wide.half_width() - half).abs() < 1e-4 && wide.value == 2.0, "{wide:?}");
        assert!((wide.deviation - 0.05).abs() < 1e-12);
    }

    #[test]
    fn blocks_left_out_of_a_mean_give_the_interval_of_student() {
        let blocks = [1.0, 2.0, 4.0, 3.0, 5.0, 3.0];
        let without: Vec<f64> = blocks.iter().map(|block| (18.0 - block) / 5.0).collect();
        let interval = Interval::of_jackknife(3.0, &without).expect("blocks");
        // s² = (4 + 1 + 1 + 0 + 4 + 0)/5 = 2, standard error √(2/6), t₀.₉₇₅(5) = 2.570582
        let half = 2.570_582 * (2.0_f64 / 6.0).sqrt();
        assert!((interval.half_width() - half).abs() < 1e-6, "{interval:?}");
        assert_eq!(Interval::of_jackknife(3.0, &without[..1]), None);
    }
}
