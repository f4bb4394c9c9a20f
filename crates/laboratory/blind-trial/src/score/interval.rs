//! Intervals of rates and of middles.

use statrs::distribution::{Beta, Binomial, ContinuousCDF, DiscreteCDF};
use statrs::statistics::Statistics;
use trackdyn_core::real;

/// Chance that an interval lies above what it is an interval of, and that it lies below.
const TAIL_PROBABILITY: f64 = 0.025;

/// The interval of 95 % of a rate by Clopper and Pearson: it covers the true rate in at least 95 of
/// 100 trials, however few the cases. None without cases.
///
/// # Sources
/// Clopper and Pearson, Biometrika 26 (1934), 404-413, by quantiles of the beta distribution.
pub fn clopper_pearson(successes: usize, cases: usize) -> Option<[f64; 2]> {
    if cases == 0 || successes > cases {
        return None;
    }
    let (k, n) = (real(successes), real(cases));
    let quantile = |a: f64, b: f64, p: f64| Beta::new(a, b).ok().map(|beta| beta.inverse_cdf(p));
    let low = if successes == 0 { 0.0 } else { quantile(k, n - k + 1.0, TAIL_PROBABILITY)? };
    let high =
        if successes == cases { 1.0 } else { quantile(k + 1.0, n - k, 1.0 - TAIL_PROBABILITY)? };
    Some([low, high])
}

/// The interval of 95 % of a mean by its standard error, which holds for many cases. None for fewer
/// than two.
pub fn of_mean(values: &[f64]) -> Option<[f64; 2]> {
    let (mean, deviation) = (values.mean(), values.std_dev());
    let reach = 1.96 * deviation / real(values.len()).sqrt();
    (values.len() > 1).then_some([mean - reach, mean + reach])
}

/// The interval of 95 % of a median, of values in ascending order: it covers the true one in at
/// least 95 of 100 trials, whatever the distribution. None for fewer than six cases.
///
/// # Law
/// The k-th lowest of n values is above the median where fewer than k are below it, with chance
/// P(B(n, ½) < k).
pub fn of_median(ascending: &[f64]) -> Option<[f64; 2]> {
    let cases = ascending.len();
    let below = Binomial::new(0.5, u64::try_from(cases).ok()?).ok()?;
    let rank = (0..u64::try_from(cases / 2).ok()?)
        .rev()
        .find(|&rank| below.cdf(rank) <= TAIL_PROBABILITY)?;
    let rank = usize::try_from(rank).ok()?;
    Some([ascending[rank], ascending[cases - 1 - rank]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_those_of_printed_tables() {
        // 0 of n: 1 − 0.025^(1/n); 5 of 10: 0.1871 to 0.8129; 81 of 263: 0.2527 to 0.3676
        let close = |found: Option<[f64; 2]>, expected: [f64; 2]| {
            let found = found.expect("cases");
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4)
        };
        assert!(close(clopper_pearson(0, 10), [0.0, 1.0 - 0.025_f64.powf(0.1)]));
        assert!(close(clopper_pearson(10, 10), [0.025_f64.powf(0.1), 1.0]));
        assert!(close(clopper_pearson(5, 10), [0.1871, 0.8129]));
        assert!(close(clopper_pearson(81, 263), [0.2527, 0.3676]));
        assert_eq!(clopper_pearson(0, 0), None);
    }

    #[test]
    fn ranks_around_a_median_are_those_of_printed_tables() {
        // n: ranks from 1 (sign test, two-sided 5 %): 6: 1 and 6; 10: 2 and 9; 25: 8 and 18; 50: 18
        // and 33
        for (cases, low, high) in [(6, 1, 6), (10, 2, 9), (25, 8, 18), (50, 18, 33)] {
            let values: Vec<f64> = (1..=cases).map(f64::from).collect();
            assert_eq!(of_median(&values), Some([f64::from(low), f64::from(high)]), "{cases}");
        }
        assert_eq!(of_median(&[1.0; 5]), None);
        assert_eq!(of_median(&[]), None);
    }

    #[test]
    fn a_mean_is_known_to_two_standard_errors() {
        // variance 2.5, of five cases
        let [low, high] = of_mean(&[1.0, 2.0, 3.0, 4.0, 5.0]).expect("cases");
        let reach = 1.96 * 0.5_f64.sqrt();
        assert!((low - 3.0 + reach).abs() < 1e-12 && (high - 3.0 - reach).abs() < 1e-12);
        assert_eq!(of_mean(&[1.0]), None);
    }
}
