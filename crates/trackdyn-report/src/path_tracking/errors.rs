//! Cross-track error over the way.

use super::TrackedDrive;
use crate::canvas::{Area, Canvas};
use crate::colour::INK;
use crate::panel::{Labels, Panel};
use crate::{Error, look};
use trackdyn_drive::tracking::CrossTrack;

/// Where errors reach this, m, they are shown as distances: the side of a leg that is far away says
/// nothing.
const LARGE: f64 = 1.0;

/// Least room above and below, in the unit of the axis: what is smaller is rounding.
const LEAST: f64 = 0.1;

/// Draws the errors of all drives.
pub(super) fn draw(canvas: &mut Canvas, area: Area, drives: &[TrackedDrive]) -> Result<(), Error> {
    let errors = || drives.iter().flat_map(|drive| &drive.journey.cross_track);
    let is_large = errors().any(|error| error.offset.abs() >= LARGE);
    let (scale, y, remark) = if is_large {
        (1.0, "distance to the path (m)", "either side")
    } else {
        (1e3, "cross-track error (mm)", "left positive")
    };
    let shown =
        |error: &CrossTrack| scale * if is_large { error.offset.abs() } else { error.offset };
    let [low, high] = errors()
        .fold([0.0_f64; 2], |[low, high], error| [low.min(shown(error)), high.max(shown(error))]);
    let way = errors().map(|error| error.travelled).fold(0.0, f64::max);
    let room = (0.08 * (high - low)).max(LEAST);
    let panel = Panel {
        plot: area,
        x: [0.0, if way > 0.0 { 1.03 * way } else { 1.0 }],
        y: [low - room, high + room],
    };
    let labels = Labels { title: "Beside the path", x: "distance travelled (m)", y };
    panel.frame(canvas, &labels, true)?;
    canvas.clip(area, |canvas| {
        let ends = panel.x.map(|x| panel.pixel([x, 0.0]));
        canvas.line(ends[0], ends[1], 6.0, INK);
        for (entry, drive) in drives.iter().enumerate() {
            let places = drive.journey.cross_track.iter();
            let mut places = places.map(|error| panel.pixel([error.travelled, shown(error)]));
            look::line(canvas, places.by_ref(), 4.0, look::colour(entry));
        }
        for (entry, drive) in drives.iter().enumerate() {
            if let Some(last) = drive.journey.cross_track.last() {
                let place = panel.pixel([last.travelled, shown(last)]);
                look::marker(canvas, entry, place);
            }
        }
    });
    panel.border(canvas);
    panel.remark(canvas, remark);
    Ok(())
}
