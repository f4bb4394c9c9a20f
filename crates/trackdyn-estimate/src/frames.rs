//! Whether the poses of all runs stand in one frame.
//!
//! Windows that are cut from a log often have a frame each, which begins at the window's first
//! pose. Then a place or a heading is not the same in two runs. Such runs begin near one pose and
//! end far from it, and leave the robot no time to drive back.

use trackdyn_core::robust::{median, quantile};
use trackdyn_core::{Pose, settings_group};
use trackdyn_recording::{PoseFrame, PoseSample, Recording, Run};

settings_group! {
    /// When runs have frames of their own, where the recording does not say.
    Settings {
        /// Fewest runs that follow one another.
        min_pairs: usize = 5, "", [1.0, 1e6],
            "Fewer begin near one pose by chance.",
            "Lower: one world's places are lost.";
        /// Largest spread of first poses over that of last ones.
        max_spread: f64 = 0.25, "", [0.0, 1.0],
            "First poses then lie together.",
            "Higher: one world's places are lost; lower: several are mixed.";
        /// Largest pause between runs, over the way back at the usual speed.
        max_pause: f64 = 2.0, "", [0.0, 100.0],
            "Nobody drives back in less.",
            "Higher: robots driven back lose their world.";
    }
}

/// Whether all runs share one frame: as stated, or else as their ends and beginnings show.
pub fn share_a_frame(recording: &Recording, settings: &Settings) -> bool {
    match recording.pose_frame() {
        Some(stated) => stated == PoseFrame::World,
        None => !begin_anew(recording, settings),
    }
}

/// Whether runs begin near one pose though nothing leads back to it.
fn begin_anew(recording: &Recording, settings: &Settings) -> bool {
    let mut runs: Vec<&[PoseSample]> = recording.runs().iter().map(Run::poses).collect();
    runs.retain(|poses| poses.len() > 1);
    runs.sort_by(|a, b| a[0].t.total_cmp(&b[0].t));
    let ends: Vec<[&PoseSample; 2]> =
        runs.iter().map(|poses| [&poses[0], &poses[poses.len() - 1]]).collect();
    let pairs: Vec<[&PoseSample; 2]> = ends
        .windows(2)
        .map(|pair| [pair[0][1], pair[1][0]])
        .filter(|[last, first]| first.t > last.t)
        .collect();
    if pairs.len() < settings.min_pairs || pairs.len() + 1 < runs.len() {
        return false;
    }
    let spread = |which: usize| -> Option<[f64; 2]> {
        let poses = ends.iter().map(|ends| ends[which].pose);
        spread(&poses.collect::<Vec<_>>())
    };
    let (Some(first), Some(last)) = (spread(0), spread(1)) else { return false };
    let is_narrow = first.iter().zip(last).all(|(first, last)| *first < settings.max_spread * last);
    let speeds = runs.iter().flat_map(|poses| poses.windows(2)).map(|pair| {
        let step = pair[0].pose.relative(&pair[1].pose);
        step.x.hypot(step.y) / (pair[1].t - pair[0].t)
    });
    let speed = median(&mut speeds.collect::<Vec<_>>()).unwrap_or(0.0);
    let pauses = pairs.iter().map(|[last, first]| {
        let way = last.pose.relative(&first.pose);
        (first.t - last.t) * speed / way.x.hypot(way.y)
    });
    let pause = median(&mut pauses.collect::<Vec<_>>());
    is_narrow && pause.is_some_and(|pause| pause < settings.max_pause)
}

/// How far poses scatter about their median: position (m) and yaw (rad), the upper quartile.
fn spread(poses: &[Pose]) -> Option<[f64; 2]> {
    let middle = |of: fn(&Pose) -> f64| median(&mut poses.iter().map(of).collect::<Vec<_>>());
    let (x, y, yaw) = (middle(|pose| pose.x)?, middle(|pose| pose.y)?, middle(|pose| pose.yaw)?);
    let mut places: Vec<f64> = poses.iter().map(|pose| (pose.x - x).hypot(pose.y - y)).collect();
    let mut yaws: Vec<f64> = poses.iter().map(|pose| (pose.yaw - yaw).abs()).collect();
    Some([quantile(&mut places, 0.75)?, quantile(&mut yaws, 0.75)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Synthetic, random_steps};
    use trackdyn_recording::UncheckedRun;

    /// One drive, cut into windows of 6 s; `anew` says whether each begins at the origin.
    fn windows(anew: bool, pause: f64) -> Recording {
        let whole =
            Synthetic { schedules: vec![random_steps(40, 3.0, 0.8, 3)], ..Synthetic::default() };
        let whole = whole.recording().expect("long enough");
        let run = &whole.runs()[0];
        let cut = (0..20).map(|k| {
            let (from, until) = (6.0 * f64::from(k), 6.0 * f64::from(k + 1) - 0.2);
            let mut rows: UncheckedRun = run.clone().into_rows();
            rows.id = i64::from(k);
            rows.tracks.samples.retain(|sample| (from..until).contains(&sample.t));
            rows.poses.samples.retain(|sample| (from..until).contains(&sample.t));
            let first = rows.poses.samples[0].pose;
            for sample in &mut rows.poses.samples {
                sample.t += pause * f64::from(k);
                if anew {
                    sample.pose = first.relative(&sample.pose);
                }
            }
            for sample in &mut rows.tracks.samples {
                sample.t += pause * f64::from(k);
            }
            Run::new(rows, &mut Vec::new())
        });
        whole.with_runs(cut.collect())
    }

    fn in_one_frame(recording: &Recording) -> bool {
        share_a_frame(recording, &Settings::default())
    }

    #[test]
    fn windows_that_begin_at_the_origin_have_frames_of_their_own() {
        assert!(in_one_frame(&windows(false, 0.0)), "cut from one drive");
        assert!(!in_one_frame(&windows(true, 0.0)), "begun anew");
        assert!(in_one_frame(&windows(true, 60.0)), "driven back to the start each time");
        let stated = windows(true, 0.0).with_pose_frame(Some(PoseFrame::World));
        assert!(in_one_frame(&stated), "as stated");
        let stated = windows(false, 0.0).with_pose_frame(Some(PoseFrame::Run));
        assert!(!in_one_frame(&stated), "as stated");
    }
}
