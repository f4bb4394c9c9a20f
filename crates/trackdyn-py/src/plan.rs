//! Plans of the driving that decides.

use crate::arrays::rows;
use crate::errors::raised;
use crate::files::written;
use crate::tables::from_toml;
use crate::vehicle::Vehicle;
use crate::work::run;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::document::Document;
use trackdyn::{OpenQuestions, PlanSettings, Provenance};

/// What to drive next, and what it separates.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Plan {
    inner: trackdyn::Plan,
}

/// Whether a diagnosis leaves nothing open between several effects, by the text of its file.
#[pyfunction]
pub fn is_decided(diagnosis: (String, String)) -> PyResult<bool> {
    let (name, text) = diagnosis;
    Ok(OpenQuestions::from_document(Document::new(name, text)).map_err(raised)?.is_empty())
}

/// Plans the driving that separates what a diagnosis left open, by the text of its file.
#[pyfunction]
#[pyo3(signature = (diagnosis, vehicle, fastest, duration, noise_xy, noise_yaw, progress))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn plan(
    py: Python<'_>,
    diagnosis: (String, String),
    vehicle: &Vehicle,
    fastest: f64,
    duration: f64,
    noise_xy: Option<f64>,
    noise_yaw: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Plan> {
    let (name, text) = diagnosis;
    let questions = OpenQuestions::from_document(Document::new(name, text)).map_err(raised)?;
    let settings = PlanSettings { fastest, duration, noise_xy, noise_yaw };
    let vehicle = Arc::clone(&vehicle.inner);
    let inner = run(py, progress.as_ref(), move |observer| {
        trackdyn::Plan::new(&questions, &vehicle, &settings, observer)
    })?;
    Ok(Plan { inner })
}

#[pymethods]
impl Plan {
    /// The commands, rows of t, v_left, v_right; none where no driving decides.
    fn schedule<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(schedule) = self.inner.schedule() else { return Ok(None) };
        let commands = schedule.commands().iter();
        rows(py, commands.map(|at| [at.t, at.speeds.left, at.speeds.right])).map(Some)
    }

    /// The plan as a dict.
    fn document<'py>(&self, py: Python<'py>, command: &str) -> PyResult<Bound<'py, PyAny>> {
        from_toml(py, &self.inner.file(&Provenance::new(command)).to_toml())
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, folder: PathBuf, command: &str) -> PyResult<Vec<PathBuf>> {
        written(self.inner.write(folder, &Provenance::new(command)))
    }
}
