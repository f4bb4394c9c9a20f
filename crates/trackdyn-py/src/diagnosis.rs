//! Diagnoses.

use crate::errors::raised;
use crate::figure::Figure;
use crate::files::written;
use crate::options::parsed;
use crate::recording::Recording;
use crate::vehicle::Vehicle;
use crate::work::run;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::document::Document;
use trackdyn::diagnose::Prepared;
use trackdyn::{
    DiagnoseSettings, EffectId, HeldOut, MethodSettings, OpenQuestions, Provenance, Resampling,
};

/// What a model of the robot lacks.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Diagnosis {
    pub inner: trackdyn::Diagnosis,
}

/// The keywords of a diagnosis, as a dict of all of them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Keywords {
    /// `none`, or a list of runs; none: every fourth.
    held_out: Option<String>,
    draws: usize,
    seed: u64,
    tau: Option<f64>,
    gyroscope: bool,
    /// The text of a settings file, and the name that errors mention it by.
    settings: Option<(String, String)>,
    /// Ids of laws of a user that are candidates too.
    laws: Vec<String>,
}

impl Keywords {
    fn settings(self) -> PyResult<DiagnoseSettings> {
        let held_out = self.held_out.map(|text| parsed::<HeldOut>("held_out", &text));
        DiagnoseSettings::DRAWS_LIMITS.check_count("draws", self.draws).map_err(raised)?;
        let laws = self.laws.iter().map(|id| id.parse::<EffectId>()).collect::<Result<_, _>>();
        let method = self.settings.map(|(name, text)| {
            MethodSettings::from_document(&Document::new(name, text))
                .map_err(|error| raised(trackdyn::Error::from(error)))
        });
        Ok(DiagnoseSettings {
            held_out: held_out.transpose()?.unwrap_or_default(),
            tau: self.tau,
            gyroscope: self.gyroscope,
            resampling: Resampling { draws: self.draws, seed: self.seed },
            method: method.transpose()?.unwrap_or_default(),
            laws: laws.map_err(raised)?,
        })
    }
}

/// Diagnoses recordings of one robot.
#[pyfunction]
#[pyo3(signature = (recordings, vehicle, keywords, progress))]
pub fn diagnose(
    py: Python<'_>,
    recordings: Vec<PyRef<'_, Recording>>,
    vehicle: &Vehicle,
    keywords: Keywords,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Diagnosis> {
    let recordings: Vec<_> = recordings.iter().map(|one| Arc::clone(&one.inner)).collect();
    let (vehicle, settings) = (Arc::clone(&vehicle.inner), keywords.settings()?);
    let inner = run(py, progress.as_ref(), move |observer| {
        let recordings: Vec<_> = recordings.iter().map(|one| (**one).clone()).collect();
        Prepared::new(&recordings, &vehicle, &settings)?.run(observer)
    })?;
    Ok(Diagnosis { inner })
}

#[pymethods]
impl Diagnosis {
    /// Name of what was diagnosed.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// The text of its file.
    fn toml(&self, command: &str) -> String {
        self.inner.file(&Provenance::new(command)).to_toml()
    }

    /// Kinds of the claims, in the order of its file.
    #[getter]
    fn kinds(&self) -> Vec<String> {
        self.inner.claims().map(|claim| format!("{:?}", claim.kind()).to_lowercase()).collect()
    }

    /// Effects of the best hypothesis that are not claimed, and why.
    #[getter]
    fn refusals(&self) -> Vec<(Vec<&'static str>, String)> {
        let refused = self.inner.found().answer.refused.iter();
        let refusal = refused.map(|verdict| {
            let effects = verdict.one_of.iter().map(|effect| effect.name()).collect();
            (effects, verdict.refused.as_ref().map_or_else(String::new, ToString::to_string))
        });
        refusal.collect()
    }

    /// The vehicle that explains the recordings.
    #[getter]
    fn corrected_vehicle(&self) -> Vehicle {
        self.inner.corrected_vehicle().clone().into()
    }

    /// Whether nothing is open between several effects.
    #[getter]
    fn is_decided(&self) -> PyResult<bool> {
        Ok(OpenQuestions::of(&self.inner).map_err(raised)?.is_empty())
    }

    /// The figures of the report, and its page, HTML.
    fn report(&self, py: Python<'_>, command: &str) -> PyResult<(Vec<Figure>, String)> {
        let report = py.detach(|| self.inner.report(&Provenance::new(command)));
        let report = report.map_err(raised)?;
        Ok((report.figures.into_iter().map(Figure::from).collect(), report.html))
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, py: Python<'_>, folder: PathBuf, command: &str) -> PyResult<Vec<PathBuf>> {
        written(py.detach(|| self.inner.write(folder, &Provenance::new(command))))
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
