//! Which parameters a replay says to take.

use trackdyn::crates::core::PerSide;
use trackdyn::crates::core::document::Document;
use trackdyn::odometry::Advice;
use trackdyn::{Gauge, Odometry, OdometrySettings, Parameters, Recording, odometry};
use trackdyn_estimate::synthetic::{ConstantIcr, Synthetic, random_steps};

/// Drives whose ICRs and factors on the track speeds are known.
fn driven(alpha: PerSide<f64>, runs: u64) -> Recording {
    let kinematics = ConstantIcr { x_left: -0.4, x_right: 0.45, y: 0.05, alpha };
    let synthetic = Synthetic {
        kinematics,
        schedules: (0..runs).map(|seed| random_steps(10, 4.0, 1.0, seed)).collect(),
        position_noise: 0.003,
        yaw_noise: 0.002,
        tau: 0.0,
        seed: 3,
        ..Synthetic::default()
    };
    synthetic.recording().expect("a recording").into()
}

/// Parameters of no recording.
fn parameters(name: &str, x_right: f64, more: &str) -> Parameters {
    let text = format!(
        "schema = \"trackdyn.kinematics/1\"\nframe = \"paper\"\nx_icr_left_m = -0.4\n\
         x_icr_right_m = {x_right}\ny_icr_m = 0.05\nsteering_efficiency = 0.5\n\
         eccentricity = 0.0\n{more}[source]\ncommand = \"\"\nversion = \"\"\n\
         vehicle = \"\"\nfingerprint = \"\"\n"
    );
    Parameters::from_document(Document::new(name, text)).expect("sound")
}

const ALPHAS: &str = "alpha_left = 0.97\nalpha_right = 0.99\n";

fn replay(recording: &Recording, gauge: f64, parameters: &[Parameters]) -> Odometry {
    let settings = OdometrySettings { tau: Some(0.0), ..OdometrySettings::default() };
    let gauge = Gauge::new(gauge).expect("a gauge");
    odometry(recording, gauge, parameters, &settings).expect("replayed")
}

fn choice(of: &Odometry) -> Option<String> {
    of.advice().choice().map(str::to_owned)
}

/// Factors that the robot has are worth their file; factors that it does not have are not.
#[test]
fn factors_are_taken_where_they_are_surely_better() {
    let files = || [parameters("plain.toml", 0.45, ""), parameters("alpha.toml", 0.45, ALPHAS)];
    let with = driven(PerSide::new(0.97, 0.99), 4);
    let of = replay(&with, 0.42, &files());
    assert_eq!(choice(&of).as_deref(), Some("alpha.toml"), "{:?}", of.advice());
    let advice = of.advice();
    let names: Vec<&str> = advice.compared().iter().map(|one| one.with.as_str()).collect();
    assert_eq!(names, ["ideal", "plain"]);
    for one in advice.compared() {
        assert!(one.place.interval().expect("enough driving")[1] < 1.0, "{one:?}");
    }
    // the order of the files does not count
    let [plain, alpha] = files();
    assert_eq!(choice(&replay(&with, 0.42, &[alpha, plain])).as_deref(), Some("alpha.toml"));
    let without = driven(PerSide::new(1.0, 1.0), 4);
    assert_eq!(choice(&replay(&without, 0.42, &files())).as_deref(), Some("plain.toml"));
}

/// Parameters that are those of the ideal drive, or worse, are no gain.
#[test]
fn the_ideal_drive_stays_where_no_file_is_surely_better() {
    let recording = driven(PerSide::new(1.0, 1.0), 4);
    let of = replay(&recording, 0.85, &[parameters("far.toml", 0.9, "")]);
    assert!(matches!(of.advice(), Advice::Ideal { .. }), "{:?}", of.advice());
    let toml: toml::Table = of.to_toml(&trackdyn::Provenance::default()).parse().expect("TOML");
    assert_eq!(toml["advice"]["take"].as_str(), Some("ideal"));
    assert_eq!(toml["advice"]["compared"][0]["with"].as_str(), Some("far"));
}

#[test]
fn what_is_not_decided_says_why() {
    let recording = driven(PerSide::new(1.0, 1.0), 1);
    let doubtful = parameters("doubtful.toml", 0.45, "doubtful = true\n");
    for (parameters, part) in [(vec![], "replayed alone"), (vec![doubtful], "doubtful")] {
        let of = replay(&recording, 0.42, &parameters);
        let Advice::Undecided { reason } = of.advice() else { panic!("{:?}", of.advice()) };
        assert!(reason.contains(part), "{reason}");
        let toml = of.to_toml(&trackdyn::Provenance::default());
        assert!(toml.contains("undecided = "), "{toml}");
    }
}
