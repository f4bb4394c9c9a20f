//! What a rule could reach at best.
//!
//! # Law
//! A recording shows how far an effect is from the next other one, z_iso, with an error of one
//! standard deviation, whatever is made of it. A rule that names an effect alone where it sees more
//! than t does so with probability Φ(z_iso − t): with one t it names both those that it should and
//! those that it should not.
//!
//! # Assumes
//! That the nearest other effect is the only one to be taken for it, and that the members of the
//! class of constants are never named alone.

use super::verdict::Judged;
use crate::answer::Concealed;
use statrs::distribution::{ContinuousCDF, Normal};
use trackdyn_core::real;

/// Smallest separations at which rules name an effect alone, in standard deviations.
const MIN_SEPARATIONS: [f64; 7] = [3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0];

/// What a rule is expected to name alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// t, in standard deviations.
    pub threshold: f64,
    /// Share of the isolable singles.
    pub isolable: f64,
    /// Share of the others, which nothing could tell from their neighbours.
    pub others: f64,
}

/// The reach of rules on the single effects of a trial; none where all of them are isolable, or
/// none.
pub fn reach(judged: &[Judged]) -> Vec<Reach> {
    let singles = judged.iter().filter_map(Judged::only);
    let (isolable, others): (Vec<_>, Vec<_>) = singles.partition(|truth| truth.is_isolable());
    if isolable.is_empty() || others.is_empty() {
        return Vec::new();
    }
    let share = |of: &[&Concealed], threshold: f64| {
        let normal = Normal::standard();
        let named = of.iter().filter(|truth| !truth.is_constant());
        let expected: f64 = named.map(|truth| normal.cdf(truth.z_iso - threshold)).sum();
        expected / real(of.len())
    };
    let at = |threshold| Reach {
        threshold,
        isolable: share(&isolable, threshold),
        others: share(&others, threshold),
    };
    MIN_SEPARATIONS.map(at).into()
}
