//! The motion with which each run begins.
//!
//! A log that is cut out of a drive begins in any state: on ice a robot slides for seconds after
//! its tracks have changed their speed. The twist of a run at its first reading departs from the
//! stationary one by a, unknown, with a prior deviation S that is a share of the fastest speed.
//!
//! # Law
//! For one hypothesis, each run has its own
//!
//! ```text
//! a = argmin Σ ρ(|z(a)|) + |S⁻¹ a|²
//! ```
//!
//! found by Gauss-Newton steps that are halved until they help; z are the whitened residuals of its
//! samples and ρ is Huber's loss. What remains unknown of a is noise that the samples of the run
//! share ([`Weighted::allowing_for_starts`]). This noise is the same for all hypotheses, so none
//! gains by what the beginnings may explain.

use crate::equations::Column;
use crate::evidence::{Evidence, run_ranges};
use crate::hypothesis::Hypothesis;
use crate::mechanics::{Instruments, Mechanics};
use crate::normal::{Columns, Normal, Prior, Solution};
use crate::weighted::Weighted;
use nalgebra::Vector3;
use std::ops::Range;
use std::sync::Arc;
use trackdyn_core::Twist;

/// Where the search for the start of a run stands, in prior deviations.
struct Start {
    samples: Range<usize>,
    run: usize,
    /// Best start so far, with its objective, the step from there, and the fall it promises.
    best: Vector3<f64>,
    objective: f64,
    step: Vector3<f64>,
    promise: f64,
}

impl Start {
    /// The start that is tried.
    fn tried(&self) -> Vector3<f64> {
        self.best + self.step
    }

    /// Takes or rejects the start that was tried, by the whitened residual there and its
    /// derivatives.
    fn judged(&mut self, evidence: &Weighted, residual: &[Vector3<f64>], columns: &[Column; 3]) {
        let residual = &residual[self.samples.clone()];
        let tried = self.tried();
        let objective = evidence.loss(residual) + tried.norm_squared();
        if objective >= self.objective || !objective.is_finite() {
            self.step /= 2.0;
            self.promise /= 2.0;
            return;
        }
        let normal = Normal::new(&Columns {
            residual,
            columns: &columns.each_ref().map(|column| column[self.samples.clone()].to_vec()),
            weights: &evidence.weights(residual),
            blocks: &vec![0; residual.len()],
            count: 1,
        });
        // |a + δ|² is a prior of the step δ with the mean −a
        let known = [0, 1, 2].map(|k| Prior::normal(-tried[k], 1.0));
        let Solution { estimate, gain, .. } = normal.fit(&[0, 1, 2], &known);
        (self.best, self.objective) = (tried, objective);
        (self.step, self.promise) = (Vector3::from_fn(|k, _| estimate[k]), gain);
    }
}

/// Prior deviations of the twist with which a run begins: across and along, m/s, and yaw, rad/s.
fn deviations(evidence: &Evidence, hypothesis: &Hypothesis) -> Vector3<f64> {
    let known = evidence.settings().evidence.start_deviation * evidence.fastest();
    Vector3::new(known, known, 2.0 * known / hypothesis.vehicle.gauge)
}

/// A twist in prior deviations, S⁻¹ a.
fn scaled(start: &Twist, deviations: &Vector3<f64>) -> Vector3<f64> {
    Vector3::from(start.to_array()).component_div(deviations)
}

/// Prior penalty Σ |S⁻¹ a|² of these starts of a hypothesis.
pub fn penalty(evidence: &Evidence, hypothesis: &Hypothesis, starts: &[Twist]) -> f64 {
    let deviations = deviations(evidence, hypothesis);
    starts.iter().map(|start| scaled(start, &deviations).norm_squared()).sum()
}

/// A hypothesis whose runs begin in the motions that suit it best.
pub struct Begun {
    /// The hypothesis.
    pub hypothesis: Hypothesis,
    /// Its mechanics, without slopes.
    pub mechanics: Mechanics,
    /// Change of each sample by each axis of the twist with which its run begins, times the prior
    /// deviation of that axis.
    pub by_starts: [Column; 3],
}

/// A hypothesis with the best starts of its runs, from its present ones on; none where its motion
/// does not depend on how it began. `before` is the mechanics of a similar hypothesis, for reuse.
pub fn fitted(
    evidence: &Weighted,
    hypothesis: &Hypothesis,
    before: Option<&Mechanics>,
) -> Option<Begun> {
    let deviations = deviations(evidence, hypothesis);
    let instruments = Instruments::of(hypothesis);
    let present = hypothesis.starts_in(evidence);
    let runs = run_ranges(evidence.samples()).map(|samples| {
        let run = evidence.samples()[samples.start].run;
        let best = present.map_or(Vector3::zeros(), |starts| scaled(&starts[run], &deviations));
        let [objective, promise] = [f64::INFINITY; 2];
        Start { samples, run, best, objective, step: Vector3::zeros(), promise }
    });
    let mut runs: Vec<Start> = runs.collect();
    let with = |of: &dyn Fn(&Start) -> Vector3<f64>, runs: &[Start]| -> Hypothesis {
        let mut twists = vec![Twist::zero(); evidence.tracks().len()];
        for start in runs {
            let twist = of(start).component_mul(&deviations);
            twists[start.run] = Twist::from_array(twist.into());
        }
        hypothesis.beginning(evidence, twists)
    };
    let at = |hypothesis: Hypothesis, before: Option<&Mechanics>| {
        let mechanics = Mechanics::beside(before, &hypothesis, evidence);
        let mut by_starts = mechanics.by_starts(&instruments, evidence)?;
        for (column, deviation) in by_starts.iter_mut().zip(deviations.iter()) {
            for value in column.iter_mut() {
                *value *= *deviation;
            }
        }
        Some(Begun { hypothesis, mechanics, by_starts })
    };
    let least = evidence.settings().fit.min_fall;
    let mut before = before.cloned();
    for _ in 0..evidence.settings().evidence.start_rounds {
        let tried = at(with(&Start::tried, &runs), before.as_ref())?;
        let residual = evidence.residual(&tried.mechanics.predict(&instruments, evidence));
        let white = tried.by_starts.map(|column| evidence.white(column));
        for run in &mut runs {
            run.judged(evidence, &residual, &white);
        }
        before = Some(tried.mechanics);
        if runs.iter().all(|run| run.promise < least) {
            break;
        }
    }
    at(with(&|run| run.best, &runs), before.as_ref())
}

/// The evidence in which each run begins with the motion that a hypothesis finds for it; none where
/// its motion does not depend on how it began.
pub fn with_own_starts(evidence: &Weighted, hypothesis: &Hypothesis) -> Option<Weighted> {
    let Begun { hypothesis, by_starts, .. } = fitted(evidence, hypothesis, None)?;
    Some(beginning_as(evidence, &hypothesis).allowing_for_starts(by_starts))
}

/// The evidence whose runs begin as those of a hypothesis.
pub fn beginning_as(evidence: &Weighted, hypothesis: &Hypothesis) -> Weighted {
    match hypothesis.starts_in(evidence) {
        Some(starts) => evidence.with_readings(|seen| seen.with_starts(Arc::clone(starts))),
        None => evidence.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::Evidence;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::fit::Fit;
    use crate::settings::{self, Settings};
    use trackdyn_core::{Pose, real};
    use trackdyn_estimate::weighting::SegmentNoise;
    use trackdyn_model::{ActiveEffect, VehicleFile};
    use trackdyn_recording::TrackSample;

    const RUNS: usize = 6;

    /// A robot on ice, with these effects.
    fn on_ice(effects: &[&str]) -> Hypothesis {
        let mut file = VehicleFile::auriga_alpha();
        file.vehicle.friction.across *= 0.1;
        file.vehicle.friction.along *= 0.1;
        let effects = effects.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect"));
        file.effects = effects.collect();
        Hypothesis::filed(&file, &settings::Prior::default())
    }

    /// Six runs of 5 s whose track speeds change, cut out of slides that `starts` tells.
    fn windows(hypothesis: &Hypothesis, starts: &[Twist]) -> Evidence {
        let run = |index: usize| {
            let tracks = (0..=20 * READINGS).map(|k| {
                let t = 10.0 * real(index) + 0.03 * real(k);
                let (v_left, v_right) = (0.6 * (0.9 * t).sin(), 0.5 * (0.7 * t).cos());
                TrackSample { t, v_left, v_right }
            });
            PlannedRun { pose: Pose::default(), tracks: tracks.collect(), blocks: vec![0] }
        };
        let runs: Vec<PlannedRun> = (0..RUNS).map(run).collect();
        let noise = SegmentNoise { pose: [1e-6; 3], walk: [1e-7; 3], heading: 0.0, stamp: 0.0 };
        Evidence::planned(&runs, noise, 0.0, &Settings::default(), |evidence| {
            let own = evidence.with_starts(starts.to_vec());
            Mechanics::new(hypothesis, &own).predict(&Instruments::of(hypothesis), &own)
        })
    }

    /// Slides of up to 0.5 m/s and rad/s, more than half of the fastest speed.
    fn slides() -> Vec<Twist> {
        let slide = |k: usize| {
            let [a, b, c] = [1.0, 2.3, 4.1].map(|by| (by * real(k + 1)).sin() / 2.0);
            Twist { v_x: a, v_y: b, w: c }
        };
        (0..RUNS).map(slide).collect()
    }

    #[test]
    fn runs_that_were_cut_out_of_a_slide_begin_in_it() {
        let hypothesis = on_ice(&["yaw-inertia:strength=1,gyration_m=0.3", "centripetal"]);
        let seen = Weighted::new(windows(&hypothesis, &slides()));
        let own = with_own_starts(&seen, &hypothesis).expect("it slides");
        // One pose is off by 1 mm and 1 mrad, which a sample of 0.27 s makes some 5 mm/s.
        for (found, truth) in own.starts().expect("found").iter().zip(slides()) {
            let off = Vector3::from((*found - truth).to_array()).norm();
            assert!(off < 0.01, "{found:?} {truth:?}");
        }
        let misfit = |evidence: &Weighted| {
            let mechanics = Mechanics::new(&hypothesis, evidence);
            let instruments = Instruments::of(&hypothesis);
            evidence.loss(&evidence.residual(&mechanics.predict(&instruments, evidence)))
        };
        let [stationary, found] = [&seen, &own].map(misfit);
        assert!(found < 1e-3 * stationary, "{found} {stationary}");
    }

    /// Beginnings that were fitted beside a lag that does not exist suit the true hypothesis badly.
    #[test]
    fn a_hypothesis_begins_its_runs_as_suits_it() {
        let inertia = ["yaw-inertia:strength=1,gyration_m=0.3", "centripetal"];
        let hypothesis = on_ice(&inertia);
        let seen = Weighted::new(windows(&hypothesis, &slides()));
        let late = on_ice(&[&inertia[..], &["drivetrain-lag:time_constant_s=0.2"]].concat());
        let of_late = with_own_starts(&seen, &late).expect("it slides");
        let fixed = Fit::new(hypothesis, &[], &of_late, None);
        let own = fixed.with_own_starts(&of_late).expect("better");
        // what is left is the price of the slides themselves
        let price = penalty(&of_late, &own.hypothesis, &slides());
        let left = own.objective - price;
        assert!(left < 0.01 * fixed.objective, "{left} {price} {}", fixed.objective);
        // other samples begin as their evidence says
        let others = windows(&own.hypothesis, &slides());
        assert!(own.hypothesis.starts_in(&others).is_none());
    }

    #[test]
    fn a_robot_without_inertia_forgets_how_it_began() {
        let hypothesis = on_ice(&[]);
        let seen = Weighted::new(windows(&hypothesis, &slides()));
        assert!(with_own_starts(&seen, &hypothesis).is_none());
    }
}
