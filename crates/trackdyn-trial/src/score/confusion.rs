//! What was taken for what.

use super::verdict::Judged;
use crate::diagnosis::Status;
use std::collections::BTreeMap;

/// Counts by what is there (rows) and what was said (columns).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Confusion {
    counts: BTreeMap<(String, String), usize>,
}

impl Confusion {
    pub(super) fn of(judged: &[Judged]) -> Self {
        let mut counts = BTreeMap::new();
        for case in judged {
            *counts.entry((truth(case), said(case))).or_default() += 1;
        }
        Self { counts }
    }

    /// What there was, in order.
    pub fn rows(&self) -> Vec<&str> {
        distinct(self.counts.keys().map(|(truth, _)| truth.as_str()))
    }

    /// What was said, in order.
    pub fn columns(&self) -> Vec<&str> {
        distinct(self.counts.keys().map(|(_, said)| said.as_str()))
    }

    /// How often.
    pub fn count(&self, truth: &str, said: &str) -> usize {
        self.counts.get(&(truth.to_owned(), said.to_owned())).copied().unwrap_or(0)
    }
}

fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn truth(case: &Judged) -> String {
    let mut ids: Vec<&str> = case.answer.concealed.iter().map(|c| c.mechanism.as_str()).collect();
    ids.sort_unstable();
    match ids.as_slice() {
        [] => "(nothing)".to_owned(),
        [only] => (*only).to_owned(),
        _ => "(pair)".to_owned(),
    }
}

/// Effects that were named; sets by whether the truth is in them.
fn said(case: &Judged) -> String {
    let Some(diagnosis) = case.diagnosis() else { return "(failed)".to_owned() };
    let physics = case.physics();
    match physics.as_slice() {
        [] if diagnosis.status == Status::Unexplained => "(unexplained)".to_owned(),
        [] => "(nothing)".to_owned(),
        [claim] if claim.members().len() == 1 => claim.effect.clone(),
        [claim] if claim.members().iter().any(|member| case.is_true(member)) => {
            "(set with it)".to_owned()
        }
        [_] => "(set without it)".to_owned(),
        _ => "(several)".to_owned(),
    }
}
