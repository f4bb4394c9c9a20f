//! Search for the effects that, with all that is free, explain the evidence best.
//!
//! Screening is linear: the signatures of all candidates stand in one set of normal equations,
//! which gives the evidence of every effect and of every pair of the best ones. The best are
//! refitted with the whole simulator. After each change, every effect of the best hypothesis is
//! left out and exchanged for every other one: forward selection alone fails where effects resemble
//! each other.

mod done;
mod newton;

use crate::base::{Base, Calibration, with_vehicle};
use crate::candidate::{Beside, Catalogue, Signature, Variant};
use crate::equations::{Equations, Stack};
use crate::fit::{Fit, Point};
use crate::form::{Alternative, Forms};
use crate::hypothesis::{Hypothesis, Unknown, active, beyond_none, unknowns_of};
use crate::normal::{Prior, Solution, ln_mean};
use crate::prior::{prior, priors};
use crate::progress::{Cancelled, Watch};
use crate::settings::Settings;
use crate::weighted::Weighted;
use done::{Done, Key, Step};
use nalgebra::DVector;
use rayon::prelude::*;
use std::sync::Arc;
use trackdyn_model::EffectId;

/// Linear estimate of what a candidate adds to a fit.
#[derive(Clone, Debug)]
pub struct Screened {
    /// Index of the variant in the catalogue.
    pub entry: usize,
    /// Its effect.
    pub effect: EffectId,
    /// Gain of ln evidence.
    pub gain: f64,
    /// √ of the decrease of the linear misfit (chi-squared): the gain of the likelihood alone.
    pub z: f64,
    /// Estimated sizes, as distances from the neutral size.
    pub sizes: Vec<f64>,
    /// Whether the evidence asks for a size beyond its physical range; it is held at the limit.
    pub held: bool,
}

/// A fitted hypothesis, with the effects that it adds to the base.
#[derive(Clone)]
pub struct Found {
    /// The added effects, ascending.
    pub effects: Vec<EffectId>,
    /// The fit.
    pub fit: Fit,
    /// What the form of its laws leaves.
    pub forms: Forms,
    /// Its log evidence, the mean over the forms.
    pub ln_evidence: f64,
}

impl Found {
    /// Effects, ascending, and unknowns with those of more effects.
    fn extended(&self, more: &[EffectId]) -> (Vec<EffectId>, Vec<Unknown>) {
        let mut effects = [&self.effects, more].concat();
        effects.sort_unstable();
        let unknowns = more.iter().flat_map(|&effect| unknowns_of(effect));
        (effects, self.fit.unknowns.iter().copied().chain(unknowns).collect())
    }
}

/// Evidence, base and candidates of a search, with a cache of its refits.
pub struct Search {
    /// The evidence, with the noise used in the search.
    pub evidence: Weighted,
    /// The base.
    pub base: Arc<Base>,
    /// The candidates.
    pub catalogue: Catalogue,
    done: Done,
}

impl Search {
    /// A search of evidence beside a base.
    pub fn new(evidence: Weighted, base: impl Into<Arc<Base>>, catalogue: Catalogue) -> Self {
        Self { evidence, base: base.into(), catalogue, done: Done::default() }
    }

    /// The settings of the diagnosis.
    pub fn settings(&self) -> &Settings {
        self.evidence.settings()
    }

    /// The search with more candidates.
    pub fn with_more(self, more: Vec<(Variant, Vec<Signature>)>) -> Self {
        let Self { evidence, base, catalogue: Catalogue { mut entries }, .. } = self;
        entries.extend(more);
        Self::new(evidence, base, Catalogue { entries })
    }

    /// The base, as a hypothesis without added effects.
    pub fn nothing(&self) -> Found {
        self.found(Vec::new(), self.base.fit.clone())
    }

    /// A fit that adds these effects to the base, with what the form of its laws leaves.
    pub fn found(&self, effects: Vec<EffectId>, fit: Fit) -> Found {
        let deviations = &self.evidence.settings().prior.form_deviations;
        let forms = Forms::of(&fit, deviations, &self.catalogue, &self.evidence);
        let forms = forms.beside(self.evidence.shared_error());
        Found { effects, ln_evidence: fit.ln_evidence() + forms.gain, fit, forms }
    }

    /// A hypothesis whose laws differ in form by as much as those of `whole`, which has more
    /// effects: what is missing would look like other forms.
    pub fn in_forms_of(&self, whole: &Found, found: Found) -> Found {
        let deviation = whole.forms.deviation;
        let forms = if deviation > 0.0 {
            Forms::at(&found.fit, deviation, &self.catalogue, &self.evidence)
        } else {
            Forms::default()
        };
        Found { forms: forms.beside(self.evidence.shared_error()), ..found }
    }

    /// Normal equations of a hypothesis in its forms, extended by the signatures of these catalogue
    /// entries.
    pub fn equations(&self, found: &Found, entries: &[usize]) -> Equations {
        let signatures = entries.iter().map(|&entry| &self.catalogue.entries[entry].1[..]);
        self.equations_with(found, &signatures.collect::<Vec<_>>())
    }

    /// Normal equations of a hypothesis in its forms, extended by these signatures; those of an
    /// effect form a group.
    pub fn equations_with(&self, found: &Found, beside: &[&[Signature]]) -> Equations {
        let Found { fit, forms, .. } = found;
        let Fit { hypothesis, unknowns, columns, residual, .. } = fit;
        let known = priors(hypothesis, unknowns, &self.evidence);
        let mut stack = Stack::new(columns.clone(), known).with_free(&forms.columns, &forms.priors);
        for &signatures in beside {
            stack.push(signatures.iter().map(|signature| {
                let known = prior(hypothesis, signature.unknown, &self.evidence);
                (signature.column.clone(), Prior { mean: 0.0, ..known })
            }));
        }
        stack.equations(|columns| self.evidence.normal(residual, columns))
    }

    /// What these catalogue entries add to a fit, in forms of any deviation: what was missing may
    /// have passed for other forms.
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
    fn pairs(&self, beside: &Found, screened: &[Screened]) -> Vec<(f64, [Screened; 2])> {
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

    /// Refits the hypothesis with more effects, from the cache where known.
    pub fn refit(&self, beside: &Found, more: &[Screened]) -> Found {
        let added = more.iter().map(|one| (one.entry, one.sizes.clone())).collect();
        self.done.or_else(Key::new(beside, Step::Add(added)), || self.refitted(beside, more))
    }

    fn refitted(&self, beside: &Found, more: &[Screened]) -> Found {
        let settings = &self.settings().search;
        let added: Vec<EffectId> = more.iter().map(|one| one.effect).collect();
        let (effects, unknowns) = beside.extended(&added);
        let evidence = &self.evidence;
        let at = |hypothesis: Hypothesis| {
            Point::new(hypothesis, &unknowns, evidence, Some(&beside.fit.mechanics))
        };
        let start = |share: f64| at(self.with(beside, more, share));
        let fitted = |start: Point| {
            let fit = Fit::from_point(start, &unknowns, evidence);
            self.recalibrated(effects.clone(), fit)
        };
        // For a nonlinear law the screen may promise a size so large that the fit does not return
        // from it. If the point explains less than no effect, or the fit keeps little of the
        // promised gain, a start at smaller sizes is tried too: either may lie beyond a crest of
        // the objective.
        let promised = more.iter().map(|one| one.gain).fold(0.0, f64::max);
        // More effects at no size are the hypothesis without them: no fit need end worse.
        let no_worse = |found: Found| {
            let is_worse = |found: &Found| {
                found.fit.objective > beside.fit.objective + settings.max_rise_of_nested
            };
            if !is_worse(&found) {
                return found;
            }
            let none = fitted(at(self.at_no_size(beside, more)));
            if none.fit.objective < found.fit.objective { none } else { found }
        };
        let kept = |found: &Found| found.ln_evidence - beside.ln_evidence;
        let mut far = Some(start(1.0));
        let is_less = |far: &mut Point| far.objective < beside.fit.objective;
        let found = fitted(far.take_if(is_less).unwrap_or_else(|| start(settings.near_start)));
        let is_kept = kept(&found) > settings.min_kept_share * promised;
        if promised < settings.min_ln_evidence || is_kept {
            return no_worse(found);
        }
        let second = far.unwrap_or_else(|| start(settings.near_start));
        if second.objective.is_infinite() {
            return no_worse(found);
        }
        let other = fitted(second);
        no_worse(if kept(&other) > kept(&found) { other } else { found })
    }

    /// The hypothesis with more effects, at a share of the screened sizes.
    fn with(&self, beside: &Found, more: &[Screened], share: f64) -> Hypothesis {
        let mut hypothesis = beside.fit.hypothesis.clone();
        for one in more {
            let variant = &self.catalogue.entries[one.entry].0;
            let sizes: Vec<f64> = one.sizes.iter().map(|size| share * size).collect();
            let present = hypothesis.effect(one.effect).map(|effect| effect.values().to_vec());
            let values = match present {
                // Already present: its size changes from its present value.
                Some(mut values) => {
                    for (&place, size) in variant.sizes().iter().zip(&sizes) {
                        values[place] += size;
                    }
                    values
                }
                None => variant.with_sizes(&sizes).values,
            };
            hypothesis = hypothesis.with_effect(active(one.effect, &values));
        }
        hypothesis
    }

    /// The hypothesis with more effects at no size, their other numbers as expected: it is as good
    /// as the hypothesis without them.
    fn at_no_size(&self, beside: &Found, more: &[Screened]) -> Hypothesis {
        let hypothesis = &beside.fit.hypothesis;
        let added = more.iter().filter(|one| hypothesis.effect(one.effect).is_none());
        let added = added.flat_map(|one| unknowns_of(one.effect));
        added.fold(self.with(beside, more, 0.0), |all, unknown| {
            let expected = all.get(unknown) + prior(&all, unknown, &self.evidence).mean;
            all.with(unknown, expected)
        })
    }

    /// Refits after constant ICR offsets were converted to the vehicle's own numbers: friction and
    /// centre of gravity had absorbed what an added effect now explains.
    pub(crate) fn recalibrated(&self, effects: Vec<EffectId>, mut fit: Fit) -> Found {
        let settings = &self.settings().search;
        for _ in 0..settings.recalibrations {
            let calibration = self.base.calibration;
            let moved: [f64; 3] = std::array::from_fn(|k| {
                fit.hypothesis.offset[k] - self.base.fit.hypothesis.offset[k]
            });
            if calibration.due(moved) < settings.max_offset * fit.hypothesis.vehicle.gauge {
                break;
            }
            let Some(again) = calibration.calibrated(&fit.hypothesis) else { break };
            let (unknowns, before) = (&fit.unknowns, Some(&fit.mechanics));
            let again = Fit::new(again, unknowns, &self.evidence, before);
            if again.objective >= fit.objective {
                break;
            }
            fit = again;
        }
        self.found(effects, fit)
    }

    /// Expresses the constant ICRs by another of the vehicle's numbers, where the effects found now
    /// favour that one.
    fn with_best_calibration(&self, found: Found) -> Found {
        let filed = &self.base.as_filed.hypothesis.vehicle;
        let Some(whole) = with_vehicle(&found.fit.hypothesis, filed) else { return found };
        let least = self.settings().search.min_fall_of_meaning;
        let mut best = found;
        for calibration in Calibration::ALL {
            let Some(hypothesis) = calibration.calibrated(&whole) else { continue };
            let (unknowns, before) = (&best.fit.unknowns, Some(&best.fit.mechanics));
            let fit = Fit::new(hypothesis, unknowns, &self.evidence, before);
            if fit.objective < best.fit.objective - least {
                best = self.found(best.effects, fit);
            }
        }
        best
    }

    /// A hypothesis whose runs begin in the motions that suit it best.
    pub fn with_own_starts(&self, found: Found) -> Found {
        match found.fit.with_own_starts(&self.evidence) {
            Some(fit) => self.found(found.effects, fit),
            None => found,
        }
    }

    /// The hypothesis without one of its added effects, refitted from there: the base itself may be
    /// a worse local minimum.
    pub fn without(&self, found: &Found, effect: EffectId) -> Found {
        self.done.or_else(Key::new(found, Step::Leave(effect)), || self.left_out(found, effect))
    }

    fn left_out(&self, found: &Found, effect: EffectId) -> Found {
        let effects: Vec<EffectId> =
            found.effects.iter().copied().filter(|other| *other != effect).collect();
        let is_base = effects.is_empty();
        let hypothesis = found.fit.hypothesis.with_effect_of(&self.base.fit.hypothesis, effect);
        let unknowns = found.fit.unknowns_without(effect);
        let before = Some(&self.base.fit.mechanics);
        let fit = Fit::new(hypothesis, &unknowns, &self.evidence, before);
        let without = self.recalibrated(effects, fit);
        let rise = without.fit.objective / found.fit.objective - 1.0;
        let may_be_near = rise < self.settings().search.max_rise_by_starts;
        let without = if may_be_near { self.with_own_starts(without) } else { without };
        let is_further = self.base.fit.objective <= without.fit.objective;
        if is_base && is_further { self.nothing() } else { without }
    }

    /// Whether the screen changes an effect of the vehicle file only slightly: no law is known more
    /// accurately than that.
    fn is_as_filed(&self, one: &Screened) -> bool {
        let filed = self.base.as_filed.hypothesis.effect(one.effect);
        filed.is_some_and(|filed| {
            let places = self.catalogue.entries[one.entry].0.sizes();
            let mut sizes = places.iter().zip(&one.sizes);
            let least = self.settings().verdict.min_filed_change;
            sizes.all(|(&place, size)| size.abs() <= least * beyond_none(filed, place).abs())
        })
    }

    /// Refits of the screened candidates, best first, as long as one promises about as much as the
    /// best refit kept: where laws are not linear, a refit keeps less than its screen promised, and
    /// others may keep more.
    fn singles(
        &self,
        beside: &Found,
        screened: &[Screened],
        watch: &Watch,
    ) -> Result<Vec<Found>, Cancelled> {
        let settings = &self.settings().search;
        let worth = settings.min_ln_evidence;
        let mut refitted: Vec<Found> = Vec::new();
        let mut kept: f64 = 0.0;
        for one in screened.iter().take(settings.max_refitted_singles) {
            let least = settings.min_relative_gain * kept - worth;
            if one.gain <= least.max(settings.min_promised_share * worth) {
                break;
            }
            watch.go_on()?;
            let found = self.refit(beside, std::slice::from_ref(one));
            kept = kept.max(found.ln_evidence - beside.ln_evidence);
            refitted.push(found);
        }
        Ok(refitted)
    }

    /// The best hypothesis.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub fn best(&self, watch: &Watch) -> Result<Found, Cancelled> {
        let settings = &self.settings().search;
        let worth = settings.min_ln_evidence;
        let mut best = self.nothing();
        let mut whole = self.newton(&best, watch)?;
        for _ in 0..settings.max_rounds {
            let mut proposals: Vec<(Found, Vec<Screened>)> = Vec::new();
            let mut singles: Vec<Found> = Vec::new();
            if best.effects.len() < settings.max_effects {
                let mut screened = self.screen(&best);
                screened.retain(|one| !self.is_as_filed(one));
                singles = self.singles(&best, &screened, watch)?;
                if best.effects.len() + 2 <= settings.max_effects {
                    let single = screened.first().map_or(0.0, |one| one.gain);
                    let pairs = self.pairs(&best, &screened);
                    let worthy =
                        pairs.into_iter().filter(|(gain, _)| *gain > single.max(0.0) + worth);
                    for (_, pair) in worthy.take(settings.max_refitted_pairs) {
                        proposals.push((best.clone(), pair.to_vec()));
                    }
                }
            }
            let without = |&effect: &EffectId| {
                watch.go_on()?;
                Ok(self.without(&best, effect))
            };
            let reduced: Vec<Found> =
                best.effects.iter().map(without).collect::<Result<_, Cancelled>>()?;
            for found in &reduced {
                let screened = self.screen(found);
                let others = screened
                    .into_iter()
                    .filter(|one| one.gain > 0.0 && !best.effects.contains(&one.effect))
                    .filter(|one| !self.is_as_filed(one));
                let missed = best.ln_evidence - found.ln_evidence;
                let least = settings.min_relative_gain * missed - worth;
                let others = others.filter(|one| one.gain > least);
                for one in others.take(settings.max_refitted_exchanges) {
                    proposals.push((found.clone(), vec![one]));
                }
            }
            let refitted = proposals.iter().map(|(beside, more)| {
                watch.go_on()?;
                Ok(self.refit(beside, more))
            });
            let refitted: Vec<Found> = refitted.collect::<Result<_, Cancelled>>()?;
            // An added effect must gain the required evidence; leaving out or exchanging one must
            // only not lose it.
            let value = |found: &Found| {
                #[expect(clippy::cast_precision_loss, reason = "at most three")]
                let added = found.effects.len() as f64;
                found.ln_evidence - worth * added
            };
            let next = reduced
                .into_iter()
                .chain(singles)
                .chain(refitted)
                .chain(whole.take())
                .max_by(|a, b| value(a).total_cmp(&value(b)).then(b.effects.cmp(&a.effects)));
            match next {
                Some(next) if value(&next) > value(&best) + settings.min_round_gain => {
                    best = self.with_own_starts(self.with_best_calibration(next));
                }
                _ => break,
            }
        }
        Ok(best)
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
    /// Rise of the least misfit by that; zero where none is held.
    rise: f64,
}

impl Held {
    /// Sizes whose columns begin at `first` of a fit beside a hypothesis.
    ///
    /// # Law
    /// Moved by d from their estimates, while all others follow, they raise the misfit by
    /// dᵀ Σ⁻¹ d, Σ their covariance.
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
        let covariance = fit.covariance.view((first, first), (by.len(), by.len())).into_owned();
        let solved = covariance.cholesky().map(|factor| factor.solve(&by));
        Self { sizes, rise: solved.map_or(f64::INFINITY, |solved| by.dot(&solved)) }
    }
}
