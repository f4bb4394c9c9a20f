//! Newton's law in one piece, as one step of the search.
//!
//! Inertia and centripetal force share the mass over the friction, and a late clock looks like
//! inertia: each alone may hide in a minimum far from the whole. So both are tried together, at
//! levels of that one ratio over two decades, with the clock of the present fit and with none.

use super::{Found, Search};
use crate::base::without_clock;
use crate::fit::{Fit, Point};
use crate::hypothesis::{Hypothesis, active, neutral, unknowns_of};
use trackdyn_model::EffectId;
use trackdyn_model::effect::{Parameter, Role};

impl Search {
    /// The hypothesis with all inertial effects that it lacks, refitted from the best of the
    /// levels; none where it lacks fewer than two.
    pub(super) fn newton(&self, beside: &Found) -> Option<Found> {
        let hypothesis = &beside.fit.hypothesis;
        let is_lacking =
            |effect: &EffectId| effect.card().is_inertia() && hypothesis.effect(*effect).is_none();
        let inertial: Vec<EffectId> = EffectId::all().filter(is_lacking).collect();
        if inertial.len() < 2 {
            return None;
        }
        let mut effects = beside.effects.clone();
        let mut unknowns = beside.fit.unknowns.clone();
        for &effect in &inertial {
            effects.push(effect);
            unknowns.extend(unknowns_of(effect));
        }
        effects.sort_unstable();
        let clocks =
            [hypothesis.clone(), without_clock(hypothesis, &self.base.as_filed.hypothesis)];
        let levels = &self.settings().search.newton_levels;
        let starts =
            clocks.iter().flat_map(|clock| levels.iter().map(|&l| at(clock, &inertial, l)));
        let points = starts
            .map(|start| Point::new(start, &unknowns, &self.evidence, Some(&beside.fit.mechanics)));
        let best = points.min_by(|a, b| a.objective.total_cmp(&b.objective))?;
        if best.objective.is_infinite() {
            return None;
        }
        let fit = Fit::from_point(best, &unknowns, &self.evidence);
        Some(self.recalibrated(effects, fit))
    }
}

/// The hypothesis with these effects, their sizes at `level` times the typical ones.
fn at(hypothesis: &Hypothesis, effects: &[EffectId], level: f64) -> Hypothesis {
    let value = |parameter: &Parameter| match parameter.role {
        Role::Size { .. } => neutral(parameter) + level * (parameter.typical - neutral(parameter)),
        _ => parameter.typical,
    };
    effects.iter().fold(hypothesis.clone(), |hypothesis, &effect| {
        let values: Vec<f64> = effect.card().parameters.iter().map(value).collect();
        hypothesis.with_effect(active(effect, &values))
    })
}
