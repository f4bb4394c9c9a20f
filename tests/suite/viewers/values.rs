//! What messages say is what was recorded and predicted.

use super::{ICRS, Message, bytes, messages, synthetic, synthetic_layers};
use std::collections::BTreeMap;
use trackdyn_core::real;
use trackdyn_recording::Run;

/// Rounding of sums of a few lengths, m or rad.
const ROUNDING: f64 = 1e-9;

fn synthetic_messages() -> BTreeMap<String, Vec<Message>> {
    messages(&bytes(&synthetic_layers()))
}

/// Stamp of a time of a run, ns: the second run follows the first after a whole second.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small, positive")]
fn stamp(runs: &[Run], run: usize, t: f64) -> u64 {
    let ends = [runs[0].tracks().last().map(|of| of.t), runs[0].poses().last().map(|of| of.t)];
    let end = ends.into_iter().flatten().fold(0.0, f64::max);
    let moved = if run == 0 { 0.0 } else { (end + 1e-9).ceil() };
    ((moved + t) * 1e9).round() as u64
}

/// A stamp of a header in ns, from whole numbers.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small, positive")]
fn stamp_of(seconds: f64, nanoseconds: f64) -> u64 {
    seconds as u64 * 1_000_000_000 + nanoseconds as u64
}

#[test]
fn poses_and_transforms_are_the_recorded_ones() {
    let recording = synthetic().recording().expect("runs");
    let runs = recording.runs();
    let found = synthetic_messages();
    let poses = &found["/trackdyn/observed/pose"];
    let recorded = (0..2).flat_map(|run| runs[run].poses().iter().map(move |of| (run, of)));
    let transforms: Vec<&Message> = found["/tf"]
        .iter()
        .filter(|of| of.text("transforms[0].child_frame_id") == "base_link")
        .collect();
    assert_eq!([poses.len(), transforms.len()], [recorded.clone().count(); 2]);
    for ((message, transform), (run, sample)) in poses.iter().zip(transforms).zip(recorded) {
        assert_eq!(message.kind, "geometry_msgs/msg/PoseStamped");
        assert_eq!(message.log, stamp(runs, run, sample.t));
        for (message, header, place, turn) in [
            (message, "header", "pose.position", "pose.orientation"),
            (
                transform,
                "transforms[0].header",
                "transforms[0].transform.translation",
                "transforms[0].transform.rotation",
            ),
        ] {
            let number = |path: &str, part: &str| message.number(&format!("{path}.{part}"));
            assert_eq!(message.text(&format!("{header}.frame_id")), "map");
            let [seconds, rest] =
                ["sec", "nanosec"].map(|of| number(header, &format!("stamp.{of}")));
            assert_eq!(stamp_of(seconds, rest), message.log);
            let (sin, cos) = (sample.pose.yaw / 2.0).sin_cos();
            assert_eq!(
                ["x", "y", "z"].map(|of| number(place, of)),
                [sample.pose.x, sample.pose.y, 0.0]
            );
            assert_eq!(["x", "y", "z", "w"].map(|of| number(turn, of)), [0.0, 0.0, sin, cos]);
        }
    }
}

/// Without noise the ICRs of the robot predict its path, and those of an ideal drive do not.
#[test]
fn the_right_icrs_lead_along_the_recorded_path() {
    let found = synthetic_messages();
    let place = |of: &Message| ["x", "y"].map(|axis| of.number(&format!("pose.position.{axis}")));
    let distance = |set: &str| {
        let (observed, of) =
            (&found["/trackdyn/observed/pose"], &found[&format!("/trackdyn/{set}/pose")]);
        assert_eq!(observed.len(), of.len());
        observed.iter().zip(of).fold(0.0_f64, |most, (a, b)| {
            assert_eq!(a.log, b.log);
            let ([x, y], [u, v]) = (place(a), place(b));
            most.max((x - u).hypot(y - v))
        })
    };
    assert!(distance("my_fit") < ROUNDING, "{}", distance("my_fit"));
    assert!(distance("ideal") > 0.1, "{}", distance("ideal"));
    for part in ["along", "across", "yaw"] {
        let largest = |set: &str| {
            let values = found[&format!("/trackdyn/{set}/residual/{part}")].iter();
            values.fold(0.0_f64, |most, of| most.max(of.number("data").abs()))
        };
        assert!(largest("my_fit") < ROUNDING && largest("ideal") > 1e-3, "{part}");
    }
    let value = |set: &str, k: usize| found[&format!("/trackdyn/{set}/yaw_rate")][k].number("data");
    for k in 0..found["/trackdyn/observed/yaw_rate"].len() {
        // ω_ideal = (V_r − V_l)/L, ω = (V_r − V_l)/(x_r − x_l)
        let ratio = (ICRS[1] - ICRS[0]) / 0.42;
        assert!((value("observed", k) - value("my_fit", k)).abs() < ROUNDING);
        assert!((value("ideal", k) - ratio * value("my_fit", k)).abs() < ROUNDING);
    }
}

#[test]
fn track_speeds_are_the_measured_ones() {
    let recording = synthetic().recording().expect("runs");
    let runs = recording.runs();
    let found = synthetic_messages();
    let readings = (0..2).flat_map(|run| runs[run].tracks().iter().map(move |of| (run, of)));
    for (k, (run, reading)) in readings.enumerate() {
        let joints = &found["/trackdyn/tracks"][k];
        assert_eq!(joints.log, stamp(runs, run, reading.t));
        assert_eq!([joints.text("name[0]"), joints.text("name[1]")], ["left_track", "right_track"]);
        assert_eq!(["position[]", "effort[]"].map(|of| joints.number(of)), [0.0, 0.0]);
        let speeds = [reading.v_left, reading.v_right];
        assert_eq!([0, 1].map(|of| joints.number(&format!("velocity[{of}]"))), speeds);
        let curves = ["left", "right"].map(|of| &found[&format!("/trackdyn/track_speed/{of}")][k]);
        assert_eq!(curves.map(|of| of.number("data")), speeds);
    }
}

/// The ICRs that poses and track speeds show are those of the robot, as curves and as markers.
#[test]
fn icrs_are_those_of_the_robot() {
    let found = synthetic_messages();
    for (topic, expected) in ["x_icr_left", "x_icr_right", "y_icr"].into_iter().zip(ICRS) {
        let values = &found[&format!("/trackdyn/my_fit/{topic}")];
        assert!(values.iter().all(|of| of.number("data") == expected), "{topic}");
    }
    // A second may hold two motions, of which one twist is not the mean: the middle of all counts.
    for (topic, expected) in ["x_icr_left", "x_icr_right", "y_icr"].into_iter().zip(ICRS) {
        let values = &found[&format!("/trackdyn/observed/{topic}")];
        let mut values: Vec<f64> = values.iter().map(|of| of.number("data")).collect();
        assert!(values.len() > 10, "{}", values.len());
        values.sort_by(f64::total_cmp);
        let median = values[values.len() / 2];
        assert!((median - expected).abs() < 1e-6, "{topic}: {median}");
    }
    let markers = &found["/trackdyn/my_fit/icrs"];
    let [x_left, x_right, y] = ICRS;
    for of in markers {
        assert_eq!(of.number("markers[]"), 3.0);
        for (k, x) in [(0, x_left), (1, x_right)] {
            let number = |path: &str| of.number(&format!("markers[{k}].{path}"));
            // ROS axes: x forward, y left
            assert_eq!(["x", "y"].map(|axis| number(&format!("pose.position.{axis}"))), [y, -x]);
            assert_eq!(
                ["type", "action", "frame_locked", "color.a"].map(number),
                [2.0, 0.0, 1.0, 1.0]
            );
            assert_eq!(of.text(&format!("markers[{k}].header.frame_id")), "base_link");
            let size = ["x", "y", "z"].map(|axis| number(&format!("scale.{axis}")));
            assert!(size.iter().all(|size| (size - 0.15 * 0.42).abs() < ROUNDING));
        }
        // the robot's ICR lies on the line through those of the tracks, or it is taken away
        let action = of.number("markers[2].action");
        let forward = of.number("markers[2].pose.position.x");
        assert!(if action == 0.0 { (forward - y).abs() < ROUNDING } else { action == 2.0 });
    }
    assert!(markers.iter().any(|of| of.number("markers[2].action") == 0.0));
}

#[test]
fn a_path_is_a_whole_run() {
    let recording = synthetic().recording().expect("runs");
    let found = synthetic_messages();
    let paths = &found["/trackdyn/observed/path"];
    assert_eq!(paths.len(), 2);
    for (path, run) in paths.iter().zip(recording.runs()) {
        let count = run.poses().len();
        assert_eq!(path.number("poses[]"), real(count));
        let last = count - 1;
        let end =
            ["x", "y"].map(|axis| path.number(&format!("poses[{last}].pose.position.{axis}")));
        assert_eq!(end, [run.poses()[last].pose.x, run.poses()[last].pose.y]);
    }
}
