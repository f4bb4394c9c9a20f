//! Means and medians over cases.

use super::verdict::Judged;
use crate::answer::Concealed;
use crate::diagnosis::Fit;

/// The middle of a quantity over cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Mean {
    /// What it is, with its unit.
    pub name: &'static str,
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// Cases that have it.
    pub cases: usize,
}

impl Mean {
    fn of(name: &'static str, values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let cases = values.len();
        let (low, high) = (values.get(cases.wrapping_sub(1) / 2)?, values.get(cases / 2)?);
        let mean = values.iter().sum::<f64>() / crate::real(cases);
        Some(Self { name, mean, median: f64::midpoint(*low, *high), cases })
    }
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
    let sizes = judged.iter().filter_map(|case| {
        let truth = case.only().filter(|truth| Concealed::is_detectable(truth))?;
        Some(crate::real(case.set_with(&truth.mechanism)?.len()))
    });
    [
        Mean::of("members of the reported set with the truth in it", sizes),
        Mean::of(
            "share of the held-out excess explained",
            fits().filter_map(|fit| fit.excess_explained),
        ),
        Mean::of(
            "held-out rms over the noise floor, before",
            over_floor(|fit| fit.held_out_before),
        ),
        Mean::of("held-out rms over the noise floor, after", over_floor(|fit| fit.held_out_after)),
    ]
    .into_iter()
    .flatten()
    .collect()
}
