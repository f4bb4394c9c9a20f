//! `trackdyn inspect` and `trackdyn identify`.

use crate::{Workplace, auriga_alpha, vehicle};
use trackdyn_core::PerSide;
use trackdyn_estimate::synthetic::{Stretch, Synthetic, random_steps};
use trackdyn_recording::folder;

/// Writes a recording of Auriga-alpha's size into the folder `rec`.
fn record(place: &Workplace, schedules: Vec<Vec<Stretch>>) {
    write(place, "rec", &auriga_alpha(schedules));
}

/// Writes a recording into a folder of this name.
fn write(place: &Workplace, name: &str, synthetic: &Synthetic) {
    let recording = synthetic.recording().expect("long enough");
    folder::write(&recording, &place.path().join(name)).expect("written");
}

/// Speeds as they were told, and the poses of a simulator: nothing of their noise can be measured,
/// and all is determined.
#[test]
fn commands_and_poses_without_noise_do() {
    let place = Workplace::new();
    let synthetic = Synthetic {
        schedules: (0..4).map(|run| random_steps(15, 2.0, 0.8, run)).collect(),
        encoder_noise: 0.0,
        position_noise: 0.005,
        yaw_noise: 0.005,
        ..Synthetic::default()
    };
    write(&place, "told", &synthetic);
    let perfect = "simulate --schedule designed --runs 2 --duration 30 --cog -0.015,0.04 \
                   --sensors perfect --out perfect";
    assert_eq!(place.run(perfect).status, 0);
    for (name, close) in [("told", 5e-3), ("perfect", 1e-2)] {
        let run = place.run(&format!(
            "identify {name} --vehicle {} --generations 20 --out {name}.d",
            vehicle()
        ));
        assert_eq!(run.status, 0, "{name}: {}{}", run.stdout, run.stderr);
        let text = String::from_utf8(place.read(&format!("{name}.d/kinematics.toml")));
        let file: toml::Table = text.expect("text").parse().expect("TOML");
        let number = |key: &str| file[key].as_float().expect("a number");
        assert!((number("x_icr_left_m") + 0.375).abs() < close, "{name}: {file}");
        assert!((number("x_icr_right_m") - 0.457).abs() < close, "{name}: {file}");
    }
}

#[test]
fn parameters_come_out_of_a_recording() {
    let place = Workplace::new();
    record(&place, (0..4).map(|run| random_steps(10, 2.0, 0.8, run)).collect());
    let run = place.run(&format!("identify rec --vehicle {} --generations 60", vehicle()));
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
    for part in ["x_l", "95 % interval", "spin test", "alpha_l", "s late"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    let number = |key: &str| file[key].as_float().expect("a number");
    assert!((number("x_icr_left_m") + 0.375).abs() < 5e-3, "{text}");
    assert!((number("x_icr_right_m") - 0.457).abs() < 5e-3, "{text}");
    assert!((number("y_icr_m") - 0.0492).abs() < 5e-3, "{text}");
    assert_eq!(file["covariance"].as_array().map(Vec::len), Some(3));
    assert_eq!(file["source"]["recording"].as_str(), Some("synthetic"));
    assert_eq!(file["source"]["runs"].as_str(), Some("0-3"));

    // Every method, every number with its unit and interval.
    let text = String::from_utf8(place.read("out/identification.toml")).expect("text");
    let document: toml::Table = text.parse().expect("TOML");
    assert_eq!(document["schema"].as_str(), Some("trackdyn.identification/1"));
    assert_eq!(document["source"]["runs"].as_str(), Some("0-3"));
    let methods = document["method"].as_array().expect("methods");
    let names: Vec<_> = methods.iter().map(|method| method["method"].as_str()).collect();
    let pair = ["genetic", "least-squares"];
    assert_eq!(names, ["spin-test", pair[0], pair[1], pair[0], pair[1]].map(Some));
    for method in methods {
        assert_eq!(method["determined"].as_bool(), Some(true), "{text}");
        for estimate in method["estimate"].as_array().expect("estimates") {
            let of = |key: &str| estimate[key].as_float().expect("a number");
            assert!(["m", "1"].contains(&estimate["unit"].as_str().expect("a unit")));
            assert!(of("low95") < of("value") && of("value") < of("high95"), "{estimate}");
            // Student's quantile: above that of the normal distribution, below that of three
            // blocks.
            let half = (of("high95") - of("low95")) / 2.0 / of("standard_error");
            assert!((1.95..4.4).contains(&half), "{estimate}");
        }
    }
    let fitted = &methods[2]["estimate"][0];
    assert!((fitted["value"].as_float().expect("x_l") - number("x_icr_left_m")).abs() < 1e-9);
    assert_eq!(methods[2]["file"].as_str(), Some("kinematics.toml"));

    // The file is one that the other commands take.
    let used = place.run("kinematics --speeds 0.3,0.9 --kinematics out/kinematics_alpha.toml");
    assert_eq!(used.status, 0, "{}", used.stderr);
    assert!(used.stdout.contains("alpha"));

    // Another number of threads changes nothing.
    let first = (run.stdout, text);
    let again = place
        .run_with_threads(&format!("identify rec --vehicle {} --generations 60", vehicle()), 1);
    let text = String::from_utf8(place.read("out/identification.toml")).expect("text");
    assert!(first == (again.stdout, text), "results differ between 2 threads and 1");
}

#[test]
fn some_runs_or_a_time_can_be_chosen() {
    let place = Workplace::new();
    record(&place, (0..6).map(|run| random_steps(10, 2.0, 0.8, run)).collect());
    let identify = format!("identify rec --vehicle {} --generations 1", vehicle());
    for (options, runs, time) in [
        ("--runs 0-3", "0-3", None),
        ("--runs 5,1,2", "1-2,5", None),
        ("--time 0,15", "0-5", Some([0.0, 15.0])),
    ] {
        let run = place.run(&format!("{identify} {options}"));
        assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
        let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
        let file: toml::Table = text.parse().expect("TOML");
        assert_eq!(file["source"]["runs"].as_str(), Some(runs), "{text}");
        let chosen = file["source"].get("time_s").and_then(toml::Value::as_array);
        let chosen = chosen.map(|ends| [0, 1].map(|k| ends[k].as_float().expect("a number")));
        assert_eq!(chosen, time, "{text}");
    }
}

#[test]
fn clock_and_mount_of_the_sensor_are_fitted_or_refused() {
    let place = Workplace::new();
    record(&place, (0..4).map(|run| random_steps(10, 2.0, 0.8, run)).collect());
    let identify = format!("identify rec --vehicle {} --generations 1", vehicle());
    let run = place.run(&format!("{identify} --fit lever-arm,sensor-yaw,time-offset"));
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
    for part in ["tau ", "psi ", " rad", "not fitted: lever-arm", "measure the mount"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    let unknown = place.run(&format!("{identify} --fit tau"));
    assert_eq!(unknown.status, 1);
    assert!(
        unknown.stderr.contains("one of time-offset, sensor-yaw, lever-arm"),
        "{}",
        unknown.stderr
    );
}

#[test]
fn what_a_recording_does_not_determine_is_not_written() {
    let place = Workplace::new();
    let straight = |speed| vec![Stretch { duration: 40.0, speeds: PerSide::new(speed, speed) }];
    record(&place, vec![straight(0.5), straight(-0.5)]);
    assert_eq!(place.run(&format!("map --vehicle {} --grid 3 --out map", vehicle())).status, 0);
    let of_map = String::from_utf8(place.read("map/kinematics.toml")).expect("text");
    let of_fit = of_map.replace("[source]", "[source]\nrecording = \"earlier\"");
    std::fs::create_dir(place.path().join("out")).expect("made");
    for name in ["kinematics.toml", "kinematics_alpha.toml"] {
        place.write(&format!("out/{name}"), &of_fit);
    }
    let run = place.run(&format!("identify rec --vehicle {} --generations 2", vehicle()));
    assert_eq!(run.status, 2, "{}", run.stdout);
    for name in ["kinematics.toml", "kinematics_alpha.toml"] {
        assert!(run.stderr.contains(&format!("removed out/{name}")), "{}", run.stderr);
        assert!(!place.path().join(format!("out/{name}")).exists());
    }
    assert!(run.stdout.contains("no ICR shows"), "{}", run.stdout);
    assert!(run.stdout.contains("taken as equal"), "{}", run.stdout);
    let text = String::from_utf8(place.read("out/identification.toml")).expect("text");
    let document: toml::Table = text.parse().expect("TOML");
    for method in document["method"].as_array().expect("methods") {
        assert_eq!(method["determined"].as_bool(), Some(false), "{text}");
        assert!(!method["doubts"].as_array().expect("reasons").is_empty());
        assert!(method.get("file").is_none());
    }
}

/// Writes a recording whose poses have a yaw alone.
fn record_yaw_alone(place: &Workplace, schedules: Vec<Vec<Stretch>>) {
    record(place, schedules);
    let poses = String::from_utf8(place.read("rec/poses.csv")).expect("text");
    let bare = poses.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},,,{}\n", cells[0], cells[3])
    });
    place.write("rec/poses.csv", &("t,x,y,yaw\n".to_owned() + &bare.collect::<String>()));
}

/// What an earlier identification wrote does not stay beside the file of another recording.
#[test]
fn no_document_of_another_recording_stays() {
    let place = Workplace::new();
    record(&place, vec![random_steps(40, 2.0, 0.8, 1)]);
    let identify = format!("identify rec --vehicle {} --generations 1", vehicle());
    assert_eq!(place.run(&identify).status, 0);
    assert!(place.path().join("out/identification.toml").exists());
    record_yaw_alone(&place, vec![random_steps(40, 2.0, 0.8, 2)]);
    let run = place.run(&identify);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(place.path().join("out/kinematics.toml").exists());
    for name in ["identification.toml", "kinematics_alpha.toml"] {
        assert!(run.stderr.contains(&format!("removed out/{name}")), "{}", run.stderr);
        assert!(!place.path().join(format!("out/{name}")).exists());
    }
}

/// ICRs between the tracks are contradicted once, with all that makes track speeds.
#[test]
fn a_distance_that_no_friction_makes_is_told_once() {
    let place = Workplace::new();
    record_yaw_alone(&place, vec![random_steps(40, 2.0, 0.8, 1)]);
    let run = place.run("identify rec --gauge 1.3");
    assert_eq!(run.status, 2, "{}", run.stderr);
    let text = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(text.matches("friction cannot put them").count(), 1, "{}", run.stdout);
    assert!(text.contains("of a twist the --separation"), "{}", run.stdout);
    // why inspect says no is what contradicts, and not that yaw alone is known
    let run = place.run("inspect rec --gauge 1.3");
    assert!(run.stdout.contains("identify  no: chi = "), "{}", run.stdout);
}

/// A sound recording that turns too little is no bad input.
#[test]
fn a_recording_that_does_not_tell_gives_no_result() {
    let place = Workplace::new();
    let curve = |left, right| Stretch { duration: 10.0, speeds: PerSide::new(left, right) };
    record_yaw_alone(&place, vec![vec![curve(0.5, 0.55), curve(0.55, 0.5)]]);
    let run = place.run(&format!("identify rec --vehicle {}", vehicle()));
    assert_eq!(run.status, 2, "{}", run.stderr);
    assert!(run.stderr.contains("the distance of the ICRs cannot be estimated"), "{}", run.stderr);
}

#[test]
fn mistakes_are_named() {
    let place = Workplace::new();
    let vehicle = vehicle();
    std::fs::create_dir(place.path().join("empty")).expect("made");
    record(&place, vec![random_steps(10, 2.0, 0.8, 1)]);
    place.write("points.csv", "v_left,v_right,v_forward,v_lateral,yaw_rate\n0.1,0.2,0.15,0,0.1\n");
    for (arguments, part) in [
        (format!("identify missing --vehicle {vehicle}"), "missing"),
        (format!("identify empty --vehicle {vehicle}"), "recording.toml"),
        ("identify empty".to_owned(), "--vehicle"),
        (format!("identify empty --vehicle {vehicle} --tau late"), "a number of seconds"),
        (format!("identify empty --vehicle {vehicle} --population 0"), "--population"),
        (
            format!("identify rec --vehicle {vehicle} --runs 0,9"),
            "--runs: run 9 is not in the recording",
        ),
        (
            format!("identify rec --vehicle {vehicle} --time 30,40"),
            "--time: no run has track speeds",
        ),
        (format!("identify rec --vehicle {vehicle} --time 3,2"), "the beginning and the end in s"),
        (
            format!("identify points.csv --vehicle {vehicle} --tracks nowhere.csv"),
            "--tracks: points.csv holds steady points",
        ),
        (
            format!("identify points.csv --vehicle {vehicle} --mount-yaw 90 --tau 0"),
            "--mount-yaw, --tau: points.csv holds steady points",
        ),
        (
            format!("identify points.csv --vehicle {vehicle} --wheel-radius 0.1"),
            "speeds in m/s are those of the tracks already",
        ),
        ("inspect empty".to_owned(), "recording.toml"),
    ] {
        let run = place.run(&arguments);
        assert_eq!(run.status, 1, "{arguments}: {}", run.stdout);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
        assert!(!place.path().join("out").exists());
    }
}

/// Parameters that other parts of the answer contradict are not written, unless that is forced;
/// then they are marked, and whatever works with them says so.
#[test]
fn contradicted_parameters_are_written_only_by_force() {
    let place = Workplace::new();
    let run = place.run("simulate --quasi-static --runs 2 --duration 20 --out drive");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let vehicle = String::from_utf8(place.read("drive/vehicle.toml")).expect("text");
    let gauge = vehicle.lines().find(|line| line.starts_with("gauge_m")).expect("a key");
    place.write("wide.toml", &vehicle.replace(gauge, "gauge_m = 1.3"));
    let run = place.run("identify drive --vehicle wide.toml");
    assert_eq!(run.status, 2, "{}", run.stdout);
    assert!(run.stdout.contains("friction cannot put them"), "{}", run.stdout);
    assert!(!place.path().join("out/kinematics.toml").exists());
    let run = place.run("identify drive --vehicle wide.toml --force");
    assert_eq!(run.status, 0, "{}", run.stdout);
    let file = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    assert!(file.contains("doubtful = true"), "{file}");
    for command in [
        "odometry drive --vehicle wide.toml --kinematics out/kinematics.toml --out path",
        "export ros2 out/kinematics.toml --wheel-radius 0.1 --out ros",
    ] {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
        assert!(run.stderr.contains("kinematics.toml is doubtful"), "{}", run.stderr);
    }
}

/// What a gyroscope does to the yaw of the poses is said, and stands in the file.
#[test]
fn a_gyroscope_corrects_poses_where_it_is_asked() {
    let place = Workplace::new();
    let made = place.run("simulate --runs 2 --duration 30 --seed 4 --out drive");
    assert_eq!(made.status, 0, "{}", made.stderr);
    let vehicle = "--vehicle drive/vehicle.toml --generations 5";
    let with = place.run(&format!("identify drive {vehicle} --gyroscope --out with"));
    assert_eq!(with.status, 0, "{}", with.stderr);
    assert!(with.stdout.contains("  gyroscope  a turn within 1 s is known to "), "{}", with.stdout);
    assert!(with.stdout.contains("standard error of x_r - x_l "), "{}", with.stdout);
    let text = std::fs::read_to_string(place.path().join("with/identification.toml"));
    let text = text.expect("written");
    assert!(text.contains("[gyroscope]\nused = true\n"), "{text}");
    let without = place.run(&format!("identify drive {vehicle} --out without"));
    assert!(!without.stdout.contains("gyroscope"), "{}", without.stdout);
}
