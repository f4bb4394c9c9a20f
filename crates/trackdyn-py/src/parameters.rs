//! Kinematic parameters.

use crate::arrays::{rows, speeds};
use crate::errors::raised;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::Kinematics;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::{PerSide, frames::ros_twist_from_paper};

/// Kinematic parameters with their origin.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Parameters {
    pub inner: Arc<trackdyn::Parameters>,
}

impl From<trackdyn::Parameters> for Parameters {
    fn from(parameters: trackdyn::Parameters) -> Self {
        Self { inner: Arc::new(parameters) }
    }
}

#[pymethods]
impl Parameters {
    /// Reads a kinematics file.
    #[staticmethod]
    fn open(path: PathBuf) -> PyResult<Self> {
        Ok(trackdyn::Parameters::open(path).map_err(raised)?.into())
    }

    /// The parameters of the text of a kinematics file, under the name that errors mention it by.
    #[staticmethod]
    fn from_toml(name: &str, text: &str) -> PyResult<Self> {
        let document = Document::new(name, text);
        Ok(trackdyn::Parameters::from_document(document).map_err(raised)?.into())
    }

    /// Its file as given, or the name of the one that it goes into.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// x_l, x_r, y in m, alpha_l, alpha_r.
    #[getter]
    fn values(&self) -> [f64; 5] {
        let Kinematics { icrs, alpha } = self.inner.kinematics();
        [icrs.x_left, icrs.x_right, icrs.y, alpha.left, alpha.right]
    }

    /// Covariance of these, as far as they were fitted.
    #[getter]
    fn covariance(&self) -> Option<Vec<Vec<f64>>> {
        self.inner.file().covariance.clone()
    }

    /// Gauge over distance of the ICRs.
    #[getter]
    fn steering_efficiency(&self) -> f64 {
        self.inner.file().steering_efficiency
    }

    /// Eccentricity of the ICRs.
    #[getter]
    fn eccentricity(&self) -> f64 {
        self.inner.file().eccentricity
    }

    /// Whether other parts of the answer contradict them.
    #[getter]
    fn is_doubtful(&self) -> bool {
        self.inner.is_doubtful()
    }

    /// The text of its file.
    #[getter]
    fn toml(&self) -> &str {
        self.inner.document().text()
    }

    /// The fingerprint of that text.
    #[getter]
    fn fingerprint(&self) -> String {
        self.inner.fingerprint()
    }

    /// Writes its file.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        self.inner.write(path).map_err(raised)
    }

    /// Motion of the body at track speeds: forward and left, m/s, and yaw rate, rad/s.
    fn twist<'py>(
        &self,
        py: Python<'py>,
        left: PyReadonlyArray1<'py, f64>,
        right: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let twist = |speeds: PerSide<f64>| {
            let twist = self.inner.kinematics_at(speeds).twist(speeds);
            let twist = ros_twist_from_paper(&twist);
            [twist.v_x, twist.v_y, twist.w]
        };
        rows(py, speeds(&left, &right).into_iter().map(twist))
    }

    /// Track speeds, m/s, for a forward speed, m/s, and a yaw rate, rad/s.
    fn track_speeds<'py>(
        &self,
        py: Python<'py>,
        forward: PyReadonlyArray1<'py, f64>,
        yaw_rate: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (forward, yaw_rate) = (forward.as_array(), yaw_rate.as_array());
        let speeds = forward.iter().zip(yaw_rate.iter()).map(|(&forward, &yaw_rate)| {
            let (speeds, _) = self.inner.track_speeds(forward, yaw_rate);
            [speeds.left, speeds.right]
        });
        let speeds: Vec<[f64; 2]> = speeds.collect();
        rows(py, speeds.into_iter())
    }
}
