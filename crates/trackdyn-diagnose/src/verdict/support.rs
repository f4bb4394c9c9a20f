//! Statistical support of a claim.

use super::Refusal;
use crate::candidate::{Signature, sizes};
use crate::equations::Equations;
use crate::hypothesis::Unknown;
use crate::normal::{Normal, Prior, effective};
use crate::resampling::Resampling;
use crate::search::{Found, Screened, Search};
use crate::settings;
use crate::significance::test;
use nalgebra::DVector;
use rand::RngExt;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::slice;
use trackdyn_core::real;
use trackdyn_model::EffectId;

/// Separates the seed of the bootstrap of recordings from that of other draws.
const RESAMPLED_SEED: u64 = 0x5eed;

/// Statistical support of a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Family-wise p value.
    pub p: f64,
    /// ln Bayes factor against the best alternative.
    pub ln_bayes_factor: f64,
    /// Cross-validated gain of log-likelihood, on blocks left out of the fit.
    pub held_out_gain: f64,
    /// Its standard error.
    pub held_out_error: f64,
    /// Share of bootstrap recordings in which it, or a member of its class, is the best.
    pub stable: f64,
    /// √ of the decrease of chi-squared by it.
    pub z: f64,
    /// Effective number of blocks that show it.
    pub blocks: f64,
}

impl Support {
    /// No support at all.
    pub(crate) fn none() -> Self {
        Self {
            p: 1.0,
            ln_bayes_factor: 0.0,
            held_out_gain: 0.0,
            held_out_error: 0.0,
            stable: 0.0,
            z: 0.0,
            blocks: 0.0,
        }
    }

    /// Whether it is strong but was met only once: so few blocks show it that any single event
    /// would look alike.
    pub fn is_met_once(&self, rules: &settings::Verdict) -> bool {
        self.ln_bayes_factor >= rules.min_ln_bayes_factor
            && self.p >= rules.max_p
            && self.blocks < rules.min_blocks
    }

    /// First of the general rules that it breaks; none where it meets them.
    pub(crate) fn falls_short(&self, rules: &settings::Verdict) -> Option<Refusal> {
        let Self { p, ln_bayes_factor, held_out_gain, held_out_error, blocks, .. } = *self;
        let needed = rules.min_ln_bayes_factor;
        if ln_bayes_factor < needed {
            return Some(Refusal::Weak { ln_bayes_factor, needed });
        }
        if self.is_met_once(rules) {
            return Some(Refusal::MetOnce { blocks, needed: rules.min_blocks, p });
        }
        if p >= rules.max_p {
            return Some(Refusal::Chance { p, needed: rules.max_p });
        }
        (held_out_gain < rules.min_held_out_gain * held_out_error).then_some(Refusal::NotForetold {
            gain: held_out_gain,
            error: held_out_error,
            needed: rules.min_held_out_gain,
        })
    }

    /// Support of a catalogue effect, beside the best hypothesis without it.
    ///
    /// The p value is family-wise over all variants of all effects, since the best was chosen from
    /// them. An effect with one size enters with the change that refitting found, in place of its
    /// best screened variant.
    pub(super) fn of_effect(
        search: &Search,
        without: &Found,
        best: &Found,
        own: &Screened,
        resampling: Resampling,
    ) -> Self {
        let found = change(own.effect, without, best).filter(|_| sizes(own.effect).len() == 1);
        let own_signatures = found.as_ref().map_or_else(
            || &search.catalogue.entries[own.entry].1[..],
            |found| slice::from_ref(&found.signature),
        );
        let equations = search.equations_with(without, &[own_signatures]);
        let p = Self::chance(search, without, own.entry, own_signatures, resampling);
        Self {
            p,
            ..Self::of_blocks(&equations.projected(), &equations.priors, &equations.groups[0])
        }
    }

    /// Support of columns by blocks: cross-validated gain, and effective number of blocks. All that
    /// is free beside them has been projected out.
    pub(crate) fn of_blocks(projected: &Normal, known: &[Prior], columns: &[usize]) -> Self {
        let (held_out_gain, held_out_error) = cross_validated(projected, known, columns);
        let blocks = shown_by(projected, known, columns);
        Self { held_out_gain, held_out_error, blocks, ..Self::none() }
    }

    /// Family-wise p value of a variant, with these signatures, among all variants.
    fn chance(
        search: &Search,
        without: &Found,
        entry: usize,
        signatures: &[Signature],
        resampling: Resampling,
    ) -> f64 {
        let variants = search.catalogue.entries.iter().enumerate();
        let family: Vec<(usize, &[Signature])> = variants
            .filter(|(_, (variant, _))| !without.effects.contains(&variant.effect))
            .map(|(other, (_, tried))| (other, if other == entry { signatures } else { tried }))
            .collect();
        let all: Vec<&[Signature]> = family.iter().map(|(_, signatures)| *signatures).collect();
        let equations = search.equations_with(without, &all);
        let tests = || {
            test(&equations.projected(), &equations.groups, resampling, &search.settings().location)
        };
        let place = family.iter().position(|(other, _)| *other == entry);
        place.map_or(1.0, |place| tests()[place].p)
    }

    /// Support of columns of a hypothesis, tested on the residual with their part added back;
    /// `parts` are their factors.
    pub(super) fn of_columns(
        search: &Search,
        found: &Found,
        columns: &[usize],
        parts: &[f64],
        resampling: Resampling,
    ) -> Self {
        let mut found = found.clone();
        let fit = &mut found.fit;
        for (&column, part) in columns.iter().zip(parts) {
            for (value, by) in fit.residual.iter_mut().zip(&fit.columns[column]) {
                *value += by * *part;
            }
        }
        let equations = search.equations(&found, &[]).with_group(columns);
        let known = equations.priors.iter().map(|prior| Prior { mean: 0.0, ..*prior }).collect();
        let equations = Equations { priors: known, ..equations };
        let projected = equations.projected();
        let settings = &search.settings().location;
        let p = test(&projected, &equations.groups, resampling, settings)[0].p;
        Self { p, stable: 1.0, ..Self::of_blocks(&projected, &equations.priors, columns) }
    }
}

/// Share of bootstrap recordings (resampled blocks) in which each effect explains most. Effects are
/// compared by the linear screen; refitted ones by their fitted change and the evidence that it
/// gained. The question is which effect it is, not whether any: screened effects behind the best by
/// the ln Bayes factor of a claim do not take part.
pub(super) fn named(
    search: &Search,
    without: &Found,
    screened: &[Screened],
    refitted: &[(EffectId, &Found)],
    resampling: Resampling,
) -> BTreeMap<EffectId, f64> {
    let settings = search.settings();
    let resamples = settings.answer.resamples;
    let is_refitted = |effect: EffectId| refitted.iter().any(|(other, _)| *other == effect);
    let most = screened.iter().map(|one| one.gain).fold(0.0, f64::max);
    let takes_part = |one: &&Screened| one.gain > most - settings.verdict.min_ln_bayes_factor;
    let screened = screened.iter().filter(takes_part).filter(|one| !is_refitted(one.effect));
    let screened =
        screened.map(|one| (one.effect, &search.catalogue.entries[one.entry].1[..], None));
    let changes: Vec<(EffectId, Change, f64)> = refitted
        .iter()
        .filter_map(|(effect, found)| {
            let gain = found.ln_evidence - without.ln_evidence;
            Some((*effect, change(*effect, without, found)?, gain))
        })
        .collect();
    let changes = changes
        .iter()
        .map(|(effect, change, gain)| (*effect, slice::from_ref(&change.signature), Some(*gain)));
    let contenders: Vec<(EffectId, &[Signature], Option<f64>)> = screened.chain(changes).collect();
    let signatures: Vec<&[Signature]> = contenders.iter().map(|(_, one, _)| *one).collect();
    let equations = search.equations_with(without, &signatures);
    let Equations { normal, groups, .. } = &equations;
    let evidence_with =
        |normal: &Normal, group: &[usize]| equations.fit_of(normal, group).ln_evidence;
    // Evidence that refitting gains beyond the linear fit of its change.
    let before = evidence_with(normal, &[]);
    let contenders_beyond = contenders.iter().zip(groups).map(|((effect, _, gain), group)| {
        let beyond = gain.map_or(0.0, |gain| gain - (evidence_with(normal, group) - before));
        (*effect, group, beyond)
    });
    let contenders: Vec<(EffectId, &Vec<usize>, f64)> = contenders_beyond.collect();
    let resampling = Resampling { draws: resamples, seed: resampling.seed ^ RESAMPLED_SEED };
    let best_of = |draw: usize| -> Option<EffectId> {
        let mut random = resampling.random(draw);
        let mut times = vec![0.0; normal.blocks()];
        for _ in 0..normal.blocks() {
            times[random.random_range(0..normal.blocks())] += 1.0;
        }
        let resampled = normal.counted(&times);
        let gains = contenders
            .iter()
            .map(|(effect, group, beyond)| (effect, evidence_with(&resampled, group) + beyond));
        gains.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(effect, _)| *effect)
    };
    let best: Vec<Option<EffectId>> = (0..resampling.draws).into_par_iter().map(best_of).collect();
    let mut shares = BTreeMap::new();
    for effect in best.into_iter().flatten() {
        *shares.entry(effect).or_insert(0.0) += 1.0 / real(resamples);
    }
    shares
}

/// Change of the prediction by refitting with an effect.
pub(super) struct Change {
    /// Change per unit of its first size that differs.
    pub signature: Signature,
    /// Difference of that size with and without the effect.
    pub size: f64,
}

/// Change of the prediction by refitting with an effect; none where none of its sizes differs.
pub(super) fn change(effect: EffectId, without: &Found, with: &Found) -> Option<Change> {
    let unknowns = sizes(effect).into_iter().map(|place| Unknown::Effect(effect, place));
    let distance = |unknown| with.fit.hypothesis.get(unknown) - without.fit.hypothesis.get(unknown);
    let unknown = unknowns.into_iter().find(|unknown| distance(*unknown) != 0.0)?;
    let size = distance(unknown);
    let residuals = without.fit.residual.iter().zip(&with.fit.residual);
    let column = residuals.map(|(before, after)| (before - after) / size).collect();
    Some(Change { signature: Signature { unknown, column }, size })
}

/// Effective number of blocks that show the change by columns: that of |s_b|², s_b the change of a
/// block's prediction. All that is free beside them has been projected out.
fn shown_by(projected: &Normal, known: &[Prior], columns: &[usize]) -> f64 {
    let factors = projected.fit(columns, known).estimate;
    effective((0..projected.blocks()).map(|block| projected.change_at(block, columns, &factors)))
}

/// Cross-validated gain of log-likelihood by columns, each block left out of the fit in turn, and
/// its standard error. All that is free beside them has been projected out: a block that alone
/// determines a nuisance parameter would otherwise spoil the gain.
///
/// # Law
/// Where the other blocks predict a change s_b in block b, the expected gain is |s_b|²/2 and noise
/// makes it vary by |s_b|. With λ = Σ g_b/Σ |s_b|² the standard error is √Σ (g_b − λ |s_b|²)², and
/// at least √Σ |s_b|². The factors |s_b|² and λ take out what is not chance: some drives excite an
/// effect more, and its form may be wrong by a constant factor.
pub fn cross_validated(projected: &Normal, known: &[Prior], columns: &[usize]) -> (f64, f64) {
    let nothing = DVector::zeros(columns.len());
    let gains = (0..projected.blocks()).map(|block| {
        let factors = projected.without(&(block..block + 1)).fit(columns, known).estimate;
        let squares = |factors| projected.squares_at(block, columns, factors);
        let gain = (squares(&nothing) - squares(&factors)) / 2.0;
        (gain, projected.change_at(block, columns, &factors))
    });
    let gains: Vec<(f64, f64)> = gains.collect();
    let sum: f64 = gains.iter().map(|(gain, _)| gain).sum();
    let expected: f64 = gains.iter().map(|(_, change)| change).sum();
    let share = if expected > 0.0 { sum / expected } else { 0.0 };
    let spread: f64 = gains.iter().map(|(gain, change)| (gain - share * change).powi(2)).sum();
    (sum, spread.max(expected).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal::Columns;
    use nalgebra::Vector3;

    /// An effect with this size in each block, of twenty samples, that shows in the blocks selected
    /// by `is_seen`.
    fn seen(sizes: &[f64], is_seen: impl Fn(usize) -> bool) -> Normal {
        const SAMPLES: usize = 20;
        let blocks: Vec<usize> =
            (0..sizes.len() * SAMPLES).map(|sample| sample / SAMPLES).collect();
        let at = |&block: &usize| if is_seen(block) { 1.0 } else { 0.0 };
        let column: Vec<Vector3<f64>> =
            blocks.iter().map(|block| Vector3::new(0.2, -0.1, 0.0) * at(block)).collect();
        let residual: Vec<Vector3<f64>> =
            blocks.iter().zip(&column).map(|(&block, value)| value * sizes[block]).collect();
        Normal::new(&Columns {
            residual: &residual,
            columns: &[column],
            weights: &vec![1.0; blocks.len()],
            blocks: &blocks,
            count: sizes.len(),
        })
    }

    const FREE_PRIOR: [Prior; 1] = [Prior { mean: 0.0, deviation: 1e6, ln_mass: 0.0 }];

    /// Gain and standard error of an effect with this size in each block.
    fn of_sizes(sizes: &[f64]) -> (f64, f64) {
        cross_validated(&seen(sizes, |_| true), &FREE_PRIOR, &[0])
    }

    #[test]
    fn what_is_everywhere_gains_by_half_of_its_square() {
        // |c|² of a block is 20 (0.2² + 0.1²) = 1, and z² is 36
        let (gain, error) = of_sizes(&[2.0; 9]);
        assert!((gain - 18.0).abs() < 1e-6 && (error - 6.0).abs() < 1e-6, "{gain} {error}");
        // half the size in some blocks is another form, not chance
        let (gain, error) = of_sizes(&[4.0, 2.0, 4.0, 2.0, 4.0, 2.0, 4.0, 2.0, 4.0]);
        let needed = settings::Verdict::default().min_held_out_gain;
        assert!(gain > needed * error, "{gain} {error}");
    }

    #[test]
    fn blocks_that_show_nothing_do_not_count() {
        let shown = |is_seen: &dyn Fn(usize) -> bool| {
            shown_by(&seen(&[2.0; 9], is_seen), &FREE_PRIOR, &[0])
        };
        assert!((shown(&|_| true) - 9.0).abs() < 1e-9);
        assert!((shown(&|block| block == 4) - 1.0).abs() < 1e-9);
        assert!((shown(&|block| block % 3 == 0) - 3.0).abs() < 1e-9);
        assert!(shown(&|_| false).abs() < 1e-9);
    }

    #[test]
    fn what_is_strong_and_was_met_once_is_said_to_be_so() {
        let strong = Support { p: 0.9, ln_bayes_factor: 92.0, blocks: 1.4, ..Support::none() };
        let rules = &settings::Verdict::default();
        assert!(strong.is_met_once(rules));
        let refused = strong.falls_short(rules);
        assert!(matches!(refused, Some(Refusal::MetOnce { blocks: 1.4, p: 0.9, .. })));
        for other in [
            Support { blocks: 20.0, ..strong },
            Support { p: 0.001, ..strong },
            Support { ln_bayes_factor: 1.0, ..strong },
        ] {
            assert!(!other.is_met_once(rules), "{other:?}");
        }
    }

    #[test]
    fn what_one_block_alone_shows_is_not_foretold() {
        let mut sizes = [0.0; 9];
        sizes[3] = 20.0;
        let (gain, _) = of_sizes(&sizes);
        assert!(gain < 0.0, "{gain}");
        // nor does one that changes its sign
        let (gain, _) = of_sizes(&[3.0, -3.0, 3.0, -3.0, 3.0, -3.0, 3.0, -3.0]);
        assert!(gain < 0.0, "{gain}");
    }
}
