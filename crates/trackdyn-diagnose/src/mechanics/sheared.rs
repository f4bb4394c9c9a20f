//! What laws of the shear stress change in the motion in time.
//!
//! # Law
//! A motion in time with these laws takes a quadrature for each of many balances of forces. One step of Newton's method
//! from near it takes one: with û the motion without the laws, moved by what they change in the stationary motion, and G
//! the sum of forces,
//!
//! ```text
//! G_u ε + G_a ε̇ = −G(û, û̇)
//! ```
//!
//! and û + ε is the motion with them, but for what is of second order in what they change. In stationary motion ε is
//! zero. By the implicit Euler rule over the steps of the motion without,
//! (G_u + G_a/h) ε_k = G_a ε_{k−1}/h − G.

use super::{minus, plus};
use nalgebra::Vector3;
use trackdyn_core::frames::paper_twist_from_ros;
use trackdyn_core::{PerSide, Trajectory, Twist};
use trackdyn_motion::Forces;
use trackdyn_recording::TrackSample;

/// A run without the laws.
pub struct Without<'a> {
    /// Its motion in time.
    pub path: &'a Trajectory,
    /// Speeds of the belts, m/s.
    pub belts: &'a [TrackSample],
    /// The stationary twist at each of their readings.
    pub steady: &'a [Twist],
}

/// What the laws add to the twist (paper's frame) while each reading of a run holds. `forces` are those with and without
/// the laws, `steady` is the stationary twist with them at each reading.
pub fn departures(forces: [&Forces; 2], run: &Without, steady: &[Twist]) -> Vec<Twist> {
    let still = Twist { v_x: 0.0, v_y: 0.0, w: 0.0 };
    let mut added = vec![still; run.belts.len()];
    let moments = run.path.moments();
    let [with, without] = forces;
    let mut epsilon = Vector3::zeros();
    let mut next = 1;
    for (reading, pair) in run.belts.windows(2).enumerate() {
        let [from, until] = [pair[0].t, pair[1].t];
        let speeds = PerSide::new(pair[0].v_left, pair[0].v_right);
        let (here, there) = (&steady[reading], &run.steady[reading]);
        let shift = minus(here, there);
        // What the tables and rules of both leave of a stationary motion is no change of it.
        let rest = with.sum(speeds, here, &still) - without.sum(speeds, there, &still);
        let mut sum = Vector3::zeros();
        while let Some(moment) = moments.get(next).filter(|moment| moment.t <= until) {
            let before = &moments[next - 1];
            next += 1;
            let h = moment.t - before.t;
            if h <= 0.0 {
                continue;
            }
            let twist = paper_twist_from_ros(&moment.twist);
            let change = minus(&twist, &paper_twist_from_ros(&before.twist));
            let rate = Twist { v_x: change.v_x / h, v_y: change.v_y / h, w: change.w / h };
            let belts = moment.belt_speed;
            let (force, [by_twist, by_rate]) = with.near(belts, &plus(&twist, &shift), &rate);
            let by_rate = by_rate / h;
            let off = force - without.sum(belts, &twist, &rate) - rest;
            epsilon = (by_twist + by_rate)
                .try_inverse()
                .map(|inverse| inverse * (by_rate * epsilon - off))
                .filter(|epsilon| epsilon.iter().all(|value| value.is_finite()))
                .unwrap_or_default();
            sum += epsilon * h;
        }
        let held = until - from;
        if held > 0.0 {
            let mean = sum / held;
            added[reading] = Twist { v_x: mean[0], v_y: mean[1], w: mean[2] };
        }
    }
    added
}
