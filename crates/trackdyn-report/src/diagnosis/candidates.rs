//! All candidates: what speaks for each, and why it lost.

use super::Subject;
use super::words::{id, ids, significant};
use crate::ticks::number;
use trackdyn_diagnose::candidate;
use trackdyn_diagnose::diagnosis::{Kind, Missing};
use trackdyn_diagnose::hypothesis::Unknown;
use trackdyn_diagnose::search::Screened;
use trackdyn_diagnose::verdict::Refusal;
use trackdyn_model::EffectId;
use trackdyn_model::effect::{Parameter, Role};

/// Gain of ln evidence below which nothing is kept.
const MIN_GAIN: f64 = 3.0;

/// Resemblance from which on two effects are called alike.
const MIN_RESEMBLANCE: f64 = 0.9;

/// How a candidate came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// It is claimed.
    Claimed,
    /// It stands beside a claimed one that explains the same.
    Twin,
    /// It is not claimed.
    Lost,
    /// It only moves constant ICRs.
    Constant,
    /// Its size would be unphysical, or it cannot be seen.
    Out,
}

/// An effect of the catalogue.
pub(super) struct Candidate {
    pub effect: EffectId,
    /// Gain of ln evidence, of a claimed one against the best model without it, of others each by
    /// itself; none where it was not, or could not be, asked.
    pub gain: Option<f64>,
    /// √ of what the misfit falls by.
    pub z: Option<f64>,
    /// Sizes with their units.
    pub sizes: String,
    pub outcome: Outcome,
    /// Why.
    pub reason: String,
}

/// All candidates and the instruments, which are free in every hypothesis, best first.
pub(super) fn candidates(subject: &Subject) -> Vec<Candidate> {
    let diagnosis = subject.diagnosis;
    let mut all: Vec<Candidate> = diagnosis
        .limits
        .screened
        .iter()
        .map(|one| {
            let (outcome, reason) = judged(subject, one);
            // What a claimed effect explains beside the others it may hardly explain alone.
            let claim = claim(subject, one.effect).map(|missing| &missing.verdict.support);
            let gain = claim.map_or(one.gain, |support| support.ln_bayes_factor);
            Candidate {
                effect: one.effect,
                gain: Some(gain).filter(|gain| gain.is_finite()),
                z: Some(claim.map_or(one.z, |support| support.z)),
                sizes: claim.map_or_else(|| sizes(subject, one), |_| fitted(subject, one.effect)),
                outcome,
                reason,
            }
        })
        .collect();
    for &effect in &diagnosis.models.base.instruments {
        let missing = claim(subject, effect);
        let refused = diagnosis.answer.refused.iter().find(|verdict| verdict.effect == effect);
        let verdict = missing.map(|missing| &missing.verdict).or(refused);
        let reason = match (missing, refused) {
            (Some(missing), _) => claimed(missing),
            (_, Some(verdict)) => refusal(verdict.refused.as_ref()),
            _ => {
                "fitted in every hypothesis; ln evidence falls by less than 5 without it".to_owned()
            }
        };
        all.push(Candidate {
            effect,
            gain: verdict.map(|verdict| verdict.support.ln_bayes_factor),
            z: verdict.map(|verdict| verdict.support.z),
            sizes: fitted(subject, effect),
            outcome: if missing.is_some() { Outcome::Claimed } else { Outcome::Lost },
            reason,
        });
    }
    let gain = |one: &Candidate| one.gain.unwrap_or(f64::NEG_INFINITY);
    all.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
    all
}

fn claim<'a>(subject: &Subject<'a>, effect: EffectId) -> Option<&'a Missing> {
    let missing = subject.diagnosis.answer.missing.iter();
    missing.filter(|missing| missing.kind != Kind::Constant).find(|m| m.verdict.effect == effect)
}

fn claimed(missing: &Missing) -> String {
    match missing.verdict.one_of.len() {
        0 | 1 => "claimed".to_owned(),
        _ => format!("claimed as one of {}", ids(&missing.verdict.one_of, ", ")),
    }
}

fn refusal(why: Option<&Refusal>) -> String {
    let why = why.map_or("no reason given".to_owned(), Refusal::to_string);
    format!("refused: {why}")
}

fn judged(subject: &Subject, one: &Screened) -> (Outcome, String) {
    let diagnosis = subject.diagnosis;
    let effect = one.effect;
    if let Some(missing) = claim(subject, effect) {
        return (Outcome::Claimed, claimed(missing));
    }
    let twin =
        diagnosis.answer.missing.iter().find(|missing| missing.verdict.one_of.contains(&effect));
    if let Some(missing) = twin {
        return if missing.kind == Kind::Constant {
            let reason = "one of the class that only moves constant ICRs, of which one is claimed";
            (Outcome::Twin, reason.to_owned())
        } else {
            let other = id(missing.verdict.effect);
            (Outcome::Twin, format!("this evidence cannot tell it from {other}"))
        };
    }
    if let Some(verdict) = diagnosis.answer.refused.iter().find(|verdict| verdict.effect == effect)
    {
        return (Outcome::Lost, refusal(verdict.refused.as_ref()));
    }
    if diagnosis.limits.constants.contains(&effect) {
        return (Outcome::Constant, "only moves constant ICRs, which are fitted anyway".to_owned());
    }
    if one.held && one.gain < MIN_GAIN {
        return (Outcome::Out, format!("unphysical: {}", unphysical(subject, one)));
    }
    if !one.gain.is_finite() || one.z == 0.0 {
        return (Outcome::Out, "not visible: nothing in this evidence would change".to_owned());
    }
    if one.gain < MIN_GAIN {
        let gain = number(one.gain, 1);
        return (
            Outcome::Lost,
            format!("gain of ln evidence {gain}, below {}", number(MIN_GAIN, 0)),
        );
    }
    (Outcome::Lost, weaker(subject, one))
}

/// Why a candidate that explains something by itself is not in the answer.
fn weaker(subject: &Subject, one: &Screened) -> String {
    let diagnosis = subject.diagnosis;
    let answer = &diagnosis.models.best.effects;
    let resemblance = &diagnosis.limits.resemblance;
    let place = |effect: EffectId| resemblance.effects.iter().position(|other| *other == effect);
    let alike = answer.iter().filter_map(|&other| {
        let cosine = resemblance.cosines[(place(one.effect)?, place(other)?)];
        Some((cosine, other))
    });
    let alike = alike.max_by(|a, b| a.0.total_cmp(&b.0));
    let left =
        diagnosis.limits.left.iter().find(|left| left.effect == one.effect).map(|left| left.gain);
    let left = left.map_or(String::new(), |gain| {
        if gain > MIN_GAIN {
            let gain = number(gain, 1);
            format!("; beside the answer it promises {gain}, but no claim came of it")
        } else if gain.is_finite() {
            format!("; beside the answer it gains {}", number(gain, 1))
        } else {
            "; beside the answer it would be unphysical".to_owned()
        }
    });
    match alike {
        Some((cosine, other)) if cosine > MIN_RESEMBLANCE => {
            format!("twin of {}, which explains more{left}", id(other))
        }
        Some((_, other)) => format!("weaker than {}{left}", id(other)),
        None if diagnosis.models.base.instruments.is_empty() => format!("not needed{left}"),
        None => format!("no single effect is worth keeping{left}"),
    }
}

/// Value of each size: that of no effect, or of the vehicle file, and the estimated distance from
/// it.
fn values<'a>(subject: &'a Subject, one: &'a Screened) -> impl Iterator<Item = (usize, f64)> + 'a {
    candidate::sizes(one.effect).into_iter().zip(&one.sizes).map(|(place, size)| {
        let hypothesis = &subject.diagnosis.models.base.fit.hypothesis;
        (place, hypothesis.get(Unknown::Effect(one.effect, place)) + size)
    })
}

fn sizes(subject: &Subject, one: &Screened) -> String {
    let texts = values(subject, one).map(|(place, value)| {
        let parameter = &one.effect.card().parameters[place];
        shown(parameter, value, 4)
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// A parameter with a value of so many digits, and its unit.
fn shown(parameter: &Parameter, value: f64, digits: i32) -> String {
    format!("{} {}{}", parameter.key, significant(value, digits), parameter.unit_behind())
}

/// All numbers of an effect as they were fitted.
fn fitted(subject: &Subject, effect: EffectId) -> String {
    let hypothesis = &subject.diagnosis.models.best.fit.hypothesis;
    let texts = effect.card().parameters.iter().enumerate().map(|(place, parameter)| {
        let value = hypothesis.get(Unknown::Effect(effect, place));
        shown(parameter, value, 4)
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// Why the evidence asks for a size that cannot be.
fn unphysical(subject: &Subject, one: &Screened) -> String {
    let limit = values(subject, one).find_map(|(place, value)| {
        let parameter = &one.effect.card().parameters[place];
        let Role::Size { neutral: none } = parameter.role else { return None };
        if !parameter.range.contains(&value) {
            None
        } else if value == none.clamp(parameter.range[0], parameter.range[1]) {
            Some("its size would have the wrong sign".to_owned())
        } else {
            Some(format!("its size would lie beyond {}", shown(parameter, value, 2)))
        }
    });
    limit.unwrap_or_else(|| "its size would lie outside its range".to_owned())
}
