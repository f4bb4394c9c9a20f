//! How much of the motion constant ICRs leave unexplained.
//!
//! Medians over the segments that should move most by the fit. A median ignores an outlier but
//! shows a wrong unit. What the noise of the poses explains does not count. These segments make up
//! half of the motion, since a robot that seldom turns shows its turning in few. They are chosen by
//! the prediction, since where the robot is slow, the segments with most observed motion are those
//! with most noise.

use crate::blocks::Blocks;
use crate::observations::{Observation, Observations};
use crate::parameters::Parameters;
use crate::prediction::{Lanes, Prediction};
use crate::weighting::SegmentNoise;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE, NORMAL_FROM_MAD, median, quantile};

/// Median of the length of two standard normal numbers, √(2 ln 2).
const RAYLEIGH_MEDIAN: f64 = 1.177_410_022_515_475;

/// Least way of a robot per way of its tracks for which its way is judged.
const MIN_WAY: f64 = 0.15;

/// Part of `most` below which the way that a block leaves counts as well fitted.
const MAX_FITTED_SHARE: f64 = 0.5;

/// Parts of the motion that parameters leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOver {
    /// Of the turning, where the robot should turn most.
    pub turning: f64,
    /// Of the way, where the robot should move furthest.
    pub way: f64,
    /// Of the move to the side, over the turning times the distance of the ICRs, where the robot
    /// should turn most. Noise counts here.
    pub sideways: f64,
}

impl LeftOver {
    /// What parameters leave of the observed motions; `noise` is that of the poses, where known.
    pub fn of(
        parameters: &Parameters,
        observations: &Observations,
        noise: Option<&SegmentNoise>,
    ) -> Self {
        let [x_l, x_r, ..] = parameters.0;
        let predictions = Lanes::new(observations).predict(parameters);
        let segments = || observations.segments().iter().zip(&predictions);
        let of_poses = |segment: &Observation, k: usize| {
            noise.map_or(0.0, |noise| 2.0 * noise.pose[k] + noise.walk[k] * segment.duration)
        };
        let by_stamps = |segment: &Observation, k: usize| {
            segment.twists.iter().map(|twist| twist[k].powi(2)).sum::<f64>()
        };
        // Errors of the stamps turn the robot as well as they move it: what shows in the way alone
        // is none of theirs.
        let shown = rows(segments(), |segment, [.., yaw], [.., off]| {
            [yaw.abs(), off * off - of_poses(segment, 2), by_stamps(segment, 2)]
        });
        let stamp = noise.map_or(0.0, |noise| noise.stamp.min(stamps(shown)));
        let variance =
            |segment: &Observation, k: usize| of_poses(segment, k) + stamp * by_stamps(segment, k);
        let turns = rows(segments(), |segment, [.., yaw], [.., off]| {
            [yaw.abs(), off.abs(), variance(segment, 2)]
        });
        let ways = rows(segments(), |segment, [x, y, _], [forward, left, _]| {
            let variance = f64::midpoint(variance(segment, 0), variance(segment, 1));
            [x.hypot(y), forward.hypot(left), variance]
        });
        // A robot that turns on the spot goes nowhere: its way says nothing.
        let gone: f64 = ways.iter().map(|[there, ..]| there).sum();
        let run = observations.segments().iter().map(|segment| {
            let travelled = observations.travelled(segment);
            f64::midpoint(travelled.left.abs(), travelled.right.abs())
        });
        let goes_nowhere = gone < MIN_WAY * run.sum::<f64>();
        let sides = rows(segments(), |_, [.., yaw], [_, left, _]| {
            [yaw.abs() * (x_r - x_l), left.abs(), 0.0]
        });
        Self {
            turning: left(turns, 1.0 / NORMAL_FROM_MAD),
            way: if goes_nowhere { 0.0 } else { left(ways, RAYLEIGH_MEDIAN) },
            sideways: left(sides, 1.0 / NORMAL_FROM_MAD),
        }
    }

    /// The time span of a run (s from its first reading) that holds all blocks with more of their
    /// way left than `most`. None where these are of several runs, where fewer than a third of the
    /// blocks fit well, or where fewer than a third lie outside the span.
    pub fn where_most(
        parameters: &Parameters,
        observations: &Observations,
        most: f64,
    ) -> Option<[f64; 2]> {
        let predictions = Lanes::new(observations).predict(parameters);
        let segments = observations.segments();
        let ranges = observations.ranges(&observations.blocks(Blocks::MIN_WHOLE_RUNS));
        let mut ways: Vec<f64> = predictions.iter().map(|by| by.motion[0].abs()).collect();
        let usual = quantile(&mut ways, 0.75)?;
        let lefts: Vec<f64> = ranges
            .iter()
            .map(|range| {
                let off = |k: usize| {
                    let off = |axis: usize| segments[k].motion[axis] - predictions[k].motion[axis];
                    off(0).hypot(off(1))
                };
                median(&mut range.clone().map(off).collect::<Vec<_>>()).unwrap_or(0.0) / usual
            })
            .collect();
        let quiet = lefts.iter().filter(|left| **left < MAX_FITTED_SHARE * most).count();
        let first = lefts.iter().position(|left| *left > most)?;
        let last = lefts.iter().rposition(|left| *left > most)?;
        let (from, to) = (&segments[ranges[first].start], &segments[ranges[last].end - 1]);
        let others = lefts.len() - (last + 1 - first);
        let is_part = 3 * quiet >= lefts.len() && 3 * others >= lefts.len();
        let begins = observations.first_reading(from.run)?;
        let time = [from.start - begins, to.start + to.duration - begins];
        (is_part && from.run == to.run).then_some(time)
    }

    /// Heading of the sensor on the robot (rad) by the direction of its way against that of the
    /// tracks, and the part of the way that a sensor turned back by it leaves beside them.
    pub fn mount(observations: &Observations) -> [f64; 2] {
        let ways: Vec<[f64; 3]> = observations
            .segments()
            .iter()
            .map(|segment| {
                let travelled = observations.travelled(segment);
                let [x, y, yaw] = segment.motion;
                let along = f64::midpoint(travelled.left, travelled.right);
                // The chord of an arc points half a turn ahead.
                let (sin, cos) = (yaw / 2.0).sin_cos();
                [along, cos * x + sin * y, cos * y - sin * x]
            })
            .collect();
        let [dot, cross] = [1, 2].map(|k| ways.iter().map(|way| way[0] * way[k]).sum::<f64>());
        let direction = cross.atan2(dot);
        let (sin, cos) = direction.sin_cos();
        let beside = ways.iter().map(|&[along, x, y]| {
            let off = [along - (cos * x + sin * y), cos * y - sin * x];
            [along.abs(), off[0].hypot(off[1]), 0.0]
        });
        [-direction, left(beside.collect(), RAYLEIGH_MEDIAN)]
    }
}

/// A row of each segment, from its prediction and what that leaves: forward, left, yaw.
fn rows<'a>(
    segments: impl Iterator<Item = (&'a Observation, &'a Prediction)>,
    row: impl Fn(&Observation, [f64; 3], [f64; 3]) -> [f64; 3],
) -> Vec<[f64; 3]> {
    let rows = segments.map(|(segment, Prediction { motion, .. })| {
        row(segment, *motion, [0, 1, 2].map(|k| segment.motion[k] - motion[k]))
    });
    rows.collect()
}

/// Variance of the stamps (s²) that the turning shows, over the rows with most of it. Rows hold how
/// much it turns, the square that is left less its noise, and that of a variance of 1 s².
fn stamps(rows: Vec<[f64; 3]>) -> f64 {
    match medians(rows) {
        Some([_, left, square]) if square > 0.0 => (left / MEDIAN_OF_CHI_SQUARE / square).max(0.0),
        _ => 0.0,
    }
}

/// Median of what is left over the median of what is there, over the rows with most of it. They
/// hold how much is there, how much is left, and the variance of its noise, whose median is
/// `of_noise` standard deviations.
fn left(rows: Vec<[f64; 3]>, of_noise: f64) -> f64 {
    match medians(rows) {
        Some([there, left, variance]) if there > 0.0 => {
            let by_noise = of_noise * of_noise * variance;
            (left * left - by_noise).max(0.0).sqrt() / there
        }
        _ => 0.0,
    }
}

/// Medians of the columns over the rows with the largest first column, which together make up half
/// of its sum; none without rows.
///
/// They are a twentieth of the rows or more, so that outliers do not make up the half, and half of
/// them at most.
fn medians(mut rows: Vec<[f64; 3]>) -> Option<[f64; 3]> {
    rows.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let half = rows.iter().map(|row| row[0]).sum::<f64>() / 2.0;
    let mut sum = 0.0;
    let most = rows.iter().take_while(|row| {
        sum += row[0];
        sum < half
    });
    let count = (most.count() + 1).clamp(rows.len().div_ceil(20), rows.len().div_ceil(2).max(1));
    rows.truncate(count);
    let of = |k: usize| median(&mut rows.iter().map(|row| row[k]).collect::<Vec<_>>());
    Some([of(0)?, of(1)?, of(2)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentOptions;
    use crate::synthetic::{Stretch, Synthetic};
    use trackdyn_core::PerSide;

    /// Nine tenths of the time straight ahead: what is left there is noise, and no turning.
    #[test]
    fn a_robot_that_seldom_turns_shows_its_turning_where_it_turns() {
        let drive = |duration, left, right| Stretch { duration, speeds: PerSide::new(left, right) };
        let legs = [drive(9.0, 0.2, 0.2), drive(1.0, -0.1, 0.1)];
        let synthetic = Synthetic {
            schedules: vec![legs.repeat(8)],
            encoder_noise: 0.01,
            yaw_noise: 0.006,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let observations = Observations::new(&recording, &SegmentOptions::default());
        let left = |gap: f64| {
            let half = gap / 2.0;
            let parameters = Parameters([0.041 - half, 0.041 + half, 0.0492, 1.0, 1.0]);
            LeftOver::of(&parameters, &observations, None).turning
        };
        // 6 mrad of noise beside 0.06 rad in a segment
        assert!(left(0.832) < 0.2, "{}", left(0.832));
        assert!(left(2.0 * 0.832) > 0.8, "twice the distance is half the turning");
    }
}
