//! Dead reckoning.

use crate::arrays::rows;
use crate::figure::Figure;
use crate::files::written;
use crate::identification::OfGauge;
use crate::options::part;
use crate::parameters::Parameters;
use crate::recording::Recording;
use crate::tables::from_toml;
use crate::work::run;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::Pose;
use trackdyn::odometry::Advice;
use trackdyn::{OdometrySettings, Provenance};

/// Where the robot would be if parameters were true, against where it was.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Odometry {
    inner: trackdyn::Odometry,
}

/// Replays a recording with the ideal drive and with each of these parameters.
#[pyfunction]
#[pyo3(signature = (recording, gauge, parameters, runs, time, tau, gyroscope))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn odometry(
    py: Python<'_>,
    recording: &Recording,
    gauge: OfGauge<'_>,
    parameters: Vec<PyRef<'_, Parameters>>,
    runs: Option<&str>,
    time: Option<[f64; 2]>,
    tau: Option<f64>,
    gyroscope: bool,
) -> PyResult<Odometry> {
    let recording = Arc::clone(&recording.inner);
    let gauge = gauge.gauge()?;
    let parameters: Vec<trackdyn::Parameters> =
        parameters.iter().map(|one| (*one.inner).clone()).collect();
    let settings = OdometrySettings { part: part(runs, time)?, tau, gyroscope };
    let inner =
        run(py, None, move |_| trackdyn::odometry(&recording, gauge, &parameters, &settings))?;
    Ok(Odometry { inner })
}

#[pymethods]
impl Odometry {
    /// Names of the sets of parameters; the first is the ideal drive.
    #[getter]
    fn sets(&self) -> Vec<String> {
        self.inner.comparison.sets.iter().map(|set| set.name().to_owned()).collect()
    }

    /// Root mean square over runs of the errors at the end, of each set: m, rad.
    fn errors_at_end<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let count = self.inner.comparison.sets.len();
        let errors: Vec<[f64; 2]> = (0..count).map(|set| self.inner.error_at_end(set)).collect();
        rows(py, errors.into_iter())
    }

    /// The paths of each run: stamps, recorded poses, and the poses that each set predicts.
    fn paths<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let path = |path: &trackdyn::crates::estimate::odometry::comparison::Path| {
            let dict = PyDict::new(py);
            dict.set_item("run", path.run)?;
            dict.set_item("t", crate::arrays::array(py, path.stamps.clone())?)?;
            dict.set_item("recorded", poses(py, &path.recorded)?)?;
            for (set, trajectory) in self.inner.comparison.sets.iter().zip(&path.trajectories) {
                dict.set_item(set.name(), poses(py, &trajectory.poses)?)?;
            }
            Ok(dict)
        };
        self.inner.comparison.paths.iter().map(path).collect()
    }

    /// Which parameters to take: the file, `ideal`, or none with the reason.
    fn advice(&self) -> (Option<String>, Option<String>) {
        match self.inner.advice() {
            Advice::Undecided { reason } => (None, Some(reason)),
            other => (other.choice().map(str::to_owned), None),
        }
    }

    /// Errors run by run, CSV.
    fn runs_csv(&self) -> String {
        self.inner.runs_csv()
    }

    /// All errors with their intervals.
    fn document<'py>(&self, py: Python<'py>, command: &str) -> PyResult<Bound<'py, PyAny>> {
        from_toml(py, &self.inner.to_toml(&Provenance::new(command)))
    }

    /// The text of its file.
    fn toml(&self, command: &str) -> String {
        self.inner.to_toml(&Provenance::new(command))
    }

    /// The replay as a figure.
    fn figure(&self, command: &str) -> Figure {
        self.inner.figure(&Provenance::new(command)).into()
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, folder: PathBuf, command: &str) -> PyResult<Vec<PathBuf>> {
        written(self.inner.write(folder, &Provenance::new(command)))
    }

    /// Writes layers for viewers into a folder; the files that were written.
    fn write_layers(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        command: &str,
    ) -> PyResult<Vec<PathBuf>> {
        written(py.detach(|| self.inner.write_layers(folder, &Provenance::new(command))))
    }
}

fn poses<'py>(py: Python<'py>, poses: &[Pose]) -> PyResult<Bound<'py, PyAny>> {
    rows(py, poses.iter().map(|pose| [pose.x, pose.y, pose.yaw]))
}
