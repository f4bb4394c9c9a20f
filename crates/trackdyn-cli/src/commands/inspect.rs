//! `trackdyn inspect`: what a recording holds.

use crate::commands::Outcome;
use crate::commands::identify::lagging_points;
use crate::exit::Exit;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trackdyn::crates::estimate::clock::{ClockSearch, clock_offset};
use trackdyn::crates::recording::rosbag::{self, RosbagOptions};
use trackdyn::crates::recording::{
    Error as ReadError, Format, OperatingPoint, Recording as Motion, Run, tum,
};
use trackdyn::recording::PointsTable;
use trackdyn::{ReadOptions, Recording};

/// Options of `trackdyn inspect`.
#[derive(Args)]
pub struct Options {
    /// Folder with recording.toml, bag of ROS (.mcap, .db3, .bag or their folder), or trajectory
    /// of the TUM benchmark (.tum, .txt), or table of steady operating points (.csv)
    recording: PathBuf,
    /// Trajectory: its track speeds, of the same clock (CSV with t, v_left, v_right)
    #[arg(long, value_name = "FILE")]
    tracks: Option<PathBuf>,
}

/// Lists the topics of a bag with the options that they suggest, or the runs of a recording.
pub fn run(options: &Options) -> Outcome {
    let path = &options.recording;
    let is_table = Recording::points_file(path).is_some();
    if is_table && options.tracks.is_some() {
        return Err(format!(
            "--tracks: {} is a table of steady motion, which has them: expected with a trajectory",
            path.display()
        )
        .into());
    }
    let text = match (is_table, options.tracks.is_none()) {
        (false, true) if Format::of(path)? == Format::Rosbag => bag(path)?,
        (false, true) if Format::of(path)? == Format::Tum => trajectory(path)?,
        _ => {
            let read = ReadOptions { tracks: options.tracks.clone(), ..ReadOptions::default() };
            let recording = Recording::open(path, &read)?;
            let of_points = recording.points().map(points);
            of_points.or_else(|| recording.motion().map(runs)).unwrap_or_default()
        }
    };
    show(&text)?;
    Ok(Exit::Done)
}

/// A trajectory alone, and the option that adds its track speeds.
fn trajectory(path: &Path) -> Result<String, ReadError> {
    let poses = tum::read_poses(path)?.samples;
    let (first, last) = (poses.first().map_or(0.0, |p| p.t), poses.last().map_or(0.0, |p| p.t));
    Ok(format!(
        "{}: trajectory, {} poses, t = {first:.3} to {last:.3} s\n\nsuggested: --tracks \
        TRACKS.csv\n",
        path.display(),
        poses.len()
    ))
}

/// A table of operating points: its speeds, what was measured, and the points that lag.
fn points(table: &PointsTable) -> String {
    let points = table.points();
    let measured = |of: fn(&OperatingPoint) -> Option<f64>| points.iter().filter_map(of).count();
    let mut text = format!(
        "{}: {} steady operating points; measured: {} forward speeds, {} lateral speeds, {} yaw \
        rates\n",
        table.name(),
        points.len(),
        measured(|point| point.v_forward),
        measured(|point| point.v_lateral),
        measured(|point| point.yaw_rate)
    );
    for (side, speed) in [
        ("left", (|point| point.v_left) as fn(&OperatingPoint) -> f64),
        ("right", |point| point.v_right),
    ] {
        let low = points.iter().map(speed).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(speed).fold(f64::NEG_INFINITY, f64::max);
        let _ = writeln!(text, "{side} track {low:.3} to {high:.3} m/s");
    }
    text + &lagging_points(points)
}

/// The topics of a bag, and the options that read it.
fn bag(path: &Path) -> Result<String, ReadError> {
    let inspection = rosbag::inspect(path)?;
    let mut text = format!("{:>9} {:>9}  {:40} type\n", "messages", "seconds", "topic");
    for topic in &inspection.topics {
        let (count, seconds) = (topic.messages, topic.duration);
        let _ = writeln!(text, "{count:>9} {seconds:>9.1}  {:40} {}", topic.name, topic.kind);
        if !topic.joints.is_empty() {
            let (joints, signals) = (topic.joints.join(", "), topic.signals.join(", "));
            let _ = writeln!(text, "{:21}joints: {joints} ({signals})", "");
        }
        for (parent, child) in &topic.frames {
            let _ = writeln!(text, "{:21}frames: {parent} -> {child}", "");
        }
    }
    let _ = writeln!(text, "\nsuggested:{}", suggestion(&inspection.suggested));
    for warning in &inspection.warnings {
        say(format_args!("note: {warning}"));
    }
    Ok(text)
}

/// The options of the command line that read the bag so.
fn suggestion(options: &RosbagOptions) -> String {
    let mut text = String::new();
    let mut add = |name: &str, value: &str| {
        let _ = write!(text, " --{name} {value}");
    };
    if let Some(topic) = &options.tracks_topic {
        add("tracks-topic", topic);
    }
    for joint in &options.left_joints {
        add("left-joint", joint);
    }
    for joint in &options.right_joints {
        add("right-joint", joint);
    }
    if let Some(topic) = &options.pose_topic {
        add("pose-topic", topic);
    }
    if let Some(frame) = &options.parent_frame {
        add("parent-frame", frame);
    }
    if let Some(frame) = &options.child_frame {
        add("child-frame", frame);
    }
    if let Some(topic) = &options.twist_topic {
        add("twist-topic", topic);
        add("separation", "METRES");
    } else if options.wheel_radius.is_none() {
        add("wheel-radius", "METRES");
    }
    text
}

/// The runs of a recording, and its clocks.
fn runs(recording: &Motion) -> String {
    let runs = recording.runs();
    let total = |count: fn(&Run) -> usize| runs.iter().map(count).sum::<usize>();
    let mut text = format!(
        "{}: robot {}, fingerprint {}\n",
        recording.name(),
        recording.robot(),
        recording.fingerprint()
    );
    let _ = writeln!(
        text,
        "{} runs, {:.0} s, {} readings of the tracks, {} poses, {} readings of an IMU",
        runs.len(),
        runs.iter().map(Run::duration).sum::<f64>(),
        total(|run| run.tracks().len()),
        total(|run| run.poses().len()),
        total(|run| run.imu().len()),
    );
    let _ = match clock_offset(recording, &ClockSearch::default()) {
        Ok(offset) => writeln!(
            text,
            "poses come {:.3} s after the tracks (standard error {:.3} s)",
            offset.tau, offset.standard_error
        ),
        Err(reason) => writeln!(text, "{reason}"),
    };
    for warning in recording.warnings() {
        say(format_args!("note: {warning}"));
    }
    text
}
