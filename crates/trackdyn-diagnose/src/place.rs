//! Where a mismatch lies, as a sentence.

use crate::base::Base;
use crate::evidence::Sample;
use crate::locate::{Location, Manoeuvre, Wave};
use crate::weighted::Weighted;
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
    match location.wave.filter(|_| symmetry == Symmetry::Place) {
        Some(Wave { length, direction, .. }) => {
            let direction = direction.to_degrees();
            format!("{words}, in waves {length:.2} m long that run at {direction:.0} deg")
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

/// Manoeuvre with the largest residuals, and its mean track speed, m/s.
fn worst(evidence: &Weighted, base: &Base) -> Option<(Manoeuvre, f64)> {
    let (residual, settings) = (&base.fit.residual, &evidence.settings().location);
    let weights = evidence.weights(residual);
    let fast = |sample: &Sample| sample.speeds.left.abs().max(sample.speeds.right.abs());
    let fastest = evidence.fastest();
    let mut best: Option<(f64, Manoeuvre, f64)> = None;
    for manoeuvre in
        [Manoeuvre::Straight, Manoeuvre::Arc, Manoeuvre::CounterRotation, Manoeuvre::Spin]
    {
        for third in 0..3 {
            let (low, high) = (fastest * real(third) / 3.0, fastest * real(third + 1) / 3.0);
            let chosen: Vec<usize> = (0..residual.len())
                .filter(|&k| {
                    let sample = &evidence.samples()[k];
                    let inside = fast(sample) > low && fast(sample) <= high;
                    inside && Manoeuvre::of(sample, settings) == manoeuvre
                })
                .collect();
            if chosen.len() < settings.min_samples_named {
                continue;
            }
            let count = real(chosen.len());
            let square =
                chosen.iter().map(|&k| weights[k] * residual[k].norm_squared()).sum::<f64>();
            let speed = chosen.iter().map(|&k| fast(&evidence.samples()[k])).sum::<f64>() / count;
            let mean = square / count;
            if best.is_none_or(|(most, ..)| mean > most) {
                best = Some((mean, manoeuvre, speed));
            }
        }
    }
    best.map(|(_, manoeuvre, speed)| (manoeuvre, speed))
}
