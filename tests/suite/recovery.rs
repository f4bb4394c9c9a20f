//! Parameters that were put into a recording come out of it.

mod contradictions;
mod corrupted;
mod coverage;
mod manual;
mod methods;
mod responses;
mod sensor;
mod steady;

use rayon::prelude::*;
use trackdyn_core::PerSide;
use trackdyn_estimate::SegmentOptions;
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::noise::{self, noise};
use trackdyn_estimate::synthetic::{ConstantIcr, Stretch, Synthetic, random_steps};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_estimate::{
    Error, Estimate, Free, Observations, Parameters, Weighting, least_squares,
};
use trackdyn_model::Kinematics;
use trackdyn_recording::Recording;

/// Gauge of the vehicle that drives, m.
const GAUGE: f64 = 0.42;

/// x_l, x_r, y, α_l, α_r of the vehicle that drives.
const TRUTH: [f64; 5] = [-0.375, 0.457, 0.049, 0.98, 1.01];

/// Nine runs of random steps, each a whole number of readings long, with noisy encoders and poses.
fn drive(seed: u64) -> Recording {
    let schedules = (0..9).map(|run| random_steps(12, 1.98, 0.8, 100 * seed + run)).collect();
    record(schedules, seed)
}

fn record(schedules: Vec<Vec<Stretch>>, seed: u64) -> Recording {
    let [x_left, x_right, y, left, right] = TRUTH;
    let kinematics = ConstantIcr { x_left, x_right, y, alpha: PerSide::new(left, right) };
    let synthetic = Synthetic {
        kinematics,
        schedules,
        track_interval: 0.03,
        pose_interval: 0.09,
        encoder_noise: 0.02,
        position_noise: 0.002,
        yaw_noise: 0.002,
        seed,
        ..Synthetic::default()
    };
    synthetic.recording().expect("long enough")
}

fn observe(recording: &Recording) -> Observations {
    Observations::new(recording, &SegmentOptions::default())
}

fn start() -> Parameters {
    Parameters::of(&Kinematics::ideal(GAUGE))
}

/// Least squares with the noise that the recording shows.
fn fit(recording: &Recording, free: Free) -> Result<Estimate, Error> {
    let measured = SegmentNoise::measured(&noise(recording, 0.0, &noise::Settings::default()), 0.8)
        .expect("steady driving");
    let weighting = Weighting::Noise(measured);
    least_squares(&observe(recording), &start(), &free.into(), &weighting, Loss::Huber)
}

/// Shares of `count` draws, with the seeds from `seed` on, in which each of N intervals holds the
/// truth.
fn shares<const N: usize>(
    count: u32,
    seed: u64,
    holds: impl Fn(u64) -> [bool; N] + Sync,
) -> [f64; N] {
    let hits: Vec<[bool; N]> =
        (0..count).into_par_iter().map(|k| holds(seed + u64::from(k))).collect();
    std::array::from_fn(|k| {
        let share = hits.iter().map(|hit| f64::from(u8::from(hit[k])));
        share.sum::<f64>() / f64::from(count)
    })
}
