//! `trackdyn diagnose`: small recoveries, what it must not say, and what it refuses.

use crate::{Run, Workplace};

pub const VEHICLE: &str = "drive/auriga.toml";

/// A drive of Auriga-alpha with what is concealed from its owner, and the vehicle file that the
/// owner has.
pub fn drive(place: &Workplace, concealed: &str) {
    let run = place.run(&format!("simulate --quasi-static {concealed} --out drive"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let run = place.run("simulate --quasi-static --runs 1 --duration 2 --out owner");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let vehicle = String::from_utf8(place.read("owner/vehicle.toml")).expect("text");
    place.write(VEHICLE, &vehicle);
}

pub fn diagnosed(place: &Workplace, more: &str) -> (Run, toml::Table) {
    let run = place.run(&format!("diagnose drive --vehicle {VEHICLE} --out found {more}"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = String::from_utf8(place.read("found/diagnosis.toml")).expect("text");
    let file = text.parse().expect("TOML");
    (run, file)
}

/// What is named: the members of each entry, clock offset aside, which every simulated sensor has.
fn named(file: &toml::Table) -> Vec<Vec<String>> {
    let Some(missing) = file.get("missing") else { return Vec::new() };
    let members = missing.as_array().expect("tables").iter().map(|one| {
        let ids = one["one_of"].as_array().expect("ids").iter();
        ids.map(|id| id.as_str().expect("an id").to_owned()).collect::<Vec<_>>()
    });
    members.filter(|ids| ids != &["time-offset"]).collect()
}

fn value(file: &toml::Table, effect: &str, parameter: &str) -> f64 {
    sized(file, effect, parameter)[1]
}

/// A size between the ends of its interval.
fn sized(file: &toml::Table, effect: &str, parameter: &str) -> [f64; 3] {
    let missing = file["missing"].as_array().expect("tables");
    let one = missing.iter().find(|one| one["effect"].as_str() == Some(effect)).expect("named");
    let parameters = one["parameters"].as_array().expect("tables");
    let of = parameters.iter().find(|one| one["name"].as_str() == Some(parameter)).expect("there");
    ["low95", "value", "high95"].map(|key| of[key].as_float().expect("a number"))
}

#[test]
fn centripetal_force_of_the_independent_ground_is_named_and_sized() {
    let place = Workplace::new();
    drive(&place, "--ground independent --effect centripetal");
    let (run, file) = diagnosed(&place, "");
    assert_eq!(named(&file), [["centripetal"]], "{}", run.stdout);
    assert!(file.get("proposed").is_none(), "{file}");
    // Two simulators agree on it to a few percent.
    assert!((value(&file, "centripetal", "strength") - 1.0).abs() < 0.1, "{file}");
    let broken = file["located"]["broken"].as_array().expect("letters");
    assert!(broken.iter().any(|letter| letter.as_str() == Some("S")), "{file}");
    let fit = |key: &str| file["fit"][key].as_float().expect("a number");
    assert!(fit("held_out_after") < fit("held_out_before"));
    assert!(fit("excess_explained") > 0.9, "{file}");
    the_corrected_vehicle_runs_where_vehicles_run(&place);
}

fn the_corrected_vehicle_runs_where_vehicles_run(place: &Workplace) {
    let run = |command: &str| {
        let run = place.run(&format!("{command} --vehicle found/vehicle.corrected.toml"));
        assert_eq!(run.status, 0, "{command}: {}", run.stderr);
        run
    };
    run("map --grid 5 --out map");
    run("simulate --run-count 1 --duration 5 --out again");
    let driven = run("drive --forces --out driven");
    assert!(driven.stdout.contains("forces on Auriga-alpha"), "{}", driven.stdout);
    run("export table --out table");
    run("plan --diagnosis found/diagnosis.toml --out plan");
    // Dead reckoning by its forces, on runs that it was fitted to and on others.
    let physics = |command: &str, is_held_out: bool| {
        let run = run(command);
        let text = String::from_utf8(place.read("replay/odometry.toml")).expect("text");
        let file: toml::Table = text.parse().expect("TOML");
        let sets = file["set"].as_array().expect("sets");
        let [ideal, physics] = &sets[..] else { panic!("{sets:?}") };
        assert_eq!(physics["name"].as_str(), Some("physics"));
        assert_eq!(physics["held_out"].as_bool(), Some(is_held_out), "{}", run.stderr);
        assert!(physics.get("x_icr_left_m").is_none(), "forces have no constant ICRs");
        let end = |set: &toml::Value| set["end_position_rms_m"].as_float().expect("a number");
        assert!(end(physics) < 0.05 * end(ideal), "{} of {} m", end(physics), end(ideal));
        run
    };
    let run = physics("odometry drive --out replay", false);
    assert!(run.stderr.contains("was corrected by some of these runs"), "{}", run.stderr);
    assert!(run.stdout.contains("take  not decided"), "{}", run.stdout);
    let run = physics("odometry drive --runs 3,7 --out replay", true);
    assert!(run.stdout.contains("take  the forces on Auriga-alpha"), "{}", run.stdout);
}

#[test]
fn exact_twins_are_not_split() {
    let place = Workplace::new();
    drive(&place, "--effect friction-split:split=0.05");
    let (run, file) = diagnosed(&place, "");
    let named = named(&file);
    assert_eq!(named.len(), 1, "{}", run.stdout);
    for member in ["friction-split", "cog-shift"] {
        assert!(named[0].iter().any(|id| id == member), "{member}: {}", run.stdout);
    }
    assert_eq!(file["status"].as_str(), Some("ambiguous"));
    assert!(run.stdout.contains("weigh each track"), "{}", run.stdout);

    // Weighed to a millimetre, the centre of gravity cannot be a centimetre aside.
    let vehicle = String::from_utf8(place.read(VEHICLE)).expect("text");
    let cog = vehicle.lines().find(|line| line.starts_with("cog_m")).expect("a key");
    place.write(VEHICLE, &vehicle.replace(cog, &format!("{cog}\ncog_m_sd = [0.001, 0.001]")));
    let (run, file) = diagnosed(&place, "");
    let named = self::named(&file);
    assert!(named[0].iter().any(|id| id == "friction-split"), "{}", run.stdout);
    assert!(!named[0].iter().any(|id| id == "cog-shift"), "{}", run.stdout);
}

#[test]
fn straight_driving_is_refused_with_what_is_missing() {
    let place = Workplace::new();
    let rows: Vec<String> = (0..40)
        .map(|k| {
            let v = if k % 2 == 0 { 0.5 } else { -0.4 };
            format!("{},{v},{v}\n", 3 * k)
        })
        .collect();
    place.write("straight.csv", &format!("t,v_left,v_right\n{}", rows.concat()));
    drive(&place, "--schedule straight.csv");
    let run = place.run(&format!("diagnose drive --vehicle {VEHICLE} --out found"));
    assert_eq!(run.status, 1, "{}", run.stdout);
    assert!(run.stderr.contains("hardly turns"), "{}", run.stderr);
}

/// A part of a recording is chosen as for the other commands, and stands in the file.
#[test]
fn a_part_of_a_recording_can_be_diagnosed() {
    let place = Workplace::new();
    drive(&place, "--run-count 3 --duration 20 --effect motion-resistance");
    let (_, file) = diagnosed(&place, "--draws 1000 --runs 0,2 --time 0,15");
    assert_eq!(file["source"]["runs"].as_str(), Some("0,2"), "{file}");
    let time = file["source"]["time_s"].as_array().expect("two numbers");
    assert_eq!(time.iter().map(toml::Value::as_float).collect::<Vec<_>>(), [Some(0.0), Some(15.0)]);
    // what was measured of the noise stands there for a plan
    let noise = file["noise"]["pose_forward_m"].as_float().expect("a number");
    assert!((1e-4..0.01).contains(&noise), "{file}");
}

#[test]
fn the_order_of_runs_and_the_number_of_threads_change_nothing() {
    let place = Workplace::new();
    drive(&place, "--runs 4 --duration 10 --effect motion-resistance");
    let (_, forwards) = diagnosed(&place, "--held-out none");
    let text = place.read("found/diagnosis.toml");
    let arguments = format!("diagnose drive --vehicle {VEHICLE} --out found --held-out none");
    let run = place.run_with_threads(&arguments, 1);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert_eq!(place.read("found/diagnosis.toml"), text);

    // The runs numbered the other way round.
    for file in ["tracks.csv", "poses.csv"] {
        let path = format!("drive/{file}");
        let text = String::from_utf8(place.read(&path)).expect("text");
        let mut lines = text.lines();
        let head = lines.next().expect("a header").to_owned();
        let column = head.split(',').position(|name| name == "run").expect("a column");
        let renumbered = lines.map(|line| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            let run: i64 = cells[column].parse().expect("a number");
            cells[column] = (100 - run).to_string();
            cells.join(",")
        });
        let rows: Vec<String> = renumbered.collect();
        place.write(&path, &format!("{head}\n{}\n", rows.join("\n")));
    }
    let (_, backwards) = diagnosed(&place, "--held-out none");
    // The clock offset of the sensors may be named too.
    assert!(named(&forwards).contains(&vec!["motion-resistance".to_owned()]), "{forwards}");
    assert_eq!(named(&backwards), named(&forwards));
    // Runs are taken in the order in which they were driven.
    let size = |file: &toml::Table| sized(file, "motion-resistance", "coefficient");
    let ([low, one, high], others) = (size(&forwards), size(&backwards));
    assert_eq!([low, one, high], others);
    assert!((one - 0.05).abs() < 0.01, "{one}");
}

#[test]
fn bad_input_is_refused_and_leaves_nothing() {
    let place = Workplace::new();
    drive(&place, "--runs 2");
    // the same poses in coordinates of a map
    std::fs::create_dir(place.path().join("far")).expect("a folder");
    for name in ["recording.toml", "tracks.csv", "poses.csv"] {
        let text = String::from_utf8(place.read(&format!("drive/{name}"))).expect("text");
        let far = |line: &str| match line.split(',').collect::<Vec<_>>().as_slice() {
            [run, t, x, y, yaw] if x.parse::<f64>().is_ok() => {
                format!("{run},{t},{},{y},{yaw}", 5e5 + x.parse::<f64>().expect("a number"))
            }
            _ => line.to_owned(),
        };
        let lines: Vec<String> = text.lines().map(far).collect();
        place.write(&format!("far/{name}"), &(lines.join("\n") + "\n"));
    }
    // the second run breaks off as it begins
    std::fs::create_dir(place.path().join("brief")).expect("a folder");
    for name in ["recording.toml", "tracks.csv", "poses.csv"] {
        let text = String::from_utf8(place.read(&format!("drive/{name}"))).expect("text");
        let time = |line: &str| -> Option<f64> {
            let (run, rest) = line.split_once(',')?;
            (run == "1").then(|| rest.split(',').next()?.parse().ok())?
        };
        let begin = text.lines().find_map(time).unwrap_or_default();
        let stays = |line: &&str| time(line).is_none_or(|t| t < begin + 0.2);
        let lines: Vec<&str> = text.lines().filter(stays).collect();
        place.write(&format!("brief/{name}"), &(lines.join("\n") + "\n"));
    }
    place.write("points.csv", "v_left,v_right,v_forward,v_lateral,yaw_rate\n0.1,0.2,0.15,,0.2\n");
    for (arguments, message) in [
        (format!("diagnose nowhere --vehicle {VEHICLE}"), "nowhere"),
        ("diagnose drive --vehicle nothing.toml".to_owned(), "nothing.toml"),
        (format!("diagnose drive --vehicle {VEHICLE} --held-out 99"), "run 99"),
        (format!("diagnose drive --vehicle {VEHICLE} --held-out 7-3"), "--held-out 7-3: expected"),
        (format!("diagnose drive --vehicle {VEHICLE} --held-out 0-1"), "at least one run to fit"),
        (
            format!("diagnose points.csv --vehicle {VEHICLE}"),
            "points.csv: 1 steady points: expected at least 30",
        ),
        (
            format!("diagnose points.csv --wheel-radius 0.1 --vehicle {VEHICLE}"),
            "speeds in m/s are those of the tracks already",
        ),
        (format!("diagnose points.csv --held-out 1 --vehicle {VEHICLE}"), "--held-out 1: a table"),
        (
            format!("diagnose points.csv --runs 1 --time 0,5 --vehicle {VEHICLE}"),
            "--runs, --time: points.csv holds steady points",
        ),
        (
            format!("diagnose points.csv --tau 0.1 --vehicle {VEHICLE}"),
            "--tau: points.csv holds steady points",
        ),
        (format!("diagnose drive --runs 99 --vehicle {VEHICLE}"), "--runs: run 99 is not in"),
        (format!("diagnose drive drive --vehicle {VEHICLE}"), "each recording once"),
        (
            format!("diagnose drive --wheel-radius 0.1 --vehicle {VEHICLE}"),
            "speeds in m/s are those of the tracks already",
        ),
        (format!("diagnose drive --pose-topic /slam --vehicle {VEHICLE}"), "drive is no bag"),
        (format!("diagnose brief --held-out 1 --vehicle {VEHICLE}"), "hold no segment of driving"),
        (format!("diagnose far --vehicle {VEHICLE}"), "expected at most 1000 m"),
    ] {
        let before = place.files();
        let run = place.run(&format!("{arguments} --out found"));
        assert_eq!(run.status, 1, "{arguments}: {}", run.stdout);
        assert!(run.stderr.contains(message), "{arguments}: {}", run.stderr);
        assert_eq!(place.files(), before, "{arguments}");
    }
}
