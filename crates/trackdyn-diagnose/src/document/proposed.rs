//! Tables of a proposed law.

use super::{DIGITS, ParameterTable, SupportTable};
use crate::proposal::Proposal;
use serde::{Deserialize, Serialize};
use trackdyn_model::effect::Symmetry;

/// A term of a proposed law.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ProposedTable {
    /// Its form: the id in vehicle files.
    pub form: String,
    /// Its key.
    pub term: String,
    /// Component of the wrench.
    pub component: String,
    /// Size: the coefficient, or the norm of a pair (cosine and sine, or two axes).
    pub value: f64,
    /// Lower end of the 95 % interval.
    pub low95: f64,
    /// Upper end of the interval.
    pub high95: f64,
    /// Unit.
    pub unit: String,
    /// The term in words.
    pub what: String,
    /// Letters of the symmetries that the term breaks.
    pub symmetries: Vec<String>,
    /// Coefficients.
    pub parameters: Vec<ParameterTable>,
    /// Statistical support; the Bayes factor is against the law without the term.
    pub evidence: SupportTable,
}

/// Quality of a proposed law.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ProposalTable {
    /// Share of the excess over the noise floor that it explains; absent where there was no excess.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explains: Option<f64>,
    /// Error without the law on held-out runs.
    pub held_out_before: f64,
    /// Error with the law.
    pub held_out_after: f64,
    /// Letters of the symmetries that it leaves significantly broken.
    pub left_over: Vec<String>,
}

/// Tables of the terms.
pub(super) fn terms(proposal: &Proposal) -> Vec<ProposedTable> {
    let card = proposal.effect.card();
    proposal
        .terms
        .iter()
        .map(|proposed| {
            let size = proposed.size();
            let parameters = proposed.coefficients.iter().filter_map(ParameterTable::of);
            ProposedTable {
                form: card.id.to_owned(),
                term: proposed.term.key.to_owned(),
                component: proposed.term.component.to_owned(),
                value: DIGITS.round(size.value),
                low95: DIGITS.round(size.value - size.half),
                high95: DIGITS.round(size.value + size.half),
                unit: proposed.term.unit.to_owned(),
                what: proposed.phrase(proposal.contact_length),
                symmetries: letters(&proposed.term.breaks),
                parameters: parameters.collect(),
                evidence: SupportTable::of(&proposed.support),
            }
        })
        .collect()
}

/// Table of the law.
pub(super) fn law(proposal: &Proposal) -> ProposalTable {
    ProposalTable {
        explains: proposal.explains().map(|value| DIGITS.round(value)),
        held_out_before: DIGITS.round(proposal.held_out.before),
        held_out_after: DIGITS.round(proposal.held_out.after),
        left_over: letters(&proposal.left_over),
    }
}

fn letters(symmetries: &[Symmetry]) -> Vec<String> {
    symmetries.iter().map(|symmetry| symmetry.letter().to_string()).collect()
}
