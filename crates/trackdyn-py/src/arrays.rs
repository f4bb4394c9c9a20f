//! Columns of numbers as arrays of NumPy.

use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use trackdyn::crates::core::PerSide;

/// A table: columns by name, of one length.
pub struct Table<'py> {
    columns: Bound<'py, PyDict>,
}

impl<'py> Table<'py> {
    /// A table without columns.
    pub fn new(py: Python<'py>) -> Self {
        Self { columns: PyDict::new(py) }
    }

    /// Adds a column. The array takes over the memory of the vector and cannot be written to.
    pub fn with<T: Element>(self, name: &str, values: Vec<T>) -> PyResult<Self> {
        self.columns.set_item(name, array(self.columns.py(), values)?)?;
        Ok(self)
    }

    /// Its dict.
    pub fn into_dict(self) -> Bound<'py, PyDict> {
        self.columns
    }
}

/// An array that has taken over the memory of a vector and cannot be written to.
pub fn array<T: Element>(py: Python<'_>, values: Vec<T>) -> PyResult<Bound<'_, PyArray1<T>>> {
    let array = PyArray1::from_vec(py, values);
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array)
}

/// Pairs of speeds of the left and the right track.
pub fn speeds(
    left: &PyReadonlyArray1<'_, f64>,
    right: &PyReadonlyArray1<'_, f64>,
) -> Vec<PerSide<f64>> {
    let (left, right) = (left.as_array(), right.as_array());
    left.iter().zip(right.iter()).map(|(&left, &right)| PerSide::new(left, right)).collect()
}

/// An array of these rows, that can be written to.
pub fn rows<const N: usize>(
    py: Python<'_>,
    rows: impl ExactSizeIterator<Item = [f64; N]>,
) -> PyResult<Bound<'_, PyAny>> {
    let count = rows.len();
    let values: Vec<f64> = rows.flatten().collect();
    Ok(PyArray1::from_vec(py, values).reshape([count, N])?.into_any())
}
