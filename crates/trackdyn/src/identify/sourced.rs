//! Where the numbers of an identification come from.

use crate::{Gauge, IdentifySettings, Provenance, Recording};
use trackdyn_estimate::{Contradiction, Free, Interval, Parameters, Separation};
use trackdyn_model::kinematics::{BagSource, KinematicsFile, SeparationFile, Source};
use trackdyn_recording::{BagNames, Recording as Motion};

/// Parameters that were fitted, with the rows of their covariance.
pub(super) struct Fitted {
    pub(super) parameters: Parameters,
    pub(super) free: Free,
    pub(super) covariance: Vec<Vec<f64>>,
}

/// Where the numbers of an identification come from, and what they are judged by.
#[derive(Clone, Debug)]
pub(super) struct Sourced {
    source: Source,
    /// Gauge of the vehicle, m.
    pub(super) gauge: f64,
    /// Whether what is contradicted is given as well.
    pub(super) force: bool,
}

impl Sourced {
    /// The source of what is found in a recording.
    pub(super) fn new(recording: &Recording, gauge: &Gauge, settings: &IdentifySettings) -> Self {
        let source = Source {
            vehicle: gauge.vehicle().to_owned(),
            fingerprint: recording.fingerprint().to_owned(),
            recording: Some(recording.name().to_owned()),
            ..recording.motion().map_or_else(Source::default, |motion| of_motion(recording, motion))
        };
        Self { source, gauge: gauge.metres(), force: settings.force }
    }

    /// These numbers with random draws of this seed.
    pub(super) fn with_seed(self, seed: u64) -> Self {
        Self { source: Source { seed: Some(seed), ..self.source }, ..self }
    }

    /// The file of a fit; none of one that something contradicts, unless it is forced.
    pub(super) fn file(
        &self,
        fit: &Fitted,
        contradictions: &[Contradiction],
        provenance: &Provenance,
    ) -> Option<KinematicsFile> {
        let doubtful = !contradictions.is_empty();
        if doubtful && !self.force {
            return None;
        }
        let Fitted { parameters, free, covariance } = fit;
        let (kinematics, with_alphas) = (parameters.kinematics(), *free == Free::IcrsAndAlphas);
        let (rows, source) = (covariance.clone(), self.source(provenance));
        let mut file = KinematicsFile::of_fit(&kinematics, self.gauge, with_alphas, rows, source);
        file.doubtful = doubtful;
        Some(file)
    }

    /// The file of a distance of the ICRs.
    pub(super) fn separation(&self, found: &Separation, provenance: &Provenance) -> SeparationFile {
        let Interval { value, low, high, .. } = found.gap;
        SeparationFile::new(value, [low, high], self.gauge, self.source(provenance))
    }

    /// The source, at the request of a command.
    pub(super) fn source(&self, provenance: &Provenance) -> Source {
        let Provenance { command, version } = provenance.clone();
        Source { command, version, ..self.source.clone() }
    }
}

/// What only recordings of motion have.
fn of_motion(recording: &Recording, motion: &Motion) -> Source {
    Source {
        pose_fingerprint: Some(motion.pose_fingerprint().to_owned()),
        runs: Some(motion.run_list().to_string()),
        time_s: recording.time(),
        bag: motion.source().names.as_deref().map(of_names),
        ..Source::default()
    }
}

/// What a bag calls the parts of the robot.
fn of_names(names: &BagNames) -> BagSource {
    let BagNames { joints, wheel_radius, track_topics, pose_topic, parent_frame, child_frame } =
        names.clone();
    BagSource {
        left_joints: joints.left,
        right_joints: joints.right,
        wheel_radius_m: wheel_radius,
        track_topics,
        pose_topic,
        parent_frame,
        child_frame,
    }
}
