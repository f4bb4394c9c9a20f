//! From the readings of the encoders to the speeds of the belts.

use std::borrow::Cow;
use trackdyn_core::PerSide;
use trackdyn_recording::TrackSample;

/// Readings of belts with a first-order lag of each side (s), each averaged over the time that it
/// holds.
pub fn lagging(
    tracks: &[Vec<TrackSample>],
    time_constant: PerSide<f64>,
) -> Cow<'_, [Vec<TrackSample>]> {
    let constants = [time_constant.left, time_constant.right];
    if constants.iter().all(|constant| *constant <= 0.0) {
        return Cow::Borrowed(tracks);
    }
    tracks.iter().map(|run| lagging_run(run, constants)).collect()
}

fn lagging_run(tracks: &[TrackSample], time_constants: [f64; 2]) -> Vec<TrackSample> {
    let Some(first) = tracks.first() else { return Vec::new() };
    let mut belts = [first.v_left, first.v_right];
    let mut filtered = Vec::with_capacity(tracks.len());
    for (index, reading) in tracks.iter().enumerate() {
        let next = tracks.get(index + 1).map_or(reading.t, |next| next.t);
        let shown = [reading.v_left, reading.v_right];
        let mut mean = shown;
        for k in 0..2 {
            if time_constants[k] <= 0.0 {
                belts[k] = shown[k];
                continue;
            }
            let steps = (next - reading.t) / time_constants[k];
            let remaining = (-steps).exp();
            // V(t) = V_e + (V_0 − V_e) e^(−t/T); its mean while V_e holds
            let share = if steps > 1e-9 { (1.0 - remaining) / steps } else { 1.0 };
            mean[k] = shown[k] + (belts[k] - shown[k]) * share;
            belts[k] = shown[k] + (belts[k] - shown[k]) * remaining;
        }
        filtered.push(TrackSample { t: reading.t, v_left: mean[0], v_right: mean[1] });
    }
    filtered
}
