//! Plans of the driving that decides.

use crate::arrays::rows;
use crate::errors::{raised, refused};
use crate::files::written;
use crate::tables::from_toml;
use crate::vehicle::Vehicle;
use crate::work::run;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::document::Document;
use trackdyn::plan::assumed_noise;
use trackdyn::{OpenQuestions, PlanSettings, Provenance};

/// What to drive next, and what it separates.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Plan {
    inner: trackdyn::Plan,
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
    let fastest = between("fastest", fastest, [0.05, 10.0], "m/s")?;
    let duration = between("duration", duration, [1.0, 3600.0], "s")?;
    let (name, text) = diagnosis;
    let questions = OpenQuestions::from_document(Document::new(name, text)).map_err(raised)?;
    let mut noise = questions.noise().unwrap_or(PlanSettings::default().noise);
    if let Some(xy) = noise_xy {
        let xy = between("noise_xy", xy, [1e-6, 10.0], "m or rad")?;
        let given = assumed_noise(xy, 0.0);
        noise.pose[..2].copy_from_slice(&given.pose[..2]);
        noise.walk[..2].copy_from_slice(&given.walk[..2]);
    }
    if let Some(yaw) = noise_yaw {
        let yaw = between("noise_yaw", yaw, [1e-6, 10.0], "m or rad")?;
        let given = assumed_noise(0.0, yaw);
        (noise.pose[2], noise.walk[2], noise.heading) = (given.pose[2], given.walk[2], 0.0);
    }
    let method = questions.method().clone();
    let settings = PlanSettings { fastest, duration, noise, method };
    let vehicle = Arc::clone(&vehicle.inner);
    let inner = run(py, progress.as_ref(), move |observer| {
        trackdyn::Plan::new(&questions, &vehicle, &settings, observer)
    })?;
    Ok(Plan { inner })
}

/// A number within limits.
fn between(setting: &str, value: f64, [low, high]: [f64; 2], unit: &str) -> PyResult<f64> {
    let is_within = (low..=high).contains(&value);
    let expected = || refused(setting, value, &format!("expected {low} to {high} {unit}"));
    is_within.then_some(value).ok_or_else(expected)
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
