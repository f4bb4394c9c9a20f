//! What to set in a simulator, and how much closer to the robot it would be.

use super::choice::Choice;
use super::difference::{Difference, NoDifference};
use super::quantity::Subject;
use crate::base::{correct_constants, spin_with};
use crate::diagnosis::Examination;
use crate::drift::Drift;
use crate::hypothesis::{Hypothesis, Unknown};
use crate::locate::excess;
use crate::mechanics::{Instruments, Mechanics, is_instrument};
use crate::weighted::Weighted;
use trackdyn_model::{ActiveEffect, EffectId, Effects, VehicleFile};

/// Predictions of the runs of the second set: held-out ones where there are any.
#[derive(Clone, Debug)]
pub struct Closer {
    /// Drift of dead reckoning with the first set's model, and with what differs as in the second.
    pub drift: Drift,
    /// Errors, in units of the noise, of the first set's model, of it with what differs as in the
    /// second, and of the second set's own model.
    pub errors: [f64; 3],
    /// Whether the runs were held out.
    pub are_held_out: bool,
    /// The first set's model, with what differs as in the second.
    pub vehicle: VehicleFile,
}

impl Closer {
    /// Predicts the runs of the second set.
    pub(super) fn of(
        sets: [&Examination; 2],
        choice: &Choice,
        claimed: &[Difference],
        file: &VehicleFile,
    ) -> Self {
        let second = &choice.fits[1].fit.hypothesis;
        let subjects: Vec<Subject> = claimed.iter().map(|one| one.group.subject).collect();
        let [own, moved] = [&[][..], &subjects].map(|claimed| first_with(choice, claimed));
        let judging = sets[1].diagnosis.evidence.unseen.as_ref().map(|unseen| &unseen.evidence);
        let evidence = judging.unwrap_or(&sets[1].search.evidence);
        let [before, after] = [(&own, &choice.fits[0].effects), (&moved, &choice.fits[1].effects)]
            .map(|(hypothesis, added)| vehicle(file, hypothesis, added));
        Self {
            drift: Drift::of(evidence, &before, &after),
            errors: [&own, &moved, second].map(|one| Predicted::by(one, evidence).error),
            are_held_out: judging.is_some(),
            vehicle: after,
        }
    }
}

/// Refuses differences with which the first set's model predicts the second set hardly better:
/// sizes that hang together may each look different, and be wrong where one alone is set.
///
/// The runs are those of the fit: there, differences that are right raise the log-likelihood by as
/// much as the evidence that is asked of a claim.
pub(super) fn judge(
    sets: [&Examination; 2],
    choice: &Choice,
    mut judged: Vec<Difference>,
) -> Vec<Difference> {
    let evidence = &sets[1].search.evidence;
    let needed = evidence.settings().verdict.min_ln_bayes_factor;
    let with = |claimed: &[Subject]| Predicted::by(&first_with(choice, claimed), evidence);
    let without = with(&[]);
    let mut claimed: Vec<Subject> =
        judged.iter().filter(|one| one.refused.is_none()).map(|one| one.group.subject).collect();
    let mut refused = Vec::new();
    while !claimed.is_empty() {
        let here = with(&claimed);
        if here.gain_over(&without) >= needed {
            break;
        }
        // the one without which the others predict best
        let others = (0..claimed.len()).map(|place| {
            let others = claimed.iter().enumerate().filter(|(other, _)| *other != place);
            let others: Vec<Subject> = others.map(|(_, subject)| *subject).collect();
            (place, with(&others))
        });
        let least = others.min_by(|a, b| a.1.loss.total_cmp(&b.1.loss));
        let (place, rest) = least.expect("a claim");
        let why = NoDifference::NotCloser { without: rest.error, with: here.error };
        refused.push((claimed.remove(place), why));
    }
    for one in &mut judged {
        let own = refused.iter().find(|(subject, _)| *subject == one.group.subject);
        if let Some((_, why)) = own {
            one.refused = Some(why.clone());
        }
    }
    judged
}

/// The first set's model with these numbers as in the second set, seen by the second set's
/// encoders and pose sensor: they are no physics of the first.
fn first_with(choice: &Choice, claimed: &[Subject]) -> Hypothesis {
    let [first, second] = [0, 1].map(|k| &choice.fits[k].fit.hypothesis);
    let is_claimed = |subject: Subject| claimed.contains(&subject);
    let mut moved = with_instruments_of(second, first.clone());
    for subject in claimed {
        if let Subject::Effect(effect) = *subject {
            moved = moved.with_effect_of(second, effect);
        }
    }
    if is_claimed(Subject::Constants) {
        moved = Hypothesis {
            vehicle: second.vehicle.clone(),
            offset: second.offset,
            cog_moved: second.cog_moved,
            friction_level: second.friction_level,
            ..moved
        };
        for &stays in choice.fits[1].effects.iter().filter(|one| !choice.compared.contains(one)) {
            moved = moved.with_effect_of(second, stays);
        }
    } else if is_claimed(Subject::CentreOfGravity) {
        moved = with_cog_of(second, moved);
    }
    let level = if is_claimed(Subject::FrictionLevel) { second } else { first };
    moved.with(Unknown::FrictionLevel, level.friction_level)
}

/// A hypothesis with the encoders and the pose sensor of another one.
fn with_instruments_of(other: &Hypothesis, own: Hypothesis) -> Hypothesis {
    let both = own.effects.iter().chain(other.effects.iter());
    let is_one = |active: &&ActiveEffect| is_instrument(&other.vehicle, active);
    let all: Vec<EffectId> = both.filter(is_one).map(ActiveEffect::effect).collect();
    all.into_iter().fold(own, |moved, effect| moved.with_effect_of(other, effect))
}

/// A hypothesis with the centre of gravity of another one, at constant ICRs that stay.
fn with_cog_of(other: &Hypothesis, own: Hypothesis) -> Hypothesis {
    let moved = [0, 1].into_iter().fold(own.clone(), |moved, axis| {
        moved.with(Unknown::Cog(axis), other.get(Unknown::Cog(axis)))
    });
    let spin = |of: &Hypothesis| spin_with(&of.vehicle, Effects::none());
    let Some((before, after)) = spin(&own).zip(spin(&moved)) else { return own };
    let offset = std::array::from_fn(|k| moved.offset[k] + before[k] - after[k]);
    Hypothesis { offset, ..moved }
}

/// A vehicle file with all of a hypothesis: effects, and friction and centre of gravity that have
/// its constant ICRs.
fn vehicle(file: &VehicleFile, hypothesis: &Hypothesis, added: &[EffectId]) -> VehicleFile {
    let mut vehicle = file.clone();
    for effect in &hypothesis.effects {
        vehicle.effects.insert(effect.clone());
    }
    correct_constants(&mut vehicle, hypothesis, added, hypothesis.friction_level);
    vehicle
}

/// How well a hypothesis predicts, without a fit.
struct Predicted {
    /// Weighted root mean square of the whitened residual.
    error: f64,
    /// Twice the negative log-likelihood.
    loss: f64,
}

impl Predicted {
    fn by(hypothesis: &Hypothesis, evidence: &Weighted) -> Self {
        let mechanics = Mechanics::new(hypothesis, evidence);
        let prediction = mechanics.predict(&Instruments::of(hypothesis), evidence);
        let residual = evidence.residual(&prediction);
        Self { error: excess(evidence, &residual), loss: evidence.loss(&residual) }
    }

    /// Log-likelihood over that of another prediction.
    fn gain_over(&self, other: &Self) -> f64 {
        (other.loss - self.loss) / 2.0
    }
}
