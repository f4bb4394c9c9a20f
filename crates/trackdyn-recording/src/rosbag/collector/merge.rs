//! Joints of several messages, brought onto common times.

use crate::recording::MIN_GAP_RATIO;
use crate::rosbag::date::{Stamped, seconds};
use trackdyn_core::robust::median;
use trackdyn_core::{PerSide, Side};

/// A signal of one joint of a side.
pub(super) struct SideSignal {
    pub(super) side: Side,
    /// In the order of the bag; a joint that counts backwards has the opposite sign already.
    pub(super) values: Vec<Stamped<f64>>,
}

/// Means of both sides, and how many times were left out.
pub(super) struct Merged {
    pub(super) sides: Vec<Stamped<PerSide<f64>>>,
    pub(super) left_out: usize,
}

/// Means of the joints of each side at the times of the joint that is read most often. The others
/// are interpolated between two readings, never over a gap; times that one of them does not reach
/// are left out.
pub(super) fn merge(parts: &[SideSignal]) -> Merged {
    let Some(leading) = parts.iter().rev().max_by_key(|part| part.values.len()) else {
        return Merged { sides: Vec::new(), left_out: 0 };
    };
    let lines: Vec<(Side, Line)> =
        parts.iter().map(|part| (part.side, Line::of(&part.values))).collect();
    let mut merged = Merged { sides: Vec::with_capacity(leading.values.len()), left_out: 0 };
    for &(time, _) in &leading.values {
        let mut sums = PerSide::new((0.0, 0.0), (0.0, 0.0));
        let complete = lines.iter().all(|(side, line)| {
            let value = line.at(time);
            sums[*side].0 += value.unwrap_or_default();
            sums[*side].1 += 1.0;
            value.is_some()
        });
        if complete {
            merged.sides.push((time, sums.map(|(sum, count)| sum / count)));
        } else {
            merged.left_out += 1;
        }
    }
    merged
}

/// The values of a joint by their time.
struct Line {
    values: Vec<Stamped<f64>>,
    /// Median interval, s.
    usual: f64,
}

impl Line {
    fn of(values: &[Stamped<f64>]) -> Self {
        let mut values = values.to_vec();
        values.sort_by_key(|(time, _)| *time);
        values.dedup_by_key(|(time, _)| *time);
        let intervals = values.windows(2).map(|pair| seconds(pair[0].0, pair[1].0));
        let usual = median(&mut intervals.collect::<Vec<_>>()).unwrap_or_default();
        Self { values, usual }
    }

    /// The value at a time: between two readings that have no gap between them, or held for at most
    /// an interval beyond the first and the last.
    fn at(&self, time: i64) -> Option<f64> {
        let after = self.values.partition_point(|(known, _)| *known < time);
        let end = self.values.get(after);
        let start = after.checked_sub(1).map(|before| self.values[before]);
        match (start, end) {
            (_, Some(&(known, value))) if known == time => Some(value),
            (Some((from, first)), Some(&(to, last))) => {
                let interval = seconds(from, to);
                let portion = seconds(from, time) / interval;
                (interval <= MIN_GAP_RATIO * self.usual).then_some(first + portion * (last - first))
            }
            (Some((known, value)), None) | (None, Some(&(known, value))) => {
                (seconds(known, time).abs() <= self.usual).then_some(value)
            }
            (None, None) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(side: Side, start: i64, values: &[f64]) -> SideSignal {
        let times = (0..).map(|k| start + k * 10_000_000);
        SideSignal { side, values: times.zip(values.iter().copied()).collect() }
    }

    #[test]
    fn joints_of_one_message_are_their_means() {
        let merged = merge(&[
            part(Side::Left, 0, &[1.0, 2.0]),
            part(Side::Right, 0, &[3.0, 5.0]),
            part(Side::Left, 0, &[2.0, 4.0]),
        ]);
        let expected = [(0, PerSide::new(1.5, 3.0)), (10_000_000, PerSide::new(3.0, 5.0))];
        assert_eq!((merged.sides.as_slice(), merged.left_out), (&expected[..], 0));
    }

    #[test]
    fn joints_of_other_times_are_interpolated_and_never_over_a_gap() {
        let mut right = part(Side::Right, 2_500_000, &[0.0, 4.0, 8.0, 12.0]);
        right.values.push((1_000_000_000, 0.0));
        let left = part(Side::Left, 0, &[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        let merged = merge(&[left, right]);
        let found: Vec<(i64, f64)> =
            merged.sides.iter().map(|(time, sides)| (time / 1_000_000, sides.right)).collect();
        // the first is held back, the others stand three quarters on the way
        assert_eq!(found, [(0, 0.0), (10, 3.0), (20, 7.0), (30, 11.0)]);
        assert_eq!(merged.left_out, 3);
    }
}
