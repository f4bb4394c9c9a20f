//! Files of sensors that are not accepted.

use trackdyn_core::document::Document;
use trackdyn_drive::Sensors;

fn refused(text: &str) -> String {
    let text = format!("schema = \"trackdyn.sensors/1\"\nname = \"s\"\n{text}");
    Sensors::from_document(&Document::new("s.toml", text)).expect_err("refused").to_string()
}

#[test]
fn errors_point_at_their_line_and_key() {
    for (text, expected) in [
        ("[encoder]\ninterval_s = 0\n", "s.toml:4: encoder.interval_s = 0: expected"),
        ("[encoder]\ninterval_s = nan\n", "s.toml:4: encoder.interval_s = nan: expected"),
        ("[encoder]\ntick_m = -0.1\n", "s.toml:4: encoder.tick_m = -0.1: expected"),
        ("[encoder]\nticks = 1\n", "s.toml:4:1: unknown field `ticks`"),
        ("[pose]\n\njitter_s = 0.06\n", "s.toml:5: pose.jitter_s = 0.06: expected 0 to a quarter"),
        ("[pose]\nwhite = { position_m = -1 }\n", "s.toml:4: pose.white.position_m = -1"),
        ("[pose.dropout]\nshare = 0.1\n", "pose.dropout.duration_s = "),
        ("[pose.outlier]\nshare = 1.5\n", "s.toml:4: pose.outlier.share = 1.5: expected 0 to 1"),
        ("[pose]\nframe = \"moon\"\n", "s.toml:4:9: unknown variant `moon`"),
        ("[imu]\nleft_m = inf\n", "s.toml:4: imu.left_m = inf"),
        ("[lidar]\n", "unknown field `lidar`"),
    ] {
        let error = refused(text);
        assert!(error.contains(expected), "{error}");
    }
    let other = Document::new("s.toml", "schema = \"trackdyn.vehicle/1\"\nname = \"s\"\n");
    let error = Sensors::from_document(&other).expect_err("another schema").to_string();
    assert!(error.contains("s.toml:1: schema = \"trackdyn.vehicle/1\": expected"), "{error}");
}

#[test]
fn what_is_absent_is_as_in_the_laboratory_but_for_the_imu() {
    let text = "schema = \"trackdyn.sensors/1\"\nname = \"laboratory\"\n";
    let sensors = Sensors::from_document(&Document::new("s.toml", text)).expect("valid");
    assert_eq!(sensors, Sensors { imu: None, ..Sensors::default() });
}
