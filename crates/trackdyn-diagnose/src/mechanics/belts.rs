//! From the readings of the encoders to the speeds of the belts.

use std::borrow::Cow;
use trackdyn_recording::TrackSample;

/// Readings of belts with a first-order lag (s), each averaged over the time that it holds.
pub fn lagging(tracks: &[Vec<TrackSample>], time_constant: f64) -> Cow<'_, [Vec<TrackSample>]> {
    if time_constant <= 0.0 {
        return Cow::Borrowed(tracks);
    }
    tracks.iter().map(|run| lagging_run(run, time_constant)).collect()
}

fn lagging_run(tracks: &[TrackSample], time_constant: f64) -> Vec<TrackSample> {
    let Some(first) = tracks.first() else { return Vec::new() };
    let mut belts = [first.v_left, first.v_right];
    let mut filtered = Vec::with_capacity(tracks.len());
    for (index, reading) in tracks.iter().enumerate() {
        let next = tracks.get(index + 1).map_or(reading.t, |next| next.t);
        let steps = (next - reading.t) / time_constant;
        let remaining = (-steps).exp();
        // V(t) = V_e + (V_0 − V_e) e^(−t/T); its mean while V_e holds
        let share = if steps > 1e-9 { (1.0 - remaining) / steps } else { 1.0 };
        let shown = [reading.v_left, reading.v_right];
        let mean: [f64; 2] = std::array::from_fn(|k| shown[k] + (belts[k] - shown[k]) * share);
        belts = std::array::from_fn(|k| shown[k] + (belts[k] - shown[k]) * remaining);
        filtered.push(TrackSample { t: reading.t, v_left: mean[0], v_right: mean[1] });
    }
    filtered
}
