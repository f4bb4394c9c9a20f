//! The ICR map: stationary motions over a grid of track speeds.

mod grid;
mod sector;
mod statistics;

pub use grid::{Grid, GridError};
pub use sector::Sector;
pub use statistics::Statistics;

use crate::custom::together;
use crate::stationary::{Solution, Stationary, Status};
use crate::{Circumstance, Model};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use trackdyn_core::PerSide;

/// Stationary motions for every pair of track speeds of a grid.
#[derive(Clone, Debug)]
pub struct IcrMap {
    /// The speeds.
    pub grid: Grid,
    /// One solution per pair, V_l outermost, both ascending.
    pub solutions: Vec<Solution>,
    /// Gauge of the vehicle, m.
    pub gauge: f64,
}

impl IcrMap {
    /// Solves every pair in parallel. `progress` receives the number of pairs of each finished row,
    /// or one for each pair where pairs share calls of a law.
    ///
    /// Each pair is solved independently from a cold start, so the map does not depend on the
    /// number of threads.
    ///
    /// # Panics
    /// Never: `progress` cannot cancel.
    pub fn solve(
        model: &Model,
        grid: Grid,
        circumstance: &Circumstance,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Self {
        let unstopped = |pairs| {
            progress(pairs);
            ControlFlow::Continue(())
        };
        Self::solve_unless_stopped(model, grid, circumstance, &unstopped)
            .expect("progress never asks to stop")
    }

    /// Like [`IcrMap::solve`], but `progress` may cancel: then there is no map.
    pub fn solve_unless_stopped(
        model: &Model,
        grid: Grid,
        circumstance: &Circumstance,
        progress: &(dyn Fn(usize) -> ControlFlow<()> + Sync),
    ) -> Option<Self> {
        let solver = Stationary::new(model, circumstance);
        let speeds = grid.speeds();
        let gauge = model.vehicle().gauge;
        if model.effects().share_calls() {
            let pairs: Vec<PerSide<f64>> = (speeds.iter())
                .flat_map(|&left| speeds.iter().map(move |&right| PerSide::new(left, right)))
                .collect();
            let is_stopped = AtomicBool::new(false);
            let solved = together(&pairs, true, |&pair| {
                let is_wanted = || !is_stopped.load(Ordering::Relaxed);
                let solution = is_wanted().then(|| solver.solve(pair))?;
                if progress(1).is_break() {
                    is_stopped.store(true, Ordering::Relaxed);
                }
                is_wanted().then_some(solution)
            });
            let solutions = solved.into_iter().collect::<Option<_>>()?;
            return Some(Self { grid, solutions, gauge });
        }
        let row = |&left: &f64| -> Option<Vec<Solution>> {
            let row = speeds.iter().map(|&right| solver.solve(PerSide::new(left, right))).collect();
            progress(speeds.len()).is_continue().then_some(row)
        };
        let rows: Option<Vec<Vec<Solution>>> = speeds.par_iter().map(row).collect();
        Some(Self { grid, solutions: rows?.concat(), gauge })
    }

    /// Solutions in which the robot turns; only these have ICRs.
    pub fn turning(&self) -> impl Iterator<Item = &Solution> {
        self.solutions.iter().filter(|solution| solution.status == Status::Turning)
    }

    /// Motions in which part of the contact has lifted.
    pub fn lifted(&self) -> impl Iterator<Item = &Solution> {
        self.solutions.iter().filter(|solution| {
            solution.is_lifted && !matches!(solution.status, Status::Tips | Status::NotConverged)
        })
    }

    /// Number of solutions of each kind, in the order of [`Status::NAMES`].
    pub fn counts(&self) -> [usize; 5] {
        let mut counts = [0; 5];
        for solution in &self.solutions {
            counts[solution.status.index()] += 1;
        }
        counts
    }

    /// Means and standard deviations over the turning motions; none where the robot never turns.
    pub fn statistics(&self) -> Option<Statistics> {
        Statistics::of(self.turning().filter_map(|solution| solution.icrs), self.gauge)
    }

    /// Means and standard deviations by the signs of V_l, V_r and |V_r| − |V_l| (sec. 4.1), where
    /// these explain nine tenths of the variance of x_l, x_r or y; empty otherwise.
    pub fn sectors(&self) -> Vec<Sector> {
        sector::sectors(self)
    }
}
