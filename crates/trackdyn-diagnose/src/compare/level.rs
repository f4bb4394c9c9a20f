//! Mass over friction as one number of both sets.
//!
//! # Law
//! Forces of inertia are felt in units of friction: all their strengths are k = e^(−λ), λ the ln of
//! the friction on which the robot slides over that of the vehicle file. Each strength kᵢ ± sᵢ of a
//! set is an estimate of k, and what they differ by is an error of their laws:
//!
//! k = Σ kᵢ/sᵢ² / Σ 1/sᵢ²,  s² = max(1, χ²/(n − 1)) / Σ 1/sᵢ²,  χ² = Σ (kᵢ − k)²/sᵢ²
//!
//! # Sources
//! Birge, Physical Review 40(2), 1932 (the scale of χ²).

use super::choice::Choice;
use super::quantity::{Estimate, Group, Number, Quantity, Subject};
use crate::diagnosis::Examination;
use crate::hypothesis::Unknown;
use crate::normal::Prior;
use crate::prior::prior;
use crate::search::Found;
use trackdyn_core::real;
use trackdyn_estimate::interval::NORMAL_QUANTILE;
use trackdyn_model::EffectId;

/// These groups, with the level of friction in place of the strengths of inertia, where it stands
/// for all of them.
pub(super) fn with_level(
    mut groups: Vec<Group>,
    sets: [&Examination; 2],
    choice: &Choice,
) -> Vec<Group> {
    let search = &sets[0].search;
    let hypothesis = &search.base.as_filed.hypothesis;
    let known = prior(hypothesis, Unknown::FrictionLevel, &search.evidence);
    let level = group(&groups, &known);
    if let Some(level) = level.filter(|level| stands_for_all(level, &choice.fits)) {
        groups.retain(|group| !group.effects.iter().any(|one| level.effects.contains(one)));
        groups.push(level);
    }
    groups
}

/// Whether a level of friction stands for all strengths of inertia that are free in these fits, and
/// friction is not free beside it.
fn stands_for_all(level: &Group, fits: &[Found; 2]) -> bool {
    let is_other = |unknown: &Unknown| match *unknown {
        Unknown::FrictionLevel => true,
        Unknown::Effect(effect, _) => {
            Number::Level.moves(*unknown) && !level.effects.contains(&effect)
        }
        Unknown::Offset(_) | Unknown::Cog(_) => false,
    };
    fits.iter().all(|found| !found.fit.unknowns.iter().any(is_other))
}

/// The level of friction by the effects of inertia among these groups that both sets surely have;
/// none where there is none. Its prior is that of ln friction.
fn group(groups: &[Group], prior: &Prior) -> Option<Group> {
    let is_sure = |one: &Quantity| one.each.iter().all(|each| each.low > 0.0);
    let inertial: Vec<&Group> = groups
        .iter()
        .filter(|group| group.effects.iter().all(|effect| effect.card().is_inertia()))
        .filter(|group| !group.effects.is_empty() && group.numbers.iter().all(is_sure))
        .collect();
    let strengths = |k: usize| -> Vec<Estimate> {
        inertial.iter().flat_map(|group| &group.numbers).map(|one| one.each[k]).collect()
    };
    let each = [level(&strengths(0))?, level(&strengths(1))?];
    let effects: Vec<EffectId> =
        inertial.iter().flat_map(|group| group.effects.iter().copied()).collect();
    let numbers = vec![Quantity::new(Number::Level, each, *prior, prior.deviation)];
    Some(Group { subject: Subject::FrictionLevel, effects, numbers })
}

/// ln friction by strengths of one set; none without any.
fn level(strengths: &[Estimate]) -> Option<Estimate> {
    let weight = |one: &Estimate| one.deviation().powi(-2);
    let weights: f64 = strengths.iter().map(weight).sum();
    let mean = strengths.iter().map(|one| weight(one) * one.value).sum::<f64>() / weights;
    let squares: f64 = strengths.iter().map(|one| weight(one) * (one.value - mean).powi(2)).sum();
    let scatter = (squares / real(strengths.len().saturating_sub(1).max(1))).max(1.0);
    let deviation = (scatter / weights).sqrt();
    // λ = −ln k
    (mean > 0.0).then(|| Estimate::around(-mean.ln(), NORMAL_QUANTILE * deviation / mean))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strength(value: f64, deviation: f64) -> Estimate {
        Estimate::around(value, NORMAL_QUANTILE * deviation)
    }

    #[test]
    fn strengths_that_agree_are_known_better_together_and_others_worse() {
        let agreeing = level(&[strength(0.5, 0.02), strength(0.5, 0.02)]).expect("a level");
        assert!((agreeing.value - 2.0_f64.ln()).abs() < 1e-12);
        assert!((agreeing.deviation() - 0.02 / 0.5 / 2.0_f64.sqrt()).abs() < 1e-12);
        // 1.18 and 0.79 cannot both be mass over friction
        let apart = level(&[strength(1.18, 0.02), strength(0.79, 0.04)]).expect("a level");
        assert!((-0.12..-0.08).contains(&apart.value) && apart.deviation() > 0.1, "{apart:?}");
        let alone = level(&[strength(2.0, 0.1)]).expect("a level");
        assert!((alone.value + 2.0_f64.ln()).abs() < 1e-12);
        assert!((alone.deviation() - 0.05).abs() < 1e-12);
        assert!(level(&[]).is_none());
    }
}
