//! Scores: what the diagnoses of a trial are worth.
//!
//! Every score is a list of cases that count and of those among them that succeed. A further score
//! is one more function in [`rates`], [`means`] or a table of its own. [`resolution`] stands apart:
//! whether the manoeuvre that is planned for an ambiguous diagnosis resolves it is known after
//! driving it only.

mod by_law;
mod confusion;
pub mod coverage;
pub mod interval;
pub mod means;
mod metadata;
mod power;
mod rate;
pub mod rates;
mod reach;
pub mod resolution;
mod tables;
mod verdict;

pub use by_law::ByLaw;
pub use confusion::Confusion;
pub use means::Mean;
pub use power::PowerBin;
pub use rate::Rate;
pub use reach::Reach;
pub use resolution::{Outcome, Revisited};
pub use tables::{
    cases_csv, comparison, confusion_csv, distinct, markdown, power_csv, rates_csv,
    resolution_markdown,
};
pub use verdict::{Judged, Reply};

/// All scores of a trial.
#[derive(Clone, Debug)]
pub struct Score {
    /// Cases with an answer, and what came back.
    pub judged: Vec<Judged>,
    /// Cases that the diagnosis has not seen yet.
    pub absent: usize,
    /// Rates with their intervals.
    pub rates: Vec<Rate>,
    /// Rates at which intervals hold the true sizes, by effect.
    pub coverage: Vec<Rate>,
    /// Means and medians.
    pub means: Vec<Mean>,
    /// What is found against what could be found.
    pub power: Vec<PowerBin>,
    /// What rules could reach at best.
    pub reach: Vec<Reach>,
    /// What is found of each law of the catalogue.
    pub by_law: Vec<ByLaw>,
    /// What was taken for what.
    pub confusion: Confusion,
}

impl Score {
    /// Scores cases; those that were not diagnosed do not count.
    pub fn of(cases: Vec<Judged>) -> Self {
        let (judged, absent): (Vec<_>, Vec<_>) =
            cases.into_iter().partition(|case| case.reply != Reply::Absent);
        let mut rates = rates::rates(&judged);
        rates.push(metadata::told_from_files(&judged));
        Self {
            rates,
            coverage: coverage::coverage(&judged),
            means: means::means(&judged),
            power: power::power(&judged),
            reach: reach::reach(&judged),
            by_law: by_law::by_law(&judged),
            confusion: Confusion::of(&judged),
            absent: absent.len(),
            judged,
        }
    }
}
