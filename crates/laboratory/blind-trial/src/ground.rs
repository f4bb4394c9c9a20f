//! Driving on the independent ground.

use crate::driving::Drive;
use crate::failure::Failure;
use rayon::prelude::*;
use trackdyn_core::{Plant, Trajectory};
use trackdyn_drive::schedules::as_commanded;
use trackdyn_drive::sensors::{Preset, Sensors, Views};
use trackdyn_estimate::Observations;
use trackdyn_estimate::SegmentOptions;
use trackdyn_model::{RunningGear, Vehicle};
use trackdyn_recording::{Recording, Source, UncheckedRun};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup};

/// How finely the ground is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fineness {
    /// For recordings: the independent ground's own settings; prints of wheels are short and take
    /// fewer shoes for the same error.
    Recording,
    /// For signatures: the error of few shoes cancels between drives with and without an effect.
    Signature,
}

impl Fineness {
    fn setup(self, vehicle: &Vehicle) -> Setup {
        let tracks = matches!(vehicle.running_gear, RunningGear::Track { .. });
        let usual = Setup::default();
        match (self, tracks) {
            (Self::Recording, true) => usual,
            (Self::Recording, false) => Setup { strips: 4, shoes: 14, ..usual },
            (Self::Signature, true) => {
                Setup { strips: 3, shoes: 14, longest_step: 0.02, speed_change: 0.01, ..usual }
            }
            (Self::Signature, false) => {
                Setup { strips: 2, shoes: 6, longest_step: 0.02, speed_change: 0.01, ..usual }
            }
        }
    }
}

/// Largest clock offset that may be fitted to a signature, s; runs begin and end with a longer
/// rest.
const MAX_CLOCK_OFFSET: f64 = 0.4;

/// A run as it was driven.
pub(crate) struct Driven {
    /// Its number.
    pub(crate) id: i64,
    /// What the encoders see.
    pub(crate) encoders: Trajectory,
    /// The body's motion.
    pub(crate) body: Trajectory,
    /// What the pose sensor takes it for, before noise.
    pub(crate) poses: Trajectory,
}

/// A robot with what acts on it.
pub(crate) struct Ground<'a> {
    pub(crate) vehicle: &'a Vehicle,
    pub(crate) active: Vec<ActiveMechanism>,
    pub(crate) fineness: Fineness,
    /// Seed of the shoes' places.
    pub(crate) seed: u64,
}

impl Ground<'_> {
    /// Adds one more mechanism.
    pub(crate) fn and(&self, mechanism: ActiveMechanism) -> Self {
        let mut active = self.active.clone();
        active.push(mechanism);
        Self { vehicle: self.vehicle, active, ..*self }
    }

    /// Drives all runs, each from rest.
    pub(crate) fn drive(&self, runs: &[Drive]) -> Result<Vec<Driven>, Failure> {
        runs.par_iter().map(|run| self.drive_one(run)).collect()
    }

    fn drive_one(&self, run: &Drive) -> Result<Driven, Failure> {
        let [start_time, _] = run.schedule.span();
        let seed = self.seed.wrapping_add(run.id.cast_unsigned());
        let setup =
            Setup { start: run.start, start_time, seed, ..self.fineness.setup(self.vehicle) };
        let mut robot = Robot::new(self.vehicle, &self.active, &setup)?;
        let body = robot.follow(&run.schedule)?;
        let poses = robot.report(&body);
        Ok(Driven { id: run.id, encoders: as_commanded(&run.schedule, &body), body, poses })
    }

    /// What perfect sensors with the intervals of these would show of the runs, segment by segment.
    pub(crate) fn observe(
        &self,
        runs: &[Drive],
        sensors: &Sensors,
    ) -> Result<Observations, Failure> {
        observations(&self.drive(runs)?, sensors)
    }
}

/// Segments of driven runs without noise.
pub(crate) fn observations(driven: &[Driven], sensors: &Sensors) -> Result<Observations, Failure> {
    let mut perfect = Preset::Perfect.sensors();
    perfect.encoder.interval = sensors.encoder.interval;
    perfect.pose.interval = sensors.pose.interval;
    perfect.imu = None;
    let runs = seen(driven, &perfect, 0)?;
    let recording = Recording::new("signature", "robot", runs, Source::computed(), Vec::new())?;
    let options = SegmentOptions { tau_margin: MAX_CLOCK_OFFSET, ..SegmentOptions::default() };
    Ok(Observations::new(&recording, &options))
}

/// What sensors report of driven runs.
pub(crate) fn seen(
    driven: &[Driven],
    sensors: &Sensors,
    seed: u64,
) -> Result<Vec<UncheckedRun>, Failure> {
    let runs = driven.iter().map(|run| {
        let views = Views { encoders: &run.encoders, body: &run.body, poses: &run.poses };
        Ok(sensors.observe_views(run.id, &views, seed)?)
    });
    runs.collect()
}
