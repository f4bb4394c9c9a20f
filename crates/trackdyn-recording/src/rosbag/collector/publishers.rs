//! Several publishers of the joints. Those that never move, or that repeat what others send, are
//! left out. A second publisher on a topic may send zeros between the readings of the first.
//!
//! # Law
//! A message whose joints are all at exactly 0 and stand still, between two messages of fast
//! joints, is not from the robot: no wheel stops and starts again within a reading. Where a tenth
//! of the steps of a fast robot have such messages between them, a second publisher sends them.
//! What it sends is dropped where at most twice as many zeros follow one another as usually do
//! between fast messages: longer rows of zeros are a robot that stands.

use crate::recording::Warning;
use crate::rosbag::joints::{Column, Source};
use crate::rosbag::names::Part;
use std::collections::BTreeSet;
use trackdyn_core::robust::median;

/// Least portion of the steps between fast messages that have zeros between them.
const MIN_PORTION: f64 = 0.1;

/// Least number of such steps.
const MIN_STEPS: usize = 5;

/// Drops the zeros of a second publisher with the same joints and signals.
pub(super) fn without_zeros(source: &mut Source, warnings: &mut Vec<Warning>) {
    let Some(dropped) = zeros(source) else { return };
    let count = dropped.iter().filter(|dropped| **dropped).count() as u64;
    let mut keep = dropped.iter().map(|dropped| !dropped);
    source.received.retain(|_| keep.next().unwrap_or(true));
    for column in &mut source.columns {
        for values in [&mut column.positions, &mut column.velocities] {
            let mut keep = dropped.iter().map(|dropped| !dropped);
            values.retain(|_| keep.next().unwrap_or(true));
        }
    }
    let topic = source.topic.clone();
    let reason = "all its joints are at zero between messages of joints that move: another \
                  publisher sends them"
        .to_owned();
    warnings.push(Warning::MessagesSkipped { topic, count, reason });
}

/// Which messages are zeros of a second publisher; none where there is none.
fn zeros(source: &Source) -> Option<Vec<bool>> {
    let rows = source.received.len();
    // Size of a message: the largest velocity where there are any, else position.
    let size = |row: usize| {
        let sizes = source.columns.iter().map(|column| {
            let [position, velocity] = column.signals(row).map(f64::abs);
            if velocity.is_nan() { [position, position] } else { [velocity, position] }
        });
        sizes.fold([0.0, 0.0], |sum: [f64; 2], one| [sum[0].max(one[0]), sum[1].max(one[1])])
    };
    let sizes: Vec<[f64; 2]> = (0..rows).map(size).collect();
    let is_zero = |row: usize| sizes[row] == [0.0, 0.0];
    let mut moving: Vec<f64> =
        (0..rows).filter(|&row| !is_zero(row)).map(|row| sizes[row][0]).collect();
    let fast = median(&mut moving)?;
    let others: Vec<usize> = (0..rows).filter(|&row| !is_zero(row)).collect();
    let steps = others
        .windows(2)
        .filter(|pair| sizes[pair[0]][0] >= fast && sizes[pair[1]][0] >= fast)
        .map(|pair| pair[1] - pair[0] - 1);
    let (mut between, mut all): (Vec<usize>, usize) = (Vec::new(), 0);
    for zeros in steps {
        all += 1;
        between.extend(Some(zeros).filter(|zeros| *zeros > 0));
    }
    let parted = between.len();
    if parted < MIN_STEPS || trackdyn_core::real(parted) < MIN_PORTION * trackdyn_core::real(all) {
        return None;
    }
    between.sort_unstable();
    let usual = between[parted * 9 / 10];
    let mut dropped = vec![false; rows];
    let mut start = 0;
    while start < rows {
        let end = (start..rows).find(|&row| !is_zero(row)).unwrap_or(rows);
        if end - start <= 2 * usual {
            dropped[start..end].fill(true);
        }
        start = end + 1;
    }
    Some(dropped)
}

/// Leaves out sources whose joints never move where another source has these joints in motion.
pub(super) fn drop_idle(sources: &mut Vec<Source>, warnings: &mut Vec<Warning>) {
    let moves: Vec<bool> = sources.iter().map(|source| source.columns.iter().any(moves)).collect();
    let moving: BTreeSet<(&str, String)> = sources
        .iter()
        .zip(&moves)
        .filter(|(_, moves)| **moves)
        .flat_map(|(source, _)| {
            source.columns.iter().map(|one| (one.side.name(), one.name.clone()))
        })
        .collect();
    let is_idle = |source: &Source, moves: bool| {
        let mut columns = source.columns.iter().filter(|column| column.part != Part::Other);
        !moves && columns.any(|column| moving.contains(&(column.side.name(), column.name.clone())))
    };
    let mut idle = sources.iter().zip(&moves).map(|(source, moves)| is_idle(source, *moves));
    let idle: Vec<bool> = idle.by_ref().collect();
    for (source, _) in sources.iter().zip(&idle).filter(|(_, idle)| **idle) {
        let (topic, count) = (source.topic.clone(), source.messages);
        let reason = "its joints never move, as they do in other messages: another publisher \
                      sends it"
            .to_owned();
        warnings.push(Warning::MessagesSkipped { topic, count, reason });
    }
    let mut idle = idle.into_iter();
    sources.retain(|_| !idle.next().unwrap_or(false));
}

/// Leaves out sources that tell joints of another source of their topic at its times: of both, the
/// one with velocities stays, else the one with more messages.
pub(super) fn drop_repeated(sources: &mut Vec<Source>, warnings: &mut Vec<Warning>) {
    sources.sort_by_key(|source| {
        let has_velocities = source.columns.iter().any(|column| !column.velocities.is_empty());
        std::cmp::Reverse((has_velocities, source.messages))
    });
    let mut kept: Vec<Source> = Vec::with_capacity(sources.len());
    for source in sources.drain(..) {
        let is_told = |other: &Source| {
            let shares = |one: &Column| other.columns.iter().any(|two| two.name == one.name);
            other.topic == source.topic
                && source.columns.iter().any(shares)
                && is_within(&source, other)
        };
        if kept.iter().any(is_told) {
            let (topic, count) = (source.topic.clone(), source.messages);
            let reason = "other messages tell its joints at these times".to_owned();
            warnings.push(Warning::MessagesSkipped { topic, count, reason });
        } else {
            kept.push(source);
        }
    }
    *sources = kept;
}

/// Whether most messages of a source were logged between the first and the last of another.
fn is_within(source: &Source, other: &Source) -> bool {
    let logged = || other.received.iter().map(|one| one.log_ns);
    let (Some(first), Some(last)) = (logged().min(), logged().max()) else { return false };
    let within = source.received.iter().filter(|one| (first..=last).contains(&one.log_ns));
    2 * within.count() > source.received.len()
}

/// Whether a joint moves at all.
pub(super) fn moves(column: &Column) -> bool {
    let steps = |values: &[f64]| {
        let mut finite = values.iter().filter(|value| value.is_finite());
        let first = finite.next().copied();
        finite.any(|value| Some(*value) != first)
    };
    steps(&column.positions) || column.velocities.iter().any(|v| v.is_finite() && *v != 0.0)
}
