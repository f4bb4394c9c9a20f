//! The figure of drives along a path.

mod errors;
mod numbers;
mod paths;

use crate::canvas::{Area, Canvas};
use crate::colour::GREY;
use crate::panel::ticks::number;
use crate::text::{Horizontal, Style, Vertical};
use crate::{Error, legend};
use trackdyn_drive::{Journey, Path};

const WIDTH: u16 = 2400;
const HEIGHT: u16 = 1350;
/// Left end of all lines of text.
const LEFT: i32 = 40;

const LEGEND: Area = Area::new(LEFT, 120, 2320, 70);
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

/// Drives along a path as a picture: the planned path with the driven ones, the cross-track error over
/// the way, and both in numbers. `point` is the tracked body point (forward, left, m), `title` says how
/// the robot knew its pose, and `caption` stands below, for what the figure was made from.
///
/// Returns the bytes of a PNG. They depend on the arguments only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no result is the cause of one.
pub fn path_tracking(
    path: &Path,
    drives: &[TrackedDrive],
    point: [f64; 2],
    title: &str,
    caption: &str,
) -> Result<Vec<u8>, Error> {
    let mut canvas = Canvas::new(WIDTH, HEIGHT)?;
    heading(&mut canvas, path, title, caption);
    legend::draw(&mut canvas, LEGEND, "planned", drives.iter().map(|drive| drive.name));
    paths::draw(&mut canvas, PATHS, path, drives, point)?;
    errors::draw(&mut canvas, ERRORS, drives)?;
    numbers::draw(&mut canvas, NUMBERS, path, drives, point);
    canvas.to_png()
}

fn heading(canvas: &mut Canvas, path: &Path, title: &str, caption: &str) {
    let style = |size| Style::new(size).anchor(Horizontal::Left, Vertical::Baseline);
    let right = i32::from(WIDTH) - LEFT;
    let title = format!("Path tracking: {title}, {} m", number(path.length(), 1));
    let title = canvas.fitted(&title, 40.0, right - LEFT);
    canvas.text(&title, [LEFT, 72], &style(40.0));
    let below = canvas.fitted(caption, 24.0, right - LEFT);
    canvas.text(&below, [LEFT, i32::from(HEIGHT) - 28], &style(24.0).colour(GREY));
}
