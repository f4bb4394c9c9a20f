//! Rows that cannot be used as they are.

use super::finding::{Cleaning, Finding};
use crate::sample::{PoseSample, Sample, Series, Stream};
use crate::stray_stamps::{self, Parts};
use std::f64::consts::{PI, TAU};
use trackdyn_core::robust::median;

/// Intervals of more than this many medians are gaps: nobody knows what happened within.
pub const MIN_GAP_RATIO: f64 = 5.0;

/// Intervals up to this are no gaps, s: a robot hardly changes its motion in it. A motion capture
/// of 200 Hz that misses ten frames has missed nothing.
const MIN_GAP: f64 = 0.1;

/// The longest interval that is no gap, s, of samples that usually come at an interval, s.
pub fn longest_interval(usual: f64) -> f64 {
    (MIN_GAP_RATIO * usual).max(MIN_GAP)
}

/// Smallest interval, in medians, of two separate measurements.
const MIN_INTERVAL_RATIO: f64 = 0.1;

/// Drops rows that lack a needed number or are far from all others in time, sorts the rest by time,
/// and keeps the first row of each stamp.
pub(crate) fn clean<S: Sample>(series: &mut Series<S>, run: i64, cleanings: &mut Vec<Cleaning>) {
    let mut report = |finding, count, t| {
        if count > 0 {
            cleanings.push(Cleaning { stream: S::STREAM, finding, count, runs: 1, run, t });
        }
    };
    let mut row = Vec::with_capacity(S::COLUMNS.len());
    let samples = &series.samples;
    let mut kept: Vec<usize> = Vec::with_capacity(samples.len());
    let mut not_finite = 0;
    let mut not_finite_at = f64::NAN;
    for (index, sample) in samples.iter().enumerate() {
        row.clear();
        sample.push_columns(&mut row);
        if row[..S::NEEDED_COLUMNS].iter().all(|value| value.is_finite()) {
            kept.push(index);
        } else {
            if not_finite == 0 {
                not_finite_at = sample.time();
            }
            not_finite += 1;
        }
    }
    report(Finding::NotFinite, not_finite, not_finite_at);

    let time = |index: usize| samples[index].time();
    let back: Vec<usize> =
        kept.windows(2).filter(|pair| time(pair[1]) < time(pair[0])).map(|pair| pair[1]).collect();
    if let Some(&first) = back.first() {
        report(Finding::Unsorted, back.len(), time(first));
        kept.sort_by(|&a, &b| time(a).total_cmp(&time(b)));
    }
    let first = kept.first().map_or(0.0, |&index| time(index));
    let times: Vec<f64> = kept.iter().map(|&index| time(index) - first).collect();
    if let Parts::Main(main) = stray_stamps::parts(&times)
        && main.len() < kept.len()
    {
        let wrong = if main.start > 0 { 0 } else { main.end };
        report(Finding::Far, kept.len() - main.len(), time(kept[wrong]));
        kept = kept[main].to_vec();
    }
    let before = kept.len();
    let repeated_at =
        kept.windows(2).find(|pair| time(pair[0]) == time(pair[1])).map(|pair| time(pair[0]));
    if let Some(t) = repeated_at {
        kept.dedup_by(|next, first| time(*next) == time(*first));
        report(Finding::Repeated, before - kept.len(), t);
    }
    if kept.len() < samples.len() || !back.is_empty() {
        *series = series.part(&kept);
    }
    intervals(&series.samples, report);
}

/// Finds gaps and stamps too close to be two measurements; both stay.
fn intervals<S: Sample>(samples: &[S], mut report: impl FnMut(Finding, usize, f64)) {
    let lengths = || samples.windows(2).map(|pair| pair[1].time() - pair[0].time());
    let Some(usual) = median(&mut lengths().collect::<Vec<_>>()) else { return };
    let mut of = |is: &dyn Fn(f64) -> bool, finding: &dyn Fn(f64) -> Finding| {
        let mut count = 0;
        let mut first = f64::NAN;
        let mut longest = 0.0_f64;
        for (sample, length) in samples.iter().zip(lengths()) {
            if is(length) {
                if count == 0 {
                    first = sample.time();
                }
                count += 1;
                longest = longest.max(length);
            }
        }
        report(finding(longest), count, first);
    };
    of(&|length| length < MIN_INTERVAL_RATIO * usual, &|_| Finding::Crowded);
    of(&|length| length > longest_interval(usual), &|longest| Finding::Gap { longest });
}

/// Adds whole turns so that yaw never jumps by more than half a turn.
pub(super) fn unwrap_yaw(poses: &mut [PoseSample], run: i64, cleanings: &mut Vec<Cleaning>) {
    let mut turns = 0.0;
    let mut count = 0;
    let mut first = f64::NAN;
    for index in 1..poses.len() {
        let previous = poses[index - 1].pose.yaw;
        let jump = poses[index].pose.yaw + turns * TAU - previous;
        if jump.abs() > PI {
            turns -= (jump / TAU).round();
            if count == 0 {
                first = poses[index].t;
            }
            count += 1;
        }
        poses[index].pose.yaw += turns * TAU;
    }
    if count > 0 {
        let finding = Finding::YawUnwrapped;
        cleanings.push(Cleaning { stream: Stream::Poses, finding, count, runs: 1, run, t: first });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{Cells, Column, TrackSample};

    fn tracks(stamps: &[f64]) -> Series<TrackSample> {
        let samples: Vec<TrackSample> =
            stamps.iter().map(|&t| TrackSample { t, v_left: t, v_right: -t }).collect();
        let cells = Cells::Numbers(stamps.iter().map(|t| 10.0 * t).collect());
        Series { samples, extra: vec![Column { name: "beside".into(), cells }] }
    }

    fn found(cleanings: &[Cleaning]) -> Vec<(Finding, usize)> {
        cleanings.iter().map(|cleaning| (cleaning.finding, cleaning.count)).collect()
    }

    #[test]
    fn rows_are_sorted_with_their_extra_cells_and_repeats_go() {
        let mut series = tracks(&[0.0, 2.0, 1.0, 1.0, 3.0]);
        let mut cleanings = Vec::new();
        clean(&mut series, 4, &mut cleanings);
        assert_eq!(series, tracks(&[0.0, 1.0, 2.0, 3.0]));
        assert_eq!(found(&cleanings), [(Finding::Unsorted, 1), (Finding::Repeated, 1)]);
        assert_eq!((cleanings[0].run, cleanings[0].t), (4, 1.0));
    }

    #[test]
    fn rows_that_are_not_finite_go() {
        let mut series = tracks(&[0.0, 1.0, 2.0, 3.0]);
        series.samples[1].v_left = f64::NAN;
        series.samples[2].v_right = f64::INFINITY;
        let mut cleanings = Vec::new();
        clean(&mut series, 0, &mut cleanings);
        assert_eq!(series, tracks(&[0.0, 3.0]));
        assert_eq!(found(&cleanings), [(Finding::NotFinite, 2)]);
    }

    #[test]
    fn rows_before_a_clock_was_set_go() {
        let right = |k: u32| 1.7e9 + f64::from(k);
        let all: Vec<f64> = [0.5, 0.75].into_iter().chain((0..30).map(right)).collect();
        let mut series = tracks(&all);
        let mut cleanings = Vec::new();
        clean(&mut series, 0, &mut cleanings);
        assert_eq!(series, tracks(&all[2..]));
        assert_eq!((found(&cleanings), cleanings[0].t), (vec![(Finding::Far, 2)], 0.5));
    }

    #[test]
    fn gaps_and_crowded_stamps_are_said_and_stay() {
        let stamps = [0.0, 1.0, 2.0, 2.01, 3.0, 4.0, 14.0, 15.0];
        let mut series = tracks(&stamps);
        let mut cleanings = Vec::new();
        clean(&mut series, 0, &mut cleanings);
        assert_eq!(series, tracks(&stamps));
        assert_eq!(found(&cleanings), [(Finding::Crowded, 1), (Finding::Gap { longest: 10.0 }, 1)]);
        assert_eq!(cleanings[1].t, 4.0);
    }

    #[test]
    fn clean_rows_are_left_alone_and_nothing_is_said() {
        let mut series = tracks(&[0.0, 1.0, 2.0]);
        let mut cleanings = Vec::new();
        clean(&mut series, 0, &mut cleanings);
        assert_eq!(series, tracks(&[0.0, 1.0, 2.0]));
        assert!(cleanings.is_empty());
    }

    #[test]
    fn yaw_goes_on_through_several_turns() {
        let truth: Vec<f64> = (0..40).map(|step| 0.5 * f64::from(step)).collect();
        let mut poses: Vec<PoseSample> = truth
            .iter()
            .enumerate()
            .map(|(index, &yaw)| {
                let yaw = trackdyn_core::pose::wrap_angle(yaw);
                let t = trackdyn_core::real(index);
                PoseSample { t, pose: trackdyn_core::Pose::new(0.0, 0.0, yaw) }
            })
            .collect();
        let mut cleanings = Vec::new();
        unwrap_yaw(&mut poses, 0, &mut cleanings);
        for (sample, yaw) in poses.iter().zip(&truth) {
            assert!((sample.pose.yaw - yaw).abs() < 1e-12);
        }
        assert_eq!(found(&cleanings), [(Finding::YawUnwrapped, 3)]);
    }
}
