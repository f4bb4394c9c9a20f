//! Stamps of other clocks and poses that lack what is needed: right numbers, or a message that
//! names the cause.

use super::drives::{Bag, EPOCH, LENGTH, RADIUS, at, ns, poses, quaternion, speeds, times};
use std::fmt::Write;
use trackdyn_recording::rosbag::{self, Dating, RosbagOptions};
use trackdyn_recording::{Error, Recording, folder, tum};

fn read(bag: Bag, dated_by: Dating) -> Result<Recording, Error> {
    let options =
        RosbagOptions { wheel_radius: Some(RADIUS), dated_by, ..RosbagOptions::default() };
    let (_folder, path) = bag.write();
    rosbag::read(&path, &options)
}

/// Velocities stamped by a clock: the stamp, Unix time in ns, of a time after the beginning, s.
fn wheels(bag: &mut Bag, start: f64, clock: impl Fn(f64) -> i64) {
    for t in times(50) {
        let velocities = [speeds(t).left, speeds(t).right];
        let names = ["left_wheel", "right_wheel"];
        bag.joints("/joint_states", (at(start + t).0, clock(t)), &names, [&[], &velocities]);
    }
}

fn drive(bag: &mut Bag, start: f64, clock: impl Fn(f64) -> i64) {
    for (t, pose) in poses() {
        bag.pose((at(start + t).0, clock(t)), [pose.x, pose.y], quaternion(pose.yaw));
    }
}

/// Largest difference of the speeds from the truth at their times, counted from the first pose.
fn error_of(recording: &Recording, run: usize) -> f64 {
    let run = &recording.runs()[run];
    let start = run.poses()[0].t;
    let errors = run.tracks().iter().map(|sample| {
        let truth = speeds(sample.t - start).map(|speed| RADIUS * speed);
        (sample.v_left - truth.left).abs().max((sample.v_right - truth.right).abs())
    });
    errors.fold(0.0, f64::max)
}

fn notes(recording: &Recording) -> String {
    recording.warnings().iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Stamp, Unix time in ns, of a time after the beginning, s.
type Clock<'a> = &'a dyn Fn(f64) -> i64;

#[test]
fn clocks_of_their_own_are_dated_by_the_log() {
    // since boot; the first of these stamps is zero
    let boot = |t: f64| ns(t);
    // 37 s of leap seconds, and poses that are stamped after they are logged
    let late = |by: f64| move |t: f64| EPOCH + ns(t + by);
    let unix = late(0.0);
    let clocks: [(Clock, Clock, &str); 4] = [
        (&boot, &unix, "1700000000.000 s later"),
        (&unix, &late(37.0), "37.000 s later"),
        (&unix, &late(-18.0), "18.000 s earlier"),
        (&unix, &late(1.5), "1.500 s later"),
    ];
    for (of_wheels, of_poses, offset) in clocks {
        let bag = || {
            let mut bag = Bag::default();
            wheels(&mut bag, 0.0, of_wheels);
            drive(&mut bag, 0.0, of_poses);
            bag
        };
        let recording = read(bag(), Dating::Any).expect(offset);
        assert!(error_of(&recording, 0) < 1e-6, "{offset}: {}", error_of(&recording, 0));
        let text = notes(&recording);
        assert!(text.contains(offset) && text.contains("--dated-by header"), "{text}");
        // Stamps that are kept on demand are no matter of signs or units.
        let recording = read(bag(), Dating::Header).expect(offset);
        assert!(error_of(&recording, 0) > 0.1, "{offset}: the stamps are kept");
        let is_apart = notes(&recording).contains("share no time");
        assert_eq!(is_apart, offset.starts_with("1700000000"), "{}", notes(&recording));
    }
}

#[test]
fn delays_are_no_clocks() {
    let mut bag = Bag::default();
    wheels(&mut bag, 0.0, |t| EPOCH + ns(t));
    for (t, pose) in poses() {
        let logged = at(t + 0.4).0;
        bag.pose((logged, EPOCH + ns(t)), [pose.x, pose.y], quaternion(pose.yaw));
    }
    let recording = read(bag, Dating::Any).expect("readable");
    assert!(error_of(&recording, 0) < 1e-6);
    assert!(notes(&recording).contains("taken for a delay"), "{}", notes(&recording));
}

#[test]
fn a_reset_of_the_simulation_begins_a_run() {
    let mut bag = Bag::default();
    // What is told again by the same stamps would be a copy.
    for (start, began) in [(0.0, 0.1), (LENGTH + 10.0, 0.14)] {
        wheels(&mut bag, start, |t| ns(t + began));
        drive(&mut bag, start, |t| ns(t + began));
    }
    let recording = read(bag, Dating::Any).expect("readable");
    assert_eq!(recording.runs().len(), 2);
    for run in [0, 1] {
        assert_eq!(recording.runs()[run].tracks().len(), times(50).count());
        assert!(error_of(&recording, run) < 1e-6);
    }
    assert!(notes(&recording).contains("2 runs"), "{}", notes(&recording));
}

#[test]
fn stamps_from_before_a_clock_was_set_are_dropped() {
    let clock = |t: f64| if t < 0.05 { ns(t) } else { EPOCH + ns(t) };
    let mut bag = Bag::default();
    wheels(&mut bag, 0.0, clock);
    drive(&mut bag, 0.0, clock);
    let recording = read(bag, Dating::Any).expect("readable");
    let run = &recording.runs()[0];
    assert_eq!(run.tracks().len(), times(50).count() - 3);
    assert!(run.duration() < LENGTH);
    assert!(notes(&recording).contains("stamp is far from all others"), "{}", notes(&recording));
}

/// A recording folder with poses (x, y, yaw) as texts of a true pose.
fn tables(time: f64, text: impl Fn(f64, f64, f64) -> String) -> Result<Recording, Error> {
    let place = tempfile::tempdir().expect("a temporary folder");
    let manifest = "schema = \"trackdyn.recording/1\"\nname = \"drive\"\nrobot = \"robot\"\n\
                    frame = \"ros\"\n";
    std::fs::write(place.path().join("recording.toml"), manifest).expect("written");
    let mut tracks = "t,v_left,v_right\n".to_owned();
    for t in times(50) {
        let v = speeds(t).map(|speed| RADIUS * speed);
        writeln!(tracks, "{},{},{}", time * t, v.left, v.right).expect("written");
    }
    std::fs::write(place.path().join("tracks.csv"), &tracks).expect("written");
    let mut table = "t,x,y,yaw\n".to_owned();
    for (t, pose) in poses() {
        writeln!(table, "{},{}", time * t, text(pose.x, pose.y, pose.yaw)).expect("written");
    }
    std::fs::write(place.path().join("poses.csv"), &table).expect("written");
    folder::read(place.path())
}

#[test]
fn tables_with_wrong_units_are_refused() {
    let wrapped = |yaw: f64| trackdyn_core::pose::wrap_angle(yaw);
    let right = |x: f64, y: f64, yaw: f64| format!("{x},{y},{}", wrapped(yaw));
    assert!(tables(1.0, right).expect("readable").has_positions());
    let text = tables(1000.0, right).expect_err("milliseconds").to_string();
    assert!(text.contains("milliseconds"), "{text}");
    let degrees = |x: f64, y: f64, yaw: f64| format!("{x},{y},{}", wrapped(yaw).to_degrees());
    let text = tables(1.0, degrees).expect_err("degrees").to_string();
    assert!(text.contains("degrees"), "{text}");
}

#[test]
fn a_trajectory_in_milliseconds_beside_tracks_in_seconds_is_refused() {
    let place = tempfile::tempdir().expect("a temporary folder");
    let [trajectory, tracks] = ["poses.tum", "tracks.csv"].map(|name| place.path().join(name));
    let mut lines = String::new();
    for (t, pose) in poses() {
        let [_, _, z, w] = quaternion(pose.yaw);
        writeln!(lines, "{} {} {} 0 0 0 {z} {w}", 1000.0 * (100.0 + t), pose.x, pose.y)
            .expect("written");
    }
    std::fs::write(&trajectory, lines).expect("written");
    let mut table = "t,v_left,v_right\n".to_owned();
    for t in times(50) {
        writeln!(table, "{},{},{}", 100.0 + t, speeds(t).left, speeds(t).right).expect("written");
    }
    std::fs::write(&tracks, table).expect("written");
    let text = tum::read(&trajectory, &tracks, "robot").expect_err("refused").to_string();
    assert!(text.contains("milliseconds"), "{text}");
}

#[test]
fn yaw_alone_is_kept_and_positions_are_marked() {
    for text in [
        |_: f64, _: f64, yaw: f64| format!(",,{yaw}"),
        |_: f64, _: f64, yaw: f64| format!("nan,nan,{yaw}"),
        |_: f64, _: f64, yaw: f64| format!("-0.0,0.0,{yaw}"),
        |_: f64, _: f64, yaw: f64| format!("3.5,-2.0,{yaw}"),
    ] {
        let recording = tables(1.0, text).expect("readable");
        assert!(!recording.has_positions());
        assert!(notes(&recording).contains("positions are not known"), "{}", notes(&recording));
        let run = &recording.runs()[0];
        let truth = poses();
        assert_eq!(run.poses().len(), truth.len());
        for (sample, (_, pose)) in run.poses().iter().zip(&truth) {
            assert_eq!([sample.pose.x, sample.pose.y], [0.0, 0.0]);
            assert!((sample.pose.yaw - pose.yaw).abs() < 1e-9);
        }
        // a part of it knows no more
        assert!(!recording.within([1.0, 2.0]).expect("a part").has_positions());
    }
}

#[test]
fn poses_without_an_orientation_are_refused() {
    for (of, part) in [
        ([0.0; 4], "a quaternion of zeros"),
        ([0.0, 0.0, 0.0, 1.0], "orientation never changes"),
        ([0.0, 0.0, 0.6, 0.8], "orientation never changes"),
    ] {
        let mut bag = Bag::default().with_wheels();
        for (t, pose) in poses() {
            bag.pose(at(t), [pose.x, pose.y], of);
        }
        let text = read(bag, Dating::Any).expect_err(part).to_string();
        assert!(text.contains(part) && text.contains("--pose-topic"), "{text}");
    }
}

#[test]
fn axes_of_a_camera_are_refused() {
    // yaw about z, then the axes of a camera: q = (0, 0, sin, cos) (-½, ½, -½, ½)
    let mut bag = Bag::default().with_wheels();
    for (t, pose) in poses() {
        let [_, _, s, c] = quaternion(pose.yaw).map(|value| 0.5 * value);
        bag.pose(at(t), [pose.x, pose.y], [-c - s, c - s, s - c, c + s]);
    }
    let text = read(bag, Dating::Any).expect_err("refused").to_string();
    assert!(text.contains("axes of a camera") && text.contains("--child-frame"), "{text}");
}
