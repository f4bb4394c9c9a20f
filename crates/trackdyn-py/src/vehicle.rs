//! Vehicles.

use crate::errors::raised;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::document::Document;
use trackdyn::{ActiveEffect, EffectId, RunningGear, VehicleSketch};

/// A vehicle, and the effects that its model has.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Vehicle {
    pub inner: Arc<trackdyn::Vehicle>,
}

impl From<trackdyn::Vehicle> for Vehicle {
    fn from(vehicle: trackdyn::Vehicle) -> Self {
        Self { inner: Arc::new(vehicle) }
    }
}

#[pymethods]
impl Vehicle {
    /// The vehicle of a file, or of a name.
    #[staticmethod]
    fn choose(choice: PathBuf) -> PyResult<Self> {
        Ok(trackdyn::Vehicle::choose(choice).map_err(raised)?.into())
    }

    /// The vehicle of the text of a vehicle file, under the name that errors mention it by.
    #[staticmethod]
    fn from_toml(name: &str, text: &str) -> PyResult<Self> {
        let document = Document::new(name, text);
        Ok(trackdyn::Vehicle::from_document(&document).map_err(raised)?.into())
    }

    /// A vehicle of which this much is known.
    #[staticmethod]
    #[pyo3(signature = (name, gauge, mass, contact_length, width, axles, cog, friction))]
    #[expect(clippy::too_many_arguments, reason = "the numbers of a vehicle file")]
    fn of_numbers(
        name: &str,
        gauge: f64,
        mass: f64,
        contact_length: f64,
        width: f64,
        axles: Option<Vec<f64>>,
        cog: Option<[f64; 2]>,
        friction: Option<[f64; 2]>,
    ) -> PyResult<Self> {
        let gear = match axles {
            Some(axles) => RunningGear::Wheels { contact_length, width, axles },
            None => RunningGear::Track { contact_length, belt_width: width },
        };
        let sketch = VehicleSketch { cog, friction, ..VehicleSketch::new(name, gauge, mass, gear) };
        Ok(sketch.vehicle().map_err(raised)?.into())
    }

    /// The names of the vehicles that need no file.
    #[staticmethod]
    fn names() -> Vec<&'static str> {
        trackdyn::Vehicle::names().collect()
    }

    /// With this effect in place of the one that it may have.
    fn with_effect(&self, text: &str) -> PyResult<Self> {
        Ok((*self.inner).clone().with_effect(text).map_err(raised)?.into())
    }

    /// With another centre of gravity.
    fn with_cog(&self, cog: [f64; 2]) -> PyResult<Self> {
        Ok((*self.inner).clone().with_cog(cog).map_err(raised)?.into())
    }

    /// With or without its inertia.
    fn with_inertia(&self, inertia: bool) -> Self {
        (*self.inner).clone().with_inertia(inertia).into()
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// Distance between the track centre-lines, m.
    #[getter]
    fn gauge(&self) -> f64 {
        self.inner.gauge()
    }

    /// The effects that its model has.
    #[getter]
    fn effects(&self) -> Vec<String> {
        self.inner.effects().iter().map(ToString::to_string).collect()
    }

    /// Ids of the laws of a user among them.
    #[getter]
    fn laws(&self) -> Vec<&'static str> {
        let effects = self.inner.effects().iter().map(ActiveEffect::effect);
        effects.filter(|effect| effect.custom().is_some()).map(EffectId::name).collect()
    }

    /// The text of its file.
    #[getter]
    fn toml(&self) -> String {
        self.inner.to_toml()
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
}
