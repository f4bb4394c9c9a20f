//! The planned path and the driven ones.

use super::TrackedDrive;
use crate::canvas::{Area, Canvas};
use crate::colour::{INK, WHITE};
use crate::panel::{Labels, Panel};
use crate::{Error, look};
use trackdyn_core::Pose;
use trackdyn_drive::Path;

/// Draws all of them.
pub(super) fn draw(
    canvas: &mut Canvas,
    area: Area,
    path: &Path,
    drives: &[TrackedDrive],
    [forward, left]: [f64; 2],
) -> Result<(), Error> {
    let driven: Vec<Vec<[f64; 2]>> = drives
        .iter()
        .map(|drive| {
            let moments = drive.journey.trajectory.moments().iter();
            let place = |pose: Pose| pose.compose(&Pose::new(forward, left, 0.0));
            moments.map(|moment| place(moment.pose)).map(|pose| [pose.x, pose.y]).collect()
        })
        .collect();
    let planned = path.points();
    // A drive goes hardly further than the path is long: all of it is shown.
    let all = planned.iter().chain(driven.iter().flatten()).copied();
    let panel = Panel::around(area, all, []);
    panel.frame(canvas, &Labels { title: "Paths", x: "x (m)", y: "y (m)" }, true)?;
    canvas.clip(area, |canvas| {
        look::line(canvas, planned.iter().map(|&point| panel.pixel(point)), 10.0, INK);
        for (entry, points) in driven.iter().enumerate() {
            let places = points.iter().map(|&point| panel.pixel(point));
            look::line(canvas, places, 4.0, look::colour(entry));
        }
        canvas.disc(panel.pixel(planned[planned.len() - 1]), 14.0, INK);
        let start = panel.pixel(planned[0]);
        canvas.disc(start, 16.0, WHITE);
        canvas.ring(start, 16.0, 4.0, INK);
        for (entry, points) in driven.iter().enumerate() {
            if let Some(&end) = points.last() {
                look::marker(canvas, entry, panel.pixel(end));
            }
        }
    });
    panel.border(canvas);
    panel.remark(canvas, "ring: start, marks: end");
    Ok(())
}
