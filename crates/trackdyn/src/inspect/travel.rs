//! Way of the poses per way of the tracks.
//!
//! # Law
//! x = k (D_r + D_l)/2 + c Δψ over a segment, eq. (8): x is the way forward and Δψ the turn of the
//! poses, D the ways of the tracks, and k is 1 where the wheel radius is right and nothing slips.

use trackdyn_core::real;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_estimate::Observations;
use trackdyn_estimate::observations::Observation;

/// Fewest segments.
const MIN_SEGMENTS: usize = 20;

/// Largest standard error of k, in k.
const MAX_ERROR: f64 = 0.03;

/// Residuals that count, in standard deviations.
const MAX_RESIDUAL: f64 = 3.0;

/// Times that residuals are looked at.
const ROUNDS: usize = 5;

/// k; none where the segments do not show it.
pub(super) fn travel_ratio(observations: &Observations) -> Option<f64> {
    let of = |segment: &Observation| {
        let travelled = observations.travelled(segment);
        let [forward, _, turn] = segment.motion;
        [forward, f64::midpoint(travelled.left, travelled.right), turn]
    };
    let all: Vec<[f64; 3]> = observations.segments().iter().map(of).collect();
    let mut fit = Fit::of(&all)?;
    for _ in 0..ROUNDS {
        let mut sizes: Vec<f64> = all.iter().map(|row| fit.residual(row)).collect();
        let limit = MAX_RESIDUAL * deviation_about_zero(&mut sizes)?;
        let within = |row: &&[f64; 3]| fit.residual(row).abs() <= limit;
        let Some(next) = Fit::of(&all.iter().filter(within).copied().collect::<Vec<_>>()) else {
            break;
        };
        fit = next;
    }
    (fit.ratio > 0.0 && fit.error <= MAX_ERROR * fit.ratio).then_some(fit.ratio)
}

/// Least squares.
struct Fit {
    /// k.
    ratio: f64,
    /// c, m.
    lever: f64,
    /// Standard error of k.
    error: f64,
}

impl Fit {
    /// Of rows x, (D_r + D_l)/2, Δψ.
    fn of(rows: &[[f64; 3]]) -> Option<Self> {
        let sum = |a: usize, b: usize| rows.iter().map(|row| row[a] * row[b]).sum::<f64>();
        let (ways, turns, both) = (sum(1, 1), sum(2, 2), sum(1, 2));
        // without turning, the way alone counts
        let turns = if turns > 0.0 { turns } else { 1.0 };
        let determinant = ways * turns - both * both;
        if rows.len() < MIN_SEGMENTS || determinant <= f64::EPSILON * ways * turns {
            return None;
        }
        let ratio = (sum(0, 1) * turns - sum(0, 2) * both) / determinant;
        let lever = (sum(0, 2) * ways - sum(0, 1) * both) / determinant;
        let fit = Self { ratio, lever, error: 0.0 };
        let left: f64 = rows.iter().map(|row| fit.residual(row).powi(2)).sum();
        let variance = left / real(rows.len() - 2);
        Some(Self { error: (variance * turns / determinant).sqrt(), ..fit })
    }

    fn residual(&self, [forward, way, turn]: &[f64; 3]) -> f64 {
        forward - self.ratio * way - self.lever * turn
    }
}
