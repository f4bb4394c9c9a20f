//! The results of drives as a file, schema `trackdyn.drive/1`.

use super::{Drives, ending};
use crate::Provenance;
use crate::document::{Head, to_toml};
use serde::Serialize;
use trackdyn_core::output::fingerprint;

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

/// The text of `drive.toml`.
pub(super) fn text(drives: &Drives, provenance: &Provenance) -> String {
    let (path, tracker) = (drives.path(), drives.tracker());
    let rows = drives.drives().iter().map(|drive| {
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
    to_toml(&File {
        head: Head::new("trackdyn.drive/1", drives.of.vehicle(), provenance),
        path_fingerprint: fingerprint(path.to_csv().as_bytes()),
        path_length_m: path.length(),
        tracked_point_m: tracker.point,
        look_ahead_m: tracker.look_ahead,
        speed_m_s: tracker.speed,
        drive: rows.collect(),
    })
}
