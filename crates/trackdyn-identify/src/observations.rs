//! What a recording shows, segment by segment.

use trackdyn_core::PerSide;
use trackdyn_recording::hold::held;
use trackdyn_recording::{Recording, Segment, SegmentOptions, segments};

/// Observed motions and the track speeds that go with them, in flat arrays.
#[derive(Clone, Debug)]
pub struct Observations {
    segments: Vec<Observation>,
    /// Pieces of constant track speed: duration (s) and speeds (m/s), those of a segment in a row.
    pieces: Vec<Piece>,
}

/// A time during which the track speeds are constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Its length, s.
    pub duration: f64,
    /// Left track speed, m/s.
    pub v_left: f64,
    /// Right track speed, m/s.
    pub v_right: f64,
}

/// One segment: where its pieces are and what was observed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    first_piece: usize,
    last_piece: usize,
    /// Motion over the segment from its first pose: forward (m), left (m), yaw (rad).
    pub motion: [f64; 3],
    /// Heading of its first pose in the frame of the run, rad.
    pub heading: f64,
    /// Its length, s.
    pub duration: f64,
    /// Index of its run in the recording.
    pub run: usize,
    /// Whether its first pose is the last one of the segment before it.
    pub follows: bool,
}

impl Observations {
    /// The segments of a recording.
    pub fn new(recording: &Recording, options: &SegmentOptions) -> Self {
        let mut observations = Self { segments: Vec::new(), pieces: Vec::new() };
        for segment in segments(recording, options) {
            observations.push(recording, &segment, options.tau);
        }
        observations
    }

    fn push(&mut self, recording: &Recording, segment: &Segment, tau: f64) {
        let run = &recording.runs()[segment.run];
        let first_piece = self.pieces.len();
        let pieces = held(run.tracks(), segment.start, segment.end, tau);
        self.pieces.extend(pieces.map(|piece| Piece {
            duration: piece.duration,
            v_left: piece.speeds.left,
            v_right: piece.speeds.right,
        }));
        let observed = segment.observed;
        self.segments.push(Observation {
            first_piece,
            last_piece: self.pieces.len(),
            motion: [observed.x, observed.y, observed.yaw],
            heading: run.poses()[segment.poses[0]].pose.yaw,
            duration: segment.duration(),
            run: segment.run,
            follows: segment.follows,
        });
    }

    /// The segments, in the order of the recording.
    pub fn segments(&self) -> &[Observation] {
        &self.segments
    }

    /// The pieces of constant track speed of a segment.
    #[inline]
    pub fn pieces(&self, segment: &Observation) -> &[Piece] {
        &self.pieces[segment.first_piece..segment.last_piece]
    }

    /// Distance that each track runs in a segment, m.
    pub fn travelled(&self, segment: &Observation) -> PerSide<f64> {
        let distance = |speed: fn(&Piece) -> f64| {
            self.pieces(segment).iter().map(|piece| piece.duration * speed(piece)).sum()
        };
        PerSide::new(distance(|piece| piece.v_left), distance(|piece| piece.v_right))
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.segments.len()
    }
}
