//! Cross-track error over the way.

use super::TrackedDrive;
use crate::colour::INK;
use crate::figure::{Area, Axis, Line, Marker, Panel, Points, entry_colour};
use trackdyn_drive::tracking::CrossTrack;

/// Error from which on all are shown as distances, m: the side of a leg that is far away says
/// nothing.
const MIN_DISTANCE: f64 = 1.0;

/// Least room above and below, in the unit of the axis: what is smaller is rounding.
const MIN_ROOM: f64 = 0.1;

/// The errors of all drives.
pub(super) fn panel(place: Area, drives: &[TrackedDrive]) -> Panel {
    let errors = || drives.iter().flat_map(|drive| &drive.journey.cross_track);
    let is_large = errors().any(|error| error.offset.abs() >= MIN_DISTANCE);
    let (scale, quantity, unit, remark) = if is_large {
        (1.0, "distance to the path", "m", "either side")
    } else {
        (1e3, "cross-track error", "mm", "left positive")
    };
    let shown =
        |error: &CrossTrack| scale * if is_large { error.offset.abs() } else { error.offset };
    let [low, high] = errors()
        .fold([0.0_f64; 2], |[low, high], error| [low.min(shown(error)), high.max(shown(error))]);
    let way = errors().map(|error| error.travelled).fold(0.0, f64::max);
    let room = (0.08 * (high - low)).max(MIN_ROOM);
    let x = [0.0, if way > 0.0 { 1.03 * way } else { 1.0 }];
    let y = Axis::new(quantity, unit, [low - room, high + room]);
    let mut panel =
        Panel::new("Beside the path", place, Axis::new("distance travelled", "m", x), y);
    panel.remark = String::from(remark);
    let path = x.map(|x| [x, 0.0]).to_vec();
    panel.show_as("path", Line { points: path, thickness: 6.0, colour: INK });
    for (entry, drive) in drives.iter().enumerate() {
        let points = drive.journey.cross_track.iter();
        let points = points.map(|error| [error.travelled, shown(error)]).collect();
        let line = Line { points, thickness: 4.0, colour: entry_colour(entry) };
        panel.show_as(drive.name, line);
    }
    for (entry, drive) in drives.iter().enumerate() {
        let end = drive.journey.cross_track.last();
        let end = end.map(|error| [error.travelled, shown(error)]);
        panel.show_as("end", Points::new(Vec::from_iter(end), Marker::of_entry(entry)));
    }
    panel
}
