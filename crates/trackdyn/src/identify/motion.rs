//! What a recording of motion says of the kinematic parameters.

use super::document;
use super::sourced::Sourced;
use crate::{Provenance, Vehicle};
use trackdyn_estimate::{Free, Identification, Interval};
use trackdyn_model::kinematics::{KinematicsFile, SeparationFile};
use trackdyn_recording::Recording as Motion;

/// What a recording of motion says of the kinematic parameters.
#[derive(Clone, Debug)]
pub struct MotionFit {
    /// What was found, method by method.
    pub found: Identification,
    robot: String,
    vehicle_fingerprint: String,
    pub(super) sourced: Sourced,
}

impl MotionFit {
    pub(super) fn new(
        found: Identification,
        motion: &Motion,
        vehicle: &Vehicle,
        sourced: Sourced,
    ) -> Self {
        let (robot, vehicle_fingerprint) = (motion.robot().to_owned(), vehicle.fingerprint());
        Self { found, robot, vehicle_fingerprint, sourced }
    }

    /// Gauge of the vehicle, m.
    pub fn gauge(&self) -> f64 {
        self.sourced.gauge
    }

    /// The robot, as the recording calls it.
    pub fn robot(&self) -> &str {
        &self.robot
    }

    /// The text of `identification.toml` (schema `trackdyn.identification/1`).
    pub fn to_toml(&self, provenance: &Provenance) -> String {
        document::text(self, &self.sourced.source(provenance))
    }

    pub(super) fn vehicle_fingerprint(&self) -> &str {
        &self.vehicle_fingerprint
    }

    /// The kinematics files of the fits, where the recording determines them and nothing
    /// contradicts them, or where the settings force them.
    pub(super) fn files(&self, provenance: &Provenance) -> [Option<KinematicsFile>; 2] {
        let source = self.sourced.source(provenance);
        self.found.fits.each_ref().map(|fit| {
            let estimate = fit.least_squares.as_ref().ok().filter(|_| fit.doubts.is_empty())?;
            let doubtful = !fit.contradictions.is_empty();
            if doubtful && !self.sourced.force {
                return None;
            }
            let rows = estimate.covariance_of_parameters();
            let with_alphas = fit.free == Free::IcrsAndAlphas;
            let kinematics = estimate.parameters.kinematics();
            let of = source.clone();
            let mut file =
                KinematicsFile::of_fit(&kinematics, self.sourced.gauge, with_alphas, rows, of);
            file.doubtful = doubtful;
            Some(file)
        })
    }

    /// The distance of the ICRs alone, where that is all that the recording determines.
    pub(super) fn separation(&self, provenance: &Provenance) -> Option<SeparationFile> {
        let is_contradicted = self.found.fits.iter().any(|fit| !fit.contradictions.is_empty());
        let found = self.found.separation.as_ref().ok().filter(|_| !is_contradicted)?;
        let Interval { value, low, high, .. } = found.gap;
        Some(SeparationFile::new(
            value,
            [low, high],
            self.sourced.gauge,
            self.sourced.source(provenance),
        ))
    }
}
