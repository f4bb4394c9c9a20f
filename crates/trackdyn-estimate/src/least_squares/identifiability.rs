//! What a recording cannot identify.

use super::Estimate;
use super::covariance::MIN_EIGENVALUE_RATIO;
use crate::doubt::Doubt;
use crate::noise::Noise;
use crate::observations::Observations;
use crate::parameters::Free;
use crate::sensor::Nuisance;
use nalgebra::{Matrix2, Vector2};
use trackdyn_core::Side;

/// Largest standard deviation of an ICR, in gauges, with which a robot can be driven.
const MAX_ICR_DEVIATION: f64 = 0.25;

/// Largest standard deviation of α with which a robot can be driven.
const MAX_ALPHA_DEVIATION: f64 = 0.1;

/// Smallest ratio of the variance of the driving to that of the encoders' noise: below, noise
/// passes for driving and biases the estimate by a tenth or more.
const MIN_EXCITATION: f64 = 10.0;

/// Smallest ratio of the variance of speed changes to that of their noise: below, they are mostly
/// noise.
const MIN_CHANGE_RATIO: f64 = 1.0;

/// What the driving of a recording lacks for these parameters; none where it lacks nothing. `noise`
/// is that of the recording.
pub fn lacks(observations: &Observations, noise: &Noise, free: Free) -> Option<Doubt> {
    let ratio = poorest_excitation(observations, noise, free);
    (ratio < MIN_EXCITATION).then_some(match free {
        Free::Icrs => Doubt::NoTurning,
        Free::IcrsAndAlphas => Doubt::OneRatio,
    })
}

/// What the driving of a recording lacks for a property of the sensor; none where it lacks nothing.
pub fn lacks_nuisance(
    observations: &Observations,
    noise: &Noise,
    nuisance: Nuisance,
) -> Option<Doubt> {
    match nuisance {
        Nuisance::LeverArm => Some(Doubt::LeverArm),
        Nuisance::SensorYaw => {
            let ratio = translation(observations, noise);
            (ratio < MIN_EXCITATION).then_some(Doubt::NoTranslation)
        }
        Nuisance::TimeOffset => {
            let ratio = changes(observations, noise);
            (ratio < MIN_CHANGE_RATIO).then_some(Doubt::NoChange)
        }
    }
}

/// The properties of the sensor in an estimate that are too uncertain to be of use.
pub fn nuisance_doubts(estimate: &Estimate) -> Vec<Doubt> {
    let fitted = estimate.unknowns.nuisances.iter();
    fitted
        .filter_map(|&nuisance| {
            let deviation = estimate.nuisance(nuisance)?.deviation;
            let wide = deviation.is_nan() || deviation > nuisance.limit();
            wide.then_some(Doubt::WideNuisance { nuisance, deviation })
        })
        .collect()
}

/// Variance of (V_r + V_l)/2, as far as V_r − V_l does not explain it, over that of its noise.
///
/// A point of the body moves straight ahead with (V_r + V_l)/2, plus ω times a vector that the ICRs
/// fix. ψ turns the first part. Its effect on the second part equals that of other ICRs.
fn translation(observations: &Observations, noise: &Noise) -> f64 {
    let per_second = variance_per_second(noise);
    let (mut means, mut mixed, mut differences, mut variance) = (0.0, 0.0, 0.0, 0.0);
    for segment in observations.segments() {
        let speed = observations.travelled(segment).map(|distance| distance / segment.duration);
        let (mean, difference) = (f64::midpoint(speed.right, speed.left), speed.right - speed.left);
        means += mean * mean;
        mixed += mean * difference;
        differences += difference * difference;
        variance += per_second / (2.0 * segment.duration);
    }
    let explained = if differences > 0.0 { mixed * mixed / differences } else { 0.0 };
    over_noise(means - explained, variance, means)
}

/// Variance of the change of track speeds from the beginning to the end of segments over that of
/// their noise.
fn changes(observations: &Observations, noise: &Noise) -> f64 {
    let variance =
        |side: Side| noise.encoders[side].map_or(0.0, |noise| 2.0 * noise.deviation.powi(2));
    let of_noise = variance(Side::Left) + variance(Side::Right);
    let (mut squares, mut expected, mut speeds) = (0.0, 0.0, 0.0);
    for segment in observations.segments() {
        if let [first, .., last] = observations.pieces(segment) {
            squares +=
                (last.v_left - first.v_left).powi(2) + (last.v_right - first.v_right).powi(2);
            expected += of_noise;
            speeds += first.v_left.powi(2) + first.v_right.powi(2);
        }
    }
    over_noise(squares, expected, speeds)
}

/// Variance of the mean of an encoder's speeds over a second, m²/s²; zero where its noise was not
/// measured.
fn variance_per_second(noise: &Noise) -> f64 {
    let encoder = |side: Side| {
        noise.encoders[side].map_or(0.0, |noise| noise.deviation.powi(2) * noise.update_interval)
    };
    f64::midpoint(encoder(Side::Left), encoder(Side::Right))
}

/// Variance of driving over that of its noise; `driven` contains both. Infinite without noise,
/// unless what was driven is rounding of `all`.
fn over_noise(driven: f64, noise: f64, all: f64) -> f64 {
    if noise > 0.0 {
        driven / noise - 1.0
    } else if driven > MIN_EIGENVALUE_RATIO * all {
        f64::INFINITY
    } else {
        0.0
    }
}

/// The parameters of an estimate that are too uncertain for a vehicle with this gauge, m.
pub fn doubts(estimate: &Estimate, gauge: f64) -> Vec<Doubt> {
    too_wide(&estimate.deviations()[..estimate.unknowns.free.count()], gauge)
}

/// The parameters whose standard deviations are too large for a vehicle with this gauge, m.
pub(crate) fn too_wide(deviations: &[f64], gauge: f64) -> Vec<Doubt> {
    let deviations = deviations.iter().copied().enumerate();
    deviations
        .filter_map(|(parameter, deviation)| {
            let limit = if parameter < 3 { MAX_ICR_DEVIATION * gauge } else { MAX_ALPHA_DEVIATION };
            let wide = deviation.is_nan() || deviation > limit;
            wide.then_some(Doubt::Wide { parameter, deviation, limit })
        })
        .collect()
}

/// Variance of the driving over that of the encoders' noise: of V_r − V_l for the ICRs alone; with
/// α, in the direction of the (V_l, V_r) plane in which the recording drives least.
fn poorest_excitation(observations: &Observations, noise: &Noise, free: Free) -> f64 {
    let per_second = variance_per_second(noise);
    let mut moments = Matrix2::zeros();
    let mut variance = 0.0;
    for segment in observations.segments() {
        let travelled = observations.travelled(segment);
        let speed = Vector2::new(travelled.left, travelled.right) / segment.duration;
        moments += speed * speed.transpose();
        // The mean of T/u readings of variance σ²
        variance += per_second / segment.duration;
    }
    let least = match free {
        Free::Icrs => {
            let across = Vector2::new(-1.0, 1.0).normalize();
            across.dot(&(moments * across))
        }
        Free::IcrsAndAlphas => moments.symmetric_eigenvalues().min(),
    };
    over_noise(least, variance, moments.trace())
}
