//! The results of drives as a table and as a file, schema `trackdyn.drive/1`.

use super::Drive;
use crate::tables::Head;
use serde::Serialize;
use std::fmt::Write;
use trackdyn::crates::core::output::fingerprint;
use trackdyn::crates::drive::{Ending, Path, Tracker};
use trackdyn::crates::model::VehicleFile;

#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    head: Head<'a>,
    path_fingerprint: String,
    path_length_m: f64,
    tracked_point_m: [f64; 2],
    look_ahead_m: f64,
    speed_m_s: f64,
    drive: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    kinematics: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    fingerprint: Option<&'a str>,
    ending: String,
    cross_track_rms_m: f64,
    cross_track_max_m: f64,
    end_distance_m: f64,
    end_belief_m: f64,
    duration_s: f64,
}

fn ending(ending: &Ending) -> String {
    match ending {
        Ending::Arrived => "arrived".to_owned(),
        Ending::OutOfTime => "out of time".to_owned(),
        Ending::Stopped(stopped) => stopped.to_string(),
        other => format!("{other:?}"),
    }
}

/// The text of `drive.toml`.
pub fn text(
    file: &VehicleFile,
    path: &Path,
    tracker: &Tracker,
    drives: &[Drive],
) -> Result<String, toml::ser::Error> {
    let rows = drives.iter().map(|drive| {
        let summary = drive.journey.summary(path, tracker.point);
        Row {
            kinematics: &drive.name,
            fingerprint: drive.fingerprint.as_deref(),
            ending: ending(&drive.journey.ending),
            cross_track_rms_m: summary.rms,
            cross_track_max_m: summary.max,
            end_distance_m: summary.end_distance,
            end_belief_m: summary.end_belief,
            duration_s: summary.duration,
        }
    });
    toml::to_string(&File {
        head: Head::new("trackdyn.drive/1", file),
        path_fingerprint: fingerprint(path.to_csv().as_bytes()),
        path_length_m: path.length(),
        tracked_point_m: tracker.point,
        look_ahead_m: tracker.look_ahead,
        speed_m_s: tracker.speed,
        drive: rows.collect(),
    })
}

/// What the user sees.
pub fn summary(path: &Path, tracker: &Tracker, drives: &[Drive]) -> String {
    let width = drives.iter().map(|drive| drive.name.len()).max().unwrap_or(0).max(10);
    let mut text = format!(
        "path of {:.1} m, {} m/s, look-ahead {} m\n\n{:width$}  {:>9}  {:>9}  {:>9}  {:>7}\n",
        path.length(),
        tracker.speed,
        tracker.look_ahead,
        "kinematics",
        "rms",
        "largest",
        "at end",
        "time",
    );
    for drive in drives {
        let summary = drive.journey.summary(path, tracker.point);
        let _ = write!(
            text,
            "{:width$}  {:6.1} mm  {:6.1} mm  {:6.1} mm  {:5.1} s",
            drive.name,
            1e3 * summary.rms,
            1e3 * summary.max,
            1e3 * summary.end_distance,
            summary.duration,
        );
        if drive.journey.ending != Ending::Arrived {
            let _ = write!(text, "  {}", ending(&drive.journey.ending));
        }
        text.push('\n');
    }
    text
}
