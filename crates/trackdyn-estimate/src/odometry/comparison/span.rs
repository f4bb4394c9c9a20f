//! Errors over pieces of one length.

use super::component::Piece;
use super::{Component, Path};
use crate::Blocks;
use crate::odometry::intervals::{Sums, size};
use crate::odometry::{Estimate, Residual, Span, Stretch};
use trackdyn_core::real;

/// Errors of all parameter sets over pieces of one length.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanErrors {
    /// The length.
    pub span: Span,
    /// Pieces.
    pub count: usize,
    /// Blocks with pieces in them.
    pub blocks: usize,
    /// Mean distance travelled in a piece, m.
    pub mean_distance: f64,
    /// Mean time of a piece, s.
    pub mean_duration: f64,
    /// Errors in the order of the parameter sets.
    pub sets: Vec<SetErrors>,
    /// Sums of the squares of the errors of place, m², and yaw, rad², of each set in each block
    /// with pieces in it.
    squares: Vec<Vec<[f64; 2]>>,
}

/// Errors of one parameter set over pieces of one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetErrors {
    /// Forward, m.
    pub along: Component,
    /// To the left, m.
    pub across: Component,
    /// Counter-clockwise, rad.
    pub yaw: Component,
    /// Distance between observed and predicted place, m.
    pub position: Component,
}

impl SpanErrors {
    /// The errors over some stretches; none without any.
    pub(super) fn new(
        span: Span,
        stretches: &[Stretch],
        paths: &[Path],
        sets: usize,
        blocks: &Blocks,
    ) -> Option<Self> {
        if stretches.is_empty() {
            return None;
        }
        let pieces: Vec<Piece> = stretches
            .iter()
            .map(|stretch| Piece {
                block: blocks.of(stretch.run, stretch.start).unwrap_or(0),
                distance: stretch.distance,
            })
            .collect();
        let residuals: Vec<Vec<Residual>> = (0..sets)
            .map(|set| {
                let residual = |stretch: &Stretch| {
                    let place = paths.binary_search_by_key(&stretch.run, |path| path.index).ok()?;
                    Some(Residual::of_stretch(stretch, &paths[place].trajectories[set]))
                };
                // A stretch lies in a run that was replayed.
                stretches.iter().filter_map(residual).collect()
            })
            .collect();
        let component = |set: usize, of: fn(&Residual) -> f64| {
            let values = |set: usize| residuals[set].iter().map(of).collect::<Vec<f64>>();
            let first = (set > 0).then(|| values(0));
            Component::new(&pieces, blocks.count(), &values(set), first.as_deref())
        };
        let mut used: Vec<usize> = pieces.iter().map(|piece| piece.block).collect();
        used.sort_unstable();
        used.dedup();
        let squares = residuals.iter().map(|of_set| {
            let mut sums = vec![[0.0; 2]; blocks.count()];
            for (piece, residual) in pieces.iter().zip(of_set) {
                let [place, yaw] = &mut sums[piece.block];
                *place += residual.position().powi(2);
                *yaw += residual.yaw.powi(2);
            }
            used.iter().map(|&block| sums[block]).collect()
        });
        let squares = squares.collect();
        let count = stretches.len();
        let mean = |of: fn(&Stretch) -> f64| stretches.iter().map(of).sum::<f64>() / real(count);
        Some(Self {
            span,
            count,
            blocks: used.len(),
            mean_distance: mean(|stretch| stretch.distance),
            mean_duration: mean(|stretch| stretch.duration),
            sets: (0..sets)
                .map(|set| SetErrors {
                    along: component(set, |residual| residual.along),
                    across: component(set, |residual| residual.across),
                    yaw: component(set, |residual| residual.yaw),
                    position: component(set, Residual::position),
                })
                .collect(),
            squares,
        })
    }

    /// Root mean squares of the errors of place and yaw of one set over those of another on the
    /// same pieces, 1; none where there is no such set, or where the errors of the other vanish.
    pub fn ratio(&self, set: usize, other: usize) -> Option<[Estimate; 2]> {
        let (of, over) = (self.squares.get(set)?, self.squares.get(other)?);
        let ratio = |component: usize| {
            let sums: Vec<Sums<2>> =
                of.iter().zip(over).map(|(of, over)| [of[component], over[component]]).collect();
            let has_errors = sums.iter().any(|[_, over]| *over > 0.0);
            // rms/rms = √(Σ e²/Σ e_other²), of as many pieces
            has_errors.then(|| size(&sums, |[of, over]| (of / over).max(0.0).sqrt()))
        };
        Some([ratio(0)?, ratio(1)?])
    }
}
