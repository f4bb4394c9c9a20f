//! Noise of encoder speeds.

use super::{EncoderNoise, Method, Settings};
use trackdyn_core::Side;
use trackdyn_core::robust::{deviation_about_zero, median};
use trackdyn_recording::{Recording, TrackSample};

/// The noise of one side while its track runs. None where the speeds are commands, whose changes
/// are the driving.
pub(super) fn noise(
    recording: &Recording,
    side: Side,
    settings: &Settings,
) -> Option<EncoderNoise> {
    let speed = |sample: &TrackSample| match side {
        Side::Left => sample.v_left,
        Side::Right => sample.v_right,
    };
    let mut residuals = Vec::new();
    let mut speeds = Vec::new();
    let mut intervals = Vec::new();
    let mut readings = Vec::new();
    for run in recording.runs() {
        readings.extend(run.tracks().windows(2).map(|pair| pair[1].t - pair[0].t));
        let mut updates: Vec<(f64, f64)> = Vec::with_capacity(run.tracks().len());
        for sample in run.tracks() {
            let v = speed(sample);
            if updates.last().is_none_or(|(_, before)| *before != v) {
                updates.push((sample.t, v));
            }
        }
        for triple in updates.windows(3) {
            let [(t_a, a), (t_b, b), (t_c, c)] = [triple[0], triple[1], triple[2]];
            if a == 0.0 || b == 0.0 || c == 0.0 {
                continue;
            }
            let lambda = (t_b - t_a) / (t_c - t_a);
            let between = (1.0 - lambda) * a + lambda * c;
            let amplification = 1.0 + lambda * lambda + (1.0 - lambda) * (1.0 - lambda);
            residuals.push((b - between) / amplification.sqrt());
            speeds.push(b.abs());
            intervals.push(t_b - t_a);
        }
    }
    if residuals.len() < settings.min_triples {
        return None;
    }
    let update_interval = median(&mut intervals)?;
    let by_readings = settings.max_hold_readings * median(&mut readings)?;
    if update_interval > settings.max_hold_time.min(by_readings) {
        return None;
    }
    let triples = residuals.len();
    let deviation = deviation_about_zero(&mut residuals)?;
    Some(EncoderNoise {
        deviation,
        relative: deviation / median(&mut speeds)?,
        update_interval,
        triples,
        method: Method::ReadingDifferences,
    })
}
