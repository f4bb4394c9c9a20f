//! Track speeds between their readings: a reading holds until the next one.
//!
//! Poses may lag behind the encoders. The clock offset `tau` (s) is what has to be added to a stamp
//! of the encoders to get the stamp of the pose that shows the same motion: with `tau` > 0 the
//! poses are late. What a pose shows between `start` and `end` the tracks did between `start − tau`
//! and `end − tau`.
//!
//! Stamps that should be equal differ by rounding. A reading that would hold for no longer than
//! that does not count: its time goes to its neighbour.

use crate::sample::TrackSample;
use std::ops::Range;
use trackdyn_core::{PerSide, Pose, Twist};

/// A time during which the track speeds are constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// Its length, s.
    pub duration: f64,
    /// Track speeds, m/s.
    pub speeds: PerSide<f64>,
}

/// Index of the reading that holds at a time of the encoders; none before the first.
pub fn holding(tracks: &[TrackSample], t: f64) -> Option<usize> {
    tracks.partition_point(|sample| sample.t <= t).checked_sub(1)
}

/// Largest difference between two times that should be equal, s: each stamp is rounded by half a
/// unit in its last place, which is at most ε times the stamp, and so is the difference to `tau`.
fn rounding(start: f64, end: f64, tau: f64) -> f64 {
    2.0 * f64::EPSILON * start.abs().max(end.abs()).max(tau.abs())
}

/// Indices of the readings that hold at some time between two times of the pose clock.
///
/// Before the first reading the first one counts, after the last one the last. Empty when there are
/// no readings or `end` is not after `start`.
pub fn readings(tracks: &[TrackSample], start: f64, end: f64, tau: f64) -> Range<usize> {
    let rounding = rounding(start, end, tau);
    let (start, end) = (start - tau, end - tau);
    if tracks.is_empty() || start >= end {
        return 0..0;
    }
    let first = holding(tracks, start + rounding).unwrap_or(0);
    let until = tracks.partition_point(|sample| sample.t < end - rounding);
    first..until.max(first + 1)
}

/// Each of the [`readings`] between two times of the pose clock, in order: its index, and how long
/// it holds, s.
///
/// Callers that must not extrapolate compare with the stamps first.
pub fn pieces(
    tracks: &[TrackSample],
    start: f64,
    end: f64,
    tau: f64,
) -> impl Iterator<Item = (usize, f64)> + '_ {
    let range = readings(tracks, start, end, tau);
    let (start, end) = (start - tau, end - tau);
    range.clone().map(move |index| {
        let from = if index == range.start { start } else { tracks[index].t };
        let until = if index + 1 == range.end { end } else { tracks[index + 1].t };
        (index, until - from)
    })
}

/// The [`pieces`] with their track speeds.
pub fn held(
    tracks: &[TrackSample],
    start: f64,
    end: f64,
    tau: f64,
) -> impl Iterator<Item = Held> + '_ {
    pieces(tracks, start, end, tau)
        .map(|(index, duration)| Held { duration, speeds: tracks[index].speeds() })
}

/// Distance that each track runs between two times of the pose clock, m.
pub fn travelled(tracks: &[TrackSample], start: f64, end: f64, tau: f64) -> PerSide<f64> {
    held(tracks, start, end, tau).fold(PerSide::default(), |sum: PerSide<f64>, piece| {
        PerSide::new(
            sum.left + piece.duration * piece.speeds.left,
            sum.right + piece.duration * piece.speeds.right,
        )
    })
}

/// Motion between two times of the pose clock, seen from its start: the pose that constant twists,
/// one per piece, add up to. `twist` gives the body's twist in the frame of the result.
pub fn integrate(
    tracks: &[TrackSample],
    start: f64,
    end: f64,
    tau: f64,
    mut twist: impl FnMut(PerSide<f64>) -> Twist,
) -> Pose {
    held(tracks, start, end, tau).fold(Pose::default(), |pose, piece| {
        pose.compose(&Pose::exp(&twist(piece.speeds), piece.duration))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRACKS: [TrackSample; 3] = [
        TrackSample { t: 0.0, v_left: 1.0, v_right: 2.0 },
        TrackSample { t: 1.0, v_left: 3.0, v_right: 4.0 },
        TrackSample { t: 3.0, v_left: 5.0, v_right: 6.0 },
    ];

    fn pieces(start: f64, end: f64, tau: f64) -> Vec<(f64, f64)> {
        held(&TRACKS, start, end, tau).map(|piece| (piece.duration, piece.speeds.left)).collect()
    }

    #[test]
    fn readings_hold_until_the_next_and_the_ends_go_on() {
        assert_eq!(pieces(0.5, 3.5, 0.0), [(0.5, 1.0), (2.0, 3.0), (0.5, 5.0)]);
        assert_eq!(pieces(1.0, 3.0, 0.0), [(2.0, 3.0)]);
        assert_eq!(pieces(-1.0, 0.5, 0.0), [(1.5, 1.0)]);
        assert_eq!(pieces(4.0, 5.0, 0.0), [(1.0, 5.0)]);
        assert_eq!(pieces(2.0, 2.0, 0.0), []);
        assert_eq!(held(&[], 0.0, 1.0, 0.0).count(), 0);
    }

    /// Decimals as logs write them: sums of intervals that no binary number equals.
    #[test]
    fn rounding_of_stamps_makes_no_pieces_and_moves_nothing() {
        let stamp = |k: u32| 0.03 * f64::from(k);
        let speed = |k: u32| f64::from(k).sin();
        let tracks: Vec<TrackSample> = (0..4000)
            .map(|k| TrackSample { t: stamp(k), v_left: speed(k), v_right: -speed(k) })
            .collect();
        let mut least = f64::INFINITY;
        for k in 40..440 {
            let (start, end) = (0.27 * f64::from(k), 0.27 * f64::from(k) + 0.27);
            for tau in [0.0, 0.3, -0.09] {
                let pieces: Vec<Held> = held(&tracks, start, end, tau).collect();
                assert_eq!(pieces.len(), 9, "{start} {tau}");
                least = pieces.iter().fold(least, |least, piece| least.min(piece.duration));
                // Readings are dropped for a picosecond at most; at up to 2 m/s that is 1e-12 m.
                let first = (0..4000).find(|&j| stamp(j) > start - tau - 1e-9).expect("later");
                let sum: f64 = (first..first + 9).map(|j| 0.03 * speed(j)).sum();
                let travelled = travelled(&tracks, start, end, tau);
                assert!((travelled.left - sum).abs() < 1e-12, "{}", travelled.left - sum);
                let whole: f64 = pieces.iter().map(|piece| piece.duration).sum();
                assert!((whole - (end - start)).abs() < 1e-13);
            }
        }
        assert!(least > 0.0299, "{least}");
    }

    #[test]
    fn short_pieces_that_stamps_resolve_stay() {
        // a nanosecond, as logs count
        let pieces = pieces(1.0 - 1e-9, 3.0 + 1e-9, 0.0);
        assert_eq!(pieces.len(), 3);
        assert!((pieces[0].0 - 1e-9).abs() < 1e-15 && pieces[2].1 == 5.0);
    }

    #[test]
    fn late_poses_see_earlier_readings() {
        assert_eq!(pieces(1.25, 1.75, 0.5), pieces(0.75, 1.25, 0.0));
    }

    #[test]
    fn distances_and_poses_add_up() {
        let distance = travelled(&TRACKS, 0.5, 3.5, 0.0);
        assert_eq!((distance.left, distance.right), (9.0, 12.0));
        let straight = |speeds: PerSide<f64>| Twist { v_x: speeds.left, v_y: 0.0, w: 0.0 };
        assert_eq!(integrate(&TRACKS, 0.5, 3.5, 0.0, straight), Pose::new(9.0, 0.0, 0.0));
        let spin = |speeds: PerSide<f64>| Twist { v_x: 0.0, v_y: 0.0, w: speeds.right };
        assert_eq!(integrate(&TRACKS, 0.5, 3.5, 0.0, spin).yaw, 12.0);
    }
}
