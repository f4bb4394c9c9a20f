//! Forces as a table, for the computer of a robot.

use crate::arrays::{rows, speeds};
use crate::files::written;
use crate::vehicle::Vehicle;
use crate::work::run;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::Provenance;
use trackdyn::crates::export::TextFile;
use trackdyn::crates::model::{MotionTable as Table, motion_table::Tabulated};

/// Steady motion by the forces on a vehicle, as polynomials of the encoder speeds.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct MotionTable {
    table: Table,
    files: [TextFile; 2],
}

/// The table of a vehicle for encoder speeds up to `fastest`, m/s.
#[pyfunction]
#[pyo3(signature = (vehicle, fastest, command))]
pub fn motion_table(
    py: Python<'_>,
    vehicle: &Vehicle,
    fastest: f64,
    command: &str,
) -> PyResult<MotionTable> {
    let (vehicle, provenance) = (Arc::clone(&vehicle.inner), Provenance::new(command));
    let (table, files) =
        run(py, None, move |_| trackdyn::export::motion_table(&vehicle, fastest, &provenance))?;
    Ok(MotionTable { table, files })
}

#[pymethods]
impl MotionTable {
    /// Largest difference from the model, m/s.
    #[getter]
    fn error(&self) -> f64 {
        self.table.error
    }

    /// Part of the speeds without a steady motion.
    #[getter]
    fn unsolved(&self) -> f64 {
        self.table.unsolved
    }

    /// Numbers of polynomials in both coordinates of a sector.
    #[getter]
    fn orders(&self) -> [usize; 2] {
        self.table.orders
    }

    /// Names and texts of its files.
    #[getter]
    fn files(&self) -> Vec<(String, String)> {
        self.files.iter().map(|file| (file.name.to_owned(), file.text.clone())).collect()
    }

    /// Motion of the body at encoder speeds: forward and left, m/s, and yaw rate, rad/s.
    fn twist<'py>(
        &self,
        py: Python<'py>,
        left: PyReadonlyArray1<'py, f64>,
        right: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let twist = |at: Tabulated| [at.twist.v_x, at.twist.v_y, at.twist.w];
        rows(py, self.at(&left, &right).into_iter().map(twist))
    }

    /// Derivatives of forward, left and yaw, each by the left and the right encoder speed.
    fn by_speed<'py>(
        &self,
        py: Python<'py>,
        left: PyReadonlyArray1<'py, f64>,
        right: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let flat = |at: Tabulated| {
            let [[a, b], [c, d], [e, f]] = at.by_speed;
            [a, b, c, d, e, f]
        };
        rows(py, self.at(&left, &right).into_iter().map(flat))
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        written(trackdyn::export::write(&self.files, folder))
    }
}

impl MotionTable {
    fn at(
        &self,
        left: &PyReadonlyArray1<'_, f64>,
        right: &PyReadonlyArray1<'_, f64>,
    ) -> Vec<Tabulated> {
        speeds(left, right).into_iter().map(|speeds| self.table.at(speeds)).collect()
    }
}
