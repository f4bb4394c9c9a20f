//! A recording as long as the paper's: 1807 segments of nine readings of 30 ms, with noise.

use trackdyn_core::PerSide;
use trackdyn_estimate::SegmentOptions;
use trackdyn_estimate::genetic::GeneticEstimate;
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::noise::{self, noise};
use trackdyn_estimate::synthetic::{ConstantIcr, Stretch, Synthetic, random_steps};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_estimate::{
    Estimate, Free, GeneticOptions, Observations, Parameters, Weighting, genetic, least_squares,
};
use trackdyn_model::Kinematics;

const SEGMENTS: usize = 1807;

/// Gauge of the vehicle that drives, m.
const GAUGE: f64 = 0.42;

/// Turns yaw errors into distances in the cost (17), m.
pub const LEVER: f64 = GAUGE / 2.0;

/// The recording, cut, and the noise that it shows.
pub struct PaperCase {
    pub observations: Observations,
    pub by_noise: Weighting,
}

impl PaperCase {
    pub fn new() -> Self {
        // 139 steps, each 13 segments long, and a halt of one reading: the last segment's speeds
        // must be known to its end.
        let mut schedule = random_steps(139, 3.51, 0.8, 1);
        schedule.push(Stretch { duration: 0.03, speeds: PerSide::default() });
        let synthetic = Synthetic {
            kinematics: ConstantIcr {
                x_left: -0.375,
                x_right: 0.457,
                y: 0.049,
                alpha: PerSide::new(0.98, 1.01),
            },
            schedules: vec![schedule],
            track_interval: 0.03,
            pose_interval: 0.27,
            encoder_noise: 0.02,
            position_noise: 0.002,
            yaw_noise: 0.002,
            seed: 1,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let observations = Observations::new(&recording, &SegmentOptions::default());
        assert_eq!(observations.len(), SEGMENTS);
        let measured = SegmentNoise::measured(
            &noise(&recording, 0.0, &noise::Settings::default()),
            2.0 * GAUGE,
        );
        Self { observations, by_noise: Weighting::Noise(measured.expect("steady driving")) }
    }

    /// Robust least squares by the noise of the recording.
    pub fn noise_huber(&self) -> Estimate {
        self.fit(&self.by_noise, Loss::Huber)
    }

    /// Least squares by the cost (17).
    pub fn distance_squares(&self) -> Estimate {
        self.fit(&Weighting::Distance { lever: LEVER }, Loss::Squares)
    }

    fn fit(&self, weighting: &Weighting, loss: Loss) -> Estimate {
        let start = Parameters::of(&Kinematics::ideal(GAUGE));
        least_squares(&self.observations, &start, &Free::IcrsAndAlphas.into(), weighting, loss)
            .expect("a determined recording")
    }

    /// The genetic algorithm: 100 individuals, 200 generations.
    pub fn genetic(&self, seed: u64) -> GeneticEstimate {
        let options =
            GeneticOptions { population: 100, generations: 200, seed, ..Default::default() };
        genetic(&self.observations, GAUGE, LEVER, Free::IcrsAndAlphas, &options, &|_| ())
    }
}
