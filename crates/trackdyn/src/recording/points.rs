//! Tables of steady operating points.

use crate::Error;
use std::path::{Path, PathBuf};
use trackdyn_core::input;
use trackdyn_core::output::fingerprint;
use trackdyn_recording::{OperatingPoint, OperatingPoints, TableOptions};

/// Largest file of steady operating points, bytes; a thousand points take 60 kB.
const MAX_TABLE_SIZE: u64 = 64 << 20;

/// A table of steady operating points with its origin: a measured map of ICRs.
#[derive(Clone, Debug)]
pub struct PointsTable {
    pub(super) table: OperatingPoints,
    pub(super) path: PathBuf,
    pub(super) fingerprint: String,
}

impl PointsTable {
    /// Reads a table `v_left,v_right,v_forward,v_lateral,yaw_rate`; an empty cell was not measured.
    pub(super) fn read(path: &Path, options: &TableOptions) -> Result<Self, Error> {
        let text = input::bytes(path, MAX_TABLE_SIZE);
        let text = text.map_err(|cause| Error::Unreadable { path: path.to_owned(), cause })?;
        let table = OperatingPoints::read_by(path, options)?;
        Ok(Self { table, path: path.to_owned(), fingerprint: fingerprint(&text) })
    }

    /// Its name: that of the file.
    pub fn name(&self) -> &str {
        &self.table.name
    }

    /// The fingerprint of its file.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// The points, in the order of the file.
    pub fn points(&self) -> &[OperatingPoint] {
        &self.table.points
    }

    /// Refuses settings that only recordings of motion have a use for.
    pub(crate) fn refuse(&self, settings: Vec<&'static str>) -> Result<(), Error> {
        if settings.is_empty() {
            return Ok(());
        }
        Err(Error::MotionOnly { settings, table: self.path.clone() })
    }
}
