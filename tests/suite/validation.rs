//! Published results and reference figures, one file each.

mod centripetal_cloud;
mod held_out;
mod identified_distances;
mod independent_ground;
mod martinez_2005_asymmetric;
mod martinez_2005_symmetric;
mod operating_points;
mod paper_chain;
mod recordings;
mod two_simulators;

use trackdyn_model::map::Statistics;
use trackdyn_model::{Circumstance, Model};
use trackdyn_model::{Grid, IcrMap};

/// Statistics of the map over ±1 m/s with 11 speeds per track.
fn map_statistics(model: &Model) -> Statistics {
    let grid = Grid::new(11, Grid::PAPER_SPEED).expect("a grid");
    let map = IcrMap::solve(model, grid, &Circumstance::default(), &|_| ());
    map.statistics().expect("the robot turns")
}

/// Compares named numbers, each with its tolerance.
fn compare(rows: &[(&str, f64, f64, f64)]) {
    for (name, ours, theirs, tolerance) in rows {
        assert!(
            (ours - theirs).abs() <= *tolerance,
            "{name}: {ours} is not {theirs} within {tolerance}"
        );
    }
}
