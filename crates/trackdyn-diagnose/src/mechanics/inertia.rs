//! Departure of the transient from the stationary motion.
//!
//! # Law
//! Transient minus stationary motion over each sample. Around the parameters θ₀ that were simulated
//! it is linear in the free ones, d(θ) = d(θ₀) + Σ (θ − θ₀) ∂d/∂θ, used within `mechanics.reach`,
//! and over any distance during a fit.

use super::belts::{lagging, smooth};
use super::sheared::{self, Without};
use super::{coarse, motion_over};
use crate::evidence::{Evidence, Sample};
use crate::hypothesis::{Unknown, active, find, typical_size, value, with_friction};
use crate::settings;
use crate::surface::Surface;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};
use trackdyn_core::frames::{paper_twist_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Plant, Pose, Trajectory, Twist};
use trackdyn_model::contact::Resolution;
use trackdyn_model::transient::Step;
use trackdyn_model::{ActiveEffect, Circumstance, Drive, EffectId, Effects, Model, Vehicle};
use trackdyn_model::{Forces, Transient};
use trackdyn_recording::TrackSample;

/// Step control of the transient simulation.
#[derive(Clone, Copy)]
struct Steps {
    /// Longest step, s.
    longest: f64,
    /// Estimated error of the twist above which a step is halved, m/s.
    tolerance: f64,
}

impl Steps {
    /// Steps of the transient motion itself. With the defaults the departure agrees with that of 2
    /// ms steps to one standard deviation of laboratory sensors over eight minutes of driving.
    /// Belts jump at each reading and on dry friction a body follows in milliseconds: longer steps
    /// would skip that, unseen by the error estimate.
    fn fine(settings: &settings::Mechanics) -> Self {
        Self { longest: settings.max_step, tolerance: settings.step_tolerance }
    }

    /// Steps for shear-stress laws. With the defaults they err by nine of these standard
    /// deviations, but alike with and without a law, so that the errors cancel.
    fn coarse(settings: &settings::Mechanics) -> Self {
        Self { longest: settings.max_sheared_step, tolerance: settings.sheared_step_tolerance }
    }
}

/// Largest distances to the simulated parameters over which a departure is extrapolated, in typical
/// sizes.
#[derive(Clone, Copy)]
pub struct Within {
    /// For parameters with a known slope.
    known: f64,
    /// For all others.
    unknown: f64,
    /// For the lag of the belts, s.
    late: f64,
}

impl Within {
    /// Near enough for the end of a fit.
    pub fn reach(settings: &settings::Mechanics) -> Self {
        let settings::Mechanics { reach, max_lag_change, .. } = *settings;
        Self { known: reach, unknown: reach, late: max_lag_change }
    }

    /// During a fit: any distance where slopes are known.
    pub fn the_way(settings: &settings::Mechanics) -> Self {
        Self { known: f64::MAX, unknown: settings.reach_without_slope, late: f64::MAX }
    }

    /// A finite-difference step of any size.
    pub const A_STEP: Self = Self { known: f64::MAX, unknown: f64::MAX, late: f64::MAX };
}

/// Difference of ln friction that counts as rounding.
const LN_FRICTION_ROUNDING: f64 = 1e-12;

/// Input of a transient simulation.
pub struct Case<'a> {
    /// The vehicle without effects.
    pub vehicle: &'a Vehicle,
    /// The vehicle with effects, inertia among them.
    pub model: &'a Model,
    /// Largest speed of a belt, m/s.
    pub largest: f64,
    pub drive: &'a Drive,
    pub evidence: &'a Evidence,
}

impl Case<'_> {
    fn settings(&self) -> &settings::Mechanics {
        &self.evidence.settings().mechanics
    }
}

/// Inertial departure, valid near the simulated parameters.
#[derive(Clone)]
pub struct InertiaNear {
    at: Arc<Inertia>,
    /// Its derivatives by the free parameters.
    slopes: Vec<Arc<Slope>>,
    /// Extrapolated change of each sample; none at the simulated parameters themselves.
    shift: Option<Arc<Vec<Twist>>>,
}

/// Derivative of the departure by one parameter, by a finite difference.
struct Slope {
    by: Unknown,
    /// Where it was computed.
    at: Arc<Inertia>,
    /// Change of each sample per unit of the parameter.
    change: Vec<Twist>,
}

impl InertiaNear {
    /// Departure simulated for this case, without derivatives. `inert` are the effects of inertia.
    pub fn here(inert: Vec<ActiveEffect>, case: &Case) -> Result<Self, String> {
        Ok(Self { at: Arc::new(Inertia::new(inert, case)?), slopes: Vec::new(), shift: None })
    }

    /// Departure of a hypothesis: extrapolated from `before` where it is near and all slopes are
    /// known, otherwise simulated. `inert` are the effects of inertia; slopes by the `free`
    /// unknowns are computed where missing, at a pose delay of `delay`, s.
    pub fn beside(
        before: Option<&Self>,
        inert: Vec<ActiveEffect>,
        case: &Case,
        free: &[Unknown],
        delay: f64,
        within: Within,
    ) -> Result<Self, String> {
        let knows = |near: &Self| free.iter().all(|by| near.slope(*by).is_some());
        let known = before.filter(|before| knows(before));
        if let Some(near) = known.and_then(|known| known.moved(&inert, case, within)) {
            return Ok(near);
        }
        let here = match before.filter(|before| before.at.is_for(&inert, case)) {
            Some(before) => before.unmoved(),
            None => Self::here(inert, case)?,
        };
        let before = before.map_or(&[][..], |before| &before.slopes);
        // Slopes of a clearly different robot mislead: moments of inertia are quadratic in a
        // radius.
        let alike = |slope: &&Arc<Slope>| slope.at.is_alike(&here.at);
        let slopes: Vec<Arc<Slope>> = free
            .par_iter()
            .filter_map(|by| {
                let mut known = before.iter().filter(alike);
                let known = known.find(|slope| slope.by == *by).cloned();
                known.or_else(|| Slope::new(*by, &here.at, case, delay).map(Arc::new))
            })
            .collect();
        Ok(Self { slopes, ..here })
    }

    /// Departure extrapolated to a hypothesis; none where its inertial effects differ, or it is
    /// farther away than `within` allows.
    pub fn moved(&self, inert: &[ActiveEffect], case: &Case, within: Within) -> Option<Self> {
        let late = self.at.later(case.drive).abs();
        if !are_same(&self.at.inert, inert) || !self.at.is_close(case.vehicle) || late > within.late
        {
            return None;
        }
        let settings = case.settings();
        let size = |by: Unknown| size(by, case.vehicle, settings);
        let nearly = |by: Unknown, change: f64| match by {
            Unknown::Cog(_) => change.abs() < settings.max_vehicle_change * case.vehicle.gauge,
            _ => change.abs() <= within.unknown * size(by) && !needs_slope(by, inert),
        };
        let mut shift: Option<Vec<Twist>> = None;
        for (by, change) in self.at.changes(case.vehicle, case.model.effects()) {
            match self.slope(by) {
                Some(slope) if change.abs() <= within.known * size(by) => {
                    let still = || vec![Twist::zero(); slope.change.len()];
                    let sums = shift.get_or_insert_with(still);
                    for (sum, slope) in sums.iter_mut().zip(&slope.change) {
                        *sum += *slope * change;
                    }
                }
                None if nearly(by, change) => {}
                _ => return None,
            }
        }
        Some(Self { shift: shift.map(Arc::new), ..self.clone() })
    }

    fn slope(&self, by: Unknown) -> Option<&Slope> {
        self.slopes.iter().map(Arc::as_ref).find(|slope| slope.by == by)
    }

    /// The departure at the simulated parameters.
    pub fn unmoved(&self) -> Self {
        Self { shift: None, ..self.clone() }
    }

    /// Change of the departure by shear-stress laws, at each reading, at the simulated parameters.
    /// `with` is the table of stationary motions with the laws, `case` the robot without.
    pub fn sheared(&self, laws: &[ActiveEffect], with: &Surface, case: &Case) -> Vec<Vec<Twist>> {
        let without = Surface::new(
            case.model,
            case.largest,
            case.settings().speed_range,
            Some(&self.at.surface),
        );
        self.at.sheared(laws, [with, &without])
    }

    /// Whether both come from one transient simulation.
    pub fn is_from(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.at, &other.at)
    }

    /// Departure of the twist (paper's frame) during the sample with this index, for the belt lag
    /// of `drive` and a pose delay, s.
    pub fn departure(&self, index: usize, sample: &Sample, drive: &Drive, delay: f64) -> Twist {
        let departure = self.at.departure(sample, delay + self.at.later(drive));
        self.shift.as_ref().map_or(departure, |shift| departure + shift[index])
    }
}

impl Slope {
    /// Derivative by a finite difference of two simulations; none where neither side can be
    /// simulated.
    fn new(by: Unknown, at: &Arc<Inertia>, case: &Case, delay: f64) -> Option<Self> {
        let departures = |inertia: &Inertia| -> Vec<Twist> {
            let samples = case.evidence.samples().par_iter();
            samples.map(|sample| inertia.departure(sample, delay)).collect()
        };
        // A robot that is about to tip can be simulated on one side only.
        let (there, step) = [1.0, -1.0].into_iter().find_map(|sign| {
            let (model, step) = stepped(by, case, sign)?;
            Some((Inertia::new(Vec::new(), &Case { model: &model, ..*case }).ok()?, step))
        })?;
        let (there, here) = (departures(&there), departures(at));
        let change = there.iter().zip(&here);
        let change = change.map(|(there, here)| (*there - *here) * step.recip());
        Some(Self { by, at: Arc::clone(at), change: change.collect() })
    }
}

/// The model with one parameter changed by a step of this sign, and the step; none where it would
/// leave its physical range.
fn stepped(by: Unknown, case: &Case, sign: f64) -> Option<(Model, f64)> {
    let (vehicle, effects) = (case.vehicle, case.model.effects());
    let settings = case.settings();
    let step = sign * settings.reach * size(by, vehicle, settings);
    match by {
        Unknown::Offset(_) => None,
        Unknown::Cog(axis) => {
            let mut moved = vehicle.clone();
            moved.cog[axis] += step;
            Some((coarse(&moved, effects.clone()), step))
        }
        Unknown::FrictionLevel => {
            Some((coarse(&with_friction(vehicle, step), effects.clone()), step))
        }
        Unknown::Effect(effect, place) => {
            let mut values = find(effects, effect)?.values().to_vec();
            let [low, high] = effect.card().parameters[place].range;
            values[place] += step;
            if !(low..=high).contains(&values[place]) {
                return None;
            }
            let mut effects = effects.clone();
            effects.insert(active(effect, &values));
            Some((coarse(vehicle, effects), step))
        }
    }
}

/// Whether the departure can be differentiated by a parameter: one whose typical size is zero has
/// no step, and counts as near only if equal.
pub fn has_slope(by: Unknown, model: &Model) -> bool {
    match by {
        Unknown::Offset(_) => false,
        Unknown::FrictionLevel | Unknown::Cog(_) => true,
        Unknown::Effect(effect, _) => find(model.effects(), effect).is_some() && typical(by) > 0.0,
    }
}

/// Typical size of a parameter, as a unit of distance; one for ln friction.
fn size(by: Unknown, vehicle: &Vehicle, settings: &settings::Mechanics) -> f64 {
    match by {
        Unknown::Cog(_) => settings.cog_size * vehicle.gauge,
        _ => typical(by),
    }
}

/// Typical size of a parameter of an effect; one for ln friction.
fn typical(by: Unknown) -> f64 {
    by.parameter().map_or(1.0, typical_size)
}

/// Whether any change of a parameter, however small, needs a slope: it belongs to one of these
/// effects, or to the vehicle.
fn needs_slope(by: Unknown, effects: &[ActiveEffect]) -> bool {
    let card = by.card();
    card.is_none_or(|card| effects.iter().any(|effect| effect.card().id == card.id))
}

/// Whether both lists hold the same effects, with any values.
fn are_same(known: &[ActiveEffect], effects: &[ActiveEffect]) -> bool {
    let ids = |effects: &[ActiveEffect]| -> Vec<&str> {
        effects.iter().map(|effect| effect.card().id).collect()
    };
    ids(known) == ids(effects)
}

/// Geometric mean of the friction coefficients.
fn level(vehicle: &Vehicle) -> f64 {
    (vehicle.friction.across * vehicle.friction.along).sqrt()
}

/// A simulated inertial departure.
struct Inertia {
    /// The effects of inertia.
    inert: Vec<ActiveEffect>,
    /// The vehicle without effects.
    vehicle: Vehicle,
    /// The vehicle with effects.
    model: Model,
    /// From its encoder speeds to its belt speeds.
    drive: Drive,
    /// Transient motion of each run, by the encoder clock.
    paths: Vec<Trajectory>,
    /// Its coarse steps, computed on demand.
    steps: OnceLock<Vec<Vec<Step>>>,
    /// Belt speeds, m/s.
    belts: Vec<Vec<TrackSample>>,
    /// Table of stationary motions.
    surface: Surface,
    /// Stationary twists at the belt speeds.
    steady: Vec<Vec<Twist>>,
    /// Sums of forces in these, nonzero by the error of the table, computed on demand.
    left: OnceLock<Vec<Vec<Vector3<f64>>>>,
    settings: settings::Mechanics,
}

impl Inertia {
    fn new(inert: Vec<ActiveEffect>, case: &Case) -> Result<Self, String> {
        let Case { model, largest, drive, evidence, .. } = *case;
        let settings = case.settings().clone();
        let surface = Surface::new(model, largest, settings.speed_range, None);
        let gained = |reading: &TrackSample| {
            let PerSide { left, right } = drive.driven(reading.speeds());
            TrackSample { t: reading.t, v_left: left, v_right: right }
        };
        let belts: Vec<Vec<TrackSample>> = lagging(evidence.tracks(), drive.time_constant)
            .iter()
            .map(|run| smooth(run).iter().map(gained).collect())
            .collect();
        let path = |run: &Vec<TrackSample>| {
            let steps = Steps::fine(&settings);
            path_in_time(model, &surface, run, steps, settings.stick_speed).map(|(path, _)| path)
        };
        let paths = belts.par_iter().map(path).collect::<Result<Vec<_>, String>>()?;
        let steady = belts.iter().map(|run| stationary(&surface, run)).collect();
        let vehicle = case.vehicle.clone();
        let (model, drive) = (model.clone(), *drive);
        let (steps, left) = (OnceLock::new(), OnceLock::new());
        Ok(Self {
            inert,
            vehicle,
            model,
            drive,
            paths,
            steps,
            belts,
            surface,
            steady,
            left,
            settings,
        })
    }

    /// Whether it was simulated for exactly this case.
    fn is_for(&self, inert: &[ActiveEffect], case: &Case) -> bool {
        let Case { vehicle, model, drive, .. } = case;
        self.inert == inert
            && self.vehicle == **vehicle
            && self.model.effects() == model.effects()
            && self.drive == **drive
    }

    /// Additional belt lag of this drive, s: slow changes are delayed by the time constant.
    fn later(&self, drive: &Drive) -> f64 {
        drive.time_constant - self.drive.time_constant
    }

    /// Whether the vehicle, without effects, has about this friction ratio.
    fn is_close(&self, vehicle: &Vehicle) -> bool {
        let ratio = |vehicle: &Vehicle| vehicle.friction.across / vehicle.friction.along;
        (ratio(&self.vehicle) / ratio(vehicle)).ln().abs() < self.settings.max_vehicle_change
    }

    /// Parameters that differ, with the difference from here to there.
    fn changes(&self, vehicle: &Vehicle, effects: &Effects) -> Vec<(Unknown, f64)> {
        let level = (level(vehicle) / level(&self.vehicle)).ln();
        let level = if level.abs() < LN_FRICTION_ROUNDING { 0.0 } else { level };
        let level = std::iter::once((Unknown::FrictionLevel, level));
        let cog = [0, 1].map(|k| (Unknown::Cog(k), vehicle.cog[k] - self.vehicle.cog[k]));
        let change = |effect: EffectId, place: usize| {
            let [here, there] =
                [self.model.effects(), effects].map(|effects| value(effects, effect, place));
            (Unknown::Effect(effect, place), there - here)
        };
        let of_effects = EffectId::all().flat_map(|effect| {
            (0..effect.card().parameters.len()).map(move |place| change(effect, place))
        });
        level.chain(cog).chain(of_effects).filter(|(_, change)| *change != 0.0).collect()
    }

    /// Whether slopes of one robot serve for the other.
    fn is_alike(&self, other: &Self) -> bool {
        let settings = &self.settings;
        let mut changes = self.changes(&other.vehicle, other.model.effects()).into_iter();
        are_same(&self.inert, &other.inert)
            && self.later(&other.drive).abs() <= settings.max_lag_change
            && changes.all(|(by, change)| {
                change.abs() <= settings.reach * size(by, &self.vehicle, settings)
            })
    }

    /// Change of the transient motion by shear-stress laws, at each reading. Their change of the
    /// stationary motion is the difference between the tables `with` and `without` them; other
    /// differences from this robot are covered by the slopes.
    fn sheared(&self, laws: &[ActiveEffect], [with, without]: [&Surface; 2]) -> Vec<Vec<Twist>> {
        let added = |belts: &[TrackSample]| -> Vec<Twist> {
            let [with, without] = [with, without].map(|surface| stationary(surface, belts));
            with.iter().zip(without).map(|(with, without)| *with - without).collect()
        };
        let mut effects = self.model.effects().clone();
        for law in laws {
            effects.insert(law.clone());
        }
        let with = Model::new(self.vehicle.clone(), effects).with_resolution(Resolution::Rough);
        let level = Circumstance::default();
        let grounds = [&with, &self.model].map(|model| model.ground(&level));
        let creep = self.settings.stick_speed;
        let with = Forces { model: &with, ground: &grounds[0], creep };
        let without = Forces { model: &self.model, ground: &grounds[1], creep };
        // Sequential: a job of the thread pool taken up in between would wait for this one.
        let steps =
            self.steps.get_or_init(|| self.belts.iter().map(|run| self.steps(run)).collect());
        let left = self.left.get_or_init(|| {
            let runs = self.belts.iter().zip(&self.steady);
            let sum = |(belts, twist): (&TrackSample, &Twist)| {
                without.sum(belts.speeds(), twist, &Twist::zero())
            };
            runs.map(|(belts, steady)| belts.iter().zip(steady).map(sum).collect()).collect()
        });
        let runs = steps.par_iter().zip(&self.belts).zip(&self.steady).zip(left);
        runs.map(|(((steps, belts), steady), left)| {
            let run = Without { steps, belts, steady, left };
            sheared::departures([&with, &without], &run, &added(belts), &self.settings)
        })
        .collect()
    }

    /// Steps of the transient motion over a run: coarse ones, or fine ones where the former fail.
    fn steps(&self, run: &[TrackSample]) -> Vec<Step> {
        let creep = self.settings.stick_speed;
        let path = |steps| path_in_time(&self.model, &self.surface, run, steps, creep);
        let steps = [Steps::coarse(&self.settings), Steps::fine(&self.settings)];
        let found = steps.into_iter().map(path).find_map(Result::ok);
        found.map(|(_, steps)| steps).unwrap_or_default()
    }

    /// Transient minus stationary motion, as a twist over a sample.
    fn departure(&self, sample: &Sample, delay: f64) -> Twist {
        let (from, until) = (sample.start, sample.start + sample.duration);
        let path = &self.paths[sample.run];
        let moved = path.pose_at(from - delay).relative(&path.pose_at(until - delay));
        let steady = &self.steady[sample.run];
        let steady = motion_over(&self.belts[sample.run], sample, delay, |reading| {
            ros_twist_from_paper(&steady[reading])
        });
        let twist = |pose: &Pose| paper_twist_from_ros(&pose.log(sample.duration));
        twist(&moved) - twist(&steady)
    }
}

/// Stationary twist at each reading of a run.
fn stationary(surface: &Surface, belts: &[TrackSample]) -> Vec<Twist> {
    belts.iter().map(|reading| surface.motion(reading.speeds()).twist(&[0.0; 3])).collect()
}

/// Transient motion over a run, and its steps. A track sticks below a slip of `creep`, m/s.
fn path_in_time(
    model: &Model,
    surface: &Surface,
    belts: &[TrackSample],
    steps: Steps,
    creep: f64,
) -> Result<(Trajectory, Vec<Step>), String> {
    let mut path = Trajectory::default();
    let Some(first) = belts.first() else { return Ok((path, Vec::new())) };
    let start = surface.motion(first.speeds()).twist(&[0.0; 3]);
    let mut robot = Transient::at_rest(model, first.t, Pose::default())
        .with_step(steps.longest)
        .with_tolerance(steps.tolerance)
        .with_creep(creep)
        .with_twist(start)
        .with_pull()
        .with_steps();
    path.push(robot.moment());
    for pair in belts.windows(2) {
        robot
            .drive(pair[0].speeds(), pair[1].t, &mut path)
            .map_err(|stopped| stopped.to_string())?;
    }
    Ok((path, robot.into_steps()))
}
