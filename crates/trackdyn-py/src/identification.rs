//! Identification of the kinematics.

use crate::errors::raised;
use crate::files::written;
use crate::options::parsed;
use crate::parameters::Parameters;
use crate::recording::Recording;
use crate::tables::from_toml;
use crate::vehicle::Vehicle;
use crate::work::run;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::identify::Prepared;
use trackdyn::{Gauge, IdentifySettings, Provenance};

/// What a recording says of the kinematic parameters.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Identification {
    inner: trackdyn::Identification,
}

/// The keywords of an identification, as a dict of all of them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Keywords {
    tau: Option<f64>,
    settle: Option<f64>,
    nuisances: Vec<String>,
    gyroscope: bool,
    force: bool,
    seed: u64,
    population: Option<usize>,
    generations: Option<usize>,
}

/// A gauge: of a vehicle, or a number.
#[derive(FromPyObject)]
pub enum OfGauge<'py> {
    /// That of a vehicle.
    #[pyo3(transparent)]
    Vehicle(PyRef<'py, Vehicle>),
    /// A number, m.
    #[pyo3(transparent)]
    Metres(f64),
}

impl OfGauge<'_> {
    /// The gauge of the library.
    pub fn gauge(&self) -> PyResult<Gauge> {
        match self {
            Self::Vehicle(vehicle) => Ok(Gauge::from(&*vehicle.inner)),
            Self::Metres(metres) => Gauge::new(*metres).map_err(raised),
        }
    }
}

impl Keywords {
    fn settings(self) -> PyResult<IdentifySettings> {
        if let Some(settle) = self.settle {
            IdentifySettings::SETTLE_LIMITS.check("settle", settle).map_err(raised)?;
        }
        let nuisances = self.nuisances.iter().map(|name| parsed("nuisances", name));
        let mut settings = IdentifySettings {
            tau: self.tau,
            settle: self.settle,
            nuisances: nuisances.collect::<PyResult<_>>()?,
            gyroscope: self.gyroscope,
            force: self.force,
            ..IdentifySettings::default()
        };
        settings.genetic.seed = self.seed;
        if let Some(population) = self.population {
            let limits = IdentifySettings::POPULATION_LIMITS;
            settings.genetic.population =
                limits.check_count("population", population).map_err(raised)?;
        }
        if let Some(generations) = self.generations {
            let limits = IdentifySettings::GENERATIONS_LIMITS;
            settings.genetic.generations =
                limits.check_count("generations", generations).map_err(raised)?;
        }
        Ok(settings)
    }
}

/// Identifies the kinematic parameters of a robot.
#[pyfunction]
#[pyo3(signature = (recording, gauge, keywords, progress))]
pub fn identify(
    py: Python<'_>,
    recording: &Recording,
    gauge: OfGauge<'_>,
    keywords: Keywords,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Identification> {
    let (recording, gauge) = (Arc::clone(&recording.inner), gauge.gauge()?);
    let settings = keywords.settings()?;
    let inner = run(py, progress.as_ref(), move |observer| {
        Prepared::new(&recording, &gauge, &settings)?.run(observer)
    })?;
    Ok(Identification { inner })
}

#[pymethods]
impl Identification {
    /// The parameters of the ICRs alone, and with the factors on the track speeds; none where the
    /// recording does not determine them.
    fn fits(&self, command: &str) -> [Option<Parameters>; 2] {
        self.inner.fits(&Provenance::new(command)).map(|fit| fit.map(Parameters::from))
    }

    /// Why the recording does not determine each of them, or why it is withheld.
    #[getter]
    fn reasons(&self) -> [Option<String>; 2] {
        self.inner.reasons()
    }

    /// What contradicts each of them.
    #[getter]
    fn contradictions(&self) -> [Vec<String>; 2] {
        self.inner.contradictions().map(|of| of.iter().map(ToString::to_string).collect())
    }

    /// The distance of the ICRs alone, where the recording determines nothing else.
    fn separation<'py>(
        &self,
        py: Python<'py>,
        command: &str,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let separation = self.inner.separation(&Provenance::new(command));
        separation.map(|file| from_toml(py, &file.to_toml())).transpose()
    }

    /// All that was found of a recording of motion.
    fn document<'py>(&self, py: Python<'py>, command: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        match &self.inner {
            trackdyn::Identification::Motion(fit) => {
                from_toml(py, &fit.to_toml(&Provenance::new(command))).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, folder: PathBuf, command: &str) -> PyResult<Vec<PathBuf>> {
        written(self.inner.write(folder, &Provenance::new(command)))
    }
}
