//! What was taken for what.

use super::verdict::Judged;
use crate::diagnosis::Status;
use std::collections::{BTreeMap, BTreeSet};

const NO_NAME: &str = "(nothing)";
const BOTH_NAMES: &str = "(both)";
const SET_WITH_TRUTH: &str = "(set with it)";
const NO_EXPLANATION: &str = "(unexplained)";

/// What a case conceals, in the order of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Nothing,
    Effect,
    Constants,
    Pair,
    Outside,
}

/// What stands in a row.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Truth {
    kind: Kind,
    name: String,
}

impl Truth {
    fn of(case: &Judged) -> Self {
        let (kind, name) = match case.answer.concealed.as_slice() {
            [] => (Kind::Nothing, NO_NAME.to_owned()),
            [only] if !only.in_catalogue => {
                (Kind::Outside, format!("{} (outside)", only.mechanism))
            }
            [only] if only.is_constant() => {
                (Kind::Constants, format!("{} (constants)", only.mechanism))
            }
            [only] => (Kind::Effect, only.mechanism.clone()),
            _ => (Kind::Pair, "(pair)".to_owned()),
        };
        Self { kind, name }
    }

    /// What is right to say of it, where the recording shows it.
    fn answer(&self) -> &str {
        match self.kind {
            Kind::Nothing => NO_NAME,
            Kind::Effect => &self.name,
            Kind::Constants => SET_WITH_TRUTH,
            Kind::Pair => BOTH_NAMES,
            Kind::Outside => NO_EXPLANATION,
        }
    }
}

/// Counts by what is there (rows) and what was said (columns).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Confusion {
    counts: BTreeMap<Truth, BTreeMap<String, usize>>,
}

impl Confusion {
    pub(super) fn of(judged: &[Judged]) -> Self {
        let mut counts: BTreeMap<Truth, BTreeMap<String, usize>> = BTreeMap::new();
        for case in judged {
            let row = counts.entry(Truth::of(case)).or_default();
            *row.entry(said(case)).or_default() += 1;
        }
        Self { counts }
    }

    /// What there was: nothing, effects of the catalogue, those of the class of constants, pairs,
    /// laws outside the catalogue.
    pub fn rows(&self) -> Vec<&str> {
        self.counts.keys().map(|truth| truth.name.as_str()).collect()
    }

    /// What was said, in order.
    pub fn columns(&self) -> Vec<&str> {
        let said: BTreeSet<&str> =
            self.counts.values().flat_map(BTreeMap::keys).map(String::as_str).collect();
        said.into_iter().collect()
    }

    /// How often.
    pub fn count(&self, truth: &str, said: &str) -> usize {
        let row = self.counts.iter().find(|(row, _)| row.name == truth);
        row.and_then(|(_, row)| row.get(said)).copied().unwrap_or(0)
    }

    /// Whether it is right to say this of that.
    pub fn is_right(&self, truth: &str, said: &str) -> bool {
        self.counts.keys().any(|row| row.name == truth && row.answer() == said)
    }
}

/// Effects that were named; sets by whether the truth is in them.
fn said(case: &Judged) -> String {
    let Some(diagnosis) = case.diagnosis() else { return "(failed)".to_owned() };
    let concealed: Vec<&str> =
        case.answer.concealed.iter().map(|concealed| concealed.mechanism.as_str()).collect();
    let physics = case.physics();
    match physics.as_slice() {
        [] if diagnosis.status == Status::Unexplained => NO_EXPLANATION.to_owned(),
        [] if case.names_absent_law() => "(absent law in a true set)".to_owned(),
        [] => NO_NAME.to_owned(),
        [claim] if claim.members().len() == 1 => claim.effect.clone(),
        [claim] if claim.members().iter().any(|member| case.is_true(member)) => {
            SET_WITH_TRUTH.to_owned()
        }
        [_] => "(set without it)".to_owned(),
        [_, _] if case.names_exactly(&concealed) => BOTH_NAMES.to_owned(),
        _ => "(several)".to_owned(),
    }
}
