//! What a hypothesis predicts of the evidence.
//!
//! The prediction starts each sample at its observed pose and moves the body with the recorded
//! track speeds.
//!
//! # Law
//! The twist is that of the stationary motion, plus two departures that are small where they are at
//! all:
//! - of ground that changes with place, heading or time: the stationary motion there less the one
//!   without,
//! - of inertia: the motion in time less the stationary one, over the sample.
//!
//! # Assumes
//! The departures are found without the laws that change the shear stress, which need a quadrature
//! per solve. What these change in that by ground is a product of two small things; what they
//! change in that by inertia is found from it in a few steps. Where no motion in time goes through,
//! that of a hypothesis that resembles this one stands in: the ticks of a coarse counter may tip a
//! high robot over that never was near to it.

mod belts;
mod ground;
mod inertia;
mod sheared;

use crate::evidence::{Evidence, Origin, Sample};
use crate::hypothesis::{Hypothesis, Unknown};
use crate::surface::{Steady, Surface};
use belts::lagging;
use ground::{Acts, acts, by_ground};
use inertia::{Case, InertiaNear, Within, has_slope};
use nalgebra::Vector3;
use rayon::prelude::*;
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

/// Samples that one task predicts or solves.
const TASK: usize = 64;

/// The expensive part of a prediction: all that does not hang on sensors, gains and lags of the
/// drive, and constant offsets of the ICRs.
#[derive(Clone)]
pub struct Mechanics {
    surface: Surface,
    /// The stationary motion at each reading, of belts that follow the encoders as `drive` says.
    steady: Arc<Vec<Vec<Steady>>>,
    drive: Drive,
    /// What changing ground adds to the twist during each sample, paper's frame.
    ground: Option<Arc<Vec<Twist>>>,
    /// What inertia adds.
    in_time: InTime,
    /// The laws of the shear stress.
    shear: Vec<ActiveEffect>,
}

/// What inertia adds to the stationary motion.
#[derive(Clone)]
enum InTime {
    /// Nothing: no effect stands against acceleration, or the evidence has none.
    Stationary,
    /// What was found for this robot, or near it.
    Found {
        /// What is added without the laws of the shear stress.
        inertia: InertiaNear,
        /// What these laws change in that, at each reading; none where there are none, or where
        /// what it was taken from knew no inertia.
        sheared: Option<Arc<Vec<Vec<Twist>>>>,
    },
    /// What was found for another robot, without laws of the shear stress: no motion in time goes
    /// through with this one.
    OfAnother(InertiaNear),
    /// The hypothesis cannot be: no forces balance over a good part of the speeds, or no motion in
    /// time goes through with it.
    Impossible(String),
}

impl InTime {
    /// What is added without the laws of the shear stress; none where nothing is.
    fn inertia(&self) -> Option<&InertiaNear> {
        match self {
            Self::Found { inertia, .. } | Self::OfAnother(inertia) => Some(inertia),
            Self::Stationary | Self::Impossible(_) => None,
        }
    }

    /// What laws of the shear stress change in that, at each reading.
    fn sheared(&self) -> Option<&Arc<Vec<Vec<Twist>>>> {
        match self {
            Self::Found { sheared, .. } => sheared.as_ref(),
            Self::Stationary | Self::OfAnother(_) | Self::Impossible(_) => None,
        }
    }
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

/// Whether an effect says something of sensors, gains and lags alone: no balance of forces knows
/// it.
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
        Self::found(None, None, hypothesis, evidence, InertiaNear::here)
    }

    /// Mechanics where `before` is the mechanics of a hypothesis that resembles it, and some
    /// numbers are free: where the effects of inertia are about the same, what these add is taken
    /// from there, for its change is a product of two small things.
    pub fn beside(
        before: Option<&Self>,
        hypothesis: &Hypothesis,
        free: &[Unknown],
        evidence: &Evidence,
    ) -> Self {
        Self::near(
            before,
            hypothesis,
            free,
            evidence,
            Within::reach(&evidence.settings().mechanics),
        )
    }

    /// The mechanics of a hypothesis on the way of a fit: what inertia adds is taken from here,
    /// however far what it comes from has moved, as long as the rest resembles this one.
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
        Self::found(before, None, hypothesis, evidence, |inert, case| {
            let known = before.and_then(|before| before.in_time.inertia());
            let free = free.iter().copied().filter(|by| has_slope(*by, case.model));
            let free: Vec<Unknown> = free.collect();
            let delay = Instruments::of(hypothesis).sensor.delay;
            InertiaNear::beside(known, inert, case, &free, delay, within)
        })
    }

    /// Mechanics of a hypothesis that differs by a step, be it that of a difference quotient: what
    /// inertia adds is taken from here wherever it can be, for what it jumps by elsewhere would be
    /// divided by the step.
    ///
    /// What laws of the shear stress change in that stays too, unless it is one of these that
    /// differs.
    pub fn varied(&self, hypothesis: &Hypothesis, evidence: &Evidence) -> Self {
        let inertia = |inert: Vec<ActiveEffect>, case: &Case| {
            let moved = match &self.in_time {
                InTime::Stationary | InTime::Impossible(_) => {
                    return InertiaNear::here(inert, case);
                }
                InTime::Found { inertia, .. } => inertia.moved(&inert, case, Within::A_STEP),
                InTime::OfAnother(_) => None,
            };
            moved.ok_or_else(|| "found for another robot".to_owned())
        };
        Self::found(Some(self), Some(self), hypothesis, evidence, inertia)
    }

    /// `kept` lends what laws of the shear stress change in inertia, where these are the same.
    fn found(
        before: Option<&Self>,
        kept: Option<&Self>,
        hypothesis: &Hypothesis,
        evidence: &Evidence,
        inertia: impl FnOnce(Vec<ActiveEffect>, &Case) -> Result<InertiaNear, String>,
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
        let largest = settings.speed_headroom * evidence.fastest() * std::f64::consts::SQRT_2;
        let model = coarse(vehicle, constant.iter().cloned().collect());
        let resembling = before.map(|before| &before.surface);
        let surface = Surface::new(&model, largest, settings.speed_range, resembling);
        let steady = Arc::new(steady(&surface, &drive, evidence.tracks()));
        let shear: Vec<ActiveEffect> =
            constant.iter().filter(|effect| effect.card().shears()).cloned().collect();
        let still =
            Self { surface, steady, drive, ground: None, in_time: InTime::Stationary, shear };
        // What cannot be needs no departures, which cost most where no forces balance.
        if let Some(reason) = unbalanced(&still.surface, settings.max_unsolved_share) {
            return Self { in_time: InTime::Impossible(reason), ..still };
        }
        let simple = coarse(vehicle, without_shear(&constant));
        let ground = (!varying.is_empty()).then(|| {
            let mut effects = without_shear(&constant);
            for effect in varying {
                effects.insert(effect);
            }
            let with = coarse(vehicle, effects);
            Arc::new(by_ground(&with, &simple, &still.surface, &drive, evidence))
        });
        let inert = simple.effects().iter().filter(|effect| feels_inertia(vehicle, effect));
        let inert: Vec<ActiveEffect> = inert.cloned().collect();
        if inert.is_empty() || matches!(evidence.origin(), Origin::SteadyPoints(_)) {
            return Self { ground, ..still };
        }
        let case = Case { vehicle, model: &simple, largest, drive: &drive, evidence };
        // Where no motion in time goes through, that of a hypothesis that resembles this one is
        // taken.
        let known = before.and_then(|before| before.in_time.inertia());
        let in_time = match (inertia(inert, &case), known) {
            (Ok(inertia), _) => {
                let sheared = still.sheared(kept, &inertia, &case);
                InTime::Found { inertia, sheared }
            }
            (Err(_), Some(known)) => InTime::OfAnother(known.unmoved()),
            (Err(reason), None) => InTime::Impossible(reason),
        };
        Self { ground, in_time, ..still }
    }

    /// What the laws of the shear stress change in what inertia adds: as it was `kept` where they
    /// are the same.
    fn sheared(
        &self,
        kept: Option<&Self>,
        inertia: &InertiaNear,
        case: &Case,
    ) -> Option<Arc<Vec<Vec<Twist>>>> {
        let kept = kept.filter(|kept| kept.shear == self.shear);
        match kept.map(|kept| &kept.in_time) {
            Some(InTime::Found { sheared, .. }) => sheared.clone(),
            Some(InTime::Stationary | InTime::Impossible(_)) => None,
            Some(InTime::OfAnother(_)) | None => (!self.shear.is_empty())
                .then(|| Arc::new(inertia.sheared(&self.shear, &self.surface, case))),
        }
    }

    /// Whether what inertia adds comes from the same motion in time.
    pub fn has_inertia_of(&self, other: &Self) -> bool {
        match (self.in_time.inertia(), other.in_time.inertia()) {
            (Some(here), Some(there)) => here.is_from(there),
            (None, None) => true,
            _ => false,
        }
    }

    /// Why the hypothesis cannot be: part of the contact lifts, or no motion balances the forces,
    /// over a good part of the speeds, or no motion in time goes through. None where it can.
    pub fn failure(&self) -> Option<&str> {
        match &self.in_time {
            InTime::Impossible(reason) => Some(reason),
            InTime::Stationary | InTime::Found { .. } | InTime::OfAnother(_) => None,
        }
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
                let by_inertia = self
                    .in_time
                    .inertia()
                    .map(|inertia| inertia.departure(index, sample, drive, sensor.delay));
                let departure = [by_ground, by_inertia].into_iter().flatten().reduce(|a, b| a + b);
                let departure = departure.map(|departure| seen_from(&departure, offset));
                let tracks = &evidence.tracks()[sample.run];
                let steady = &steady[sample.run];
                let sheared = self.in_time.sheared().map(|departures| &departures[sample.run]);
                let pose = motion_over(tracks, sample, sensor.delay, |reading| {
                    let mut twist = steady[reading].twist(offset);
                    if let Some(departure) = &departure {
                        twist += *departure;
                    }
                    if let Some(sheared) = sheared {
                        twist += seen_from(&sheared[reading], offset);
                    }
                    ros_twist_from_paper(&sensor.reported(&twist))
                });
                Vector3::new(pose.x, pose.y, pose.yaw)
            })
            .collect()
    }
}

/// Why no robot moves so that has these stationary motions, at more than this share of the speeds;
/// none where one may.
fn unbalanced(surface: &Surface, most: f64) -> Option<String> {
    let share = surface.unsolved();
    (share > most).then(|| {
        format!(
            "at {:.0} % of the speeds part of the contact lifts or no forces balance",
            100.0 * share
        )
    })
}

/// The stationary motion at each reading of each run.
fn steady(surface: &Surface, drive: &Drive, tracks: &[Vec<TrackSample>]) -> Vec<Vec<Steady>> {
    let belts = lagging(tracks, drive.time_constant);
    let motion = |reading: &TrackSample| surface.motion(drive.driven(reading.speeds()));
    belts.par_iter().map(|run| run.iter().map(motion).collect()).collect()
}

/// The motion over a sample, seen from its start, with the twist (REP-103) at each reading that it
/// holds.
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

/// A robot as finely as noisy data can tell.
fn coarse(vehicle: &Vehicle, effects: Effects) -> Model {
    Model::new(vehicle.clone(), effects).with_resolution(Resolution::Coarse)
}

fn single(vehicle: &Vehicle, effect: &ActiveEffect) -> Model {
    coarse(vehicle, std::iter::once(effect.clone()).collect())
}

/// What a change of the twist is at the point from which the ICRs have this offset: δv = ω × r,
/// with y for all of them and the mean of the x as r. The rest of the offset is no matter of where
/// one looks from.
fn seen_from(twist: &Twist, [left, right, y]: &[f64; 3]) -> Twist {
    let middle = f64::midpoint(*left, *right);
    Twist { v_x: twist.v_x + y * twist.w, v_y: twist.v_y - middle * twist.w, w: twist.w }
}
