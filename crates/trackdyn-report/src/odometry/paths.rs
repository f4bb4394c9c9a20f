//! A recorded path and what was predicted.

use super::look;
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{INK, Rgb, WHITE};
use crate::panel::ticks::number;
use crate::panel::{Labels, Panel};
use trackdyn_core::Pose;
use trackdyn_odometry::Comparison;
use trackdyn_odometry::comparison::Path;

/// Longer paths cross themselves too often to be followed: only their beginning is shown, m.
const LONGEST: f64 = 15.0;
/// Predictions may leave the recorded path's box by this share of its size.
const BEYOND: f64 = 0.6;

/// Draws the run whose errors are in the middle of all.
pub(super) fn draw(canvas: &mut Canvas, area: Area, result: &Comparison) -> Result<(), Error> {
    let Some(path) = representative(result) else { return Ok(()) };
    let count = path.travelled.partition_point(|travelled| *travelled <= LONGEST).max(2);
    let recorded = &path.recorded[..count.min(path.recorded.len())];
    let panel = view(area, recorded, path);
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

/// The panel that shows all paths, if they are not too far away.
fn view(area: Area, recorded: &[Pose], path: &Path) -> Panel {
    let range = |of: fn(&Pose) -> f64| {
        let values = recorded.iter().map(of);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        })
    };
    let mut ranges = [range(|pose| pose.x), range(|pose| pose.y)];
    let size = ranges.iter().map(|[low, high]| high - low).fold(0.05, f64::max);
    let limits = ranges.map(|[low, high]| [low - BEYOND * size, high + BEYOND * size]);
    for trajectory in &path.trajectories {
        for pose in &trajectory.poses[..recorded.len()] {
            for (k, value) in [pose.x, pose.y].into_iter().enumerate() {
                let value = value.clamp(limits[k][0], limits[k][1]);
                ranges[k] = [ranges[k][0].min(value), ranges[k][1].max(value)];
            }
        }
    }
    let room = 0.06 * ranges.iter().map(|[low, high]| high - low).fold(0.05, f64::max);
    let [x, y] = ranges.map(|[low, high]| [low - room, high + room]);
    Panel::equal_scale(area, x, y)
}

fn place(panel: &Panel, pose: &Pose) -> [f64; 2] {
    panel.pixel([pose.x, pose.y])
}

/// A line through poses; steps shorter than a pixel are joined.
fn line(canvas: &mut Canvas, panel: &Panel, poses: &[Pose], thickness: f64, colour: Rgb) {
    let mut places = poses.iter().map(|pose| place(panel, pose));
    let Some(mut from) = places.next() else { return };
    let mut to = from;
    for next in places {
        to = next;
        if (to[0] - from[0]).hypot(to[1] - from[1]) >= 1.0 {
            canvas.line(from, to, thickness, colour);
            from = to;
        }
    }
    canvas.line(from, to, thickness, colour);
}
