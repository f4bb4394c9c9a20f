//! Selection of terms: forward steps, each followed by exchange and elimination.

use crate::equations::Equations;
use crate::hypothesis::Unknown;
use crate::resampling::Resampling;
use crate::settings::Settings;
use crate::significance::test;
use crate::verdict::Support;
use rayon::prelude::*;
use trackdyn_model::EffectId;
use trackdyn_model::effect::Term;

/// All admissible terms of a form, beside a fit.
pub(super) struct Library {
    /// The form.
    pub effect: EffectId,
    /// The terms.
    pub terms: Vec<Term>,
    /// Coefficients, ascending; their columns follow those of the fit.
    pub unknowns: Vec<Unknown>,
    /// Normal equations: what is free, and all coefficients as one group.
    pub equations: Equations,
    /// The settings of the diagnosis.
    pub settings: Settings,
}

/// A selected term.
pub(super) struct Selected {
    /// Index in the library.
    pub term: usize,
    /// Statistical support.
    pub support: Support,
}

impl Library {
    /// Coefficients of a term.
    pub(super) fn unknowns(&self, term: usize) -> Vec<Unknown> {
        let coefficients = self.terms[term].coefficients.iter();
        coefficients.map(|&k| Unknown::Effect(self.effect, k)).collect()
    }

    /// Joint estimates of the coefficients of some terms, as changes.
    pub(super) fn estimate(&self, terms: &[usize]) -> Vec<(Unknown, f64)> {
        let columns = self.columns(terms);
        let solution = self.equations.fit_with(&columns);
        let free = self.equations.free.len();
        let of_terms = columns.iter().zip(solution.estimate.iter().skip(free));
        of_terms.map(|(&column, step)| (self.unknowns[column - free], *step)).collect()
    }

    /// Columns of some terms, without repetition.
    fn columns(&self, terms: &[usize]) -> Vec<usize> {
        let mut columns = Vec::new();
        for &term in terms {
            for column in self.group(term) {
                if !columns.contains(&column) {
                    columns.push(column);
                }
            }
        }
        columns
    }

    /// Columns of a term.
    fn group(&self, term: usize) -> Vec<usize> {
        let place = |unknown: Unknown| self.unknowns.iter().position(|other| *other == unknown);
        let places = self.unknowns(term).into_iter().filter_map(place);
        places.map(|place| self.equations.groups[0][place]).collect()
    }

    fn ln_evidence(&self, terms: &[usize]) -> f64 {
        self.equations.fit_with(&self.columns(terms)).ln_evidence
    }

    /// The choice of terms with the largest log evidence.
    fn best_of(&self, choices: Vec<Vec<usize>>) -> Option<(Vec<usize>, f64)> {
        let valued: Vec<(Vec<usize>, f64)> = choices
            .into_par_iter()
            .map(|terms| {
                let value = self.ln_evidence(&terms);
                (terms, value)
            })
            .collect();
        valued.into_iter().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
    }

    /// Support of a term beside the others.
    fn support(&self, term: usize, terms: &[usize], resampling: Resampling) -> Support {
        let others: Vec<usize> = terms.iter().copied().filter(|other| *other != term).collect();
        let base = self.columns(&others);
        let Equations { normal, priors, free, .. } = &self.equations;
        let projected = normal.projected(&[&free[..], &base[..]].concat(), priors);
        let family: Vec<usize> =
            (0..self.terms.len()).filter(|other| !others.contains(other)).collect();
        let groups: Vec<Vec<usize>> = family
            .iter()
            .map(|&term| {
                self.group(term).into_iter().filter(|column| !base.contains(column)).collect()
            })
            .collect();
        let tests = test(&projected, &groups, resampling, &self.settings.location);
        let own = family.iter().position(|other| *other == term);
        let columns = own.map_or(&[][..], |own| &groups[own]);
        Support {
            p: own.map_or(1.0, |own| tests[own].p),
            ln_bayes_factor: self.ln_evidence(terms) - self.ln_evidence(&others),
            ..Support::of_blocks(&projected, priors, columns)
        }
    }
}

/// Terms that meet the rules of a claim, largest evidence first: the weakest is dropped until all
/// do.
pub(super) fn select(library: &Library, resampling: Resampling) -> Vec<Selected> {
    let rules = &library.settings.verdict;
    let mut chosen = search(library);
    loop {
        let mut selected: Vec<Selected> = chosen
            .iter()
            .map(|&term| Selected { term, support: library.support(term, &chosen, resampling) })
            .collect();
        let gain = |selected: &Selected| selected.support.ln_bayes_factor;
        selected.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
        match selected.iter().rfind(|selected| selected.support.falls_short(rules).is_some()) {
            Some(weakest) => chosen.retain(|term| *term != weakest.term),
            None => return selected,
        }
    }
}

fn search(library: &Library) -> Vec<usize> {
    let all: Vec<usize> = (0..library.terms.len()).collect();
    let mut chosen: Vec<usize> = Vec::new();
    let mut value = library.ln_evidence(&chosen);
    while chosen.len() < library.settings.proposal.max_terms {
        let others = all.iter().filter(|term| !chosen.contains(term));
        let more = others.map(|&term| chosen.iter().copied().chain([term]).collect()).collect();
        let Some((terms, with)) = library.best_of(more) else { break };
        if with - value < library.settings.verdict.min_ln_bayes_factor {
            break;
        }
        (chosen, value) = exchanged(library, &all, terms, with);
    }
    chosen
}

/// The choice after all exchanges of a term that help, and without terms whose loss costs too
/// little.
fn exchanged(
    library: &Library,
    all: &[usize],
    mut chosen: Vec<usize>,
    mut value: f64,
) -> (Vec<usize>, f64) {
    let min_ln_bayes_factor = library.settings.verdict.min_ln_bayes_factor;
    loop {
        let exchanges = (0..chosen.len()).flat_map(|place| {
            let others = all.iter().filter(|term| !chosen.contains(term));
            let chosen = &chosen;
            others.map(move |&term| {
                let mut terms = chosen.clone();
                terms[place] = term;
                terms
            })
        });
        let best = library.best_of(exchanges.collect());
        match best.filter(|(_, with)| *with > value + 1e-6) {
            Some((terms, with)) => (chosen, value) = (terms, with),
            None => break,
        }
    }
    loop {
        let without = (0..chosen.len()).map(|place| {
            let mut terms = chosen.clone();
            terms.remove(place);
            terms
        });
        match library.best_of(without.collect()) {
            Some((terms, left)) if value - left < min_ln_bayes_factor => {
                (chosen, value) = (terms, left);
            }
            _ => return (chosen, value),
        }
    }
}
