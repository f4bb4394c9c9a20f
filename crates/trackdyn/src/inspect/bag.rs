//! Reading a bag by the options given and those that it needs.

use super::{Driving, Finding};
use crate::{ReadOptions, Recording};
use std::path::Path;
use trackdyn_core::PerSide;
use trackdyn_recording::rosbag::RosbagOptions;
use trackdyn_recording::{Doubt, Error, SpeedUnit};

/// Radius that is assumed where none is given, m: that of no robot is so far from it that units
/// would look mixed up.
const ASSUMED_RADIUS: f64 = 0.1;

/// Times that a bag is read, each with what the one before showed.
const MAX_READINGS: usize = 5;

/// A bag that can be read.
pub(super) struct Read {
    pub(super) recording: Recording,
    /// The options given, and those that it needs.
    pub(super) options: ReadOptions,
    /// The radius that was assumed, m, where none is given; else 1.
    pub(super) speed_unit: f64,
    /// What was mended by an option.
    pub(super) findings: Vec<Finding>,
}

/// Reads a bag. Where the options given leave a choice, those that its topics suggest are taken;
/// where tracks and poses contradict each other by signs or sides, the joints that agree.
///
/// # Errors
/// The options tried last, and why they do not do.
pub(super) fn read(
    path: &Path,
    given: &ReadOptions,
    suggested: &RosbagOptions,
) -> Result<Read, (ReadOptions, String)> {
    let (mut options, mut radius) = (given.clone(), ASSUMED_RADIUS);
    let mut findings = Vec::new();
    let (mut reason, mut is_measured) = (String::new(), false);
    for _ in 0..MAX_READINGS {
        let is_open = options.bag.wheel_radius.is_none() && options.bag.counts_wheels();
        let mut tried = options.clone();
        if is_open {
            tried.bag.wheel_radius = Some(radius);
        }
        let error = match Recording::open(path, &tried) {
            Ok(recording) => {
                let found = if is_open { by_travel(&recording) } else { None };
                if let Some(ratio) = found.filter(|ratio| is_off(*ratio) && !is_measured) {
                    radius *= ratio;
                    is_measured = true;
                    continue;
                }
                if is_open && found.is_some() && is_of_tracks(radius, &options.bag) {
                    findings.push(Finding::Mended(format!(
                        "by the way of the poses, these speeds would be of wheels whose radius is \
                         {radius:.2} m: those of the tracks in m/s"
                    )));
                    options.bag.speed_unit = Some(SpeedUnit::MetresPerSecond);
                    continue;
                }
                let speed_unit = if is_open { radius } else { 1.0 };
                return Ok(Read { recording, options, speed_unit, findings });
            }
            Err(crate::Error::Recording(error)) => error,
            Err(error) => return Err((options, without_path(path, &error))),
        };
        reason = without_path(path, &error);
        match error {
            Error::Topic { .. } if options == *given => {
                fill(&mut options.bag, suggested);
                if options == *given {
                    break;
                }
            }
            Error::Contradiction { doubt: Doubt::Travel { ratio, .. }, .. }
                if is_open && radius == ASSUMED_RADIUS =>
            {
                radius /= ratio;
            }
            Error::Contradiction { joints: Some(joints), .. } if findings.is_empty() => {
                findings.push(Finding::Mended(reason.clone()));
                let (bag, PerSide { left, right }) = (&mut options.bag, *joints);
                if bag.left_signals.is_empty() {
                    (bag.left_joints, bag.right_joints) = (left, right);
                } else {
                    (bag.left_signals, bag.right_signals) = (left, right);
                }
            }
            _ => break,
        }
    }
    Err((options, reason))
}

/// The message of an error without the recording, which stands above it.
fn without_path(path: &Path, error: &dyn std::error::Error) -> String {
    let text = error.to_string();
    let rest = text.strip_prefix(&format!("{}: ", path.display())).map(str::to_owned);
    rest.unwrap_or(text)
}

/// Way of the poses per way of the tracks: by it an assumed radius is wrong.
fn by_travel(recording: &Recording) -> Option<f64> {
    Driving::of(recording.motion()?, None).travel_ratio
}

/// Whether a radius is so wrong that a fit would say so.
fn is_off(ratio: f64) -> bool {
    const TOLERANCE: f64 = 0.02;
    ratio > 0.0 && (ratio - 1.0).abs() > TOLERANCE
}

/// Whether speeds of such wheels are those of the tracks, m/s: no wheel has a radius of 1 m.
fn is_of_tracks(radius: f64, options: &RosbagOptions) -> bool {
    const TOLERANCE: f64 = 0.1;
    options.speed_unit.is_none() && (radius - 1.0).abs() < TOLERANCE
}

/// Takes what is suggested where nothing is said.
fn fill(options: &mut RosbagOptions, suggested: &RosbagOptions) {
    let take = |option: &mut Option<String>, suggested: &Option<String>| {
        if option.is_none() {
            option.clone_from(suggested);
        }
    };
    if options.pose_topic.is_none() && options.parent_frame.is_none() {
        take(&mut options.pose_topic, &suggested.pose_topic);
        take(&mut options.parent_frame, &suggested.parent_frame);
        take(&mut options.child_frame, &suggested.child_frame);
    }
    if !options.left_signals.is_empty() || options.twist_topic.is_some() {
        return;
    }
    take(&mut options.twist_topic, &suggested.twist_topic);
    if options.twist_topic.is_some() {
        // No wheel counts.
        options.wheel_radius = None;
    }
    take(&mut options.tracks_topic, &suggested.tracks_topic);
    if options.tracks_topic.is_none() && options.left_joints.is_empty() {
        options.left_signals.clone_from(&suggested.left_signals);
        options.right_signals.clone_from(&suggested.right_signals);
    }
    let sides = [
        (&mut options.left_joints, &suggested.left_joints),
        (&mut options.right_joints, &suggested.right_joints),
    ];
    for (joints, suggested) in sides.into_iter().filter(|(joints, _)| joints.is_empty()) {
        joints.clone_from(suggested);
    }
}
