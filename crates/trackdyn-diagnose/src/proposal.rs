//! Proposal of an empirical force law for what the catalogue does not explain.
//!
//! # Law
//! Sparse regression: the residual of the best hypothesis is regressed on the signatures of all
//! terms of the catalogue's forms, computed by the simulator with a small force each, beside all
//! that is free. The selected terms enter the simulator as a force, and everything is refitted.
//!
//! # Assumes
//! A force on the body can stand for what is missing. It is never called an effect, for it names no
//! cause.

mod selection;
pub mod symmetry;
pub mod words;

use crate::base::Base;
use crate::candidate::Catalogue;
use crate::equations::Stack;
use crate::fit::{Fit, columns};
use crate::held_out::{HeldOut, Unseen};
use crate::hypothesis::Unknown;
use crate::locate::{Location, Residual, excess, icr_columns};
use crate::prior::priors;
use crate::resampling::Resampling;
use crate::search::{Found, Search};
use crate::uncertainty::{Interval, Uncertainty};
use crate::verdict::{Support, tolerated};
use crate::weighted::Weighted;
use selection::{Library, Selected};
use std::sync::Arc;
use trackdyn_core::real;
use trackdyn_model::effect::{Symmetry, Term};
use trackdyn_model::{EffectId, Effects, Model, Vehicle};

/// An empirical law for what no effect explains.
#[derive(Clone)]
pub struct Proposal {
    /// The form of the law.
    pub effect: EffectId,
    /// Its terms, largest evidence first.
    pub terms: Vec<Proposed>,
    /// The best hypothesis with the law, refitted.
    pub found: Found,
    /// Departures from it.
    pub after: Location,
    /// Symmetries that it leaves significantly broken.
    pub left_over: Vec<Symmetry>,
    /// Errors without and with the law, on held-out runs where there are any.
    pub held_out: HeldOut,
    /// Contact length between its ends, m.
    pub contact_length: f64,
}

/// A term of a proposed law.
#[derive(Clone, Debug)]
pub struct Proposed {
    /// The term.
    pub term: Term,
    /// Coefficients with 95 % intervals.
    pub coefficients: Vec<Interval>,
    /// Statistical support.
    pub support: Support,
}

impl Proposal {
    /// Share of the best hypothesis's excess over the noise floor that the law explains; limited to
    /// one, as the floor is an estimate. None where there was no excess.
    pub fn explains(&self) -> Option<f64> {
        self.held_out.excess_explained().map(|share| share.min(1.0))
    }

    /// The law in words.
    pub fn sentence(&self) -> String {
        let phrases = self.terms.iter().map(|proposed| proposed.phrase(self.contact_length));
        phrases.collect::<Vec<_>>().join("; ")
    }

    /// Symmetries that the terms break, ascending.
    pub fn breaks(&self) -> Vec<Symmetry> {
        let breaks = |symmetry: &Symmetry| {
            self.terms.iter().any(|proposed| proposed.term.breaks.contains(symmetry))
        };
        Symmetry::ALL.into_iter().filter(breaks).collect()
    }
}

/// A best hypothesis that leaves symmetries broken, with its residuals.
#[derive(Clone, Copy)]
pub struct Unexplained<'a> {
    /// The evidence of the fit.
    pub evidence: &'a Weighted,
    /// The base.
    pub base: &'a Arc<Base>,
    /// The best hypothesis.
    pub best: &'a Found,
    /// Departures from the vehicle as filed.
    pub filed: &'a Location,
    /// Departures from the base.
    pub before: &'a Location,
    /// Departures from the best hypothesis.
    pub after: &'a Location,
    /// Errors of the best hypothesis, on held-out runs where there are any.
    pub held_out: HeldOut,
    /// Held-out runs; none where none were held out.
    pub unseen: Option<&'a Unseen>,
}

/// The law of the first form that yields one.
pub fn propose(unexplained: &Unexplained, resampling: Resampling) -> Option<Proposal> {
    let forms = EffectId::all().filter(|effect| effect.card().is_form());
    forms.into_iter().find_map(|effect| law(effect, unexplained, resampling))
}

/// The law of a form: terms selected, then fitted in the simulator.
fn law(effect: EffectId, unexplained: &Unexplained, resampling: Resampling) -> Option<Proposal> {
    let Unexplained { evidence, base, best, .. } = *unexplained;
    let settings = evidence.settings();
    let form = tolerated(evidence, base, best);
    let left_over = unexplained.after.left_over(form);
    let locations = [unexplained.filed, unexplained.before, unexplained.after];
    let kept = symmetry::kept(locations, &settings.proposal);
    let terms = effect.card().terms().into_iter();
    let terms = terms
        .filter(|term| symmetry::is_admissible(term, unexplained.after, &left_over, &kept))
        .collect();

    let search = Search::new(evidence.clone(), Arc::clone(base), Catalogue::default());
    let library = library(effect, terms, &search, &best.fit);
    let selected = selection::select(&library, resampling);
    if selected.is_empty() {
        return None;
    }
    let found = refitted(effect, &selected, &library, &search, best);
    let icrs = icr_columns(evidence, &found.fit);
    let residual = Residual { evidence, fit: &found.fit, forms: &found.forms, icrs: &icrs };
    let after = residual.locate_in_waves(resampling);
    let held_out = judged(unexplained, &found.fit);
    let still = after.left_over(form);
    // A law is rejected if it leaves most of the departure, breaks other symmetries, or fails on
    // held-out runs.
    let remains = remainder(&after, &left_over) / remainder(unexplained.after, &left_over);
    let at_limit = |&unknown: &Unknown| unknown.is_of(effect) && found.fit.is_at_limit(unknown);
    let sound = remains < settings.proposal.max_remainder
        && still.iter().all(|symmetry| left_over.contains(symmetry))
        && held_out.after < held_out.before
        && found.ln_evidence - best.ln_evidence >= settings.verdict.min_ln_bayes_factor
        && !found.fit.unknowns.iter().any(at_limit);
    if !sound {
        return None;
    }
    let intervals = Uncertainty::of(&search, &found).intervals(&[effect]);
    let of = |unknown: Unknown| intervals.iter().find(|one| one.unknown == unknown).copied();
    let terms = selected.into_iter().map(|selected| Proposed {
        coefficients: library.unknowns(selected.term).into_iter().filter_map(of).collect(),
        term: library.terms[selected.term].clone(),
        support: selected.support,
    });
    Some(Proposal {
        effect,
        terms: terms.collect(),
        after,
        left_over: still,
        held_out,
        contact_length: contact_length(&found.fit.hypothesis.vehicle),
        found,
    })
}

/// Chi-squared of these symmetries beyond their degrees of freedom.
fn remainder(location: &Location, symmetries: &[Symmetry]) -> f64 {
    let tests = location.tests.iter().filter(|test| symmetries.contains(&test.symmetry));
    tests.map(|test| (test.test.statistic - real(test.test.degrees)).max(0.0)).sum()
}

/// Normal equations of the best fit, extended by the signatures of all terms.
fn library(effect: EffectId, terms: Vec<Term>, search: &Search, fit: &Fit) -> Library {
    let Search { evidence, .. } = search;
    let mut unknowns: Vec<Unknown> = terms
        .iter()
        .flat_map(|term| term.coefficients.iter().map(|&k| Unknown::Effect(effect, k)))
        .collect();
    unknowns.sort_unstable();
    unknowns.dedup();
    let hypothesis = &fit.hypothesis;
    let prediction = fit.prediction(evidence);
    let more = columns(hypothesis, &fit.mechanics, &prediction, &unknowns, evidence);
    let known = priors(hypothesis, &fit.unknowns, evidence);
    let mut stack = Stack::new(fit.columns.clone(), known);
    stack.push(more.into_iter().zip(priors(hypothesis, &unknowns, evidence)));
    let equations = stack.equations(|columns| evidence.normal(&fit.residual, columns));
    Library { effect, terms, unknowns, equations, settings: evidence.settings().clone() }
}

/// The best hypothesis with the selected terms as a force in the simulator, refitted.
fn refitted(
    effect: EffectId,
    selected: &[Selected],
    library: &Library,
    search: &Search,
    best: &Found,
) -> Found {
    let mut hypothesis = best.fit.hypothesis.clone();
    let mut unknowns = best.fit.unknowns.clone();
    let chosen: Vec<usize> = selected.iter().map(|selected| selected.term).collect();
    for (unknown, step) in library.estimate(&chosen) {
        hypothesis = hypothesis.with(unknown, hypothesis.get(unknown) + step);
        if !unknowns.contains(&unknown) {
            unknowns.push(unknown);
        }
    }
    let before = Some(&best.fit.mechanics);
    let fit = Fit::new(hypothesis, &unknowns, &search.evidence, before);
    let mut effects = best.effects.clone();
    effects.push(effect);
    effects.sort_unstable();
    search.found(effects, fit)
}

/// Errors without and with the law, on held-out runs where there are any.
fn judged(unexplained: &Unexplained, fit: &Fit) -> HeldOut {
    let HeldOut { instruments, after: before, noise_floor, are_held_out, .. } =
        unexplained.held_out;
    let after = match unexplained.unseen {
        Some(Unseen { evidence, .. }) => excess(evidence, &fit.on(evidence).residual),
        None => excess(unexplained.evidence, &fit.residual),
    };
    HeldOut { before, instruments, after, noise_floor, are_held_out }
}

/// Contact length between its ends, m.
fn contact_length(vehicle: &Vehicle) -> f64 {
    let model = Model::new(vehicle.clone(), Effects::none());
    let [rear, front] = model.footprint().ends;
    front - rear
}
