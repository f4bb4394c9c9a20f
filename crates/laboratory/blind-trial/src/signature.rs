//! What an effect leaves in a recording, in units of its noise.

use crate::failure::Failure;
use crate::subspace::Subspace;
use nalgebra::Vector3;
use trackdyn_core::{Pose, Twist};
use trackdyn_estimate::least_squares::Loss;
use trackdyn_estimate::observations::{Observation, Piece};
use trackdyn_estimate::prediction::body_velocity;
use trackdyn_estimate::sensor::{Nuisance, Sensor, report};
use trackdyn_estimate::weighting::{SegmentNoise, Weighting, Whitener};
use trackdyn_estimate::{Free, Observations, Parameters, Unknowns, least_squares};

/// Step of the gyro's bias in difference quotients, rad/s.
const BIAS_STEP: f64 = 1e-4;

/// A drive without the effect, and what instruments and constant ICRs can make of it.
pub(crate) struct Bench {
    observations: Observations,
    /// Residuals of constant ICRs.
    residuals: Vec<Vector3<f64>>,
    weighting: Weighting,
    whitener: Whitener,
    start: Parameters,
    /// Whitened derivatives by the nuisances.
    nuisances: Vec<Vec<f64>>,
    scale: f64,
}

impl Bench {
    /// The bench of a drive that perfect sensors saw, for a recording with this noise in which
    /// poses are there for the share `presence` of the time.
    ///
    /// # Errors
    /// Where constant ICRs cannot be fitted: a robot that hardly turns.
    pub(crate) fn new(
        observations: Observations,
        noise: SegmentNoise,
        presence: f64,
        gauge: f64,
    ) -> Result<Self, Failure> {
        let weighting = Weighting::Noise(noise);
        let ideal = Parameters([-gauge, gauge, 0.0, 1.0, 1.0]);
        let (start, residuals) = fitted(&observations, &ideal, &weighting)?;
        let whitener = Whitener::new(&weighting, &observations);
        let (scale, nuisances) = (presence.sqrt(), Vec::new());
        let mut bench =
            Self { observations, residuals, weighting, whitener, start, nuisances, scale };
        let columns = nuisance_columns(&bench.observations, &bench.start);
        bench.nuisances = columns.into_iter().map(|column| bench.whitened(column)).collect();
        Ok(bench)
    }

    /// Adds what another drive differs by as one more nuisance.
    ///
    /// # Errors
    /// Where segments of both drives do not match.
    pub(crate) fn with_nuisance(mut self, of: &Observations) -> Result<Self, Failure> {
        let column = self.signature(of)?;
        self.nuisances.push(column);
        Ok(self)
    }

    /// What nuisances span in the first `rows` rows of a signature.
    pub(crate) fn nuisances(&self, rows: usize) -> Subspace {
        Subspace::spanned_by(self.nuisances.iter().map(|column| &column[..rows.min(column.len())]))
    }

    /// The whitened difference that an effect makes of this drive, or of its first runs, with what
    /// constant ICRs, a clock offset and a turned sensor explain taken away of both.
    ///
    /// # Errors
    /// Where segments of both drives do not match.
    pub(crate) fn signature(&self, with: &Observations) -> Result<Vec<f64>, Failure> {
        self.difference(with, &self.observations, &self.residuals)
    }

    /// The whitened difference of two drives on another ground, of which the one without the effect
    /// has these residuals.
    ///
    /// # Errors
    /// Where segments do not match.
    pub(crate) fn difference(
        &self,
        with: &Observations,
        without: &Observations,
        residuals: &[Vector3<f64>],
    ) -> Result<Vec<f64>, Failure> {
        let own = self.observations.segments();
        let matches = |other: &[Observation]| {
            other.len() <= own.len()
                && other.iter().zip(own).all(|(a, b)| a.run == b.run && a.start == b.start)
        };
        let (rows, others) = (with.segments(), without.segments());
        if !(matches(rows) && matches(others)) || rows.len() > others.len() {
            let (own, without, with) = (own.len(), others.len(), rows.len());
            return Err(Failure::Segments { own, without, with });
        }
        let changed = self.residuals(with)?;
        Ok(self.whitened(changed.iter().zip(residuals).map(|(a, b)| a - b).collect()))
    }

    /// Residuals of a drive against the constant ICRs, clock offset and yaw of the sensor that fit
    /// it best.
    ///
    /// # Errors
    /// Where there are none: a robot that hardly turns.
    pub(crate) fn residuals(&self, of: &Observations) -> Result<Vec<Vector3<f64>>, Failure> {
        fitted(of, &self.start, &self.weighting).map(|(_, residuals)| residuals)
    }

    /// Rows of a signature.
    pub(crate) fn rows(&self) -> usize {
        3 * self.observations.len()
    }

    fn whitened(&self, mut column: Vec<Vector3<f64>>) -> Vec<f64> {
        self.whitener.whiten(&mut column);
        column.iter().flat_map(|v| v.iter().map(|value| self.scale * value)).collect()
    }
}

/// The constant ICRs that fit best beside a clock offset and a turned sensor, and their residuals.
/// Large changes of ICRs and clocks are not linear: they have to be fitted, not projected out.
fn fitted(
    observations: &Observations,
    start: &Parameters,
    weighting: &Weighting,
) -> Result<(Parameters, Vec<Vector3<f64>>), Failure> {
    let with_sensor =
        Unknowns { free: Free::Icrs, nuisances: vec![Nuisance::TimeOffset, Nuisance::SensorYaw] };
    let fit = |unknowns: &Unknowns| {
        least_squares(observations, start, unknowns, weighting, Loss::Squares)
    };
    let estimate = fit(&with_sensor).or_else(|_| fit(&Unknowns::from(Free::Icrs)))?;
    let (parameters, sensor) = (estimate.parameters, estimate.sensor);
    let at = observations.at(sensor.tau);
    let residuals = at.segments().iter().map(|segment| {
        let predicted = report(&parameters, &sensor, at.pieces(segment)).motion;
        Vector3::from(segment.motion) - Vector3::from(predicted)
    });
    Ok((parameters, residuals.collect()))
}

/// Derivatives of the motion of constant ICRs, segment by segment, by x_l, x_r, y, α_l, α_r, the
/// clock offset, the yaw of the sensor and the bias of the gyro.
fn nuisance_columns(
    observations: &Observations,
    parameters: &Parameters,
) -> [Vec<Vector3<f64>>; 8] {
    let sensor = Sensor { tau: 0.0, yaw: 0.0 };
    let mut columns: [Vec<Vector3<f64>>; 8] = Default::default();
    for segment in observations.segments() {
        let pieces = observations.pieces(segment);
        let report = report(parameters, &sensor, pieces);
        let kinematic = report.by_parameter.into_iter();
        let all =
            kinematic.chain([report.by_tau, report.by_yaw, by_bias(segment, parameters, pieces)]);
        for (column, derivative) in columns.iter_mut().zip(all) {
            column.push(Vector3::from(derivative));
        }
    }
    columns
}

/// Derivative by a constant error of the yaw rate, per rad/s: the way is laid on along the wrong
/// heading.
fn by_bias(segment: &Observation, parameters: &Parameters, pieces: &[Piece]) -> [f64; 3] {
    let end = |bias: f64| {
        let steps = pieces.iter().map(|piece| {
            let [v_x, v_y, w] = body_velocity(parameters, piece);
            Pose::exp(&Twist { v_x, v_y, w: w + bias }, piece.duration)
        });
        steps.fold(Pose::default(), |pose, step| pose.compose(&step))
    };
    let (ahead, behind) = (end(BIAS_STEP), end(-BIAS_STEP));
    let quotient = |a: f64, b: f64| (a - b) / (2.0 * BIAS_STEP);
    [quotient(ahead.x, behind.x), quotient(ahead.y, behind.y), segment.duration]
}
