//! Segments side by side, for the compiler to put into vector registers.

use super::series::MAX_SERIES_ANGLE;
use crate::observations::{Observations, Piece};

/// Segments that are computed side by side.
pub const LANES: usize = 4;

/// One number per segment of a batch.
pub type Lane = [f64; LANES];

/// Segments side by side. Shorter ones are filled up with pieces in which nothing moves, and so are
/// the places in the last batch that no segment takes.
pub struct Batch {
    /// Distances that the left and the right track run in each piece, m.
    pub pieces: Vec<[Lane; 2]>,
    /// Observed motion: forward (m), left (m), yaw (rad).
    pub observed: [Lane; 3],
    /// The longest distances that the left and the right track run in a piece, m.
    longest: [f64; 2],
}

impl Batch {
    /// All segments of a recording, in their order.
    pub fn all(observations: &Observations) -> Vec<Self> {
        let batches = observations.segments().chunks(LANES).map(|segments| {
            let pieces =
                |lane: usize| segments.get(lane).map_or(&[][..], |s| observations.pieces(s));
            let longest = (0..LANES).map(|lane| pieces(lane).len()).max().unwrap_or(0);
            let column = |k: usize, way: fn(&Piece) -> f64| -> Lane {
                std::array::from_fn(|lane| pieces(lane).get(k).map_or(0.0, way))
            };
            let ways = |k: usize| {
                [column(k, |p| p.duration * p.v_left), column(k, |p| p.duration * p.v_right)]
            };
            let observed = |channel: usize| {
                std::array::from_fn(|lane| segments.get(lane).map_or(0.0, |s| s.motion[channel]))
            };
            let pieces: Vec<[Lane; 2]> = (0..longest).map(ways).collect();
            let longest = [0, 1].map(|side: usize| {
                let ways = pieces.iter().flat_map(|piece| piece[side]);
                ways.fold(0.0, |most: f64, way| most.max(way.abs()))
            });
            Self { pieces, observed: [0, 1, 2].map(observed), longest }
        });
        batches.collect()
    }

    /// Whether no piece turns by more than the series of an arc reach where the tracks turn the
    /// robot by these angles per metre, rad/m. Readings of fast robots at less than one a second
    /// may.
    pub fn is_within_series(&self, [left, right]: [f64; 2]) -> bool {
        left.abs() * self.longest[0] + right.abs() * self.longest[1] <= MAX_SERIES_ANGLE
    }
}
