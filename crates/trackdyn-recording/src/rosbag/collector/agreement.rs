//! Whether the joints of a side move alike, and what to do where they do not.

use super::alike::{Likeness, edges, likeness, means, ratio, ratio_all_along, speeds};
use super::joint::{Joint, listed};
use super::signal::Signal;
use crate::recording::Warning;
use std::collections::BTreeMap;
use trackdyn_core::Side;

/// Largest shares by which a joint of a side may always turn faster than another: without a
/// warning, and at all. The mean of both is off by half of it.
const MAX_SILENT_DIFFERENCE: f64 = 0.02;
const MAX_SPEED_DIFFERENCE: f64 = 0.05;

/// Keeps the joints of a side that move, which have to move alike.
///
/// # Errors
/// Which do not, and what to name.
pub(super) fn keep_alike(
    joints: &mut Vec<Joint>,
    side: Side,
    signal: Signal,
    warnings: &mut Vec<Warning>,
) -> Result<(), String> {
    let motions = motions(joints, side, signal);
    let moves: Vec<bool> =
        motions.iter().map(|motion| motion.iter().any(|(_, speed)| *speed != 0.0)).collect();
    if joints.iter().zip(&moves).any(|(joint, moves)| joint.side == side && *moves) {
        let stays = |joint: &Joint, moves: bool| joint.side != side || moves;
        let idle = joints.iter().zip(&moves).filter(|(joint, moves)| !stays(joint, **moves));
        let idle = listed(idle.map(|(joint, _)| joint));
        if !idle.is_empty() {
            let (word, what) = (side.name(), "joints");
            let taken = format!("all {word} ones but {idle}, which never move");
            warnings.push(Warning::Chosen { what, taken });
        }
        let stay = joints.iter().zip(&moves).map(|(joint, moves)| stays(joint, *moves));
        let mut stay = stay.collect::<Vec<bool>>().into_iter();
        joints.retain(|_| stay.next().unwrap_or(true));
    }
    let edges = edges(motions.iter());
    let moving = motions.iter().zip(&moves).filter(|(_, moves)| **moves);
    let means: Vec<Vec<f64>> = moving.map(|(motion, _)| means(motion, &edges)).collect();
    if let Some(problem) = refusal(joints, side, &means) {
        return Err(problem);
    }
    let names: Vec<&str> = names(joints, side);
    let Some((other, ratio)) = faster(&means) else { return Ok(()) };
    if ratio.max(1.0 / ratio) >= 1.0 + MAX_SPEED_DIFFERENCE {
        return Err(one_of_both(joints, side, [names[0], names[other]], ratio));
    }
    warnings.push(told_faster(side, &names, other, ratio));
    Ok(())
}

/// Names of the joints of a side.
fn names(joints: &[Joint], side: Side) -> Vec<&str> {
    let of_side = joints.iter().filter(|joint| joint.side == side);
    of_side.map(|joint| joint.name.as_str()).collect()
}

/// The joint whose speed has the most deviating constant ratio to that of the first joint, and that
/// ratio, first over other. None where no ratio is worth a warning.
fn faster(means: &[Vec<f64>]) -> Option<(usize, f64)> {
    let size = |ratio: f64| ratio.max(1.0 / ratio);
    let all = (1..means.len()).filter_map(|at| {
        let ratio = ratio_all_along(&means[0], &means[at])?;
        (size(ratio) >= 1.0 + MAX_SILENT_DIFFERENCE).then_some((at, ratio))
    });
    all.max_by(|(_, a), (_, b)| size(*a).total_cmp(&size(*b)))
}

/// How much faster a joint turns than another one.
fn faster_by([first, second]: [&str; 2], ratio: f64) -> String {
    format!(
        "{first} turns {ratio:.3} times as far as {second} all along (wheels of other sizes, or a \
         gear)"
    )
}

/// What is said of joints that turn nearly as far as each other.
fn told_faster(side: Side, names: &[&str], other: usize, ratio: f64) -> Warning {
    let what = if side == Side::Left { "left joints" } else { "right joints" };
    let told = faster_by([names[0], names[other]], ratio);
    let (names, word) = (names.join(", "), side.name());
    let taken = format!("the mean of {names}, but {told}; --{word}-joint takes one of them");
    Warning::Chosen { what, taken }
}

/// Why two joints are not taken together that turn by a fixed ratio, and the options that take one
/// of them on each side.
fn one_of_both(joints: &[Joint], side: Side, pair: [&str; 2], ratio: f64) -> String {
    let others = names(joints, side.other());
    let own = names(joints, side);
    let option = |name: &str| {
        let place = own.iter().position(|one| *one == name);
        // Joints of an axle stand at the same place, where there are as many on the other side.
        let beside = place.and_then(|at| others.get(at)).filter(|_| own.len() == others.len());
        let named = format!("--{}-joint {name}", side.name());
        let beside = beside.map(|beside| format!("--{}-joint {beside}", side.other().name()));
        match (side, beside) {
            (_, None) => named,
            (Side::Left, Some(beside)) => format!("{named} {beside}"),
            (Side::Right, Some(beside)) => format!("{beside} {named}"),
        }
    };
    let [first, second] = pair.map(option);
    format!(
        "{}: one --wheel-radius does not fit both. Take one of them on each side, with its own \
         radius, by {first} or by {second}",
        faster_by(pair, ratio)
    )
}

/// What is to be said of joints that the options name and that do not move alike.
pub(super) fn told_apart(joints: &[Joint], side: Side, signal: Signal) -> Option<Warning> {
    let motions = motions(joints, side, signal);
    let edges = edges(motions.iter());
    let of_side = joints.iter().zip(&motions).filter(|(joint, _)| joint.side == side);
    let (names, means): (Vec<&str>, Vec<Vec<f64>>) = of_side
        .map(|(joint, motion)| {
            let means = means(motion, &edges);
            (joint.name.as_str(), means.iter().map(|mean| joint.sign * mean).collect())
        })
        .unzip();
    let apart = (1..means.len()).find(|&at| likeness(&means[0], &means[at]) != Likeness::Alike);
    let Some(apart) = apart else {
        let (other, ratio) = faster(&means)?;
        return Some(told_faster(side, &names, other, ratio));
    };
    let what = if side == Side::Left { "left joints" } else { "right joints" };
    let apart = apart_from(names[0], names[apart], &means[0], &means[apart]);
    Some(Warning::Chosen { what, taken: format!("the mean of {}, but {apart}", names.join(", ")) })
}

/// Speeds of the joints of a side; none of the others.
fn motions(joints: &[Joint], side: Side, signal: Signal) -> Vec<Vec<(i64, f64)>> {
    let motion = |joint: &Joint| match joint.side {
        of if of == side => speeds(&joint.signals, signal == Signal::Position),
        _ => Vec::new(),
    };
    joints.iter().map(motion).collect()
}

/// Why the joints of a side cannot be taken together; none where they can. `means` are those of the
/// joints of the side, in their order.
fn refusal(joints: &[Joint], side: Side, means: &[Vec<f64>]) -> Option<String> {
    let of_side = joints.iter().filter(|joint| joint.side == side);
    let names: Vec<&str> = of_side.map(|joint| joint.name.as_str()).collect();
    let how: Vec<Likeness> = means.iter().map(|motion| likeness(&means[0], motion)).collect();
    let word = side.name();
    if let Some(apart) = how.iter().position(|how| *how == Likeness::Apart) {
        let told = apart_from(names[0], names[apart], &means[0], &means[apart]);
        return Some(match robots(joints, side, means) {
            Some(robots) => format!("{told}: {robots}"),
            None => format!(
                "{told}: one of them may be no wheel or track. Name the joints of the tracks by \
                 --left-joint and --right-joint; the {word} side has {}",
                names.join(", ")
            ),
        });
    }
    let reversed = how.iter().position(|how| *how == Likeness::Reversed)?;
    // The sense of most of them is the right one.
    let count = how.iter().filter(|how| **how == Likeness::Reversed).count();
    let minus = if 2 * count > how.len() { Likeness::Alike } else { Likeness::Reversed };
    let options = names.iter().zip(&how).map(|(name, how)| {
        let sign = if *how == minus { "-" } else { "" };
        format!("--{word}-joint {sign}{name}")
    });
    Some(format!(
        "{} counts backwards beside {}; a - before a name reverses a joint: name those of the \
         {word} side by {}",
        names[reversed],
        names[0],
        options.collect::<Vec<_>>().join(" ")
    ))
}

/// How two joints differ.
fn apart_from(first: &str, second: &str, a: &[f64], b: &[f64]) -> String {
    match ratio(a, b) {
        Some(ratio) => format!(
            "{first} and {second} do not move alike: the first turns {ratio:.2} times as far (a \
             gear or another unit)"
        ),
        None => format!("{first} and {second} do not move alike"),
    }
}

/// The options that take one of several robots, which the parts of the names before the last slash
/// tell apart; none where they do not.
fn robots(joints: &[Joint], side: Side, means: &[Vec<f64>]) -> Option<String> {
    let robot = |joint: &Joint| joint.name.rsplit_once('/').map(|(robot, _)| robot.to_owned());
    let mut robots: BTreeMap<String, Vec<&Joint>> = BTreeMap::new();
    for joint in joints {
        robots.entry(robot(joint)?).or_default().push(joint);
    }
    let of_side = joints.iter().filter(|joint| joint.side == side).zip(means);
    let of_side: Vec<(String, &Vec<f64>)> =
        of_side.filter_map(|(joint, means)| Some((robot(joint)?, means))).collect();
    let is_one = |name: &String| {
        let mut own = of_side.iter().filter(|(of, _)| of == name).map(|(_, means)| *means);
        let first = own.next();
        first.is_some_and(|first| own.all(|next| likeness(first, next) == Likeness::Alike))
    };
    let has_both = |joints: &[&Joint]| {
        Side::BOTH.into_iter().all(|side| joints.iter().any(|joint| joint.side == side))
    };
    if robots.len() < 2 || !robots.iter().all(|(name, own)| is_one(name) && has_both(own)) {
        return None;
    }
    let options = robots.iter().map(|(name, own)| {
        let option = |joint: &&Joint| format!("--{}-joint {}", joint.side.name(), joint.name);
        let options: Vec<String> = own.iter().map(option).collect();
        format!("{} are those of {name}", options.join(" "))
    });
    Some(format!("joints of several robots; {}", options.collect::<Vec<_>>().join(", ")))
}
