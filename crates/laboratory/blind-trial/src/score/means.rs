//! Means and medians over cases.

use super::interval;
use super::verdict::Judged;
use crate::answer::Concealed;
use crate::diagnosis::Fit;
use statrs::distribution::{ContinuousCDF, Normal};
use trackdyn_core::real;

/// Smallest ln Bayes factor of a claim.
const MIN_LN_BAYES_FACTOR: f64 = 5.0;

/// The middle of a quantity over cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Mean {
    /// What it is, with its unit.
    pub name: &'static str,
    /// Mean.
    pub mean: f64,
    /// Its interval of 95 %.
    pub mean_interval: Option<[f64; 2]>,
    /// Median.
    pub median: f64,
    /// Its interval of 95 %.
    pub median_interval: Option<[f64; 2]>,
    /// Cases that have it.
    pub cases: usize,
}

impl Mean {
    fn of(name: &'static str, values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let cases = values.len();
        let (low, high) = (values.get(cases.wrapping_sub(1) / 2)?, values.get(cases / 2)?);
        let mean = values.iter().sum::<f64>() / real(cases);
        Some(Self {
            name,
            mean,
            mean_interval: interval::of_mean(&values),
            median: f64::midpoint(*low, *high),
            median_interval: interval::of_median(&values),
            cases,
        })
    }
}

/// How often noise lets an answer be told from another one that is z standard errors away, by the
/// ln Bayes factor that a claim needs: whoever knows both exactly sees ln L₁/L₂ with mean z²/2 and
/// standard deviation z.
fn told_apart(z: f64) -> f64 {
    let more = z / 2.0 - MIN_LN_BAYES_FACTOR / z;
    if z > 0.0 { Normal::standard().cdf(more) } else { 0.0 }
}

/// Share of what constants and instruments leave above the floor that is explained; none where they
/// leave less than a hundredth of the floor, in squares.
fn beyond_instruments(fit: &Fit) -> Option<f64> {
    let [before, after, floor] =
        [fit.held_out_instruments?, fit.held_out_after?, fit.noise_floor?].map(|rms| rms * rms);
    let excess = before - floor;
    (excess > 0.01 * floor).then(|| (before - after) / excess)
}

/// All means of a trial.
pub fn means(judged: &[Judged]) -> Vec<Mean> {
    let detectable = |case: &&Judged| {
        let concealed = &case.answer.concealed;
        !concealed.is_empty() && concealed.iter().all(|c| c.in_catalogue && c.is_detectable())
    };
    let fits = || judged.iter().filter(detectable).filter_map(|case| Some(&case.diagnosis()?.fit));
    let over_floor = |of: fn(&Fit) -> Option<f64>| {
        fits().filter_map(move |fit| Some(of(fit)? / fit.noise_floor?))
    };
    // Both figures are the program's own; how they come out where it found nothing says what they
    // are worth.
    let missed = || {
        let missed = judged.iter().filter(|case| {
            let truth = case.only().filter(|truth| truth.is_detectable());
            truth.is_some_and(|truth| case.set_with(&truth.mechanism).is_none())
        });
        missed.filter_map(|case| Some(&case.diagnosis()?.fit))
    };
    let with_truth = || {
        judged.iter().filter_map(|case| {
            let truth = case.only().filter(|truth| truth.is_detectable())?;
            Some((truth, case.set_with(&truth.mechanism)?))
        })
    };
    let pairs = judged.iter().map(|case| case.answer.concealed.as_slice());
    let isolable_pairs =
        pairs.filter(|pair| pair.len() == 2 && pair.iter().all(Concealed::is_isolable));
    let singles = judged.iter().filter_map(|case| case.only());
    let isolable = singles.filter(|truth| truth.is_isolable());
    [
        Mean::of(
            "members of the reported set with the truth in it, but constants",
            with_truth().filter(|(truth, _)| !truth.is_constant()).map(|(_, set)| real(set.len())),
        ),
        Mean::of(
            "members of the reported set with the truth in it",
            with_truth().map(|(_, set)| real(set.len())),
        ),
        Mean::of(
            "fewest to expect there: members of the smallest set that the recording allows",
            with_truth().map(|(truth, _)| real(truth.smallest_set())),
        ),
        Mean::of(
            "most to expect of exact isolation: chance that noise allows it",
            isolable.map(|truth| told_apart(truth.z_iso)),
        ),
        Mean::of(
            "most to expect of isolable pairs: chance that noise allows both",
            isolable_pairs.map(|pair| pair.iter().map(|truth| told_apart(truth.z_iso)).product()),
        ),
        // last, for they prove no answer: they are as good where the truth was missed
        Mean::of(
            "share of the held-out excess explained",
            fits().filter_map(|fit| fit.excess_explained),
        ),
        Mean::of(
            "share of the held-out excess explained beyond constants and instruments",
            fits().filter_map(beyond_instruments),
        ),
        Mean::of(
            "held-out rms over the noise floor, before",
            over_floor(|fit| fit.held_out_before),
        ),
        Mean::of("held-out rms over the noise floor, after", over_floor(|fit| fit.held_out_after)),
        Mean::of(
            "share of the held-out excess explained, where the truth is in no set",
            missed().filter_map(|fit| fit.excess_explained),
        ),
        Mean::of(
            "held-out rms over the noise floor, after, where the truth is in no set",
            missed().filter_map(|fit| Some(fit.held_out_after? / fit.noise_floor?)),
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_told_apart_by_luck() {
        assert_eq!(told_apart(0.0), 0.0);
        // Φ(0) and Φ(3/4), by tables
        assert!((told_apart(10.0_f64.sqrt()) - 0.5).abs() < 1e-9);
        assert!((told_apart(4.0) - 0.77337).abs() < 1e-5);
        assert!(told_apart(10.0) > 0.9999);
    }
}
