//! Recordings as dicts of numbers, texts and arrays, and back: what a pickle holds.

use crate::arrays::rows;
use crate::errors::{raised, refused, said};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use trackdyn::crates::core::PerSide;
use trackdyn::crates::recording::recording::Kept as Motion;
use trackdyn::crates::recording::sample::{ImuSample, PoseSample, Sample, TrackSample};
use trackdyn::crates::recording::{
    BagNames, Format, OperatingPoint, OperatingPoints, PoseFrame, Source, StatedNoise, UncheckedRun,
};
use trackdyn::recording::{Kept, KeptSeen};

/// Formats by the names that pickles have for them.
const FORMATS: [(&str, Format); 5] = [
    ("folder", Format::Folder),
    ("rosbag", Format::Rosbag),
    ("tum", Format::Tum),
    ("table", Format::Table),
    ("memory", Format::Memory),
];

/// What a recording holds.
pub fn keep<'py>(py: Python<'py>, recording: &trackdyn::Recording) -> PyResult<Bound<'py, PyDict>> {
    let Kept { seen, path, time } = recording.keep();
    let dict = PyDict::new(py);
    dict.set_item("path", path.map(|path| path.display().to_string()))?;
    dict.set_item("time", time)?;
    match seen {
        KeptSeen::Motion(motion) => dict.set_item("motion", of_motion(py, &motion)?)?,
        KeptSeen::Points(table, path, fingerprint) => {
            let points = table.points.iter().map(|point| {
                let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
                let measured = [point.v_forward, point.v_lateral, point.yaw_rate].map(or_nan);
                [point.v_left, point.v_right, measured[0], measured[1], measured[2]]
            });
            let path = path.display().to_string();
            dict.set_item("points", (table.name, rows(py, points)?, path, fingerprint))?;
        }
    }
    Ok(dict)
}

fn of_motion<'py>(py: Python<'py>, motion: &Motion) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("name", &motion.name)?;
    dict.set_item("robot", &motion.robot)?;
    dict.set_item("has_positions", motion.has_positions)?;
    let noise = motion.stated_noise.map(|noise| [noise.position, noise.yaw]);
    dict.set_item("stated_noise", noise)?;
    dict.set_item("is_one_world", motion.pose_frame.map(|frame| frame == PoseFrame::World))?;
    dict.set_item("fingerprint", &motion.fingerprint)?;
    dict.set_item("pose_fingerprint", &motion.pose_fingerprint)?;
    let Source { format, path, epoch_ns, names } = &motion.source;
    let format = FORMATS.iter().find(|(_, of)| of == format).map_or("memory", |(name, _)| *name);
    let path = path.as_ref().map(|path| path.display().to_string());
    dict.set_item("source", (format, path, *epoch_ns))?;
    dict.set_item("bag", names.as_ref().map(|names| of_names(py, names)).transpose()?)?;
    let runs = motion.runs.iter().map(|run| {
        let tracks = run.tracks.samples.iter().map(cells::<TrackSample, 3>);
        let poses = run.poses.samples.iter().map(cells::<PoseSample, 4>);
        let imu = run.imu.samples.iter().map(cells::<ImuSample, 4>);
        Ok((run.id, rows(py, tracks)?, rows(py, poses)?, rows(py, imu)?))
    });
    dict.set_item("runs", runs.collect::<PyResult<Vec<_>>>()?)?;
    Ok(dict)
}

fn of_names<'py>(py: Python<'py>, names: &BagNames) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("left_joints", &names.joints.left)?;
    dict.set_item("right_joints", &names.joints.right)?;
    dict.set_item("wheel_radius", names.wheel_radius)?;
    dict.set_item("track_topics", &names.track_topics)?;
    dict.set_item("pose_topic", &names.pose_topic)?;
    dict.set_item("parent_frame", &names.parent_frame)?;
    dict.set_item("child_frame", &names.child_frame)?;
    Ok(dict)
}

fn cells<S: Sample, const N: usize>(sample: &S) -> [f64; N] {
    let mut cells = Vec::with_capacity(N);
    sample.push_columns(&mut cells);
    std::array::from_fn(|place| cells[place])
}

/// The rows of a run: its number, track speeds, poses and readings of an IMU.
type Rows<'py> =
    (i64, PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>);

/// What was kept of a recording of motion.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Parts<'py> {
    name: String,
    robot: String,
    has_positions: bool,
    stated_noise: Option<[f64; 2]>,
    is_one_world: Option<bool>,
    fingerprint: String,
    pose_fingerprint: String,
    source: (String, Option<PathBuf>, Option<i64>),
    bag: Option<Names>,
    runs: Vec<Rows<'py>>,
}

/// What was kept of the names in a bag.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Names {
    left_joints: Vec<String>,
    right_joints: Vec<String>,
    wheel_radius: Option<f64>,
    track_topics: Vec<String>,
    pose_topic: Option<String>,
    parent_frame: Option<String>,
    child_frame: Option<String>,
}

/// The recording that was kept.
pub fn restore(kept: &Bound<'_, PyDict>) -> PyResult<trackdyn::Recording> {
    let missing = || said("recording", "recording: expected what a recording kept");
    let path = kept.get_item("path")?.ok_or_else(missing)?.extract()?;
    let time = kept.get_item("time")?.ok_or_else(missing)?.extract()?;
    let seen = if let Some(motion) = kept.get_item("motion")? {
        KeptSeen::Motion(motion.extract::<Parts<'_>>()?.into_motion()?)
    } else {
        let points = kept.get_item("points")?.ok_or_else(missing)?;
        let (name, rows, path, fingerprint): (_, PyReadonlyArray2<'_, f64>, _, _) =
            points.extract()?;
        let measured = |value: f64| (!value.is_nan()).then_some(value);
        let rows = rows.as_array();
        let points = rows.rows().into_iter().map(|row| OperatingPoint {
            v_left: row[0],
            v_right: row[1],
            v_forward: measured(row[2]),
            v_lateral: measured(row[3]),
            yaw_rate: measured(row[4]),
        });
        KeptSeen::Points(OperatingPoints { name, points: points.collect() }, path, fingerprint)
    };
    trackdyn::Recording::restore(Kept { seen, path, time }, Vec::new()).map_err(raised)
}

impl Parts<'_> {
    fn into_motion(self) -> PyResult<Motion> {
        let (format, path, epoch_ns) = self.source;
        let known = FORMATS.iter().find(|(name, _)| *name == format);
        let unknown = || refused("format", &format, "expected one that this version knows");
        let (_, format) = *known.ok_or_else(unknown)?;
        let names = self.bag.map(|bag| {
            Box::new(BagNames {
                joints: PerSide::new(bag.left_joints, bag.right_joints),
                wheel_radius: bag.wheel_radius,
                track_topics: bag.track_topics,
                pose_topic: bag.pose_topic,
                parent_frame: bag.parent_frame,
                child_frame: bag.child_frame,
            })
        });
        let runs = self.runs.into_iter().map(|(id, tracks, poses, imu)| UncheckedRun {
            id,
            tracks: super::series::<TrackSample>(&tracks),
            poses: super::series::<PoseSample>(&poses),
            imu: super::series::<ImuSample>(&imu),
        });
        Ok(Motion {
            name: self.name,
            robot: self.robot,
            runs: runs.collect(),
            has_positions: self.has_positions,
            stated_noise: self.stated_noise.map(|[position, yaw]| StatedNoise { position, yaw }),
            pose_frame: (self.is_one_world)
                .map(|is_one| if is_one { PoseFrame::World } else { PoseFrame::Run }),
            source: Source { format, path, epoch_ns, names },
            fingerprint: self.fingerprint,
            pose_fingerprint: self.pose_fingerprint,
        })
    }
}
