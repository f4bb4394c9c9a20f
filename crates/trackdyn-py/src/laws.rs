//! Laws of a user: functions of Python as effects beside the catalogue.

mod retraced;
mod tape;

use crate::errors::raised;
use crate::options::named;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use retraced::Retraced;
use tape::{Step, Tape};
use trackdyn::crates::model::effect::Role;
use trackdyn::law::{Argument, Batch, CustomLaw, Declared, Kind, Results, register};

/// Steps, and the places of the results.
type Taped = (Vec<Step>, Vec<usize>);

/// A parameter, as a dict of all that is said of it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Parameter {
    key: String,
    unit: String,
    meaning: String,
    role: String,
    neutral: f64,
    low: f64,
    high: f64,
    typical: f64,
}

impl Parameter {
    fn declared(self) -> PyResult<Declared> {
        let roles = [
            ("size", Role::Size { neutral: self.neutral }),
            ("shape", Role::Shape),
            ("direction", Role::Direction),
            ("x", Role::Place { axis: 0 }),
            ("y", Role::Place { axis: 1 }),
            ("time", Role::Time),
        ];
        let role = named("role", Some(self.role), &roles)?.unwrap_or(Role::Shape);
        let Self { key, unit, meaning, low, high, typical, .. } = self;
        Ok(Declared { key, unit, meaning, role, range: [low, high], typical })
    }
}

/// The kind of a law by the name of what it adds.
fn kind(acts: &str) -> PyResult<Kind> {
    let known = [("force", Kind::Force), ("friction", Kind::Friction)];
    Ok(named("acts", Some(acts.to_owned()), &known)?.unwrap_or(Kind::Force))
}

/// Names of what a law sees, in the order of its columns.
#[pyfunction]
pub fn law_arguments(acts: &str) -> PyResult<Vec<&'static str>> {
    Ok(kind(acts)?.arguments().iter().map(|argument| argument.name()).collect())
}

/// Registers a law whose function takes columns and the values of its parameters, and gives rows of
/// what it adds and the columns that it read, a bit each; the letters of the symmetries that it
/// breaks.
///
/// Where a `tape` says what the function does, it is done in its place, without the interpreter.
/// `trace` gives the tape for values of the parameters, where that depends on them, or None.
#[pyfunction]
#[pyo3(signature = (id, summary, acts, parameters, function, tape, trace))]
pub fn register_law(
    id: &str,
    summary: &str,
    acts: &str,
    parameters: Vec<Parameter>,
    function: Py<PyAny>,
    tape: Option<Taped>,
    trace: Option<Py<PyAny>>,
) -> PyResult<String> {
    let kind = kind(acts)?;
    let parameters =
        parameters.into_iter().map(Parameter::declared).collect::<PyResult<Vec<_>>>()?;
    let counts = [kind.arguments().len(), parameters.len(), kind.results().len()];
    let called = move |at: &Batch, values: &[f64], adds: &mut Results| {
        Python::attach(|py| called(py, &function, kind, at, values, adds))
    };
    // what a step does not read, it does not depend on
    let read_by = |tape: &Tape| tape.reads().into_iter().fold(0, |all, place| all | 1_u32 << place);
    let law = match (tape, trace) {
        (Some((steps, results)), _) => {
            let tape = Tape::new(counts, &steps, results)?;
            let reads: Vec<Argument> =
                tape.reads().into_iter().map(|place| kind.arguments()[place]).collect();
            let law = CustomLaw::new(kind, id, summary, &parameters, move |at, values, adds| {
                tape.evaluate(at, values, adds);
                Ok(())
            });
            law.map(|law| law.reading(&reads))
        }
        (None, Some(trace)) => {
            let retraced = Retraced::new(counts, trace);
            CustomLaw::new(kind, id, summary, &parameters, move |at, values, adds| {
                match retraced.tape(values)? {
                    Some(tape) => {
                        adds.read(read_by(&tape));
                        tape.evaluate(at, values, adds);
                    }
                    None => called(at, values, adds)?,
                }
                Ok(())
            })
        }
        (None, None) => {
            let law = CustomLaw::new(kind, id, summary, &parameters, move |at, values, adds| {
                Ok(called(at, values, adds)?)
            });
            law.map(CustomLaw::shared)
        }
    };
    let law = law.map_err(raised)?;
    let law = register(law).map_err(raised)?;
    Ok(law.card().breaks.iter().map(|symmetry| symmetry.letter()).collect())
}

/// What the steps of a tape give at columns, without a law: to compare them with the function.
#[pyfunction]
pub fn taped<'py>(
    py: Python<'py>,
    counts: [usize; 3],
    steps: Vec<Step>,
    results: Vec<usize>,
    columns: PyReadonlyArray2<'py, f64>,
    values: Vec<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let tape = Tape::new(counts, &steps, results)?;
    let rows = columns.shape()[1];
    let mut adds = vec![0.0; counts[2] * rows];
    tape.evaluate_columns(columns.as_slice()?, rows, &values, &mut adds);
    Ok(PyArray1::from_vec(py, adds).reshape([counts[2], rows])?.into_any())
}

/// Calls the function with columns. It gives rows of what the law adds, and which columns it read.
fn called(
    py: Python<'_>,
    function: &Py<PyAny>,
    kind: Kind,
    at: &Batch,
    values: &[f64],
    adds: &mut Results,
) -> PyResult<()> {
    let shape = [kind.arguments().len(), at.len()];
    let columns = PyArray1::from_slice(py, at.columns()).reshape(shape)?;
    let found = function.bind(py).call1((columns, PyTuple::new(py, values)?))?;
    let (found, read): (PyReadonlyArray2<'_, f64>, u32) = found.extract()?;
    adds.read(read);
    let found = found.as_slice()?;
    let adds = adds.columns();
    if found.len() != adds.len() {
        return Err(PyRuntimeError::new_err("a law gave another number of rows"));
    }
    adds.copy_from_slice(found);
    Ok(())
}
