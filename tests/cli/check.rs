//! `trackdyn check`: what a user's CI calls.

use crate::{Workplace, project_file, project_text};

#[test]
fn reference_table_of_the_paper_holds() {
    let reference = project_file("configs/references/auriga-alpha.toml");
    let run = Workplace::new().run(&format!("check {}", reference.display()));
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("13 of 13 values within tolerance"), "{}", run.stdout);
}

const REFERENCE: &str = "schema = \"trackdyn.reference/1\"\ngrid = 5\n[[case]]\nname = \"mine\"\n\
    [case.expect]\neccentricity = { value = 0.0984, tolerance = 1e-3 }\n";

#[test]
fn a_number_that_left_its_tolerance_fails() {
    let place = Workplace::new();
    place.write("good.toml", REFERENCE);
    assert_eq!(place.run("check good.toml").status, 0);
    // The printed e of the paper, which its own ICRs contradict.
    place.write("bad.toml", &REFERENCE.replace("0.0984", "0.108"));
    let run = place.run("check bad.toml");
    assert_eq!(run.status, 1);
    assert!(run.stdout.contains("MISS") && run.stdout.contains("0 of 1 values"), "{}", run.stdout);
}

/// A robot of which one track carries nearly all does not turn; the cases beside it keep their
/// rows.
#[test]
fn a_case_that_does_not_turn_misses_and_costs_no_other() {
    let place = Workplace::new();
    let held = "[[case]]\nname = \"held\"\ncog_m = [0.2, 0.0]\n[case.expect]\n\
                eccentricity = { value = 0.0, tolerance = 1.0 }\n\
                turning_pairs = { value = 0, tolerance = 0 }\n";
    place.write("two.toml", &format!("{REFERENCE}{held}"));
    let run = place.run("check two.toml");
    assert_eq!(run.status, 1, "{}", run.stderr);
    assert!(run.stderr.contains("\"held\": no motion turns"), "{}", run.stderr);
    assert!(run.stdout.contains("2 of 3 values within tolerance"), "{}", run.stdout);
}

#[test]
fn another_vehicle_can_be_checked() {
    let place = Workplace::new();
    place.write("good.toml", REFERENCE);
    let vehicle = project_text("configs/vehicles/auriga-alpha.toml");
    place.write("moved.toml", &vehicle.replace("[-0.015, 0.04]", "[0.0, 0.04]"));
    let run = place.run("check good.toml --vehicle moved.toml");
    assert_eq!(run.status, 1, "{}", run.stdout);
}

#[test]
fn mistakes_in_a_reference_name_their_line() {
    let place = Workplace::new();
    for (from, to, part) in [
        ("eccentricity", "excentricity", "bad.toml:6: expect = excentricity: expected one of"),
        ("tolerance = 1e-3", "tolerance = -1", "bad.toml:6: eccentricity"),
        ("grid = 5", "grid = 1", "bad.toml:2: grid = 1: expected 2 to 2001"),
        ("[case.expect]", "effects = [\"slop\"]\n[case.expect]", "bad.toml:5: effects = \"slop\""),
        (
            "[case.expect]",
            "effects = [\"slope\", \"slope:angle_deg=2\"]\n[case.expect]",
            "bad.toml:5: effects = \"slope:angle_deg=2\": expected each effect once",
        ),
        ("value = 0.0984", "valeu = 0.0984", "bad.toml:6:"),
        ("grid = 5", "grid = 5\nmax_speed_m_s = nan", "bad.toml:3: max_speed_m_s = nan: expected"),
        ("[case.expect]", "cog_m = [0.0]\n[case.expect]", "bad.toml:5: cog_m = [0.0]: expected 2"),
        // what checks nothing does not hold
        ("tolerance = 1e-3", "tolerance = inf", "bad.toml:6: eccentricity"),
        ("eccentricity = { value = 0.0984, tolerance = 1e-3 }\n", "", "nothing would be checked"),
    ] {
        place.write("bad.toml", &REFERENCE.replace(from, to));
        let run = place.run("check bad.toml");
        assert_eq!(run.status, 1, "{}", run.stdout);
        assert!(run.stderr.contains(part), "{part:?} is not in:\n{}", run.stderr);
    }
}
