//! Where a mismatch lies, as a sentence.

use crate::base::Base;
use crate::evidence::Sample;
use crate::locate::{Along, Location, Manoeuvre, Wave};
use crate::settings;
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;

/// Channels in words, in the order of a motion.
pub const CHANNELS: [&str; 3] = ["longitudinal", "lateral", "yaw"];

/// A broken symmetry in words.
pub fn words(symmetry: Symmetry, location: &Location) -> String {
    let words = match symmetry {
        Symmetry::SpeedScale => "the ICRs move with speed",
        Symmetry::Reversal => "the ICRs differ between one direction and the reverse",
        Symmetry::Manoeuvre => "the ICRs differ between arcs, counter-rotation and spins",
        Symmetry::Mirror => "left and right differ",
        Symmetry::Heading => "the ICRs move with the heading",
        Symmetry::Place => "the ICRs move with the place",
        Symmetry::Time => "the ICRs move with time",
        Symmetry::Transient => "changes of speed or the past show",
        Symmetry::Straight => {
            "straight driving is not straight, or not as fast as the encoders say"
        }
    };
    match location.waves.iter().find(|wave| wave.along.symmetry() == symmetry) {
        Some(Wave { length, along: Along::Ground { direction }, .. }) => {
            let direction = direction.to_degrees();
            format!("{words}, in waves {length:.2} m long that run at {direction:.0} deg")
        }
        Some(Wave { length, along: Along::Belts, .. }) => {
            format!("{words}, as belts or sprockets that come round every {length:.2} m")
        }
        None => words.to_owned(),
    }
}

/// Sentence on where the model fails, from the locations before and after the correction.
pub fn sentence(
    evidence: &Weighted,
    base: &Base,
    [located, after]: [&Location; 2],
    broken: &[Symmetry],
) -> String {
    if broken.is_empty() {
        return "nowhere: constant ICRs and what encoders and pose sensor add explain it"
            .to_owned();
    }
    let mut parts = Vec::new();
    let channel = (0..3).max_by(|&a, &b| located.channels[a].total_cmp(&located.channels[b]));
    if let Some(channel) = channel.filter(|&channel| located.channels[channel] > 0.0) {
        let share = 100.0 * located.channels[channel];
        parts.push(format!("{share:.0} % of the excess is {}", CHANNELS[channel]));
    }
    if let Some((manoeuvre, speed)) = worst(evidence, base) {
        parts.push(format!("it is largest in {} at {speed:.2} m/s", manoeuvre.name()));
    }
    parts.extend(broken.iter().map(|symmetry| words(*symmetry, after)));
    parts.join("; ")
}

/// A kind of driving by which a mismatch is placed: a manoeuvre, and a third of the speeds up to
/// the fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regime {
    /// The manoeuvre.
    pub manoeuvre: Manoeuvre,
    /// The third: 0 the slowest.
    pub third: usize,
}

impl Regime {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        [Manoeuvre::Straight, Manoeuvre::Arc, Manoeuvre::CounterRotation, Manoeuvre::Spin]
            .into_iter()
            .flat_map(|manoeuvre| (0..3).map(move |third| Self { manoeuvre, third }))
    }

    /// That of a sample; none at rest. `fastest` is the largest track speed, m/s; what is faster
    /// counts to the fastest third.
    pub fn of(sample: &Sample, fastest: f64, settings: &settings::Location) -> Option<Self> {
        let speed = faster(sample);
        let manoeuvre = Manoeuvre::of(sample, settings);
        let third = (1..3).find(|&end| speed <= fastest * real(end) / 3.0).map_or(2, |end| end - 1);
        (speed > 0.0).then_some(Self { manoeuvre, third })
    }

    /// Its name in words.
    pub fn name(self) -> String {
        format!("{}, {}", self.manoeuvre.name(), ["slow", "medium", "fast"][self.third.min(2)])
    }
}

/// Speed of the faster track, m/s.
fn faster(sample: &Sample) -> f64 {
    sample.speeds.left.abs().max(sample.speeds.right.abs())
}

/// Manoeuvre with the largest residuals, and its mean track speed, m/s.
fn worst(evidence: &Weighted, base: &Base) -> Option<(Manoeuvre, f64)> {
    worst_regime(evidence, &base.fit.residual).map(|(regime, speed)| (regime.manoeuvre, speed))
}

/// The regime with the largest whitened residuals, and its mean track speed, m/s; none where each
/// has too few samples.
pub fn worst_regime(evidence: &Weighted, residual: &[Vector3<f64>]) -> Option<(Regime, f64)> {
    let settings = &evidence.settings().location;
    let weights = evidence.weights(residual);
    let fastest = evidence.fastest();
    let regimes: Vec<Option<Regime>> =
        evidence.samples().iter().map(|sample| Regime::of(sample, fastest, settings)).collect();
    let mut best: Option<(f64, Regime, f64)> = None;
    for regime in Regime::all() {
        let chosen: Vec<usize> =
            (0..residual.len()).filter(|&k| regimes[k] == Some(regime)).collect();
        if chosen.len() < settings.min_samples_named {
            continue;
        }
        let count = real(chosen.len());
        let square = chosen.iter().map(|&k| weights[k] * residual[k].norm_squared()).sum::<f64>();
        let speed = chosen.iter().map(|&k| faster(&evidence.samples()[k])).sum::<f64>() / count;
        let mean = square / count;
        if best.is_none_or(|(most, ..)| mean > most) {
            best = Some((mean, regime, speed));
        }
    }
    best.map(|(_, regime, speed)| (regime, speed))
}
