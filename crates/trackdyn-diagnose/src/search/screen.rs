//! The linear screen: what every candidate, and every pair of the best ones, adds to a fit.
//!
//! The signatures of all candidates stand in one set of normal equations.

use super::{Found, Screened, Search};
use crate::candidate::{Beside, Catalogue, Signature, Variant};
use crate::equations::Equations;
use crate::form::Alternative;
use crate::hypothesis::{Hypothesis, Unknown};
use crate::normal::{Solution, ln_mean};
use crate::progress::{Cancelled, Watch};
use nalgebra::DVector;
use rayon::prelude::*;
use std::sync::Arc;

impl Search {
    /// What these catalogue entries add to a fit, at every deviation of the forms: a missing effect
    /// may have passed for other forms.
    fn added<'a>(&self, beside: &'a Found, entries: &[usize]) -> Added<'a> {
        let equations = self.equations(beside, entries);
        let first = beside.fit.unknowns.len();
        let deviations = &self.settings().prior.form_deviations;
        let forms = beside.forms.alternatives(&equations, first, deviations).into_iter();
        let without = |one: Alternative| (equations.normal.fit(&one.free, &one.priors), one);
        let forms = forms.map(without).collect();
        Added { beside: &beside.fit.hypothesis, equations, forms }
    }

    /// Screens all candidates beside a fit: the best variant of each effect, best first.
    pub fn screen(&self, beside: &Found) -> Vec<Screened> {
        let entries: Vec<usize> = (0..self.catalogue.entries.len())
            .filter(|&entry| !beside.effects.contains(&self.catalogue.entries[entry].0.effect))
            .collect();
        let added = self.added(beside, &entries);
        let mut best: Vec<Screened> = Vec::new();
        let all: Vec<Screened> = entries
            .par_iter()
            .enumerate()
            .map(|(group, &entry)| {
                let variant = &self.catalogue.entries[entry].0;
                let Gain { ln_evidence, drop, sizes, held } = added.gain(&[group], &[variant]);
                Screened {
                    entry,
                    effect: variant.effect,
                    // An effect that the robot never met has zero signatures.
                    gain: if added.is_unseen(group) { f64::NEG_INFINITY } else { ln_evidence },
                    z: drop.sqrt(),
                    sizes: sizes.concat(),
                    held,
                }
            })
            .collect();
        for one in all {
            match best.iter_mut().find(|other| other.effect == one.effect) {
                Some(other) => {
                    if one.gain > other.gain || (other.held && one.held && one.z > other.z) {
                        *other = one;
                    }
                }
                None => best.push(one),
            }
        }
        best.sort_by(|a, b| b.gain.total_cmp(&a.gain).then(a.effect.cmp(&b.effect)));
        best
    }

    /// Variants between those of the catalogue with a higher gain, for effects that show beside the
    /// base.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub fn between(
        &self,
        beside: &Beside,
        watch: &Watch,
    ) -> Result<Vec<(Variant, Vec<Signature>)>, Cancelled> {
        let nothing = self.nothing();
        let alone = |variant: &Variant, signatures: &[Signature]| -> f64 {
            let catalogue = Catalogue { entries: vec![(variant.clone(), signatures.to_vec())] };
            let search = Self::new(self.evidence.clone(), Arc::clone(&self.base), catalogue);
            search.screen(&nothing).first().map_or(f64::NEG_INFINITY, |one| one.gain)
        };
        let screened = self.screen(&nothing);
        let min_z = self.settings().search.min_refined_z;
        let shows = screened.iter().filter(|one| one.z > min_z && one.gain.is_finite());
        shows
            .map(|one| (&self.catalogue.entries[one.entry].0, one.gain))
            .filter(|(variant, _)| !beside.knows(variant))
            .filter_map(|(variant, gain)| match watch.go_on() {
                Ok(()) => beside.between(variant, gain, alone).map(Ok),
                Err(cancelled) => Some(Err(cancelled)),
            })
            .collect()
    }

    /// Pairs of the best screened candidates, best first: joint gain of ln evidence, and both with
    /// their joint sizes.
    pub(super) fn pairs(&self, beside: &Found, screened: &[Screened]) -> Vec<(f64, [Screened; 2])> {
        let dozen: Vec<&Screened> =
            screened.iter().take(self.settings().search.max_paired).collect();
        let entries: Vec<usize> = dozen.iter().map(|one| one.entry).collect();
        let added = self.added(beside, &entries);
        let mut pairs = Vec::new();
        for a in 0..dozen.len() {
            for b in a + 1..dozen.len() {
                let members = [dozen[a], dozen[b]];
                let variants = members.map(|one| &self.catalogue.entries[one.entry].0);
                let Gain { ln_evidence: gain, sizes, .. } = added.gain(&[a, b], &variants);
                // each carries the gain of both: alone, neither may show
                let with =
                    |k: usize| Screened { gain, sizes: sizes[k].clone(), ..members[k].clone() };
                pairs.push((gain, [with(0), with(1)]));
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        pairs
    }
}

/// What variants add to a hypothesis, in the linear approximation.
struct Added<'a> {
    beside: &'a Hypothesis,
    /// The normal equations. Each variant is a group.
    equations: Equations,
    /// What is free at each deviation of the forms, all equally probable, with its fit.
    forms: Vec<(Solution, Alternative)>,
}

/// What some variants add together.
struct Gain {
    /// Gain of ln evidence, each the mean over the forms.
    ln_evidence: f64,
    /// Decrease of the misfit, in the most probable forms with them.
    drop: f64,
    /// Estimated sizes of each, as distances from the present ones.
    sizes: Vec<Vec<f64>>,
    /// Whether some are held at the end of their range.
    held: bool,
}

impl Added<'_> {
    fn gain(&self, groups: &[usize], variants: &[&Variant]) -> Gain {
        let Equations { normal, groups: columns, .. } = &self.equations;
        let added: Vec<usize> = groups.iter().flat_map(|&group| &columns[group]).copied().collect();
        let fits = self.forms.iter().map(|(without, Alternative { free, priors })| {
            let fit = normal.fit(&[free, &added[..]].concat(), priors);
            let held = Held::of(&fit, free.len(), self.beside, variants);
            let drop = (without.misfit - fit.misfit - held.rise).max(0.0);
            (fit.ln_evidence - held.rise / 2.0, drop, held)
        });
        let fits: Vec<(f64, f64, Held)> = fits.collect();
        let with = ln_mean(fits.iter().map(|(ln_evidence, ..)| *ln_evidence));
        let without = ln_mean(self.forms.iter().map(|(fit, _)| fit.ln_evidence));
        let best = fits.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let (_, drop, Held { sizes, rise }) = best.expect("one of the forms");
        Gain { ln_evidence: with - without, drop, sizes, held: rise > 0.0 }
    }

    /// Whether the columns of a group are zero.
    fn is_unseen(&self, group: usize) -> bool {
        let Equations { normal, groups, .. } = &self.equations;
        groups[group].iter().all(|&column| normal.product(column, column) == 0.0)
    }
}

/// Estimated sizes of variants, held within their physical ranges.
struct Held {
    /// Sizes of each variant, as distances from the present ones.
    sizes: Vec<Vec<f64>>,
    /// Increase of the least misfit by holding them; zero where none is held.
    rise: f64,
}

impl Held {
    /// Sizes whose columns begin at `first` of a fit beside a hypothesis.
    fn of(fit: &Solution, first: usize, beside: &Hypothesis, variants: &[&Variant]) -> Self {
        let mut estimates = fit.estimate.iter().skip(first);
        let mut moved = Vec::new();
        let of_variant = |variant: &&Variant| -> Vec<f64> {
            let unknowns = variant.sizes().into_iter().map(|k| Unknown::Effect(variant.effect, k));
            unknowns
                .zip(&mut estimates)
                .map(|(unknown, &size)| {
                    let ([low, high], present) = (beside.range(unknown), beside.get(unknown));
                    let value = present + size;
                    let is_within = (low..=high).contains(&value);
                    let held = if is_within { size } else { value.clamp(low, high) - present };
                    moved.push(held - size);
                    held
                })
                .collect()
        };
        let sizes = variants.iter().map(of_variant).collect();
        if moved.iter().all(|by| *by == 0.0) {
            return Self { sizes, rise: 0.0 };
        }
        let by = DVector::from(moved);
        let columns: Vec<usize> = (first..first + by.len()).collect();
        Self { sizes, rise: fit.rise(&columns, &by) }
    }
}
