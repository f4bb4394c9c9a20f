//! A recording taken apart and restored.

use super::{PointsTable, Recording, Seen};
use crate::Error;
use std::path::PathBuf;
use trackdyn_recording::{OperatingPoints, Recording as Motion, Warning, recording};

/// All that a recording holds, for programs that keep it in a form of their own, such as a pickle.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// What was seen.
    pub seen: KeptSeen,
    /// Path as given; none where it was computed.
    pub path: Option<PathBuf>,
    /// Time of each run that is left of it, s; none: all of it.
    pub time: Option<[f64; 2]>,
}

/// What was seen.
#[derive(Clone, Debug, PartialEq)]
pub enum KeptSeen {
    /// A recording of motion.
    Motion(recording::Kept),
    /// A table of steady operating points, its path and its fingerprint.
    Points(OperatingPoints, PathBuf, String),
}

impl Recording {
    /// What it holds. A correction by its gyroscope is not part of it.
    pub fn keep(&self) -> Kept {
        let seen = match &self.seen {
            Seen::Motion(motion) => KeptSeen::Motion(motion.keep()),
            Seen::Points(table) => {
                let (path, fingerprint) = (table.path.clone(), table.fingerprint.clone());
                KeptSeen::Points(table.table.clone(), path, fingerprint)
            }
        };
        Kept { seen, path: self.path.clone(), time: self.time }
    }

    /// The recording that was kept. `warnings` are those that it had.
    ///
    /// # Errors
    /// [`Error::Recording`] where the rows are not those of a recording.
    pub fn restore(kept: Kept, warnings: Vec<Warning>) -> Result<Self, Error> {
        let seen = match kept.seen {
            KeptSeen::Motion(motion) => Seen::Motion(Motion::restore(motion, warnings)?),
            KeptSeen::Points(table, path, fingerprint) => {
                Seen::Points(PointsTable { table, path, fingerprint })
            }
        };
        Ok(Self { seen, path: kept.path, time: kept.time, gyroscope: None })
    }
}
