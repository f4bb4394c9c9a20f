//! A recorded path and what was predicted.

use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{INK, Rgb, WHITE};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{Labels, Panel};
use trackdyn_core::Pose;
use trackdyn_estimate::odometry::Comparison;
use trackdyn_estimate::odometry::comparison::Path;

/// Longer paths cross themselves too often to be followed: only their beginning is shown, m.
const LONGEST: f64 = 15.0;

/// Draws the run whose errors are in the middle of all.
pub(super) fn draw(canvas: &mut Canvas, area: Area, result: &Comparison) -> Result<(), Error> {
    let Some(path) = representative(result) else { return Ok(()) };
    let count = path.travelled.partition_point(|travelled| *travelled <= LONGEST).max(2);
    let recorded = &path.recorded[..count.min(path.recorded.len())];
    let points = |poses: &[Pose]| poses.iter().map(|pose| [pose.x, pose.y]).collect::<Vec<_>>();
    let predicted = path.trajectories.iter();
    let predicted = predicted.flat_map(|trajectory| points(&trajectory.poses[..recorded.len()]));
    let panel = Panel::around(area, points(recorded), predicted);
    let labels = Labels { title: "Paths", x: "x (m)", y: "y (m)" };
    panel.frame(canvas, &labels, true)?;
    canvas.clip(area, |canvas| {
        line(canvas, &panel, recorded, 8.0, INK);
        for (set, trajectory) in path.trajectories.iter().enumerate() {
            let poses = &trajectory.poses[..recorded.len()];
            line(canvas, &panel, poses, 4.0, look::colour(set));
        }
        for (set, trajectory) in path.trajectories.iter().enumerate() {
            look::marker(canvas, set, place(&panel, &trajectory.poses[recorded.len() - 1]));
        }
        canvas.disc(place(&panel, &recorded[recorded.len() - 1]), 12.0, INK);
        let start = place(&panel, &recorded[0]);
        canvas.disc(start, 12.0, WHITE);
        canvas.ring(start, 12.0, 4.0, INK);
    });
    panel.border(canvas);
    let length = path.length();
    let shown = if recorded.len() < path.recorded.len() {
        format!("first {} of {} m", number(LONGEST, 0), number(length, 1))
    } else {
        format!("{} m", number(length, 2))
    };
    panel.remark(canvas, &format!("run {}, {shown}; ring: start, marks: end", path.run));
    Ok(())
}

/// Of the longer half of the runs, the one with the median error of yaw: it turns as the others do.
fn representative(result: &Comparison) -> Option<&Path> {
    let mut lengths: Vec<f64> = result.paths.iter().map(Path::length).collect();
    lengths.sort_by(f64::total_cmp);
    let median = lengths.get(lengths.len() / 2)?;
    let mut runs: Vec<(f64, &Path)> = result
        .paths
        .iter()
        .filter(|path| path.length() >= *median)
        .map(|path| {
            let errors = (0..result.sets.len()).filter_map(|set| path.errors(set));
            (errors.map(|errors| errors.absolute_yaw.rmse).sum::<f64>(), path)
        })
        .collect();
    runs.sort_by(|a, b| a.0.total_cmp(&b.0));
    runs.get(runs.len().saturating_sub(1) / 2).map(|(_, path)| *path)
}

fn place(panel: &Panel, pose: &Pose) -> [f64; 2] {
    panel.pixel([pose.x, pose.y])
}

/// A line through poses.
fn line(canvas: &mut Canvas, panel: &Panel, poses: &[Pose], thickness: f64, colour: Rgb) {
    look::line(canvas, poses.iter().map(|pose| place(panel, pose)), thickness, colour);
}
