//! What is replayed, and with which parameters.

use super::{DrivingOptions, GaugeOptions};
use crate::changes::say_doubtful;
use crate::gyroscope::say_gyroscopes;
use crate::stderr::{note, warn};
use clap::{ArgGroup, Args};
use std::error::Error;
use std::path::PathBuf;
use trackdyn::{Odometry, OdometrySettings, Parameters, odometry};

/// A recording, parameters to replay it with, and the gauge of the ideal drive.
#[derive(Args)]
#[command(group(ArgGroup::new("known").required(true).args(["vehicle", "gauge"])))]
pub struct ReplayOptions {
    /// Parameters to replay with (schema trackdyn.kinematics/1); repeatable
    #[arg(long, value_name = "FILE")]
    kinematics: Vec<PathBuf>,
    /// Correct the yaw of the poses by the recording's gyroscope
    #[arg(long)]
    gyroscope: bool,
    #[command(flatten)]
    driving: DrivingOptions,
    #[command(flatten)]
    gauge: GaugeOptions,
}

impl ReplayOptions {
    /// Replays, and says what is to be known of it.
    ///
    /// # Errors
    /// A message that names the file, line and key, or the option.
    pub fn replay(&self) -> Result<Odometry, Box<dyn Error>> {
        let gauge = self.gauge.expect_gauge()?;
        let parameters = self.kinematics.iter().map(Parameters::open);
        let parameters = parameters.collect::<Result<Vec<_>, _>>()?;
        for doubtful in parameters.iter().filter(|of| of.is_doubtful()) {
            say_doubtful(doubtful.name());
        }
        let recording = self.driving.recording()?;
        let settings = OdometrySettings {
            part: self.driving.part(),
            tau: self.driving.tau,
            gyroscope: self.gyroscope,
        };
        let found = odometry(&recording, &gauge, &parameters, &settings)?;
        if let Some(reason) = found.clock.reason() {
            note(format_args!("{reason}; the clock offset is taken as 0 (set it with --tau)"));
        }
        for contradiction in &found.contradictions {
            warn(format_args!("{contradiction}"));
        }
        say_gyroscopes(found.recording().gyroscope());
        for fitted in found.fitted_to_it() {
            note(format_args!(
                "{} was fitted to some of these runs, which makes its errors look smaller (choose \
                 others with --runs or --time)",
                fitted.name()
            ));
        }
        if found.is_physics_fitted_to_it() {
            note(format_args!(
                "the vehicle was corrected by some of these runs, which makes the errors of its \
                 physics look smaller (choose others with --runs or --time)"
            ));
        }
        if let Some(reason) = found.physics_stopped() {
            note(format_args!("{reason}; the forces on the vehicle are not replayed"));
        }
        let left_out = found.comparison.left_out.len();
        if left_out > 0 {
            note(format_args!(
                "{left_out} runs left out, whose poses lie outside the time of their track speeds"
            ));
        }
        Ok(found)
    }
}
