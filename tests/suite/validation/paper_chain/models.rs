//! The kinematic models that the paper compares, from one training recording.

use super::robot::auriga_without_alpha;
use crate::validation::map_statistics;
use trackdyn_core::PerSide;
use trackdyn_estimate::SegmentOptions;
use trackdyn_estimate::identification::{Identification, Options, identify};
use trackdyn_estimate::odometry::ParameterSet;
use trackdyn_estimate::{Estimate, GeneticOptions, Observations, spin_test};
use trackdyn_model::{Icrs, Kinematics};
use trackdyn_recording::{Recording, Source, TrackSample, UncheckedRun};

/// Gauge of Auriga-alpha, m.
pub const GAUGE: f64 = 0.42;

/// Names of the models, in the order of [`Trained::sets`]: the first half without α, the second
/// with.
pub const NAMES: [&str; 10] = [
    "ideal",
    "symmetric",
    "simulated map",
    "asymmetric, genetic",
    "asymmetric",
    "ideal, α",
    "symmetric, α",
    "simulated map, α",
    "asymmetric, genetic, α",
    "asymmetric, α",
];

/// The order of the paper: each better than the other in the position over a metre. α improve only
/// what has no greater fault.
pub const ORDER: [(usize, usize); 11] =
    [(1, 0), (2, 1), (3, 2), (4, 2), (6, 5), (7, 6), (8, 7), (9, 7), (7, 2), (8, 3), (9, 4)];

/// The order of yaw errors: spinning χ before none, α before none.
pub const ORDER_OF_YAW: [(usize, usize); 6] = [(1, 0), (6, 5), (6, 1), (7, 2), (8, 3), (9, 4)];

/// Places of the fits.
const FIT_WITHOUT_ALPHA: usize = 0;
/// The fit with α.
pub const FIT_WITH_ALPHA: usize = 1;

/// What the training paths say.
pub struct Trained {
    /// All methods.
    pub found: Identification,
    /// The models.
    pub sets: Vec<ParameterSet>,
}

impl Trained {
    /// Identifies, the symmetric models from spins, the others from paths; the genetic algorithm
    /// draws from `seed`.
    pub fn new(recording: &Recording, spins: &Recording, seed: u64) -> Self {
        let genetic = GeneticOptions { seed, ..GeneticOptions::default() };
        let options = Options { genetic, ..Options::new(GAUGE) };
        let found = identify(recording, &options, &|_| ()).expect("enough segments");
        let alpha = least_squares(&found, FIT_WITH_ALPHA).parameters.kinematics().alpha;
        let one = PerSide::new(1.0, 1.0);
        let map = Kinematics::new(map_statistics(&auriga_without_alpha()).mean);
        let models = [(FIT_WITHOUT_ALPHA, one), (FIT_WITH_ALPHA, alpha)].into_iter().flat_map(
            |(fit, alpha)| {
                [
                    Kinematics { alpha, ..Kinematics::ideal(GAUGE) },
                    symmetric(spins, found.clock.tau(), alpha),
                    Kinematics { alpha, ..map },
                    found.fits[fit].genetic.parameters.kinematics(),
                    least_squares(&found, fit).parameters.kinematics(),
                ]
            },
        );
        let sets =
            NAMES.into_iter().zip(models).map(|(name, model)| ParameterSet::new(name, model));
        Self { sets: sets.collect(), found }
    }

    /// The estimate by least squares of a fit.
    pub fn estimate(&self, fit: usize) -> &Estimate {
        least_squares(&self.found, fit)
    }
}

fn least_squares(found: &Identification, fit: usize) -> &Estimate {
    found.fits[fit].least_squares.as_ref().expect("determined")
}

/// The spin test (16) on the speeds of belts of this α: one χ, e = 0, y = 0.
fn symmetric(spins: &Recording, tau: f64, alpha: PerSide<f64>) -> Kinematics {
    let runs = spins.runs().iter().map(|run| {
        let tracks = run.tracks().iter().map(|reading| TrackSample {
            v_left: alpha.left * reading.v_left,
            v_right: alpha.right * reading.v_right,
            ..*reading
        });
        UncheckedRun {
            id: run.id(),
            tracks: tracks.collect::<Vec<_>>().into(),
            poses: run.poses().to_vec().into(),
            imu: Vec::new().into(),
        }
    });
    let belts = Recording::new("belts", "", runs.collect(), Source::computed(), Vec::new());
    let segments = SegmentOptions { tau, ..SegmentOptions::default() };
    let observations = Observations::new(&belts.expect("as long as before"), &segments);
    let half = spin_test(&observations, GAUGE, &spin_test::Settings::default())
        .expect("turns on the spot")
        .gap
        / 2.0;
    Kinematics { icrs: Icrs { x_left: -half, x_right: half, y: 0.0 }, alpha }
}
