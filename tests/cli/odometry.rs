//! `trackdyn odometry`.

use crate::{Run, Workplace, project_text};
use trackdyn_core::PerSide;
use trackdyn_estimate::synthetic::{ConstantIcr, Stretch, Synthetic, random_steps};
use trackdyn_recording::folder;

/// Four runs of a robot whose ICRs and alphas are known.
fn synthetic() -> Synthetic {
    Synthetic {
        kinematics: ConstantIcr {
            x_left: -0.4,
            x_right: 0.45,
            y: 0.05,
            alpha: PerSide::new(0.97, 0.99),
        },
        schedules: (0..4).map(|seed| random_steps(10, 4.0, 1.0, seed)).collect(),
        position_noise: 0.003,
        yaw_noise: 0.002,
        tau: 0.15,
        seed: 3,
        ..Synthetic::default()
    }
}

/// A workplace with that recording, the vehicle, and files with true and with other parameters.
fn workplace(synthetic: &Synthetic) -> Workplace {
    let place = Workplace::new();
    let recording = synthetic.recording().expect("a recording");
    folder::write(&recording, &place.path().join("recording")).expect("written");
    place.write("robot.toml", &project_text("configs/vehicles/auriga-alpha.toml"));
    let file = |x_right: f64, alphas: &str| {
        format!(
            "schema = \"trackdyn.kinematics/1\"\nframe = \"paper\"\nx_icr_left_m = -0.4\n\
             x_icr_right_m = {x_right}\ny_icr_m = 0.05\nsteering_efficiency = 0.5\n\
             eccentricity = 0.0\n{alphas}[source]\ncommand = \"\"\nversion = \"\"\n\
             vehicle = \"\"\nfingerprint = \"\"\n"
        )
    };
    place.write("fit.toml", &file(0.45, "alpha_left = 0.97\nalpha_right = 0.99\n"));
    place.write("other.toml", &file(0.5, ""));
    place
}

const COMMAND: &str = "odometry recording --vehicle robot.toml --kinematics fit.toml \
                       --kinematics other.toml";

fn document(place: &Workplace) -> toml::Table {
    String::from_utf8(place.read("out/odometry.toml")).expect("text").parse().expect("TOML")
}

/// Rms of a component over segments of the set at a place in the file.
fn rms(document: &toml::Table, set: usize, component: &str) -> f64 {
    document["span"][0]["set"][set][component]["rms"]["value"].as_float().expect("a number")
}

#[test]
fn true_parameters_win_by_all_that_is_not_noise() {
    let place = workplace(&synthetic());
    let run = place.run(COMMAND);
    assert_eq!(run.status, 0, "{}", run.stderr);
    for part in ["4 of 4 runs, 159 s", "clock offset 0.15", "gauge 0.42 m", "fit-no-alpha"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    assert!(run.stdout.lines().count() <= 30, "{}", run.stdout);
    let files = place.files();
    let trajectories = files.iter().filter(|file| file.starts_with("out/trajectories")).count();
    // Recorded, ideal, fit, fit without alpha, other, physics.
    assert_eq!(trajectories, 4 * 6);
    for name in ["out/odometry.png", "out/odometry.toml", "out/runs.csv"] {
        assert!(files.iter().any(|file| file.as_os_str() == name), "{name}");
    }

    let document = document(&place);
    assert_eq!(document["schema"].as_str(), Some("trackdyn.odometry/1"));
    assert_eq!(document["clock"]["origin"].as_str(), Some("estimated"));
    let names: Vec<_> =
        document["set"].as_array().expect("sets").iter().map(|set| set["name"].as_str()).collect();
    assert_eq!(names, ["ideal", "fit", "fit-no-alpha", "other", "physics"].map(Some));
    // Two poses each with 0.002 rad and 0.003 m; 10 %: 480 segments, and the clock offset.
    for (component, noise) in [("yaw_rad", 0.002), ("along_m", 0.003), ("across_m", 0.003)] {
        let ratio = rms(&document, 1, component) / (noise * 2.0_f64.sqrt());
        assert!((ratio - 1.0).abs() < 0.1, "{component}: {ratio}");
        for set in [0, 2, 3, 4] {
            assert!(rms(&document, set, component) > rms(&document, 1, component), "{component}");
        }
    }
}

/// Errors of parameters that are far off are wide, and still stand apart.
#[test]
fn columns_do_not_run_together() {
    let place = workplace(&synthetic());
    let file = String::from_utf8(place.read("other.toml")).expect("text");
    place.write("near.toml", &file.replace("x_icr_right_m = 0.5", "x_icr_right_m = -0.3995"));
    let run = place.run("odometry recording --gauge 0.42 --kinematics near.toml");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let rows: Vec<&str> = run.stdout.lines().filter(|line| line.starts_with("  near")).collect();
    assert!(rows.len() >= 2, "{}", run.stdout);
    for row in rows {
        let mut cells = row.split_whitespace().skip(1);
        assert!(cells.all(|cell| cell == "±" || cell.parse::<f64>().is_ok()), "{row}");
    }
}

#[test]
fn trajectories_start_together_and_have_one_line_per_pose() {
    let place = workplace(&synthetic());
    assert_eq!(place.run(COMMAND).status, 0);
    let lines = |name: &str| -> Vec<String> {
        let text = String::from_utf8(place.read(&format!("out/trajectories/{name}-run2.tum")));
        text.expect("text").lines().map(str::to_owned).collect()
    };
    let (recorded, fit) = (lines("recorded"), lines("fit"));
    assert_eq!(recorded.len(), fit.len());
    assert_eq!(recorded[1], fit[1]);
    assert!(fit[1..].iter().all(|line| line.split(' ').count() == 8));
}

#[test]
fn runs_and_clock_offset_can_be_chosen() {
    let place = workplace(&synthetic());
    let run = place.run(&format!("{COMMAND} --runs 1,3 --tau 0.15"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("2 of 4 runs") && run.stdout.contains("0.150 s (given)"));
    let document = document(&place);
    let runs: Vec<_> =
        document["runs"].as_array().expect("runs").iter().map(toml::Value::as_integer).collect();
    assert_eq!(runs, [Some(1), Some(3)]);
}

/// Replays the fitted kinematics, and reads what comes of it.
fn replayed(place: &Workplace, options: &str) -> (Run, toml::Table) {
    let replay = "odometry recording --vehicle robot.toml --kinematics out/kinematics.toml";
    let run = place.run(&format!("{replay} {options}"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    (run, document(place))
}

/// The last lines say what to take, with the numbers that decide it.
#[test]
fn what_to_take_is_said_at_the_end() {
    let place = workplace(&synthetic());
    let run = place.run(COMMAND);
    let (_, end) = run.stdout.split_once("\ntake  fit.toml\n").expect("an advice");
    assert_eq!(end.lines().count(), 3, "{end}");
    assert!(end.contains("as shares of ideal's: place") && end.contains("as shares of other's"));
    assert_eq!(document(&place)["advice"]["take"].as_str(), Some("fit.toml"));
    for (options, part) in [
        (
            "--gauge 0.42",
            "the ideal drive was replayed alone: give parameter files by --kinematics",
        ),
        (
            "--vehicle robot.toml --kinematics out/kinematics.toml",
            "kinematics: fitted to this driving",
        ),
    ] {
        let fit = "identify recording --vehicle robot.toml --generations 1";
        assert_eq!(place.run(fit).status, 0);
        let run = place.run(&format!("odometry recording {options}"));
        let (_, end) = run.stdout.split_once("\ntake  not decided: ").expect("an advice");
        assert!(end.starts_with(part), "{options}: {end}");
    }
}

/// Poses that are computed from the tracks judge nothing: all that replays or diagnoses them gives
/// no result, as `identify` and `inspect` say, and writes nothing.
#[test]
fn wheel_odometry_judges_no_parameters() {
    let alpha = PerSide::new(1.0, 1.0);
    let kinematics = ConstantIcr { x_left: -0.21, x_right: 0.21, y: 0.0, alpha };
    let schedules = vec![random_steps(60, 2.0, 0.8, 1)];
    let place = workplace(&Synthetic { kinematics, schedules, ..Synthetic::default() });
    let before = place.files();
    for command in [COMMAND, "diagnose recording --vehicle robot.toml --out diagnosis"] {
        let run = place.run(command);
        assert_eq!(run.status, 2, "{command}: {}", run.stderr);
        assert!(run.stderr.contains("these poses are wheel odometry"), "{}", run.stderr);
        assert_eq!(place.files(), before, "{command}");
    }
    let run = place.run("inspect recording --vehicle robot.toml");
    for command in ["odometry", "diagnose"] {
        let no = format!("  {command:10}no: these poses are wheel odometry");
        assert!(run.stdout.contains(&no), "{}", run.stdout);
    }
}

#[test]
fn parameters_of_the_same_runs_are_not_held_out() {
    let place = workplace(&synthetic());
    let fit = place.run("identify recording --vehicle robot.toml --generations 1 --runs 0-1");
    assert_eq!(fit.status, 0, "{}", fit.stderr);
    for (options, held_out) in [("--runs 2-3", true), ("--runs 1-3", false), ("", false)] {
        let (run, document) = replayed(&place, options);
        assert_eq!(document["set"][1]["held_out"].as_bool(), Some(held_out), "{options}");
        assert_eq!(run.stderr.contains("fitted to some of these runs"), !held_out);
    }
}

/// Another circumference of the wheels makes no other drive of it.
#[test]
fn the_same_drive_read_otherwise_is_not_held_out() {
    let place = workplace(&synthetic());
    let fit = place.run("identify recording --vehicle robot.toml --generations 1");
    assert_eq!(fit.status, 0, "{}", fit.stderr);
    let tracks = String::from_utf8(place.read("recording/tracks.csv")).expect("text");
    let faster = |line: &str| match line.rsplit_once(',') {
        Some((rest, last)) => match last.parse::<f64>() {
            Ok(speed) => format!("{rest},{}\n", 1.01 * speed),
            Err(_) => format!("{line}\n"),
        },
        None => panic!("{line}"),
    };
    let other: String = tracks.lines().map(faster).collect();
    place.write("recording/tracks.csv", &other);
    let (_, document) = replayed(&place, "");
    assert_eq!(document["set"][1]["held_out"].as_bool(), Some(false));
}

#[test]
fn another_time_of_the_same_runs_is_held_out() {
    let place = workplace(&synthetic());
    let fit = "identify recording --vehicle robot.toml --generations 1 --time 0,20";
    assert_eq!(place.run(fit).status, 0);
    for (time, held_out) in [("20,40", true), ("10,40", false)] {
        let (_, document) = replayed(&place, &format!("--time {time}"));
        assert_eq!(document["set"][1]["held_out"].as_bool(), Some(held_out), "{time}");
        assert!(document["source"]["time_s"].is_array());
    }
}

#[test]
fn residuals_become_covariances_of_a_controller() {
    let place = workplace(&synthetic());
    let identify = "identify recording --vehicle robot.toml --generations 1 --runs 0-1";
    assert_eq!(place.run(identify).status, 0);
    let replay = "odometry recording --vehicle robot.toml --kinematics out/kinematics_alpha.toml";
    let export = "export ros2 out/kinematics_alpha.toml --wheel-radius 0.1 --residuals";
    assert_eq!(place.run(&format!("{replay} --runs 2-3 --out replay")).status, 0);
    let run = place.run(&format!("{export} replay/odometry.toml"));
    assert_eq!((run.status, run.stderr.contains("warning")), (0, false), "{}", run.stderr);
    let text = String::from_utf8(place.read("out/diff_drive_controller.yaml")).expect("text");
    let yaml: serde_yaml_ng::Value = serde_yaml_ng::from_str(&text).expect("YAML");
    let twist = &yaml["diff_drive_controller"]["ros__parameters"]["twist_covariance_diagonal"];
    // Poses with 0.002 rad of noise, two to a piece of 1 s, at 50 Hz. 40 % in the variance:
    // 78 pieces, and the fit.
    let yaw = twist[5].as_f64().expect("six numbers");
    assert!((yaw / (2.0 * 0.002_f64.powi(2) * 50.0) - 1.0).abs() < 0.4, "{yaw}");
    assert!(text.contains("not fitted to"), "{text}");

    assert_eq!(place.run(&format!("{replay} --out same")).status, 0);
    let run = place.run(&format!("{export} same/odometry.toml"));
    assert!(run.status == 0 && run.stderr.contains("too small"), "{}", run.stderr);

    for (arguments, part) in [
        (
            "export ros2 fit.toml --wheel-radius 0.1 --residuals replay/odometry.toml",
            "--residuals = replay/",
        ),
        ("export ros2 fit.toml --wheel-radius 0.1 --residuals robot.toml", "robot.toml:"),
        ("export ros2 fit.toml --wheel-radius 0.1 --publish-rate 20", "--residuals"),
    ] {
        let run = place.run(&format!("{arguments} --out new"));
        assert_eq!(run.status, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
        assert!(!place.path().join("new").exists(), "{arguments}");
    }
}

#[test]
fn a_clock_offset_that_cannot_be_estimated_is_zero_and_said() {
    let straight = vec![vec![Stretch { duration: 20.0, speeds: PerSide::new(0.5, 0.5) }]];
    let place = workplace(&Synthetic { schedules: straight, ..Synthetic::default() });
    let run = place.run(COMMAND);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stderr.contains("the clock offset is taken as 0"), "{}", run.stderr);
    assert!(run.stdout.contains("0.000 s (not estimable)"), "{}", run.stdout);
}

#[test]
fn same_bytes_on_any_number_of_threads() {
    let place = workplace(&synthetic());
    let all = |threads| {
        let run = place.run_with_threads(COMMAND, threads);
        let files = place.files().into_iter();
        let contents: Vec<_> = files.map(|file| place.read(&file.to_string_lossy())).collect();
        (run.stdout, contents)
    };
    assert!(all(1) == all(3), "output differs between 1 and 3 threads");
}

#[test]
fn mistakes_are_named_and_nothing_is_written() {
    let place = workplace(&synthetic());
    std::fs::create_dir(place.path().join("empty")).expect("created");
    let fit = String::from_utf8(place.read("fit.toml")).expect("text");
    place.write("nan.toml", &fit.replace("alpha_left = 0.97", "alpha_left = nan"));
    let before = place.files();
    for (arguments, part) in [
        ("odometry recording", "--vehicle"),
        ("odometry missing --vehicle robot.toml", "missing: cannot be read"),
        ("odometry empty --vehicle robot.toml", "neither recording.toml nor"),
        ("odometry recording --vehicle missing.toml", "missing.toml: cannot be read"),
        (
            "odometry recording --vehicle robot.toml --kinematics robot.toml",
            "schema = \"trackdyn.vehicle/1\": expected \"trackdyn.kinematics/1\"",
        ),
        (
            "odometry recording --vehicle robot.toml --kinematics nan.toml",
            "nan.toml:8: alpha_left = nan: expected a positive number",
        ),
        (
            "odometry recording --vehicle robot.toml --runs 1,7",
            "--runs: run 7 is not in the recording: expected one of 0, 1, 2, 3",
        ),
        ("odometry recording --vehicle robot.toml --runs 1,x", "numbers of runs"),
        ("odometry recording --vehicle robot.toml --tau soon", "a number of seconds"),
        ("odometry recording --vehicle robot.toml --tau 900", "lie within the time of its track"),
        ("odometry recording --vehicle robot.toml --out robot.toml/out", "cannot be written"),
    ] {
        let run = place.run(arguments);
        assert_eq!(run.status, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
        assert!(run.stdout.is_empty() && run.stderr.lines().count() <= 20, "{}", run.stderr);
    }
    assert_eq!(place.files(), before);
}

#[test]
fn recordings_without_poses_or_motion_are_refused() {
    let standing = vec![vec![Stretch { duration: 5.0, speeds: PerSide::new(0.0, 0.0) }]];
    let place = workplace(&Synthetic { schedules: standing, ..Synthetic::default() });
    let run = place.run(COMMAND);
    assert_eq!(run.status, 1, "{}", run.stdout);
    assert!(run.stderr.contains("recording: the tracks never move"), "{}", run.stderr);
    place.write("recording/poses.csv", "t,x,y,yaw\n");
    let run = place.run(COMMAND);
    assert_eq!(run.status, 1, "{}", run.stdout);
    assert!(!place.path().join("out").exists());
}

/// The files for viewers, and what becomes of them.
#[test]
fn layers_are_written_where_they_are_asked_for() {
    let place = workplace(&synthetic());
    let names = ["odometry.mcap", "odometry.foxglove.json", "odometry.plotjuggler.xml"];
    let are_there = |folder: &str| {
        names
            .map(|name| place.path().join(folder).join(name))
            .iter()
            .filter(|of| of.exists())
            .count()
    };
    let run = place.run(&format!("{COMMAND} --mcap"));
    assert_eq!((run.status, are_there("out")), (0, 3), "{}", run.stderr);
    for name in names {
        assert!(run.stderr.contains(&format!("wrote out/{name}")), "{}", run.stderr);
    }
    // what an earlier run wrote would be taken for this one's
    let run = place.run(COMMAND);
    assert_eq!((run.status, are_there("out")), (0, 0), "{}", run.stderr);
    assert!(run.stderr.contains("removed out/odometry.mcap, of an earlier run"), "{}", run.stderr);
    let options = COMMAND.strip_prefix("odometry").expect("the command");
    let export = format!("export mcap {options} --out viewers");
    let run = place.run(&export);
    assert_eq!((run.status, run.stdout.as_str(), are_there("viewers")), (0, "", 3));
    assert_eq!(std::fs::read_dir(place.path().join("viewers")).expect("a folder").count(), 3);
    let file = place.read("viewers/odometry.mcap");
    assert_eq!(place.run(&export).status, 0);
    assert!(place.read("viewers/odometry.mcap") == file, "no time stands in it");
}

#[test]
fn layers_that_cannot_be_written_are_named() {
    let place = workplace(&synthetic());
    std::fs::create_dir_all(place.path().join("out/odometry.mcap")).expect("a folder");
    let run = place.run("export mcap recording --gauge 0.42");
    assert_eq!(run.status, 1);
    assert!(run.stderr.contains("error: out/odometry.mcap: cannot be written"), "{}", run.stderr);
    let left = place.files().into_iter().filter(|file| file.starts_with("out"));
    assert_eq!(left.count(), 0);
    let run = place.run("export mcap recording");
    assert_eq!(run.status, 1);
    assert!(run.stderr.contains("--gauge"), "{}", run.stderr);
}
