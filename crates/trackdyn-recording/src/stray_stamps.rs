//! Stamps that are far from all others, such as those before a clock was set.

use std::ops::Range;

/// Least ratio of a gap between stamps to the time that all other gaps take together. Such a gap
/// separates wrong stamps from right ones.
const MIN_RATIO: f64 = 100.0;

/// Shortest time that a gap is compared with, s.
const MIN_REST: f64 = 1.0;

/// At most one stamp in so many may be wrong.
const MAX_PORTION: usize = 10;

/// Fewest stamps among which wrong ones are sought.
const MIN_STAMPS: usize = 20;

/// How gaps divide the stamps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Parts {
    /// The range of the right stamps; few others or none lie outside it.
    Main(Range<usize>),
    /// Many stamps lie on both sides of a gap.
    Several,
}

/// The right ones among stamps in the order of time, s.
pub(crate) fn parts(stamps: &[f64]) -> Parts {
    let all = stamps.len();
    let mut main = 0..all;
    while all >= MIN_STAMPS && main.len() > 1 {
        let steps = stamps[main.clone()].windows(2).map(|pair| pair[1] - pair[0]);
        let longest = main.clone().zip(steps).max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((at, gap)) = longest else { break };
        let rest = stamps[main.end - 1] - stamps[main.start] - gap;
        if gap <= MIN_RATIO * rest.max(MIN_REST) {
            break;
        }
        let (before, after) = (main.start..at + 1, at + 1..main.end);
        main = if before.len() > after.len() { before } else { after };
        if MAX_PORTION * (all - main.len()) > all {
            return Parts::Several;
        }
    }
    Parts::Main(main)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamps(start: f64, count: u32) -> impl Iterator<Item = f64> {
        (0..count).map(move |k| start + 0.1 * f64::from(k))
    }

    #[test]
    fn few_stamps_beyond_a_long_gap_are_wrong() {
        let first: Vec<f64> = stamps(0.0, 2).chain(stamps(1.7e9, 100)).collect();
        assert_eq!(parts(&first), Parts::Main(2..102));
        let both: Vec<f64> = stamps(0.0, 1).chain(stamps(1e6, 100)).chain([1e9]).collect();
        assert_eq!(parts(&both), Parts::Main(1..101));
        let halves: Vec<f64> = stamps(0.0, 50).chain(stamps(1.7e9, 60)).collect();
        assert_eq!(parts(&halves), Parts::Several);
    }

    #[test]
    fn pauses_of_a_drive_are_no_such_gaps() {
        let pause: Vec<f64> = stamps(0.0, 5).chain(stamps(90.0, 100)).collect();
        assert_eq!(parts(&pause), Parts::Main(0..105));
        assert_eq!(parts(&[0.0, 1e9]), Parts::Main(0..2));
        assert_eq!(parts(&[]), Parts::Main(0..0));
    }
}
