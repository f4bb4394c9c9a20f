//! What to set in a simulator, and how much closer to the robot it would be.

use super::choice::Choice;
use super::difference::Difference;
use super::quantity::Subject;
use crate::base::correct_constants;
use crate::diagnosis::Examination;
use crate::drift::Drift;
use crate::hypothesis::{Hypothesis, Unknown};
use crate::locate::excess;
use crate::mechanics::{Instruments, Mechanics, is_instrument};
use crate::weighted::Weighted;
use trackdyn_model::{ActiveEffect, EffectId, VehicleFile};

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
        let [first, second] = [0, 1].map(|k| &choice.fits[k].fit.hypothesis);
        let with_constants = claimed.iter().any(|one| one.group.subject == Subject::Constants);
        // Encoders and pose sensor are those of the second set: they are no physics of the first.
        let instruments = |hypothesis: Hypothesis| {
            let own = hypothesis.effects.iter().map(ActiveEffect::effect);
            let theirs = second.effects.iter().map(ActiveEffect::effect);
            let all: Vec<EffectId> = own.chain(theirs).collect();
            let is_one = |effect: &EffectId| {
                let active = hypothesis.effect(*effect).or_else(|| second.effect(*effect));
                active.is_some_and(|active| is_instrument(&second.vehicle, active))
            };
            let of_sensors = all.into_iter().filter(is_one).collect::<Vec<_>>();
            of_sensors
                .into_iter()
                .fold(hypothesis, |moved, effect| moved.with_effect_of(second, effect))
        };
        let own = instruments(first.clone());
        let mut closer = own.clone();
        for one in claimed {
            if let Subject::Effect(effect) = one.group.subject {
                closer = closer.with_effect_of(second, effect);
            }
        }
        let is_claimed = |subject: Subject| claimed.iter().any(|one| one.group.subject == subject);
        let constants = if with_constants { second } else { first };
        let mut moved = Hypothesis {
            vehicle: constants.vehicle.clone(),
            offset: constants.offset,
            cog_moved: constants.cog_moved,
            friction_level: constants.friction_level,
            ..closer
        };
        let level = if is_claimed(Subject::FrictionLevel) { second } else { first };
        moved = moved.with(Unknown::FrictionLevel, level.friction_level);
        if with_constants {
            for stays in &choice.fits[1].effects {
                if !choice.effects.contains(stays) {
                    moved = moved.with_effect_of(second, *stays);
                }
            }
        }
        let judging = sets[1].diagnosis.evidence.unseen.as_ref().map(|unseen| &unseen.evidence);
        let evidence = judging.unwrap_or(&sets[1].search.evidence);
        let [before, after] = [(&own, &choice.fits[0].effects), (&moved, &choice.fits[1].effects)]
            .map(|(hypothesis, added)| vehicle(file, hypothesis, added));
        Self {
            drift: Drift::of(evidence, &before, &after),
            errors: [error(&own, evidence), error(&moved, evidence), error(second, evidence)],
            are_held_out: judging.is_some(),
            vehicle: after,
        }
    }
}

/// A vehicle file with all of a hypothesis: effects, and friction and centre of gravity that have
/// its constant ICRs.
fn vehicle(file: &VehicleFile, hypothesis: &Hypothesis, added: &[EffectId]) -> VehicleFile {
    let mut vehicle = file.clone();
    for effect in hypothesis.effects.iter() {
        vehicle.effects.insert(effect.clone());
    }
    correct_constants(&mut vehicle, hypothesis, added, hypothesis.friction_level);
    vehicle
}

/// Weighted root mean square of the whitened residual of a hypothesis, without a fit.
fn error(hypothesis: &Hypothesis, evidence: &Weighted) -> f64 {
    let mechanics = Mechanics::new(hypothesis, evidence);
    let prediction = mechanics.predict(&Instruments::of(hypothesis), evidence);
    excess(evidence, &evidence.residual(&prediction))
}
