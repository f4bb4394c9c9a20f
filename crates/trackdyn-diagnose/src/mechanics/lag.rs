//! What laws change in the answer to acceleration, where these are in no motion in time.
//!
//! # Law
//! Λ (u̇_s + δ̇) + δ = 0 near the stationary motion u_s, see [`trackdyn_motion::lag`]: the departure δ with these laws
//! less that without. Friction that grows with the slip speed lets a robot drift by tens of milliseconds, where
//! Coulomb's lets it by a few.

use super::minus;
use crate::surface::Lags;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use trackdyn_core::{PerSide, Twist};
use trackdyn_physics::Drive;
use trackdyn_recording::TrackSample;

/// What laws add to the twist (paper's frame) at each reading, from the lags with and without
/// them, the readings of belts that follow the encoders as `drive` says, and the stationary twists there.
pub fn by_lag(
    [with, without]: [&Lags; 2],
    drive: &Drive,
    belts: &[Vec<TrackSample>],
    steady: &[Vec<Twist>],
) -> Vec<Vec<Twist>> {
    let runs = belts.par_iter().zip(steady);
    runs.map(|(belts, steady)| {
        let of = |lags: &Lags| departures(lags, drive, belts, steady);
        of(with).iter().zip(of(without)).map(|(with, without)| minus(with, &without)).collect()
    })
    .collect()
}

/// How far the motion departs from the stationary one while each reading holds.
fn departures(lags: &Lags, drive: &Drive, belts: &[TrackSample], steady: &[Twist]) -> Vec<Twist> {
    let vector = |twist: &Twist| Vector3::new(twist.v_x, twist.v_y, twist.w);
    let mut departure = Vector3::zeros();
    (0..belts.len())
        .map(|k| {
            let TrackSample { t, v_left, v_right } = belts[k];
            let held = belts.get(k + 1).map_or(0.0, |next| next.t - t);
            let lag = lags.at(drive.driven(PerSide::new(v_left, v_right)));
            let change = vector(&steady[k]) - vector(&steady[k.saturating_sub(1)]);
            // (Λ + h) δ_k = Λ (δ_{k−1} − Δu_s): all of a step of u_s adds up to −Λ Δu_s
            let inverse = (lag + Matrix3::identity() * held).try_inverse();
            departure = inverse
                .map_or_else(Vector3::zeros, |inverse| inverse * (lag * (departure - change)));
            Twist { v_x: departure[0], v_y: departure[1], w: departure[2] }
        })
        .collect()
}
