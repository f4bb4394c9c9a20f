//! Prediction of the motion by a hypothesis.
//!
//! Each sample starts at its observed pose and integrates the twist for the recorded track speeds.
//!
//! # Law
//! The twist is that of the stationary motion, plus two small departures:
//! - ground that changes with place, heading or time: the stationary motion there minus the one on
//!   uniform ground,
//! - inertia: the transient motion minus the stationary one, over the sample.
//!
//! # Assumes
//! Both departures are computed without shear-stress laws, which need a quadrature per solve. Their
//! influence on the ground departure is of second order and neglected; that on the inertial
//! departure is found from it in a few Newton steps.

mod belts;
mod by_shear;
mod ground;
mod inertia;
mod sheared;
mod simulated;
mod slope;

use crate::error::Impossible;
use crate::evidence::{Evidence, Origin, Sample};
use crate::hypothesis::{Hypothesis, Unknown};
use crate::surface::{MAX_UNSOLVED_SAMPLE_SHARE, Steady, Surface};
use belts::lagging;
use by_shear::ByShear;
use ground::{Acts, ByGround, acts};
use inertia::{InertiaNear, Within};
use nalgebra::Vector3;
use rayon::prelude::*;
use simulated::Case;
use slope::has_slope;
use std::borrow::Cow;
use std::sync::Arc;
use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{Pose, Twist};
use trackdyn_model::Transient;
use trackdyn_model::contact::Resolution;
use trackdyn_model::effect::Stage;
use trackdyn_model::{ActiveEffect, Drive, Effects, Model, Sensor, Vehicle};
use trackdyn_recording::TrackSample;
use trackdyn_recording::hold::pieces;

/// Samples that one parallel task predicts or solves.
const SAMPLES_PER_TASK: usize = 64;

/// The expensive part of a prediction: independent of sensors, of gains and lags of the drive, and
/// of constant ICR offsets.
#[derive(Clone)]
pub struct Mechanics {
    surface: Surface,
    /// Encoder readings of each run.
    tracks: Arc<[Vec<TrackSample>]>,
    /// Stationary motion at each reading of each run, for belts that follow the encoders by
    /// `drive`.
    steady: Arc<Vec<Vec<Steady>>>,
    drive: Drive,
    /// Departure of the twist during each sample by changing ground, paper's frame.
    ground: Option<Arc<ByGround>>,
    /// Departure by inertia.
    in_time: InTime,
    /// The robot without laws of the shear stress, on ground that does not change.
    simple: Arc<Model>,
    /// Laws of the shear stress.
    shear: Effects,
}

/// Departure of the transient from the stationary motion.
#[derive(Clone)]
enum InTime {
    /// None: no effect depends on acceleration, or the evidence is a table of steady points.
    Stationary,
    /// Computed for this robot or a similar one.
    Found {
        /// Departure without shear-stress laws.
        inertia: InertiaNear,
        /// Change of it by shear-stress laws; none without such laws.
        sheared: Option<ByShear>,
    },
    /// None: the hypothesis is impossible.
    Impossible(Impossible),
}

impl InTime {
    /// Departure without shear-stress laws; none where there is no departure.
    fn inertia(&self) -> Option<&InertiaNear> {
        match self {
            Self::Found { inertia, .. } => Some(inertia),
            Self::Stationary | Self::Impossible(_) => None,
        }
    }

    /// Forgets what only slopes need, which takes much memory.
    fn forget_steps(&self) {
        if let Self::Found { inertia, .. } = self {
            inertia.forget_steps();
        }
    }

    /// Change of the departure by shear-stress laws.
    fn sheared(&self) -> Option<&ByShear> {
        match self {
            Self::Found { sheared, .. } => sheared.as_ref(),
            Self::Stationary | Self::Impossible(_) => None,
        }
    }
}

/// Encoders, pose sensor and constant ICR offsets of a hypothesis: the cheap part of a prediction.
#[derive(Clone, Copy, Debug)]
pub struct Instruments {
    /// From encoder speeds to belt speeds.
    pub drive: Drive,
    /// Mount and delay of the pose sensor.
    pub sensor: Sensor,
    /// Constant offset of the ICRs (x_l, x_r, y), m.
    pub offset: [f64; 3],
}

impl Instruments {
    /// Instruments of a hypothesis.
    pub fn of(hypothesis: &Hypothesis) -> Self {
        let model = Model::new(hypothesis.vehicle.clone(), hypothesis.effects.clone());
        Self { drive: *model.drive(), sensor: *model.sensor(), offset: hypothesis.offset }
    }
}

/// Whether an effect concerns sensors, gains and lags only: it does not enter the balance of
/// forces.
pub fn is_instrument(vehicle: &Vehicle, effect: &ActiveEffect) -> bool {
    let outside = |stage: &Stage| matches!(stage, Stage::Drive | Stage::Sense);
    effect.card().stages.iter().all(outside)
        && single(vehicle, effect).drive().slip_per_traction == 0.0
}

/// Whether an effect's forces depend on acceleration.
fn feels_inertia(vehicle: &Vehicle, effect: &ActiveEffect) -> bool {
    Transient::feels_inertia(&single(vehicle, effect))
}

impl Mechanics {
    /// The mechanics of a hypothesis for this evidence.
    pub fn new(hypothesis: &Hypothesis, evidence: &Evidence) -> Self {
        let new = Self::beside(None, hypothesis, evidence);
        new.in_time.forget_steps();
        new
    }

    /// Mechanics of a hypothesis. `before` is the mechanics of a similar hypothesis: where its
    /// inertial effects are about equal, its inertial departure is reused, since the error is of
    /// second order.
    pub fn beside(before: Option<&Self>, hypothesis: &Hypothesis, evidence: &Evidence) -> Self {
        let within = Within::reach(&evidence.settings().mechanics);
        Self::near(before, hypothesis, &[], evidence, within)
    }

    /// This mechanics of a hypothesis with the slopes of its departure by the free unknowns: itself
    /// where they are known, otherwise the departure is simulated at the hypothesis.
    pub fn with_slopes(
        &self,
        hypothesis: &Hypothesis,
        free: &[Unknown],
        evidence: &Evidence,
    ) -> Self {
        let InTime::Found { inertia, .. } = &self.in_time else { return self.clone() };
        let within = Within::the_way(&evidence.settings().mechanics);
        let inertia = Self::inertia_beside(Some(inertia), hypothesis, free, within);
        let in_time = self.in_time(Some(self), (free, within), hypothesis, evidence, inertia);
        in_time.forget_steps();
        Self { in_time, ..self.clone() }
    }

    /// Mechanics of a hypothesis during a fit: the inertial departure is extrapolated linearly from
    /// this one over any distance in the parameters with known slopes, as long as the others stay
    /// near.
    pub fn on_the_way(
        &self,
        hypothesis: &Hypothesis,
        free: &[Unknown],
        evidence: &Evidence,
    ) -> Self {
        let within = Within::the_way(&evidence.settings().mechanics);
        Self::near(Some(self), hypothesis, free, evidence, within)
    }

    fn near(
        before: Option<&Self>,
        hypothesis: &Hypothesis,
        free: &[Unknown],
        evidence: &Evidence,
        within: Within,
    ) -> Self {
        let known = before.and_then(|before| before.in_time.inertia());
        let inertia = Self::inertia_beside(known, hypothesis, free, within);
        Self::found(before, (free, within), hypothesis, evidence, inertia)
    }

    /// Inertial departure of a hypothesis beside that of a similar one, with slopes by the free
    /// unknowns.
    fn inertia_beside(
        known: Option<&InertiaNear>,
        hypothesis: &Hypothesis,
        free: &[Unknown],
        within: Within,
    ) -> impl FnOnce(Vec<ActiveEffect>, &Case) -> Result<InertiaNear, Impossible> {
        let delay = Instruments::of(hypothesis).sensor.delay;
        move |inert, case| {
            let free = free.iter().copied().filter(|by| has_slope(*by, case.model));
            let free: Vec<Unknown> = free.collect();
            Ok(InertiaNear::beside(known, inert, case, &free, delay, within)?)
        }
    }

    /// Mechanics of a hypothesis that differs by one step, as of a finite difference. The inertial
    /// departure, and its change by shear-stress laws, are extrapolated wherever possible: a jump
    /// by a new simulation would be divided by the step. Beside an impossible hypothesis there is
    /// none.
    pub fn varied(&self, hypothesis: &Hypothesis, evidence: &Evidence) -> Self {
        let inertia = |inert: Vec<ActiveEffect>, case: &Case| {
            let moved = match &self.in_time {
                InTime::Stationary => return Ok(InertiaNear::here(inert, case)?),
                InTime::Impossible(reason) => return Err(reason.clone()),
                InTime::Found { inertia, .. } => inertia.moved(&inert, case, Within::A_STEP),
            };
            moved.ok_or(Impossible::OtherRobot)
        };
        Self::found(Some(self), (&[], Within::A_STEP), hypothesis, evidence, inertia)
    }

    /// The mechanics of a hypothesis, with the departure by `inertia`. Its change by shear-stress
    /// laws is extrapolated from `before` as far as `within` allows; it has slopes by those
    /// unknowns of the laws that are free.
    fn found(
        before: Option<&Self>,
        (free, within): (&[Unknown], Within),
        hypothesis: &Hypothesis,
        evidence: &Evidence,
        inertia: impl FnOnce(Vec<ActiveEffect>, &Case) -> Result<InertiaNear, Impossible>,
    ) -> Self {
        let (vehicle, settings) = (&hypothesis.vehicle, &evidence.settings().mechanics);
        let mechanical = hypothesis.effects.iter().filter(|effect| !is_instrument(vehicle, effect));
        let (mut varying, mut constant) = (Vec::new(), Vec::new());
        for effect in mechanical.cloned() {
            match acts(vehicle, &effect, evidence) {
                Acts::Varying => varying.push(effect),
                Acts::Alike => constant.push(effect),
                Acts::Nowhere => {}
            }
        }
        let without_shear = |effects: &[ActiveEffect]| -> Effects {
            effects.iter().filter(|effect| !effect.card().shears()).cloned().collect()
        };
        let drive = Instruments::of(hypothesis).drive;
        let largest = largest(evidence);
        let model = coarse(vehicle, constant.iter().cloned().collect());
        let resembling = before.map(|before| &before.surface);
        let surface = Surface::new(&model, largest, settings.speed_range, resembling);
        let tracks = Arc::clone(evidence.tracks());
        let same = before.filter(|before| {
            before.surface.is(&surface)
                && before.drive == drive
                && Arc::ptr_eq(&before.tracks, &tracks)
        });
        let steady = match same {
            Some(same) => Arc::clone(&same.steady),
            None => Arc::new(steady(&surface, &drive, &tracks)),
        };
        let shear: Effects =
            constant.iter().filter(|effect| effect.card().shears()).cloned().collect();
        let simple = Arc::new(coarse(vehicle, without_shear(&constant)));
        let in_time = InTime::Stationary;
        let still = Self { surface, tracks, steady, drive, ground: None, in_time, simple, shear };
        // An impossible hypothesis needs no departures, which cost most where no forces balance.
        let unsolved = still.surface.unsolved();
        if unsolved > settings.max_unsolved_share {
            let share = (unsolved <= MAX_UNSOLVED_SAMPLE_SHARE).then_some(unsolved);
            return Self { in_time: InTime::Impossible(Impossible::Unbalanced { share }), ..still };
        }
        let ground = (!varying.is_empty()).then(|| {
            let mut effects = without_shear(&constant);
            for effect in varying {
                effects.insert(effect);
            }
            let with = coarse(vehicle, effects);
            let known = before.and_then(|before| before.ground.as_deref());
            let grounds = [&with, &*still.simple];
            Arc::new(ByGround::new(grounds, &still.surface, &drive, evidence, known))
        });
        let in_time = still.in_time(before, (free, within), hypothesis, evidence, inertia);
        Self { ground, in_time, ..still }
    }

    /// Departure of this robot from its stationary motion; see [`Self::found`].
    fn in_time(
        &self,
        before: Option<&Self>,
        (free, within): (&[Unknown], Within),
        hypothesis: &Hypothesis,
        evidence: &Evidence,
        inertia: impl FnOnce(Vec<ActiveEffect>, &Case) -> Result<InertiaNear, Impossible>,
    ) -> InTime {
        let Self { simple, drive, shear, surface, .. } = self;
        let vehicle = &hypothesis.vehicle;
        let inert = simple.effects().iter().filter(|effect| feels_inertia(vehicle, effect));
        let inert: Vec<ActiveEffect> = inert.cloned().collect();
        if inert.is_empty() || matches!(evidence.origin(), Origin::SteadyPoints(_)) {
            return InTime::Stationary;
        }
        let (largest, starts) = (largest(evidence), hypothesis.starts_in(evidence));
        let case = Case { vehicle, model: simple, surface, largest, drive, starts, evidence };
        match inertia(inert.clone(), &case) {
            Ok(inertia) => {
                let known = before.and_then(|before| before.in_time.sheared());
                let beside =
                    || ByShear::beside(known, shear, surface, (&inertia, &case), free, within);
                let sheared = (!shear.is_empty()).then(beside);
                InTime::Found { inertia, sheared }
            }
            // a step of a difference quotient without a slope changes nothing
            Err(reason) => match before {
                Some(before) if within.is_a_step() => before.in_time.clone(),
                _ => InTime::Impossible(reason),
            },
        }
    }

    /// Whether it departs in time from the stationary motion.
    pub fn has_departure(&self) -> bool {
        self.in_time.inertia().is_some()
    }

    /// Whether both inertial departures come from one transient simulation, and their changes by
    /// shear-stress laws from one solution.
    pub fn has_inertia_of(&self, other: &Self) -> bool {
        let inertia = [self, other].map(|one| one.in_time.inertia());
        let sheared = [self, other].map(|one| one.in_time.sheared());
        are_from_one(inertia, InertiaNear::is_from) && are_from_one(sheared, ByShear::is_from)
    }

    /// Departure of the twist (paper's frame) from the stationary one with which each run begins;
    /// none without inertia, or where all begin in stationary motion.
    pub fn starts(&self) -> Option<&[Twist]> {
        self.in_time.inertia().and_then(InertiaNear::starts)
    }

    /// Why the hypothesis is impossible; none where it is possible.
    pub fn failure(&self) -> Option<&Impossible> {
        match &self.in_time {
            InTime::Impossible(reason) => Some(reason),
            InTime::Stationary | InTime::Found { .. } => None,
        }
    }

    /// Whether forces depend on place, heading or time.
    pub fn knows_places(&self) -> bool {
        self.ground.is_some()
    }

    /// Predicted motion of each sample as reported by the pose sensor: forward (m), left (m), yaw
    /// (rad).
    pub fn predict(&self, instruments: &Instruments, evidence: &Evidence) -> Vec<Vector3<f64>> {
        let Instruments { drive, sensor, offset } = instruments;
        let steady = if *drive == self.drive {
            Cow::Borrowed(&*self.steady)
        } else {
            Cow::Owned(steady(&self.surface, drive, evidence.tracks()))
        };
        let samples = evidence.samples();
        let by_inertia = self.in_time.inertia();
        let departures =
            |of: &InertiaNear| of.departures(evidence.shared_samples(), drive, sensor.delay);
        let by_inertia = by_inertia.map(departures);
        let reported = sensor.reporting();
        (0..samples.len())
            .into_par_iter()
            .with_min_len(SAMPLES_PER_TASK)
            .map(|index| {
                let sample = &samples[index];
                let by_ground = self.ground.as_ref().map(|ground| ground.departures[index]);
                let by_inertia = by_inertia.as_ref().map(|departures| departures[index]);
                let departure = [by_ground, by_inertia].into_iter().flatten().reduce(|a, b| a + b);
                let departure = departure.map(|departure| seen_from(&departure, offset));
                let tracks = &evidence.tracks()[sample.run];
                let steady = &steady[sample.run];
                let sheared = self.in_time.sheared().map(|sheared| sheared.of_run(sample.run));
                let pose = motion_over(tracks, sample, sensor.delay, |reading| {
                    let mut twist = steady[reading].twist(offset);
                    if let Some(departure) = &departure {
                        twist += *departure;
                    }
                    if let Some(sheared) = sheared {
                        twist += seen_from(&sheared[reading], offset);
                    }
                    ros_twist_from_paper(&reported(&twist))
                });
                Vector3::new(pose.x, pose.y, pose.yaw)
            })
            .collect()
    }

    /// Derivative of the motion of each sample, as reported by the pose sensor, by each axis of the
    /// twist (paper's frame) with which its run begins; none without inertia, or where its
    /// simulation fails.
    pub fn by_starts(
        &self,
        instruments: &Instruments,
        evidence: &Evidence,
    ) -> Option<[Vec<Vector3<f64>>; 3]> {
        /// Step of a twist, m/s and rad/s: the motion over a sample is nearly linear in it.
        const STEP: f64 = 1e-4;
        let Instruments { sensor, offset, .. } = instruments;
        let samples = evidence.samples();
        let changes = self.in_time.inertia()?.changes_by_starts(samples, sensor.delay).ok()?;
        let turned = Sensor { yaw_rate_bias: 0.0, ..*sensor }.reporting();
        let moved = |(sample, change): (&Sample, &Twist)| {
            let [forward, left, yaw] = sample.motion.into();
            let before = Pose::new(forward, left, yaw);
            let change = ros_twist_from_paper(&turned(&seen_from(change, offset))) * STEP;
            let after = Pose::exp(&(before.log(sample.duration) + change), sample.duration);
            Vector3::new(after.x - forward, after.y - left, after.yaw - yaw) / STEP
        };
        Some(changes.each_ref().map(|changes| samples.iter().zip(changes).map(moved).collect()))
    }
}

/// Largest speed of a belt for which motions are tabulated, m/s.
fn largest(evidence: &Evidence) -> f64 {
    evidence.settings().mechanics.speed_headroom * evidence.fastest() * std::f64::consts::SQRT_2
}

/// Whether there is neither, or both are from one computation.
fn are_from_one<T>([here, there]: [Option<&T>; 2], is_from: impl Fn(&T, &T) -> bool) -> bool {
    match (here, there) {
        (Some(here), Some(there)) => is_from(here, there),
        (None, None) => true,
        _ => false,
    }
}

/// Stationary motion at each reading of each run.
fn steady(surface: &Surface, drive: &Drive, tracks: &[Vec<TrackSample>]) -> Vec<Vec<Steady>> {
    let belts = lagging(tracks, drive.time_constant);
    let motion = |reading: &TrackSample| surface.motion(drive.driven(reading.speeds(), reading.t));
    belts.par_iter().map(|run| run.iter().map(motion).collect()).collect()
}

/// Motion over a sample seen from its start, by the twist (REP-103) at each of its readings.
fn motion_over(
    tracks: &[TrackSample],
    sample: &Sample,
    delay: f64,
    twist: impl Fn(usize) -> Twist,
) -> Pose {
    let until = sample.start + sample.duration;
    let pieces = pieces(tracks, sample.start, until, delay);
    pieces.fold(Pose::default(), |pose, (reading, duration)| {
        pose.compose(&Pose::exp(&twist(reading), duration))
    })
}

/// A model with a resolution that suffices for noisy data.
fn coarse(vehicle: &Vehicle, effects: Effects) -> Model {
    Model::new(vehicle.clone(), effects).with_resolution(Resolution::Coarse)
}

/// The model of a vehicle with one effect alone.
pub(crate) fn single(vehicle: &Vehicle, effect: &ActiveEffect) -> Model {
    coarse(vehicle, std::iter::once(effect.clone()).collect())
}

/// A change of the twist, moved to the point that the ICR offset shifts to: δv = ω × r, with r the
/// offset in y and the mean offset in x. The difference of the x offsets does not move that point.
fn seen_from(twist: &Twist, [left, right, y]: &[f64; 3]) -> Twist {
    let middle = f64::midpoint(*left, *right);
    Twist { v_x: twist.v_x + y * twist.w, v_y: twist.v_y - middle * twist.w, w: twist.w }
}
