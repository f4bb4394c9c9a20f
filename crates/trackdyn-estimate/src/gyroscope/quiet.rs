//! Noise of a gyroscope from its own readings.

use super::fit::Drive;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE, median, usual_interval};
use trackdyn_recording::{Run, hold};

/// Variance per second of the random walk of the integral, rad²/s: that of a reading times the time
/// between two. Where the robot never stands, its motion adds to it.
pub(super) fn walk(drive: &Drive) -> f64 {
    let (mut still, mut all) = (Vec::new(), Vec::new());
    for (run, turned) in drive.recording.runs().iter().zip(drive.turned) {
        for turned in turned {
            let [at_rest, any] = turned.scatter(&|t| stands(run, t));
            still.extend(at_rest);
            all.extend(any);
        }
    }
    let scatter = if still.len() >= drive.settings.min_still { still } else { all };
    let mut squares: Vec<f64> = scatter.iter().map(|off| off * off).collect();
    let variance = median(&mut squares).unwrap_or(0.0) / MEDIAN_OF_CHI_SQUARE;
    let runs = drive.recording.runs().iter();
    let mut intervals: Vec<f64> =
        runs.map(|run| usual_interval(run.imu().iter().map(|reading| reading.t))).collect();
    variance * median(&mut intervals).unwrap_or(0.0)
}

/// Whether the encoders show that the robot stands.
fn stands(run: &Run, t: f64) -> bool {
    let holding = hold::holding(run.tracks(), t).map(|index| run.tracks()[index]);
    holding.is_some_and(|reading| reading.v_left == 0.0 && reading.v_right == 0.0)
}
