//! What inertia adds to the stationary motion, found once near a hypothesis.
//!
//! # Law
//! The motion in time less the stationary motion, over each sample. What it changes by beside another hypothesis is that
//! of the linear answer ([`super::lag`]), of which only what is of second order in the acceleration is not known there.

use super::belts::{lagging, smooth};
use super::lag::linear_answer;
use super::{minus, motion_over};
use crate::evidence::{Evidence, Sample};
use crate::hypothesis::{typical_size, value};
use crate::surface::Surface;
use rayon::prelude::*;
use trackdyn_core::frames::{paper_twist_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Plant, Pose, Trajectory, Twist};
use trackdyn_motion::Transient;
use trackdyn_physics::effect::Parameter;
use trackdyn_physics::{ActiveEffect, CATALOGUE, Drive, Effects, Model, Vehicle};
use trackdyn_recording::TrackSample;

/// Longest step of the motion in time, s: readings come more often.
const STEP: f64 = 0.05;

/// Part of its typical size by which a parameter of an effect that it comes from may differ from where it was found,
/// and the difference of the logarithm of friction.
const REACH: f64 = 0.3;

/// The same for other effects.
const ALIKE: f64 = 1.0;

/// Part of the gauge, and of the friction ratio, by which the vehicle may differ.
const CLOSE: f64 = 0.05;

/// What the motion in time is found for.
pub struct Case<'a> {
    /// The robot, inertia among its effects.
    pub model: &'a Model,
    /// Largest speed of a belt, m/s.
    pub largest: f64,
    pub drive: &'a Drive,
    pub evidence: &'a Evidence,
}

/// Whether effects are the same, with values that differ by no more than this part of their typical sizes.
fn are_near(known: &[ActiveEffect], effects: &[ActiveEffect], reach: f64) -> bool {
    let near = |a: &ActiveEffect, b: &ActiveEffect| {
        let values = a.values().iter().zip(b.values()).zip(a.card().parameters);
        let mut values =
            values.map(|((a, b), parameter)| (a - b).abs() <= reach * typical_size(parameter));
        a.card().id == b.card().id && values.all(|near| near)
    };
    known.len() == effects.len() && known.iter().zip(effects).all(|(a, b)| near(a, b))
}

/// Geometric mean of the friction coefficients.
fn level(vehicle: &Vehicle) -> f64 {
    (vehicle.friction.across * vehicle.friction.along).sqrt()
}

/// What inertia adds to the stationary motion.
pub struct Inertia {
    /// The effects that it comes from.
    inert: Vec<ActiveEffect>,
    /// The robot.
    vehicle: Vehicle,
    effects: Effects,
    /// Motion in time of each run, by the clock of the encoders; none where a run stops, for ticks of a counter tip
    /// a robot over that stood firmly. Then the linear answer is all.
    paths: Option<Vec<Trajectory>>,
    /// Speeds of the belts behind it, m/s.
    belts: Vec<Vec<TrackSample>>,
    /// The stationary twists there without it.
    steady: Vec<Vec<Twist>>,
    /// The part of the linear answer that it holds, at each reading.
    pub linear: Vec<Vec<Twist>>,
}

impl Inertia {
    /// What these effects add.
    pub fn new(inert: Vec<ActiveEffect>, case: &Case) -> Self {
        let Case { model, largest, drive, evidence, .. } = *case;
        let surface = Surface::new(model, largest, None);
        let gained = |reading: &TrackSample| {
            let speeds = drive.driven(PerSide::new(reading.v_left, reading.v_right));
            TrackSample { t: reading.t, v_left: speeds.left, v_right: speeds.right }
        };
        let belts: Vec<Vec<TrackSample>> = lagging(evidence.tracks(), drive.time_constant)
            .iter()
            .map(|run| smooth(run).iter().map(gained).collect())
            .collect();
        let paths: Option<Vec<Trajectory>> =
            belts.par_iter().map(|run| path_in_time(model, &surface, run)).collect();
        let speeds = |reading: &TrackSample| PerSide::new(reading.v_left, reading.v_right);
        let twist = |reading: &TrackSample| surface.motion(speeds(reading)).twist(&[0.0; 3]);
        let steady = belts.iter().map(|run| run.iter().map(twist).collect()).collect();
        let linear = if paths.is_some() {
            linear_answer(&surface, model, drive, evidence.tracks())
        } else {
            belts.iter().map(|run| vec![Twist { v_x: 0.0, v_y: 0.0, w: 0.0 }; run.len()]).collect()
        };
        let (vehicle, effects) = (model.vehicle().clone(), model.effects().clone());
        Self { inert, vehicle, effects, paths, belts, steady, linear }
    }

    /// Whether it comes from effects of the same kinds.
    pub fn is_of(&self, inert: &[ActiveEffect]) -> bool {
        are_near(&self.inert, inert, f64::INFINITY)
    }

    /// Whether it was found for about the same.
    pub fn resembles(&self, case: &Case, inert: &[ActiveEffect]) -> bool {
        let (here, there) = (&self.vehicle, case.model.vehicle());
        let moved = (here.cog[0] - there.cog[0]).hypot(here.cog[1] - there.cog[1]);
        let ratio = |vehicle: &Vehicle| vehicle.friction.across / vehicle.friction.along;
        let grips = (ratio(here) / ratio(there)).ln().abs();
        let is_other =
            |effect: &usize| !inert.iter().any(|one| one.card().id == CATALOGUE[*effect].id);
        let mut others = (0..CATALOGUE.len()).filter(is_other);
        let is_near = |(place, parameter): (usize, &Parameter), effect: usize| {
            let [here, there] =
                [&self.effects, case.model.effects()].map(|effects| value(effects, effect, place));
            (here - there).abs() <= ALIKE * typical_size(parameter)
        };
        let near = others.all(|effect| {
            let mut parameters = CATALOGUE[effect].parameters.iter().enumerate();
            parameters.all(|parameter| is_near(parameter, effect))
        });
        let level = (level(there) / level(here)).ln().abs();
        let is_inert_near = level < REACH && are_near(&self.inert, inert, REACH);
        is_inert_near && moved < CLOSE * here.gauge && grips < CLOSE && near
    }

    /// The motion in time less the stationary motion, as a twist over a sample.
    pub fn departure(&self, sample: &Sample, delay: f64) -> Twist {
        let (from, until) = (sample.start, sample.start + sample.duration);
        let Some(paths) = &self.paths else { return Twist { v_x: 0.0, v_y: 0.0, w: 0.0 } };
        let path = &paths[sample.run];
        let moved = path.pose_at(from - delay).relative(&path.pose_at(until - delay));
        let steady = &self.steady[sample.run];
        let steady = motion_over(&self.belts[sample.run], sample, delay, |reading| {
            ros_twist_from_paper(&steady[reading])
        });
        let twist = |pose: &Pose| paper_twist_from_ros(&pose.log(sample.duration));
        minus(&twist(&moved), &twist(&steady))
    }
}

/// The motion in time over a run; none where it stops.
fn path_in_time(model: &Model, surface: &Surface, belts: &[TrackSample]) -> Option<Trajectory> {
    let mut path = Trajectory::default();
    let Some(first) = belts.first() else { return Some(path) };
    let speeds = |sample: &TrackSample| PerSide::new(sample.v_left, sample.v_right);
    let start = surface.motion(speeds(first)).twist(&[0.0; 3]);
    let mut robot =
        Transient::at_rest(model, first.t, Pose::default()).with_step(STEP).with_twist(start);
    path.push(robot.moment());
    for pair in belts.windows(2) {
        robot.drive(speeds(&pair[0]), pair[1].t, &mut path).ok()?;
    }
    Some(path)
}
