//! What a recording of motion says of the kinematic parameters.

use super::document;
use crate::{Provenance, Recording, Vehicle};
use trackdyn_estimate::identification::Fit;
use trackdyn_estimate::{Free, Identification};
use trackdyn_model::kinematics::{KinematicsFile, Source};
use trackdyn_recording::Recording as Motion;

/// What a recording of motion says of the kinematic parameters.
#[derive(Clone, Debug)]
pub struct MotionFit {
    /// What was found, method by method.
    pub found: Identification,
    source: Source,
    robot: String,
    vehicle_fingerprint: String,
    gauge: f64,
}

impl MotionFit {
    pub(super) fn new(
        found: Identification,
        recording: &Recording,
        motion: &Motion,
        vehicle: &Vehicle,
        seed: u64,
    ) -> Self {
        let source = Source {
            vehicle: vehicle.name().to_owned(),
            fingerprint: motion.fingerprint().to_owned(),
            pose_fingerprint: Some(motion.pose_fingerprint().to_owned()),
            recording: Some(motion.name().to_owned()),
            runs: Some(motion.run_list().to_string()),
            time_s: recording.time(),
            seed: Some(seed),
            ..Source::default()
        };
        Self {
            found,
            source,
            robot: motion.robot().to_owned(),
            vehicle_fingerprint: vehicle.fingerprint(),
            gauge: vehicle.gauge(),
        }
    }

    /// Gauge of the vehicle, m.
    pub fn gauge(&self) -> f64 {
        self.gauge
    }

    /// The robot, as the recording calls it.
    pub fn robot(&self) -> &str {
        &self.robot
    }

    /// The text of `identification.toml` (schema `trackdyn.identification/1`).
    pub fn to_toml(&self, provenance: &Provenance) -> String {
        document::text(self, &self.source(provenance))
    }

    pub(super) fn vehicle_fingerprint(&self) -> &str {
        &self.vehicle_fingerprint
    }

    /// The kinematics files of the fits, where the recording determines them.
    pub(super) fn files(&self, provenance: &Provenance) -> [Option<KinematicsFile>; 2] {
        let source = self.source(provenance);
        self.found.fits.each_ref().map(|fit| file(fit, self.gauge, &source))
    }

    /// Where the numbers come from.
    fn source(&self, provenance: &Provenance) -> Source {
        let Provenance { command, version } = provenance.clone();
        Source { command, version, ..self.source.clone() }
    }
}

/// The file of a fit, where the recording determines it.
fn file(fit: &Fit, gauge: f64, source: &Source) -> Option<KinematicsFile> {
    let estimate = fit.least_squares.as_ref().ok().filter(|_| fit.doubts.is_empty())?;
    let rows = estimate.covariance_of_parameters();
    let with_alphas = fit.free == Free::IcrsAndAlphas;
    let kinematics = estimate.parameters.kinematics();
    Some(KinematicsFile::of_fit(&kinematics, gauge, with_alphas, rows, source.clone()))
}
