//! What to set in a simulator, and how much closer to the robot it would be.

use super::difference::{Difference, NoDifference};
use super::in_common::Sets;
use super::quantity::Subject;
use super::shared::Shared;
use crate::base::correct_constants;
use crate::drift::Drift;
use crate::hypothesis::Hypothesis;
use crate::locate::excess;
use crate::mechanics::{Instruments, Mechanics};
use crate::weighted::Weighted;
use trackdyn_core::real;
use trackdyn_model::VehicleFile;

/// Predictions of the runs of the second set: held-out ones where there are any.
#[derive(Clone, Debug)]
pub struct Closer {
    /// Drift of dead reckoning with the first set's model, and with what differs as in the second.
    pub drift: Drift,
    /// Errors in units of the noise: of the first set's model, of that model with the differences
    /// as in the second set, and of the second set's own model. Numbers that do not differ are
    /// estimated from both sets.
    pub errors: [f64; 3],
    /// Whether the runs were held out.
    pub are_held_out: bool,
    /// −2 ln L of the second set's runs under the corrected model of the first, minus that under
    /// the second set's own model, minus what as many free numbers explain by chance. 0 where the
    /// corrected model has no motion.
    pub left: f64,
    /// The first set's model, with what differs as in the second.
    pub vehicle: VehicleFile,
}

impl Closer {
    /// Predicts the runs of the second set by the model in which only what is claimed differs.
    pub(super) fn of(both: Sets, shared: &Shared, file: &VehicleFile) -> Self {
        let Sets { sets, choice, .. } = both;
        let own = &choice.fits[1].fit;
        let predicted = |evidence: &Weighted, fitted: Option<&Mechanics>| {
            [&shared.as_first, &shared.as_second, &own.hypothesis]
                .map(|one| Predicted::by(one, evidence, fitted))
        };
        let seen = &sets[1].search.evidence;
        let of_seen = predicted(seen, Some(&own.mechanics));
        let [_, alike, apart] = of_seen.each_ref().map(|one| one.loss);
        let free = real(own.free.len());
        let by_chance = free + seen.settings().comparison.max_chance * (2.0 * free).sqrt();
        // what cannot be predicted is no evidence
        let left = if alike.is_finite() { alike - apart - by_chance } else { 0.0 };
        let unseen = sets[1].diagnosis.evidence.unseen.as_ref().map(|unseen| &unseen.evidence);
        let of_unseen = unseen.map(|unseen| predicted(unseen, None));
        let tolerated = seen.settings().verdict.min_icr_difference * file.vehicle.gauge;
        let [first, second] =
            [&shared.as_first, &shared.as_second].map(|model| vehicle(file, model, tolerated));
        let drift = Drift::of(unseen.unwrap_or(seen), [&first, &second]);
        Self {
            drift,
            errors: of_unseen.unwrap_or(of_seen).map(|one| one.error),
            are_held_out: unseen.is_some(),
            left,
            vehicle: second,
        }
    }
}

/// Refuses differences with which the first set's model predicts the second set hardly better.
/// Correlated sizes may each look different, although a change of one of them alone explains
/// nothing. Returns the differences, and the model in which those that are claimed differ.
///
/// The runs are those of the fit: there, differences that are right raise the log-likelihood by as
/// much as the evidence that is asked of a claim.
pub(super) fn judge(both: Sets, mut judged: Vec<Difference>) -> (Vec<Difference>, Shared) {
    let evidence = &both.sets[1].search.evidence;
    let needed = evidence.settings().verdict.min_ln_bayes_factor;
    let fitted = Some(&both.choice.fits[1].fit.mechanics);
    let predicted = |model: &Hypothesis| Predicted::by(model, evidence, fitted);
    let mut claimed: Vec<Subject> =
        judged.iter().filter(|one| one.refused.is_none()).map(|one| one.group.subject).collect();
    loop {
        let shared = both.model(&claimed);
        if claimed.is_empty() {
            return (judged, shared);
        }
        let [before, after] = [&shared.as_first, &shared.as_second].map(predicted);
        if after.gain_over(&before) >= needed {
            return (judged, shared);
        }
        // the one without which the others predict best
        let others = (0..claimed.len()).map(|place| {
            let mut others = claimed.clone();
            others.remove(place);
            (place, predicted(&both.model(&others).as_second).loss)
        });
        let least = others.min_by(|a, b| a.1.total_cmp(&b.1));
        let (place, _) = least.expect("a claim");
        let subject = claimed.remove(place);
        let why = NoDifference::NotCloser { without: before.error, with: after.error };
        for one in judged.iter_mut().filter(|one| one.group.subject == subject) {
            one.refused = Some(why.clone());
        }
    }
}

/// A vehicle file with all of a hypothesis: effects, and its constant ICRs to `tolerated`, m.
fn vehicle(file: &VehicleFile, hypothesis: &Hypothesis, tolerated: f64) -> VehicleFile {
    let mut vehicle = file.clone();
    for effect in &hypothesis.effects {
        vehicle.effects.insert(effect.clone());
    }
    correct_constants(&mut vehicle, hypothesis, hypothesis.friction_level, tolerated);
    vehicle
}

/// How well a hypothesis predicts, without a fit.
struct Predicted {
    /// Weighted root mean square of the whitened residual.
    error: f64,
    /// Twice the negative log-likelihood; ∞ where no motion in time exists.
    loss: f64,
}

impl Predicted {
    /// By a hypothesis beside the mechanics of a similar one.
    fn by(hypothesis: &Hypothesis, evidence: &Weighted, before: Option<&Mechanics>) -> Self {
        let mechanics = Mechanics::beside(before, hypothesis, evidence);
        let prediction = mechanics.predict(&Instruments::of(hypothesis), evidence);
        let residual = evidence.residual(&prediction);
        let is_possible = mechanics.failure().is_none();
        let loss = if is_possible { evidence.loss(&residual) } else { f64::INFINITY };
        Self { error: excess(evidence, &residual), loss }
    }

    /// Log-likelihood over that of another prediction.
    fn gain_over(&self, other: &Self) -> f64 {
        (other.loss - self.loss) / 2.0
    }
}
