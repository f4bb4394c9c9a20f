//! Evidence for a number in two sets: in neither, in one of them, one size in both, or two sizes.
//!
//! # Law
//! Each set knows the number as a normal likelihood N(l; θ, s²). With θ ~ N(m, p²) before:
//!
//! none: N(l₁; m, s₁²) N(l₂; m, s₂²),  first alone: N(l₁; m, p² + s₁²) N(l₂; m, s₂²),
//! two: N(l₁; m, p² + s₁²) N(l₂; m, p² + s₂²),
//! the same: N(l₁ − l₂; 0, s₁² + s₂²) N(l̄; m, p² + s̄²), with l̄ the weighted mean of both and
//! 1/s̄² = 1/s₁² + 1/s₂²

use crate::normal::Prior;
use std::f64::consts::TAU;

/// What two sets may have of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Alternatives {
    /// ln evidence that neither has it.
    pub none: f64,
    /// That the first alone has it.
    pub first: f64,
    /// That the second alone has it.
    pub second: f64,
    /// That both have it in one size.
    pub same: f64,
    /// That both have it in different sizes.
    pub different: f64,
}

impl Alternatives {
    /// Alternatives by the value and the variance in each set.
    pub fn of(likelihoods: [[f64; 2]; 2], prior: &Prior) -> Self {
        let ([[l_1, v_1], [l_2, v_2]], m, p) = (likelihoods, prior.mean, prior.deviation.powi(2));
        let [none_1, none_2] = [ln_normal(l_1 - m, v_1), ln_normal(l_2 - m, v_2)];
        let [some_1, some_2] = [ln_normal(l_1 - m, p + v_1), ln_normal(l_2 - m, p + v_2)];
        let both = (v_1.recip() + v_2.recip()).recip();
        let mean = both * (l_1 / v_1 + l_2 / v_2);
        Self {
            none: none_1 + none_2,
            first: some_1 + none_2,
            second: none_1 + some_2,
            same: ln_normal(l_1 - l_2, v_1 + v_2) + ln_normal(mean - m, p + both),
            different: some_1 + some_2,
        }
    }

    /// The sum over independent numbers.
    pub fn plus(self, other: Self) -> Self {
        Self {
            none: self.none + other.none,
            first: self.first + other.first,
            second: self.second + other.second,
            same: self.same + other.same,
            different: self.different + other.different,
        }
    }

    /// ln Bayes factor of a difference against none.
    pub fn for_difference(&self) -> f64 {
        self.first.max(self.second).max(self.different) - self.none.max(self.same)
    }
}

/// ln N(x; 0, v)
fn ln_normal(x: f64, v: f64) -> f64 {
    -0.5 * (x * x / v + (TAU * v).ln())
}

/// ln Bayes factor of one size against two, from posterior means and variances.
pub fn shared_gain(posteriors: [[f64; 2]; 2], prior: &Prior) -> f64 {
    let [Some(a), Some(b)] = posteriors.map(|one| likelihood(one, prior)) else { return 0.0 };
    let Alternatives { same, different, .. } = Alternatives::of([a, b], prior);
    same - different
}

/// Value and variance of a likelihood whose posterior has this mean and variance; none where it is
/// no narrower than the prior.
fn likelihood([mean, variance]: [f64; 2], prior: &Prior) -> Option<[f64; 2]> {
    let known = prior.deviation.powi(-2);
    let precision = variance.recip() - known;
    (precision > 1e-6 * known)
        .then(|| [(mean / variance - known * prior.mean) / precision, precision.recip()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sizes_need_evidence_and_one_needs_less() {
        let prior = Prior::normal(0.0, 1.0);
        let of = |a: f64, b: f64| Alternatives::of([[a, 1e-4], [b, 1e-4]], &prior);
        // ln(p/s) is 4.6: what one size more costs
        assert!(of(0.5, 0.5).for_difference() < -3.0);
        assert!(of(0.0, 0.0).for_difference() < -3.0);
        let only = of(0.0, 0.5);
        assert!(only.for_difference() > 100.0 && only.second > only.different);
        let both = of(0.3, 0.5);
        assert!(both.for_difference() > 50.0 && both.different > both.second);
        // a posterior is the likelihood and the prior: the evidence is that of the likelihoods
        let posterior = |l: f64, v: f64| {
            let variance = (v.recip() + 1.0).recip();
            [variance * l / v, variance]
        };
        let gain = shared_gain([posterior(0.3, 0.04), posterior(0.5, 0.09)], &prior);
        let Alternatives { same, different, .. } =
            Alternatives::of([[0.3, 0.04], [0.5, 0.09]], &prior);
        assert!((gain - (same - different)).abs() < 1e-9);
        assert!(shared_gain([[0.3, 1.0], [0.5, 0.1]], &prior).abs() < 1e-12);
    }
}
