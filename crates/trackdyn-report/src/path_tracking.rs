//! The figure of drives along a path.

mod errors;
mod numbers;

use crate::colour::GREY;
use crate::figure::{Area, Figure, around};
use crate::odometry::legend;
use crate::paths::{self, Named};
use crate::sheet::{self, LEFT};
use crate::text::Style;
use crate::ticks::number;
use trackdyn_core::Pose;
use trackdyn_drive::{Journey, Path};

const HEIGHT: i32 = 1350;
const PATHS: Area = Area::new(LEFT + 118, 270, 940, 900);
const ERRORS: Area = Area::new(1290, 270, 1050, 470);
const NUMBERS: Area = Area::new(1290, 890, 1050, 310);

/// A drive and what it is called.
#[derive(Clone, Copy, Debug)]
pub struct TrackedDrive<'a> {
    /// Name of the kinematics.
    pub name: &'a str,
    /// What came of it.
    pub journey: &'a Journey,
}

/// Drives along a path as a picture: the planned path with the driven ones, the cross-track error
/// over the way, and both in numbers. `point` is the tracked body point (forward, left, m), `title`
/// says how the robot knew its pose, and `caption` stands below, for what the figure was made from.
pub fn path_tracking(
    path: &Path,
    drives: &[TrackedDrive],
    point: [f64; 2],
    title: &str,
    caption: &str,
) -> Figure {
    let mut figure = Figure::new("drive", [sheet::WIDTH, HEIGHT]);
    let title = format!("Path tracking: {title}, {} m", number(path.length(), 1));
    sheet::line(&mut figure, &title, 72, Style::new(40.0));
    sheet::line(&mut figure, caption, HEIGHT - 28, Style::new(24.0).colour(GREY));
    figure.legends.push(legend("planned", drives.iter().map(|drive| drive.name)));
    let driven: Vec<Named> =
        drives.iter().map(|drive| (drive.name, driven(drive, point))).collect();
    let planned = path.points().to_vec();
    // A drive goes hardly further than the path is long: all of it is shown
    let all = planned.iter().chain(driven.iter().flat_map(|(_, points)| points)).copied();
    let ranges = around(PATHS, all, []);
    let mut panel = paths::panel(PATHS, ranges, ("planned", planned), &driven);
    panel.remark = String::from("ring: start, marks: end");
    figure.panels.push(panel);
    figure.panels.push(errors::panel(ERRORS, drives));
    figure.panels.push(numbers::panel(NUMBERS, path, drives, point));
    figure
}

/// The way of the tracked point.
fn driven(drive: &TrackedDrive, [forward, left]: [f64; 2]) -> Vec<[f64; 2]> {
    let moments = drive.journey.trajectory.moments().iter();
    let place = |pose: Pose| pose.compose(&Pose::new(forward, left, 0.0));
    moments.map(|moment| place(moment.pose)).map(|pose| [pose.x, pose.y]).collect()
}
