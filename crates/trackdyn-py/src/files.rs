//! Files that results are written into.

use crate::errors::raised;
use pyo3::PyResult;
use std::path::PathBuf;
use trackdyn::{Change, Error};

/// The files that were written.
pub fn written(changes: Result<Vec<Change>, Error>) -> PyResult<Vec<PathBuf>> {
    let changes = changes.map_err(raised)?;
    Ok(changes.iter().map(|change| change.path().to_owned()).collect())
}
