//! What an earlier search of the same samples found.
//!
//! Evidence is searched again when its noise was estimated anew. Its hypotheses are the same and
//! their minima hardly move, so a refit begins where the earlier one ended, with its simulations.
//! Signatures are taken over where the base predicts about the same motion.

use super::Found;
use super::done::Done;
use crate::base::Base;
use crate::candidate::Catalogue;
use crate::fit::Fit;
use crate::hypothesis::{Hypothesis, Unknown};
use crate::mechanics::Mechanics;
use crate::weighted::Weighted;
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::sync::Arc;
use trackdyn_model::EffectId;

/// The best fit of each set of effects that was tried, the best set, and the signatures.
#[derive(Default)]
pub struct Known {
    fits: BTreeMap<Vec<EffectId>, Minimum>,
    /// Effects of the best hypothesis, ascending.
    pub(super) best: Vec<EffectId>,
    signed: Option<Signed>,
}

/// Where a fit ended.
pub(super) struct Minimum {
    hypothesis: Hypothesis,
    unknowns: Vec<Unknown>,
    mechanics: Mechanics,
    /// Twice the objective.
    objective: f64,
}

/// Signatures with what they were taken beside, and whitened by.
pub(super) struct Signed {
    pub base: Arc<Base>,
    pub evidence: Weighted,
    pub catalogue: Catalogue,
}

impl Known {
    /// This and what a search found, whose best hypothesis is `best`.
    pub(super) fn after(self, done: Done, best: Found, signed: Signed) -> Self {
        let mut fits: BTreeMap<Vec<EffectId>, Minimum> = BTreeMap::new();
        let effects = best.effects.clone();
        for Found { effects, fit, .. } in done.into_found().chain([best]) {
            let Fit { hypothesis, unknowns, mechanics, objective, .. } = fit;
            let is_less = fits.get(&effects).is_none_or(|other| objective < other.objective);
            if is_less && objective.is_finite() {
                fits.insert(effects, Minimum { hypothesis, unknowns, mechanics, objective });
            }
        }
        let mut all = self.fits;
        all.extend(fits);
        Self { fits: all, best: effects, signed: Some(signed) }
    }

    /// The minimum with these effects; none where they were not tried.
    pub(super) fn with(&self, effects: &[EffectId]) -> Option<&Minimum> {
        self.fits.get(effects)
    }

    /// Takes out the signatures for other evidence of the same samples; none where the base now
    /// predicts another motion, or where a sample that was lost has been restored.
    pub fn take_signatures(&mut self, base: &Base, evidence: &Weighted) -> Option<Catalogue> {
        let Signed { base: before, evidence: of, catalogue } = self.signed.take()?;
        let most = evidence.settings().candidates.max_base_change;
        let serve = change(&before.fit, &base.fit, evidence) < most && of.lost_are_lost(evidence);
        serve.then(|| catalogue.whitened_by(evidence, &of))
    }
}

impl Minimum {
    /// The hypothesis fitted to other evidence of the same samples.
    pub fn refitted(&self, evidence: &Weighted) -> Fit {
        let Self { hypothesis, unknowns, mechanics, .. } = self;
        Fit::new(hypothesis.clone(), unknowns, evidence, Some(mechanics))
    }
}

/// Change of the predicted motion, as a share of it. A turn counts as the way of a track.
fn change(before: &Fit, now: &Fit, evidence: &Weighted) -> f64 {
    let half_gauge = now.hypothesis.vehicle.gauge / 2.0;
    let way = |motion: Vector3<f64>| {
        motion.component_mul(&Vector3::new(1.0, 1.0, half_gauge)).norm_squared()
    };
    let [before, now] = [before, now].map(|fit| fit.prediction(evidence));
    let changed: f64 = before.iter().zip(&now).map(|(before, now)| way(now - before)).sum();
    let whole: f64 = now.iter().map(|now| way(*now)).sum();
    (changed / whole).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::Search;
    use super::*;
    use crate::candidate::{Beside, candidates};
    use crate::evidence::Evidence;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::mechanics::Instruments;
    use crate::plan::assumed_noise;
    use crate::progress::Watch;
    use crate::settings::Settings;
    use trackdyn_core::{Pose, real};
    use trackdyn_model::VehicleFile;
    use trackdyn_recording::TrackSample;

    const SUSPECTS: [&str; 4] =
        ["viscous-friction", "friction-gradient", "hitch-drag", "stribeck-friction"];

    /// Drives of a robot with these effects.
    fn driven(effects: &str) -> Evidence {
        let reading = |run: usize| {
            move |k: usize| {
                let (t, phase) = (0.03 * real(k), real(run));
                let v_left = 0.7 * (0.5 * t + phase).sin();
                let v_right = 0.7 * (0.31 * t + 2.0 * phase).cos();
                TrackSample { t, v_left, v_right }
            }
        };
        let runs: Vec<PlannedRun> = (0..3)
            .map(|run| PlannedRun {
                tracks: (0..=100 * READINGS).map(reading(run)).collect(),
                pose: Pose::default(),
                blocks: (0..10).map(|block| 10 * READINGS * block).collect(),
            })
            .collect();
        let (file, settings) = (VehicleFile::auriga_alpha(), Settings::default());
        let with = |of: Hypothesis, id: &str| of.with_effect(id.parse().expect("an effect"));
        let robot = Hypothesis::filed(&file, &settings.prior);
        let robot = effects.split_whitespace().fold(robot, with);
        Evidence::planned(&runs, assumed_noise(1e-3, 1e-3), 0.0, &settings, |evidence| {
            Mechanics::new(&robot, evidence).predict(&Instruments::of(&robot), evidence)
        })
    }

    /// A search that knows nothing.
    fn search(evidence: &Weighted, base: Base) -> Search {
        let suspects = SUSPECTS.map(|id| EffectId::of(id).expect("an effect"));
        let tried = candidates(&suspects, &base.instruments, evidence);
        let entries = Beside::new(&base.fit.hypothesis, evidence).signatures(&tried);
        Search::new(evidence.clone(), base, Catalogue { entries })
    }

    fn best(search: &Search) -> Found {
        search.best(&Watch::none()).expect("nobody stops it")
    }

    #[test]
    fn a_search_that_knows_another_ends_where_one_from_nothing_does() {
        const MAX_DIFFERENCE: f64 = 0.1;
        let evidence = Weighted::new(driven("viscous-friction hitch-drag"));
        let file = VehicleFile::auriga_alpha();
        let base = Base::new(&file, &evidence, &Watch::none()).expect("nobody stops it");
        let first = search(&evidence, base.clone());
        let found = best(&first);
        assert_eq!(found.effects.len(), 2, "{:?}", found.effects);
        let known = first.into_known(found);
        let noisier = evidence.with_scale([1.7, 1.3, 1.5]);
        let anew = search(&noisier, base.refitted(&noisier));
        let from_nothing = best(&anew);
        let knowing = best(&anew.with_known(known));
        assert_eq!(knowing.effects, from_nothing.effects);
        let difference = knowing.fit.objective - from_nothing.fit.objective;
        assert!(difference < MAX_DIFFERENCE, "worse by {difference}");
    }

    /// Signatures of an earlier search are those that would be found anew, or there are none.
    #[test]
    fn signatures_serve_as_long_as_the_base_moves_alike() {
        let evidence = Weighted::new(driven("viscous-friction"));
        let file = VehicleFile::auriga_alpha();
        let base = Base::new(&file, &evidence, &Watch::none()).expect("nobody stops it");
        let nothing = |search: &Search| search.nothing();
        let known = |search: Search| {
            let nothing = nothing(&search);
            search.into_known(nothing)
        };
        let noisier = evidence.with_noise(assumed_noise(3e-3, 2e-3)).with_scale([1.0, 1.2, 1.0]);
        let again = base.refitted(&noisier);
        let taken = known(search(&evidence, base.clone())).take_signatures(&again, &noisier);
        let taken = taken.expect("the base hardly moved");
        let anew = search(&noisier, again).catalogue;
        assert_eq!(taken.entries.len(), anew.entries.len());
        for ((variant, taken), (_, anew)) in taken.entries.iter().zip(&anew.entries) {
            for (taken, anew) in taken.iter().zip(anew) {
                let square = |column: &[Vector3<f64>]| -> f64 {
                    column.iter().map(Vector3::norm_squared).sum()
                };
                let off: Vec<_> =
                    taken.column.iter().zip(&anew.column).map(|(a, b)| a - b).collect();
                let off = (square(&off) / square(&anew.column)).sqrt();
                assert!(off < 0.05, "{variant:?}: {off}");
            }
        }
        let mut moved = base.clone();
        moved.fit.hypothesis.offset[1] += 0.1;
        let taken = known(search(&evidence, base.clone())).take_signatures(&moved, &evidence);
        assert!(taken.is_none(), "another robot");
        let lost = evidence.without(&[7]);
        let taken = known(search(&lost, base.clone())).take_signatures(&base, &evidence);
        assert!(taken.is_none(), "a sample without signatures");
    }
}
