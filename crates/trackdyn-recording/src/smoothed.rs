//! Track speeds without the ticks of their encoders.

use crate::TrackSample;

/// Readings smoothed by v'_k = (v_{k−1} + 2 v_k + v_{k+1})/4.
///
/// Encoder ticks make speeds alternate by more than a robot's speed changes between two readings.
/// Stationary motion averages that out. A mass on dry friction would not: shaken like that, it
/// slides more easily than it should.
pub fn smoothed(run: &[TrackSample]) -> Vec<TrackSample> {
    (0..run.len())
        .map(|k| {
            let [before, here, after] =
                [run[k.saturating_sub(1)], run[k], run[(k + 1).min(run.len() - 1)]];
            let mean = |v: fn(&TrackSample) -> f64| (v(&before) + 2.0 * v(&here) + v(&after)) / 4.0;
            TrackSample { t: here.t, v_left: mean(|s| s.v_left), v_right: mean(|s| s.v_right) }
        })
        .collect()
}
