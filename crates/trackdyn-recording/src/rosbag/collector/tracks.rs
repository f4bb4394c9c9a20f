//! Which joints turn the tracks.
//!
//! Joints that are not named are chosen by the words of their names, then by their motion: those of
//! a side have to move alike.

use super::agreement::{keep_alike, told_apart};
use super::joint::{Joint, listed};
use super::publishers::{drop_idle, drop_repeated, without_zeros};
use super::signal::{self, Signal};
use crate::recording::Warning;
use crate::rosbag::joints::{Column, Source};
use crate::rosbag::names::Part;
use crate::rosbag::options::RosbagOptions;
use std::collections::BTreeSet;
use trackdyn_core::{PerSide, Side};

/// The joints that were chosen.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    pub(super) joints: Vec<Joint>,
    pub(super) signal: Signal,
}

/// Chooses the joints of both sides.
///
/// # Errors
/// Why none or several could be it.
pub(super) fn choose(
    mut sources: Vec<Source>,
    options: &RosbagOptions,
    warnings: &mut Vec<Warning>,
) -> Result<Chosen, String> {
    for source in &mut sources {
        without_zeros(source, warnings);
    }
    drop_idle(&mut sources, warnings);
    let taken = topics(&sources, options)?;
    if options.tracks_topic.is_none() {
        let what = "track speeds";
        warnings.push(Warning::Chosen { what, taken: taken.join(", ") });
    }
    sources.retain(|source| taken.contains(&source.topic));
    drop_repeated(&mut sources, warnings);
    let (mut joints, left_out) = joints(sources);
    drop_silent(&mut joints, options, warnings);
    let signal = signal::choose(&joints, options.joint_signal, warnings)?;
    for side in Side::BOTH {
        let named = match side {
            Side::Left => &options.left_joints,
            Side::Right => &options.right_joints,
        };
        if named.is_empty() {
            keep_alike(&mut joints, side, signal, warnings)?;
            let taken = listed(joints.iter().filter(|joint| joint.side == side));
            let what = if side == Side::Left { "left joints" } else { "right joints" };
            let taken = match left_out[side].join(", ") {
                out if out.is_empty() => taken,
                out => format!("{taken}; {out} left out, by the name no wheel or track"),
            };
            warnings.push(Warning::Chosen { what, taken });
        } else {
            warnings.extend(told_apart(&joints, side, signal));
        }
    }
    Ok(Chosen { joints, signal })
}

/// The topics to take joints from: the only one with both sides, else all with one of them.
fn topics(sources: &[Source], options: &RosbagOptions) -> Result<Vec<String>, String> {
    let with = |side: Side| -> BTreeSet<&str> {
        let has = |source: &&Source| {
            source.columns.iter().any(|column| column.side == side && column.part != Part::Other)
        };
        sources.iter().filter(has).map(|source| source.topic.as_str()).collect()
    };
    let [left, right] = Side::BOTH.map(with);
    let both: Vec<String> = left.intersection(&right).map(|&topic| topic.to_owned()).collect();
    match both.as_slice() {
        [_] => return absent(sources, options, &both).map_or(Ok(both), Err),
        [] => {}
        several => {
            let several = several.join(", ");
            return Err(format!("several fit: {several}; choose by --tracks-topic"));
        }
    }
    let all: Vec<String> = left.union(&right).map(|&topic| topic.to_owned()).collect();
    absent(sources, options, &all).map_or(Ok(all), Err)
}

/// Why the topics do not have what is needed; none where they do.
fn absent(sources: &[Source], options: &RosbagOptions, topics: &[String]) -> Option<String> {
    let of_topics = || sources.iter().filter(|source| topics.contains(&source.topic));
    let found = |side: Side, name: &str| {
        let bare = name.strip_prefix('-');
        let mut columns = of_topics().flat_map(|source| &source.columns);
        columns.any(|one| one.side == side && (one.name == name || Some(&*one.name) == bare))
    };
    let lacks = |side: Side| {
        let named = match side {
            Side::Left => &options.left_joints,
            Side::Right => &options.right_joints,
        };
        let word = side.name();
        if named.is_empty() {
            let has = |column: &Column| column.side == side && column.part != Part::Other;
            let has = of_topics().flat_map(|source| &source.columns).any(has);
            let option = format!("--{word}-joint");
            return (!has).then(|| {
                format!(
                    "no joint of a wheel or track has {word:?} in its name (name it by {option})"
                )
            });
        }
        let all = named.iter().all(|name| found(side, name));
        (!all).then(|| format!("not all of the {word} joints ({}) are in it", named.join(", ")))
    };
    let reason = Side::BOTH.into_iter().find_map(lacks)?;
    let mut problem = "no sensor_msgs/JointState or DynamicJointState with both sides".to_owned();
    let mut told: Vec<&Source> = Vec::new();
    for source in sources {
        let is_it = |other: &&Source| other.topic == source.topic && other.names == source.names;
        if told.len() < MAX_LISTED_KINDS && !told.iter().any(is_it) {
            told.push(source);
        }
    }
    for source in told {
        let (topic, messages, names) = (&source.topic, source.messages, source.names.join(", "));
        let skipped =
            format!("; {topic}: {messages} messages skipped, because {reason}, but {names}");
        problem.push_str(&skipped);
    }
    Some(problem)
}

/// Most kinds of messages that an error lists.
const MAX_LISTED_KINDS: usize = 8;

/// The joints of these sources, and those that their names leave out.
fn joints(sources: Vec<Source>) -> (Vec<Joint>, PerSide<Vec<String>>) {
    let mut joints: Vec<Joint> = Vec::new();
    for source in sources {
        for column in &source.columns {
            let signals = source.received.iter().enumerate();
            let signals = signals.map(|(row, one)| one.with(column.signals(row)));
            let known = joints.iter_mut().find(|joint| {
                joint.name == column.name
                    && joint.topic == source.topic
                    && joint.side == column.side
            });
            if let Some(joint) = known {
                joint.signals.extend(signals);
            } else {
                joints.push(Joint {
                    name: column.name.clone(),
                    topic: source.topic.clone(),
                    side: column.side,
                    sign: column.sign,
                    part: column.part,
                    signals: signals.collect(),
                });
            }
        }
    }
    for joint in &mut joints {
        joint.signals.sort_by_key(|one| one.log_ns);
    }
    let best = PerSide::from_fn(|side| {
        joints.iter().filter(|joint| joint.side == side).map(|joint| joint.part).max()
    });
    let mut left_out = PerSide::new(Vec::new(), Vec::new());
    joints.retain(|joint| {
        let stays = Some(joint.part) == best[joint.side];
        if !stays {
            left_out[joint.side].push(joint.name.clone());
        }
        stays
    });
    (joints, left_out)
}

/// Leaves out joints without numbers beside others of their side; those that the options name stay.
fn drop_silent(joints: &mut Vec<Joint>, options: &RosbagOptions, warnings: &mut Vec<Warning>) {
    let is_named = PerSide::new(!options.left_joints.is_empty(), !options.right_joints.is_empty());
    let speaks = PerSide::from_fn(|side| {
        joints.iter().any(|joint| joint.side == side && !signal::is_silent(joint))
    });
    let is_left_out =
        |joint: &Joint| signal::is_silent(joint) && speaks[joint.side] && !is_named[joint.side];
    let silent = listed(joints.iter().filter(|joint| is_left_out(joint)));
    joints.retain(|joint| !is_left_out(joint));
    if !silent.is_empty() {
        let taken = format!("all but {silent}, which have no number in most messages");
        warnings.push(Warning::Chosen { what: "joints", taken });
    }
}
