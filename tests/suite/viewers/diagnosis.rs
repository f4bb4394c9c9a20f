//! A diagnosis as layers.

use super::{Message, bytes, messages};
use trackdyn::{
    DiagnoseSettings, Provenance, Recording, SimulateSettings, Vehicle, diagnose, simulate,
};

/// Where the corrected vehicle is nearer to the drive than the one as filed, viewers show it.
#[test]
fn the_corrected_vehicle_is_nearer_and_leaves_noise() {
    let robot = Vehicle::auriga_alpha().with_effect("directional-lugs").expect("an effect");
    let settings =
        SimulateSettings { runs: Some(1), duration: Some(40.0), ..SimulateSettings::default() };
    let drive = simulate(&robot, &settings).expect("it drives");
    let recording: Recording = drive.recording.into();
    let filed = Vehicle::auriga_alpha().with_inertia(true);
    let settings = DiagnoseSettings::default();
    let found = diagnose(&[recording.clone()], &filed, &settings).expect("an answer");
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
        distances.sum::<f64>() / poses(driver).len() as f64
    };
    let [filed, corrected] = ["as_filed", "corrected"].map(distance);
    assert!(corrected < 0.5 * filed, "{corrected} {filed}");
    // what is seen was recorded then
    let run = &recording.runs()[0];
    for seen in poses("observed") {
        let log = seen.log as f64;
        let near = run
            .poses()
            .iter()
            .min_by(|a, b| (a.t * 1e9 - log).abs().total_cmp(&(b.t * 1e9 - log).abs()));
        let near = near.expect("poses").pose;
        assert_eq!(place(seen), [near.x, near.y]);
    }

    for channel in ["forward", "left", "yaw"] {
        let rms = |state: &str| {
            let values = &found[&format!("/trackdyn/{state}/whitened_residual/{channel}")];
            let sum: f64 = values.iter().map(|of| of.number("data").powi(2)).sum();
            (sum / values.len() as f64).sqrt()
        };
        // about 130 segments: a standard error of 6 %
        assert!((0.7..1.3).contains(&rms("after")), "{channel}: {}", rms("after"));
    }
    let texts: Vec<&str> = found["/trackdyn/driving"].iter().map(|of| of.text("data")).collect();
    assert!(texts.windows(2).all(|pair| pair[0] != pair[1]), "{texts:?}");
    assert!(texts.iter().any(|text| text.ends_with(": largest residuals")), "{texts:?}");
}
