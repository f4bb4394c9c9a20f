//! A gyroscope as evidence of the yaw of poses.
//!
//! # Law
//! A pose at time t has the yaw ψ = ψ₀ + s G(t − τ) + b t + x(t) + e. G is the integral of the
//! measured yaw rate, s the gyroscope's scale, τ how late poses are against it, b its bias in the
//! run, x a random walk (its noise, its drift and that of the poses) and e the white noise of the
//! pose. s, τ and b follow from generalised least squares with Huber's loss; the variances of x and
//! e from the median squares of differences over 1, 2, 4, ... poses. A Kalman smoother then gives
//! x, and with it a yaw without most of e.
//!
//! A gyroscope that is worse than the poses changes nothing: x then follows the poses. Where the
//! yaw of the poses jumps, as at the closure of a loop, smoothing begins anew.
//!
//! # Assumes
//! The gyroscope turns with the body, about the vertical. Accelerometers are not used: a tilt of a
//! degree shows as 0.17 m/s², more than most of what tracks do to a robot.
//!
//! # Sources
//! Rauch, Tung, Striebel, AIAA Journal 3(8), 1965 (smoother); IEEE Std 952 (errors of gyroscopes).

mod fit;
mod level;
mod turned;

use fit::{Drive, Fit};
use level::Level;
use std::ops::Range;
use trackdyn_core::real;
use trackdyn_recording::{Recording, Run, UncheckedRun};
use turned::Turned;

/// Fewest poses beside readings of the gyroscope.
const MIN_POSES: usize = 60;

/// Fewest poses in a row that are smoothed.
const MIN_ROW: usize = 8;

/// A change of the residual between two poses that is longer, in standard deviations, is a jump of
/// the poses.
const MIN_JUMP: f64 = 6.0;

/// Scales that a gyroscope about the vertical may have, with its tilt.
const SCALES: [f64; 2] = [0.8, 1.25];

/// What a gyroscope tells of the poses of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyroscope {
    /// True yaw rate per measured one, s.
    pub scale: f64,
    /// Time by which poses are late against it, τ, s.
    pub lag: f64,
    /// Standard deviation of the yaw of a pose by itself, rad.
    pub yaw_of_poses: f64,
    /// Standard deviation of the yaw that is left with the gyroscope, rad.
    pub yaw_with_it: f64,
    /// Poses whose yaw it corrects.
    pub poses: usize,
}

/// Why a gyroscope does not serve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unfit {
    /// Too few poses beside its readings.
    #[error("{found} poses have readings of the gyroscope around them, {MIN_POSES} needed")]
    TooFewPoses {
        /// Those that have.
        found: usize,
    },
    /// It does not turn as the poses do.
    #[error(
        "the poses turn {scale:.3} times as much as the gyroscope, expected 1: look at its unit, \
         its axis and its mount"
    )]
    Scale {
        /// Yaw of the poses per yaw of the gyroscope.
        scale: f64,
    },
}

/// The recording with the yaw of its poses corrected by its gyroscope, and what that tells; none
/// without a gyroscope. `tau` is the clock offset of the poses against the encoders, s.
///
/// # Errors
/// Why the gyroscope does not serve.
pub fn with_gyroscope(
    recording: &Recording,
    tau: f64,
) -> Option<Result<(Recording, Gyroscope), Unfit>> {
    let turned: Vec<Vec<Turned>> = recording.runs().iter().map(Turned::of_run).collect();
    if turned.iter().all(Vec::is_empty) {
        return None;
    }
    let drive = Drive { recording, turned: &turned };
    Some(Fit::new(&drive, tau).and_then(|fit| corrected(&drive, &fit)))
}

/// The recording with the yaw that a fit gives.
fn corrected(drive: &Drive, fit: &Fit) -> Result<(Recording, Gyroscope), Unfit> {
    let rows = drive.rows(fit.lag);
    let found: usize = rows.iter().map(|row| row.poses.len()).sum();
    if found < MIN_POSES {
        return Err(Unfit::TooFewPoses { found });
    }
    if fit.scale < SCALES[0] || fit.scale > SCALES[1] {
        return Err(Unfit::Scale { scale: fit.scale });
    }
    let (mut variance, mut count) = (0.0, 0);
    let runs = drive.recording.runs().iter().cloned();
    let mut runs: Vec<UncheckedRun> = runs.map(Run::into_rows).collect();
    for row in &rows {
        let residual = fit.residual(row);
        for part in without_jumps(&row.times, &residual, &fit.level) {
            let smooth = fit.level.smoothed(&row.times[part.clone()], &residual[part.clone()]);
            for (k, (level, known)) in part.zip(smooth) {
                // ψ̂ = ψ − r + x̂
                let pose = &mut runs[row.run].poses.samples[row.poses.start + k].pose;
                pose.yaw += level - residual[k];
                variance += known;
                count += 1;
            }
        }
    }
    let gyroscope = Gyroscope {
        scale: fit.scale,
        lag: fit.lag,
        yaw_of_poses: fit.level.white.sqrt(),
        yaw_with_it: (variance / real(count.max(1))).sqrt(),
        poses: count,
    };
    let runs = runs.into_iter().map(|rows| Run::new(rows, &mut Vec::new()));
    Ok((drive.recording.with_runs(runs.collect()), gyroscope))
}

/// Parts of a row between the jumps of its residual, as long as can be smoothed.
fn without_jumps(times: &[f64], residual: &[f64], level: &Level) -> Vec<Range<usize>> {
    let is_jump = |k: usize| {
        let change = residual[k] - residual[k - 1];
        change.powi(2) > MIN_JUMP.powi(2) * level.of_change(times[k] - times[k - 1])
    };
    let ends = (1..residual.len()).filter(|&k| is_jump(k)).chain([residual.len()]);
    let mut start = 0;
    let parts = ends.map(|end| std::mem::replace(&mut start, end)..end);
    parts.filter(|part| part.len() >= MIN_ROW).collect()
}

#[cfg(test)]
mod tests;
