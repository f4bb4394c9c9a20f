//! Recordings.

mod pickled;

use crate::arrays::Table;
use crate::errors::{raised, refused};
use crate::options::{Reading, parsed, part};
use crate::work::run;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::recording::recording::Recording as Motion;
use trackdyn::crates::recording::sample::{ImuSample, PoseSample, Sample, TrackSample};
use trackdyn::crates::recording::{Format, Run, Series, Source, UncheckedRun};

/// What was seen of a robot.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Recording {
    pub inner: Arc<trackdyn::Recording>,
}

impl From<trackdyn::Recording> for Recording {
    fn from(recording: trackdyn::Recording) -> Self {
        Self { inner: Arc::new(recording) }
    }
}

/// The rows of a run: its number, track speeds (t, v_left, v_right), poses (t, x, y, yaw) and
/// readings of an IMU (t, gyro_z, acc_x, acc_y).
type Rows<'py> = (
    i64,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, f64>,
    Option<PyReadonlyArray2<'py, f64>>,
);

#[pymethods]
impl Recording {
    /// Reads a recording; all options are given.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf, options: Reading) -> PyResult<Self> {
        let options = options.options()?;
        let opened = run(py, None, move |_| trackdyn::Recording::open(&path, &options))?;
        Ok(opened.into())
    }

    /// A recording of rows that are at hand. They are cleaned and doubted as those of a file.
    #[staticmethod]
    fn of_rows(
        name: &str,
        robot: &str,
        runs: Vec<Rows<'_>>,
        accept: Vec<String>,
    ) -> PyResult<Self> {
        let runs = runs.into_iter().map(|(id, tracks, poses, imu)| UncheckedRun {
            id,
            tracks: series::<TrackSample>(&tracks),
            poses: series::<PoseSample>(&poses),
            imu: imu.map_or_else(Series::default, |imu| series::<ImuSample>(&imu)),
        });
        let accepted: PyResult<Vec<_>> =
            accept.iter().map(|doubt| parsed("accept", doubt)).collect();
        let source = Source { format: Format::Table, ..Source::computed() };
        let runs = runs.collect();
        let motion = Motion::accepting(name, robot, runs, source, Vec::new(), &accepted?);
        Ok(trackdyn::Recording::from(motion.map_err(trackdyn::Error::from).map_err(raised)?).into())
    }

    /// A part of it.
    #[pyo3(signature = (runs, time))]
    fn part(&self, runs: Option<&str>, time: Option<[f64; 2]>) -> PyResult<Self> {
        Ok(self.inner.part(&part(runs, time)?).map_err(raised)?.into())
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// What errors call it.
    #[getter]
    fn place(&self) -> String {
        self.inner.place()
    }

    /// The robot that was recorded.
    #[getter]
    fn robot(&self) -> Option<&str> {
        self.inner.motion().map(Motion::robot)
    }

    /// Fingerprint of what was read.
    #[getter]
    fn fingerprint(&self) -> &str {
        self.inner.fingerprint()
    }

    /// Whether it is a table of steady operating points.
    #[getter]
    fn is_of_points(&self) -> bool {
        self.inner.points().is_some()
    }

    /// Whether the positions of all poses are known.
    #[getter]
    fn has_positions(&self) -> bool {
        self.inner.motion().is_some_and(Motion::has_positions)
    }

    /// Numbers of its runs.
    #[getter]
    fn runs(&self) -> Vec<i64> {
        self.inner.runs().iter().map(Run::id).collect()
    }

    /// Time of all runs, s.
    #[getter]
    fn duration(&self) -> f64 {
        self.inner.runs().iter().map(Run::duration).sum()
    }

    /// Unix time of t = 0 in nanoseconds, where the source keeps absolute time.
    #[getter]
    fn epoch_ns(&self) -> Option<i64> {
        self.inner.motion().and_then(|motion| motion.source().epoch_ns)
    }

    /// What was cleaned or left out in reading.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.inner.warnings().iter().map(ToString::to_string).collect()
    }

    /// The columns of a series of all runs: tracks, poses, imu or points.
    fn columns<'py>(&self, py: Python<'py>, series: &str) -> PyResult<Bound<'py, PyDict>> {
        let runs = self.inner.runs();
        match series {
            "tracks" => columns(py, runs, Run::tracks),
            "poses" => columns(py, runs, Run::poses),
            "imu" => columns(py, runs, Run::imu),
            "points" => {
                let table = self.inner.points().map_or(&[][..], |table| table.points());
                let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
                let columns = Table::new(py)
                    .with("v_left", table.iter().map(|point| point.v_left).collect())?
                    .with("v_right", table.iter().map(|point| point.v_right).collect())?
                    .with("v_forward", table.iter().map(|at| or_nan(at.v_forward)).collect())?
                    .with("v_lateral", table.iter().map(|at| or_nan(at.v_lateral)).collect())?
                    .with("yaw_rate", table.iter().map(|at| or_nan(at.yaw_rate)).collect())?;
                Ok(columns.into_dict())
            }
            other => Err(refused("series", other, "expected tracks, poses, imu or points")),
        }
    }

    /// What it holds, for a pickle.
    fn keep<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        pickled::keep(py, &self.inner)
    }

    /// The recording that was kept.
    #[staticmethod]
    fn restore(kept: &Bound<'_, PyDict>) -> PyResult<Self> {
        Ok(pickled::restore(kept)?.into())
    }
}

/// The samples in the rows of an array, whose columns are those of the samples.
fn series<S: Sample>(rows: &PyReadonlyArray2<'_, f64>) -> Series<S> {
    let rows = rows.as_array();
    let samples = rows.rows().into_iter().map(|row| S::from_columns(&row.to_vec()));
    samples.collect::<Vec<S>>().into()
}

/// The number of its run and the columns of each sample, over all runs. They are copied: the
/// library keeps samples, not columns.
fn columns<'py, S: Sample>(
    py: Python<'py>,
    runs: &[Run],
    of: fn(&Run) -> &[S],
) -> PyResult<Bound<'py, PyDict>> {
    let count = runs.iter().map(|run| of(run).len()).sum();
    let mut ids: Vec<i64> = Vec::with_capacity(count);
    let mut columns = vec![Vec::with_capacity(count); S::COLUMNS.len()];
    let mut cells = Vec::with_capacity(S::COLUMNS.len());
    for run in runs {
        for sample in of(run) {
            ids.push(run.id());
            cells.clear();
            sample.push_columns(&mut cells);
            columns.iter_mut().zip(&cells).for_each(|(column, cell)| column.push(*cell));
        }
    }
    let mut table = Table::new(py).with("run", ids)?;
    for (name, column) in S::COLUMNS.iter().zip(columns) {
        table = table.with(name, column)?;
    }
    Ok(table.into_dict())
}
