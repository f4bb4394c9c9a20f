//! Intervals of rates.

use statrs::distribution::{Beta, ContinuousCDF};
use trackdyn_core::real;

/// The interval of 95 % of a rate by Clopper and Pearson: it covers the true rate in at least 95 of
/// 100 trials, however few the cases. None without cases.
///
/// # Sources
/// Clopper and Pearson, Biometrika 26 (1934), 404-413, by quantiles of the beta distribution.
pub fn clopper_pearson(successes: usize, cases: usize) -> Option<[f64; 2]> {
    const TAIL: f64 = 0.025;
    if cases == 0 || successes > cases {
        return None;
    }
    let (k, n) = (real(successes), real(cases));
    let quantile = |a: f64, b: f64, p: f64| Beta::new(a, b).ok().map(|beta| beta.inverse_cdf(p));
    let low = if successes == 0 { 0.0 } else { quantile(k, n - k + 1.0, TAIL)? };
    let high = if successes == cases { 1.0 } else { quantile(k + 1.0, n - k, 1.0 - TAIL)? };
    Some([low, high])
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
}
