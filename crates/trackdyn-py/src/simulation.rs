//! Drives in time, one at a time or many at once.

use crate::arrays::Table;
use crate::errors::{raised, refused, said};
use crate::files::written;
use crate::recording::Recording;
use crate::tables::from_toml;
use crate::vehicle::Vehicle;
use crate::work::run;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::trajectory::Moment;
use trackdyn::crates::core::{Command, PerSide, Pose, Schedule};
use trackdyn::crates::drive::schedules::ScheduledRun;
use trackdyn::simulate::{Driving, Prepared, sensors, simulate_all};
use trackdyn::{Error, Provenance, SimulateSettings};

/// A robot that was driven in simulation.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct Simulation {
    inner: trackdyn::Simulation,
}

/// What the tracks do.
#[derive(FromPyObject)]
pub enum Tracks<'py> {
    /// The name of driving that is generated, or a file.
    #[pyo3(transparent)]
    Named(PathBuf),
    /// Numbers of runs and their commands, rows of t, v_left, v_right.
    #[pyo3(transparent)]
    Runs(Vec<(i64, PyReadonlyArray2<'py, f64>)>),
}

/// The keywords of a simulation, as a dict of all of them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Keywords<'py> {
    schedule: Tracks<'py>,
    runs: Option<usize>,
    duration: Option<f64>,
    fastest: Option<f64>,
    sensors: String,
    start: [f64; 3],
    inertia: bool,
    longest_step: Option<f64>,
}

impl Keywords<'_> {
    fn settings(self, seed: u64) -> PyResult<SimulateSettings> {
        let usual = SimulateSettings::default();
        let longest_step = self.longest_step.unwrap_or(usual.longest_step);
        if !(1e-5..=0.1).contains(&longest_step) {
            let expected = "expected a time between 0.00001 and 0.1 s";
            return Err(refused("longest_step", longest_step, expected));
        }
        let [x, y, yaw] = self.start;
        if ![x, y, yaw].iter().all(|value| value.is_finite()) {
            return Err(refused("start", format!("{x},{y},{yaw}"), "expected finite numbers"));
        }
        Ok(SimulateSettings {
            driving: driving(self.schedule)?,
            runs: self.runs,
            duration: self.duration,
            fastest: self.fastest,
            sensors: sensors(&self.sensors).map_err(raised)?,
            start: Pose::new(x, y, yaw),
            inertia: self.inertia,
            longest_step,
            seed,
        })
    }
}

fn driving(tracks: Tracks<'_>) -> PyResult<Driving> {
    let runs = match tracks {
        Tracks::Named(name) => {
            return name.display().to_string().parse().map_err(|error: Error| raised(error));
        }
        Tracks::Runs(runs) => runs,
    };
    let run = |(id, commands): (i64, PyReadonlyArray2<'_, f64>)| {
        let rows = commands.as_array();
        let command = |row: numpy::ndarray::ArrayView1<'_, f64>| Command {
            t: row[0],
            speeds: PerSide::new(row[1], row[2]),
        };
        let schedule = Schedule::new(rows.rows().into_iter().map(command).collect());
        let schedule = schedule.map_err(|error| said("schedule", &format!("schedule: {error}")))?;
        Ok(ScheduledRun { id, schedule })
    };
    Ok(Driving::Runs(runs.into_iter().map(run).collect::<PyResult<_>>()?))
}

/// Simulates a robot and records it.
#[pyfunction]
#[pyo3(signature = (vehicle, keywords, seed, progress))]
pub fn simulate(
    py: Python<'_>,
    vehicle: &Vehicle,
    keywords: Keywords<'_>,
    seed: u64,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Simulation> {
    let settings = keywords.settings(seed)?;
    let vehicle = Arc::clone(&vehicle.inner);
    let inner = run(py, progress.as_ref(), move |observer| {
        Prepared::new(&vehicle, &settings)?.run(observer)
    })?;
    Ok(Simulation { inner })
}

/// Simulates several robots at once, each with its seed, in parallel. A part is a robot. One that
/// cannot be simulated has its exception in its place.
#[pyfunction]
#[pyo3(signature = (vehicles, keywords, seeds, progress))]
pub fn simulate_batch(
    py: Python<'_>,
    vehicles: Vec<PyRef<'_, Vehicle>>,
    keywords: Keywords<'_>,
    seeds: Vec<u64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Vec<Py<PyAny>>> {
    if seeds.len() != vehicles.len() {
        let expected = format!("expected one for each of {} vehicles", vehicles.len());
        return Err(refused("seeds", seeds.len(), &expected));
    }
    let settings = keywords.settings(1)?;
    let robots = vehicles.iter().map(|vehicle| (*vehicle.inner).clone());
    let robots: Vec<_> = robots.zip(seeds).collect();
    let all =
        run(py, progress.as_ref(), move |observer| simulate_all(&robots, &settings, observer))?;
    let object = |one: Result<trackdyn::Simulation, Error>| match one {
        Ok(inner) => Ok(Py::new(py, Simulation { inner })?.into_any()),
        Err(error) => Ok(raised(error).into_value(py).into_any()),
    };
    all.into_iter().map(object).collect()
}

#[pymethods]
impl Simulation {
    /// What the sensors recorded.
    #[getter]
    fn recording(&self) -> Recording {
        self.inner.recording.clone().into()
    }

    /// The vehicle as it was driven.
    #[getter]
    fn vehicle(&self) -> Vehicle {
        self.inner.vehicle().clone().into()
    }

    /// The true motion of all runs.
    fn truth<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = self
            .inner
            .paths
            .iter()
            .flat_map(|(id, path)| path.moments().iter().map(move |moment| (*id, moment)));
        let all: Vec<(i64, &Moment)> = all.collect();
        let of = |of: fn(&Moment) -> f64| -> Vec<f64> {
            all.iter().map(|(_, moment)| of(moment)).collect()
        };
        let table = Table::new(py)
            .with::<i64>("run", all.iter().map(|(id, _)| *id).collect())?
            .with("t", of(|at| at.t))?
            .with("x", of(|at| at.pose.x))?
            .with("y", of(|at| at.pose.y))?
            .with("yaw", of(|at| at.pose.yaw))?
            .with("v_forward", of(|at| at.twist.v_x))?
            .with("v_lateral", of(|at| at.twist.v_y))?
            .with("yaw_rate", of(|at| at.twist.w))?
            .with("v_left", of(|at| at.belt_speed.left))?
            .with("v_right", of(|at| at.belt_speed.right))?;
        Ok(table.into_dict())
    }

    /// What it was made from.
    fn document<'py>(&self, py: Python<'py>, command: &str) -> PyResult<Bound<'py, PyAny>> {
        from_toml(py, &self.inner.to_toml(&Provenance::new(command)))
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, folder: PathBuf, command: &str) -> PyResult<Vec<PathBuf>> {
        written(self.inner.write(folder, &Provenance::new(command)))
    }
}
