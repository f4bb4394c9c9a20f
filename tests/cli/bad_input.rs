//! Nonsense gets one screen that says where, what and what was expected; status 1; and no file.

use crate::{Workplace, project_text};

/// The default vehicle with one piece of text replaced.
fn vehicle(from: &str, to: &str) -> String {
    let text = project_text("configs/vehicles/auriga-alpha.toml");
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

/// Runs `map` on a vehicle file and expects all of `parts` in the message.
fn refused(file: &str, parts: &[&str]) {
    let place = Workplace::new();
    place.write("robot.toml", file);
    let run = place.run("map --vehicle robot.toml --out out");
    assert_eq!(run.status, 1, "{}", run.stderr);
    for part in parts {
        assert!(run.stderr.contains(part), "{part:?} is not in:\n{}", run.stderr);
    }
    assert!(run.stderr.lines().count() <= 20 && run.stdout.is_empty(), "{}", run.stdout);
    assert_eq!(place.files(), [std::path::PathBuf::from("robot.toml")]);
}

#[test]
fn unknown_key() {
    refused(
        &vehicle("gauge_m = 0.42", "guage_m = 0.42"),
        &["robot.toml:6:1", "unknown field `guage_m`", "`gauge_m`", "6 | guage_m = 0.42"],
    );
}

#[test]
fn wrong_type() {
    refused(
        &vehicle("mass_kg = 258.0", "mass_kg = \"heavy\""),
        &["robot.toml:5:11", "string \"heavy\"", "expected f64"],
    );
}

#[test]
fn missing_key() {
    refused(&vehicle("mu_y = 0.7", ""), &["robot.toml:", "missing field `mu_y`"]);
}

#[test]
fn not_toml() {
    refused("name = ", &["robot.toml:1:"]);
}

/// A file of another kind is called so before its keys are asked for.
#[test]
fn another_kind_of_file() {
    refused(
        "name = \"x\"\nschema = \"trackdyn.kinematics/1\"\n",
        &["robot.toml:2: schema = \"trackdyn.kinematics/1\": expected \"trackdyn.vehicle/1\""],
    );
}

/// A height beside the two would be dropped without a word.
#[test]
fn three_numbers_for_two() {
    refused(
        &vehicle("[-0.015, 0.04]", "[-0.015, 0.04, 0.1]"),
        &["cog_m = [-0.015, 0.04, 0.1]: expected 2 numbers"],
    );
}

#[test]
fn wrong_schema() {
    refused(
        &vehicle("trackdyn.vehicle/1", "trackdyn.vehicle/9"),
        &["robot.toml:3: schema = \"trackdyn.vehicle/9\": expected \"trackdyn.vehicle/1\""],
    );
}

#[test]
fn negative_mass() {
    refused(
        &vehicle("mass_kg = 258.0", "mass_kg = -258.0"),
        &["robot.toml:5: mass_kg = -258.0: expected a positive mass in kg"],
    );
}

#[test]
fn nan_and_infinity() {
    refused(&vehicle("mu_x = 0.9", "mu_x = nan"), &["robot.toml:14: friction.mu_x = nan"]);
    refused(&vehicle("gauge_m = 0.42", "gauge_m = inf"), &["robot.toml:6: gauge_m = inf"]);
}

#[test]
fn centre_of_gravity_beside_the_contact() {
    let at = |cog| vehicle("cog_m = [-0.015, 0.04]", &format!("cog_m = {cog}"));
    refused(
        &at("[0.0, 0.36]"),
        &["robot.toml:7: cog_m", "-0.3500 and 0.3500", "tips over its front end"],
    );
    refused(&at("[0.0, -0.36]"), &["tips over its rear end"]);
    refused(&at("[0.3, 0.0]"), &["-0.2100 and 0.2100", "tips over its right side"]);
    refused(&at("[-0.3, 0.0]"), &["tips over its left side"]);
}

#[test]
fn tracks_that_overlap_and_running_gear_that_is_none_or_two() {
    refused(
        &vehicle("belt_width_m = 0.15", "belt_width_m = 0.5"),
        &["robot.toml:11: track.belt_width_m = 0.5", "the sides overlap"],
    );
    let track = "[track]\ncontact_length_m = 0.70\nbelt_width_m = 0.15\n";
    let wheels = "[wheels]\ncontact_length_m = 0.1\nwidth_m = 0.1\naxles_m = [0.3, -0.3]\n";
    refused(&vehicle(track, ""), &["a table [track] or [wheels]"]);
    refused(&vehicle(track, &format!("{track}{wheels}")), &["not both"]);
    refused(
        &vehicle(track, &wheels.replace("[0.3, -0.3]", "[0.3, 0.35]")),
        &["robot.toml:12: wheels.axles_m = [0.3, 0.35]", "a contact length (0.1 m) apart"],
    );
}

#[test]
fn effects_in_a_file() {
    let with = |table: &str| format!("{}\n{table}\n", vehicle("", ""));
    refused(
        &with("[effect.load-transfr]"),
        &["robot.toml:17: effect.load-transfr", "such as \"load-transfer\""],
    );
    refused(
        &with("[effect.load-transfer]\nheight_m = 0.3"),
        &["robot.toml:18: effect.load-transfer.height_m = 0.3", "such as \"cog_height_m\""],
    );
    refused(
        &with("[effect.load-transfer]\ncog_height_m = -0.3"),
        &["robot.toml:18: effect.load-transfer.cog_height_m = -0.3", "between 0 and 5 m"],
    );
    refused(
        &with("[effect.load-transfer]\ncog_height_m = \"high\""),
        &["robot.toml:18:16", "expected f64"],
    );
}

#[test]
fn options_of_the_command_line() {
    let place = Workplace::new();
    for (arguments, part) in [
        ("map --grid 0", "grid = 0: expected 2 to 2001 points per track"),
        ("map --grid 1000000", "grid = 1000000"),
        ("map --grid -3", "invalid value '-3' for '--grid <N>': expected a whole number"),
        ("simulate --duration -5", "duration -5: expected"),
        ("trial make --cases -1 --seed 1 --out x", "invalid value '-1' for '--cases <N>'"),
        ("plan --diagnosis x --fastest -1", "invalid value '-1' for '--fastest"),
        ("map --fastest 0", "--fastest = 0: expected a positive largest track speed"),
        ("map --speed nan", "--fastest = NaN"),
        ("map --fastest 1e308", "at most 1000"),
        ("map --cog 0.3,0", "tips over its right side"),
        ("map --cog nan,0", "two numbers separated by a comma"),
        ("map --cog 0.1", "two numbers separated by a comma"),
        ("map --effect centripedal", "such as \"centripetal\""),
        ("map --effect slope:angel_deg=3", "such as \"angle_deg\""),
        ("map --effect slope:angle_deg=steep", "the form"),
        ("map --heading north", "a finite number"),
        ("map --vehicle missing.toml", "missing.toml: cannot be read"),
        ("check missing.toml", "missing.toml: cannot be read"),
        ("kinematics", "--speeds"),
        ("kinematics --speeds 1,2,3", "two numbers separated by a comma"),
        ("effects slop", "such as \"slope\""),
        ("maps", "map"),
    ] {
        let run = place.run(arguments);
        assert_eq!(run.status, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
        assert!(run.stdout.is_empty(), "{arguments}: {}", run.stdout);
    }
    assert!(place.files().is_empty(), "{:?}", place.files());
}

#[test]
fn folder_that_cannot_be_written() {
    let place = Workplace::new();
    place.write("file", "in the way");
    let run = place.run("map --out file/out");
    assert_eq!(run.status, 1);
    assert!(run.stderr.contains("file/out: cannot be written"), "{}", run.stderr);
    assert!(run.stdout.is_empty());
    assert_eq!(place.read("file"), b"in the way");
}
