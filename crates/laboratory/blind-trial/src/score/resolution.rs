//! Whether driving on tells apart what a diagnosis could not.

use super::rate::Rate;
use super::verdict::Judged;
use crate::answer::is_constant;
use crate::diagnosis::{Diagnosis, Missing, Status};

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

/// The sets of effects that the diagnosis of a case leaves open. A set of constants alone does not
/// count: no driving separates causes that move the constant ICRs alike.
pub fn open_sets(case: &Judged) -> Vec<Vec<&str>> {
    let diagnosis = case.diagnosis().filter(|diagnosis| diagnosis.status == Status::Ambiguous);
    let claims = diagnosis.map_or(&[][..], |diagnosis| &diagnosis.missing);
    let sets = claims.iter().map(Missing::members);
    let is_open = |set: &Vec<&str>| set.len() > 1 && !set.iter().all(|id| is_constant(id));
    sets.filter(is_open).collect()
}

impl Revisited<'_> {
    /// The open set: the smallest that holds what is concealed, else the smallest that holds
    /// something true, else the smallest.
    pub fn set_before(&self) -> Vec<&str> {
        let key = |set: &Vec<&str>| {
            let holds = |of: &dyn Fn(&str) -> bool| set.iter().any(|member| of(member));
            let lacks = [!holds(&|m| self.conceals(m)), !holds(&|m| self.before.is_true(m))];
            (lacks, set.len())
        };
        open_sets(self.before).into_iter().min_by_key(key).unwrap_or_default()
    }

    /// What is true of the open set: what is concealed, else an error of an instrument or of the
    /// vehicle file.
    pub fn truth(&self) -> Option<&str> {
        let set = self.set_before();
        let concealed = set.iter().find(|member| self.conceals(member));
        concealed.or_else(|| set.iter().find(|member| self.before.is_true(member))).copied()
    }

    fn conceals(&self, effect: &str) -> bool {
        self.before.answer.concealed.iter().any(|concealed| concealed.mechanism == effect)
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
    // "a lag or a late clock" is mostly a clock: what is concealed counts by itself
    let of = |what: &str, is: fn(&Revisited, &str) -> bool| {
        let with_truth =
            || driven().filter(|case| case.truth().is_some_and(|truth| is(case, truth)));
        let after = |name: &str, holds: fn(&Revisited, &[&str]) -> bool| {
            let outcomes =
                with_truth().map(|case| case.set_after().is_some_and(|set| holds(case, &set)));
            Rate::of(format!("{name}: {what}"), outcomes)
        };
        [
            after("truth still in the set", |_, _| true),
            after("set smaller and with the truth", |case, set| {
                set.len() < case.set_before().len()
            }),
            after("resolved, the truth named by itself", |_, set| set.len() == 1),
        ]
    };
    let mut rates = vec![
        Rate::of(
            "a plan to drive: open sets",
            revisited.iter().map(|case| case.outcome != Outcome::NothingToDrive),
        ),
        Rate::of("truth in the set before: driven", driven().map(|case| case.truth().is_some())),
    ];
    rates.extend(of("driven, with what is concealed in the set", |case, truth| {
        case.conceals(truth)
    }));
    rates.extend(of("driven, with another error in the set", |case, truth| !case.conceals(truth)));
    rates.extend([
        Rate::of("another member named by itself: driven", driven().map(Revisited::is_misled)),
        Rate::of(
            "planning, driving or diagnosing failed: driven",
            driven().map(|case| matches!(case.outcome, Outcome::Failed(_))),
        ),
    ]);
    rates
}
