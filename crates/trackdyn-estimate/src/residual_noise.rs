//! Noise of segments from what constant ICRs leave, where the recording shows it in no other way.
//!
//! [`noise`](crate::noise) needs stretches of standing or of steady driving. Without them the
//! residuals of the best constant ICRs still bound the noise from above: physics that constant ICRs
//! lack counts as noise here. So it serves as a start for an estimate beside a richer model.

use crate::least_squares::{Loss, least_squares};
use crate::observations::Observations;
use crate::parameters::{Free, Parameters};
use crate::prediction::Lanes;
use crate::weighting::{MIN_POSE_NOISE, SegmentNoise, Weighting};
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_model::Kinematics;

/// White noise of each pose that explains the median residuals of constant ICRs; `gauge` is the
/// vehicle's, m. None where least squares does not find the ICRs.
pub fn residual_noise(observations: &Observations, gauge: f64) -> Option<SegmentNoise> {
    let start = Parameters::of(&Kinematics::ideal(gauge));
    let unknowns = Free::Icrs.into();
    let weighting = Weighting::Distance { lever: gauge / 2.0 };
    let fit = least_squares(observations, &start, &unknowns, &weighting, Loss::Huber).ok()?;
    let predictions = Lanes::new(observations).predict(&fit.parameters);
    // Two poses meet in a segment: Var r = 2R.
    let pose = [0, 1, 2].map(|channel| {
        let segments = observations.segments().iter().zip(&predictions);
        let residual = segments.map(|(segment, by)| segment.motion[channel] - by.motion[channel]);
        let deviation = deviation_about_zero(&mut residual.collect::<Vec<_>>()).unwrap_or(0.0);
        deviation * deviation / 2.0
    });
    Some(
        SegmentNoise { pose, walk: [0.0; 3], heading: 0.0, stamp: 0.0 }
            .at_least([MIN_POSE_NOISE, 0.0]),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentOptions;
    use crate::synthetic::{Synthetic, random_steps};

    #[test]
    fn poses_have_the_noise_of_their_residuals() {
        let synthetic = Synthetic {
            schedules: vec![random_steps(400, 0.3, 0.8, 1)],
            pose_interval: 0.2,
            position_noise: 0.004,
            yaw_noise: 0.003,
            seed: 5,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let observations = Observations::new(&recording, &SegmentOptions::default());
        let found = residual_noise(&observations, 0.42).expect("turns");
        // 300 residuals give a median to 7 %
        for (found, truth) in found.pose.into_iter().zip([0.004, 0.004, 0.003]) {
            assert!((found.sqrt() / truth - 1.0).abs() < 0.2, "{} {truth}", found.sqrt());
        }
    }
}
