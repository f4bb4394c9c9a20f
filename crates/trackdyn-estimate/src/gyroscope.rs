//! A gyroscope as evidence of the yaw of poses.
//!
//! # Law
//! A pose at time t has the yaw ψ = ψ₀ + s G(t − τ) + b t + x(t) + o(t) + e. G is the integral of
//! the measured yaw rate, s the gyroscope's scale, τ how late poses are against it, b its bias in
//! the session, x a random walk of both, o an error that wanders about zero and e the white noise
//! of the pose. s, τ and b follow from generalised least squares with Huber's loss: τ from quick
//! changes, and s from means over two seconds, since a filter of the poses or a late stamp makes
//! quick changes small. The variances of x, o and e follow from the median squares of differences
//! over 1, 2, 4, ... poses. A Kalman smoother then gives x, and with the gyroscope's share of it a
//! yaw without most of the other errors.
//!
//! A gyroscope that is no better than the poses is left out. Where the yaw of the poses jumps, as
//! at the closure of a loop, smoothing begins anew.
//!
//! # Assumes
//! The noise of the gyroscope is white: the random walk of its integral follows from the scatter of
//! its readings, at stand-still where the robot stands. What else grows with time is of the poses,
//! and so is what stays bounded: their stamps, their filter, their map. The gyroscope turns with
//! the body, about the vertical. Accelerometers are not used: a tilt of a degree shows as
//! 0.17 m/s², more than most of what tracks do to a robot.
//!
//! # Sources
//! Rauch, Tung, Striebel, AIAA Journal 3(8), 1965 (smoother); IEEE Std 952 (errors of gyroscopes).

mod between;
mod fit;
mod level;
mod quiet;
mod turned;

pub use between::Filled;

use fit::{Drive, Fit};
use std::fmt;
use std::ops::Range;
use trackdyn_core::real;
use trackdyn_core::robust::{median, usual_interval};
use trackdyn_recording::{Recording, Run, UncheckedRun};
use turned::Turned;

/// Fewest poses beside readings of the gyroscope.
const MIN_POSES: usize = 60;

/// Least share of the poses that have readings around them: weights are those of one kind of poses.
/// A pose at either end of a run mostly has none, one of seven in runs of 14 poses.
const MIN_SHARE: f64 = 0.75;

/// Fewest poses in a row that are smoothed.
const MIN_ROW: usize = 8;

/// A change of the residual between two poses that is longer, in standard deviations, is a jump of
/// the poses.
const MIN_JUMP: f64 = 6.0;

/// Largest error that is left of that of the poses for a gyroscope to serve.
const MAX_ERROR_RATIO: f64 = 0.8;

/// Largest part of the noise of a gyroscope by which poses part from it that have their yaw of it.
const MAX_OWN: f64 = 0.5;

/// Scales that a gyroscope about the vertical may have, with its tilt.
const SCALES: [f64; 2] = [0.8, 1.25];

/// What a gyroscope tells of the poses of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyroscope {
    /// True yaw rate per measured one, s.
    pub scale: f64,
    /// Its standard deviation: an error that all yaw of the recording shares.
    pub scale_deviation: f64,
    /// Time by which poses are late against it, τ, s.
    pub lag: f64,
    /// Standard deviation of what poses turn within a second, rad.
    pub error_of_poses: f64,
    /// Standard deviation of what the corrected poses turn within a second, rad.
    pub error_with_it: f64,
    /// Poses whose yaw it corrects.
    pub poses: usize,
}

impl fmt::Display for Gyroscope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [before, after] = [self.error_of_poses, self.error_with_it].map(f64::to_degrees);
        write!(
            f,
            "a turn within 1 s is known to {after:.2} deg, {before:.2} without it; scale {:.4}; \
             poses {:.3} s late against it",
            self.scale, self.lag
        )
    }
}

/// Why a gyroscope does not serve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unfit {
    /// No gyroscope, or hardly a reading of one.
    #[error("the recording has no readings of a gyroscope in a row")]
    NoReadings,
    /// Too few poses beside its readings.
    #[error("{found} poses have readings of the gyroscope around them, {MIN_POSES} needed")]
    TooFewPoses {
        /// Those that have.
        found: usize,
    },
    /// Too few poses in a row to tell errors of the poses from its own.
    #[error(
        "at most {longest} poses in a row have readings of the gyroscope around them, too few to \
         judge it by: take longer runs"
    )]
    ShortRows {
        /// Most in a row.
        longest: usize,
    },
    /// Many poses have no readings around them.
    #[error(
        "{found} of {of} poses have readings of the gyroscope around them, three of four needed: \
         take the part that has (--time), or longer runs"
    )]
    OfAPart {
        /// Those that have.
        found: usize,
        /// All.
        of: usize,
    },
    /// It is no better than the poses.
    #[error(
        "it is no better than the poses: a turn within 1 s is known to {:.2} deg with it, {:.2} \
         without",
        .with_it.to_degrees(), .without.to_degrees()
    )]
    NoBetter {
        /// Standard deviation of a turn within a second with it, rad.
        with_it: f64,
        /// The poses' own, rad.
        without: f64,
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

/// A recording whose gyroscope corrects the yaw of its poses.
#[derive(Clone, Debug)]
pub struct Corrected {
    /// The recording.
    pub recording: Recording,
    /// What the gyroscope tells.
    pub gyroscope: Gyroscope,
    /// Poses that are smoothed in a row: the index of their run, and theirs in it.
    rows: Vec<(usize, Range<usize>)>,
}

/// The recording with the yaw of its poses corrected by its gyroscope. `tau` is the clock offset of
/// the poses against the encoders, s.
///
/// # Errors
/// Why the gyroscope does not serve.
pub fn with_gyroscope(recording: &Recording, tau: f64) -> Result<Corrected, Unfit> {
    let turned: Vec<Vec<Turned>> = recording.runs().iter().map(Turned::of_run).collect();
    if turned.iter().all(Vec::is_empty) {
        return Err(Unfit::NoReadings);
    }
    let jumps = vec![Vec::new(); turned.len()];
    let drive = Drive { recording, turned: &turned, jumps };
    let lag = Fit::best_lag(&drive, tau)?;
    // A jump hides in a fit across it.
    let jumps = jumps_of(&drive, &Fit::near(&drive, lag)?);
    let drive = Drive { jumps, ..drive };
    corrected(&drive, &Fit::near(&drive, lag)?)
}

/// The recording with the yaw that a fit gives.
fn corrected(drive: &Drive, fit: &Fit) -> Result<Corrected, Unfit> {
    let rows = drive.rows(fit.lag);
    let found: usize = rows.iter().map(|row| row.poses.len()).sum();
    if found < MIN_POSES {
        return Err(Unfit::TooFewPoses { found });
    }
    let of = drive.recording.runs().iter().map(|run| run.poses().len()).sum();
    if real(found) < MIN_SHARE * real(of) {
        return Err(Unfit::OfAPart { found, of });
    }
    if fit.scale < SCALES[0] || fit.scale > SCALES[1] {
        return Err(Unfit::Scale { scale: fit.scale });
    }
    let noise = quiet::walk(drive);
    // Of a walk that is the sum of two, each takes its share of the variance.
    let share = (noise / fit.level.walk).min(1.0);
    let mut count = 0;
    let runs = drive.recording.runs().iter().cloned();
    let mut runs: Vec<UncheckedRun> = runs.map(Run::into_rows).collect();
    for (row, residual) in rows.iter().zip(fit.residuals(&rows)) {
        let smooth = fit.level.smoothed(&row.times, &residual);
        // The poses say where the yaw begins.
        let mean = smooth.iter().sum::<f64>() / real(smooth.len());
        let poses = &mut runs[row.run].poses.samples[row.poses.clone()];
        for ((sample, level), residual) in poses.iter_mut().zip(smooth).zip(residual) {
            // ψ̂ = ψ − r + x̄ + share (x̂ − x̄)
            sample.pose.yaw += mean + share * (level - mean) - residual;
            count += 1;
        }
    }
    let of_poses = fit.level.of_change(1.0) - share * fit.level.walk;
    let (without, with_it) =
        (of_poses.sqrt(), (noise * (1.0 - share)).max(noise.min(of_poses) * share).sqrt());
    // Poses that part from it by less than its own noise have their yaw of it: it adds what lies
    // between them.
    let is_its_own = fit.level.of_change(1.0) < MAX_OWN * noise;
    if with_it > MAX_ERROR_RATIO * without && !is_its_own {
        return Err(Unfit::NoBetter { with_it, without });
    }
    let gyroscope = Gyroscope {
        scale: fit.scale,
        scale_deviation: fit.scale_deviation,
        lag: fit.lag,
        error_of_poses: without,
        error_with_it: with_it,
        poses: count,
    };
    let runs = runs.into_iter().map(|rows| Run::new(rows, &mut Vec::new()));
    let recording = drive.recording.with_runs(runs.collect());
    let rows = rows.iter().map(|row| (row.run, row.poses.clone())).collect();
    Ok(Corrected { recording, gyroscope, rows })
}

/// Indices of the poses of each run at which what a fit leaves jumps, and stays where it went. A
/// change no larger than what the robot turns within a pose interval is no jump: a stamp may be
/// late by as much.
fn jumps_of(drive: &Drive, fit: &Fit) -> Vec<Vec<usize>> {
    let middle = |of: &[f64]| median(&mut of.to_vec()).unwrap_or(0.0);
    let mut jumps = vec![Vec::new(); drive.turned.len()];
    let rows = drive.rows(fit.lag);
    for (row, residual) in rows.iter().zip(fit.residuals(&rows)) {
        let usual = usual_interval(row.times.iter().copied());
        for k in 1..residual.len() {
            let change = residual[k] - residual[k - 1];
            let expected = fit.level.of_change(row.times[k] - row.times[k - 1]).sqrt();
            let late = usual * fit.rate(row, k - 1).abs().max(fit.rate(row, k).abs());
            let before = &residual[k.saturating_sub(MIN_ROW)..k];
            let after = &residual[k..residual.len().min(k + MIN_ROW)];
            let is_long = change.abs() > MIN_JUMP * expected + late;
            // An outlier comes back.
            let stays = (middle(after) - middle(before)).abs() > change.abs() / 2.0;
            if is_long && stays {
                jumps[row.run].push(row.poses.start + k);
            }
        }
    }
    jumps
}

#[cfg(test)]
mod tests;
