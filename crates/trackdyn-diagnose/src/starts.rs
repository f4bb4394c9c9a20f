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
//! samples and ρ is Huber's loss. What is then left unknown of a is noise that the samples of the
//! run share ([`Weighted::with_starts`]). It is the same for all hypotheses: each forgoes what the
//! beginnings may explain.

use crate::equations::Column;
use crate::hypothesis::Hypothesis;
use crate::mechanics::{Instruments, Mechanics};
use crate::weighted::Weighted;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;
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
    /// The start that is tried.
    tried: Vector3<f64>,
}

impl Start {
    /// Takes or rejects the start that was tried, by the whitened residual there and its
    /// derivatives.
    fn judged(&mut self, evidence: &Weighted, residual: &[Vector3<f64>], columns: &[Column; 3]) {
        let residual = &residual[self.samples.clone()];
        let objective = evidence.loss(residual) + self.tried.norm_squared();
        if objective >= self.objective || !objective.is_finite() {
            self.step /= 2.0;
            self.promise /= 2.0;
            self.tried = self.best + self.step;
            return;
        }
        let columns = columns.each_ref().map(|column| &column[self.samples.clone()]);
        let weights = evidence.weights(residual);
        let product = |x: &[Vector3<f64>], y: &[Vector3<f64>]| -> f64 {
            x.iter().zip(y).zip(&weights).map(|((x, y), weight)| x.dot(y) * weight).sum()
        };
        // (bᵀ W b + 1) δ = bᵀ W z − a
        let normal = Matrix3::from_fn(|i, k| product(columns[i], columns[k])) + Matrix3::identity();
        let right = Vector3::from_fn(|i, _| product(columns[i], residual)) - self.tried;
        let step = normal.cholesky().map_or(Vector3::zeros(), |factor| factor.solve(&right));
        (self.best, self.objective, self.step) = (self.tried, objective, step);
        self.promise = step.dot(&right);
        self.tried = self.best + step;
    }
}

/// The evidence in which each run begins with the motion that a hypothesis finds for it; none where
/// its motion does not depend on how it began.
pub fn with_own_starts(evidence: &Weighted, hypothesis: &Hypothesis) -> Option<Weighted> {
    let settings = &evidence.settings().evidence;
    let known = settings.start_deviation * evidence.fastest();
    // across, along and yaw, in the paper's frame
    let deviations = Vector3::new(known, known, 2.0 * known / hypothesis.vehicle.gauge);
    let instruments = Instruments::of(hypothesis);
    let mut begin = 0;
    let runs = evidence.samples().chunk_by(|a, b| a.run == b.run).map(|of_run| {
        let samples = begin..begin + of_run.len();
        begin = samples.end;
        let none = Vector3::zeros();
        let run = of_run[0].run;
        let [objective, promise] = [f64::INFINITY; 2];
        Start { samples, run, best: none, objective, step: none, promise, tried: none }
    });
    let mut runs: Vec<Start> = runs.collect();
    let count = evidence.tracks().len();
    let twists = |of: &dyn Fn(&Start) -> Vector3<f64>, runs: &[Start]| -> Vec<Twist> {
        let mut twists = vec![Twist::zero(); count];
        for start in runs {
            let twist = of(start).component_mul(&deviations);
            twists[start.run] = Twist::from_array(twist.into());
        }
        twists
    };
    let at = |starts: Vec<Twist>, before: Option<&Mechanics>| {
        let seen = evidence.with_readings(|evidence| evidence.with_starts(starts));
        let mechanics = Mechanics::beside(before, hypothesis, &[], &seen);
        let mut columns = mechanics.by_starts(&instruments, &seen)?;
        for (column, deviation) in columns.iter_mut().zip(deviations.iter()) {
            for value in column.iter_mut() {
                *value *= *deviation;
            }
        }
        Some((seen, mechanics, columns))
    };
    let least = evidence.settings().fit.min_fall;
    let mut before: Option<Mechanics> = None;
    for _ in 0..settings.start_rounds {
        let (seen, mechanics, columns) = at(twists(&|run| run.tried, &runs), before.as_ref())?;
        let residual = seen.residual(&mechanics.predict(&instruments, &seen));
        let white = columns.map(|column| seen.white(column));
        for run in &mut runs {
            run.judged(evidence, &residual, &white);
        }
        before = Some(mechanics);
        if runs.iter().all(|run| run.promise < least) {
            break;
        }
    }
    let starts = twists(&|run| run.best, &runs);
    let (_, _, columns) = at(starts.clone(), before.as_ref())?;
    Some(evidence.with_starts(starts, columns))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::Evidence;
    use crate::evidence::planned::{PlannedRun, READINGS};
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

    #[test]
    fn a_robot_without_inertia_forgets_how_it_began() {
        let hypothesis = on_ice(&[]);
        let seen = Weighted::new(windows(&hypothesis, &slides()));
        assert!(with_own_starts(&seen, &hypothesis).is_none());
    }
}
