//! One component of the residuals.

use crate::odometry::Estimate;
use crate::odometry::intervals::{Sums, estimate, size};

/// Statistics of one component of the residuals: along, across, yaw, or the distance between
/// observed and predicted place. Units: m or rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Mean.
    pub mean: Estimate,
    /// Root of the mean square.
    pub rms: Estimate,
    /// Sum of the absolute values per distance travelled, per m; none where nothing was travelled.
    pub per_metre: Option<Estimate>,
    /// Root mean square over that of the first parameter set on the same stretches, 1; none for the
    /// first set, and where its residuals vanish.
    pub over_first: Option<Estimate>,
}

/// A stretch, as far as a component needs it.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    /// Its block.
    pub block: usize,
    /// Distance travelled, m.
    pub distance: f64,
}

impl Component {
    /// The statistics of values, one per piece, and those of the first set where this is another.
    pub(super) fn new(
        pieces: &[Piece],
        blocks: usize,
        values: &[f64],
        first: Option<&[f64]>,
    ) -> Self {
        let mut sums: Vec<Sums<6>> = vec![[0.0; 6]; blocks];
        for (index, (piece, value)) in pieces.iter().zip(values).enumerate() {
            let of_first = first.map_or(0.0, |first| first[index]);
            let terms =
                [1.0, *value, value * value, value.abs(), piece.distance, of_first * of_first];
            for (sum, term) in sums[piece.block].iter_mut().zip(terms) {
                *sum += term;
            }
        }
        sums.retain(|block| block[0] > 0.0);
        let total = |term: usize| sums.iter().map(|block| block[term]).sum::<f64>();
        let has_first = first.is_some() && total(5) > 0.0;
        Self {
            mean: estimate(&sums, |[count, sum, ..]| sum / count),
            rms: size(&sums, |[count, _, squares, ..]| (squares / count).max(0.0).sqrt()),
            per_metre: (total(4) > 0.0)
                .then(|| size(&sums, |[.., sizes, distance, _]| sizes / distance)),
            over_first: has_first.then(|| {
                size(&sums, |[_, _, squares, .., of_first]| (squares / of_first).max(0.0).sqrt())
            }),
        }
    }
}
