//! Segments against the truth of synthetic recordings.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::synthetic::{Stretch, Synthetic, random_steps};
use trackdyn_estimate::{Segment, SegmentOptions, segments};
use trackdyn_recording::{PoseSample, Recording, Series, Source, TrackSample, UncheckedRun, hold};

fn cut(recording: &Recording, options: &SegmentOptions) -> Vec<Segment> {
    let found = segments(recording, options);
    assert!(!found.is_empty());
    for segment in &found {
        let run = &recording.runs()[segment.run];
        let [first, last] = segment.poses;
        assert_eq!(segment.start, run.poses()[first].t);
        assert_eq!(segment.end, run.poses()[last].t);
        assert!(segment.duration() >= options.minimum_duration - 1e-9);
        assert!(segment.readings.len() >= options.minimum_readings);
        // 1 ns for the rounding of sums of stamps and offset
        let stamps = |index: usize| run.tracks()[index].t + options.tau;
        assert!(stamps(segment.readings.start) <= segment.start + 1e-9);
        assert!(stamps(segment.readings.start + 1) > segment.start - 1e-9);
        assert!(stamps(segment.readings.end - 1) < segment.end + 1e-9);
        assert!(stamps(segment.readings.end) >= segment.end - 1e-9);
    }
    for pair in found.windows(2) {
        let shares = pair[0].run == pair[1].run && pair[0].poses[1] == pair[1].poses[0];
        assert_eq!(pair[1].follows, shares);
    }
    found
}

fn without(
    recording: &Recording,
    drop_track: impl Fn(f64) -> bool,
    drop_pose: impl Fn(f64) -> bool,
) -> Recording {
    let runs = recording.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        rows.tracks.samples.retain(|sample| !drop_track(sample.t));
        rows.poses.samples.retain(|sample| !drop_pose(sample.t));
        rows
    });
    Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new()).expect("long enough")
}

/// Frames that a motion capture of 200 Hz misses now and then are no gaps.
#[test]
fn a_few_missed_frames_lose_no_driving() {
    let synthetic = Synthetic { pose_interval: 0.005, ..Synthetic::default() };
    let whole = synthetic.recording().expect("long enough");
    let driven = |recording: &Recording| -> f64 {
        cut(recording, &SegmentOptions::default()).iter().map(Segment::duration).sum()
    };
    let missed = driven(&without(&whole, |_| false, |t| t % 1.0 < 0.08));
    assert!(missed > 0.98 * driven(&whole), "{missed} of {}", driven(&whole));
    // Nobody knows what happens in a quarter of a second.
    let gaps = driven(&without(&whole, |_| false, |t| t % 1.0 < 0.25));
    assert!(gaps < 0.8 * driven(&whole), "{gaps} of {}", driven(&whole));
}

/// Stamps and steps coincide, so that the held readings are the true speeds: 1e-9 is rounding.
#[test]
fn observed_motion_is_the_integral_of_the_readings_at_the_right_clock_offset() {
    for tau in [0.0, 0.27, -0.13] {
        let synthetic = Synthetic {
            schedules: vec![random_steps(10, 1.5, 1.0, 1), random_steps(10, 2.0, 0.7, 2)],
            tau,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let options = SegmentOptions { tau, ..SegmentOptions::default() };
        let found = cut(&recording, &options);
        assert!(found.iter().any(|segment| segment.run == 1));
        for segment in &found {
            let tracks = recording.runs()[segment.run].tracks();
            let motion = hold::integrate(tracks, segment.start, segment.end, tau, |speeds| {
                synthetic.kinematics.twist(speeds)
            });
            let off = |found: f64, expected: f64| (found - expected).abs() > 1e-9;
            let Pose { x, y, yaw } = segment.observed;
            assert!(!off(x, motion.x) && !off(y, motion.y) && !off(yaw, motion.yaw), "{segment:?}");
        }
    }
}

#[test]
fn segments_are_as_short_as_allowed_and_follow_one_another() {
    let recording = Synthetic::default().recording().expect("long enough");
    let found = cut(&recording, &SegmentOptions::default());
    // poses every 0.1 s: the first at or after 0.27 s is 0.3 s on, with six readings of 0.05 s
    assert!(found.iter().all(|segment| (segment.duration() - 0.3).abs() < 1e-9));
    assert!(found.iter().all(|segment| segment.readings.len() == 6));
    assert_eq!(found.len(), 200);
    assert!(!found[0].follows && found[1..].iter().all(|segment| segment.follows));
    let options = SegmentOptions { minimum_duration: 1.0, ..SegmentOptions::default() };
    assert_eq!(cut(&recording, &options).len(), 60);
    let options = SegmentOptions { minimum_readings: 11, ..SegmentOptions::default() };
    assert!(cut(&recording, &options).iter().all(|s| (s.duration() - 0.6).abs() < 1e-9));
}

#[test]
fn gaps_are_not_bridged() {
    let whole = Synthetic::default().recording().expect("long enough");
    let inside = |t: f64| t > 20.02 && t < 23.02;
    let across =
        |found: &[Segment]| found.iter().filter(|s| s.start < 23.0 && s.end > 20.1).count();
    assert!(across(&segments(&whole, &SegmentOptions::default())) > 0);

    let poses_missing = without(&whole, |_| false, inside);
    let found = cut(&poses_missing, &SegmentOptions::default());
    assert_eq!(across(&found), 0);
    assert_eq!(found.iter().filter(|segment| !segment.follows).count(), 2);

    let readings_missing = without(&whole, inside, |_| false);
    let found = cut(&readings_missing, &SegmentOptions::default());
    assert_eq!(across(&found), 0);
    assert!(found.iter().any(|segment| segment.start > 23.0));

    let options = SegmentOptions {
        longest_pose_interval: Some(10.0),
        longest_track_interval: Some(10.0),
        ..SegmentOptions::default()
    };
    assert_eq!(across(&segments(&poses_missing, &options)), 1);
}

#[test]
fn readings_must_cover_all_offsets_of_the_margin() {
    let recording = Synthetic::default().recording().expect("long enough");
    let options = SegmentOptions { tau: 0.3, tau_margin: 0.2, ..SegmentOptions::default() };
    let found = cut(&recording, &options);
    assert!(found[0].start - 0.5 >= 0.0);
    let last = found.last().expect("some");
    assert!(last.end <= 60.0 + 1e-9, "offsets above 0.1 s ask for readings of the past only");
    let options = SegmentOptions { tau: -0.3, tau_margin: 0.2, ..options };
    let found = cut(&recording, &options);
    assert!(found.last().expect("some").end + 0.5 <= 60.0 + 1e-9);
}

#[test]
fn a_recording_without_room_for_a_segment_gives_none() {
    let stretch = Stretch { duration: 0.2, speeds: PerSide::new(0.1, 0.1) };
    let synthetic = Synthetic { schedules: vec![vec![stretch]], ..Synthetic::default() };
    let recording = synthetic.recording().expect("three poses");
    assert!(segments(&recording, &SegmentOptions::default()).is_empty());
}

#[test]
fn coarse_stamps_do_not_make_segments_longer() {
    // A robot that turns at 1 rad/s for 2 s at a time. Poses come every 0.1 s, give or take 30 ms,
    // and have the stamp of the last of the readings, which come every 0.05 s.
    const GRID: f64 = 0.05;
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let runs = (0..3000).map(|id| {
        let phase = GRID * random.random::<f64>();
        let reading = |k: i32| TrackSample { t: GRID * f64::from(k), v_left: -0.2, v_right: 0.2 };
        let pose = |k: i32| {
            let t = 0.1 * f64::from(k) + phase;
            let shown = t + 0.1 + 0.06 * (random.random::<f64>() - 0.5);
            PoseSample { t: (shown / GRID).floor() * GRID, pose: Pose::new(0.0, 0.0, t) }
        };
        let tracks: Vec<TrackSample> = (0..=44).map(reading).collect();
        let poses: Vec<PoseSample> = (0..20).map(pose).collect();
        UncheckedRun { id, tracks: tracks.into(), poses: poses.into(), imu: Series::default() }
    });
    let runs = runs.collect();
    let recording = Recording::new("spin", "none", runs, Source::computed(), Vec::new());
    let found = segments(&recording.expect("runs"), &SegmentOptions::default());
    let turned: f64 = found.iter().map(|segment| segment.observed.yaw).sum();
    let lasted: f64 = found.iter().map(Segment::duration).sum();
    // The ends of 3000 runs of 1.8 s, 30 ms early or late, leave 0.04 %. Cuts at the first stamp
    // that is
    // 0.27 s later would make it 0.45 % too slow.
    assert!((turned / lasted - 1.0).abs() < 0.0015, "{}", turned / lasted);
}
