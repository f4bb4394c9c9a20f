//! Statistics of sums over blocks of a recording, with the intervals that leaving out one block
//! each gives ([`Interval`]).

use crate::Interval;

/// Smallest number of blocks for an interval.
pub const MIN_BLOCKS: usize = 5;

/// A number with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number over all blocks.
    pub value: f64,
    /// Half the width of the interval; none where there are fewer than [`MIN_BLOCKS`] blocks.
    pub half_width: Option<f64>,
    /// Whether it is a size, never below zero.
    pub is_size: bool,
}

impl Estimate {
    /// Both ends of the interval; that of a size does not reach below zero.
    pub fn interval(&self) -> Option<[f64; 2]> {
        let least = if self.is_size { 0.0 } else { f64::NEG_INFINITY };
        self.half_width.map(|half| [(self.value - half).max(least), self.value + half])
    }
}

/// Sums of one block, of which statistics are functions.
pub type Sums<const N: usize> = [f64; N];

/// A statistic of the sums over all blocks, with its interval; blocks without samples are left out
/// before.
pub(crate) fn estimate<const N: usize>(
    blocks: &[Sums<N>],
    statistic: impl Fn(&Sums<N>) -> f64,
) -> Estimate {
    let total =
        blocks.iter().fold([0.0; N], |total, block| std::array::from_fn(|k| total[k] + block[k]));
    let value = statistic(&total);
    let count = blocks.len();
    if count < MIN_BLOCKS {
        return Estimate { value, half_width: None, is_size: false };
    }
    let without: Vec<f64> = blocks
        .iter()
        .map(|block| statistic(&std::array::from_fn(|k| total[k] - block[k])))
        .collect();
    let interval = Interval::of_jackknife(value, &without);
    let half_width = interval.map(|interval| interval.half_width());
    let half_width = half_width.filter(|half| half.is_finite());
    Estimate { value, half_width, is_size: false }
}

/// The estimate of a statistic that is never below zero.
pub fn size<const N: usize>(blocks: &[Sums<N>], statistic: impl Fn(&Sums<N>) -> f64) -> Estimate {
    Estimate { is_size: true, ..estimate(blocks, statistic) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_blocks_give_the_interval_of_student_over_their_means() {
        let means = [1.0, 2.0, 4.0, 3.0, 5.0, 3.0];
        let blocks: Vec<Sums<2>> = means.iter().map(|mean| [10.0, 10.0 * mean]).collect();
        let Estimate { value, half_width, .. } = estimate(&blocks, |[count, sum]| sum / count);
        assert!((value - 3.0).abs() < 1e-12);
        // s² = (4 + 1 + 1 + 0 + 4 + 0)/5 = 2, standard error √(2/6) with five degrees of freedom
        let of_student = Interval::new(3.0, (2.0_f64 / 6.0).sqrt(), 6, 1);
        let half = of_student.half_width();
        assert!((half_width.expect("enough blocks") - half).abs() < 1e-12);
        assert_eq!(estimate(&blocks[..4], |[count, sum]| sum / count).half_width, None);
        let few = |blocks: &[f64]| blocks.iter().map(|&one| [one]).collect::<Vec<Sums<1>>>();
        let scattered = size(&few(&[0.0, 0.0, 0.0, 0.0, 9.0]), |[sum]| *sum);
        let [low, high] = scattered.interval().expect("enough blocks");
        assert!(low == 0.0 && high > 9.0, "{low} {high}");
    }
}
