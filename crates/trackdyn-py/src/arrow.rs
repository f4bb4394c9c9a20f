//! Tables as streams of Arrow, by the PyCapsule interface.

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, RecordBatchIterator};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};
use std::sync::Arc;

/// A stream with one batch: the columns of a dict, arrays of float64 and int64, which are copied.
#[pyfunction]
pub fn arrow_stream<'py>(
    py: Python<'py>,
    columns: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let mut batch: Vec<(String, ArrayRef)> = Vec::with_capacity(columns.len());
    for (name, values) in columns.iter() {
        batch.push((name.extract()?, column(&values)?));
    }
    let other = |error: &dyn std::fmt::Display| PyTypeError::new_err(error.to_string());
    let batch = RecordBatch::try_from_iter(batch).map_err(|error| other(&error))?;
    let schema = batch.schema();
    let reader = RecordBatchIterator::new(std::iter::once(Ok(batch)), schema);
    let stream = FFI_ArrowArrayStream::new(Box::new(reader));
    // who takes the stream marks it as released; what nobody took is released with the capsule
    PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
}

fn column(values: &Bound<'_, PyAny>) -> PyResult<ArrayRef> {
    if let Ok(floats) = values.cast::<PyArray1<f64>>() {
        return Ok(Arc::new(Float64Array::from(floats.to_vec()?)));
    }
    let whole = values
        .cast::<PyArray1<i64>>()
        .map_err(|_| PyTypeError::new_err("expected one-dimensional arrays of float64 or int64"))?;
    Ok(Arc::new(Int64Array::from(whole.to_vec()?)))
}
