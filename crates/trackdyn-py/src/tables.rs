//! Tables of TOML as Python's dicts, and the catalogue of effects.

use crate::errors::said;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pythonize::{depythonize, pythonize};
use trackdyn::{Card, Parameter};

/// A TOML text as a dict.
#[pyfunction]
pub fn from_toml<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let table: toml::Table =
        toml::from_str(text).map_err(|error| said("text", &format!("text: {error}")))?;
    Ok(pythonize(py, &table)?)
}

/// A dict as a TOML text.
#[pyfunction]
pub fn to_toml(table: &Bound<'_, PyDict>) -> PyResult<String> {
    let other = |error: &dyn std::fmt::Display| {
        said("table", &format!("table: {error}: expected what TOML can hold"))
    };
    let table: toml::Table = depythonize(table).map_err(|error| other(&error))?;
    toml::to_string(&table).map_err(|error| other(&error))
}

/// The catalogue: physics beyond the base model, an effect each.
#[pyfunction]
pub fn effects(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    trackdyn::effects().iter().map(|card| effect(py, card)).collect()
}

fn effect<'py>(py: Python<'py>, card: &Card) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("id", card.id)?;
    dict.set_item("title", card.title)?;
    dict.set_item("law", card.law)?;
    dict.set_item("assumes", card.assumes)?;
    dict.set_item("shows", card.shows)?;
    dict.set_item("resembles", card.resembles)?;
    let breaks: String = card.breaks.iter().map(|symmetry| symmetry.letter()).collect();
    dict.set_item("breaks", breaks)?;
    dict.set_item("sources", card.sources.to_vec())?;
    let parameters: PyResult<Vec<_>> =
        card.parameters.iter().map(|one| parameter(py, one)).collect();
    dict.set_item("parameters", parameters?)?;
    Ok(dict)
}

fn parameter<'py>(py: Python<'py>, one: &Parameter) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("key", one.key)?;
    dict.set_item("symbol", one.symbol)?;
    dict.set_item("unit", one.unit)?;
    dict.set_item("meaning", one.meaning)?;
    dict.set_item("role", one.role.name())?;
    dict.set_item("range", (one.range[0], one.range[1]))?;
    dict.set_item("typical", one.typical)?;
    Ok(dict)
}
