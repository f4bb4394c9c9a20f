//! How noisy poses and encoders are, from the recording alone.
//!
//! No kinematic model is used. Three poses a, b, c, n steps apart, give two body velocities; for a
//! constant twist they are equal, whatever it is. Their difference, as the distance of b from the
//! motion between a and c, is e = (v₂ − v₁) T₁ T₂/(T₁ + T₂), with
//!
//! Var e = R (1 + λ² + (1 − λ)²) + q T₁ T₂/(T₁ + T₂),  λ = T₁/(T₁ + T₂).
//!
//! R is white noise of each pose, q the variance per second of a random walk: slip, rough ground, a
//! drifting map and, while moving, what the tracks do to the body below the noise of their
//! encoders. With equal intervals, 4 Var e = 6R + 2nQ. R and q come from the variances at n = 1, 2,
//! 4 and 8 by weighted least squares; variances come from the median of e², so that outliers and
//! the few triples with a change of speed in them do not count. Errors of the stamps of poses,
//! which grow with the speed, are told from them by a likelihood (`stamps`).
//!
//! # Sources
//! The Allan variance of phase data with white phase noise and white frequency noise (IEEE Std
//! 1139); difference-based variance in regression: Gasser, Sroka and Jennen-Steinmetz, Biometrika
//! 73 (1986), 625-633.

use std::fmt;
use trackdyn_core::{PerSide, Side};
use trackdyn_recording::Recording;

mod encoder;
mod scatter;
mod settings;
mod stamps;
mod triples;

pub use scatter::scatter;
pub use settings::Settings;

/// Noise of a recording; what the recording cannot show is absent.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Pose noise while both tracks stand.
    pub standing: Option<PoseNoise>,
    /// Pose noise while both tracks run steadily.
    pub moving: Option<PoseNoise>,
    /// Noise of the encoder speeds while the track runs.
    pub encoders: PerSide<Option<EncoderNoise>>,
}

/// Pose noise along the axes of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseNoise {
    /// Forward, m.
    pub forward: Component,
    /// To the left, m.
    pub lateral: Component,
    /// Yaw, rad.
    pub yaw: Component,
    /// Standard deviation of the error of each pose's stamp, s; zero where none shows.
    pub stamp: f64,
    /// Standard deviation of each pose by white noise and stamps together: forward (m), left (m),
    /// yaw (rad).
    pub of_pose: [f64; 3],
    /// Triples of neighbouring poses (n = 1) behind the figures.
    pub triples: usize,
    /// How the figures were found.
    pub method: Method,
}

/// White noise and random walk of one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Standard deviation of each pose, √R, in the unit of the coordinate.
    pub white: f64,
    /// Random walk, √q, in the unit per √s.
    pub walk: f64,
}

/// Noise of one encoder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderNoise {
    /// Standard deviation of a reading, m/s.
    pub deviation: f64,
    /// The standard deviation per median speed, 1.
    pub relative: f64,
    /// Median time between readings that differ, s: longer than between stamps where the source
    /// holds its readings.
    pub update_interval: f64,
    /// Triples of readings behind the figures.
    pub triples: usize,
    /// How the figures were found.
    pub method: Method,
}

/// How a figure was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Poses while the encoders show zero, from half a second after they do.
    StandStill,
    /// Increments over 1, 2, 4 and 8 steps while the track speeds stay the same within their noise.
    SteadyIncrements,
    /// Second differences of readings that differ from the one before.
    ReadingDifferences,
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::StandStill => "poses at stand-still",
            Self::SteadyIncrements => "increments over 1, 2, 4 and 8 steps of steady driving",
            Self::ReadingDifferences => "second differences of the readings",
        })
    }
}

/// Measures the noise; `tau` is the clock offset of the poses, s ([`clock`](crate::clock)).
pub fn noise(recording: &Recording, tau: f64, settings: &Settings) -> Noise {
    noise_beside(recording, tau, of_encoders(recording, settings), settings)
}

/// Noise of the encoder of each side; none where its speeds are commands, or too few.
pub(crate) fn of_encoders(
    recording: &Recording,
    settings: &Settings,
) -> PerSide<Option<EncoderNoise>> {
    PerSide::from_fn(|side| encoder::noise(recording, side, settings))
}

/// The noise beside that of the encoders, which is known: a filter of their speeds changes it.
pub(crate) fn noise_beside(
    recording: &Recording,
    tau: f64,
    encoders: PerSide<Option<EncoderNoise>>,
    settings: &Settings,
) -> Noise {
    let deviation = PerSide::from_fn(|side: Side| encoders[side].map(|noise| noise.deviation));
    Noise {
        standing: triples::standing(recording, tau, settings),
        moving: triples::moving(recording, tau, deviation, settings),
        encoders,
    }
}
