//! What laws of the shear stress change in the motion in time.
//!
//! # Law
//! A motion in time with these laws takes a quadrature for each of many balances of forces. One step of Newton's method
//! from near it takes two. With û the motion without the laws, D what they add to it, and G and G₀ the sums of forces with and
//! without them, by the implicit Euler rule over the steps of û,
//!
//! ```text
//! G(û_k + D_k, û̇_k + (D_k − D_{k−1})/h) = G₀(û_k, û̇_k)
//! ```
//!
//! from D_k as it is in stationary motion on: (G_u + G_a/h) δ = G₀ − G. Of δ as much is taken as comes nearer to a balance: where a
//! track nearly sticks a law may be steep, and the whole of it lead far away.

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

/// Shares of a step of Newton's method, the first of which that comes nearer to a balance of forces is taken.
const SHARES: [f64; 3] = [1.0, 0.3, 0.1];

/// What the laws add to the twist (paper's frame) while each reading of a run holds. `forces` are those with and without
/// the laws, `steady` is the stationary twist with them at each reading.
pub fn departures(forces: [&Forces; 2], run: &Without, steady: &[Twist]) -> Vec<Twist> {
    let still = Twist { v_x: 0.0, v_y: 0.0, w: 0.0 };
    let mut added = vec![still; run.belts.len()];
    let moments = run.path.moments();
    let [with, without] = forces;
    let gauge = with.model.vehicle().gauge;
    let size = |force: &Vector3<f64>| force[0].hypot(force[1]).hypot(force[2] / gauge);
    // What is added to the motion without the laws, at the end of the step before.
    let mut before_added = Vector3::zeros();
    let mut next = 1;
    for (reading, pair) in run.belts.windows(2).enumerate() {
        let [from, until] = [pair[0].t, pair[1].t];
        let speeds = PerSide::new(pair[0].v_left, pair[0].v_right);
        let (here, there) = (&steady[reading], &run.steady[reading]);
        let shift = vector(&minus(here, there));
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
            let rate = twist_of(&(vector(&change) / h));
            let belts = moment.belt_speed;
            let balance = without.sum(belts, &twist, &rate) + rest;
            let at = |added: &Vector3<f64>| {
                let faster = (added - before_added) / h;
                (plus(&twist, &twist_of(added)), plus(&rate, &twist_of(&faster)))
            };
            let (moved, moved_rate) = at(&shift);
            let (force, [by_twist, by_rate]) = with.near(belts, &moved, &moved_rate);
            let off = force - balance;
            let step = (by_twist + by_rate / h).try_inverse().map(|inverse| -(inverse * off));
            let nearer = step.and_then(|step| {
                let shares = SHARES.iter().map(|share| shift + step * *share);
                shares.into_iter().find(|added| {
                    let (moved, moved_rate) = at(added);
                    size(&(with.sum(belts, &moved, &moved_rate) - balance)) < size(&off)
                })
            });
            before_added = nearer.unwrap_or(shift);
            sum += (before_added - shift) * h;
        }
        let held = until - from;
        if held > 0.0 {
            added[reading] = twist_of(&(sum / held));
        }
    }
    added
}

fn vector(twist: &Twist) -> Vector3<f64> {
    Vector3::new(twist.v_x, twist.v_y, twist.w)
}

fn twist_of(vector: &Vector3<f64>) -> Twist {
    Twist { v_x: vector[0], v_y: vector[1], w: vector[2] }
}
