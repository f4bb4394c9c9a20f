//! What was taken for what.

use crate::case::{CLOCK, CONSTANTS, NOTHING_NAME};
use crate::table::{Table, ids, is_refusal};
use std::fmt::Write;
use trackdyn_model::CATALOGUE;
use trackdyn_model::effect::Symmetry;

/// Column of answers that nothing of the catalogue explains.
const UNEXPLAINED_COLUMN: &str = "unexplained";

/// Column of cases without a diagnosis.
const REFUSED_COLUMN: &str = "refused";

/// Shares of the cases of each truth in which each name came up; a member of a set counts as its
/// part of the set.
pub struct Confusion {
    /// What was concealed.
    pub rows: Vec<&'static str>,
    /// What was named.
    pub columns: Vec<&'static str>,
    /// Cases of each row.
    pub cases: Vec<usize>,
    /// Shares, row by row.
    pub shares: Vec<Vec<f64>>,
}

impl Confusion {
    /// That of a table.
    pub fn of(table: &Table) -> Self {
        let ids_of = || CATALOGUE.iter().filter(|card| !card.is_form()).map(|card| card.id);
        let rows: Vec<&str> = std::iter::once(NOTHING_NAME).chain(ids_of()).collect();
        let ends = [NOTHING_NAME, CONSTANTS];
        let columns: Vec<&str> =
            ends.into_iter().chain(ids_of()).chain([UNEXPLAINED_COLUMN, REFUSED_COLUMN]).collect();
        let mut shares = vec![vec![0.0; columns.len()]; rows.len()];
        let mut cases = vec![0; rows.len()];
        for (truth, named, status) in table.answers() {
            let Some(row) = rows.iter().position(|id| *id == truth) else { continue };
            cases[row] += 1;
            for (name, share) in weights(&named, status) {
                if let Some(column) = columns.iter().position(|id| *id == name) {
                    shares[row][column] += share;
                }
            }
        }
        for (row, count) in shares.iter_mut().zip(&cases) {
            for share in row {
                *share /= trackdyn_core::real((*count).max(1));
            }
        }
        Self { rows, columns, cases, shares }
    }

    /// Whether a column is a right answer to a row.
    pub fn is_right(&self, row: usize, column: usize) -> bool {
        let truth = self.rows[row];
        self.columns[column] == if is_constant(truth) { CONSTANTS } else { truth }
    }

    /// As a file.
    pub fn csv(&self) -> String {
        let mut text = format!("concealed,cases,{}\n", self.columns.join(","));
        for ((row, cases), shares) in self.rows.iter().zip(&self.cases).zip(&self.shares) {
            let shares: Vec<String> = shares.iter().map(|share| format!("{share:.3}")).collect();
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{row},{cases},{}", shares.join(","));
        }
        text
    }
}

/// Whether an effect only moves constant ICRs: it breaks no symmetry but that of left and right.
fn is_constant(id: &str) -> bool {
    let card = CATALOGUE.iter().find(|card| card.id == id);
    card.is_some_and(|card| card.breaks.iter().all(|symmetry| *symmetry == Symmetry::Mirror))
}

/// The names that a case counts for.
fn weights<'a>(named: &[&'a str], status: &'a str) -> Vec<(&'a str, f64)> {
    let mut weights = Vec::new();
    for answer in named {
        if answer.starts_with(CONSTANTS) {
            weights.push((CONSTANTS, 1.0));
            continue;
        }
        let count = ids(answer).count();
        weights.extend(ids(answer).map(|id| (id, 1.0 / trackdyn_core::real(count))));
    }
    if is_refusal(status) {
        weights.push((REFUSED_COLUMN, 1.0));
    } else if status == UNEXPLAINED_COLUMN {
        weights.push((UNEXPLAINED_COLUMN, 1.0));
    } else if named.is_empty() {
        weights.push((NOTHING_NAME, 1.0));
    }
    weights
}

/// Note below the matrix.
pub fn note() -> String {
    format!(
        "Frames: right answers. A member of a set of n counts 1/n. {CONSTANTS}: \"a wrong number, \
         or one of the \
         class of effects that only move constant ICRs\". {CLOCK}, which all these sensors have, \
         counts only \
         where it was concealed."
    )
}
