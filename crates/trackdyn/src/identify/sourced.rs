//! Where the numbers of an identification come from.

use crate::{IdentifySettings, Provenance, Recording, Vehicle};
use trackdyn_model::kinematics::Source;
use trackdyn_recording::Recording as Motion;

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
    pub(super) fn new(
        recording: &Recording,
        vehicle: &Vehicle,
        settings: &IdentifySettings,
    ) -> Self {
        let source = Source {
            vehicle: vehicle.name().to_owned(),
            fingerprint: recording.fingerprint().to_owned(),
            recording: Some(recording.name().to_owned()),
            ..recording.motion().map_or_else(Source::default, |motion| of_motion(recording, motion))
        };
        Self { source, gauge: vehicle.gauge(), force: settings.force }
    }

    /// These numbers with random draws of this seed.
    pub(super) fn with_seed(self, seed: u64) -> Self {
        Self { source: Source { seed: Some(seed), ..self.source }, ..self }
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
        ..Source::default()
    }
}
