//! Search for the effects that, with all that is free, explain the evidence best.
//!
//! A linear screen gives the evidence of every effect and of every pair of the best ones. The best
//! are refitted with the whole simulator. After each change, every effect of the best hypothesis is
//! left out and exchanged for every other one: forward selection alone fails where effects resemble
//! each other.

mod done;
mod known;
mod newton;
mod refit;
mod screen;

pub use known::Known;

use crate::base::Base;
use crate::candidate::{Catalogue, Signature, Variant};
use crate::equations::{Equations, Stack};
use crate::fit::Fit;
use crate::form::Forms;
use crate::hypothesis::{Unknown, beyond_none, unknowns_of};
use crate::normal::Prior;
use crate::prior::{prior, priors};
use crate::progress::{Cancelled, Watch};
use crate::settings::Settings;
use crate::weighted::Weighted;
use done::Done;
use known::Signed;
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

/// A hypothesis that is worth a refit: another one with more effects.
struct Proposal {
    beside: Found,
    more: Vec<Screened>,
}

/// Evidence, base and candidates of a search, with its refits and those of earlier searches.
pub struct Search {
    /// The evidence, with the noise used in the search.
    pub evidence: Weighted,
    /// The base.
    pub base: Arc<Base>,
    /// The candidates.
    pub catalogue: Catalogue,
    known: Known,
    done: Done,
}

impl Search {
    /// A search of evidence beside a base.
    pub fn new(evidence: Weighted, base: impl Into<Arc<Base>>, catalogue: Catalogue) -> Self {
        let (base, known, done) = (base.into(), Known::default(), Done::default());
        Self { evidence, base, catalogue, known, done }
    }

    /// The search with what an earlier one of the same samples found.
    pub fn with_known(self, known: Known) -> Self {
        Self { known, ..self }
    }

    /// What the search found, for a later one of the same samples.
    pub fn into_known(self, best: Found) -> Known {
        let Self { evidence, base, catalogue, known, done } = self;
        known.after(done, best, Signed { base, evidence, catalogue })
    }

    /// The settings of the diagnosis.
    pub fn settings(&self) -> &Settings {
        self.evidence.settings()
    }

    /// The search with more candidates.
    pub fn with_more(self, more: Vec<(Variant, Vec<Signature>)>) -> Self {
        let mut entries = self.catalogue.entries;
        entries.extend(more);
        Self { catalogue: Catalogue { entries }, ..self }
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
    /// effects. If its own forms were found, the missing effects would look like other forms.
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

    /// Refits of the screened candidates, best first. The screened gain says little of a nonlinear
    /// law: a refit with a high centre of gravity gained eight times as much.
    fn singles(
        &self,
        beside: &Found,
        screened: &[Screened],
        watch: &Watch,
    ) -> Result<Vec<Found>, Cancelled> {
        let settings = &self.settings().search;
        let least = settings.min_promised_share * settings.min_ln_evidence;
        let worthy = screened.iter().take(settings.max_refitted_singles);
        let refit = |one: &Screened| {
            watch.go_on()?;
            Ok(self.refit(beside, std::slice::from_ref(one)))
        };
        worthy.take_while(|one| one.gain > least).map(refit).collect()
    }

    /// Value of a hypothesis in the search: an added effect must gain the required evidence;
    /// leaving out or exchanging one must only not lose it.
    fn value(&self, found: &Found) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "at most three")]
        let added = found.effects.len() as f64;
        found.ln_evidence - self.settings().search.min_ln_evidence * added
    }

    /// Newton's law in one piece, and with what it does to the load, as far as it gains.
    fn newtons(&self, nothing: &Found, watch: &Watch) -> Result<Vec<Found>, Cancelled> {
        let newton = self.newton(nothing, watch)?;
        let gains = newton.as_ref().filter(|newton| self.value(newton) > self.value(nothing));
        let with_load = gains.map_or(Ok(None), |newton| self.with_load(newton, watch))?;
        Ok(newton.into_iter().chain(with_load).collect())
    }

    /// The hypothesis with one effect more, refitted, and those with two more that are worth a
    /// refit.
    fn additions(
        &self,
        best: &Found,
        watch: &Watch,
    ) -> Result<(Vec<Found>, Vec<Proposal>), Cancelled> {
        let settings = &self.settings().search;
        if best.effects.len() >= settings.max_effects {
            return Ok((Vec::new(), Vec::new()));
        }
        let mut screened = self.screen(best);
        screened.retain(|one| !self.is_as_filed(one));
        let singles = self.singles(best, &screened, watch)?;
        if best.effects.len() + 2 > settings.max_effects {
            return Ok((singles, Vec::new()));
        }
        let single = screened.first().map_or(0.0, |one| one.gain);
        let least = single.max(0.0) + settings.min_ln_evidence;
        let worthy = self.pairs(best, &screened).into_iter().filter(|(gain, _)| *gain > least);
        let worthy = worthy.take(settings.max_refitted_pairs);
        let pairs = worthy.map(|(_, pair)| Proposal { beside: best.clone(), more: pair.to_vec() });
        Ok((singles, pairs.collect()))
    }

    /// The hypothesis with an effect exchanged for another one that is worth a refit; `reduced`
    /// lacks each of its effects in turn.
    fn exchanges(&self, best: &Found, reduced: &[Found]) -> Vec<Proposal> {
        let settings = &self.settings().search;
        let of_one = |(found, left_out): (&Found, &EffectId)| {
            let screened = self.screen(found);
            let own = screened.iter().find(|one| one.effect == *left_out);
            let promised = own.map_or(f64::INFINITY, |own| own.gain);
            let missed = (best.ln_evidence - found.ln_evidence).min(promised);
            let least = settings.min_relative_gain * missed - settings.min_ln_evidence;
            let others = screened
                .into_iter()
                .filter(|one| one.gain > least.max(0.0) && !best.effects.contains(&one.effect))
                .filter(|one| !self.is_as_filed(one))
                .take(settings.max_refitted_exchanges);
            others
                .map(|one| Proposal { beside: found.clone(), more: vec![one] })
                .collect::<Vec<_>>()
        };
        reduced.iter().zip(&best.effects).flat_map(of_one).collect()
    }

    /// The best hypothesis.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub fn best(&self, watch: &Watch) -> Result<Found, Cancelled> {
        let value = |found: &Found| self.value(found);
        let settings = &self.settings().search;
        let nothing = self.nothing();
        let mut newtons = self.newtons(&nothing, watch)?;
        let earlier = self.again(&self.known.best).filter(|found| value(found) > value(&nothing));
        let mut best = earlier.unwrap_or(nothing);
        for _ in 0..settings.max_rounds {
            let (singles, pairs) = self.additions(&best, watch)?;
            let without = |&effect: &EffectId| {
                watch.go_on()?;
                Ok(self.without(&best, effect))
            };
            let reduced: Vec<Found> =
                best.effects.iter().map(without).collect::<Result<_, Cancelled>>()?;
            let proposals = pairs.into_iter().chain(self.exchanges(&best, &reduced));
            let refitted = proposals.map(|Proposal { beside, more }| {
                watch.go_on()?;
                Ok(self.refit(&beside, &more))
            });
            let refitted: Vec<Found> = refitted.collect::<Result<_, Cancelled>>()?;
            let next = reduced
                .into_iter()
                .chain(singles)
                .chain(refitted)
                .chain(newtons.drain(..))
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
