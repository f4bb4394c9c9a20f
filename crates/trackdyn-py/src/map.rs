//! ICR maps.

use crate::arrays::Table;
use crate::errors::refused;
use crate::figure::Figure;
use crate::files::written;
use crate::parameters::Parameters;
use crate::vehicle::Vehicle;
use crate::work::run;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use trackdyn::crates::core::frames::ros_twist_from_paper;
use trackdyn::crates::model::map::GridError;
use trackdyn::crates::model::stationary::{Solution, Status};
use trackdyn::{Circumstance, Grid, MapSettings, Provenance};

/// The stationary motion of a vehicle over a grid of track speeds.
#[pyclass(frozen, module = "trackdyn._trackdyn")]
pub struct IcrMap {
    inner: trackdyn::IcrMap,
}

/// Solves an ICR map.
#[pyfunction]
#[pyo3(signature = (vehicle, points, max_speed, position, heading, time, progress))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn icr_map(
    py: Python<'_>,
    vehicle: &Vehicle,
    points: usize,
    max_speed: f64,
    position: [f64; 2],
    heading: f64,
    time: f64,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<IcrMap> {
    for (name, value) in
        [("position", position[0]), ("position", position[1]), ("heading", heading), ("time", time)]
    {
        if !value.is_finite() {
            return Err(refused(name, value, "expected a finite number"));
        }
    }
    let grid = Grid::new(points, max_speed);
    let grid = grid.map_err(|error| {
        let expected = format!("expected {}", error.expected());
        match error {
            GridError::Points(_) => refused("points", points, &expected),
            _ => refused("max_speed", max_speed, &expected),
        }
    })?;
    let circumstance = Circumstance { position, heading, time };
    let settings = MapSettings { grid, circumstance };
    let vehicle = Arc::clone(&vehicle.inner);
    let inner = run(py, progress.as_ref(), move |observer| {
        trackdyn::IcrMap::solve(&vehicle, &settings, observer)
    })?;
    Ok(IcrMap { inner })
}

#[pymethods]
impl IcrMap {
    /// The speeds of the grid, m/s.
    #[getter]
    fn speeds(&self) -> Vec<f64> {
        self.inner.solved().grid.speeds()
    }

    /// A row for each pair of speeds, those of the left track outermost.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = &self.inner.solved().solutions;
        let of = |of: fn(&Solution) -> f64| -> Vec<f64> { all.iter().map(of).collect() };
        let icr = |place: usize| -> Vec<f64> {
            let value = |one: &Solution| {
                one.icrs
                    .filter(|_| one.status == Status::Turning)
                    .map_or(f64::NAN, |icrs| icrs.to_array()[place])
            };
            all.iter().map(value).collect()
        };
        let moves = |one: &Solution| {
            matches!(one.status, Status::Turning | Status::Straight | Status::Holds(_))
        };
        let twist = |place: usize| -> Vec<f64> {
            let value = |one: &Solution| {
                let twist = ros_twist_from_paper(&one.twist);
                if moves(one) { [twist.v_x, twist.v_y, twist.w][place] } else { f64::NAN }
            };
            all.iter().map(value).collect()
        };
        #[expect(clippy::cast_possible_wrap, reason = "an index of five")]
        let status = all.iter().map(|one| one.status.index() as i64).collect();
        let table = Table::new(py)
            .with("v_left", of(|one| one.track_speed.left))?
            .with("v_right", of(|one| one.track_speed.right))?
            .with("x_l", icr(0))?
            .with("x_r", icr(1))?
            .with("y", icr(2))?
            .with("v_forward", twist(0))?
            .with("v_lateral", twist(1))?
            .with("yaw_rate", twist(2))?
            .with::<i64>("status", status)?;
        Ok(table.into_dict())
    }

    /// Names of the kinds of motion, by their number in the column status.
    #[staticmethod]
    fn status_names() -> [&'static str; 5] {
        Status::NAMES
    }

    /// Means and spreads; none where no motion turns.
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(of) = self.inner.statistics() else { return Ok(None) };
        let dict = PyDict::new(py);
        dict.set_item("count", of.count)?;
        for (suffix, icrs) in [("", &of.mean), ("_spread", &of.spread)] {
            dict.set_item(format!("x_l{suffix}"), icrs.x_left)?;
            dict.set_item(format!("x_r{suffix}"), icrs.x_right)?;
            dict.set_item(format!("y{suffix}"), icrs.y)?;
        }
        dict.set_item("steering_efficiency", of.steering_efficiency)?;
        dict.set_item("eccentricity", of.eccentricity)?;
        dict.set_item("mean_steering_efficiency", of.mean_steering_efficiency)?;
        dict.set_item("mean_eccentricity", of.mean_eccentricity)?;
        Ok(Some(dict))
    }

    /// The parameters to drive with; none where no motion turns.
    fn parameters(&self, command: &str) -> Option<Parameters> {
        self.inner.parameters(&Provenance::new(command)).map(Parameters::from)
    }

    /// The map as a figure.
    fn figure(&self, command: &str) -> Figure {
        self.inner.figure(&Provenance::new(command)).into()
    }

    /// Writes its files into a folder; those that were written.
    fn write(&self, folder: PathBuf, command: &str) -> PyResult<Vec<PathBuf>> {
        written(self.inner.write(folder, &Provenance::new(command)))
    }
}
