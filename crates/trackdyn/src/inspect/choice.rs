//! What a bag leaves to its user: each choice is tried.

use super::bag::{Read, read};
use super::{Driving, Finding};
use crate::ReadOptions;
use std::path::Path;
use trackdyn_estimate::Contradiction;
use trackdyn_recording::rosbag::{self, Role};

/// Most sources of poses that are tried: each takes as long as reading the bag.
const MAX_TRIED_SOURCES: usize = 4;

/// What comes of trying.
pub(super) enum Choice {
    /// One of them does.
    One(Box<Read>),
    /// Several do, by these options.
    Several(Vec<ReadOptions>),
    /// None does, or there is nothing to choose.
    None,
}

/// Reads a bag by each of its poses where it has several, and by its only two joints where their
/// names tell no sides: how the poses turn tells them. Poses that are computed from the tracks are
/// none to take where there are others. `reason` is why the bag is not read without a choice.
pub(super) fn of(
    path: &Path,
    given: &ReadOptions,
    seen: &rosbag::Inspection,
    reason: &str,
) -> Choice {
    let joints = joints(given, seen);
    let base = joints.clone().unwrap_or_else(|| given.clone());
    let poses = poses(given, seen);
    let tries: Vec<ReadOptions> = match poses.as_slice() {
        [_, _, ..] => poses.iter().map(|topic| with_poses(&base, topic)).collect(),
        _ if joints.is_some() => vec![base],
        _ => return Choice::None,
    };
    if tries.len() > MAX_TRIED_SOURCES {
        return Choice::Several(tries);
    }
    let tried = tries.iter().filter_map(|options| read(path, options, &seen.suggested).ok());
    let of_other = |read: &Read| joints.is_none() || turns(read);
    let (computed, others): (Vec<Read>, Vec<Read>) = tried.filter(of_other).partition(is_computed);
    // Where there are no others, it is said of these what they are.
    let (mut found, computed) =
        if others.is_empty() { (computed, Vec::new()) } else { (others, computed) };
    if found.len() > 1 {
        return Choice::Several(found.into_iter().map(|read| read.options).collect());
    }
    let Some(mut read) = found.pop() else { return Choice::None };
    let took = took(&read, joints.is_some(), &computed);
    read.findings.insert(0, Finding::Mended(format!("{reason}: {took}")));
    Choice::One(Box::new(read))
}

/// The options given with the only two joints, where no side is named.
fn joints(given: &ReadOptions, seen: &rosbag::Inspection) -> Option<ReadOptions> {
    let (bag, suggested) = (&given.bag, &seen.suggested);
    let are_known = [&bag.left_joints, &bag.right_joints, &bag.left_signals, &bag.right_signals]
        .into_iter()
        .chain([&suggested.left_joints, &suggested.right_joints, &suggested.left_signals])
        .any(|names| !names.is_empty());
    if are_known || bag.twist_topic.is_some() || suggested.twist_topic.is_some() {
        return None;
    }
    let mut topics = seen.topics.iter().filter(|topic| !topic.joints.is_empty());
    let (Some(topic), None) = (topics.next(), topics.next()) else { return None };
    let [first, second] = topic.joints.as_slice() else { return None };
    let mut options = given.clone();
    options.bag.left_joints = vec![first.clone()];
    options.bag.right_joints = vec![second.clone()];
    Some(options)
}

/// The topics of poses among which the user has not chosen.
fn poses<'a>(given: &ReadOptions, seen: &'a rosbag::Inspection) -> Vec<&'a str> {
    let bag = &given.bag;
    let is_chosen =
        [&bag.pose_topic, &bag.parent_frame, &bag.child_frame, &seen.suggested.pose_topic]
            .into_iter()
            .any(Option::is_some);
    if is_chosen {
        return Vec::new();
    }
    let of_poses = seen.topics.iter().filter(|topic| topic.role == Some(Role::Poses));
    let named = of_poses.filter(|topic| topic.messages > 0).map(|topic| topic.name.as_str());
    named.collect()
}

fn with_poses(options: &ReadOptions, topic: &str) -> ReadOptions {
    let mut options = options.clone();
    options.bag.pose_topic = Some(topic.to_owned());
    options
}

/// Whether poses and tracks turn, so that sides which are swapped would show.
fn turns(read: &Read) -> bool {
    let driving = read.recording.motion().map(|motion| Driving::of(motion, None));
    driving.is_some_and(|driving| driving.separation.is_ok())
}

/// Whether the poses are computed from the tracks.
fn is_computed(read: &Read) -> bool {
    let Some(motion) = read.recording.motion() else { return false };
    let gap = Driving::of(motion, None).separation.map(|found| found.gap.value);
    let Ok(gauge) = crate::Gauge::new(super::readiness::usual_gauge(gap.ok())) else {
        return false;
    };
    let found = read.recording.contradictions(gauge, None);
    found.iter().any(|of| matches!(of, Contradiction::WheelOdometry { .. }))
}

/// What was taken, in words; of joints, where no side was named.
fn took(read: &Read, has_told_sides: bool, computed: &[Read]) -> String {
    let bag = &read.options.bag;
    let mut words = Vec::new();
    if let Some(topic) = &bag.pose_topic {
        words.push(topic.clone());
    }
    if has_told_sides {
        let (left, right) = (bag.left_joints.join(", "), bag.right_joints.join(", "));
        words.push(format!("{left} for the left and {right} for the right, as the poses turn"));
    }
    let topics = computed.iter().filter_map(|of| of.options.bag.pose_topic.clone());
    let topics: Vec<String> = topics.collect();
    let other = match topics.as_slice() {
        [] => String::new(),
        topics => format!("; wheel odometry, computed from the tracks: {}", topics.join(", ")),
    };
    format!("took {}{other}", words.join(", and "))
}
