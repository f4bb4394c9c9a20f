//! Statistics of errors.

use trackdyn_core::real;

/// What `evo` says of a list of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// How many there are.
    pub count: usize,
    /// Root of the mean square.
    pub rmse: f64,
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// Standard deviation of the population.
    pub std: f64,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
    /// Sum of squares.
    pub sse: f64,
}

impl Statistics {
    /// The statistics of some errors; none without any.
    pub fn of(errors: &[f64]) -> Option<Self> {
        if errors.is_empty() {
            return None;
        }
        let count = errors.len();
        let mut sorted = errors.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let mean = errors.iter().sum::<f64>() / real(count);
        let sse: f64 = errors.iter().map(|error| error * error).sum();
        let scatter: f64 = errors.iter().map(|error| (error - mean) * (error - mean)).sum();
        Some(Self {
            count,
            rmse: (sse / real(count)).sqrt(),
            mean,
            median: f64::midpoint(sorted[(count - 1) / 2], sorted[count / 2]),
            std: (scatter / real(count)).sqrt(),
            min: sorted[0],
            max: sorted[count - 1],
            sse,
        })
    }
}
