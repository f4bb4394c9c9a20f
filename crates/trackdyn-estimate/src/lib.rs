//! Which numbers: the kinematic parameters of a tracked robot from its recordings.
//!
//! What a recording says before any kinematic model:
//!
//! - [`segment`]: pieces between two poses; [`gaps`]: times without readings.
//! - [`clock`]: how late the poses are against the encoders.
//! - [`noise`]: how noisy poses, encoders and tables of operating points are.
//! - [`gyroscope`]: a gyroscope as evidence of the yaw of poses.
//! - [`regular`]: the times at which samples were due, of stamps that jitter.
//! - [`thinned`]: fewer readings, of encoders that report very often.
//! - [`frames`]: whether all runs share the frame of their poses.
//! - [`blocks`]: parts that count as independent.
//! - [`interval`]: 95 % from leaving out one of them each.
//! - [`synthetic`]: recordings with known truth.
//!
//! What it says of the parameters:
//!
//! - [`observations`]: what a recording shows, segment by segment.
//! - [`parameters`]: the numbers; [`doubt`]: why a recording does not determine them.
//! - [`prediction`]: what a kinematic model makes of the same track speeds, with its derivatives.
//! - [`sensor`]: clock and mount of the pose sensor, which can be fitted beside.
//! - [`mod@residual_noise`]: the noise, where only the residuals of a model show it.
//! - [`weighting`]: how much a residual counts: the cost (17), or the noise that was measured.
//! - [`restricted_likelihood`]: the noise by which residuals are most likely; [`variances`]: its
//!   steps.
//! - [`gauss_newton`]: robust least squares, whatever the residuals are of.
//! - [`mod@spin_test`], [`mod@genetic`], [`mod@least_squares`]: three ways to the parameters.
//! - [`response`]: how the poses follow the track speeds over time.
//! - [`run_clocks`]: runs with a clock of their own.
//! - [`separation`]: the distance of the ICRs from turning alone.
//! - [`steady`]: the parameters from a table of steady operating points.
//! - [`identification`]: all of them on one recording; [`contradiction`]: where they do not agree.
//! - [`yaw_rates`]: yaw rates over time, measured and predicted.
//! - [`odometry`]: where the robot would be if its parameters were true, against where it was.
//!
//! Residual = observed − predicted, in the frame of the segment's first pose (REP-103).

pub mod blocks;
pub mod clock;
pub mod contradiction;
pub mod doubt;
pub mod error;
pub mod frames;
pub mod gaps;
pub mod gauss_newton;
pub mod genetic;
pub mod gyroscope;
pub mod identification;
pub mod interval;
pub mod least_squares;
pub mod noise;
pub mod observations;
pub mod odometry;
pub mod parameters;
pub mod prediction;
pub mod regular;
pub mod residual_noise;
pub mod response;
pub mod restricted_likelihood;
pub mod run_clocks;
mod scatter;
pub mod segment;
pub mod sensor;
pub mod separation;
pub mod spin_test;
pub mod steady;
pub mod synthetic;
pub mod thinned;
mod unexplained;
pub mod variances;
pub mod weighting;
pub mod yaw_rates;

pub use blocks::{Blocks, Extent};
pub use clock::Clock;
pub use contradiction::Contradiction;
pub use doubt::Doubt;
pub use error::Error;
pub use genetic::{GeneticOptions, genetic, genetic_unless_stopped};
pub use gyroscope::{Gyroscope, with_gyroscope};
pub use identification::{Identification, identify, identify_unless_stopped};
pub use interval::Interval;
pub use least_squares::{Estimate, Unknowns, least_squares};
pub use observations::Observations;
pub use parameters::{Free, Parameters};
pub use residual_noise::residual_noise;
pub use response::Response;
pub use segment::{Segment, SegmentOptions, segments};
pub use sensor::{Nuisance, Sensor};
pub use separation::{Separation, Turning};
pub use spin_test::{SpinTest, spin_test};
pub use steady::{SteadyEstimate, fit_points};
pub use weighting::Weighting;
pub use yaw_rates::{Rate, RunRates, YawRates};
