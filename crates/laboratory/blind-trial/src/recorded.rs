//! What is recorded of driven runs.

use crate::failure::Failure;
use crate::ground::{Driven, seen};
use crate::instruments::Instruments;
use trackdyn_core::rounding::Digits;
use trackdyn_recording::{PoseFrame, Recording, Source, StatedNoise, UncheckedRun};

/// Digits of every number of a recording: to a micrometre, to a microsecond.
const DIGITS: Digits = Digits::Decimals(6);

/// The recording that the instruments of a case make of driven runs, with the noise of a seed.
pub(crate) fn recorded(
    name: &str,
    driven: &[Driven],
    instruments: &Instruments,
    noise: u64,
) -> Result<Recording, Failure> {
    let mut runs = seen(driven, &instruments.sensors, noise)?;
    runs.iter_mut().for_each(round);
    let recording = Recording::new(name, "robot", runs, Source::computed(), Vec::new())?;
    let recording = recording.with_pose_frame(Some(PoseFrame::World));
    Ok(recording.with_stated_noise(Some(rounded(instruments.stated))))
}

/// Rounds all numbers of a run alike: how they are written says nothing.
fn round(run: &mut UncheckedRun) {
    let digits = |value: &mut f64| *value = DIGITS.round(*value) + 0.0;
    for sample in &mut run.tracks.samples {
        [&mut sample.t, &mut sample.v_left, &mut sample.v_right].into_iter().for_each(digits);
    }
    for sample in &mut run.poses.samples {
        let pose = &mut sample.pose;
        [&mut sample.t, &mut pose.x, &mut pose.y, &mut pose.yaw].into_iter().for_each(digits);
    }
}

fn rounded(noise: StatedNoise) -> StatedNoise {
    StatedNoise { position: DIGITS.round(noise.position), yaw: DIGITS.round(noise.yaw) }
}
