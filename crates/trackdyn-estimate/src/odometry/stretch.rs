//! Pieces of a run over which motion is compared.

use crate::{Segment, SegmentOptions, segments};
use trackdyn_core::Pose;
use trackdyn_recording::{Recording, hold};

/// How long a piece is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Span {
    /// One segment: as short as readings and poses allow.
    Segment,
    /// Segments until they travel this far, m.
    Distance(f64),
    /// Segments until they last this long, s.
    Duration(f64),
}

impl Span {
    /// Segments, distances and durations that are tried on every recording.
    pub const ALL: [Self; 16] = [
        Self::Segment,
        Self::Distance(0.5),
        Self::Distance(1.0),
        Self::Distance(2.0),
        Self::Distance(5.0),
        Self::Distance(10.0),
        Self::Distance(20.0),
        Self::Distance(50.0),
        Self::Duration(0.5),
        Self::Duration(1.0),
        Self::Duration(1.5),
        Self::Duration(2.0),
        Self::Duration(5.0),
        Self::Duration(10.0),
        Self::Duration(20.0),
        Self::Duration(50.0),
    ];

    fn is_reached(self, distance: f64, duration: f64) -> bool {
        // Rounding must not lengthen a piece by a segment.
        const ROUNDING_SLACK: f64 = 1.0 - 1e-9;
        match self {
            Self::Segment => true,
            Self::Distance(length) => distance >= length * ROUNDING_SLACK,
            Self::Duration(length) => duration >= length * ROUNDING_SLACK,
        }
    }
}

/// A piece between two poses, without gaps in poses or readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Index of its run in the recording.
    pub run: usize,
    /// Indices of its first and last pose in the run.
    pub poses: [usize; 2],
    /// Stamp of its first pose, s.
    pub start: f64,
    /// Time between its poses, s.
    pub duration: f64,
    /// Distance travelled, m: ∫ |V_l + V_r|/2 dt. It is the same for every parameter set, noise of
    /// the poses does not lengthen it, and turning on the spot does not count.
    pub distance: f64,
    /// Observed motion: the last pose seen from the first.
    pub observed: Pose,
}

impl Stretch {
    /// A segment, with the distance that the tracks travel in it.
    fn of_segment(segment: &Segment, recording: &Recording, tau: f64) -> Self {
        let tracks = recording.runs()[segment.run].tracks();
        let distance = hold::held(tracks, segment.start, segment.end, tau)
            .map(|piece| {
                f64::midpoint(piece.speeds.left, piece.speeds.right).abs() * piece.duration
            })
            .sum();
        Self {
            run: segment.run,
            poses: segment.poses,
            start: segment.start,
            duration: segment.duration(),
            distance,
            observed: segment.observed,
        }
    }

    /// This and the one that follows it as one.
    fn joined(&self, next: &Self) -> Self {
        Self {
            poses: [self.poses[0], next.poses[1]],
            duration: self.duration + next.duration,
            distance: self.distance + next.distance,
            observed: self.observed.compose(&next.observed),
            ..*self
        }
    }
}

/// The segments of a recording, in order.
pub fn of_segments(recording: &Recording, options: &SegmentOptions) -> Vec<Stretch> {
    segments(recording, options)
        .iter()
        .map(|segment| Stretch::of_segment(segment, recording, options.tau))
        .collect()
}

/// Neighbouring segments joined to pieces of a span; none overlaps another, and one begins where
/// the other ends. What is left at the end of a run is too short and dropped.
pub fn joined(segments: &[Stretch], span: Span) -> Vec<Stretch> {
    let mut pieces = Vec::new();
    let mut open: Option<Stretch> = None;
    for segment in segments {
        let piece = match open {
            Some(before) if before.run == segment.run && before.poses[1] == segment.poses[0] => {
                before.joined(segment)
            }
            _ => *segment,
        };
        open = if span.is_reached(piece.distance, piece.duration) {
            pieces.push(piece);
            None
        } else {
            Some(piece)
        };
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Stretch as Drive, Synthetic};
    use trackdyn_core::PerSide;

    fn pieces(span: Span) -> Vec<Stretch> {
        let drive = |left, right| Drive { duration: 6.0, speeds: PerSide::new(left, right) };
        let schedules = vec![vec![drive(0.5, 0.5), drive(-0.3, 0.3), drive(-0.4, -0.6)]];
        let recording = Synthetic { schedules, ..Synthetic::default() }.recording().expect("runs");
        joined(&of_segments(&recording, &SegmentOptions::default()), span)
    }

    #[test]
    fn spinning_is_no_distance_and_backward_is() {
        let total: f64 = pieces(Span::Segment).iter().map(|piece| piece.distance).sum();
        // 6 s of 0.5 m/s forward and backward.
        assert!((total - 6.0).abs() < 1e-9, "{total}");
    }

    #[test]
    fn pieces_are_long_enough_and_do_not_overlap() {
        let metres = pieces(Span::Distance(2.0));
        assert_eq!(metres.len(), 2);
        assert!(metres.iter().all(|piece| piece.distance >= 2.0 - 1e-9));
        assert_eq!(metres[0].poses[1], metres[1].poses[0]);
        let seconds = pieces(Span::Duration(3.0));
        assert_eq!(seconds.len(), 6);
        assert!(seconds.iter().all(|piece| (piece.duration - 3.0).abs() < 1e-9));
    }

    #[test]
    fn joined_motion_is_that_between_the_end_poses() {
        let piece = pieces(Span::Duration(12.0))[0];
        // 3 m forward, then 6 s at 0.6/0.832 rad/s about the centre of the ICRs.
        assert!((piece.observed.yaw - 6.0 * 0.6 / 0.832).abs() < 1e-9);
    }
}
