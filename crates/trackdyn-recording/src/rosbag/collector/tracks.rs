//! Which joints turn the tracks.
//!
//! Joints that are not named are chosen by the words of their names, then by their motion: those of
//! a side have to move alike.

use super::alike::{Likeness, edges, likeness, means, speeds};
use super::joint::{Joint, listed};
use super::publishers::{drop_idle, drop_repeated, without_zeros};
use super::signal::{self, Signal};
use crate::recording::Warning;
use crate::rosbag::joints::{Column, Source};
use crate::rosbag::names::{Part, word};
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
        let word = word(side);
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
        if told.len() < MAX_TOLD && !told.iter().any(is_it) {
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
const MAX_TOLD: usize = 8;

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

/// Keeps the joints of a side that move, which have to move alike.
fn keep_alike(
    joints: &mut Vec<Joint>,
    side: Side,
    signal: Signal,
    warnings: &mut Vec<Warning>,
) -> Result<(), String> {
    let motions: Vec<Vec<(i64, f64)>> = joints
        .iter()
        .map(|joint| {
            if joint.side == side {
                speeds(&joint.signals, signal == Signal::Position)
            } else {
                Vec::new()
            }
        })
        .collect();
    let moves: Vec<bool> =
        motions.iter().map(|motion| motion.iter().any(|(_, speed)| *speed != 0.0)).collect();
    if joints.iter().zip(&moves).any(|(joint, moves)| joint.side == side && *moves) {
        let stays = |joint: &Joint, moves: bool| joint.side != side || moves;
        let idle = joints.iter().zip(&moves).filter(|(joint, moves)| !stays(joint, **moves));
        let idle = listed(idle.map(|(joint, _)| joint));
        if !idle.is_empty() {
            let (word, what) = (word(side), "joints");
            let taken = format!("all {word} ones but {idle}, which never move");
            warnings.push(Warning::Chosen { what, taken });
        }
        let mut stay = joints.iter().zip(&moves).map(|(joint, moves)| stays(joint, *moves));
        let stay: Vec<bool> = stay.by_ref().collect();
        let mut stay = stay.into_iter();
        joints.retain(|_| stay.next().unwrap_or(true));
    }
    let edges = edges(motions.iter());
    let mut moving = motions.iter().zip(&moves).filter(|(_, moves)| **moves);
    let means: Vec<Vec<f64>> = moving.by_ref().map(|(motion, _)| means(motion, &edges)).collect();
    let names: Vec<&str> =
        joints.iter().filter(|joint| joint.side == side).map(|joint| joint.name.as_str()).collect();
    let word = word(side);
    for (place, motion) in means.iter().enumerate().skip(1) {
        let how = match likeness(&means[0], motion) {
            Likeness::Alike => continue,
            Likeness::Reversed => format!(
                "{} counts backwards beside {}; a - before a name reverses a joint",
                names[place], names[0]
            ),
            Likeness::Apart => format!(
                "{} and {} do not move alike: one of them may be no wheel or track",
                names[0], names[place]
            ),
        };
        let options: Vec<String> =
            names.iter().map(|name| format!("--{word}-joint {name}")).collect();
        return Err(format!(
            "{how}. Name the joints of the tracks by --left-joint and --right-joint; those of the \
             {word} side are {}",
            options.join(" ")
        ));
    }
    Ok(())
}
