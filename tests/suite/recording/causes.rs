//! Logs that are refused, or mended, by the cause of what is wrong with them.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;
use trackdyn_core::{PerSide, Side};
use trackdyn_estimate::Interval;
use trackdyn_estimate::identification::{Options, icrs_alone};
use trackdyn_estimate::synthetic::{ConstantIcr, Stretch, Synthetic, random_steps};
use trackdyn_recording::recording::Finding;
use trackdyn_recording::{
    Doubt, DoubtKind, Error, Format, ImuSample, PoseAxes, Recording, Run, Source, SpeedUnit,
    TableOptions, UncheckedRun, Warning, folder,
};

/// Drives of half a minute, with the noise of encoders and poses.
fn rows() -> Vec<UncheckedRun> {
    let schedules = (0..4).map(|run| random_steps(15, 2.0, 0.8, run)).collect();
    driven(schedules)
}

fn driven(schedules: Vec<Vec<Stretch>>) -> Vec<UncheckedRun> {
    let alpha = PerSide::new(1.0, 1.0);
    let synthetic = Synthetic {
        kinematics: ConstantIcr { x_left: -0.4, x_right: 0.42, y: 0.03, alpha },
        schedules,
        encoder_noise: 0.01,
        position_noise: 0.005,
        yaw_noise: 0.005,
        tau: 0.1,
        seed: 4,
        ..Synthetic::default()
    };
    let recording = synthetic.recording().expect("long enough");
    recording.runs().iter().cloned().map(Run::into_rows).collect()
}

fn read(runs: Vec<UncheckedRun>) -> Result<Recording, Error> {
    accepting(runs, &[])
}

fn accepting(runs: Vec<UncheckedRun>, accepted: &[DoubtKind]) -> Result<Recording, Error> {
    let source = Source { format: Format::Folder, path: Some("log".into()), ..Source::computed() };
    Recording::accepting("log", "robot", runs, source, Vec::new(), accepted)
}

/// The doubt that stops a reader, and its message.
fn refused(runs: Vec<UncheckedRun>) -> (Doubt, String) {
    let error = read(runs).expect_err("refused");
    let text = error.to_string();
    let Error::Contradiction { doubt, .. } = error else { panic!("{text}") };
    (doubt, text)
}

fn change(mut runs: Vec<UncheckedRun>, of: impl Fn(&mut UncheckedRun)) -> Vec<UncheckedRun> {
    runs.iter_mut().for_each(of);
    runs
}

/// What was found in the rows.
fn findings(recording: &Recording) -> Vec<(Finding, usize)> {
    let found = recording.warnings().iter().filter_map(|warning| match warning {
        Warning::Cleaned(cleaning) => Some((cleaning.finding, cleaning.count)),
        _ => None,
    });
    found.collect()
}

#[test]
fn a_drive_as_it_was_is_read_without_a_word() {
    let recording = read(rows()).expect("right");
    assert!(recording.warnings().is_empty(), "{:?}", recording.warnings());
}

#[test]
fn a_dead_encoder_is_named() {
    for (dead, name) in [(0.0, "left"), (0.37, "left")] {
        let runs = change(rows(), |run| {
            for reading in &mut run.tracks.samples {
                reading.v_left = dead;
            }
        });
        let (doubt, text) = refused(runs.clone());
        assert!(matches!(doubt, Doubt::DeadEncoder { side: Some(_), .. }), "{text}");
        assert!(text.contains(&format!("the {name} side never changes")), "{text}");
        assert!(text.contains("--accept dead-encoder"), "{text}");
        let recording = accepting(runs, &[DoubtKind::DeadEncoder]).expect("accepted");
        let is_told = |warning: &Warning| matches!(warning, Warning::Accepted(_));
        assert!(recording.warnings().iter().any(is_told));
    }
    let runs = change(rows(), |run| {
        for reading in &mut run.tracks.samples {
            (reading.v_left, reading.v_right) = (0.0, 0.0);
        }
    });
    let (doubt, text) = refused(runs);
    assert!(matches!(doubt, Doubt::DeadEncoder { side: None, .. }), "{text}");
}

/// A log in which only the noise of the poses moves.
#[test]
fn a_robot_that_only_stands_still_is_named() {
    let speeds = PerSide::new(0.0, 0.0);
    let still = || driven(vec![vec![Stretch { duration: 60.0, speeds }]]);
    let runs = change(still(), |run| {
        for reading in &mut run.tracks.samples {
            (reading.v_left, reading.v_right) = (0.0, 0.0);
        }
    });
    let (doubt, text) = refused(runs.clone());
    assert!(matches!(doubt, Doubt::StoodStill { .. }), "{text}");
    assert!(text.contains("only stands still") && text.contains("turns on the spot"), "{text}");
    assert!(accepting(runs, &[DoubtKind::DeadEncoder]).is_ok());
}

#[test]
fn a_track_that_stands_is_no_dead_encoder() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for left in [0.0, 0.4] {
        let mut stretch = || {
            let speeds = PerSide::new(left, random.random_range(-0.8..0.8));
            Stretch { duration: 2.0, speeds }
        };
        let schedule: Vec<Stretch> = (0..40).map(|_| stretch()).collect();
        let runs = change(driven(vec![schedule]), |run| {
            for reading in &mut run.tracks.samples {
                reading.v_left = left;
            }
        });
        let recording = read(runs).expect("a pivot");
        assert!(recording.warnings().is_empty(), "{:?}", recording.warnings());
    }
}

#[test]
fn an_encoder_that_dies_on_the_way_is_left_out_from_there_on() {
    let mut runs = rows();
    let readings = &mut runs[2].tracks.samples;
    let from = readings.len() / 2;
    for reading in &mut readings[from..] {
        reading.v_right = 0.0;
    }
    let dead = readings.len() - from;
    for reading in &mut runs[0].tracks.samples[100..103] {
        reading.v_left = 0.0;
    }
    let good = runs[0].tracks.samples[97];
    let recording = read(runs).expect("usable");
    let [(Finding::Dead { longest }, count)] = findings(&recording)[..] else {
        panic!("{:?}", recording.warnings())
    };
    assert_eq!(count, dead + 3);
    assert!((longest - 15.0).abs() < 0.1, "{longest}");
    assert_eq!(recording.runs()[2].tracks().len(), from);
    // three zeros are bridged; the commanded speed does not change there
    let bridged = recording.runs()[0].tracks()[101];
    assert!((bridged.v_left - good.v_left).abs() < 0.05, "{bridged:?} {good:?}");
}

#[test]
fn a_robot_that_stops_at_once_has_no_dead_encoder() {
    let stops = |seed: u64| {
        let mut schedule = random_steps(30, 1.0, 0.8, seed);
        for (index, stretch) in schedule.iter_mut().enumerate() {
            match index % 4 {
                1 => stretch.speeds.left = 0.0,
                3 => stretch.speeds = PerSide::new(0.0, 0.0),
                _ => {}
            }
        }
        schedule
    };
    let recording = read(driven((0..4).map(stops).collect())).expect("right");
    assert!(findings(&recording).is_empty(), "{:?}", recording.warnings());
}

#[test]
fn a_stuck_tracker_is_named() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for noise in [0.0, 0.003] {
        let mut runs = rows();
        for sample in runs.iter_mut().flat_map(|run| &mut run.poses.samples) {
            sample.pose.x = 1.0 + noise * random.random_range(-1.0..1.0);
            sample.pose.y = 2.0 + noise * random.random_range(-1.0..1.0);
            sample.pose.yaw = 0.5 + noise * random.random_range(-1.0..1.0);
        }
        let (doubt, text) = refused(runs);
        assert!(matches!(doubt, Doubt::StuckPoses { .. }), "{text}");
        assert!(text.contains("a tracker that is stuck"), "{text}");
    }
}

#[test]
fn poses_that_freeze_for_a_while_are_left_out() {
    let mut runs = rows();
    let poses = &mut runs[1].poses.samples;
    let (from, until) = (100, 180);
    let held = poses[from].pose;
    for sample in &mut poses[from..until] {
        sample.pose = held;
    }
    let recording = read(runs).expect("usable");
    let is_it = |(finding, count): &(Finding, usize)| {
        matches!(finding, Finding::Frozen { longest } if (longest - 7.9).abs() < 1e-9)
            && *count == until - from - 1
    };
    assert!(findings(&recording).iter().any(is_it), "{:?}", recording.warnings());
}

/// Two seconds out of every six: each too short to be told by what lies a second within.
#[test]
fn poses_that_freeze_again_and_again_are_left_out() {
    let runs = change(rows(), |run| {
        let mut held = run.poses.samples[0].pose;
        for sample in &mut run.poses.samples {
            if sample.t % 6.0 < 4.0 {
                held = sample.pose;
            }
            sample.pose = held;
        }
    });
    let recording = read(runs).expect("usable");
    let frozen = |(finding, _): &(Finding, usize)| matches!(finding, Finding::Frozen { .. });
    let found = findings(&recording);
    let (_, count) = found.iter().find(|found| frozen(found)).expect("frozen");
    // a third of 4 drives of 300 poses, less what the tracks hardly move in
    assert!((360..=400).contains(count), "{count}");
}

fn drives(seed: u64) -> Vec<UncheckedRun> {
    driven((0..4).map(|run| random_steps(30, 2.0, 0.8, 10 * seed + run)).collect())
}

/// x_r − x_l of the drives, m.
const GAP: f64 = 0.82;

fn gap(recording: &Recording) -> Interval {
    icrs_alone(recording, &Options::new(0.5)).expect("it turns").gap()
}

/// The limit of an encoder, or of the type of a message.
#[test]
fn speeds_that_are_cut_at_a_limit_are_left_out() {
    for limit in [0.6, 0.3] {
        let runs = change(drives(1), |run| {
            for reading in &mut run.tracks.samples {
                reading.v_left = reading.v_left.clamp(-limit, limit);
                reading.v_right = reading.v_right.clamp(-limit, limit);
            }
        });
        let recording = read(runs).expect("usable");
        let is_it = |(finding, _): &(Finding, usize)| match finding {
            Finding::Saturated { limit: found } => (found - limit).abs() < 1e-9,
            _ => false,
        };
        assert!(findings(&recording).iter().any(is_it), "{:?}", recording.warnings());
        let gap = gap(&recording);
        assert!(gap.low < GAP && GAP < gap.high && gap.deviation < 0.01, "{limit}: {gap:?}");
    }
}

/// A minute of it is enough.
#[test]
fn a_limit_shows_in_a_short_log() {
    for seed in 0..8 {
        let schedule = random_steps(30, 2.0, 0.8, seed);
        let runs = change(driven(vec![schedule]), |run| {
            for reading in &mut run.tracks.samples {
                reading.v_left = reading.v_left.clamp(-0.5, 0.5);
                reading.v_right = reading.v_right.clamp(-0.5, 0.5);
            }
        });
        let recording = read(runs).expect("usable");
        let is_it = |(finding, _): &(Finding, usize)| matches!(finding, Finding::Saturated { .. });
        assert!(findings(&recording).iter().any(is_it), "{seed}: {:?}", recording.warnings());
    }
}

/// A driver at full speed shows one number again and again, and his track runs as it says.
#[test]
fn speeds_that_are_driven_at_the_limit_stay() {
    for seed in 0..20 {
        let at_most = |stretch: Stretch| {
            let speeds = stretch.speeds.map(|speed| speed.clamp(-0.5, 0.5));
            Stretch { speeds, ..stretch }
        };
        let schedule = |run: u64| -> Vec<Stretch> {
            random_steps(30, 2.0, 0.8, 10 * seed + run).into_iter().map(at_most).collect()
        };
        let runs = change(driven((0..4).map(schedule).collect()), |run| {
            for reading in &mut run.tracks.samples {
                let near =
                    |speed: f64| if speed.abs() > 0.46 { speed.signum() * 0.5 } else { speed };
                (reading.v_left, reading.v_right) = (near(reading.v_left), near(reading.v_right));
            }
        });
        let recording = read(runs).expect("right");
        assert!(findings(&recording).is_empty(), "{seed}: {:?}", recording.warnings());
    }
}

#[test]
fn columns_of_mean_and_difference_are_named() {
    for (by, per_unit) in [(1.0, "1.22 rad"), (0.5, "2.44 rad"), (1.0 / GAP, "1.00 rad")] {
        for is_turned in [false, true] {
            let runs = change(drives(2), |run| {
                for reading in &mut run.tracks.samples {
                    let mean = f64::midpoint(reading.v_left, reading.v_right);
                    let difference = by * (reading.v_right - reading.v_left);
                    (reading.v_left, reading.v_right) =
                        if is_turned { (difference, mean) } else { (mean, difference) };
                }
            });
            let (doubt, text) = refused(runs);
            assert!(matches!(doubt, Doubt::NotSides { .. }), "{text}");
            assert!(text.contains(per_unit) && text.contains("mean - difference/2"), "{text}");
        }
    }
}

#[test]
fn a_bias_of_a_side_is_taken_off() {
    for (left, right) in [(0.05, 0.0), (0.0, -0.1), (0.03, 0.06)] {
        let runs = change(drives(3), |run| {
            for reading in &mut run.tracks.samples {
                reading.v_left += left;
                reading.v_right += right;
            }
        });
        let recording = read(runs).expect("usable");
        let found = |side: Side| {
            let of = findings(&recording).into_iter().find_map(|(finding, _)| match finding {
                Finding::Biased { side: of, speed } if of == side => Some(speed),
                _ => None,
            });
            of.unwrap_or(0.0)
        };
        for (side, bias) in [(Side::Left, left), (Side::Right, right)] {
            assert!((found(side) - bias).abs() < 2e-3, "{left} {right}: {}", found(side));
        }
        let gap = gap(&recording);
        assert!(gap.low < GAP && GAP < gap.high && gap.deviation < 0.005, "{gap:?}");
    }
}

/// Nothing is found in drives of robots of many kinds as they were.
#[test]
fn drives_as_they_were_are_left_alone() {
    for seed in 0..100_u64 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let half = random.random_range(0.25..1.0);
        let aside = half * random.random_range(-0.3..0.3);
        let fastest = random.random_range(0.3..2.0);
        let steps = random.random_range(0.7..4.0);
        let schedule = |run: u64| random_steps(25, steps, fastest, 100 * seed + run);
        let alpha = PerSide::new(random.random_range(0.9..1.1), random.random_range(0.9..1.1));
        let y = half * random.random_range(-0.3..0.3);
        let kinematics = ConstantIcr { x_left: aside - half, x_right: aside + half, y, alpha };
        let synthetic = Synthetic {
            kinematics,
            schedules: (0..random.random_range(1..6)).map(schedule).collect(),
            track_interval: [0.02, 0.05, 0.1][random.random_range(0..3)],
            pose_interval: [0.05, 0.1, 0.2][random.random_range(0..3)],
            encoder_noise: [0.0, 0.005, 0.02][random.random_range(0..3)],
            position_noise: random.random_range(0.001..0.02),
            yaw_noise: random.random_range(0.001..0.01),
            tau: random.random_range(-0.1..0.3),
            seed,
        };
        let recording = synthetic.recording().expect("long enough");
        let rows = recording.runs().iter().cloned().map(Run::into_rows).collect();
        let recording = read(rows).expect("right");
        assert!(findings(&recording).is_empty(), "{seed}: {:?}", recording.warnings());
    }
}

#[test]
fn speeds_in_kilometres_per_hour_and_of_wheels_are_named() {
    for (factor, option) in [
        (3.6, "--speed-unit km/h"),
        (1000.0, "--speed-unit mm/s"),
        (1.0 / 0.165, "--speed-unit rad/s --wheel-radius METRES"),
        (60.0 / (2.0 * PI * 0.165), "some 0.16"),
    ] {
        let runs = change(rows(), |run| {
            for reading in &mut run.tracks.samples {
                reading.v_left *= factor;
                reading.v_right *= factor;
            }
        });
        let (doubt, text) = refused(runs);
        assert!(matches!(doubt, Doubt::Travel { .. }), "{text}");
        assert!(text.contains(option), "{factor}: {text}");
    }
    // tracks that slip by two thirds of their way
    let runs = change(rows(), |run| {
        for reading in &mut run.tracks.samples {
            reading.v_left *= 2.8;
            reading.v_right *= 2.8;
        }
    });
    assert!(read(runs).is_ok());
}

#[test]
fn a_sensor_that_faces_backwards_is_named() {
    let backwards = || {
        change(rows(), |run| {
            for sample in &mut run.poses.samples {
                sample.pose.yaw += PI;
            }
        })
    };
    let (doubt, text) = refused(backwards());
    assert_eq!(doubt, Doubt::Backwards);
    assert!(text.contains("faces backwards") && text.contains("--mount-yaw 180"), "{text}");
}

#[test]
fn a_sensor_that_is_turned_by_the_option_is_right() {
    let backwards = change(rows(), |run| {
        for sample in &mut run.poses.samples {
            sample.pose.yaw += PI;
        }
    });
    let place = tempfile::tempdir().expect("a temporary folder");
    let source = Source::computed();
    let recording = Recording::new("log", "robot", backwards, source, Vec::new()).expect("usable");
    folder::write(&recording, place.path()).expect("written");
    assert!(folder::read(place.path()).is_err());
    let options = TableOptions { mount_yaw: Some(PI), ..TableOptions::default() };
    let turned = folder::read_by(place.path(), &options).expect("right");
    let truth = read(rows()).expect("right");
    let (found, expected) = (turned.runs()[1].poses(), truth.runs()[1].poses());
    for (found, expected) in found.iter().zip(expected) {
        let off = trackdyn_core::pose::wrap_angle(found.pose.yaw - expected.pose.yaw);
        assert!(off.abs() < 1e-9, "{off}");
    }
}

/// North, east, down: y points right, and yaw counts clockwise.
#[test]
fn poses_that_count_clockwise_are_named_and_read_by_the_option() {
    let mirrored = change(rows(), |run| {
        for sample in &mut run.poses.samples {
            sample.pose.y = -sample.pose.y;
            sample.pose.yaw = -sample.pose.yaw;
        }
    });
    let (doubt, text) = refused(mirrored.clone());
    assert_eq!(doubt, Doubt::Swapped);
    assert!(text.contains("--pose-axes ned"), "{text}");
    let place = tempfile::tempdir().expect("a temporary folder");
    let source = Source::computed();
    let recording = Recording::new("log", "robot", mirrored, source, Vec::new()).expect("usable");
    folder::write(&recording, place.path()).expect("written");
    let options = TableOptions { pose_axes: PoseAxes::NorthEastDown, ..TableOptions::default() };
    let read_so = folder::read_by(place.path(), &options).expect("right");
    let truth = read(rows()).expect("right");
    for (found, expected) in read_so.runs().iter().zip(truth.runs()) {
        for (found, expected) in found.poses().iter().zip(expected.poses()) {
            let off = expected.pose.relative(&found.pose);
            assert!(off.x.abs().max(off.y.abs()).max(off.yaw.abs()) < 1e-9, "{off:?}");
        }
    }
}

/// A folder with speeds in rpm of wheels of 0.2 m.
#[test]
fn a_folder_is_read_in_the_unit_of_the_option() {
    let place = tempfile::tempdir().expect("a temporary folder");
    let scale = 0.2 * 2.0 * PI / 60.0;
    let runs = change(rows(), |run| {
        for reading in &mut run.tracks.samples {
            (reading.v_left, reading.v_right) = (reading.v_left / scale, reading.v_right / scale);
        }
    });
    let recording = Recording::new("rpm", "robot", runs, Source::computed(), Vec::new());
    folder::write(&recording.expect("usable"), place.path()).expect("written");
    let options = TableOptions {
        speed_unit: Some(SpeedUnit::TurnsPerMinute),
        wheel_radius: Some(0.2),
        ..TableOptions::default()
    };
    let found = folder::read_by(place.path(), &options).expect("right");
    let truth = read(rows()).expect("right");
    for (found, expected) in found.runs()[0].tracks().iter().zip(truth.runs()[0].tracks()) {
        assert!((found.v_left - expected.v_left).abs() < 1e-9, "{found:?} {expected:?}");
    }
    let alone = TableOptions { wheel_radius: None, ..options };
    let text = folder::read_by(place.path(), &alone).expect_err("no radius").to_string();
    assert!(text.contains("expected --wheel-radius METRES"), "{text}");
}

/// Yaw rates of the poses as an IMU at 50 Hz tells them.
fn with_gyro(factor: f64) -> Vec<UncheckedRun> {
    change(rows(), |run| {
        let poses = run.poses.samples.clone();
        let rate = |k: usize| {
            let (first, last) = (&poses[k / 5], &poses[k / 5 + 1]);
            (last.pose.yaw - first.pose.yaw) / (last.t - first.t)
        };
        let reading = |k: usize| ImuSample {
            t: 0.02 * trackdyn_core::real(k),
            gyro_z: factor * rate(k),
            acc_x: 0.0,
            acc_y: 0.0,
        };
        run.imu = (0..5 * (poses.len() - 1)).map(reading).collect::<Vec<_>>().into();
    })
}

#[test]
fn a_gyroscope_in_degrees_is_left_out_and_told() {
    let recording = read(with_gyro(180.0 / PI)).expect("right without it");
    assert!(recording.runs().iter().all(|run| run.imu().is_empty()));
    let text = recording.warnings().iter().map(ToString::to_string).collect::<String>();
    assert!(text.contains("--gyro-unit deg/s"), "{text}");
    let recording = read(with_gyro(1.0)).expect("right");
    assert!(recording.runs().iter().all(|run| !run.imu().is_empty()));
}

#[test]
fn headings_in_degrees_are_refused() {
    let runs = change(rows(), |run| {
        for sample in &mut run.poses.samples {
            sample.pose = trackdyn_core::Pose::new(f64::NAN, f64::NAN, 3.0 * sample.pose.yaw);
        }
    });
    assert!(read(runs.clone()).is_ok(), "three times the yaw: ICRs close to each other");
    let runs = change(runs, |run| {
        let degrees = 180.0 / PI / 3.0;
        // poses come often enough that no step is half a turn in radians
        let dense = run.poses.samples.windows(2).flat_map(|pair| {
            (0..10).map(move |k| {
                let part = f64::from(k) / 10.0;
                let t = pair[0].t + part * (pair[1].t - pair[0].t);
                let yaw = pair[0].pose.yaw + part * (pair[1].pose.yaw - pair[0].pose.yaw);
                let pose = trackdyn_core::Pose::new(f64::NAN, f64::NAN, degrees * yaw);
                trackdyn_recording::PoseSample { t, pose }
            })
        });
        run.poses = dense.collect::<Vec<_>>().into();
    });
    let (doubt, text) = refused(runs);
    assert!(matches!(doubt, Doubt::TurnInDegrees { .. }), "{text}");
    assert!(text.contains("--gyro-unit deg/s"), "{text}");
}

/// A heading clockwise from north, in degrees as it was written and in radians as `:deg` makes it.
#[test]
fn headings_of_a_compass_are_named() {
    for (per_radian, wraps) in [(180.0 / PI, true), (180.0 / PI, false), (1.0, false)] {
        let runs = change(rows(), |run| {
            for sample in &mut run.poses.samples {
                let heading = per_radian * (0.5 * PI - sample.pose.yaw);
                sample.pose.yaw = if wraps { heading.rem_euclid(360.0) } else { heading };
            }
        });
        let (doubt, text) = refused(runs);
        assert_eq!(doubt, Doubt::YawOfCompass, "{per_radian}");
        assert!(text.contains("--columns yaw=COLUMN:compass"), "{text}");
    }
}

#[test]
fn speeds_that_jump_too_often_are_named() {
    let runs = change(rows(), |run| {
        for reading in run.tracks.samples.iter_mut().step_by(4) {
            reading.v_left = 30.0;
        }
    });
    let (doubt, text) = refused(runs);
    let Doubt::Jumps { share, largest } = doubt else { panic!("{text}") };
    assert!((share - 0.25).abs() < 0.01 && largest == 30.0, "{text}");
    assert!(text.contains("25 % of the track speeds jump"), "{text}");
}
