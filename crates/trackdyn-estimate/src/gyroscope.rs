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
//! its readings, at stand-still where the robot stands. All other errors are those of the poses
//! (their stamps, their filter, their map), whether they grow with time or stay bounded. The
//! gyroscope turns with the body, about the vertical. Accelerometers are not used: a tilt of a
//! degree shows as 0.17 m/s², more than most of what tracks do to a robot.
//!
//! # Sources
//! Rauch, Tung, Striebel, AIAA Journal 3(8), 1965 (smoother); IEEE Std 952 (errors of gyroscopes).

mod between;
mod fit;
mod level;
mod quiet;
mod settings;
mod turned;

pub use between::Filled;
pub use settings::Settings;

use fit::{Drive, Fit};
use std::fmt;
use std::ops::Range;
use trackdyn_core::real;
use trackdyn_core::robust::{median, usual_interval};
use trackdyn_recording::{Recording, Run, UncheckedRun};
use turned::Turned;

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
    #[error("{found} poses have readings of the gyroscope around them, {needed} needed")]
    TooFewPoses {
        /// Those that have.
        found: usize,
        /// As many are needed.
        needed: usize,
    },
    /// Too few poses in a row to separate errors of the poses from its own.
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
        "{found} of {of} poses have readings of the gyroscope around them, {} needed: \
         take the part that has (--time), or longer runs",
        in_words(*.needed)
    )]
    OfAPart {
        /// Those that have.
        found: usize,
        /// All.
        of: usize,
        /// Share of all that is needed, 1.
        needed: f64,
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

/// A share as one says it.
fn in_words(share: f64) -> String {
    let is_usual = (share - 0.75).abs() < f64::EPSILON;
    if is_usual { "three of four".to_owned() } else { format!("{:.0} %", 100.0 * share) }
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
    /// Fewest readings in a row.
    min_readings: usize,
}

/// The recording with the yaw of its poses corrected by its gyroscope. `tau` is the clock offset of
/// the poses against the encoders, s.
///
/// # Errors
/// Why the gyroscope does not serve.
pub fn with_gyroscope(
    recording: &Recording,
    tau: f64,
    settings: &Settings,
) -> Result<Corrected, Unfit> {
    let turned = |run: &Run| Turned::of_run(run, settings.min_readings);
    let turned: Vec<Vec<Turned>> = recording.runs().iter().map(turned).collect();
    if turned.iter().all(Vec::is_empty) {
        return Err(Unfit::NoReadings);
    }
    let jumps = vec![Vec::new(); turned.len()];
    let drive = Drive { recording, turned: &turned, jumps, settings };
    let lag = Fit::best_lag(&drive, tau)?;
    // A jump hides in a fit across it.
    let jumps = jumps_of(&drive, &Fit::near(&drive, lag)?);
    let drive = Drive { jumps, ..drive };
    corrected(&drive, &Fit::near(&drive, lag)?)
}

/// The recording with the yaw that a fit gives.
fn corrected(drive: &Drive, fit: &Fit) -> Result<Corrected, Unfit> {
    let &Settings { min_poses, min_share, scales, max_own, max_error_ratio, .. } = drive.settings;
    let rows = drive.rows(fit.lag);
    let found: usize = rows.iter().map(|row| row.poses.len()).sum();
    if found < min_poses {
        return Err(Unfit::TooFewPoses { found, needed: min_poses });
    }
    let of = drive.recording.runs().iter().map(|run| run.poses().len()).sum();
    if real(found) < min_share * real(of) {
        return Err(Unfit::OfAPart { found, of, needed: min_share });
    }
    if fit.scale < scales[0] || fit.scale > scales[1] {
        return Err(Unfit::Scale { scale: fit.scale });
    }
    let noise = quiet::walk(drive);
    // Of a walk that is the sum of two, each takes its share of the variance.
    let share = (noise / fit.level.walk).min(1.0);
    let mut count = 0;
    let runs = drive.recording.runs().iter().cloned();
    let mut runs: Vec<UncheckedRun> = runs.map(Run::into_rows).collect();
    for (row, residual) in rows.iter().zip(fit.residuals(&rows)) {
        let smooth = fit.level.smoothed(&row.times, &residual, drive.settings.max_innovation);
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
    let is_its_own = fit.level.of_change(1.0) < max_own * noise;
    if with_it > max_error_ratio * without && !is_its_own {
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
    Ok(Corrected { recording, gyroscope, rows, min_readings: drive.settings.min_readings })
}

/// Indices of the poses of each run at which what a fit leaves jumps, and stays where it went. A
/// change no larger than what the robot turns within a pose interval is no jump: a stamp may be
/// late by as much.
fn jumps_of(drive: &Drive, fit: &Fit) -> Vec<Vec<usize>> {
    let &Settings { min_row, min_jump, .. } = drive.settings;
    let middle = |of: &[f64]| median(&mut of.to_vec()).unwrap_or(0.0);
    let mut jumps = vec![Vec::new(); drive.turned.len()];
    let rows = drive.rows(fit.lag);
    for (row, residual) in rows.iter().zip(fit.residuals(&rows)) {
        let usual = usual_interval(row.times.iter().copied());
        for k in 1..residual.len() {
            let change = residual[k] - residual[k - 1];
            let expected = fit.level.of_change(row.times[k] - row.times[k - 1]).sqrt();
            let late = usual * fit.rate(row, k - 1).abs().max(fit.rate(row, k).abs());
            let before = &residual[k.saturating_sub(min_row)..k];
            let after = &residual[k..residual.len().min(k + min_row)];
            let is_long = change.abs() > min_jump * expected + late;
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
