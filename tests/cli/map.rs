//! `trackdyn map` and `trackdyn kinematics`.

use crate::Workplace;

#[test]
fn the_main_job() {
    let place = Workplace::new();
    let run = place.run("map --cog -0.015,0.04");
    assert_eq!(run.status, 0, "{}", run.stderr);
    for part in ["-0.37538 m", "0.45735 m", "0.04923 m", "0.50437", "0.09844", "420 turn"] {
        assert!(run.stdout.contains(part), "{part} is not in:\n{}", run.stdout);
    }
    let files = place.files();
    assert_eq!(files, ["out/icr_map.png", "out/kinematics.toml"].map(std::path::PathBuf::from));

    let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    assert_eq!(file["schema"].as_str(), Some("trackdyn.kinematics/1"));
    assert_eq!(file["frame"].as_str(), Some("paper"));
    assert!((file["eccentricity"].as_float().expect("a number") - 0.09844).abs() < 5e-6);
    assert_eq!(file["source"]["command"].as_str(), Some("trackdyn map --cog -0.015,0.04"));
    assert!(!file.contains_key("sector"), "the base map is not piecewise");

    // What was written is read: the same motion from the file as from the vehicle.
    let ours = place.run("kinematics --speeds 0.3,0.9 --kinematics out/kinematics.toml");
    let direct = place.run("kinematics --speeds 0.3,0.9 --cog -0.015,0.04");
    assert_eq!((ours.status, &ours.stdout), (0, &direct.stdout));
    assert!(ours.stdout.contains("w 0.72053 rad/s"), "{}", ours.stdout);
}

#[test]
fn motion_resistance_makes_sectors() {
    let place = Workplace::new();
    let run = place.run("map --effect motion-resistance:coefficient=0.05 --grid 9");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("The map is piecewise"), "{}", run.stdout);
    let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    // Eight open sectors, two spins, four with one track stopped.
    assert_eq!(file["sector"].as_array().map(Vec::len), Some(14));
    // Inverse kinematics picks the sector that its own result lies in.
    let there = place.run("kinematics --speeds 0.2,0.9 --kinematics out/kinematics.toml");
    let twist = there.stdout.lines().find(|line| line.contains("ROS")).expect("a motion");
    let numbers: Vec<&str> = twist.split_whitespace().collect();
    let back = place.run(&format!(
        "kinematics --twist {},{} --kinematics out/kinematics.toml",
        numbers[3],
        numbers[numbers.len() - 2]
    ));
    assert!(back.stdout.contains("left 0.2000") && back.stdout.contains("right 0.9000"));
}

#[test]
fn effects_come_from_file_and_command_line() {
    let place = Workplace::new();
    let vehicle = crate::project_text("configs/vehicles/auriga-alpha.toml");
    place.write("fast.toml", &format!("{vehicle}\n[effect.centripetal]\n"));
    let from_file = place.run("map --vehicle fast.toml --grid 7 --out a");
    let from_option = place.run("map --effect centripetal --grid 7 --out b");
    assert_eq!((from_file.status, &from_file.stdout), (0, &from_option.stdout));
    assert_eq!(place.read("a/icr_map.png"), place.read("b/icr_map.png"));
    assert!(from_file.stdout.contains("centripetal:strength=1"));
}

#[test]
fn same_bytes_on_any_number_of_threads() {
    let place = Workplace::new();
    let arguments = "map --effect centripetal --effect load-transfer:cog_height_m=0.05 --grid 15";
    let once = place.run_with_threads(arguments, 1);
    let files = || ["out/kinematics.toml", "out/icr_map.png"].map(|name| place.read(name));
    let first = files();
    let again = place.run_with_threads(arguments, 3);
    assert_eq!(once.stdout, again.stdout);
    assert!(first == files(), "files differ between 1 and 3 threads");
}

#[test]
fn robot_that_never_turns_gets_its_picture_and_status_2() {
    let place = Workplace::new();
    // parameters of an earlier map would stand beside the picture of this one
    assert_eq!(place.run("map --grid 3").status, 0);
    let run = place.run("map --cog 0.2,0 --grid 5");
    assert_eq!(run.status, 2, "{}", run.stdout);
    assert!(run.stderr.contains("removed out/kinematics.toml"), "{}", run.stderr);
    assert!(run.stdout.contains("20 are held straight by one track"), "{}", run.stdout);
    assert_eq!(place.files(), [std::path::PathBuf::from("out/icr_map.png")]);
}

#[test]
fn speeds_of_any_size_are_readable() {
    let place = Workplace::new();
    let run = place.run("kinematics --speeds 1e300,-2e300");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("left 1.00000e300  right -2.00000e300 m/s"), "{}", run.stdout);
    assert!(run.stdout.lines().all(|line| line.len() < 100), "{}", run.stdout);
}

#[test]
fn factors_of_the_encoders_are_parameters_and_not_icrs() {
    let place = Workplace::new();
    let run = place.run("map --cog -0.015,0.04 --effect encoder-scale:left=0.98,right=1.02");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = String::from_utf8(place.read("out/kinematics.toml")).expect("text");
    let file: toml::Table = text.parse().expect("TOML");
    let number = |key: &str| file[key].as_float().expect("a number");
    assert!((number("x_icr_left_m") + 0.37538).abs() < 5e-6, "{text}");
    assert_eq!((number("alpha_left"), number("alpha_right")), (0.98, 1.02));
}

#[test]
fn few_pairs_of_speeds_make_no_sectors() {
    let place = Workplace::new();
    for grid in [2, 3, 4, 5] {
        let run = place.run(&format!("map --effect centripetal --grid {grid}"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        assert!(!run.stdout.contains("piecewise"), "{grid}: {}", run.stdout);
    }
}

/// What a pose sensor makes of the motion is no part of the hull's ICRs, and a reader of them is
/// told so.
#[test]
fn what_steady_icrs_leave_out_is_said() {
    let place = Workplace::new();
    let note = |effect: &str| {
        let run = place.run(&format!("map --effect {effect} --grid 5"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        run.stderr.contains(&format!("note: {effect} does not change the steady motion"))
    };
    assert!(note("sensor-lever-arm") && note("time-offset") && note("drivetrain-lag"));
    assert!(!note("centripetal") && !note("slope") && !note("encoder-scale"));
    let run = place.run("kinematics --speeds 0.3,0.9 --effect friction-creep");
    assert!(run.stderr.contains("go with the speeds"), "{}", run.stderr);
    let piecewise = place.run("kinematics --speeds 0.3,0.9 --effect motion-resistance");
    assert!(!piecewise.stderr.contains("go with the speeds"), "{}", piecewise.stderr);
}
