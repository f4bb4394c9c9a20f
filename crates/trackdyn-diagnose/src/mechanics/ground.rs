//! Departure by ground that changes with place, heading or time.

use super::{SAMPLES_PER_TASK, coarse, single};
use crate::evidence::{Evidence, Origin, Sample};
use crate::surface::Surface;
use rayon::prelude::*;
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose, Side, Twist, Wrench, real};
use trackdyn_model::effect::{Role, Stage};
use trackdyn_model::stationary::Near;
use trackdyn_model::{ActiveEffect, Circumstance, Drive, Effects, Ground, Model, Motion, Vehicle};
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
    let level = Circumstance::default();
    let model = single(vehicle, effect);
    let samples = evidence.samples();
    // A place may be crossed, and a time may lie, between any two samples.
    let is_somewhere = |role: Role| matches!(role, Role::Place { .. } | Role::Time);
    let is_local = effect.card().parameters.iter().any(|one| is_somewhere(one.role));
    let step = if is_local { 1 } else { (samples.len() / probes).max(1) };
    let is_as_on_level = |other: &Model, at: &Circumstance| {
        act_alike([&model, other], [&level, at], is_of_ground(effect), PROBE_SPEEDS)
    };
    let differs = |sample: &Sample| !is_as_on_level(&model, &circumstance(sample));
    if samples.iter().step_by(step).any(differs) {
        return Acts::Varying;
    }
    let is_absent = || is_as_on_level(&coarse(vehicle, Effects::none()), &level);
    if is_local && is_absent() { Acts::Nowhere } else { Acts::Alike }
}

/// Belt speeds of the turn in which forces are probed, m/s.
const PROBE_SPEEDS: PerSide<f64> = PerSide::new(-0.2, 0.5);

/// Whether an effect acts by the ground alone: where that is alike, so are all forces.
fn is_of_ground(effect: &ActiveEffect) -> bool {
    effect.card().stages.iter().all(|stage| *stage == Stage::Ground)
}

/// Whether two models act alike on the robot, each at its place, heading and time: by their ground
/// where it tells all, else by the forces in a turn at these belt speeds.
fn act_alike(
    models: [&Model; 2],
    at: [&Circumstance; 2],
    by_ground: bool,
    speeds: PerSide<f64>,
) -> bool {
    let [here, there] = [0, 1].map(|k| models[k].ground(at[k]));
    if by_ground {
        Ground { circumstance: here.circumstance, ..there } == here
    } else {
        probed(models[0], &here, speeds) == probed(models[1], &there, speeds)
    }
}

/// Forces in a turn at these belt speeds: friction of each side, and all others.
fn probed(model: &Model, ground: &Ground, speeds: PerSide<f64>) -> [Wrench; 3] {
    let gauge = model.vehicle().gauge;
    let motion = Motion::anchored(speeds, Side::Left, [-gauge, 0.1 * gauge], 0.5 / gauge);
    let balance = model.balance(ground, &motion);
    [balance.friction.left, balance.friction.right, balance.load]
}

/// Departure by ground that changes, and the motions from which those of similar models start.
pub struct ByGround {
    /// Stationary motion at the place of each sample, minus that without the effects of place,
    /// heading or time.
    pub departures: Vec<Twist>,
    starts: Arc<Vec<Starts>>,
}

/// Known motions of a sample: at its place, and without what changes with the place.
type Starts = [Option<Near>; 2];

/// Largest share of far solves among the samples that depart. Above it, the motions of all samples
/// are kept as new starts.
const MAX_FAR_SHARE: f64 = 0.1;

/// Most steps of a solve that starts near its motion. One that takes more is a far solve.
const MAX_NEAR_STEPS: usize = 3;

/// A sample at which the ground changes the motion.
struct Changed {
    departure: Twist,
    starts: Starts,
    was_far: bool,
}

impl ByGround {
    /// The departure of a model `with` effects that vary by place, heading or time from that
    /// `without`. `table` approximates the latter. Solves start from the motions of `before`, the
    /// departure of a similar model, or from the table.
    pub fn new(
        [with, without]: [&Model; 2],
        table: &Surface,
        drive: &Drive,
        evidence: &Evidence,
        before: Option<&Self>,
    ) -> Self {
        let level = Circumstance::default();
        let by_ground = with.effects().iter().all(|effect| {
            is_of_ground(effect) || without.effects().iter().any(|constant| constant == effect)
        });
        let on_level = Stationary::new(without, &level);
        let samples = evidence.samples();
        let before = before.map(|before| &before.starts).filter(|of| of.len() == samples.len());
        let known = |index: usize| before.map_or([None; 2], |before| before[index]);
        let changed = |(index, sample): (usize, &Sample)| -> Option<Changed> {
            let (speeds, at) = (drive.driven(sample.speeds, sample.start), circumstance(sample));
            // outside a patch
            if act_alike([without, with], [&level, &at], by_ground, speeds) {
                return None;
            }
            let known = known(index);
            let tabulated = || table.motion(speeds).near();
            let there = on_level.starting_at(known[1].or_else(tabulated)).solve(speeds);
            let near = known[0].or_else(|| there.near()).or_else(tabulated);
            let here = Stationary::from_start(with, &at, near).solve(speeds);
            let solved = [here, there];
            let usable = solved.iter().all(|one| one.status != Status::NotConverged);
            Some(Changed {
                departure: if usable { here.twist - there.twist } else { Twist::zero() },
                starts: solved.map(|one| one.linearised.map(Near::Linearised)),
                was_far: known == [None; 2]
                    || solved.iter().any(|one| one.iterations > MAX_NEAR_STEPS),
            })
        };
        let changes: Vec<Option<Changed>> =
            samples.par_iter().enumerate().with_min_len(SAMPLES_PER_TASK).map(changed).collect();
        let departure = |change: &Option<Changed>| {
            change.as_ref().map_or(Twist::zero(), |change| change.departure)
        };
        let departures = changes.iter().map(departure).collect();
        let far = changes.iter().flatten().filter(|change| change.was_far).count();
        let all = changes.iter().flatten().count();
        let starts = match before {
            Some(before) if real(far) <= MAX_FAR_SHARE * real(all) => Arc::clone(before),
            _ => {
                let starts = changes.iter().enumerate().map(|(index, change)| {
                    change.as_ref().map_or_else(|| known(index), |change| change.starts)
                });
                Arc::new(starts.collect())
            }
        };
        Self { departures, starts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::planned::{PlannedRun, READINGS};
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

    /// One run from a pose by these readings, which moves as filed.
    fn driven(
        filed: &Hypothesis,
        pose: Pose,
        readings: impl IntoIterator<Item = TrackSample>,
    ) -> Evidence {
        let tracks = readings.into_iter().collect();
        let run = [PlannedRun { tracks, pose, blocks: vec![0] }];
        let noise = SegmentNoise { pose: [1e-6; 3], walk: [1e-6; 3], heading: 0.0, stamp: 0.0 };
        Evidence::planned(&run, noise, 0.0, &Settings::default(), |evidence| moves(filed, evidence))
    }

    /// A robot that turns thirty metres from the origin of its poses.
    #[test]
    fn ground_where_the_robot_never_is_changes_nothing_wherever_poses_are_counted_from() {
        let file = VehicleFile::auriga_alpha();
        let filed = Hypothesis::filed(&file, &Settings::default().prior);
        let reading = |k| TrackSample { t: 0.03 * real(k), v_left: -0.2, v_right: 0.5 };
        let evidence = driven(&filed, Pose::new(30.0, 0.0, 0.0), (0..91).map(reading));
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

    /// Solves that start from the motions of a similar model find those of solves from the table.
    #[test]
    fn a_departure_does_not_depend_on_where_its_solves_start() {
        let file = VehicleFile::auriga_alpha();
        let filed = Hypothesis::filed(&file, &Settings::default().prior);
        let reading = |k: usize| {
            let [left, right] = [0.1 * real(k % 17), 0.07 * real(k % 23)];
            TrackSample { t: 0.03 * real(k), v_left: 0.6 - left, v_right: 0.7 - right }
        };
        let readings = (0..=40 * READINGS).map(reading);
        let evidence = driven(&filed, Pose::new(0.1, 0.0, 0.3), readings);
        let with = |effect: &str| {
            let effect: ActiveEffect = effect.parse().expect("an effect");
            filed.with_effect(effect)
        };
        for (here, there) in [
            (
                "terrain-patch:x_m=0,y_m=0,radius_m=1,ratio=1.3",
                "terrain-patch:x_m=0.2,y_m=0,radius_m=1.2,ratio=1.8",
            ),
            (
                "ground-change:across_factor=1.2,from_s=1,until_s=8",
                "ground-change:across_factor=0.7,from_s=0.5,until_s=9",
            ),
            ("slope:angle_deg=4", "slope:angle_deg=9,uphill_deg=80"),
            ("friction-drift:rate_1_per_s=0.01", "friction-drift:rate_1_per_s=-0.01"),
        ] {
            let [here, there] = [here, there].map(with);
            let before = Mechanics::new(&here, &evidence);
            let departures = |mechanics: &Mechanics| {
                mechanics.ground.as_ref().expect("it varies").departures.clone()
            };
            let from_table = departures(&Mechanics::new(&there, &evidence));
            let from_known = departures(&Mechanics::beside(Some(&before), &there, &evidence));
            for (a, b) in from_table.iter().zip(&from_known) {
                let off = *a - *b;
                // solves are exact to 1e-8 of the weight
                assert!(off.v_x.abs().max(off.v_y.abs()).max(off.w.abs()) < 1e-7, "{a:?} {b:?}");
            }
            assert!(from_table.iter().any(|departure| *departure != Twist::zero()));
        }
    }
}
