//! Departure by ground that changes with place, heading or time.

use super::{TASK, coarse, single};
use crate::evidence::{Evidence, Origin, Sample};
use crate::surface::Surface;
use rayon::prelude::*;
use trackdyn_core::{PerSide, Pose, Side, Twist, Wrench};
use trackdyn_model::effect::Role;
use trackdyn_model::{ActiveEffect, Circumstance, Drive, Effects, Model, Motion, Vehicle};
use trackdyn_model::{Stationary, Status};

/// Place, heading and time of the robot at the middle of a sample.
fn circumstance(sample: &Sample) -> Circumstance {
    let half =
        Pose::exp(&Pose::new(sample.motion[0], sample.motion[1], sample.motion[2]).log(1.0), 0.5);
    let middle = sample.pose.compose(&half);
    Circumstance {
        position: [middle.x, middle.y],
        heading: middle.yaw,
        time: sample.start + sample.duration / 2.0,
    }
}

/// How an effect acts over the poses and times of the evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// Nowhere: its place was never visited.
    Nowhere,
    /// Equally everywhere.
    Alike,
    /// Its forces depend on place, heading or time.
    Varying,
}

/// How an effect acts over the poses and times of this evidence.
pub fn acts(vehicle: &Vehicle, effect: &ActiveEffect, evidence: &Evidence) -> Acts {
    let probes = evidence.settings().mechanics.probes;
    if matches!(evidence.origin(), Origin::SteadyPoints(_)) {
        return Acts::Alike;
    }
    let forces = |model: &Model, at: &Circumstance| probed(model, at, PerSide::new(-0.2, 0.5));
    let level = Circumstance::default();
    let model = single(vehicle, effect);
    let samples = evidence.samples();
    // A place may be crossed, and a time may lie, between any two samples.
    let is_somewhere = |role: Role| matches!(role, Role::Place { .. } | Role::Time);
    let is_local = effect.card().parameters.iter().any(|one| is_somewhere(one.role));
    let step = if is_local { 1 } else { (samples.len() / probes).max(1) };
    let there = forces(&model, &level);
    if samples.iter().step_by(step).any(|sample| forces(&model, &circumstance(sample)) != there) {
        return Acts::Varying;
    }
    let is_absent = || there == forces(&coarse(vehicle, Effects::none()), &level);
    if is_local && is_absent() { Acts::Nowhere } else { Acts::Alike }
}

/// Forces in a turn at these belt speeds: friction of each side, and all others.
fn probed(model: &Model, at: &Circumstance, speeds: PerSide<f64>) -> [Wrench; 3] {
    let gauge = model.vehicle().gauge;
    let motion = Motion::anchored(speeds, Side::Left, [-gauge, 0.1 * gauge], 0.5 / gauge);
    let balance = model.balance(&model.ground(at), &motion);
    [balance.friction.left, balance.friction.right, balance.load]
}

/// Stationary motion at the place of each sample, minus that without the effects of place, heading
/// or time. `table` approximates the latter and starts the solves.
pub fn by_ground(
    with: &Model,
    without: &Model,
    table: &Surface,
    drive: &Drive,
    evidence: &Evidence,
) -> Vec<Twist> {
    let level = Stationary::new(without, &Circumstance::default());
    let samples = evidence.samples().par_iter().with_min_len(TASK);
    samples
        .map(|sample| {
            let (speeds, at) = (drive.driven(sample.speeds, sample.start), circumstance(sample));
            let nothing = Twist::zero();
            // outside a patch forces equal those of level ground
            if probed(with, &at, speeds) == probed(without, &Circumstance::default(), speeds) {
                return nothing;
            }
            let near = table.motion(speeds).near();
            let there = level.starting_at(near).solve(speeds);
            let near = there.near().or(near);
            let here = Stationary::from_start(with, &at, near).solve(speeds);
            let usable = |status: Status| status != Status::NotConverged;
            if usable(here.status) && usable(there.status) {
                here.twist - there.twist
            } else {
                nothing
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::planned::PlannedRun;
    use crate::hypothesis::Hypothesis;
    use crate::mechanics::{Instruments, Mechanics};
    use crate::settings::Settings;
    use nalgebra::Vector3;
    use trackdyn_core::real;
    use trackdyn_estimate::weighting::SegmentNoise;
    use trackdyn_model::VehicleFile;
    use trackdyn_recording::TrackSample;

    fn moves(hypothesis: &Hypothesis, evidence: &Evidence) -> Vec<Vector3<f64>> {
        Mechanics::new(hypothesis, evidence).predict(&Instruments::of(hypothesis), evidence)
    }

    /// A robot that turns thirty metres from the origin of its poses.
    #[test]
    fn ground_where_the_robot_never_is_changes_nothing_wherever_poses_are_counted_from() {
        let (file, settings) = (VehicleFile::auriga_alpha(), Settings::default());
        let filed = Hypothesis::filed(&file, &settings.prior);
        let reading = |k| TrackSample { t: 0.03 * real(k), v_left: -0.2, v_right: 0.5 };
        let run = PlannedRun {
            tracks: (0..91).map(reading).collect(),
            pose: Pose::new(30.0, 0.0, 0.0),
            blocks: vec![0],
        };
        let noise = SegmentNoise { pose: [1e-6; 3], walk: [1e-6; 3], heading: 0.0, stamp: 0.0 };
        let run = [run];
        let evidence =
            Evidence::planned(&run, noise, 0.0, &settings, |evidence| moves(&filed, evidence));
        for (x, acts_there) in [(0.0, Acts::Varying), (-50.0, Acts::Nowhere), (30.0, Acts::Varying)]
        {
            let patch: ActiveEffect =
                format!("terrain-patch:x_m={x},radius_m=5").parse().expect("an effect");
            assert_eq!(acts(&file.vehicle, &patch, &evidence), acts_there, "{x}");
            let mut with = filed.clone();
            with.effects.insert(patch);
            let is_changed = moves(&with, &evidence) != moves(&filed, &evidence);
            assert_eq!(is_changed, x == 30.0, "{x}");
        }
        let resistance: ActiveEffect = "motion-resistance".parse().expect("an effect");
        assert_eq!(acts(&file.vehicle, &resistance, &evidence), Acts::Alike);
    }
}
