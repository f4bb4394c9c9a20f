//! Change of the inertial departure by laws of the shear stress.
//!
//! # Law
//! Beside one simulated motion it is found at the laws' own numbers θ₀ ([`sheared`]). Around these
//! it is linear, c(θ) = c(θ₀) + Σ (θ − θ₀) ∂c/∂θ, and used as far as the departure itself
//! ([`inertia`]).
//!
//! [`inertia`]: super::inertia
//! [`sheared`]: super::sheared

use super::coarse;
use super::inertia::{InertiaNear, Within};
use super::simulated::{Case, are_same, typical};
use super::slope;
use crate::hypothesis::{Unknown, differences, find};
use crate::surface::Surface;
use rayon::prelude::*;
use std::sync::Arc;
use trackdyn_core::Twist;
use trackdyn_model::Effects;

/// Change of the departure by laws of the shear stress, valid near their numbers.
#[derive(Clone)]
pub struct ByShear {
    at: Arc<Solved>,
    /// Its derivatives by the free numbers of the laws.
    slopes: Vec<Arc<Slope>>,
    /// The changes extrapolated to other numbers; none at the laws themselves.
    moved: Option<Arc<Changes>>,
}

/// A mean twist (paper's frame) at each reading of each run.
type Changes = Vec<Vec<Twist>>;

/// The change by these laws beside this departure.
struct Solved {
    laws: Effects,
    inertia: InertiaNear,
    changes: Changes,
}

/// Derivative by one number of a law.
struct Slope {
    by: Unknown,
    /// Where it was computed.
    at: Arc<Solved>,
    /// Change per unit of the number.
    changes: Changes,
}

impl ByShear {
    /// The change by these laws: extrapolated from `before` where that is near and all slopes are
    /// known, otherwise found. `with` is the table of stationary motions with the laws, `case` the
    /// robot without; slopes by the `free` unknowns are computed where missing.
    pub fn beside(
        before: Option<&Self>,
        laws: &Effects,
        with: &Surface,
        (inertia, case): (&InertiaNear, &Case),
        free: &[Unknown],
        within: Within,
    ) -> Self {
        let is_free = |by: &&Unknown| laws.iter().any(|law| by.is_of(law.effect()));
        let free: Vec<Unknown> =
            free.iter().filter(is_free).copied().filter(|by| typical(*by) > 0.0).collect();
        let beside_it = before.filter(|before| before.at.inertia.is_from(inertia));
        let knows = |near: &&Self| free.iter().all(|by| near.slope(*by).is_some());
        if let Some(near) = beside_it.filter(knows).and_then(|near| near.to(laws, within)) {
            return near;
        }
        let at = match beside_it.filter(|near| near.at.laws == *laws) {
            Some(near) => Arc::clone(&near.at),
            None => Arc::new(Solved::new(laws, with, inertia, case)),
        };
        let alike = |slope: &&Arc<Slope>| slope.at.is_alike(&at, case);
        let before = before.map_or(&[][..], |before| &before.slopes);
        let mut slopes: Vec<Arc<Slope>> = before.iter().filter(alike).cloned().collect();
        let is_missing = |by: &Unknown| slopes.iter().all(|slope| slope.by != *by);
        let missing: Vec<Unknown> = free.into_iter().filter(is_missing).collect();
        let found = missing.into_par_iter().filter_map(|by| Slope::new(by, &at, with, case));
        slopes.extend(found.map(Arc::new).collect::<Vec<_>>());
        Self { at, slopes, moved: None }
    }

    /// The change extrapolated to other numbers of the laws; none where these are other laws, or
    /// farther away than `within` allows.
    fn to(&self, laws: &Effects, within: Within) -> Option<Self> {
        if !are_same(&self.at.laws, laws) {
            return None;
        }
        let mut moved: Option<Changes> = None;
        for (by, change) in differences(&self.at.laws, laws) {
            let slope = self.slope(by).filter(|_| within.knows(change / typical(by)))?;
            let sums = moved.get_or_insert_with(|| self.at.changes.clone());
            for (sums, slopes) in sums.iter_mut().zip(&slope.changes) {
                for (sum, slope) in sums.iter_mut().zip(slopes) {
                    *sum += *slope * change;
                }
            }
        }
        Some(Self { moved: moved.map(Arc::new), ..self.clone() })
    }

    fn slope(&self, by: Unknown) -> Option<&Slope> {
        self.slopes.iter().map(Arc::as_ref).find(|slope| slope.by == by)
    }

    /// Mean twist (paper's frame) at each reading of a run.
    pub fn of_run(&self, run: usize) -> &[Twist] {
        &self.moved.as_deref().unwrap_or(&self.at.changes)[run]
    }

    /// Whether both are extrapolated from the same laws beside the same motion.
    pub fn is_from(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.at, &other.at)
    }
}

impl Solved {
    fn new(laws: &Effects, with: &Surface, inertia: &InertiaNear, case: &Case) -> Self {
        let changes = inertia.sheared(laws, with, case);
        Self { laws: laws.clone(), inertia: inertia.unmoved(), changes }
    }

    /// Whether slopes of one serve for the other.
    fn is_alike(&self, other: &Self, case: &Case) -> bool {
        let reach = Within::reach(case.settings());
        let mut changes = differences(&self.laws, &other.laws).into_iter();
        are_same(&self.laws, &other.laws)
            && changes.all(|(by, change)| reach.knows(change / typical(by)))
            && self.inertia.is_alike(&other.inertia)
    }
}

impl Slope {
    /// The derivative by this number; none where it cannot be changed.
    fn new(by: Unknown, at: &Arc<Solved>, with: &Surface, case: &Case) -> Option<Self> {
        let Unknown::Effect(effect, place) = by else { return None };
        let share = case.settings().sheared_difference;
        let (law, step) = (find(&at.laws, effect)?, share * typical(by));
        let stepped = |step: f64| Some((step, slope::moved(law, place, step)?));
        let (step, law) = [step, -step].into_iter().find_map(stepped)?;
        let mut laws = at.laws.clone();
        laws.insert(law);
        let mut effects = case.model.effects().clone();
        for law in &laws {
            effects.insert(law.clone());
        }
        let model = coarse(case.vehicle, effects);
        let range = case.settings().speed_range;
        let there = Surface::new(&model, case.largest, range, Some(with));
        let there = at.inertia.sheared(&laws, &there, case);
        let of_run = |(there, here): (&Vec<Twist>, &Vec<Twist>)| {
            there.iter().zip(here).map(|(there, here)| (*there - *here) / step).collect()
        };
        let changes = there.iter().zip(&at.changes).map(of_run).collect();
        Some(Self { by, at: Arc::clone(at), changes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::Evidence;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::hypothesis::{Hypothesis, unknowns_of};
    use crate::mechanics::{Instruments, Mechanics};
    use crate::settings::{self, Settings};
    use nalgebra::Vector3;
    use trackdyn_core::{Pose, real};
    use trackdyn_estimate::weighting::SegmentNoise;
    use trackdyn_model::{ActiveEffect, VehicleFile};
    use trackdyn_recording::TrackSample;

    /// A robot with inertia and this law.
    fn robot(law: &str) -> Hypothesis {
        let texts = ["yaw-inertia:strength=1,gyration_m=0.3", "centripetal", law];
        let mut file = VehicleFile::auriga_alpha();
        let effects = texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect"));
        file.effects = effects.collect();
        Hypothesis::filed(&file, &settings::Prior::default())
    }

    /// Ten seconds of changing track speeds, so many times some 0.6 m/s.
    fn driven(hypothesis: &Hypothesis, times: f64) -> Evidence {
        let tracks = (0..=37 * READINGS).map(|k| {
            let t = 0.03 * real(k);
            let (v_left, v_right) = (0.6 * (1.3 * t).sin(), 0.5 * (2.1 * t).cos());
            let (v_left, v_right) = (times * v_left, times * v_right);
            TrackSample { t, v_left, v_right }
        });
        let blocks = vec![0];
        let run = PlannedRun { pose: Pose::default(), tracks: tracks.collect(), blocks };
        let noise = SegmentNoise { pose: [1e-6; 3], walk: [1e-7; 3], heading: 0.0, stamp: 0.0 };
        Evidence::planned(&[run], noise, 0.0, &Settings::default(), |evidence| {
            Mechanics::new(hypothesis, evidence).predict(&Instruments::of(hypothesis), evidence)
        })
    }

    fn change(mechanics: &Mechanics) -> &ByShear {
        mechanics.in_time.sheared().expect("a law of the shear stress")
    }

    fn distance(a: &ByShear, b: &ByShear) -> f64 {
        let pairs = a.of_run(0).iter().zip(b.of_run(0));
        let squares = pairs.map(|(a, b)| Vector3::from((*a - *b).to_array()).norm_squared());
        squares.sum::<f64>().sqrt()
    }

    /// A law of size zero changes nothing, even where centripetal force is large.
    #[test]
    fn a_law_without_size_changes_nothing() {
        for law in ["stribeck-friction:excess=0", "viscous-friction:growth_s_per_m=0"] {
            let with = robot(law);
            let shears = |effect: &&ActiveEffect| effect.card().shears();
            let effects = with.effects.iter().filter(|effect| !shears(effect)).cloned().collect();
            let without = Hypothesis { effects, ..with.clone() };
            let evidence = driven(&without, 2.0);
            let predicted = |of: &Hypothesis| {
                Mechanics::new(of, &evidence).predict(&Instruments::of(of), &evidence)
            };
            let pairs = predicted(&with).into_iter().zip(predicted(&without));
            let off = pairs.map(|(with, without)| (with - without).norm()).fold(0.0, f64::max);
            assert!(off < 1e-6, "{law}: {off:.2e} m or rad");
        }
    }

    /// Near the laws for which it was found, a change is linear in their numbers, and far from them
    /// it is found anew.
    #[test]
    fn near_laws_are_extrapolated_and_far_ones_solved() {
        for (law, near, far) in [
            (
                "stribeck-friction:excess=0.3,speed_m_per_s=0.1",
                "stribeck-friction:excess=0.33,speed_m_per_s=0.11",
                "stribeck-friction:excess=0.9,speed_m_per_s=0.1",
            ),
            (
                "shear-displacement:modulus_m=0.02",
                "shear-displacement:modulus_m=0.0203",
                "shear-displacement:modulus_m=0.06",
            ),
        ] {
            let hypothesis = robot(law);
            let evidence = driven(&hypothesis, 1.0);
            let free: Vec<Unknown> =
                hypothesis.effects.iter().flat_map(|law| unknowns_of(law.effect())).collect();
            let here = Mechanics::new(&hypothesis, &evidence);
            let here = here.with_slopes(&hypothesis, &free, &evidence);
            let [near, far] = [near, far].map(robot);
            let solved = Mechanics::new(&near, &evidence);
            let extrapolated = Mechanics::beside(Some(&here), &near, &evidence);
            assert!(extrapolated.has_inertia_of(&here), "{law}");
            let moved = distance(change(&solved), change(&here));
            let off = distance(change(&solved), change(&extrapolated));
            assert!(off < 0.15 * moved, "{law}: {off:.2e} of {moved:.2e}");
            let anew = Mechanics::beside(Some(&here), &far, &evidence);
            assert!(!anew.has_inertia_of(&here), "{law}");
            let off = distance(change(&anew), change(&Mechanics::new(&far, &evidence)));
            let moved = distance(change(&anew), change(&here));
            assert!(off < 1e-4 * moved, "{law}: {off:.2e} of {moved:.2e}");
        }
    }
}
