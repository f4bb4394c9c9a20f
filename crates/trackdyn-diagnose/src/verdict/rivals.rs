//! Rivals: effects that explain the part of a claimed effect as well.

use super::support::{self, Change};
use super::{Constants, Refusal, Support};
use crate::candidate::Signature;
use crate::equations::Equations;
use crate::hypothesis::{Unknown, typical};
use crate::mechanics::is_instrument;
use crate::progress::{Cancelled, Watch};
use crate::resampling::Resampling;
use crate::search::{Found, Screened, Search};
use crate::settings::{self, Settings};
use std::slice;
use trackdyn_model::EffectId;

/// The rivals of an effect of the best hypothesis.
pub(super) struct Rivals {
    effect: EffectId,
    /// The best hypothesis without the effect.
    pub without: Found,
    /// Change of the prediction by refitting with it; none where all its sizes are neutral.
    pub changed: Option<Change>,
    screened: Vec<Screened>,
    /// Number of rivals not refitted whose screened gain is as high.
    unasked: usize,
    /// The strongest rivals in its place, refitted.
    exchanged: Vec<(EffectId, Found)>,
    /// Refitted rivals that explain as much.
    alike: Vec<EffectId>,
}

impl Rivals {
    /// Refits the strongest rivals of an effect in its place.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub fn new(
        search: &Search,
        best: &Found,
        constants: &Constants,
        effect: EffectId,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        watch.go_on()?;
        let settings = &search.settings().answer;
        let min_ln_bayes_factor = search.settings().verdict.min_ln_bayes_factor;
        let without = search.in_forms_of(best, search.without(best, effect));
        let screened = search.screen(&without);
        let changed = support::change(effect, &without, best);
        let own = screened.iter().find(|one| one.effect == effect).map_or(0.0, |one| one.gain);
        let is_close = |one: &&Screened| one.effect != effect && is_rival(one, own, best, settings);
        let close: Vec<&Screened> = screened.iter().filter(is_close).collect();
        // Where constant ICRs moved far, the linear screen does not see what else such a law does.
        let is_asked = |(place, one): &(usize, &&Screened)| {
            *place < settings.max_rivals || constants.could_be_constant(one.effect)
        };
        let asked = close.iter().enumerate().filter(is_asked).take(2 * settings.max_rivals);
        let (mut exchanged, mut alike) = (Vec::new(), Vec::new());
        for (_, rival) in asked {
            watch.go_on()?;
            let found = search.refit(&without, slice::from_ref(rival));
            let behind = (found.fit.objective - best.fit.objective) / 2.0;
            let less = best.ln_evidence - found.ln_evidence;
            let apart = changed.as_ref().map_or(f64::INFINITY, |changed| {
                let (_, signatures) = &search.catalogue.entries[rival.entry];
                separation(search, &without, changed, &[signatures], |_| None)
            });
            let is_alike = behind < settings.max_ln_likelihood_gap
                || less < min_ln_bayes_factor
                || apart < settings.min_separation;
            if is_alike {
                alike.push(rival.effect);
            }
            exchanged.push((rival.effect, found));
        }
        let is_unasked =
            |one: &&&Screened| !exchanged.iter().any(|(effect, _)| *effect == one.effect);
        let does_as_well = |one: &&&Screened| one.gain > own - min_ln_bayes_factor;
        let unasked = close.iter().filter(is_unasked).filter(does_as_well).count();
        Ok(Self { effect, without, changed, screened, unasked, exchanged, alike })
    }

    /// The effect and its refitted rivals, each with its hypothesis.
    pub fn refitted<'a>(&'a self, best: &'a Found) -> impl Iterator<Item = (EffectId, &'a Found)> {
        let rivals = self.exchanged.iter().map(|(rival, found)| (*rival, found));
        std::iter::once((self.effect, best)).chain(rivals)
    }

    /// The effect with all rivals that explain its part as well, ascending, and the share of
    /// bootstrap recordings that name one of them. Effects that such recordings name instead are
    /// added until the share suffices.
    pub fn answer(
        &self,
        search: &Search,
        best: &Found,
        resampling: Resampling,
    ) -> (Vec<EffectId>, f64) {
        let mut one_of: Vec<EffectId> =
            std::iter::once(self.effect).chain(self.alike.iter().copied()).collect();
        let refitted: Vec<(EffectId, &Found)> = self.refitted(best).collect();
        let named = support::named(search, &self.without, &self.screened, &refitted, resampling);
        let share =
            |one_of: &[EffectId]| -> f64 { one_of.iter().filter_map(|one| named.get(one)).sum() };
        let Settings { verdict, answer, .. } = search.settings();
        while one_of.len() < answer.max_unstable && share(&one_of) < verdict.min_stability {
            let next = named.iter().filter(|(effect, _)| !one_of.contains(effect));
            let Some((&next, _)) = next.max_by(|a, b| a.1.total_cmp(b.1)) else { break };
            one_of.push(next);
        }
        let stable = share(&one_of);
        one_of.sort_unstable();
        (one_of, stable)
    }

    /// Support of an answer against the best hypothesis without any of its members.
    pub fn support(
        &self,
        search: &Search,
        best: &Found,
        one_of: &[EffectId],
        stable: f64,
        resampling: Resampling,
    ) -> Support {
        let others = self.refitted(best).filter(|(effect, _)| !one_of.contains(effect));
        let strongest = others.map(|(_, found)| found.ln_evidence);
        let strongest = strongest.fold(self.without.ln_evidence, f64::max);
        let own = self.screened.iter().find(|one| one.effect == self.effect);
        own.map_or(Support::none(), |own| Support {
            ln_bayes_factor: best.ln_evidence - strongest,
            z: (self.without.fit.objective - best.fit.objective).max(0.0).sqrt(),
            stable,
            ..Support::of_effect(search, &self.without, best, own, resampling)
        })
    }

    /// Refuses where all refitted rivals explain it as well and others were not refitted.
    pub fn too_many(&self) -> Option<Refusal> {
        let alike = self.alike.len();
        (self.unasked > 0 && alike >= self.exchanged.len())
            .then_some(Refusal::TooMany { effects: alike + self.unasked, refitted: alike })
    }
}

/// Whether the linear screen leaves open that a candidate explains as much as one with gain `own`.
///
/// Instruments get more room: their signatures are computed far from the estimate and underrate
/// their gain.
pub(super) fn is_rival(
    one: &Screened,
    own: f64,
    best: &Found,
    settings: &settings::Answer,
) -> bool {
    let hypothesis = &best.fit.hypothesis;
    let is_instrument = is_instrument(&hypothesis.vehicle, &typical(one.effect));
    let share = if is_instrument { settings.min_instrument_gain } else { settings.min_rival_gain };
    one.gain.is_finite()
        && one.gain > share * own - 2.0 * settings.max_ln_likelihood_gap
        && !best.effects.contains(&one.effect)
}

/// Separation of an effect from rivals: norm of the change by refitting with it, beside the rivals'
/// signatures and all that is free, in standard deviations. `known` gives the prior deviation of a
/// rival's size, where it has one.
pub(super) fn separation(
    search: &Search,
    without: &Found,
    changed: &Change,
    rivals: &[&[Signature]],
    known: impl Fn(Unknown) -> Option<f64>,
) -> f64 {
    let signatures = [&[slice::from_ref(&changed.signature)], rivals].concat();
    let Equations { normal, mut priors, mut free, groups } =
        search.equations_with(without, &signatures);
    for (&column, signature) in groups[1..].iter().flatten().zip(rivals.iter().copied().flatten()) {
        free.push(column);
        if let Some(deviation) = known(signature.unknown) {
            priors[column].deviation = deviation;
        }
    }
    changed.size.abs() * normal.beside(groups[0][0], &free, &priors).sqrt()
}
