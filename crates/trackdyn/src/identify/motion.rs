//! What a recording of motion says of the kinematic parameters.

use super::gyroscope::GyroscopeUse;
use super::sourced::{Fitted, Sourced};
use crate::{Gauge, Provenance};
use trackdyn_estimate::{Identification, Separation};
use trackdyn_model::kinematics::KinematicsFile;
use trackdyn_recording::Recording as Motion;

/// What a recording of motion says of the kinematic parameters.
#[derive(Clone, Debug)]
pub struct MotionFit {
    /// What was found, method by method.
    pub found: Identification,
    /// What the recording's gyroscope adds; none where it was not asked.
    pub gyroscope: Option<GyroscopeUse>,
    robot: String,
    vehicle_fingerprint: String,
    pub(super) sourced: Sourced,
}

impl MotionFit {
    pub(super) fn new(
        found: Identification,
        gyroscope: Option<GyroscopeUse>,
        motion: &Motion,
        gauge: &Gauge,
        sourced: Sourced,
    ) -> Self {
        let (robot, vehicle_fingerprint) =
            (motion.robot().to_owned(), gauge.fingerprint().to_owned());
        Self { found, gyroscope, robot, vehicle_fingerprint, sourced }
    }

    /// Gauge of the vehicle, m.
    pub fn gauge(&self) -> f64 {
        self.sourced.gauge
    }

    /// The robot, as the recording calls it.
    pub fn robot(&self) -> &str {
        &self.robot
    }

    pub(super) fn vehicle_fingerprint(&self) -> &str {
        &self.vehicle_fingerprint
    }

    /// The kinematics files of the fits, where the recording determines them and nothing
    /// contradicts them, or where the settings force them.
    pub(super) fn files(&self, provenance: &Provenance) -> [Option<KinematicsFile>; 2] {
        self.found.fits.each_ref().map(|fit| {
            let estimate = fit.least_squares.as_ref().ok().filter(|_| fit.doubts.is_empty())?;
            let fitted = Fitted {
                parameters: estimate.parameters,
                free: fit.free,
                covariance: estimate.covariance_of_parameters(),
            };
            self.sourced.file(&fitted, &fit.contradictions, provenance)
        })
    }

    /// The distance of the ICRs alone, where that is all that the recording determines.
    pub(super) fn separation(&self) -> Option<&Separation> {
        self.found.separation.as_ref()
    }
}
