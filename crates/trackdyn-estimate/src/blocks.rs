//! Parts of a recording that count as independent.
//!
//! Residuals of one run are correlated: neighbouring segments share a noisy pose, and a robot slips
//! in the same way for a while. Runs are independent. Where there are few runs, pieces of them
//! count as independent if they are long against both. Confidence intervals come from leaving out
//! one block at a time.

use trackdyn_core::real;

/// When a run begins and how long it lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Index of the run in the recording.
    pub run: usize,
    /// Its beginning, s.
    pub start: f64,
    /// Its length, s.
    pub duration: f64,
}

/// Runs, or pieces of runs where there are few.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    /// Each run with the number of its first block and how many blocks it is cut into; ascending.
    runs: Vec<(Extent, usize, usize)>,
}

impl Blocks {
    /// Usual least number of runs for which each run is a block. The scatter of fewer blocks is a
    /// poor estimate of a variance.
    pub const MIN_WHOLE_RUNS: usize = 24;

    /// Blocks of these runs, whose indices ascend: each run a block where there are
    /// `min_whole_runs`; fewer are cut into about twice as many pieces of equal length.
    pub fn new(extents: impl IntoIterator<Item = Extent>, min_whole_runs: usize) -> Self {
        let extents: Vec<Extent> = extents.into_iter().collect();
        let total: f64 = extents.iter().map(|extent| extent.duration).sum();
        let piece = total / real(2 * min_whole_runs);
        let is_cut = extents.len() < min_whole_runs && piece > 0.0;
        let mut first = 0;
        let runs = extents.into_iter().map(|extent| {
            let pieces = if is_cut { pieces(extent.duration / piece) } else { 1 };
            let run = (extent, first, pieces);
            first += pieces;
            run
        });
        Self { runs: runs.collect() }
    }

    /// Number of blocks.
    pub fn count(&self) -> usize {
        self.runs.last().map_or(0, |(_, first, pieces)| first + pieces)
    }

    /// Whether runs had to be cut.
    pub fn are_pieces(&self) -> bool {
        self.count() > self.runs.len()
    }

    /// The block that holds a time, s, of a run; none of a run that has no blocks.
    pub fn of(&self, run: usize, time: f64) -> Option<usize> {
        let place = self.runs.binary_search_by_key(&run, |(extent, ..)| extent.run).ok()?;
        let (extent, first, pieces) = self.runs[place];
        let share = (time - extent.start) / extent.duration.max(f64::MIN_POSITIVE);
        let ends = (1..pieces).map(real);
        Some(first + ends.filter(|end| share >= end / real(pieces)).count())
    }

    /// In words, for output.
    pub fn description(&self) -> String {
        match (self.runs.len(), self.count()) {
            (runs, count) if runs == count => format!("{runs} runs as blocks"),
            (1, count) => format!("1 run cut into {count} blocks of time"),
            (runs, count) => format!("{runs} runs, few, cut into {count} blocks of time"),
        }
    }
}

/// A length in pieces as their number, at least one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
fn pieces(length: f64) -> usize {
    (length.round() as usize).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(count: usize) -> Blocks {
        let extents = (0..count).map(|run| Extent { run, start: 100.0, duration: 40.0 });
        Blocks::new(extents, Blocks::MIN_WHOLE_RUNS)
    }

    #[test]
    fn few_runs_are_cut_and_many_are_not() {
        let few = runs(4);
        assert_eq!((few.count(), few.are_pieces()), (48, true));
        // Twelve pieces of 3.33 s
        assert_eq!(few.of(2, 100.0), Some(24));
        assert_eq!(few.of(2, 103.5), Some(25));
        assert_eq!(few.of(2, 139.9), Some(35));
        assert_eq!(few.of(4, 100.0), None);
        let many = runs(Blocks::MIN_WHOLE_RUNS);
        assert_eq!((many.count(), many.are_pieces()), (Blocks::MIN_WHOLE_RUNS, false));
        assert_eq!(many.of(5, 120.0), Some(5));
    }

    #[test]
    fn longer_runs_have_more_pieces() {
        let extent = |run, duration| Extent { run, start: 0.0, duration };
        let extents = [extent(0, 10.0), extent(3, 470.0), extent(7, 0.0)];
        let blocks = Blocks::new(extents, Blocks::MIN_WHOLE_RUNS);
        assert_eq!(
            (blocks.of(0, 9.0), blocks.of(3, 0.0), blocks.of(7, 0.0)),
            (Some(0), Some(1), Some(48))
        );
        assert_eq!(blocks.count(), 49);
    }
}
