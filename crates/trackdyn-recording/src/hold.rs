//! Track speeds between their readings: a reading holds until the next one.
//!
//! Poses may lag behind the encoders. The clock offset `tau` (s) is what has to be added to a stamp
//! of the encoders to get the stamp of the pose that shows the same motion: with `tau` > 0 the poses
//! are late. What a pose shows between `start` and `end` the tracks did between `start − tau` and
//! `end − tau`.

use crate::recording::TrackSample;
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

/// The pieces of constant track speed between two times of the pose clock, in order.
///
/// Before the first reading the first one counts, after the last one the last: callers that must
/// not extrapolate compare with the stamps first. Empty when there are no readings or `end` is not
/// after `start`.
pub fn held(
    tracks: &[TrackSample],
    start: f64,
    end: f64,
    tau: f64,
) -> impl Iterator<Item = Held> + '_ {
    let (start, end) = (start - tau, end - tau);
    let first = holding(tracks, start).unwrap_or(0);
    tracks.iter().enumerate().skip(first).map_while(move |(index, sample)| {
        let from = if index == first { start } else { sample.t };
        if from >= end {
            return None;
        }
        let until = tracks.get(index + 1).map_or(end, |next| next.t.min(end));
        let speeds = PerSide::new(sample.v_left, sample.v_right);
        Some(Held { duration: until - from, speeds })
    })
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
