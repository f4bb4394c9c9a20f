//! Figures as values.

use crate::errors::raised;
use pyo3::prelude::*;
use pythonize::{depythonize, pythonize};

/// A figure.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Figure {
    inner: trackdyn::Figure,
}

impl From<trackdyn::Figure> for Figure {
    fn from(inner: trackdyn::Figure) -> Self {
        Self { inner }
    }
}

#[pymethods]
impl Figure {
    /// Name of its file, without the ending.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// What it shows.
    #[getter]
    fn title(&self) -> &str {
        &self.inner.title
    }

    /// How to read it.
    #[getter]
    fn reading(&self) -> &str {
        &self.inner.reading
    }

    /// All of it as dicts and lists.
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize(py, &self.inner)?)
    }

    /// The figure of such dicts and lists.
    #[staticmethod]
    fn restore(data: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self { inner: depythonize(data)? })
    }

    /// The picture as PNG.
    fn to_png(&self, py: Python<'_>) -> PyResult<Vec<u8>> {
        py.detach(|| self.inner.to_png()).map_err(raised)
    }

    /// The picture as SVG.
    fn to_svg(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| self.inner.to_svg()).map_err(raised)
    }
}
