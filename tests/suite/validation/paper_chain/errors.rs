//! Errors of replays, and whether one model is better than another beyond chance.

use trackdyn_estimate::odometry::{Comparison, Span};

/// Quantities of a replay, with units.
pub const QUANTITIES: [&str; 7] = [
    "along [mm]",
    "across [mm]",
    "yaw [deg]",
    "1 m [mm]",
    "1 m yaw [deg]",
    "end [m]",
    "end yaw [deg]",
];

/// Place of the relative error of the position over 1 m among the quantities.
pub const RELATIVE_POSITION: usize = 3;

/// Place of the relative error of the yaw over 1 m.
pub const RELATIVE_YAW: usize = 4;

/// Root mean squares, in the order and the units of [`QUANTITIES`].
pub type Errors = [f64; QUANTITIES.len()];

/// Errors of each model on the runs of a comparison.
pub fn errors(comparison: &Comparison) -> Vec<Errors> {
    let segments = comparison.segments().expect("segments");
    let metre = comparison.over(Span::Distance(1.0)).expect("paths of 20 m");
    (0..comparison.sets.len())
        .map(|set| {
            let ends = comparison.paths.iter().map(|path| path.errors(set).expect("replayed").last);
            let (distances, yaws): (Vec<f64>, Vec<f64>) =
                ends.map(|end| (end.position(), end.yaw)).unzip();
            let [short, long] = [&segments.sets[set], &metre.sets[set]];
            [
                1e3 * short.along.rms.value,
                1e3 * short.across.rms.value,
                short.yaw.rms.value.to_degrees(),
                1e3 * long.position.rms.value,
                long.yaw.rms.value.to_degrees(),
                root_mean_square(&distances),
                root_mean_square(&yaws).to_degrees(),
            ]
        })
        .collect()
}

/// √(mean of squares).
pub fn root_mean_square(values: &[f64]) -> f64 {
    let count = f64::from(u32::try_from(values.len()).expect("few"));
    (values.iter().map(|value| value * value).sum::<f64>() / count).sqrt()
}

/// The ratio of two errors that were observed in pairs: geometric mean, and the limits of its
/// interval.
///
/// Student's t at 99 %, two-sided, of the logarithms, which are alike in size between seeds where
/// errors are not.
pub fn ratio(better: &[f64], worse: &[f64]) -> [f64; 3] {
    /// Student's t, 99.5 % point, with seven degrees of freedom.
    const T: f64 = 3.499;
    assert_eq!(better.len(), 8, "the quantile is that of eight pairs");
    let logarithms: Vec<f64> = better.iter().zip(worse).map(|(b, w)| (b / w).ln()).collect();
    let mean = logarithms.iter().sum::<f64>() / 8.0;
    let variance = logarithms.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 7.0;
    let half = T * (variance / 8.0).sqrt();
    [mean, mean - half, mean + half].map(f64::exp)
}
