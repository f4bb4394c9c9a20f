//! Whether driving on tells apart what a diagnosis could not.

use super::rates::Rate;
use super::verdict::Judged;
use crate::diagnosis::{Diagnosis, Missing, Status};
use crate::plan::STATIC_CLASS;

/// A case whose diagnosis left something open, and what further driving made of it.
#[derive(Clone, Debug)]
pub struct Revisited<'a> {
    /// The case with its diagnosis before.
    pub before: &'a Judged,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of further driving.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The plan says that no driving decides.
    NothingToDrive,
    /// Planning, driving or diagnosing failed.
    Failed(String),
    /// The diagnosis of old and new driving together.
    Diagnosed(Box<Diagnosis>),
}

/// The sets of effects that the diagnosis of a case leaves open. Classes of constants are none of them: all
/// that moves the constant ICRs is the same to every driver.
pub fn open_sets(case: &Judged) -> Vec<Vec<&str>> {
    let diagnosis = case.diagnosis().filter(|diagnosis| diagnosis.status == Status::Ambiguous);
    let claims = diagnosis.map_or(&[][..], |diagnosis| &diagnosis.missing);
    let sets = claims.iter().map(Missing::members);
    let is_open = |set: &Vec<&str>| set.len() > 1 && !set.iter().any(|m| STATIC_CLASS.contains(m));
    sets.filter(is_open).collect()
}

impl Revisited<'_> {
    /// The open set: the smallest that holds something true, else the smallest.
    pub fn set_before(&self) -> Vec<&str> {
        let key = |set: &Vec<&str>| (!set.iter().any(|m| self.before.is_true(m)), set.len());
        open_sets(self.before).into_iter().min_by_key(key).unwrap_or_default()
    }

    /// What is true of the open set.
    pub fn truth(&self) -> Option<&str> {
        self.set_before().into_iter().find(|member| self.before.is_true(member))
    }

    /// The smallest set after driving that holds what is true of the open one.
    pub fn set_after(&self) -> Option<Vec<&str>> {
        let truth = self.truth()?;
        let sets = self.claims().iter().map(Missing::members);
        sets.filter(|set| set.contains(&truth)).min_by_key(Vec::len)
    }

    /// Whether a member of the open set that is not true is named by itself after driving.
    pub fn is_misled(&self) -> bool {
        let open = self.set_before();
        self.claims().iter().any(|claim| match claim.members().as_slice() {
            [only] => open.contains(only) && !self.before.is_true(only),
            _ => false,
        })
    }

    fn claims(&self) -> &[Missing] {
        match &self.outcome {
            Outcome::Diagnosed(diagnosis) => &diagnosis.missing,
            Outcome::NothingToDrive | Outcome::Failed(_) => &[],
        }
    }
}

/// All rates of further driving.
pub fn rates(revisited: &[Revisited]) -> Vec<Rate> {
    let driven = || revisited.iter().filter(|case| case.outcome != Outcome::NothingToDrive);
    let with_truth = || driven().filter(|case| case.truth().is_some());
    let after = |holds: fn(&Revisited, &[&str]) -> bool| {
        with_truth().map(move |case| case.set_after().is_some_and(|set| holds(case, &set)))
    };
    vec![
        Rate::of(
            "a plan to drive: open sets",
            revisited.iter().map(|case| case.outcome != Outcome::NothingToDrive),
        ),
        Rate::of("truth in the set before: driven", driven().map(|case| case.truth().is_some())),
        Rate::of("truth still in the set: driven, with the truth before", after(|_, _| true)),
        Rate::of(
            "set smaller and with the truth: driven, with the truth before",
            after(|case, set| set.len() < case.set_before().len()),
        ),
        Rate::of(
            "resolved, the truth named by itself: driven, with the truth before",
            after(|_, set| set.len() == 1),
        ),
        Rate::of("another member named by itself: driven", driven().map(Revisited::is_misled)),
        Rate::of(
            "planning, driving or diagnosing failed: driven",
            driven().map(|case| matches!(case.outcome, Outcome::Failed(_))),
        ),
    ]
}
