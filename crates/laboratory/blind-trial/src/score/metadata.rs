//! Whether files tell by their outside what is inside.
//!
//! A classifier that sees no number of a recording, only sizes and stamps of its files, is asked
//! which cases are nulls: nearest neighbour, leaving out the case itself, among as many nulls as
//! others, taken evenly from the whole list. It has to stay at chance: the neighbour is one of n -
//! 1 of its own kind and n of the other, a little less than a half.

use super::rate::Rate;
use super::verdict::Judged;
use trackdyn_core::real;

/// How often the classifier is right.
pub fn told_from_files<'a>(judged: &'a [Judged]) -> Rate {
    let (nulls, others): (Vec<&Judged>, Vec<&Judged>) =
        judged.iter().partition(|case| case.answer.stratum.is_null());
    let count = nulls.len().min(others.len());
    let shown = |cases: Vec<&'a Judged>, is_null: bool| {
        evenly(cases, count).map(move |case| (case.outside.as_slice(), is_null))
    };
    let features = shown(nulls, true).chain(shown(others, false));
    Rate::of(
        "nulls told by sizes and stamps of files (chance: 50 %)",
        outcomes(&features.collect::<Vec<_>>()),
    )
}

/// So many of a list, at equal distances: of trials that are counted together each gives its part.
fn evenly<T: Copy>(of: Vec<T>, count: usize) -> impl Iterator<Item = T> {
    (0..count).map(move |place| of[place * of.len() / count])
}

/// Whether each is of the class of its nearest neighbour, in units of each feature's scatter.
fn outcomes(cases: &[(&[f64], bool)]) -> Vec<bool> {
    let features = cases.first().map_or(0, |(features, _)| features.len());
    let count = real(cases.len());
    let scatter: Vec<f64> = (0..features)
        .map(|k| {
            let mean = cases.iter().map(|(of, _)| of[k]).sum::<f64>() / count;
            (cases.iter().map(|(of, _)| (of[k] - mean).powi(2)).sum::<f64>() / count).sqrt()
        })
        .collect();
    let distance = |a: &[f64], b: &[f64]| {
        let parts = a.iter().zip(b).zip(&scatter).filter(|(_, scatter)| **scatter > 0.0);
        parts.map(|((a, b), scatter)| ((a - b) / scatter).powi(2)).sum::<f64>()
    };
    let nearest = |index: usize| {
        let others = cases.iter().enumerate().filter(move |(other, _)| *other != index);
        others.min_by(|a, b| {
            let to = |other: &(usize, &(&[f64], bool))| distance(cases[index].0, other.1.0);
            to(a).total_cmp(&to(b))
        })
    };
    let told = (0..cases.len()).filter_map(|index| Some(nearest(index)?.1.1 == cases[index].1));
    told.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key::Root;
    use crate::random::{Purpose, normal, stream};

    fn share(difference: f64) -> f64 {
        let mut random = stream(&Root::of_seed(4), 1, 0, Purpose::Plan);
        let cases: Vec<([f64; 3], bool)> = (0..200)
            .map(|k| {
                let null = k % 2 == 0;
                let shift = if null { difference } else { 0.0 };
                ([1e6 + 1e3 * (normal(&mut random) + shift), normal(&mut random), 7.0], null)
            })
            .collect();
        let cases: Vec<(&[f64], bool)> = cases.iter().map(|(f, null)| (&f[..], *null)).collect();
        let told = outcomes(&cases);
        real(told.iter().filter(|told| **told).count()) / 200.0
    }

    #[test]
    fn parts_are_taken_evenly() {
        assert_eq!(evenly((0..10).collect(), 4).collect::<Vec<_>>(), [0, 2, 5, 7]);
        assert_eq!(evenly((0..3).collect(), 3).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(evenly(Vec::<u8>::new(), 0).count(), 0);
    }

    #[test]
    fn sizes_that_differ_are_told_and_sizes_that_do_not_are_not() {
        // 200 tosses of a coin: 0.5 ± 0.035
        assert!((share(0.0) - 0.5).abs() < 0.12);
        assert!(share(4.0) > 0.9);
    }
}
