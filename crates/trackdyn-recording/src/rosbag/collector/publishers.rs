//! Several publishers of one topic: one that never moves sends zeros between the readings of the
//! other.
//!
//! # Law
//! A message whose joints are all at exactly 0 and stand still, between two messages of fast
//! joints, is not from the robot: no wheel stops and starts again within a reading. Where a tenth
//! of the steps of a fast robot have such messages between them, a second publisher sends them.
//! What it sends is dropped where at most twice as many zeros follow one another as usually do between
//! fast messages: longer rows of zeros are a robot that stands.

use crate::recording::Warning;
use crate::rosbag::joints::Source;
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
