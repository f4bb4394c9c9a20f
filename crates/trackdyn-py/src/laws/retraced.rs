//! Tapes of a function that does other things at other values of its parameters.

use super::Taped;
use super::tape::Tape;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Most tapes that are kept: those of the hypotheses that are worked on.
const MAX_TAPES: usize = 1000;

/// A tape for each set of values; none where the function cannot be traced there.
pub struct Retraced {
    counts: [usize; 3],
    trace: Py<PyAny>,
    /// By the bits of the values.
    known: Mutex<HashMap<Vec<u64>, Option<Arc<Tape>>>>,
}

impl Retraced {
    /// Tapes for so many columns, parameters and results, by a function that traces.
    pub fn new(counts: [usize; 3], trace: Py<PyAny>) -> Self {
        Self { counts, trace, known: Mutex::default() }
    }

    /// The tape for these values.
    pub fn tape(&self, values: &[f64]) -> PyResult<Option<Arc<Tape>>> {
        let key: Vec<u64> = values.iter().map(|value| value.to_bits()).collect();
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(tape) = known().get(&key) {
            return Ok(tape.clone());
        }
        // Not under the lock: who holds the interpreter may wait for it.
        let taped: Option<Taped> = Python::attach(|py| {
            let found = self.trace.bind(py).call1((PyTuple::new(py, values)?,))?;
            found.extract::<Option<Taped>>()
        })?;
        let tape = taped.map(|(steps, results)| Tape::new(self.counts, &steps, results));
        let tape = tape.transpose()?.map(Arc::new);
        let mut known = known();
        if known.len() >= MAX_TAPES {
            known.clear();
        }
        known.insert(key, tape.clone());
        Ok(tape)
    }
}
