//! What sensors report of a motion.
//!
//! A sensor sees the true motion at its own moments, with its own errors, and stamps what it saw
//! with a delay. None of them knows how the motion came about.

mod check;
mod encoder;
mod file;
mod imu;
mod pose;
mod preset;
mod stamps;
mod walk;

pub use encoder::{Encoder, StampAt};
pub use imu::Imu;
pub use pose::{Dropout, Mount, Outlier, PoseFrame, PoseSensor, Walk, White};
pub use preset::Preset;

use crate::Error;
use trackdyn_core::Trajectory;
use trackdyn_recording::{Recording, Source, UncheckedRun};

/// The sensors of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensors {
    /// Name for titles and outputs.
    pub name: String,
    /// Encoders of both tracks.
    pub encoder: Encoder,
    /// What measures poses.
    pub pose: PoseSensor,
    /// An inertial sensor, where there is one.
    pub imu: Option<Imu>,
}

/// The motion as each of the sensors sees it, where they do not see the same.
#[derive(Clone, Copy, Debug)]
pub struct Views<'a> {
    /// Speeds at the encoders, which belts may not follow.
    pub encoders: &'a Trajectory,
    /// The body's motion.
    pub body: &'a Trajectory,
    /// The motion as a pose sensor takes it to be, before noise.
    pub poses: &'a Trajectory,
}

impl Default for Sensors {
    /// A robot in a laboratory: fine encoders, laser odometry, a small IMU.
    fn default() -> Self {
        Self {
            name: "laboratory".to_owned(),
            encoder: Encoder::default(),
            pose: PoseSensor::default(),
            imu: Some(Imu::default()),
        }
    }
}

impl Sensors {
    /// Clock offset τ of their recordings, s, as [`hold`](trackdyn_recording::hold) defines it.
    ///
    /// # Law
    /// A pose with the stamp t shows the moment t − d_p. A reading with the stamp t is held from t
    /// to t + T, and shows what happened from t − d_e − s to t − d_e − s + T; s = T where a reading
    /// is stamped at the end of its interval, else s = 0. So τ = d_p − d_e − s.
    pub fn clock_offset(&self) -> f64 {
        let shown_before = match self.encoder.stamp_at {
            StampAt::Start => 0.0,
            StampAt::End => self.encoder.interval,
        };
        self.pose.delay - self.encoder.delay - shown_before
    }

    /// The run that they report of one motion. It depends on the motion, the seed and the number of
    /// the run only.
    ///
    /// # Errors
    /// As [`Sensors::observe_views`].
    pub fn observe(
        &self,
        run: i64,
        trajectory: &Trajectory,
        seed: u64,
    ) -> Result<UncheckedRun, Error> {
        let views = Views { encoders: trajectory, body: trajectory, poses: trajectory };
        self.observe_views(run, &views, seed)
    }

    /// The run that they report where each sees its own motion.
    ///
    /// # Errors
    /// [`Error::NoMotion`] for a trajectory without moments, [`Error::Option`] for values that no
    /// sensor has.
    pub fn observe_views(&self, run: i64, views: &Views, seed: u64) -> Result<UncheckedRun, Error> {
        self.check().map_err(|problem| {
            Error::option(problem.key, &problem.value, problem.expected.to_owned())
        })?;
        let Views { encoders, body, poses } = views;
        let span = body.span().ok_or(Error::NoMotion { run })?;
        if encoders.span().is_none() || poses.span().is_none() {
            return Err(Error::NoMotion { run });
        }
        let imu = self.imu.as_ref();
        Ok(UncheckedRun {
            id: run,
            tracks: self.encoder.observe(run, encoders, seed).into(),
            poses: self.pose.observe(run, poses, span, seed).into(),
            imu: imu.map(|imu| imu.observe(run, body, span, seed)).unwrap_or_default().into(),
        })
    }

    /// The recording of runs, each with its number.
    ///
    /// # Errors
    /// Those of [`Sensors::observe`]; [`Error::Recording`] where no run is long enough for two
    /// poses.
    pub fn record<'a>(
        &self,
        name: &str,
        robot: &str,
        runs: impl IntoIterator<Item = (i64, &'a Trajectory)>,
        seed: u64,
    ) -> Result<Recording, Error> {
        let runs = runs.into_iter().map(|(run, trajectory)| self.observe(run, trajectory, seed));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        Ok(Recording::new(name, robot, runs, Source::computed(), Vec::new())?)
    }
}
