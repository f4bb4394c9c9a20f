//! A diagnosis as layers.

use super::{Message, bytes, messages};
use trackdyn::{
    DiagnoseSettings, Provenance, Recording, Resampling, SimulateSettings, Vehicle, diagnose,
    simulate,
};
use trackdyn_core::real;

/// A stamp in s.
#[expect(clippy::cast_precision_loss, reason = "below 2⁵³ ns, 104 days")]
fn seconds(stamp: u64) -> f64 {
    stamp as f64 / 1e9
}

/// Where the corrected vehicle is nearer to the drive than the one as filed, viewers show it.
#[test]
fn the_corrected_vehicle_is_nearer_and_leaves_noise() {
    let robot = Vehicle::auriga_alpha().with_effect("directional-lugs").expect("an effect");
    let settings =
        SimulateSettings { runs: Some(1), duration: Some(40.0), ..SimulateSettings::default() };
    let drive = simulate(&robot, &settings).expect("it drives");
    let recording: Recording = drive.recording;
    let filed = Vehicle::auriga_alpha().with_inertia(true);
    let resampling = Resampling { draws: 1000, ..Resampling::default() };
    let settings = DiagnoseSettings { resampling, ..DiagnoseSettings::default() };
    let found = diagnose(std::slice::from_ref(&recording), &filed, &settings).expect("an answer");
    let layers = found.layers(&Provenance::default()).expect("a drive");
    let found = messages(&bytes(&layers));

    let poses = |driver: &str| &found[&format!("/trackdyn/{driver}/pose")];
    let place = |of: &Message| ["x", "y"].map(|axis| of.number(&format!("pose.position.{axis}")));
    let distance = |driver: &str| -> f64 {
        assert_eq!(poses(driver).len(), poses("observed").len());
        let pairs = poses("observed").iter().zip(poses(driver));
        let distances = pairs.map(|(seen, model)| {
            assert_eq!(seen.log, model.log);
            let ([x, y], [u, v]) = (place(seen), place(model));
            (x - u).hypot(y - v)
        });
        distances.sum::<f64>() / real(poses(driver).len())
    };
    let [filed, corrected] = ["as_filed", "corrected"].map(distance);
    assert!(corrected < 0.5 * filed, "{corrected} {filed}");
    // what is seen was recorded then
    let run = &recording.runs()[0];
    for seen in poses("observed") {
        let log = seconds(seen.log);
        let near =
            run.poses().iter().min_by(|a, b| (a.t - log).abs().total_cmp(&(b.t - log).abs()));
        let near = near.expect("poses").pose;
        let [x, y] = place(seen);
        assert!((x - near.x).hypot(y - near.y) < 1e-9, "{x} {y} {near:?}");
    }

    for channel in ["forward", "left", "yaw"] {
        let rms = |state: &str| {
            let values = &found[&format!("/trackdyn/{state}/whitened_residual/{channel}")];
            let sum: f64 = values.iter().map(|of| of.number("data").powi(2)).sum();
            (sum / real(values.len())).sqrt()
        };
        // about 130 segments: a standard error of 6 %
        assert!((0.7..1.3).contains(&rms("after")), "{channel}: {}", rms("after"));
    }
    let texts: Vec<&str> = found["/trackdyn/driving"].iter().map(|of| of.text("data")).collect();
    assert!(texts.windows(2).all(|pair| pair[0] != pair[1]), "{texts:?}");
    assert!(texts.iter().any(|text| text.ends_with(": largest residuals")), "{texts:?}");
}
