//! ICRs by cells of driving: manoeuvre, speed and direction.

use super::IcrColumns;
use super::contrasts::Manoeuvre;
use crate::evidence::Sample;
use crate::normal::{Columns, Normal, Prior};
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_core::real;

/// A cell of driving, and the departure of its ICRs from the fitted ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Manoeuvre.
    pub manoeuvre: Manoeuvre,
    /// Third of the speed distribution, 0 the slowest.
    pub speed: usize,
    /// Whether it drives forward; for spins, to the left.
    pub forward: bool,
    /// Mean speed of the faster track, m/s.
    pub mean_speed: f64,
    /// Number of samples.
    pub samples: usize,
    /// Departure of x_l, x_r and y with its standard deviation, m.
    pub departure: [(f64, f64); 3],
}

impl Cell {
    /// Which way it drives, in words.
    pub fn way(&self) -> &'static str {
        match (self.manoeuvre, self.forward) {
            (Manoeuvre::Spin, true) => "to the left",
            (Manoeuvre::Spin, false) => "to the right",
            (_, true) => "forward",
            (_, false) => "backward",
        }
    }
}

/// All cells with enough samples that turn.
pub fn cells(evidence: &Weighted, residual: &[Vector3<f64>], icrs: &IcrColumns) -> Vec<Cell> {
    let bounds = thirds(evidence.samples());
    bounds.map_or_else(Vec::new, |bounds| cells_within(bounds, evidence, residual, icrs))
}

/// Speed of the faster track, m/s.
fn fast(sample: &Sample) -> f64 {
    sample.speeds.left.abs().max(sample.speeds.right.abs())
}

/// Speeds between the thirds of the samples that move, m/s; none where none does.
pub fn thirds<'a>(samples: impl IntoIterator<Item = &'a Sample>) -> Option<[f64; 2]> {
    let speeds = samples.into_iter().map(fast).filter(|speed| *speed > 0.0);
    let mut speeds: Vec<f64> = speeds.collect();
    speeds.sort_by(f64::total_cmp);
    let count = speeds.len();
    (count > 0).then(|| [speeds[count / 3], speeds[2 * count / 3]])
}

/// All cells with enough samples that turn, between these speeds, m/s.
pub fn cells_within(
    bounds: [f64; 2],
    evidence: &Weighted,
    residual: &[Vector3<f64>],
    icrs: &IcrColumns,
) -> Vec<Cell> {
    let (samples, settings) = (evidence.samples(), &evidence.settings().location);
    let columns: Vec<Vec<Vector3<f64>>> =
        icrs.iter().map(|column| evidence.white(column.clone())).collect();
    let weights = evidence.weights(residual);
    let mut cells = Vec::new();
    for manoeuvre in [Manoeuvre::Arc, Manoeuvre::CounterRotation, Manoeuvre::Spin] {
        for speed in 0..3 {
            for forward in [true, false] {
                let inside = |sample: &Sample| {
                    let third = bounds.iter().filter(|bound| fast(sample) > **bound).count();
                    let ahead = if manoeuvre == Manoeuvre::Spin {
                        sample.speeds.right > sample.speeds.left
                    } else {
                        sample.speeds.left + sample.speeds.right > 0.0
                    };
                    Manoeuvre::of(sample, settings) == manoeuvre
                        && third == speed
                        && ahead == forward
                };
                let chosen: Vec<usize> =
                    (0..samples.len()).filter(|&k| inside(&samples[k])).collect();
                if chosen.len() < settings.min_samples_shown {
                    continue;
                }
                let mean_speed =
                    chosen.iter().map(|&k| fast(&samples[k])).sum::<f64>() / real(chosen.len());
                let pick = |of: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
                    chosen.iter().map(|&k| of[k]).collect()
                };
                let some: Vec<Vec<Vector3<f64>>> = columns.iter().map(|of| pick(of)).collect();
                let normal = Normal::new(&Columns {
                    residual: &pick(residual),
                    columns: &some,
                    weights: &chosen.iter().map(|&k| weights[k]).collect::<Vec<_>>(),
                    blocks: &vec![0; chosen.len()],
                    count: 1,
                });
                let wide = Prior::normal(0.0, settings.shown_deviation);
                let fit = normal.fit(&[0, 1, 2], &[wide; 3]);
                let departure =
                    std::array::from_fn(|k| (fit.estimate[k], fit.covariance[(k, k)].sqrt()));
                cells.push(Cell {
                    manoeuvre,
                    speed,
                    forward,
                    mean_speed,
                    samples: chosen.len(),
                    departure,
                });
            }
        }
    }
    cells
}
