//! The verdict on each effect of the best hypothesis: claimed, or why not, and what it cannot be told from.

use crate::base::OFFSETS;
use crate::fit::{Fit, measured};
use crate::hypothesis::{Hypothesis, Unknown, neutral, unknowns_of};
use crate::normal::{Normal, Prior};
use crate::search::{Found, Screened, Search};
use crate::significance::test;
use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::real;
use trackdyn_physics::{CATALOGUE, VehicleFile};

/// What a claim must reach.
pub struct Rules;

impl Rules {
    /// Family-wise probability of chance.
    pub const P: f64 = 0.01;
    /// Logarithm of the Bayes factor against the best hypothesis without the effect.
    pub const LN_BAYES_FACTOR: f64 = 5.0;
    /// Gain on blocks that were held out, in its standard errors.
    pub const GAIN: f64 = 2.0;
    /// Share of resampled recordings that name the same.
    pub const STABLE: f64 = 0.9;
    /// Log-likelihood within which two hypotheses are one answer.
    pub const SAME: f64 = 3.0;
    /// Separation, in standard deviations, below which two effects are one answer.
    pub const ISOLATED: f64 = 3.0;
    /// Part of the whole departure that an effect must explain beside others: a law is known to about a tenth
    /// of what it does, and what it leaves is not another effect.
    pub const FORM: f64 = 0.1;
    /// Part of the whole departure that the forms of the named laws may leave in one symmetry.
    pub const FORM_LEFT: f64 = 0.2;
}

/// Folds of the cross-validation and draws of resampled recordings.
const FOLDS: usize = 12;
const RESAMPLED: usize = 200;

/// Rivals of an effect that are refitted.
const RIVALS: usize = 3;

/// Share of its own beyond constant ICRs and instruments below which an effect is of their class.
const STATIC: f64 = 0.03;

/// What speaks for a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Family-wise probability of chance.
    pub p: f64,
    /// Logarithm of the Bayes factor.
    pub ln_bayes_factor: f64,
    /// Gain of log-likelihood on blocks that were held out.
    pub held_out_gain: f64,
    /// Its standard error.
    pub held_out_error: f64,
    /// Share of resampled recordings in which it, or a member of its class, is the best.
    pub stable: f64,
    /// √ of what the misfit falls by.
    pub z: f64,
}

/// Something that was left out, or why it is not claimed.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Place of the effect in the catalogue.
    pub effect: usize,
    /// All effects that explain it as well, ascending, itself among them.
    pub one_of: Vec<usize>,
    /// What speaks for it.
    pub support: Support,
    /// Why it is not claimed; none where it is.
    pub refused: Option<String>,
}

/// Effects that only move the constant ICRs, in all their variants, ascending.
pub fn statics(search: &Search) -> Vec<usize> {
    let nothing = search.nothing();
    let entries: Vec<usize> = (0..search.catalogue.entries.len()).collect();
    let (normal, known, groups) = search.normal(&nothing.fit, &entries);
    let offsets: Vec<usize> = (0..nothing.fit.unknowns.len())
        .filter(|&k| OFFSETS.contains(&nothing.fit.unknowns[k]))
        .collect();
    let projected = normal.projected(&offsets, &known);
    let is_static = |group: &Vec<usize>| {
        group.iter().all(|&column| {
            let whole = normal.product(column, column);
            whole > 0.0 && projected.product(column, column) <= STATIC * whole
        })
    };
    let mut effects: Vec<usize> =
        search.catalogue.entries.iter().map(|(variant, _)| variant.effect).collect();
    effects.dedup();
    effects.retain(|effect| {
        let own = entries.iter().filter(|&&e| search.catalogue.entries[e].0.effect == *effect);
        own.clone().count() > 0 && own.copied().all(|entry| is_static(&groups[entry]))
    });
    effects.sort_unstable();
    effects
}

/// Judges every effect that the best hypothesis adds, but those that only move constant ICRs.
pub fn judge(
    search: &Search,
    best: &Found,
    statics: &[usize],
    draws: usize,
    seed: u64,
) -> Vec<Verdict> {
    let whole = (search.nothing().fit.objective - best.fit.objective).max(0.0).sqrt();
    let physics = best.effects.iter().filter(|effect| !statics.contains(effect));
    physics
        .map(|&effect| {
            let without = search.without(best, effect);
            let screened = search.screen(&without);
            let mut one_of = vec![effect];
            let mut strongest = without.ln_evidence;
            let own = screened.iter().find(|one| one.effect == effect);
            let own_gain = own.map_or(0.0, |one| one.gain);
            let rivals = screened.iter().filter(|one| {
                let comparable = is_comparable(one.gain, own_gain);
                one.effect != effect
                    && !best.effects.contains(&one.effect)
                    && comparable
                    && one.gain.is_finite()
                    && !statics.contains(&one.effect)
            });
            for rival in rivals.take(RIVALS) {
                let exchanged = search.refit(&without, std::slice::from_ref(rival));
                let behind = (exchanged.fit.objective - best.fit.objective) / 2.0;
                let apart =
                    own.map_or(f64::INFINITY, |own| separation(search, &without, own, rival));
                if behind < Rules::SAME || apart < Rules::ISOLATED {
                    one_of.push(rival.effect);
                } else {
                    strongest = strongest.max(exchanged.ln_evidence);
                }
            }
            one_of.sort_unstable();
            let z = (without.fit.objective - best.fit.objective).max(0.0).sqrt();
            let support = own.map_or(nothing_speaks(), |own| {
                let mut support = support(search, &without, &screened, own, &one_of, draws, seed);
                support.ln_bayes_factor = best.ln_evidence - strongest;
                support.z = z;
                support
            });
            let unfit =
                best.fit.unknowns.iter().find_map(|&unknown| at_limit(&best.fit, unknown, effect));
            let refused = refusal(&support, z, whole)
                .or(unfit)
                .or_else(|| nearly_as_filed(search, &best.fit.hypothesis, effect));
            Verdict { effect, one_of, support, refused }
        })
        .collect()
}

/// Judges the effects of encoders and pose sensor that are free in every hypothesis.
pub fn judge_instruments(
    search: &Search,
    best: &Found,
    statics: &[usize],
    file: &VehicleFile,
    draws: usize,
    seed: u64,
) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for &effect in &search.base.instruments {
        let dropped = without_instrument(search, best, effect, file);
        let columns: Vec<usize> = (0..best.fit.unknowns.len())
            .filter(|&k| matches!(best.fit.unknowns[k], Unknown::Effect(of, _) if of == effect))
            .collect();
        let ln_bayes_factor = best.ln_evidence - dropped.ln_evidence;
        let z = (dropped.fit.objective - best.fit.objective).max(0.0).sqrt();
        if ln_bayes_factor < Rules::LN_BAYES_FACTOR {
            continue;
        }
        let mut one_of = vec![effect];
        let screened = search.screen(&dropped);
        let own_gain = ln_bayes_factor;
        let rivals = screened.iter().filter(|one| {
            is_comparable(one.gain, own_gain)
                && one.gain.is_finite()
                && !best.effects.contains(&one.effect)
                && !statics.contains(&one.effect)
        });
        for rival in rivals.take(RIVALS) {
            let exchanged = search.refit(&dropped, std::slice::from_ref(rival));
            if (exchanged.fit.objective - best.fit.objective) / 2.0 < Rules::SAME {
                one_of.push(rival.effect);
            }
        }
        one_of.sort_unstable();
        // The residual with the effect's own part put back: what a base without it would show.
        let sizes = DVector::from_iterator(
            columns.len(),
            columns.iter().map(|&k| {
                let unknown = best.fit.unknowns[k];
                best.fit.hypothesis.get(unknown) - filed(file, unknown)
            }),
        );
        let mut fit = best.fit.clone();
        for (place, &k) in columns.iter().enumerate() {
            for (value, by) in fit.residual.iter_mut().zip(&best.fit.columns[k]) {
                *value += by * sizes[place];
            }
        }
        let mut support = support_of_columns(search, &fit, &columns, draws, seed);
        support.ln_bayes_factor = ln_bayes_factor;
        support.z = z;
        let refused = refusal(&support, z, 0.0);
        verdicts.push(Verdict { effect, one_of, support, refused });
    }
    verdicts
}

/// Judges the constant ICRs against those of the vehicle file: a wrong number, or one of the class of effects
/// that only move them.
pub fn judge_constants(
    search: &Search,
    best: &Found,
    statics: &[usize],
    file: &VehicleFile,
    draws: usize,
    seed: u64,
) -> Option<Verdict> {
    let filed = Hypothesis {
        vehicle: file.vehicle.clone(),
        offset: [0.0; 3],
        ..best.fit.hypothesis.clone()
    };
    let fixed: Vec<Unknown> =
        best.fit.unknowns.iter().copied().filter(|unknown| !OFFSETS.contains(unknown)).collect();
    let evidence = search.evidence;
    let before = Some(&best.fit.mechanics);
    let dropped = Fit::new(filed.clone(), &fixed, evidence, search.metric, before);
    let free = Fit::new(filed.clone(), &best.fit.unknowns, evidence, search.metric, before);
    let ln_bayes_factor = free.ln_evidence(evidence) - dropped.ln_evidence(evidence);
    let z = (dropped.objective - free.objective).max(0.0).sqrt();
    if ln_bayes_factor < Rules::LN_BAYES_FACTOR {
        return None;
    }
    let columns = [0, 1, 2];
    let mut residual = free.clone();
    for k in columns {
        let size = free.hypothesis.offset[k];
        for (value, by) in residual.residual.iter_mut().zip(&free.columns[k]) {
            *value += by * size;
        }
    }
    let mut support = support_of_columns(search, &residual, &columns, draws, seed);
    support.ln_bayes_factor = ln_bayes_factor;
    support.z = z;
    let refused = refusal(&support, z, 0.0);
    // What the owner measured can have moved within its uncertainty only: is that enough?
    let can = |effect: &usize| {
        if unknowns_of(*effect).all(|unknown| measured(&file.vehicle, unknown).is_none()) {
            return true;
        }
        let unknowns: Vec<Unknown> = fixed.iter().copied().chain(unknowns_of(*effect)).collect();
        let none: Vec<f64> = CATALOGUE[*effect].parameters.iter().map(neutral).collect();
        let start = filed.with_effect(crate::hypothesis::active(*effect, &none));
        let fit = Fit::new(start, &unknowns, evidence, search.metric, before);
        // Each unknown fewer than the three constants is worth two: chance alone gives one half.
        let fewer = OFFSETS.len().saturating_sub(unknowns_of(*effect).count());
        (fit.objective - free.objective) / 2.0 < Rules::SAME + 2.0 * real(fewer)
    };
    let one_of: Vec<usize> = statics.iter().copied().filter(can).collect();
    let effect = *one_of.first()?;
    Some(Verdict { effect, one_of, support, refused })
}

/// Value of an unknown in the vehicle file; that of no effect where it does not have the effect.
fn filed(file: &VehicleFile, unknown: Unknown) -> f64 {
    let hypothesis = Hypothesis {
        vehicle: file.vehicle.clone(),
        effects: file.effects.clone(),
        offset: [0.0; 3],
    };
    hypothesis.get(unknown)
}

fn without_instrument(search: &Search, best: &Found, effect: usize, file: &VehicleFile) -> Found {
    let of = |unknown: &Unknown| matches!(unknown, Unknown::Effect(other, _) if *other == effect);
    let mut hypothesis = best.fit.hypothesis.without(effect);
    for unknown in unknowns_of(effect) {
        let value = filed(file, unknown);
        if (value - neutral(unknown.parameter().expect("an effect's"))).abs() > 0.0 {
            hypothesis = hypothesis.with(unknown, value);
        }
    }
    let unknowns: Vec<Unknown> =
        best.fit.unknowns.iter().copied().filter(|unknown| !of(unknown)).collect();
    let before = Some(&best.fit.mechanics);
    let fit = Fit::new(hypothesis, &unknowns, search.evidence, search.metric, before);
    Found { effects: best.effects.clone(), ln_evidence: fit.ln_evidence(search.evidence), fit }
}

/// Whether the linear screen leaves it open that one candidate does as well as another.
fn is_comparable(gain: f64, own: f64) -> bool {
    gain > 0.85 * own - 2.0 * Rules::SAME
}

fn nothing_speaks() -> Support {
    Support {
        p: 1.0,
        ln_bayes_factor: 0.0,
        held_out_gain: 0.0,
        held_out_error: 0.0,
        stable: 0.0,
        z: 0.0,
    }
}

fn refusal(support: &Support, z: f64, whole: f64) -> Option<String> {
    if support.ln_bayes_factor < Rules::LN_BAYES_FACTOR {
        return Some(format!(
            "ln Bayes factor {:.1}, below {}",
            support.ln_bayes_factor,
            Rules::LN_BAYES_FACTOR
        ));
    }
    if support.p >= Rules::P {
        return Some(format!("may be chance: family-wise p = {:.3}", support.p));
    }
    if support.held_out_gain < Rules::GAIN * support.held_out_error {
        return Some(format!(
            "gain on held-out blocks {:.1} is less than {} standard errors of {:.1}",
            support.held_out_gain,
            Rules::GAIN,
            support.held_out_error
        ));
    }
    if support.stable < Rules::STABLE {
        return Some(format!(
            "named in {:.0} % of resampled recordings only",
            100.0 * support.stable
        ));
    }
    if z < Rules::FORM * whole {
        return Some("no larger than what the form of the other law may leave".to_owned());
    }
    None
}

/// An effect that the vehicle file knows, at nearly the sizes that it gives: no law is known better.
fn nearly_as_filed(search: &Search, found: &Hypothesis, effect: usize) -> Option<String> {
    let filed = search.base.as_filed.hypothesis.effect(effect)?;
    let found = found.effect(effect)?;
    let near = crate::candidate::sizes(effect).into_iter().all(|place| {
        let (filed, found) = (filed.values()[place], found.values()[place]);
        (found - filed).abs() <= Rules::FORM_LEFT * filed.abs()
    });
    near.then(|| "the vehicle file knows it, at nearly this size".to_owned())
}

/// A size of the effect that ended at the limit of its physical range.
fn at_limit(fit: &Fit, unknown: Unknown, effect: usize) -> Option<String> {
    let parameter = unknown.parameter()?;
    let is_size = matches!(parameter.role, trackdyn_physics::effect::Role::Size { .. });
    let Unknown::Effect(of, _) = unknown else { return None };
    let value = fit.hypothesis.get(unknown);
    let [low, high] = parameter.range;
    let at = (value - low).min(high - value) <= 1e-6 * (high - low);
    (of == effect && is_size && at)
        .then(|| format!("{} = {value} lies at the limit of what is physical", parameter.key))
}

/// Separation of two effects: the part of the first one's signature, at its size, that neither the second one
/// nor what is free can stand for, in standard deviations.
fn separation(search: &Search, without: &Found, own: &Screened, rival: &Screened) -> f64 {
    let (normal, known, groups) = search.normal(&without.fit, &[own.entry, rival.entry]);
    let base: Vec<usize> =
        (0..without.fit.columns.len()).chain(groups[1].iter().copied()).collect();
    let projected = normal.projected(&base, &known);
    let information = projected.information(&groups[0]);
    let sizes = DVector::from_vec(own.sizes.clone());
    sizes.dot(&(information * &sizes)).max(0.0).sqrt()
}

fn support(
    search: &Search,
    without: &Found,
    screened: &[Screened],
    own: &Screened,
    class: &[usize],
    draws: usize,
    seed: u64,
) -> Support {
    let entries: Vec<usize> = screened.iter().map(|one| one.entry).collect();
    let (normal, known, groups) = search.normal(&without.fit, &entries);
    let base: Vec<usize> = (0..without.fit.columns.len()).collect();
    let place = screened.iter().position(|one| one.entry == own.entry).unwrap_or(0);
    let projected = normal.projected(&base, &known);
    let p = test(&projected, &groups, draws, seed)[place].p;
    let columns: Vec<usize> = base.iter().chain(&groups[place]).copied().collect();
    let (held_out_gain, held_out_error) = cross_validated(&normal, &known, &base, &columns);
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x5eed);
    let named = (0..RESAMPLED)
        .filter(|_| {
            let mut times = vec![0.0; normal.blocks()];
            for _ in 0..normal.blocks() {
                times[random.random_range(0..normal.blocks())] += 1.0;
            }
            let resampled = normal.counted(&times);
            let gain = |k: usize| {
                let columns: Vec<usize> = base.iter().chain(&groups[k]).copied().collect();
                resampled.fit(&columns, &known).ln_evidence
            };
            let contenders = (0..screened.len()).filter(|&k| screened[k].gain.is_finite());
            let best = contenders.max_by(|&a, &b| gain(a).total_cmp(&gain(b)));
            best.is_some_and(|k| class.contains(&screened[k].effect))
        })
        .count();
    Support {
        p,
        held_out_gain,
        held_out_error,
        stable: real(named) / real(RESAMPLED),
        ..nothing_speaks()
    }
}

/// The support of columns of a fit whose residual still has their part in it.
fn support_of_columns(
    search: &Search,
    fit: &Fit,
    columns: &[usize],
    draws: usize,
    seed: u64,
) -> Support {
    let (normal, known, _) = search.normal(fit, &[]);
    let known: Vec<Prior> = known.iter().map(|prior| Prior { mean: 0.0, ..*prior }).collect();
    let base: Vec<usize> = (0..fit.columns.len()).filter(|k| !columns.contains(k)).collect();
    let projected = normal.projected(&base, &known);
    let p = test(&projected, &[columns.to_vec()], draws, seed)[0].p;
    let all: Vec<usize> = base.iter().chain(columns).copied().collect();
    let (held_out_gain, held_out_error) = cross_validated(&normal, &known, &base, &all);
    Support { p, held_out_gain, held_out_error, stable: 1.0, ..nothing_speaks() }
}

/// Gain of log-likelihood by more columns on blocks that were left out of their fit, and its standard error
/// from block to block.
fn cross_validated(
    normal: &Normal,
    known: &[Prior],
    base: &[usize],
    columns: &[usize],
) -> (f64, f64) {
    let count = normal.blocks();
    let mut gains = vec![0.0; count];
    for fold in 0..FOLDS {
        let range = fold * count / FOLDS..(fold + 1) * count / FOLDS;
        let (training, _) = normal.split(range.clone());
        let (less, more) = (training.fit(base, known), training.fit(columns, known));
        for block in range {
            let (_, one) = normal.split(block..block + 1);
            gains[block] = (one.squares_at(base, &less.estimate)
                - one.squares_at(columns, &more.estimate))
                / 2.0;
        }
    }
    let counting: Vec<f64> = gains.iter().copied().filter(|gain| *gain != 0.0).collect();
    let blocks = real(counting.len().max(2));
    let sum: f64 = counting.iter().sum();
    let spread: f64 = counting.iter().map(|gain| (gain - sum / blocks).powi(2)).sum();
    (sum, (spread * blocks / (blocks - 1.0)).sqrt())
}
