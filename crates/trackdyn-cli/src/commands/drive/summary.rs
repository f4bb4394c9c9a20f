//! Drives along a path as a table.

use std::fmt::Write;
use trackdyn::Drives;
use trackdyn::crates::drive::Ending;
use trackdyn::drive::ending;

/// What the user sees.
pub fn text(drives: &Drives) -> String {
    let (path, tracker) = (drives.path(), drives.tracker());
    let names = drives.drives().iter().map(|drive| drive.name.len());
    let width = names.max().unwrap_or(0).max(10);
    let mut text = format!(
        "{}, path of {:.1} m, {} m/s, look-ahead {} m\n\n{:width$}  {:>9}  {:>9}  {:>9}  {:>7}\n",
        drives.vehicle().name(),
        path.length(),
        tracker.speed,
        tracker.look_ahead,
        "kinematics",
        "rms",
        "largest",
        "at end",
        "time",
    );
    for drive in drives.drives() {
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
