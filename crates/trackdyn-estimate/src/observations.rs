//! What a recording shows, segment by segment.

use crate::{Blocks, Extent, Segment, SegmentOptions, segments};
use std::ops::Range;
use std::sync::Arc;
use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{PerSide, real};
use trackdyn_model::Kinematics;
use trackdyn_recording::hold::{held, travelled};
use trackdyn_recording::{Recording, Run, TrackSample};

/// Change of a track speed over the faster one's up to which driving is steady.
const MAX_STEADY_CHANGE: f64 = 0.1;

/// Observed motions and the track speeds that go with them, in flat arrays.
#[derive(Clone, Debug)]
pub struct Observations {
    segments: Vec<Observation>,
    /// Pieces of constant track speed: duration (s) and speeds (m/s), those of a segment in a row.
    pieces: Vec<Piece>,
    /// Clock offset at which they are cut, s.
    tau: f64,
    /// How far the clock offset may move, s: the readings reach as far.
    tau_margin: f64,
    /// Readings of each run.
    tracks: Arc<[Vec<TrackSample>]>,
    /// How the body moves by the track speeds, once that is known.
    moves: Option<Kinematics>,
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
    /// Stamp of its first pose, s.
    pub start: f64,
    /// Its length, s.
    pub duration: f64,
    /// Index of its run in the recording.
    pub run: usize,
    /// Indices of its first and last pose in the run.
    pub poses: [usize; 2],
    /// Whether its first pose is the last one of the segment before it.
    pub follows: bool,
    /// Twist of the body at its first and at its last pose, by the track speeds there: forward
    /// (m/s), left (m/s), yaw (rad/s); zero while no kinematics are known
    /// ([`Observations::moving_by`]).
    pub twists: [[f64; 3]; 2],
}

impl Observation {
    fn of(run: &Run, segment: &Segment) -> Self {
        let observed = segment.observed;
        Self {
            first_piece: 0,
            last_piece: 0,
            motion: [observed.x, observed.y, observed.yaw],
            heading: run.poses()[segment.poses[0]].pose.yaw,
            start: segment.start,
            duration: segment.duration(),
            run: segment.run,
            poses: segment.poses,
            follows: segment.follows,
            twists: [[0.0; 3]; 2],
        }
    }
}

impl Observations {
    /// The segments of a recording.
    pub fn new(recording: &Recording, options: &SegmentOptions) -> Self {
        Self::of(recording, options, |_, _| true)
    }

    /// The segments of a recording over which, and for `settle` seconds before, neither track
    /// changes its speed by more than a tenth of the faster one's.
    ///
    /// Before that, the drivetrain and the slip settle, which constant ICRs do not describe.
    pub fn steady(recording: &Recording, options: &SegmentOptions, settle: f64) -> Self {
        Self::of(recording, options, |run, segment| {
            let start = segment.start - settle;
            let third = (segment.end - start) / 3.0;
            if run.tracks().first().is_none_or(|first| first.t > start - options.tau) {
                return false;
            }
            let means = [0.0, 1.0, 2.0].map(|k| {
                let from = start + k * third;
                travelled(run.tracks(), from, from + third, options.tau).map(|d| d / third)
            });
            let fastest = means.iter().map(|m| m.left.abs().max(m.right.abs())).fold(0.0, f64::max);
            [|m: &PerSide<f64>| m.left, |m: &PerSide<f64>| m.right].iter().all(|side| {
                let values = means.map(|mean| side(&mean));
                let (low, high) = values
                    .iter()
                    .fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
                high - low <= MAX_STEADY_CHANGE * fastest
            })
        })
    }

    fn of(
        recording: &Recording,
        options: &SegmentOptions,
        keep: impl Fn(&Run, &Segment) -> bool,
    ) -> Self {
        let mut kept = Vec::new();
        let mut previous_kept = false;
        for mut segment in segments(recording, options) {
            // A segment that is left out shares no pose with the one after it.
            segment.follows &= previous_kept;
            let run = &recording.runs()[segment.run];
            previous_kept = keep(run, &segment);
            if previous_kept {
                kept.push(Observation::of(run, &segment));
            }
        }
        let tracks = recording.runs().iter().map(|run| run.tracks().to_vec()).collect();
        let SegmentOptions { tau, tau_margin, .. } = *options;
        let pieces = Vec::new();
        Self { segments: kept, pieces, tau, tau_margin, tracks, moves: None }.at(tau)
    }

    /// These segments at another clock offset, s: other readings go with their poses.
    pub fn at(&self, tau: f64) -> Self {
        let mut pieces = Vec::with_capacity(self.pieces.len());
        let mut segments = self.segments.clone();
        for segment in &mut segments {
            segment.first_piece = pieces.len();
            let end = segment.start + segment.duration;
            let held = held(&self.tracks[segment.run], segment.start, end, tau);
            pieces.extend(held.map(|piece| Piece {
                duration: piece.duration,
                v_left: piece.speeds.left,
                v_right: piece.speeds.right,
            }));
            segment.last_piece = pieces.len();
            let own = &pieces[segment.first_piece..];
            let twist = |piece: Option<&Piece>| match (&self.moves, piece) {
                (Some(kinematics), Some(piece)) => {
                    let speeds = PerSide::new(piece.v_left, piece.v_right);
                    let twist = ros_twist_from_paper(&kinematics.twist(speeds));
                    [twist.v_x, twist.v_y, twist.w]
                }
                _ => [0.0; 3],
            };
            segment.twists = [twist(own.first()), twist(own.last())];
        }
        Self { segments, pieces, tau, tracks: Arc::clone(&self.tracks), ..*self }
    }

    /// These segments, with the twist at each pose by these kinematics: what an error of its stamp
    /// does to it.
    pub fn moving_by(&self, kinematics: Kinematics) -> Self {
        Self { moves: Some(kinematics), ..self.clone() }.at(self.tau)
    }

    /// How the body moves at its poses, once that is known.
    pub fn moves(&self) -> Option<Kinematics> {
        self.moves
    }

    /// Clock offset at which the pieces are cut, s.
    pub fn tau(&self) -> f64 {
        self.tau
    }

    /// How far the clock offset may move from where the segments were cut, s.
    pub fn tau_margin(&self) -> f64 {
        self.tau_margin
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

    /// What counts as independent: the runs with segments, from the first to the last one, or
    /// pieces of them where they are fewer than `min_whole_runs`.
    pub fn blocks(&self, min_whole_runs: usize) -> Blocks {
        let runs = self.segments.chunk_by(|a, b| a.run == b.run);
        let extents = runs.map(|segments| {
            let (first, last) = (&segments[0], &segments[segments.len() - 1]);
            let (start, end) = (first.start, last.start + last.duration);
            Extent { run: first.run, start, duration: end - start }
        });
        Blocks::new(extents, min_whole_runs)
    }

    /// The segments of each block that has any.
    pub fn ranges(&self, blocks: &Blocks) -> Vec<Range<usize>> {
        let block = |segment: &Observation| blocks.of(segment.run, segment.start);
        let mut end = 0;
        let parts = self.segments.chunk_by(|a, b| block(a) == block(b));
        let ranges = parts.map(|segments| {
            end += segments.len();
            end - segments.len()..end
        });
        ranges.collect()
    }

    /// Mean duration of a segment, s; the usual one where there is none.
    pub(crate) fn mean_duration(&self) -> f64 {
        let total: f64 = self.segments.iter().map(|segment| segment.duration).sum();
        if self.is_empty() {
            SegmentOptions::default().minimum_duration
        } else {
            total / real(self.len())
        }
    }

    /// Stamp of the first reading of a run, s.
    pub(crate) fn first_reading(&self, run: usize) -> Option<f64> {
        Some(self.tracks.get(run)?.first()?.t)
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
