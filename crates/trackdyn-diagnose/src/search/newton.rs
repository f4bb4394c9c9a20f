//! Newton's law in one piece, as one step of the search.
//!
//! Inertia and centripetal force share the mass over the friction, and a late clock looks like
//! inertia: each alone may hide in a minimum far from the whole. So both are tried together, at
//! levels of that one ratio over two decades, with the clock of the present fit and with none.
//!
//! These accelerations also move load to a side, by the height of the mass. A wrong height looks
//! like unequal strengths of the inertial effects. So the height is tried beside equal strengths.

use super::done::{Key, Step};
use super::{Found, Search};
use crate::base::without_clock;
use crate::fit::{Fit, Point};
use crate::hypothesis::{Hypothesis, Unknown, at_share};
use crate::progress::{Cancelled, Watch};
use trackdyn_model::EffectId;

impl Search {
    /// The hypothesis with all inertial effects that it lacks, refitted from the best of the
    /// levels; none where it lacks fewer than two, or no motion exists at any level.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub(crate) fn newton(&self, beside: &Found, watch: &Watch) -> Result<Option<Found>, Cancelled> {
        let hypothesis = &beside.fit.hypothesis;
        let is_lacking =
            |effect: &EffectId| effect.card().is_inertia() && hypothesis.effect(*effect).is_none();
        let inertial: Vec<EffectId> = EffectId::all().filter(is_lacking).collect();
        if inertial.len() < 2 {
            return Ok(None);
        }
        let (effects, unknowns) = beside.extended(&inertial);
        if let Some(found) = self.again(&effects) {
            return Ok(Some(found));
        }
        let mut clocks =
            vec![hypothesis.clone(), without_clock(hypothesis, &self.base.as_filed.hypothesis)];
        clocks.dedup();
        let levels = self.settings().search.newton_levels.iter();
        let starts =
            levels.map(|&level| clocks.iter().map(|clock| at(clock, &inertial, level)).collect());
        self.refitted_from(starts, beside, effects, &unknowns, watch)
    }

    /// Adds load transfer to a hypothesis with inertia and refits it from the best start: one level
    /// for all inertial effects, at a typical height and at that of the vehicle file. None where it
    /// has load transfer already, or no motion exists at any level.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub(super) fn with_load(
        &self,
        newton: &Found,
        watch: &Watch,
    ) -> Result<Option<Found>, Cancelled> {
        let moves_load = |effect: &EffectId| effect.card().moves_load();
        let load: Vec<EffectId> = EffectId::all().filter(moves_load).collect();
        if load.iter().any(|effect| newton.effects.contains(effect)) {
            return Ok(None);
        }
        let (effects, unknowns) = newton.extended(&load);
        if let Some(found) = self.again(&effects) {
            return Ok(Some(found));
        }
        let inertial = newton.effects.iter().copied().filter(|one| one.card().is_inertia());
        let inertial: Vec<EffectId> = inertial.collect();
        let here = &newton.fit.hypothesis;
        let mut heights = vec![at(here, &load, 1.0)];
        if load.iter().any(|&effect| here.effect(effect).is_some()) {
            heights.push(here.clone());
        }
        let levels = self.settings().search.newton_levels.iter();
        let starts = levels
            .flat_map(|&level| heights.iter().map(move |high| (high, level)))
            .map(|(high, level)| vec![at(high, &inertial, level)]);
        self.refitted_from(starts, newton, effects, &unknowns, watch)
    }

    /// A hypothesis with more effects than `beside`, refitted from the best of its starts; none
    /// where no motion exists at any. Starts that differ by their clock alone stand together.
    fn refitted_from(
        &self,
        starts: impl Iterator<Item = Vec<Hypothesis>>,
        beside: &Found,
        effects: Vec<EffectId>,
        unknowns: &[Unknown],
        watch: &Watch,
    ) -> Result<Option<Found>, Cancelled> {
        let mut best: Option<Point> = None;
        for together in starts {
            let mut before = beside.fit.mechanics.clone();
            for start in together {
                watch.go_on()?;
                let point = Point::new(start, unknowns, &self.evidence, Some(&before));
                // A clock of the poses moves nothing.
                before = point.mechanics().clone();
                let most = best.as_ref().map_or(f64::INFINITY, |best| best.objective);
                if point.objective < most {
                    best = Some(point);
                }
            }
        }
        let Some(best) = best else { return Ok(None) };
        watch.go_on()?;
        let fit = Fit::from_point(best, unknowns, &self.evidence);
        let found = self.recalibrated(effects, fit);
        self.done.keep(Key::step(beside, Step::Newton), &found);
        Ok(Some(found))
    }
}

/// The hypothesis with these effects, their sizes at `level` times the typical ones.
fn at(hypothesis: &Hypothesis, effects: &[EffectId], level: f64) -> Hypothesis {
    let with = |hypothesis: Hypothesis, &effect| hypothesis.with_effect(at_share(effect, level));
    effects.iter().fold(hypothesis.clone(), with)
}
