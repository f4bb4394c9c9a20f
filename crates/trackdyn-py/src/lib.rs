//! The extension module of the Python package `trackdyn`: thin over the library of that name.
//!
//! What a user sees is Python (`python/trackdyn`), with names, units and frames explained there.
//! Here are the calls that it makes. Work that takes long runs on threads of its own, see [`work`];
//! what goes wrong is raised by [`errors`], in the words of the library.

#![allow(clippy::needless_pass_by_value, reason = "values that Python passes are owned")]

mod arrays;
mod arrow;
mod diagnosis;
mod errors;
mod figure;
mod files;
mod identification;
mod inspection;
mod laws;
mod map;
mod motion_table;
mod odometry;
mod options;
mod parameters;
mod plan;
mod recording;
mod ros2;
mod simulation;
mod tables;
mod vehicle;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _trackdyn {
    #[pymodule_export]
    use super::arrow::arrow_stream;
    #[pymodule_export]
    use super::diagnosis::{Diagnosis, diagnose};
    #[pymodule_export]
    use super::figure::Figure;
    #[pymodule_export]
    use super::identification::{Identification, identify};
    #[pymodule_export]
    use super::inspection::inspect;
    #[pymodule_export]
    use super::laws::{law_arguments, register_law, taped};
    #[pymodule_export]
    use super::map::{IcrMap, icr_map};
    #[pymodule_export]
    use super::motion_table::{MotionTable, motion_table};
    #[pymodule_export]
    use super::odometry::{Odometry, odometry};
    #[pymodule_export]
    use super::parameters::Parameters;
    #[pymodule_export]
    use super::plan::{Plan, is_decided, plan};
    #[pymodule_export]
    use super::recording::Recording;
    #[pymodule_export]
    use super::ros2::write_ros2;
    #[pymodule_export]
    use super::simulation::{Simulation, simulate, simulate_batch};
    #[pymodule_export]
    use super::tables::{effects, from_toml, to_toml};
    #[pymodule_export]
    use super::vehicle::Vehicle;

    #[pymodule_export]
    const VERSION: &str = trackdyn::VERSION;
}
