//! A simulated inertial departure: transient minus stationary motion of one robot.

use super::belts::lagging;
use super::sheared::{self, Without};
use super::{SAMPLES_PER_TASK, motion_over};
use crate::evidence::{Evidence, Sample};
use crate::hypothesis::{Unknown, differences, typical_size};
use crate::settings;
use crate::surface::Surface;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use trackdyn_core::frames::{paper_twist_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Plant, Pose, Side, Stopped, Trajectory, Twist};
use trackdyn_model::contact::Resolution;
use trackdyn_model::transient::{Step, mean_of_stages, tangents};
use trackdyn_model::{ActiveEffect, Circumstance, Drive, Effects, Model, Vehicle};
use trackdyn_model::{Forces, Transient};
use trackdyn_recording::hold::pieces;
use trackdyn_recording::{TrackSample, smoothed};

/// Step control of the transient simulation.
#[derive(Clone, Copy)]
struct Steps {
    /// Longest step, s.
    longest: f64,
    /// Shortest step for accuracy, s.
    shortest: f64,
    /// Estimated error of the twist above which a step is shortened, m/s.
    tolerance: f64,
    /// Residual force over weight that counts as balance.
    balance: f64,
}

impl Steps {
    /// Steps of the transient motion itself. With the defaults the departure agrees with that of
    /// steps of 2 ms to one standard deviation of laboratory sensors over a minute of driving.
    fn fine(settings: &settings::Mechanics) -> Self {
        Self {
            longest: settings.max_step,
            shortest: settings.min_step,
            tolerance: settings.step_tolerance,
            balance: settings.balance_tolerance,
        }
    }

    /// Steps for shear-stress laws. With the defaults they err more, but alike with and without a
    /// law, so that the errors cancel; what they leave unbalanced would be taken for a law.
    fn coarse(settings: &settings::Mechanics) -> Self {
        Self {
            longest: settings.max_sheared_step,
            shortest: settings.min_sheared_step,
            tolerance: settings.sheared_step_tolerance,
            balance: 0.0,
        }
    }
}

/// Difference of ln friction that counts as rounding.
const LN_FRICTION_ROUNDING: f64 = 1e-12;

/// Input of a transient simulation.
pub struct Case<'a> {
    /// The vehicle without effects.
    pub vehicle: &'a Vehicle,
    /// The vehicle with effects, inertia among them.
    pub model: &'a Model,
    /// Stationary motions of the vehicle, with laws of the shear stress.
    pub surface: &'a Surface,
    /// Largest speed of a belt, m/s.
    pub largest: f64,
    pub drive: &'a Drive,
    /// Departure of the twist from the stationary one with which each run begins.
    pub starts: Option<&'a Arc<[Twist]>>,
    pub evidence: &'a Evidence,
}

impl Case<'_> {
    pub fn settings(&self) -> &settings::Mechanics {
        &self.evidence.settings().mechanics
    }
}

/// Geometric mean of the friction coefficients.
fn level(vehicle: &Vehicle) -> f64 {
    (vehicle.friction.across * vehicle.friction.along).sqrt()
}

/// Departures of samples at one delay.
struct Departures {
    samples: Arc<[Sample]>,
    delay: f64,
    twists: Arc<[Twist]>,
}

/// Delays whose departures are kept: that of a fit, and a step to either side.
const DELAYS: usize = 3;

/// A simulated inertial departure.
pub struct Inertia {
    /// The effects of inertia.
    pub inert: Vec<ActiveEffect>,
    /// The vehicle without effects.
    vehicle: Vehicle,
    /// The vehicle with effects.
    model: Model,
    /// From its encoder speeds to its belt speeds.
    drive: Drive,
    /// Encoder readings of each run.
    tracks: Arc<[Vec<TrackSample>]>,
    /// Departure of the twist from the stationary one with which each run begins; none where all
    /// begin in stationary motion.
    pub starts: Option<Arc<[Twist]>>,
    /// Transient motion of each run, by the encoder clock.
    paths: Vec<Trajectory>,
    /// Its steps, until they are forgotten.
    fine: Mutex<Option<Arc<Vec<Vec<Step>>>>>,
    /// Its coarse steps, computed on demand.
    steps: OnceLock<Vec<Vec<Step>>>,
    /// Belt speeds, m/s.
    belts: Vec<Vec<TrackSample>>,
    /// Largest speed of a belt, m/s.
    largest: f64,
    /// Table of stationary motions.
    pub surface: Surface,
    /// Stationary twists at the belt speeds.
    steady: Vec<Vec<Twist>>,
    /// Sums of forces on the robot in these twists, computed on demand. They are zero but for the
    /// error of the table.
    left: OnceLock<Vec<Vec<Vector3<f64>>>>,
    /// Departures that were found last.
    departures: Mutex<VecDeque<Departures>>,
    settings: settings::Mechanics,
}

impl Inertia {
    /// Simulates a case. `inert` are the effects of inertia.
    pub fn new(inert: Vec<ActiveEffect>, case: &Case) -> Result<Self, Stopped> {
        let Case { model, largest, drive, starts, evidence, .. } = *case;
        let settings = case.settings().clone();
        let surface = Surface::new(model, largest, settings.speed_range, Some(case.surface));
        let gained = |reading: &TrackSample| {
            let PerSide { left, right } = drive.driven(reading.speeds(), reading.t);
            TrackSample { t: reading.t, v_left: left, v_right: right }
        };
        let belts: Vec<Vec<TrackSample>> = lagging(evidence.tracks(), drive.time_constant)
            .iter()
            .map(|run| smoothed(run).iter().map(gained).collect())
            .collect();
        let starts = starts.cloned();
        let runs = fine(model, &surface, (&belts, starts.as_deref()), &settings)?;
        let (paths, steps) = runs.into_iter().unzip();
        let steady = belts.iter().map(|run| stationary(&surface, run)).collect();
        Ok(Self {
            inert,
            vehicle: case.vehicle.clone(),
            model: model.clone(),
            drive: *drive,
            tracks: Arc::clone(evidence.tracks()),
            starts,
            paths,
            fine: Mutex::new(Some(Arc::new(steps))),
            steps: OnceLock::new(),
            belts,
            largest,
            surface,
            steady,
            left: OnceLock::new(),
            departures: Mutex::default(),
            settings,
        })
    }

    /// The steps of each run, simulated again where they were forgotten.
    ///
    /// # Errors
    /// The simulation fails.
    pub fn fine_steps(&self) -> Result<Arc<Vec<Vec<Step>>>, Stopped> {
        if let Some(kept) = self.kept_steps().clone() {
            return Ok(kept);
        }
        let runs = (&self.belts[..], self.starts.as_deref());
        let runs = fine(&self.model, &self.surface, runs, &self.settings)?;
        Ok(Arc::new(runs.into_iter().map(|(_, steps)| steps).collect()))
    }

    /// Forgets the steps of each run: they take much memory.
    pub fn forget_steps(&self) {
        *self.kept_steps() = None;
    }

    fn kept_steps(&self) -> MutexGuard<'_, Option<Arc<Vec<Vec<Step>>>>> {
        self.fine.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether it was simulated for exactly this case.
    pub fn is_for(&self, inert: &[ActiveEffect], case: &Case) -> bool {
        let Case { vehicle, model, drive, .. } = case;
        self.inert == inert
            && self.vehicle == **vehicle
            && self.model.effects() == model.effects()
            && self.drive == **drive
            && self.drives_as(case)
    }

    /// Whether the runs have the readings of this case, and begin in its motion.
    pub fn drives_as(&self, case: &Case) -> bool {
        are_equal(&self.tracks, case.evidence.tracks()) && self.starts.as_ref() == case.starts
    }

    /// Additional belt lag of this drive, s, mean of both sides: slow changes are delayed by the
    /// time constant.
    pub fn later(&self, drive: &Drive) -> f64 {
        drive.mean_lag() - self.drive.mean_lag()
    }

    /// Largest change of the lag of a belt to this drive, s.
    pub fn lag_change(&self, drive: &Drive) -> f64 {
        let change = |side| (drive.time_constant[side] - self.drive.time_constant[side]).abs();
        Side::BOTH.map(change).into_iter().fold(0.0, f64::max)
    }

    /// Whether the vehicle, without effects, has about this friction ratio.
    pub fn is_close(&self, vehicle: &Vehicle) -> bool {
        let ratio = |vehicle: &Vehicle| vehicle.friction.across / vehicle.friction.along;
        (ratio(&self.vehicle) / ratio(vehicle)).ln().abs() < self.settings.max_vehicle_change
    }

    /// Parameters that differ, with the difference from here to there.
    pub fn changes(&self, vehicle: &Vehicle, effects: &Effects) -> Vec<(Unknown, f64)> {
        let level = (level(vehicle) / level(&self.vehicle)).ln();
        let level = if level.abs() < LN_FRICTION_ROUNDING { 0.0 } else { level };
        let level = std::iter::once((Unknown::FrictionLevel, level));
        let cog = [0, 1].map(|k| (Unknown::Cog(k), vehicle.cog[k] - self.vehicle.cog[k]));
        let of_vehicle = level.chain(cog).filter(|(_, change)| *change != 0.0);
        of_vehicle.chain(differences(self.model.effects(), effects)).collect()
    }

    /// Whether slopes of one robot serve for the other.
    pub fn is_alike(&self, other: &Self) -> bool {
        let settings = &self.settings;
        let mut changes = self.changes(&other.vehicle, other.model.effects()).into_iter();
        are_same(&self.inert, &other.inert)
            && are_equal(&self.tracks, &other.tracks)
            && self.lag_change(&other.drive) <= settings.max_lag_change
            && changes.all(|(by, change)| {
                change.abs() <= settings.reach * size(by, &self.vehicle, settings)
            })
    }

    /// Change of the transient motion by shear-stress laws, at each reading. Their change of the
    /// stationary motion is the difference between the tables `with` and `without` them; other
    /// differences from this robot are covered by the slopes.
    pub fn sheared(&self, laws: &Effects, [with, without]: [&Surface; 2]) -> Vec<Vec<Twist>> {
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
        // Not in parallel: the thread could take up another job of its pool while it waits, and
        // that job would wait for this result.
        let steps =
            self.steps.get_or_init(|| (0..self.belts.len()).map(|run| self.steps(run)).collect());
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
            let shifts = added(belts);
            let changes = sheared::changes([&with, &without], &run, &shifts, &self.settings);
            held(belts, steps, &changes, &shifts)
        })
        .collect()
    }

    /// Change of the departure by each of these other models, to first order: a mean twist for each
    /// reading of each run. `steps` are those of this motion.
    pub fn changes_by(&self, others: &[Model], steps: &[Vec<Step>]) -> Vec<Vec<Vec<Twist>>> {
        let range = self.settings.speed_range;
        let tables: Vec<Surface> = others
            .par_iter()
            .map(|other| Surface::new(other, self.largest, range, Some(&self.surface)))
            .collect();
        let runs = self.belts.par_iter().zip(&self.steady).zip(steps);
        let of_runs: Vec<Vec<Vec<Twist>>> = runs
            .map(|((belts, steady), steps)| {
                let shifts: Vec<Vec<Twist>> = tables
                    .iter()
                    .map(|table| {
                        let there = stationary(table, belts).into_iter().zip(steady);
                        there.map(|(there, here)| there - *here).collect()
                    })
                    .collect();
                let starts: Vec<Twist> =
                    shifts.iter().filter_map(|shift| shift.first().copied()).collect();
                let creep = self.settings.stick_speed;
                let changes = tangents(&self.model, steps, others, &starts, creep);
                let each = changes.iter().zip(&shifts);
                each.map(|(changes, shifts)| held(belts, steps, changes, shifts)).collect()
            })
            .collect();
        let of_other = |other: usize| of_runs.iter().map(|run| run[other].clone()).collect();
        (0..others.len()).map(of_other).collect()
    }

    /// Change of the departure by each axis of the twist with which its run begins, to first order:
    /// a mean twist for each reading of each run.
    ///
    /// # Errors
    /// The simulation fails.
    pub fn changes_by_starts(&self) -> Result<[Vec<Vec<Twist>>; 3], Stopped> {
        let alike = [0; 3].map(|_| self.model.clone());
        let axes = [0, 1, 2].map(|axis| Twist::from_array(Vector3::ith(axis, 1.0).into()));
        let creep = self.settings.stick_speed;
        let steps = self.fine_steps()?;
        let runs = self.belts.par_iter().zip(&*steps).map(|(belts, steps)| {
            let still = vec![Twist::zero(); belts.len()];
            let changes = tangents(&self.model, steps, &alike, &axes, creep);
            changes.iter().map(|changes| held(belts, steps, changes, &still)).collect()
        });
        let runs: Vec<Vec<Vec<Twist>>> = runs.collect();
        Ok([0, 1, 2].map(|axis| runs.iter().map(|run| run[axis].clone()).collect()))
    }

    /// Mean over a sample of twists that hold with the readings of its run.
    pub fn mean_over(&self, sample: &Sample, delay: f64, twists: &[Vec<Twist>]) -> Twist {
        let until = sample.start + sample.duration;
        let pieces = pieces(&self.belts[sample.run], sample.start, until, delay);
        let sum = pieces.fold(Twist::zero(), |sum, (reading, duration)| {
            sum + twists[sample.run][reading] * duration
        });
        sum * sample.duration.recip()
    }

    /// Steps of the transient motion over a run: coarse ones, or fine ones where the former fail.
    fn steps(&self, run: usize) -> Vec<Step> {
        let creep = self.settings.stick_speed;
        let start = start(self.starts.as_deref(), run);
        let belts = &self.belts[run];
        let path = |steps| path_in_time(&self.model, &self.surface, (belts, start), steps, creep);
        let steps = [Steps::coarse(&self.settings), Steps::fine(&self.settings)];
        let found = steps.into_iter().map(path).find_map(Result::ok);
        found.map(|(_, steps)| steps).unwrap_or_default()
    }

    /// Transient minus stationary motion, as a twist (paper's frame) over each sample, at a delay
    /// of the poses, s. Most predictions of a fit ask for the same ones, so they are kept.
    pub fn departures(&self, samples: &Arc<[Sample]>, delay: f64) -> Arc<[Twist]> {
        let kept = || self.departures.lock().unwrap_or_else(PoisonError::into_inner);
        let is_asked = |one: &&Departures| one.delay == delay && Arc::ptr_eq(&one.samples, samples);
        if let Some(known) = kept().iter().find(is_asked) {
            return Arc::clone(&known.twists);
        }
        // Unlocked: a job of the thread pool taken up in between may ask, too.
        let of = |sample: &Sample| self.departure(sample, delay);
        let twists: Arc<[Twist]> =
            samples.par_iter().with_min_len(SAMPLES_PER_TASK).map(of).collect::<Vec<_>>().into();
        let mut kept = kept();
        kept.truncate(DELAYS - 1);
        kept.push_front(Departures {
            samples: Arc::clone(samples),
            delay,
            twists: Arc::clone(&twists),
        });
        twists
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

/// Mean of the `changes` in the stages of these steps while each reading holds, beyond the `shifts`
/// of the stationary motion.
fn held(
    belts: &[TrackSample],
    steps: &[Step],
    changes: &[[Twist; 2]],
    shifts: &[Twist],
) -> Vec<Twist> {
    let mut means = vec![Twist::zero(); belts.len()];
    let mut steps = steps.iter().zip(changes).peekable();
    for ((mean, pair), shift) in means.iter_mut().zip(belts.windows(2)).zip(shifts) {
        let [from, until] = [pair[0].t, pair[1].t];
        let mut sum = Twist::zero();
        while let Some((step, stages)) = steps.next_if(|(step, _)| step.end <= until) {
            sum += (mean_of_stages(*stages) - *shift) * step.duration;
        }
        if until > from {
            *mean = sum / (until - from);
        }
    }
    means
}

/// Stationary twist at each reading of a run.
fn stationary(surface: &Surface, belts: &[TrackSample]) -> Vec<Twist> {
    belts.iter().map(|reading| surface.motion(reading.speeds()).twist(&[0.0; 3])).collect()
}

/// Departure of the twist from the stationary one with which a run begins.
fn start(starts: Option<&[Twist]>, run: usize) -> Twist {
    starts.map_or(Twist::zero(), |starts| starts[run])
}

/// Transient motion over each run, by its belt speeds and its start, and its steps.
fn fine(
    model: &Model,
    surface: &Surface,
    (belts, starts): (&[Vec<TrackSample>], Option<&[Twist]>),
    settings: &settings::Mechanics,
) -> Result<Vec<(Trajectory, Vec<Step>)>, Stopped> {
    let steps = Steps::fine(settings);
    let path = |(run, belts): (usize, &Vec<TrackSample>)| {
        let run = (&belts[..], start(starts, run));
        path_in_time(model, surface, run, steps, settings.stick_speed)
    };
    belts.par_iter().enumerate().map(path).collect()
}

/// Transient motion over a run, which begins with a departure from the stationary twist, and its
/// steps. A track sticks below a slip of `creep`, m/s.
fn path_in_time(
    model: &Model,
    surface: &Surface,
    (belts, departing): (&[TrackSample], Twist),
    steps: Steps,
    creep: f64,
) -> Result<(Trajectory, Vec<Step>), Stopped> {
    let mut path = Trajectory::default();
    let Some(first) = belts.first() else { return Ok((path, Vec::new())) };
    let start = surface.motion(first.speeds()).twist(&[0.0; 3]) + departing;
    let mut robot = Transient::at_rest(model, first.t, Pose::default())
        .with_step(steps.longest)
        .with_tolerance(steps.tolerance, steps.shortest)
        .with_creep(creep)
        .with_balance(steps.balance)
        .with_twist(start)
        .with_steps();
    path.push(robot.moment());
    for pair in belts.windows(2) {
        robot.drive(pair[0].speeds(), pair[1].t, &mut path)?;
    }
    Ok((path, robot.into_steps()))
}

/// Typical size of a parameter, as a unit of distance; one for ln friction.
pub fn size(by: Unknown, vehicle: &Vehicle, settings: &settings::Mechanics) -> f64 {
    match by {
        Unknown::Cog(_) => settings.cog_size * vehicle.gauge,
        _ => typical(by),
    }
}

/// Typical size of a parameter of an effect; one for ln friction.
pub fn typical(by: Unknown) -> f64 {
    by.parameter().map_or(1.0, typical_size)
}

/// Whether these are the readings of the same runs.
fn are_equal(a: &Arc<[Vec<TrackSample>]>, b: &Arc<[Vec<TrackSample>]>) -> bool {
    Arc::ptr_eq(a, b) || a == b
}

/// Whether both hold the same effects, with any values.
pub fn are_same<'a>(
    known: impl IntoIterator<Item = &'a ActiveEffect>,
    effects: impl IntoIterator<Item = &'a ActiveEffect>,
) -> bool {
    let id = |effect: &ActiveEffect| effect.card().id;
    known.into_iter().map(id).eq(effects.into_iter().map(id))
}
