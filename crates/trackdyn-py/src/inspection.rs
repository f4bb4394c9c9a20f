//! Judging a recording before it is used.

use crate::figure::Figure;
use crate::identification::OfGauge;
use crate::options::{Reading, part};
use crate::parameters::Parameters;
use crate::work::run;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use trackdyn::crates::estimate::Clock;
use trackdyn::inspect::{Content, Driving, Verdict};
use trackdyn::recording::{BagOptions, PoseAxes, PoseUnit, Topic};
use trackdyn::{InspectSettings, Inspection, ReadOptions};

/// Judges a recording; all options are given.
#[pyfunction]
#[pyo3(signature = (path, options, gauge, parameters, runs, time, tau))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn inspect<'py>(
    py: Python<'py>,
    path: PathBuf,
    options: Reading,
    gauge: Option<OfGauge<'py>>,
    parameters: Option<PyRef<'py, Parameters>>,
    runs: Option<&str>,
    time: Option<[f64; 2]>,
    tau: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let settings = InspectSettings {
        read: options.options()?,
        part: part(runs, time)?,
        tau,
        gauge: gauge.map(|gauge| gauge.gauge()).transpose()?,
        parameters: parameters.map(|one| (*one.inner).clone()),
    };
    let found = run(py, None, move |_| trackdyn::inspect(&path, &settings))?;
    judged(py, &found)
}

fn judged<'py>(py: Python<'py>, found: &Inspection) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let content = match &found.content {
        Content::Motion(_) => "motion",
        Content::Points(_) => "points",
        Content::Poses(_) => "poses",
        _ => "unread",
    };
    dict.set_item("name", &found.name)?;
    dict.set_item("content", content)?;
    dict.set_item("fingerprint", &found.fingerprint)?;
    let topics: PyResult<Vec<_>> = found.topics.iter().map(|of| topic(py, of)).collect();
    dict.set_item("topics", topics?)?;
    if let Content::Motion(driving) = &found.content {
        dict.set_item("driving", driven(py, driving)?)?;
    }
    dict.set_item("taken", &found.taken)?;
    let findings: Vec<String> = found.findings.iter().map(ToString::to_string).collect();
    dict.set_item("findings", findings)?;
    let lacks = found.lacks.iter().map(|lack| (lack.to_string(), lack.advice()));
    dict.set_item("lacks", lacks.collect::<Vec<_>>())?;
    let readiness = PyDict::new(py);
    for of in &found.readiness {
        let verdict = match &of.verdict {
            Verdict::Ready => ("yes", ""),
            Verdict::Partly(reason) => ("in part", reason.as_str()),
            Verdict::No(reason) => ("no", reason.as_str()),
        };
        readiness.set_item(of.what.command(), verdict)?;
    }
    dict.set_item("readiness", readiness)?;
    dict.set_item("options", given(py, &found.options)?)?;
    if let Some([first, second]) = &found.parts {
        let part = |of: &trackdyn::Part| (of.runs.as_ref().map(ToString::to_string), of.time);
        dict.set_item("parts", (part(first), part(second)))?;
    }
    if let Some(over_time) = &found.over_time {
        let caption = format!("trackdyn {}", trackdyn::VERSION);
        dict.set_item("figure", Figure::from(over_time.figure(&found.name, &caption)))?;
    }
    Ok(dict)
}

fn topic<'py>(py: Python<'py>, of: &Topic) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("name", &of.name)?;
    dict.set_item("type", &of.kind)?;
    dict.set_item("role", of.role.map(|role| format!("{role:?}").to_lowercase()))?;
    dict.set_item("messages", of.messages)?;
    dict.set_item("duration", of.duration)?;
    dict.set_item("joints", &of.joints)?;
    dict.set_item("signals", &of.signals)?;
    dict.set_item("frames", &of.frames)?;
    Ok(dict)
}

fn driven<'py>(py: Python<'py>, of: &Driving) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("robot", &of.robot)?;
    dict.set_item("runs", of.runs)?;
    dict.set_item("duration", of.duration)?;
    let gyroscope = of.gyroscope.as_ref().map(|found| match found {
        Ok(gyroscope) => (true, gyroscope.to_string()),
        Err(reason) => (false, reason.to_string()),
    });
    dict.set_item("gyroscope", gyroscope)?;
    dict.set_item("has_positions", of.has_positions)?;
    dict.set_item("fastest", of.fastest)?;
    dict.set_item("segments", of.segments)?;
    dict.set_item("distance", of.distance)?;
    dict.set_item("straight", of.straight)?;
    dict.set_item("turned", (of.turned.left, of.turned.right))?;
    dict.set_item("spun", (of.spun.left, of.spun.right))?;
    dict.set_item("standing", of.standing)?;
    dict.set_item("tau", of.clock.as_ref().ok().map(Clock::tau))?;
    let gap = of.separation.as_ref().ok().map(|found| found.gap);
    dict.set_item("separation", gap.map(|gap| (gap.value, gap.low, gap.high)))?;
    Ok(dict)
}

/// The options that are given, as keywords of reading.
fn given<'py>(py: Python<'py>, options: &ReadOptions) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let BagOptions { wheel_radius, separation, mount_yaw, .. } = options.bag;
    let bag = &options.bag;
    let texts = [
        ("tracks_topic", &bag.tracks_topic),
        ("pose_topic", &bag.pose_topic),
        ("parent_frame", &bag.parent_frame),
        ("child_frame", &bag.child_frame),
        ("imu_topic", &bag.imu_topic),
        ("twist_topic", &bag.twist_topic),
    ];
    for (name, text) in texts {
        if let Some(text) = text {
            dict.set_item(name, text)?;
        }
    }
    let lists = [
        ("left_joints", &bag.left_joints),
        ("right_joints", &bag.right_joints),
        ("left_signals", &bag.left_signals),
        ("right_signals", &bag.right_signals),
    ];
    for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
        dict.set_item(name, list)?;
    }
    let numbers =
        [("wheel_radius", wheel_radius), ("separation", separation), ("mount_yaw", mount_yaw)];
    for (name, number) in numbers {
        if let Some(number) = number {
            dict.set_item(name, number)?;
        }
    }
    if bag.pose_unit != PoseUnit::Metres {
        dict.set_item("pose_unit", bag.pose_unit.name())?;
    }
    if bag.pose_axes != PoseAxes::Ros {
        dict.set_item("pose_axes", bag.pose_axes.name())?;
    }
    if let Some(columns) = &options.columns {
        dict.set_item("columns", columns.to_string())?;
    }
    if let Some(index) = bag.pose_index {
        dict.set_item("pose_index", index)?;
    }
    if let Some(unit) = bag.speed_unit {
        dict.set_item("speed_unit", unit.to_string())?;
    }
    if let Some(tracks) = &options.tracks {
        dict.set_item("tracks", tracks)?;
    }
    if bag.gyro_in_degrees {
        dict.set_item("gyro_unit", "deg/s")?;
    }
    let accepted: Vec<&str> = bag.accepted.iter().map(|doubt| doubt.name()).collect();
    if !accepted.is_empty() {
        dict.set_item("accept", accepted)?;
    }
    Ok(dict)
}
