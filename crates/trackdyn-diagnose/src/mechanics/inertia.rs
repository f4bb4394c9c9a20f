//! What inertia adds to the stationary motion.
//!
//! # Law
//! The motion in time less the stationary motion, over each sample. Around the values θ₀ of the effects that it
//! comes from, it is linear in them: d(θ) = d(θ₀) + Σ (θ − θ₀) ∂d/∂θ, as far as [`REACH`].

use super::belts::{lagging, smooth};
use super::{minus, motion_over, plus};
use crate::evidence::{Evidence, Sample};
use crate::hypothesis::{typical_size, value, with_friction, with_values};
use crate::surface::Surface;
use rayon::prelude::*;
use std::sync::Arc;
use trackdyn_core::frames::{paper_twist_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Plant, Pose, Trajectory, Twist};
use trackdyn_motion::Transient;
use trackdyn_physics::effect::Parameter;
use trackdyn_physics::{ActiveEffect, CATALOGUE, Drive, Model, Vehicle};
use trackdyn_recording::TrackSample;

/// Longest step of the motion in time, s: readings come more often.
const STEP: f64 = 0.05;

/// Part of its typical size by which a parameter may differ from where the motion in time was found, and over which
/// derivatives are taken. Beyond what is linear, that changes half a percent of what a typical size adds.
const REACH: f64 = 0.2;

/// The same on the way of a fit, and for where derivatives were found: an error there is one of second order.
const ALIKE: f64 = 1.0;

/// How far a hypothesis may be from where the motion in time was found to be taken for near, in typical sizes.
#[derive(Clone, Copy)]
pub struct Within {
    /// The effects that it comes from, and the logarithm of friction.
    inert: f64,
    /// Other effects.
    others: f64,
}

impl Within {
    /// Near enough to end a fit with.
    pub const REACH: Self = Self { inert: REACH, others: REACH };
    /// On the way of a fit: as far as slopes may lead.
    pub const THE_WAY: Self = Self { inert: f64::MAX, others: ALIKE };
}

/// Part of the gauge, and of the friction ratio, by which the vehicle may differ.
const CLOSE: f64 = 0.02;

/// Difference of the logarithm of friction that is rounding.
const SAME: f64 = 1e-12;

/// What the motion in time is found for.
pub struct Case<'a> {
    /// The robot, without what effects make of it.
    pub vehicle: &'a Vehicle,
    /// The robot, inertia among its effects.
    pub model: &'a Model,
    /// Largest speed of a belt, m/s.
    pub largest: f64,
    pub drive: &'a Drive,
    pub evidence: &'a Evidence,
}

/// What inertia adds, near where it was found.
#[derive(Clone)]
pub struct InertiaNear {
    at: Arc<Inertia>,
    /// How it changes with the parameters of the effects that it comes from.
    slopes: Option<Arc<Slopes>>,
    /// What the change adds up to, per sample; none at the very place.
    shift: Option<Arc<Vec<Twist>>>,
}

/// How what inertia adds changes with the parameters of the effects that it comes from.
struct Slopes {
    /// The effects.
    inert: Vec<ActiveEffect>,
    /// Place of the effect, place of its parameter, and the change of each sample per unit of it.
    by: Vec<(usize, usize, Vec<Twist>)>,
    /// The same by the logarithm of friction.
    by_level: Vec<Twist>,
}

impl InertiaNear {
    /// What these effects add, without knowing how that changes.
    pub fn here(inert: Vec<ActiveEffect>, case: &Case) -> Result<Self, String> {
        Ok(Self { at: Arc::new(Inertia::new(inert, case)?), slopes: None, shift: None })
    }

    /// What it adds to a hypothesis that resembles the one it was found for. `inert` are the effects that it comes
    /// from; where their values are free, how it changes with them is found too, at a delay of the poses, s.
    pub fn beside(
        before: Option<&Self>,
        inert: Vec<ActiveEffect>,
        case: &Case,
        free_at: Option<f64>,
        within: Within,
    ) -> Result<Self, String> {
        let known = before.filter(|before| before.at.resembles(case, &inert, within.others));
        let vehicle = case.model.vehicle();
        if let Some(near) = known.and_then(|known| known.moved(&inert, vehicle, within.inert)) {
            return Ok(near);
        }
        let here = Self::here(inert, case)?;
        let Some(delay) = free_at else { return Ok(here) };
        // Slopes are asked for small steps only: those of a hypothesis that resembles this one do.
        let inert = &here.at.inert;
        let known = before.and_then(|before| before.slopes.clone());
        let known = known.filter(|known| are_near(&known.inert, inert, ALIKE));
        let slopes = known.or_else(|| Slopes::new(&here.at, case, delay).map(Arc::new));
        Ok(Self { slopes, ..here })
    }

    /// The same for other values of the effects that it comes from, up to `reach` of a typical size, and as much
    /// more or less friction; none where these are not near, or slopes not known.
    pub fn moved(&self, inert: &[ActiveEffect], vehicle: &Vehicle, reach: f64) -> Option<Self> {
        let level = (level(vehicle) / level(self.at.model.vehicle())).ln();
        if self.at.inert == inert && level.abs() < SAME {
            return Some(self.unmoved());
        }
        let slopes = self.slopes.as_ref()?;
        if !are_near(&self.at.inert, inert, reach) || level.abs() > reach {
            return None;
        }
        let mut shift: Vec<Twist> = slopes.by_level.iter().map(|by| scaled(by, level)).collect();
        for (k, place, slope) in &slopes.by {
            let by = inert[*k].values()[*place] - self.at.inert[*k].values()[*place];
            for (sum, slope) in shift.iter_mut().zip(slope) {
                *sum = plus(sum, &scaled(slope, by));
            }
        }
        Some(Self { shift: Some(Arc::new(shift)), ..self.clone() })
    }

    /// What it adds where it was found.
    pub fn unmoved(&self) -> Self {
        Self { shift: None, ..self.clone() }
    }

    /// The robot that it was found for.
    pub fn model(&self) -> &Model {
        &self.at.model
    }

    /// Whether both come from one motion in time.
    pub fn is_from(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.at, &other.at)
    }

    /// What it adds to the twist (paper's frame) during a sample, of this index.
    pub fn departure(&self, index: usize, sample: &Sample, delay: f64) -> Twist {
        let departure = self.at.departure(sample, delay);
        self.shift.as_ref().map_or(departure, |shift| plus(&departure, &shift[index]))
    }
}

impl Slopes {
    /// By differences of motions in time; none where there is no such motion.
    fn new(at: &Inertia, case: &Case, delay: f64) -> Option<Self> {
        let departures = |inertia: &Inertia| -> Vec<Twist> {
            let samples = case.evidence.samples().par_iter();
            samples.map(|sample| inertia.departure(sample, delay)).collect()
        };
        let before = departures(at);
        let (vehicle, effects) = (case.vehicle, case.model.effects());
        let slope = |model: &Model, step: f64| -> Option<Vec<Twist>> {
            let after = departures(&Inertia::new(Vec::new(), &Case { model, ..*case }).ok()?);
            let slope = after.iter().zip(&before);
            Some(slope.map(|(there, here)| scaled(&minus(there, here), step.recip())).collect())
        };
        let mut by = Vec::new();
        for (k, effect) in at.inert.iter().enumerate() {
            for (place, parameter) in effect.card().parameters.iter().enumerate() {
                let value = effect.values()[place];
                // What is typically zero is near where it is the same.
                let step = REACH * typical_size(parameter);
                if step == 0.0 {
                    continue;
                }
                let step = if value + step > parameter.range[1] { -step } else { step };
                let mut values = effect.values().to_vec();
                values[place] += step;
                let mut effects = effects.clone();
                effects.insert(with_values(effect, &values));
                by.push((k, place, slope(&Model::new(vehicle.clone(), effects), step)?));
            }
        }
        let rougher = Model::new(with_friction(vehicle, REACH), effects.clone());
        Some(Self { inert: at.inert.clone(), by, by_level: slope(&rougher, REACH)? })
    }
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

fn scaled(twist: &Twist, by: f64) -> Twist {
    Twist { v_x: by * twist.v_x, v_y: by * twist.v_y, w: by * twist.w }
}

/// What inertia adds to the stationary motion.
struct Inertia {
    /// The effects that it comes from.
    inert: Vec<ActiveEffect>,
    /// The robot.
    model: Model,
    /// Motion in time of each run, by the clock of the encoders.
    paths: Vec<Trajectory>,
    /// Speeds of the belts behind it, m/s.
    belts: Vec<Vec<TrackSample>>,
    /// The stationary twists there without it.
    steady: Vec<Vec<Twist>>,
}

impl Inertia {
    fn new(inert: Vec<ActiveEffect>, case: &Case) -> Result<Self, String> {
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
        let paths: Result<Vec<Trajectory>, String> =
            belts.par_iter().map(|run| path_in_time(model, &surface, run)).collect();
        let speeds = |reading: &TrackSample| PerSide::new(reading.v_left, reading.v_right);
        let twist = |reading: &TrackSample| surface.motion(speeds(reading)).twist(&[0.0; 3]);
        let steady = belts.iter().map(|run| run.iter().map(twist).collect()).collect();
        Ok(Self { inert, model: model.clone(), paths: paths?, belts, steady })
    }

    /// Whether all but the effects that it comes from is about the same: other effects within `reach` of their typical
    /// sizes.
    fn resembles(&self, case: &Case, inert: &[ActiveEffect], reach: f64) -> bool {
        let (here, there) = (self.model.vehicle(), case.model.vehicle());
        let moved = (here.cog[0] - there.cog[0]).hypot(here.cog[1] - there.cog[1]);
        let ratio = |vehicle: &Vehicle| vehicle.friction.across / vehicle.friction.along;
        let grips = (ratio(here) / ratio(there)).ln().abs();
        let is_other =
            |effect: &usize| !inert.iter().any(|one| one.card().id == CATALOGUE[*effect].id);
        let mut others = (0..CATALOGUE.len()).filter(is_other);
        let is_near = |(place, parameter): (usize, &Parameter), effect: usize| {
            let [here, there] =
                [&self.model, case.model].map(|model| value(model.effects(), effect, place));
            (here - there).abs() <= reach * typical_size(parameter)
        };
        let near = others.all(|effect| {
            let mut parameters = CATALOGUE[effect].parameters.iter().enumerate();
            parameters.all(|parameter| is_near(parameter, effect))
        });
        moved < CLOSE * here.gauge && grips < CLOSE && near
    }

    /// The motion in time less the stationary motion, as a twist over a sample.
    fn departure(&self, sample: &Sample, delay: f64) -> Twist {
        let (from, until) = (sample.start, sample.start + sample.duration);
        let path = &self.paths[sample.run];
        let moved = path.pose_at(from - delay).relative(&path.pose_at(until - delay));
        let steady = &self.steady[sample.run];
        let steady = motion_over(&self.belts[sample.run], sample, delay, |reading| {
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
