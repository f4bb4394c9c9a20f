//! Rivals: effects that explain a recording equally well, each at its fitted size.

use super::question::Question;
use crate::base::{Base, Calibration, OFFSETS};
use crate::candidate::{Beside, Catalogue, variants};
use crate::evidence::Evidence;
use crate::fit::Fit;
use crate::hypothesis::{Hypothesis, Unknown, active, typical, unknowns_of};
use crate::mechanics::{Instruments, Mechanics, is_instrument};
use crate::search::Search;
use crate::settings::Settings;
use crate::weighted::Weighted;
use nalgebra::Vector3;
use std::sync::Arc;
use trackdyn_model::{EffectId, VehicleFile};

/// One member of a class.
#[derive(Clone)]
pub struct Rival {
    /// The effect.
    pub effect: EffectId,
    /// The vehicle with the effect.
    pub hypothesis: Hypothesis,
    /// Unknowns: constant ICRs, instruments, and the effect's own parameters.
    pub unknowns: Vec<Unknown>,
}

impl Rival {
    /// The member that the diagnosis fitted. Its parameters are those of the vehicle file, or else
    /// of the diagnosis, or else typical.
    pub fn fitted(question: &Question, file: &VehicleFile, settings: &Settings) -> Self {
        let effect = question.effect;
        let given = Hypothesis::filed(file, &settings.prior);
        let hypothesis = match given.effect(effect) {
            Some(_) => given,
            None => given.with_effect(active(effect, &question.values)),
        };
        Self { effect, hypothesis, unknowns: Vec::new() }
    }

    /// Mechanics of the rival on this evidence.
    pub fn mechanics(&self, evidence: &Evidence) -> Mechanics {
        Mechanics::new(&self.hypothesis, evidence)
    }

    /// Predicted motion of each sample.
    pub fn moves(&self, evidence: &Evidence) -> Vec<Vector3<f64>> {
        self.mechanics(evidence).predict(&Instruments::of(&self.hypothesis), evidence)
    }

    /// Delay of the poses, s.
    pub fn delay(&self) -> f64 {
        Instruments::of(&self.hypothesis).sensor.delay
    }

    /// The other members, each fitted to the motion of this one on the given driving.
    pub fn mimicked(&self, question: &Question, driving: &Weighted) -> Vec<Self> {
        let without = self.hypothesis.without(self.effect);
        let driving = &weighed_coarsely(driving, &without);
        let vehicle = &self.hypothesis.vehicle;
        let instruments: Vec<EffectId> = EffectId::all()
            .filter(|effect| !question.members.contains(effect))
            .filter(|&effect| is_instrument(vehicle, &typical(effect)))
            .collect();
        let mut nuisances = OFFSETS.to_vec();
        nuisances.extend(instruments.iter().copied().flat_map(unknowns_of));
        let fit = Fit::new(without, &nuisances, driving, None);
        let calibration = Calibration::Vehicle;
        let base = Base { as_filed: fit.clone(), fit, nuisances, instruments, calibration };
        let base = Arc::new(base);
        let others = question.members.iter().copied().filter(|member| *member != self.effect);
        others
            .map(|effect| {
                let hypothesis = &base.fit.hypothesis;
                let tried = variants(effect, driving);
                let entries = Beside::new(hypothesis, driving).signatures(&tried);
                let catalogue = Catalogue { entries };
                let search = Search::new(driving.clone(), Arc::clone(&base), catalogue);
                let nothing = search.nothing();
                let best = search.screen(&nothing).into_iter().next();
                let found = best.map_or(nothing.clone(), |best| search.refit(&nothing, &[best]));
                Self { effect, hypothesis: found.fit.hypothesis, unknowns: found.fit.unknowns }
            })
            .collect()
    }
}

/// The driving with a noise so large that no change by the effect counts as an outlier: the change
/// is the signal here.
fn weighed_coarsely(driving: &Weighted, without: &Hypothesis) -> Weighted {
    let mechanics = Mechanics::new(without, driving);
    let residual = driving.residual(&mechanics.predict(&Instruments::of(without), driving));
    let longest = residual.iter().map(Vector3::norm).fold(0.0, f64::max);
    let most = driving.settings().plan.max_mimicked_residual;
    driving.with_scale([(longest / most).max(1.0); 3])
}
