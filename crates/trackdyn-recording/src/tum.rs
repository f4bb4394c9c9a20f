//! Trajectories of the TUM RGB-D benchmark, with the track speeds in a CSV beside them.
//!
//! A line is `t x y z qx qy qz qw`, blanks between, `#` before a remark
//! (<https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats>); names of the columns may
//! stand above. The motion is planar: x, y and the yaw of the quaternion count, the rest is
//! dropped; poses of a camera are refused.

use crate::attitude::Attitude;
use crate::doubt::{Axes, Doubt, DoubtKind};
use crate::recording::{Recording, Source, UncheckedRun, Warning, divide, turn_sensor};
use crate::rosbag::yaw_of_quaternion;
use crate::sample::{PoseSample, Series};
use crate::table::{MAX_ROW_SIZE, MAX_ROWS, number, out_of_bounds, unreadable};
use crate::{Error, Format, TableOptions, folder};
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use trackdyn_core::{Pose, input};

const COLUMNS: [&str; 8] = ["t", "x", "y", "z", "qx", "qy", "qz", "qw"];

/// Reads a trajectory and the track speeds (`t,v_left,v_right`) of the same clock.
///
/// # Errors
/// Errors that name file, line and column.
pub fn read(trajectory: &Path, tracks: &Path, robot: &str) -> Result<Recording, Error> {
    read_by(trajectory, tracks, robot, &TableOptions::default())
}

/// Reads a trajectory and the track speeds (`t,v_left,v_right`) of the same clock by options.
///
/// # Errors
/// Those of [`read`]; [`Error::Options`] for options that do not go together.
pub fn read_by(
    trajectory: &Path,
    tracks: &Path,
    robot: &str,
    options: &TableOptions,
) -> Result<Recording, Error> {
    let Poses { poses, tilted, end } = poses(trajectory)?;
    let tilted = tilted.map(|(count, axes)| Doubt::OutOfPlane { count, axes });
    let is_accepted = options.accepted.contains(&DoubtKind::OutOfPlane);
    if let Some(doubt) = tilted.clone().filter(|_| !is_accepted) {
        return Err(Error::contradiction(trajectory, doubt));
    }
    let ((tracks, mut warnings), imu) = (folder::read_single_tracks(tracks)?, Series::default());
    warnings.extend(tilted.map(Warning::Accepted).into_iter().chain(end));
    let mut runs = divide(vec![UncheckedRun { id: 0, tracks, poses, imu }], &mut warnings);
    options.convert(trajectory, &mut runs)?;
    turn_sensor(&mut runs, options.pose_axes, options.mount_yaw);
    let name = input::name_of(trajectory);
    let source =
        Source { format: Format::Tum, path: Some(trajectory.to_owned()), ..Source::computed() };
    Recording::accepting(name, robot, runs, source, warnings, &options.accepted)
        .map_err(|error| error.of_wheels(options.speed_unit, options.wheel_radius))
}

/// Reads a trajectory alone, as it stands in the file.
///
/// # Errors
/// As [`read`].
pub fn read_poses(path: &Path) -> Result<Series<PoseSample>, Error> {
    let Poses { poses, tilted, end: _ } = poses(path)?;
    match tilted {
        None => Ok(poses),
        Some((count, axes)) => Err(Error::contradiction(path, Doubt::OutOfPlane { count, axes })),
    }
}

/// What a file holds.
struct Poses {
    poses: Series<PoseSample>,
    /// How many of them no robot has, and by which axes, where these are too many.
    tilted: Option<(u64, Axes)>,
    /// The last line, where it is unfinished.
    end: Option<Warning>,
}

/// The poses of a file.
fn poses(path: &Path) -> Result<Poses, Error> {
    let file = input::open(path).map_err(|cause| unreadable(path, cause))?;
    let mut reader = BufReader::with_capacity(1 << 18, file);
    let mut poses = Vec::new();
    let mut attitude = Attitude::default();
    let mut text = Vec::new();
    let mut line = 0;
    let (mut header_was_read, mut end) = (false, None);
    loop {
        text.clear();
        let mut row = (&mut reader).take(MAX_ROW_SIZE + 1);
        if row.read_until(b'\n', &mut text).map_err(|cause| unreadable(path, cause))? == 0 {
            break;
        }
        line += 1;
        if text.len() as u64 > MAX_ROW_SIZE || line > MAX_ROWS {
            return Err(out_of_bounds(path, line));
        }
        let marked = text.strip_prefix(b"\xef\xbb\xbf").filter(|_| line == 1);
        let row = marked.unwrap_or(&text).trim_ascii();
        let is_header = poses.is_empty() && !header_was_read && is_of_names(row);
        header_was_read |= is_header;
        if !row.is_empty() && row[0] != b'#' && !is_header {
            match parse_row(row, path, line, &mut attitude) {
                Ok(pose) => poses.push(pose),
                // A program that was switched off leaves its last line unfinished.
                Err(_) if is_cut_off(&text, &mut reader, poses.len()) => {
                    let (path, bytes) = (path.to_owned(), text.len());
                    end = Some(Warning::EndLeftOut { path, line, rows: 1, bytes });
                }
                Err(error) => return Err(error),
            }
        }
    }
    if poses.is_empty() {
        let message = "no poses: expected lines t x y z qx qy qz qw".to_owned();
        return Err(Error::Empty { path: path.to_owned(), message });
    }
    Ok(Poses { poses: poses.into(), tilted: attitude.out_of_plane(), end })
}

/// What is expected in place of commas and semicolons. Columns between these may have another
/// order, so they are not read as if there were blanks.
const BLANKS: &str = "numbers with decimal points and blanks between; other tables are read as \
                      .csv, by --columns";

/// Fewest poses above a line that is left out as unfinished.
const MIN_POSES: usize = 10;

/// Whether a line ends without a line break, and so does the file.
fn is_cut_off(text: &[u8], reader: &mut impl BufRead, poses: usize) -> bool {
    let is_last = reader.fill_buf().is_ok_and(<[u8]>::is_empty);
    poses >= MIN_POSES && is_last && !text.ends_with(b"\n")
}

/// Whether a line has names of columns: as many words, and none of them a number.
fn is_of_names(row: &[u8]) -> bool {
    let words = || row.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words().count() == COLUMNS.len() && words().all(|word| number(word).is_none())
}

/// Whether a word has a comma or a semicolon.
fn separates(word: &[u8]) -> bool {
    word.iter().any(|byte| b",;".contains(byte))
}

fn parse_row(
    row: &[u8],
    path: &Path,
    line: u64,
    attitude: &mut Attitude,
) -> Result<PoseSample, Error> {
    let mut values = [0.0; 8];
    let mut found = 0;
    for word in row.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
        if let Some(value) = values.get_mut(found) {
            *value = number(word).ok_or_else(|| Error::Cell {
                path: path.to_owned(),
                line,
                column: found + 1,
                name: COLUMNS[found].to_owned(),
                value: String::from_utf8_lossy(word).into_owned(),
                expected: if separates(word) { BLANKS } else { "a number" },
            })?;
        }
        found += 1;
    }
    if found != COLUMNS.len() {
        let (found, expected) = (found as u64, COLUMNS.len() as u64);
        return Err(Error::Row { path: path.to_owned(), line, found, expected });
    }
    let [t, x, y, _, quaternion @ ..] = values;
    attitude.note(quaternion);
    Ok(PoseSample { t, pose: Pose::new(x, y, yaw_of_quaternion(quaternion)) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PoseUnit;
    use std::fmt::Write;

    /// A drive of 4 s: a trajectory in mm, and the speeds of its tracks.
    fn drive(header: &str) -> (tempfile::TempDir, Result<Recording, Error>) {
        let (mut trajectory, mut tracks) = (header.to_owned(), "t,v_left,v_right\n".to_owned());
        for k in 0..40 {
            let (s, tenth) = (k / 10, k % 10);
            let _ = writeln!(trajectory, "{s}.{tenth} {} 0 0 0 0 0 1", 100 * k);
            let _ = writeln!(tracks, "{s}.{tenth},1,1");
        }
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("walk.tum"), trajectory).expect("written");
        std::fs::write(path("tracks.csv"), tracks).expect("written");
        let options = TableOptions { pose_unit: PoseUnit::Millimetres, ..TableOptions::default() };
        let recording = read_by(&path("walk.tum"), &path("tracks.csv"), "robot", &options);
        (folder, recording)
    }

    #[test]
    fn names_of_columns_may_stand_above_and_positions_have_a_unit() {
        for header in ["", "timestamp tx ty tz qx qy qz qw\n", "# t x\nt x y z qx qy qz qw\n"] {
            let (_, recording) = drive(header);
            let recording = recording.expect(header);
            let poses = recording.runs()[0].poses();
            assert_eq!(poses.len(), 40);
            assert!((poses[39].pose.x - 3.9).abs() < 1e-12, "{:?}", poses[39]);
        }
        for row in ["0.0,0,0,0,0,0,0,1\n", "0.0;0;0;0;0;0;0;1\n", "0.0, 0, 0, 0, 0, 0, 0, 1\n"] {
            let (_, recording) = drive(row);
            let error = recording.expect_err(row).to_string();
            assert!(error.contains("walk.tum:1:1") && error.contains("--columns"), "{error}");
        }
        for header in ["t x y\n", "t x y z qx qy qz qw\nt x y z qx qy qz qw\n"] {
            let (_, recording) = drive(header);
            assert!(recording.is_err_and(|error| error.to_string().contains("walk.tum:")));
        }
    }
}
