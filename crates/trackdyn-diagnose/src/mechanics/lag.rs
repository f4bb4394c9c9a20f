//! The linear answer to acceleration.
//!
//! # Law
//! Λ (u̇_s + δ̇) + δ = 0 near the stationary motion u_s, see [`trackdyn_motion::lag`]. Friction with its full value at any
//! slip lets a robot lag by some milliseconds, friction that grows with the slip speed by tens.

use super::belts::lagging;
use super::minus;
use crate::surface::{Lags, Surface};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use trackdyn_core::{PerSide, Twist};
use trackdyn_physics::{Drive, Model};
use trackdyn_recording::TrackSample;

/// How far the motion of a model, with these stationary motions, departs from them while each reading holds (paper's
/// frame).
pub fn linear_answer(
    surface: &Surface,
    model: &Model,
    drive: &Drive,
    tracks: &[Vec<TrackSample>],
) -> Vec<Vec<Twist>> {
    let lags = surface.lags(model);
    let belts = lagging(tracks, drive.time_constant);
    belts.par_iter().map(|run| departures(surface, &lags, drive, run)).collect()
}

/// One linear answer less another.
pub fn difference(one: &[Vec<Twist>], other: &[Vec<Twist>]) -> Vec<Vec<Twist>> {
    let runs = one.iter().zip(other);
    runs.map(|(one, other)| one.iter().zip(other).map(|(one, other)| minus(one, other)).collect())
        .collect()
}

fn departures(surface: &Surface, lags: &Lags, drive: &Drive, run: &[TrackSample]) -> Vec<Twist> {
    let (mut departure, mut before) = (Vector3::zeros(), None);
    let one = |(k, reading): (usize, &TrackSample)| {
        let held = run.get(k + 1).map_or(0.0, |next| next.t - reading.t);
        let speeds = drive.driven(PerSide::new(reading.v_left, reading.v_right));
        let Twist { v_x, v_y, w } = surface.motion(speeds).twist(&[0.0; 3]);
        let steady = Vector3::new(v_x, v_y, w);
        let change = steady - before.replace(steady).unwrap_or(steady);
        // (Λ + h) δ_k = Λ (δ_{k−1} − Δu_s): all of a step of u_s adds up to −Λ Δu_s
        let lag = lags.at(speeds);
        let inverse = (lag + Matrix3::identity() * held).try_inverse();
        departure =
            inverse.map_or_else(Vector3::zeros, |inverse| inverse * (lag * (departure - change)));
        Twist { v_x: departure[0], v_y: departure[1], w: departure[2] }
    };
    run.iter().enumerate().map(one).collect()
}
