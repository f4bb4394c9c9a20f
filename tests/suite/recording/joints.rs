//! Joints as robots name and publish them: the speeds of the tracks are right, or the message names
//! the joints and the options.

use super::drives::{Bag, RADIUS, angles, at, ns, poses, quaternion, speeds, times};
use trackdyn_core::PerSide;
use trackdyn_recording::rosbag::{self, JointSignal, RosbagOptions};
use trackdyn_recording::{Doubt, DoubtKind, Error, PoseAxes, Recording, SpeedUnit};

const TOPIC: &str = "/joint_states";

fn options() -> RosbagOptions {
    RosbagOptions { wheel_radius: Some(RADIUS), ..RosbagOptions::default() }
}

fn read_by(bag: Bag, options: &RosbagOptions) -> Result<Recording, Error> {
    let (_folder, path) = bag.write();
    rosbag::read(&path, options)
}

fn read(bag: Bag) -> Recording {
    read_by(bag.with_poses(), &options()).expect("readable")
}

fn refused(bag: Bag) -> String {
    read_by(bag.with_poses(), &options()).expect_err("refused").to_string()
}

/// Compares speeds with the truth at the middle of what a reading holds for: `ahead` s later.
#[track_caller]
fn assert_speeds(recording: &Recording, count: usize, ahead: f64, tolerance: f64) {
    let ahead = ahead - recording.runs()[0].poses()[0].t;
    let tracks = recording.runs()[0].tracks();
    assert!(tracks.len().abs_diff(count) <= 4, "{} readings", tracks.len());
    for sample in tracks {
        let truth = speeds(sample.t + ahead).map(|speed| RADIUS * speed);
        let error = (sample.v_left - truth.left).abs().max((sample.v_right - truth.right).abs());
        assert!(error <= tolerance, "{sample:?} instead of {truth:?}");
    }
}

#[track_caller]
fn assert_says(recording: &Recording, part: &str) {
    let notes: Vec<String> = recording.warnings().iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.contains(part)), "{part:?} is not in {notes:?}");
}

/// A bag of messages with these joints, `rate` a second.
fn of_joints(rate: u32, names: &[&str], signals: impl Fn(f64) -> [Vec<f64>; 2]) -> Bag {
    let mut bag = Bag::default();
    for t in times(rate) {
        let [positions, velocities] = signals(t);
        bag.joints(TOPIC, at(t), names, [&positions, &velocities]);
    }
    bag
}

#[test]
fn parts_that_are_no_wheels_do_not_count() {
    let names = [
        "left_track_joint",
        "right_track_joint",
        "front_left_flipper_joint",
        "camera_upright_joint",
        "rear_right_flipper_joint",
        "left_arm_motor",
        "gripper_right",
    ];
    let recording = read(of_joints(50, &names, |t| {
        let PerSide { left, right } = speeds(t);
        [vec![], vec![left, right, 0.3 * t.cos(), 0.0, 0.2, 0.1, 0.0]]
    }));
    assert_speeds(&recording, 3000, 0.0, 1e-12);
    assert_says(
        &recording,
        "left joints: took left_track_joint; front_left_flipper_joint, left_arm",
    );
}

#[test]
fn four_wheels_are_known_by_their_letters() {
    for names in [
        ["fl_wheel", "fr_wheel", "rl_wheel", "rr_wheel"],
        ["wheelFL", "wheelFR", "wheelRL", "wheelRR"],
        ["front_l", "front_r", "rear_l", "rear_r"],
        ["m1_lf", "m2_rf", "m3_lb", "m4_rb"],
    ] {
        let recording = read(of_joints(50, &names, |t| {
            let PerSide { left, right } = speeds(t);
            [vec![], vec![1.005 * left, 0.995 * right, 0.995 * left, 1.005 * right]]
        }));
        assert_speeds(&recording, 3000, 0.0, 1e-12);
    }
}

#[test]
fn joints_of_a_side_that_move_apart_are_refused_with_the_options() {
    let text = refused(of_joints(50, &["left_a", "left_b", "right_a"], |t| {
        let PerSide { left, right } = speeds(t);
        [vec![], vec![left, 0.3 * (2.0 * t).sin(), right]]
    }));
    for part in ["do not move alike", "--left-joint and --right-joint", "has left_a, left_b"] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    assert!(!text.contains("--left-joint left_a"), "the mean of both is wrong: {text}");
    let text = refused(of_joints(50, &["left_a", "left_b", "right_a"], |t| {
        let PerSide { left, right } = speeds(t);
        [vec![], vec![2.0 * left, left, right]]
    }));
    assert!(text.contains("the first turns 2.00 times as far"), "{text}");
    let axles = ["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"];
    let faster_in_front = |ratio: f64| {
        of_joints(50, &axles, move |t| {
            let PerSide { left, right } = speeds(t);
            [vec![], vec![ratio * left, ratio * right, left, right]]
        })
    };
    let text = refused(faster_in_front(1.1));
    for part in [
        "front_left_wheel turns 1.100 times as far as rear_left_wheel",
        "--left-joint front_left_wheel --right-joint front_right_wheel or",
        "--left-joint rear_left_wheel --right-joint rear_right_wheel",
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    let recording = read(faster_in_front(1.03));
    assert_says(&recording, "front_left_wheel turns 1.030 times as far as rear_left_wheel");
    let text = refused(of_joints(50, &["left_a", "left_b", "right_a"], |t| {
        let PerSide { left, right } = speeds(t);
        [vec![], vec![left, -left, right]]
    }));
    assert!(text.contains("left_b counts backwards beside left_a"), "{text}");
    assert!(text.contains("--left-joint left_a --left-joint -left_b"), "{text}");
    // a wheel whose encoder is dead is left out
    let recording = read(of_joints(50, &["left_a", "left_b", "right_a"], |t| {
        let PerSide { left, right } = speeds(t);
        [vec![], vec![left, 0.0, right]]
    }));
    assert_speeds(&recording, 3000, 0.0, 1e-12);
    assert_says(&recording, "left_b, which never move");
}

#[test]
fn the_options_that_an_error_offers_read_the_drive() {
    let names = ["left_a", "left_b", "right_a"];
    let bag = || {
        of_joints(50, &names, |t| {
            let PerSide { left, right } = speeds(t);
            [vec![], vec![left, -left, right]]
        })
    };
    let named = RosbagOptions { left_joints: vec!["left_a".into(), "-left_b".into()], ..options() };
    let recording = read_by(bag().with_poses(), &named).expect("readable");
    assert_speeds(&recording, 3000, 0.0, 1e-12);
    let wrong = RosbagOptions { left_joints: vec!["left_a".into(), "left_b".into()], ..options() };
    let wrong = RosbagOptions { accepted: DoubtKind::ALL.to_vec(), ..wrong };
    let recording = read_by(bag().with_poses(), &wrong).expect("accepted");
    assert_says(&recording, "the mean of left_a, left_b, but left_a and left_b do not move alike");
}

#[test]
fn joints_of_two_robots_are_told_apart() {
    let names = ["r1/left_wheel", "r1/right_wheel", "r2/left_wheel", "r2/right_wheel"];
    let text = refused(of_joints(50, &names, |t| {
        let PerSide { left, right } = speeds(t);
        [vec![], vec![left, right, (0.3 * t).sin(), (0.2 * t).cos()]]
    }));
    for part in [
        "joints of several robots",
        "--left-joint r1/left_wheel --right-joint r1/right_wheel are those of r1",
        "--left-joint r2/left_wheel --right-joint r2/right_wheel are those of r2",
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
}

/// Speeds, and ways, of the tracks in place of those of the wheels: their ratio is too near to that
/// of turns and radians to tell which it is.
#[test]
fn metres_in_place_of_radians_are_named_beside_turns() {
    for is_position in [false, true] {
        let bag = of_joints(50, &["left_wheel", "right_wheel"], |t| {
            let PerSide { left, right } = if is_position { angles(t) } else { speeds(t) };
            let signal = vec![RADIUS * left, RADIUS * right];
            if is_position { [signal, vec![]] } else { [vec![], signal] }
        });
        let text = refused(bag);
        for part in ["--speed-unit m/s", "--speed-unit turns/s", "too near to tell"] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }
}

#[test]
fn one_wrong_reading_of_a_wheel_decides_nothing() {
    let recording = read(of_joints(50, &["fl", "rl", "fr", "rr"], |t| {
        let PerSide { left, right } = speeds(t);
        let wrong = if t == 30.0 { 1000.0 } else { left };
        [vec![], vec![wrong, left, right, right]]
    }));
    assert_eq!(recording.runs()[0].tracks().len(), 3000);
}

#[test]
fn zeros_of_another_publisher_are_left_out() {
    let names = ["left_wheel", "right_wheel"];
    // of other signals; of these signals; on a topic of its own
    for (topic, velocities) in [(TOPIC, &[][..]), (TOPIC, &[0.0, 0.0]), ("/zeros", &[0.0, 0.0])] {
        let mut bag = of_joints(50, &names, |t| {
            let PerSide { left, right } = speeds(t);
            let [a, b] = [angles(t).left, angles(t).right];
            [vec![1.0 + a, 1.0 + b], vec![left, right]]
        });
        for t in times(100) {
            bag.joints(topic, at(t + 0.003), &names, [&[0.0, 0.0], velocities]);
        }
        let recording = read(bag);
        assert_speeds(&recording, 3000, 0.0, 1e-12);
        assert_says(&recording, "6000 messages skipped");
    }
}

/// A publisher of all joints of a description sends zeros for flippers too; one of a simulation
/// sends positions of its own.
#[test]
fn other_publishers_of_more_joints_are_left_out() {
    let all = ["left_wheel", "right_wheel", "front_left_flipper", "left_antenna_mount"];
    for moves in [0.0, 1.0] {
        let mut bag = of_joints(50, &["left_wheel", "right_wheel"], |t| {
            [vec![1.0 + angles(t).left, angles(t).right], vec![speeds(t).left, speeds(t).right]]
        });
        for t in times(20) {
            let of = angles(0.9 * t);
            let positions = [moves * of.left, moves * of.right, 0.0, 0.0];
            bag.joints(TOPIC, at(t + 0.003), &all, [&positions, &[]]);
        }
        let recording = read(bag);
        assert_speeds(&recording, 3000, 0.0, 1e-12);
        assert_says(&recording, "1200 messages skipped");
    }
}

/// Readings of the first seconds lack what a driver does not know yet.
#[test]
fn messages_that_lack_a_signal_are_left_out() {
    let recording = read(of_joints(50, &["left_wheel", "right_wheel"], |t| {
        let PerSide { left, right } = speeds(t);
        let positions = vec![angles(t).left, angles(t).right];
        [positions, if t < 0.09 { vec![] } else { vec![left, right] }]
    }));
    assert_speeds(&recording, 2995, 0.0, 1e-12);
    assert_says(&recording, "5 messages skipped, the first because left_wheel has no velocity");
}

#[test]
fn a_message_for_each_wheel_and_a_topic_for_each_side_are_merged() {
    let mut each = Bag::default();
    let mut sides = Bag::default();
    for t in times(50) {
        let PerSide { left, right } = speeds(t);
        let wheels = [("fl", left), ("fr", right), ("rl", left), ("rr", right)];
        for (delay, (name, speed)) in [0.0, 1e-6, 2e-6, 3e-6].into_iter().zip(wheels) {
            each.joints(TOPIC, at(t + delay), &[name], [&[], &[speed]]);
        }
        sides.joints("/left/joint_states", at(t), &["wheel"], [&[], &[left]]);
        let late = speeds(t + 0.008).right;
        sides.joints("/right/joint_states", at(t + 0.008), &["wheel"], [&[], &[late]]);
    }
    assert_speeds(&read(each), 3000, 0.0, 1e-4);
    let recording = read(sides);
    // interpolated over 20 ms: at most a²/8 of the second derivative, but for the ends
    assert_speeds(&recording, 3000, 0.0, 0.002);
    assert_says(&recording, "took /left/joint_states, /right/joint_states");
}

#[test]
fn positions_stand_in_for_velocities_that_never_move() {
    let names = ["left_wheel", "right_wheel"];
    for velocities in [vec![], vec![0.0, 0.0], vec![f64::NAN, f64::NAN]] {
        let bag =
            of_joints(50, &names, |t| [vec![angles(t).left, angles(t).right], velocities.clone()]);
        let recording = read(bag);
        assert_speeds(&recording, 3000, 0.01, 1e-3);
        if velocities.first() == Some(&0.0) {
            assert_says(&recording, "took the position: the velocity of left_wheel is always 0");
        }
    }
    let bag = of_joints(50, &names, |t| [vec![0.0, 0.0], vec![speeds(t).left, speeds(t).right]]);
    assert_speeds(&read(bag), 3000, 0.0, 1e-12);
    let by_position = RosbagOptions { joint_signal: JointSignal::Position, ..options() };
    let bag = of_joints(50, &names, |t| [vec![0.0, 0.0], vec![speeds(t).left, speeds(t).right]]);
    let text = read_by(bag.with_poses(), &by_position).expect_err("refused").to_string();
    assert!(text.contains("--joint-signal velocity"), "{text}");
}

#[test]
fn sides_that_count_backwards_or_are_swapped_are_refused_with_the_options_that_help() {
    type Signals = fn(PerSide<f64>) -> [f64; 2];
    let cases: [(Signals, &str, [&str; 2]); 4] = [
        (|v| [v.left, -v.right], "right side counts backwards", ["wheel_l", "-wheel_r"]),
        (|v| [-v.left, v.right], "left side counts backwards", ["-wheel_l", "wheel_r"]),
        (|v| [-v.left, -v.right], "both sides count backwards", ["-wheel_l", "-wheel_r"]),
        (|v| [v.right, v.left], "left and right are swapped", ["wheel_r", "wheel_l"]),
    ];
    for (signals, what, [left, right]) in cases {
        let bag = || {
            let names = ["wheel_l", "wheel_r"];
            of_joints(50, &names, |t| [vec![], signals(speeds(t)).to_vec()]).with_poses()
        };
        let error = read_by(bag(), &options()).expect_err(what);
        let text = error.to_string();
        assert!(text.contains(what), "{text}");
        let named = RosbagOptions {
            left_joints: vec![left.to_owned()],
            right_joints: vec![right.to_owned()],
            ..options()
        };
        let of_right = format!("--right-joint {right}");
        let is_told = text.contains(&of_right) || text.contains(&format!("--left-joint {left}"));
        assert!(is_told, "{text}");
        assert_speeds(&read_by(bag(), &named).expect(what), 3000, 0.0, 1e-12);
    }
}

/// Names tell the sides, so it is the poses that are mirrored.
#[test]
fn poses_that_count_clockwise_beside_named_joints_do_not_swap_them() {
    let mirrored = || {
        let mut bag = Bag::default().with_wheels();
        for (t, pose) in poses() {
            bag.pose(at(t), [pose.x, -pose.y], quaternion(-pose.yaw));
        }
        bag
    };
    let error = read_by(mirrored(), &options()).expect_err("mirrored");
    let text = error.to_string();
    assert!(text.contains("tell left from right") && text.contains("--pose-axes ned"), "{text}");
    assert!(matches!(error, Error::Contradiction { joints: None, .. }), "{text}");
    let ned = RosbagOptions { pose_axes: PoseAxes::NorthEastDown, ..options() };
    let found = read_by(mirrored(), &ned).expect("right");
    let truth = read(Bag::default().with_wheels().with_poses());
    for (found, expected) in found.runs()[0].poses().iter().zip(truth.runs()[0].poses()) {
        let off = expected.pose.relative(&found.pose);
        assert!(off.x.abs().max(off.y.abs()).max(off.yaw.abs()) < 1e-6, "{off:?}");
    }
}

#[test]
fn units_that_no_slip_explains_are_named() {
    let names = ["left_wheel", "right_wheel"];
    for (factor, unit) in [(57.3, "degrees"), (9.55, "turns per minute"), (1000.0, "millimetres")] {
        let bag = of_joints(50, &names, |t| {
            [vec![], vec![factor * speeds(t).left, factor * speeds(t).right]]
        });
        let text = refused(bag);
        assert!(text.contains(unit) && text.contains("--wheel-radius"), "{text}");
    }
    // poses in millimetres
    let mut bag = Bag::default().with_wheels();
    for (t, pose) in poses() {
        bag.pose(at(t), [1000.0 * pose.x, 1000.0 * pose.y], quaternion(pose.yaw));
    }
    let error = read_by(bag, &options()).expect_err("refused");
    let is_it = matches!(&error, Error::Contradiction { doubt: Doubt::Travel { ratio, .. }, .. }
        if (0.0009..0.0012).contains(ratio));
    assert!(is_it, "{error}");
    // tracks that slip by half of their way are no matter of units
    let mut bag = Bag::default().with_wheels();
    for (t, pose) in poses() {
        bag.pose(at(t), [0.5 * pose.x, 0.5 * pose.y], quaternion(pose.yaw));
    }
    assert_eq!(ns(1.0), 1_000_000_000);
    assert_speeds(&read_by(bag, &options()).expect("slip"), 3000, 0.0, 1e-12);
}

#[test]
fn a_counter_that_does_not_move_is_named() {
    let names = ["left_wheel", "right_wheel"];
    let text = refused(of_joints(50, &names, |t| [vec![0.7, angles(t).right], vec![]]));
    assert!(text.contains("left side never changes (0.000 m/s all the time)"), "{text}");
    assert!(text.contains("a dead encoder"), "{text}");
}

#[test]
fn joints_in_other_units_are_read_with_the_option() {
    let names = ["left_wheel", "right_wheel"];
    let degrees = |of: PerSide<f64>| vec![of.left.to_degrees(), of.right.to_degrees()];
    let by_degrees = RosbagOptions { speed_unit: Some(SpeedUnit::DegreesPerSecond), ..options() };
    let bag = of_joints(50, &names, |t| [degrees(angles(t)), degrees(speeds(t))]).with_poses();
    assert_speeds(&read_by(bag, &by_degrees).expect("velocities"), 3000, 0.0, 1e-9);
    let bag = of_joints(50, &names, |t| [degrees(angles(t)), vec![]]).with_poses();
    assert_speeds(&read_by(bag, &by_degrees).expect("angles"), 3000, 0.01, 1e-3);
    // a driver that reports the speeds of the tracks as those of joints, in km/h
    let kilometres = |t: f64| {
        let PerSide { left, right } = speeds(t).map(|speed| 3.6 * RADIUS * speed);
        [vec![], vec![left, right]]
    };
    let of_tracks = RosbagOptions {
        speed_unit: Some(SpeedUnit::KilometresPerHour),
        wheel_radius: None,
        ..RosbagOptions::default()
    };
    let bag = of_joints(50, &names, kilometres).with_poses();
    assert_speeds(&read_by(bag, &of_tracks).expect("readable"), 3000, 0.0, 1e-9);
}

/// A joint whose position is reported modulo anything: the jumps tell it.
#[test]
fn positions_that_wrap_anywhere_give_the_speeds() {
    let modulo = |rate: u32, modulus: f64| {
        of_joints(rate, &["left_wheel", "right_wheel"], |t| {
            let PerSide { left, right } = angles(t);
            let coarse = |angle: f64| (angle / 5e-4).round() * 5e-4;
            [vec![coarse(left).rem_euclid(modulus), coarse(right).rem_euclid(modulus)], vec![]]
        })
    };
    for (rate, modulus) in [(50, 1.0), (10, 3.0), (20, 6.0), (10, 12.5)] {
        let recording = read(modulo(rate, modulus));
        // Means over a step of a speed that changes by up to 2.1 rad/s², and 2e-3 of 4.5 rad/s.
        let tolerance = RADIUS * (2.1 / f64::from(rate) + 0.05);
        assert_speeds(&recording, usize::try_from(60 * rate).expect("small"), 0.0, tolerance);
        assert_says(&recording, "as its jumps show");
    }
    let text = refused(modulo(10, 0.7));
    assert!(text.contains("which way it turned is not known"), "{text}");
}
