//! Generated schedules and schedules from files.

use trackdyn_core::{PerSide, Plant, Schedule};
use trackdyn_drive::schedules::{load, read, text, write};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, ScheduledRun};

use crate::driving::plant::auriga;

fn generated(kind: ScheduleKind, options: &ScheduleOptions) -> Vec<ScheduledRun> {
    kind.generate(options).expect("valid options")
}

/// Way of the middle between the tracks, m.
fn length(schedule: &Schedule) -> f64 {
    let step = |(from, until, v): (f64, f64, PerSide<f64>)| {
        (until - from) * f64::midpoint(v.left, v.right).abs()
    };
    schedule.stretches().map(step).sum()
}

#[test]
fn belts_neither_jump_nor_run_too_fast_and_rest_at_both_ends() {
    for kind in ScheduleKind::ALL {
        for (fastest, acceleration) in [(1.0, 1.0), (0.3, 0.5)] {
            let options = ScheduleOptions { fastest, acceleration, ..ScheduleOptions::default() };
            for run in generated(kind, &options) {
                let commands = run.schedule.commands();
                let [first, last] = [commands[0], commands[commands.len() - 1]];
                for end in [first, last] {
                    assert_eq!(end.speeds, PerSide::default(), "{}", kind.name());
                }
                for pair in commands.windows(2) {
                    let [a, b] = [pair[0], pair[1]];
                    assert!((b.t - a.t - options.interval).abs() < 1e-9);
                    for side in trackdyn_core::Side::BOTH {
                        assert!(b.speeds[side].abs() <= fastest * (1.0 + 1e-12));
                        let change = (b.speeds[side] - a.speeds[side]).abs();
                        // rounding, and the last command of a travel, which ends within an interval
                        assert!(change <= acceleration * options.interval * (1.0 + 1e-9));
                    }
                }
            }
        }
    }
}

#[test]
fn manual_paths_are_nine_of_twenty_metres_and_all_different() {
    let options = ScheduleOptions::default();
    let mut runs = generated(ScheduleKind::Manual, &options);
    assert_eq!(runs.len(), 9);
    runs.extend(generated(ScheduleKind::Validation, &options));
    assert_eq!(runs.iter().map(|run| run.id).collect::<Vec<_>>(), (0..11).collect::<Vec<_>>());
    let mut turned = [0.0_f64; 2];
    for (index, run) in runs.iter().enumerate() {
        let length = length(&run.schedule);
        // The driver brakes for the end as if going straight, and may be stopping out of a turn.
        assert!((length - 20.0).abs() < 0.5, "{length} m");
        assert!((25.0..90.0).contains(&run.schedule.duration()), "{}", run.schedule.duration());
        assert!(runs[..index].iter().all(|other| other.schedule != run.schedule));
        let trajectory = auriga().follow(&run.schedule).expect("it rolls");
        for pair in trajectory.moments().windows(2) {
            let turn = pair[1].pose.yaw - pair[0].pose.yaw;
            turned[usize::from(turn > 0.0)] += turn.abs();
        }
    }
    // A hand that turns either way: 11 runs with some 20 turns each.
    assert!(turned.iter().all(|turned| *turned > 20.0), "{turned:?} rad to the right and left");
    let speeds = runs.iter().flat_map(|run| run.schedule.commands()).map(|c| c.speeds);
    let reversing = speeds.clone().filter(|v| v.left < -0.05 && v.right < -0.05).count();
    let opposite = speeds.filter(|v| v.left * v.right < -0.0025).count();
    assert!(
        reversing > 100 && opposite > 100,
        "{reversing} reversing, {opposite} counter-rotating"
    );
}

#[test]
fn designed_runs_hold_every_manoeuvre_in_drawn_order() {
    let options = ScheduleOptions::default();
    let runs = generated(ScheduleKind::Designed, &options);
    let steady = |schedule: &Schedule| {
        let mut held: Vec<[f64; 2]> = Vec::new();
        let commands = schedule.commands();
        for trio in commands.windows(3) {
            let v = trio[0].speeds;
            let moves = v != PerSide::default();
            if moves && trio.iter().all(|command| command.speeds == v) {
                held.push([v.left, v.right]);
            }
        }
        held.dedup();
        held
    };
    let orders: Vec<Vec<[f64; 2]>> = runs.iter().map(|run| steady(&run.schedule)).collect();
    for order in &orders {
        assert_eq!(order.len(), 4 * 14);
        // what goes forward goes backward, what turns left turns right
        for [left, right] in order {
            for twin in [[-left, -right], [*right, *left]] {
                let known = *left == 0.0 || *right == 0.0 || order.contains(&twin);
                assert!(known, "{twin:?} is missing");
            }
        }
    }
    assert_ne!(orders[0], orders[1]);
}

#[test]
fn squares_close_on_a_robot_of_these_icrs() {
    let icrs = crate::driving::plant::AURIGA;
    let icr_distance = icrs.x_right - icrs.x_left;
    // a side that is no multiple of any command
    let options = ScheduleOptions { icr_distance, side: 2.345, ..ScheduleOptions::default() };
    for run in generated(ScheduleKind::Square, &options) {
        let trajectory = auriga().follow(&run.schedule).expect("it rolls");
        let end = trajectory.moments().last().expect("moments").pose;
        let turn = if run.id == 0 { 1.0 } else { -1.0 };
        // exact but for the microsecond in which the robot of the test changes speed
        assert!((end.yaw - turn * std::f64::consts::TAU).abs() < 1e-6, "{end:?}");
        // Turns on the spot move the origin about the centre of rotation; four of them bring it
        // back.
        assert!(end.x.hypot(end.y) < 1e-6, "{end:?}");
    }
}

#[test]
fn durations_and_steps_are_as_asked_for() {
    for kind in ScheduleKind::ALL {
        let options =
            ScheduleOptions { duration: Some(40.0), runs: Some(1), ..ScheduleOptions::default() };
        let duration = generated(kind, &options)[0].schedule.duration();
        // up to the end of a manoeuvre or of a square
        assert!((38.0..90.0).contains(&duration), "{}: {duration} s", kind.name());
    }
    let steps = ScheduleOptions { acceleration: f64::INFINITY, ..ScheduleOptions::default() };
    for kind in ScheduleKind::ALL {
        let commands = generated(kind, &steps)[0].schedule.commands().to_vec();
        assert!(commands.iter().all(|command| command.speeds.left.is_finite()));
    }
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let refused = |options: ScheduleOptions| {
        ScheduleKind::Square.generate(&options).expect_err("refused").to_string()
    };
    let default = ScheduleOptions::default;
    for (name, options) in [
        ("fastest = NaN", ScheduleOptions { fastest: f64::NAN, ..default() }),
        ("fastest = 2000", ScheduleOptions { fastest: 2000.0, ..default() }),
        ("interval = 0", ScheduleOptions { interval: 0.0, ..default() }),
        ("duration = -1", ScheduleOptions { duration: Some(-1.0), ..default() }),
        ("acceleration = 0", ScheduleOptions { acceleration: 0.0, ..default() }),
        ("runs = 0", ScheduleOptions { runs: Some(0), ..default() }),
        ("side = inf", ScheduleOptions { side: f64::INFINITY, ..default() }),
    ] {
        assert!(refused(options).starts_with(name), "{name}");
    }
    // a drive by hand has no sides
    let by_hand = ScheduleOptions { side: f64::INFINITY, icr_distance: 360.0, ..default() };
    ScheduleKind::Manual.generate(&by_hand).expect("it drives");
}

#[test]
fn files_read_back_to_the_same_bits() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("schedule.csv");
    for (kind, runs) in [(ScheduleKind::Manual, None), (ScheduleKind::Square, Some(1))] {
        let options = ScheduleOptions { runs, ..ScheduleOptions::default() };
        let runs = generated(kind, &options);
        write(&path, &runs).expect("written");
        assert_eq!(text(&runs).starts_with("run,t"), runs.len() > 1);
        assert_eq!(read(&path).expect("readable"), runs);
        assert_eq!(load(path.to_str().expect("a path"), &options).expect("readable"), runs);
    }
}

#[test]
fn files_that_make_no_sense_are_refused_with_their_place() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("s.csv");
    for (text, expected) in [
        ("t,v_left,v_right\n0,0,0\n1,NaN,0\n", "s.csv:3:2: v_left = \"NaN\": expected a finite"),
        ("t,v_left,v_right\n0,0,0\n1,0,fast\n", "s.csv:3:3: v_right = \"fast\""),
        ("t,v_left,v_right\n0,0,0\n1,0,1001\n", "s.csv:3:3: v_right = \"1001\": expected a speed"),
        ("t,v_left,v_right\n1,0,0\n1,0,0\n", "s.csv:3:1: t = \"1\": expected a time after"),
        ("t,v_left,v_right\n1,0,0\n0,0,0\n", "s.csv:3:1: t = \"0\": expected a time after"),
        ("t,v_left,v_right\n0,0,0\n", "s.csv: run 0 has a single row: expected"),
        ("run,t,v_left,v_right\n4,0,0,0\n4,1,0,0\n7,0,0,0\n", "run 7 has a single row"),
        ("t,v_left,v_right\n", "s.csv: no rows below the header"),
        ("t,left,right\n0,0,0\n", "s.csv:1: columns t,left,right: expected t,v_left,v_right"),
        ("run,t,v_left,v_right\n1.5,0,0,0\n", "s.csv:2:1: run = \"1.5\": expected an integer"),
        ("t,v_left,v_right\n,0,0\n", "s.csv:2:1: t = \"\": expected a finite number"),
    ] {
        std::fs::write(&path, text).expect("written");
        let error = read(&path).expect_err("refused").to_string();
        assert!(error.contains(expected), "{error}");
    }
    let error = load("joystick", &ScheduleOptions::default()).expect_err("unknown").to_string();
    assert!(error.contains("manual, validation, designed, square or a CSV file"), "{error}");
}
