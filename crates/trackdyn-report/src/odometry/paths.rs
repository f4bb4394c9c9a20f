//! A recorded path and what was predicted.

use crate::figure::{Area, Panel, around};
use crate::paths::{self, Named};
use crate::ticks::number;
use trackdyn_core::Pose;
use trackdyn_estimate::odometry::comparison::Path;
use trackdyn_estimate::odometry::{Comparison, ParameterSet};

/// Longer paths cross themselves too often to be followed: only their beginning is shown, m.
const MAX_LENGTH: f64 = 15.0;

/// The run whose errors are in the middle of all.
pub(super) fn panel(place: Area, result: &Comparison) -> Option<Panel> {
    let path = representative(result)?;
    let count = path.travelled.partition_point(|travelled| *travelled <= MAX_LENGTH).max(2);
    let count = count.min(path.recorded.len());
    let points = |poses: &[Pose]| -> Vec<[f64; 2]> {
        poses[..count].iter().map(|pose| [pose.x, pose.y]).collect()
    };
    let recorded = points(&path.recorded);
    let predicted = path.trajectories.iter().map(|trajectory| points(&trajectory.poses));
    let names = result.sets.iter().map(ParameterSet::name);
    let predicted: Vec<Named> = names.zip(predicted).collect();
    let further = predicted.iter().flat_map(|(_, points)| points.iter().copied());
    let ranges = around(place, recorded.iter().copied(), further);
    let mut panel = paths::panel(place, ranges, ("recorded", recorded), &predicted);
    let length = path.length();
    let shown = if count < path.recorded.len() {
        format!("first {} of {} m", number(MAX_LENGTH, 0), number(length, 1))
    } else {
        format!("{} m", number(length, 2))
    };
    panel.remark = format!("run {}, {shown}; ring: start, marks: end", path.run);
    Some(panel)
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
