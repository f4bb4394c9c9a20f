//! The true motion, as a table beside a recording: `truth.csv`, which readers of recordings pass
//! over.

use std::fmt::Write;
use std::path::Path;
use trackdyn_core::output::{OutputError, write_file};
use trackdyn_core::{Moment, PerSide, Trajectory};

/// Name of the table in the folder of a recording.
pub const FILE: &str = "truth.csv";

/// The text: `run,t,x,y,yaw,v_forward,v_lateral,yaw_rate,v_left,v_right`, REP-103 and SI, in the
/// frame of the world and by the true clock. Numbers are printed so that reading them gives the
/// same bits.
pub fn text<'a>(runs: impl IntoIterator<Item = (i64, &'a Trajectory)>) -> String {
    let mut text = String::from("run,t,x,y,yaw,v_forward,v_lateral,yaw_rate,v_left,v_right\n");
    for (run, trajectory) in runs {
        for Moment { t, pose, twist, belt_speed: PerSide { left, right } } in trajectory.moments() {
            let _ = writeln!(
                text,
                "{run},{t},{},{},{},{},{},{},{left},{right}",
                pose.x, pose.y, pose.yaw, twist.v_x, twist.v_y, twist.w
            );
        }
    }
    text
}

/// Writes the table into the folder of a recording.
///
/// # Errors
/// [`OutputError`].
pub fn write<'a>(
    folder: &Path,
    runs: impl IntoIterator<Item = (i64, &'a Trajectory)>,
) -> Result<(), OutputError> {
    write_file(&folder.join(FILE), text(runs).as_bytes())
}
