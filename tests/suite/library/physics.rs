//! Dead reckoning by the forces on a vehicle, and their table for a robot's computer.

use std::process::Command;
use trackdyn::crates::core::PerSide;
use trackdyn::crates::estimate::odometry::{Comparison, ParameterSet};
use trackdyn::export::motion_table;
use trackdyn::odometry::Advice;
use trackdyn::simulate::Driving;
use trackdyn::{
    IdentifySettings, OdometrySettings, Part, Provenance, SimulateSettings, Vehicle, identify,
    odometry, simulate,
};
use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_model::{Circumstance, Stationary};

/// A high robot with inertia, whose belts lag.
fn robot() -> Vehicle {
    let robot = Vehicle::auriga_alpha().with_inertia(true);
    ["load-transfer:cog_height_m=0.15", "drivetrain-lag:time_constant_s=0.1"]
        .into_iter()
        .try_fold(robot, Vehicle::with_effect)
        .expect("effects")
}

fn settings(runs: usize) -> SimulateSettings {
    SimulateSettings { runs: Some(runs), duration: Some(30.0), ..SimulateSettings::default() }
}

fn of_runs(runs: &str) -> OdometrySettings {
    let part = Part { runs: Some(runs.parse().expect("runs")), ..Part::default() };
    OdometrySettings { part, ..OdometrySettings::default() }
}

/// Errors of yaw over segments, rad, of each set.
fn yaw_errors(comparison: &Comparison) -> Vec<f64> {
    let segments = comparison.segments().expect("segments");
    segments.sets.iter().map(|set| set.yaw.rms.value).collect()
}

/// What constant ICRs cannot do, inertia and a lag, the forces do: they leave what the sensors
/// leave, on runs that nothing was fitted to.
#[test]
fn the_forces_on_the_vehicle_leave_noise_where_constant_icrs_leave_more() {
    let robot = robot();
    let seen = simulate(&robot, &settings(6)).expect("it drives").recording;
    let first = Part { runs: Some("0-3".parse().expect("runs")), ..Part::default() };
    let first = seen.part(&first).expect("there");
    let fit = identify(&first, &robot, &IdentifySettings::default()).expect("enough");
    let fitted = [fit.parameters().expect("determined")];
    let found = odometry(&seen, &robot, &fitted, &of_runs("4,5")).expect("replayed");
    assert_eq!(found.physics_stopped(), None);
    let names: Vec<&str> = found.comparison.sets.iter().map(ParameterSet::name).collect();
    assert_eq!((names[0], names[names.len() - 1]), ("ideal", "physics"));
    let errors = yaw_errors(&found.comparison);
    let (icrs, physics) = (errors[1], errors[errors.len() - 1]);
    // Two poses of two milliradians leave 2.8 mrad.
    assert!(physics < 0.0033 && icrs > 1.4 * physics, "{physics} of {icrs} rad");
    assert!(matches!(found.advice(), Advice::Physics { .. }), "{:?}", found.advice());
    // a gauge alone has no forces
    let gauge = trackdyn::Gauge::new(0.42).expect("a gauge");
    let found = odometry(&seen, gauge, &fitted, &of_runs("4,5")).expect("replayed");
    assert!(found.comparison.sets.iter().all(|set| set.vehicle().is_none()));
}

/// Forces that do not move the robot as it was driven are said to, and cost nothing else.
#[test]
fn a_vehicle_that_tips_over_is_replayed_without_its_forces() {
    let seen = simulate(&robot(), &settings(2)).expect("it drives").recording;
    let high = Vehicle::auriga_alpha().with_inertia(true);
    let high = high.with_effect("load-transfer:cog_height_m=1.5").expect("an effect");
    let found = odometry(&seen, &high, &[], &OdometrySettings::default()).expect("replayed");
    let reason = found.physics_stopped().expect("it tips over");
    assert!(reason.contains("tips over") && reason.contains("run 0"), "{reason}");
    assert_eq!(found.comparison.sets.len(), 1);
    let text = found.to_toml(&Provenance::default());
    assert!(text.contains("physics_stopped = "), "{text}");
}

/// A driver's own driving has no need of a schedule file.
#[test]
fn forces_lead_where_the_simulation_went() {
    let robot = robot();
    let settings = SimulateSettings {
        sensors: trackdyn::simulate::sensors("perfect").expect("a preset"),
        driving: Driving::default(),
        ..settings(1)
    };
    let made = simulate(&robot, &settings).expect("it drives");
    let found = odometry(&made.recording, &robot, &[], &OdometrySettings::default());
    let found = found.expect("replayed");
    let [place, yaw] = found.error_at_end(1);
    // Each reading of 30 ms is smoothed and holds until the next one.
    assert!(place < 0.05 && yaw < 0.02, "{place} m, {yaw} rad");
}

/// The header, compiled, gives the motion and the derivatives of the table, and both those of the
/// model.
#[test]
fn the_header_for_a_robots_computer_is_the_model() {
    let robot = Vehicle::auriga_alpha().with_inertia(true);
    let robot = robot.with_effect("encoder-scale:left=1.02,right=0.99").expect("an effect");
    let (table, [_, header]) =
        motion_table(&robot, 1.0, &Provenance::new("a */ test")).expect("a table");
    assert!(table.error <= 1e-6, "{:.1e}", table.error);
    assert!(header.text.lines().count() < 200, "{}", header.text.lines().count());
    assert!(header.text.contains("Steady driving leaves out"), "{}", header.text);
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file(header.name), &header.text).expect("written");
    let program = "#include <stdio.h>\n#include \"trackdyn_motion.h\"\n\
        int main(void) {\n  double l, r, t[3], d[3][2];\n\
        while (scanf(\"%lf %lf\", &l, &r) == 2) {\n    trackdyn_motion(l, r, t, d);\n\
        printf(\"%.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g\\n\", t[0], t[1], t[2],\n\
        d[0][0], d[0][1], d[1][0], d[1][1], d[2][0], d[2][1]);\n  }\n  return 0;\n}\n";
    std::fs::write(file("main.c"), program).expect("written");
    let compiled = Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1", "-o"])
        .args([file("main"), file("main.c")])
        .arg("-lm")
        .status();
    match compiled {
        Err(missing) => return println!("skipped: no C compiler ({missing})"),
        Ok(status) => assert!(status.success(), "{}", header.text),
    }
    let speeds: Vec<PerSide<f64>> = (0..200_u32)
        .map(|k| {
            let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
            PerSide::new(2.0 * a.fract() - 1.0, 2.0 * b.fract() - 1.0)
        })
        .chain([(0.0, 0.0), (0.5, 0.5), (0.0, 0.3)].map(|(left, right)| PerSide::new(left, right)))
        .collect();
    let lines = speeds.iter().map(|of| format!("{:?} {:?}\n", of.left, of.right));
    std::fs::write(file("speeds"), lines.collect::<String>()).expect("written");
    let input = std::fs::File::open(file("speeds")).expect("there");
    let output = Command::new(file("main")).stdin(input).output().expect("it runs").stdout;
    let text = String::from_utf8(output).expect("text");
    assert_eq!(text.lines().count(), speeds.len());
    let model = robot.model();
    let solver = Stationary::new(&model, &Circumstance::default());
    for (line, speeds) in text.lines().zip(speeds) {
        let numbers: Vec<f64> =
            line.split(' ').map(|number| number.parse().expect("a number")).collect();
        let of_table = table.at(speeds);
        let twist = of_table.twist;
        let flat = of_table.by_speed.into_iter().flatten();
        for (number, expected) in
            numbers.iter().zip([twist.v_x, twist.v_y, twist.w].into_iter().chain(flat))
        {
            // Coefficients keep ten decimals, of which derivatives lose three.
            assert!((number - expected).abs() < 1e-7, "{speeds:?}: {number} {expected}");
        }
        let off = twist - ros_twist_from_paper(&solver.solve(speeds).twist);
        let off = off.v_x.hypot(off.v_y).hypot(0.21 * off.w);
        assert!(off < 2e-6, "{speeds:?}: {off:.1e} m/s");
    }
}

/// What knows a heading has no part in a table of speeds, and is named.
#[test]
fn a_slope_is_left_out_of_a_table() {
    let level = Vehicle::auriga_alpha();
    let slope = level.clone().with_effect("slope:angle_deg=5").expect("an effect");
    let of = |robot: &Vehicle| motion_table(robot, 1.0, &Provenance::default()).expect("a table");
    let ((of_level, _), (of_slope, [_, header])) = (of(&level), of(&slope));
    assert_eq!(of_level, of_slope);
    assert!(header.text.contains("leaves out: slope:angle_deg=5"), "{}", header.text);
}

#[test]
fn a_table_needs_a_speed_of_a_robot() {
    for fastest in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        let error = motion_table(&Vehicle::auriga_alpha(), fastest, &Provenance::default());
        let error = error.expect_err("no speed");
        assert_eq!(error.setting(), Some("fastest"), "{fastest}");
    }
}
