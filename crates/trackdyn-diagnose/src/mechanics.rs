//! What a hypothesis predicts of the evidence.
//!
//! The prediction starts each sample at its observed pose and moves the body with the recorded track speeds.
//!
//! # Law
//! The twist is that of the stationary motion, plus two departures that are small where they are at all:
//! - of ground that changes with place, heading or time: the stationary motion there less the one without,
//! - of inertia: the motion in time less the stationary one, over the sample.
//!
//! # Assumes
//! The departures are found without the laws that change the shear stress: these need a quadrature per
//! solve, and what they change in a departure is a product of two small things.

use crate::evidence::{Evidence, Sample};
use crate::hypothesis::Hypothesis;
use crate::surface::{Steady, Surface};
use nalgebra::Vector3;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;
use trackdyn_core::frames::{paper_twist_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Plant, Pose, Side, Trajectory, Twist};
use trackdyn_motion::{Stationary, Status, Transient};
use trackdyn_physics::contact::quadrature::Resolution;
use trackdyn_physics::effect::Stage;
use trackdyn_physics::{
    ActiveEffect, Circumstance, Drive, Effects, Model, Motion, Sensor, Vehicle,
};
use trackdyn_recording::TrackSample;
use trackdyn_recording::hold::{held, readings};

/// Speeds beyond the largest recorded one that a hypothesis may reach by its gains.
const HEADROOM: f64 = 1.1;

/// Longest step of the motion in time, s: readings come more often.
const STEP: f64 = 0.05;

/// Samples that one task predicts.
const TASK: usize = 64;

/// The expensive part of a prediction: all that does not hang on sensors, gains and lags of the drive, and
/// constant offsets of the ICRs.
#[derive(Clone)]
pub struct Mechanics {
    surface: Surface,
    /// The stationary motion at each reading, of belts that follow the encoders as `drive` says.
    steady: Arc<Vec<Vec<Steady>>>,
    drive: Drive,
    /// What changing ground adds to the twist during each sample, paper's frame.
    ground: Option<Arc<Vec<Twist>>>,
    /// What inertia adds.
    inertia: Option<Arc<Inertia>>,
    failed: Option<String>,
}

/// Encoders and pose sensor of a hypothesis, and the offset of its ICRs: the cheap part.
#[derive(Clone, Copy, Debug)]
pub struct Instruments {
    /// From the encoders to the belts.
    pub drive: Drive,
    /// What is reported of the motion.
    pub sensor: Sensor,
    /// What is added to the ICRs (x_l, x_r, y), m.
    pub offset: [f64; 3],
}

impl Instruments {
    /// Those of a hypothesis.
    pub fn of(hypothesis: &Hypothesis) -> Self {
        let model = Model::new(hypothesis.vehicle.clone(), hypothesis.effects.clone());
        Self { drive: *model.drive(), sensor: *model.sensor(), offset: hypothesis.offset }
    }
}

/// Whether an effect says something of sensors, gains and lags alone: no balance of forces knows it.
pub fn is_instrument(vehicle: &Vehicle, effect: &ActiveEffect) -> bool {
    let outside = |stage: &Stage| matches!(stage, Stage::Drive | Stage::Sense);
    effect.card().stages.iter().all(outside)
        && single(vehicle, effect).drive().slip_per_traction == 0.0
}

/// Whether an effect stands against acceleration.
pub fn feels_inertia(vehicle: &Vehicle, effect: &ActiveEffect) -> bool {
    Transient::feels_inertia(&single(vehicle, effect))
}

impl Mechanics {
    /// The mechanics of a hypothesis for this evidence.
    pub fn new(hypothesis: &Hypothesis, evidence: &Evidence) -> Self {
        Self::beside(None, hypothesis, evidence)
    }

    /// The same where `before` is the mechanics of a hypothesis that resembles it: with the same effects of
    /// inertia, what these add is taken from there, for its change is a product of two small things.
    pub fn beside(before: Option<&Self>, hypothesis: &Hypothesis, evidence: &Evidence) -> Self {
        let vehicle = &hypothesis.vehicle;
        let mechanical = hypothesis.effects.iter().filter(|effect| !is_instrument(vehicle, effect));
        let (varying, constant): (Vec<_>, Vec<_>) =
            mechanical.cloned().partition(|effect| varies(vehicle, effect, evidence));
        let without_shear = |effects: &[ActiveEffect]| -> Effects {
            let shears = |effect: &&ActiveEffect| effect.card().stages.contains(&Stage::Shear);
            effects.iter().filter(|effect| !shears(effect)).cloned().collect()
        };
        let drive = Instruments::of(hypothesis).drive;
        let largest = HEADROOM * evidence.fastest() * std::f64::consts::SQRT_2;
        let model = Model::new(vehicle.clone(), constant.iter().cloned().collect())
            .with_resolution(Resolution::Coarse);
        let surface = Surface::new(&model, largest, before.map(|before| &before.surface));
        let steady = Arc::new(steady(&surface, &drive, evidence.tracks()));
        let mut mechanics =
            Self { surface, steady, drive, ground: None, inertia: None, failed: None };
        let simple = Model::new(vehicle.clone(), without_shear(&constant));
        if !varying.is_empty() {
            let mut effects = without_shear(&constant);
            for effect in varying {
                effects.insert(effect);
            }
            let model = Model::new(vehicle.clone(), effects);
            mechanics.ground = Some(Arc::new(by_ground(&model, &simple, &drive, evidence)));
        }
        let inert = simple.effects().iter().filter(|effect| feels_inertia(vehicle, effect));
        let inert: Vec<ActiveEffect> = inert.cloned().collect();
        if inert.is_empty() || evidence.is_steady() {
            return mechanics;
        }
        let known = before.and_then(|before| before.inertia.clone());
        if let Some(known) = known.filter(|known| known.effects == inert) {
            mechanics.inertia = Some(known);
            return mechanics;
        }
        match Inertia::new(inert, &simple, largest, &drive, evidence) {
            Ok(inertia) => mechanics.inertia = Some(Arc::new(inertia)),
            Err(reason) => mechanics.failed = Some(reason),
        }
        mechanics
    }

    /// Why the hypothesis cannot be: part of the contact lifts, or no motion balances the forces, over a
    /// good part of the speeds. None where it can.
    pub fn failure(&self) -> Option<String> {
        const MOST: f64 = 0.2;
        if let Some(reason) = &self.failed {
            return Some(reason.clone());
        }
        let share = self.surface.unsolved();
        (share > MOST).then(|| {
            format!(
                "at {:.0} % of the speeds part of the contact lifts or no forces balance",
                100.0 * share
            )
        })
    }

    /// Whether the forces hang on where the robot is, where it heads, or when.
    pub fn knows_places(&self) -> bool {
        self.ground.is_some()
    }

    /// The motion of every sample, as the pose sensor reports it: forward (m), left (m), yaw (rad).
    pub fn predict(&self, instruments: &Instruments, evidence: &Evidence) -> Vec<Vector3<f64>> {
        let Instruments { drive, sensor, offset } = instruments;
        let steady = if *drive == self.drive {
            Cow::Borrowed(&*self.steady)
        } else {
            Cow::Owned(steady(&self.surface, drive, evidence.tracks()))
        };
        let samples = evidence.samples();
        (0..samples.len())
            .into_par_iter()
            .with_min_len(TASK)
            .map(|index| {
                let sample = &samples[index];
                let by_ground = self.ground.as_ref().map(|departures| departures[index]);
                let by_inertia =
                    self.inertia.as_ref().map(|inertia| inertia.departure(sample, sensor.delay));
                let departure =
                    [by_ground, by_inertia].into_iter().flatten().reduce(|a, b| plus(&a, &b));
                let departure = departure.map(|departure| seen_from(&departure, offset));
                let tracks = &evidence.tracks()[sample.run];
                let steady = &steady[sample.run];
                let pose = moved(tracks, sample, sensor.delay, |reading| {
                    let mut twist = steady[reading].twist(offset);
                    if let Some(departure) = &departure {
                        twist = plus(&twist, departure);
                    }
                    ros_twist_from_paper(&sensor.reported(&twist))
                });
                Vector3::new(pose.x, pose.y, pose.yaw)
            })
            .collect()
    }
}

/// The stationary motion at each reading of each run.
fn steady(surface: &Surface, drive: &Drive, tracks: &[Vec<TrackSample>]) -> Vec<Vec<Steady>> {
    let belts = lagging(tracks, drive.time_constant);
    let motion = |reading: &TrackSample| {
        surface.motion(drive.driven(PerSide::new(reading.v_left, reading.v_right)))
    };
    belts.par_iter().map(|run| run.iter().map(motion).collect()).collect()
}

/// The motion over a sample, seen from its start, with the twist (REP-103) at each reading that it holds.
fn moved(
    tracks: &[TrackSample],
    sample: &Sample,
    delay: f64,
    twist: impl Fn(usize) -> Twist,
) -> Pose {
    let until = sample.start + sample.duration;
    let readings = readings(tracks, sample.start, until, delay);
    let pieces = held(tracks, sample.start, until, delay);
    readings.zip(pieces).fold(Pose::default(), |pose, (reading, piece)| {
        pose.compose(&Pose::exp(&twist(reading), piece.duration))
    })
}

fn single(vehicle: &Vehicle, effect: &ActiveEffect) -> Model {
    Model::new(vehicle.clone(), std::iter::once(effect.clone()).collect())
}

fn plus(a: &Twist, b: &Twist) -> Twist {
    Twist { v_x: a.v_x + b.v_x, v_y: a.v_y + b.v_y, w: a.w + b.w }
}

fn minus(a: &Twist, b: &Twist) -> Twist {
    Twist { v_x: a.v_x - b.v_x, v_y: a.v_y - b.v_y, w: a.w - b.w }
}

/// What a change of the twist is at the point from which the ICRs have this offset: δv = ω × r, with y for all of
/// them and the mean of the x as r. The rest of the offset is no matter of where one looks from.
fn seen_from(twist: &Twist, [left, right, y]: &[f64; 3]) -> Twist {
    let middle = f64::midpoint(*left, *right);
    Twist { v_x: twist.v_x + y * twist.w, v_y: twist.v_y - middle * twist.w, w: twist.w }
}

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
fn varies(vehicle: &Vehicle, effect: &ActiveEffect, evidence: &Evidence) -> bool {
    const PROBES: usize = 200;
    if evidence.is_steady() {
        return false;
    }
    let model = single(vehicle, effect).with_resolution(Resolution::Coarse);
    let speeds = PerSide::new(-0.2, 0.5);
    let forces = |at: &Circumstance| {
        let motion = Motion::anchored(
            speeds,
            Side::Left,
            [-vehicle.gauge, 0.1 * vehicle.gauge],
            0.5 / vehicle.gauge,
        );
        let balance = model.balance(&model.ground(at), &motion);
        (balance.friction.left, balance.friction.right, balance.load)
    };
    let samples = evidence.samples();
    let mut probes = samples.iter().step_by((samples.len() / PROBES).max(1));
    let Some(first) = probes.next().map(|sample| forces(&circumstance(sample))) else {
        return false;
    };
    probes.any(|sample| forces(&circumstance(sample)) != first)
}

/// The stationary motion where each sample was, less the one without the effects that know places,
/// headings or times.
fn by_ground(with: &Model, without: &Model, drive: &Drive, evidence: &Evidence) -> Vec<Twist> {
    let solver = Stationary::new(without, &Circumstance::default());
    let samples = evidence.samples().par_iter().with_min_len(TASK);
    samples
        .map(|sample| {
            let speeds = drive.driven(sample.speeds);
            let here = Stationary::new(with, &circumstance(sample)).solve(speeds);
            let there = solver.solve(speeds);
            let usable = |status: Status| !matches!(status, Status::NotConverged);
            if usable(here.status) && usable(there.status) {
                minus(&here.twist, &there.twist)
            } else {
                Twist { v_x: 0.0, v_y: 0.0, w: 0.0 }
            }
        })
        .collect()
}

/// What inertia adds to the stationary motion.
struct Inertia {
    /// The effects that it comes from.
    effects: Vec<ActiveEffect>,
    /// Motion in time of each run, by the clock of the encoders.
    paths: Vec<Trajectory>,
    /// Speeds of the belts behind it, m/s.
    belts: Vec<Vec<TrackSample>>,
    /// The stationary twists there without it.
    steady: Vec<Vec<Twist>>,
}

impl Inertia {
    fn new(
        effects: Vec<ActiveEffect>,
        model: &Model,
        largest: f64,
        drive: &Drive,
        evidence: &Evidence,
    ) -> Result<Self, String> {
        let surface = Surface::new(model, largest, None);
        let gained = |reading: &TrackSample| {
            let speeds = drive.driven(PerSide::new(reading.v_left, reading.v_right));
            TrackSample { t: reading.t, v_left: speeds.left, v_right: speeds.right }
        };
        let belts: Vec<Vec<TrackSample>> = lagging(evidence.tracks(), drive.time_constant)
            .iter()
            .map(|run| smooth(run).iter().map(gained).collect())
            .collect();
        let paths: Result<Vec<Trajectory>, String> =
            belts.par_iter().map(|run| path_in_time(model, &surface, run)).collect();
        let speeds = |reading: &TrackSample| PerSide::new(reading.v_left, reading.v_right);
        let twist = |reading: &TrackSample| surface.motion(speeds(reading)).twist(&[0.0; 3]);
        let steady = belts.iter().map(|run| run.iter().map(twist).collect()).collect();
        Ok(Self { effects, paths: paths?, belts, steady })
    }

    /// The motion in time less the stationary motion, as a twist over a sample.
    fn departure(&self, sample: &Sample, delay: f64) -> Twist {
        let (from, until) = (sample.start, sample.start + sample.duration);
        let path = &self.paths[sample.run];
        let moved = path.pose_at(from - delay).relative(&path.pose_at(until - delay));
        let steady = &self.steady[sample.run];
        let steady = self::moved(&self.belts[sample.run], sample, delay, |reading| {
            ros_twist_from_paper(&steady[reading])
        });
        let twist = |pose: &Pose| paper_twist_from_ros(&pose.log(sample.duration));
        minus(&twist(&moved), &twist(&steady))
    }
}

/// The motion in time over a run.
fn path_in_time(
    model: &Model,
    surface: &Surface,
    belts: &[TrackSample],
) -> Result<Trajectory, String> {
    let mut path = Trajectory::default();
    let Some(first) = belts.first() else { return Ok(path) };
    let speeds = |sample: &TrackSample| PerSide::new(sample.v_left, sample.v_right);
    let start = surface.motion(speeds(first)).twist(&[0.0; 3]);
    let mut robot =
        Transient::at_rest(model, first.t, Pose::default()).with_step(STEP).with_twist(start);
    path.push(robot.moment());
    for pair in belts.windows(2) {
        robot
            .drive(speeds(&pair[0]), pair[1].t, &mut path)
            .map_err(|stopped| stopped.to_string())?;
    }
    Ok(path)
}

/// Readings without the steps between them: v'_k = (v_{k−1} + 2 v_k + v_{k+1})/4.
///
/// A counter's ticks make the speeds jump to and fro, by more than a robot's speed changes between two readings.
/// Stationary motion averages that out; a body with mass under dry friction, shaken so, would slide more easily
/// than it does.
fn smooth(run: &[TrackSample]) -> Vec<TrackSample> {
    (0..run.len())
        .map(|k| {
            let [before, here, after] =
                [run[k.saturating_sub(1)], run[k], run[(k + 1).min(run.len() - 1)]];
            let mean = |v: fn(&TrackSample) -> f64| (v(&before) + 2.0 * v(&here) + v(&after)) / 4.0;
            TrackSample { t: here.t, v_left: mean(|s| s.v_left), v_right: mean(|s| s.v_right) }
        })
        .collect()
}

/// Readings of belts that follow with a lag, each with its mean over the time that it holds.
fn lagging(tracks: &[Vec<TrackSample>], time_constant: f64) -> Cow<'_, [Vec<TrackSample>]> {
    if time_constant <= 0.0 {
        return Cow::Borrowed(tracks);
    }
    tracks.iter().map(|run| lagging_run(run, time_constant)).collect()
}

fn lagging_run(tracks: &[TrackSample], time_constant: f64) -> Vec<TrackSample> {
    let Some(first) = tracks.first() else { return Vec::new() };
    let mut belts = [first.v_left, first.v_right];
    let mut filtered = Vec::with_capacity(tracks.len());
    for (index, reading) in tracks.iter().enumerate() {
        let next = tracks.get(index + 1).map_or(reading.t, |next| next.t);
        let steps = (next - reading.t) / time_constant;
        let remaining = (-steps).exp();
        // V(t) = V_e + (V_0 − V_e) e^(−t/T); its mean over the time that V_e holds
        let share = if steps > 1e-9 { (1.0 - remaining) / steps } else { 1.0 };
        let shown = [reading.v_left, reading.v_right];
        let mean: [f64; 2] = std::array::from_fn(|k| shown[k] + (belts[k] - shown[k]) * share);
        belts = std::array::from_fn(|k| shown[k] + (belts[k] - shown[k]) * remaining);
        filtered.push(TrackSample { t: reading.t, v_left: mean[0], v_right: mean[1] });
    }
    filtered
}
