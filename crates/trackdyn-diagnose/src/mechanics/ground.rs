//! Ground that changes with place, heading or time.

use super::{TASK, single};
use crate::evidence::{Evidence, Sample};
use crate::surface::Surface;
use rayon::prelude::*;
use trackdyn_core::{PerSide, Pose, Side, Twist, Wrench};
use trackdyn_motion::{Stationary, Status};
use trackdyn_physics::effect::Role;
use trackdyn_physics::{ActiveEffect, Circumstance, Drive, Model, Motion, Vehicle};

/// Where the robot was during a sample.
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

/// Whether the forces hang on where the robot is, where it heads, or when.
pub fn varies(vehicle: &Vehicle, effect: &ActiveEffect, evidence: &Evidence) -> bool {
    const PROBES: usize = 200;
    if evidence.is_steady() {
        return false;
    }
    let model = single(vehicle, effect);
    let forces = |at: &Circumstance| probed(&model, at, PerSide::new(-0.2, 0.5));
    let samples = evidence.samples();
    // A place may be crossed between any two.
    let has_place = effect.card().parameters.iter().any(|p| matches!(p.role, Role::Place { .. }));
    let step = if has_place { 1 } else { (samples.len() / PROBES).max(1) };
    let mut probes = samples.iter().step_by(step);
    let Some(first) = probes.next().map(|sample| forces(&circumstance(sample))) else {
        return false;
    };
    probes.any(|sample| forces(&circumstance(sample)) != first)
}

/// Forces in a turn at these belt speeds: by the friction of each side, and all others.
fn probed(model: &Model, at: &Circumstance, speeds: PerSide<f64>) -> [Wrench; 3] {
    let gauge = model.vehicle().gauge;
    let motion = Motion::anchored(speeds, Side::Left, [-gauge, 0.1 * gauge], 0.5 / gauge);
    let balance = model.balance(&model.ground(at), &motion);
    [balance.friction.left, balance.friction.right, balance.load]
}

/// The stationary motion where each sample was, less the one without the effects that know places, headings or
/// times. `table` is nearly that one: where the search starts.
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
            let (speeds, at) = (drive.driven(sample.speeds), circumstance(sample));
            let nothing = Twist::zero();
            // beside a patch forces are those of level ground
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
