//! Contrasts by what the tracks did before: heat, worked soil, a sloshing tank.

use super::departures::Contrasts;
use crate::evidence::Evidence;
use nalgebra::Vector3;
use trackdyn_core::PerSide;
use trackdyn_model::effect::Symmetry;
use trackdyn_recording::hold::held;

/// Symmetries of the present speeds: their contrasts do not count as effects of the past.
const SPEED_SYMMETRIES: &[Symmetry] =
    &[Symmetry::SpeedScale, Symmetry::Reversal, Symmetry::Manoeuvre, Symmetry::Mirror];

/// Contrasts of a, h and y by past track speeds, not whitened.
pub fn contrasts(evidence: &Evidence, [middle, half, y]: &[Vec<Vector3<f64>>; 3]) -> Contrasts {
    let mut columns: Vec<Vec<Vector3<f64>>> = Vec::new();
    for seconds in evidence.settings().location.memories {
        let past = past(evidence, seconds);
        let mut add = |of: &[Vector3<f64>], by: fn(&Past) -> f64| {
            columns.push(of.iter().zip(&past).map(|(value, past)| value * by(past)).collect());
        };
        for of in [half, y] {
            add(of, |past| past.turning);
            add(of, |past| past.running);
        }
        add(middle, |past| past.uneven);
    }
    Contrasts { symmetry: Symmetry::Transient, beside: SPEED_SYMMETRIES, columns }
}

/// Exponentially forgotten averages of track speeds, m/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Past {
    /// |V_r − V_l|
    turning: f64,
    /// |V_l| + |V_r|
    running: f64,
    /// |V_r| − |V_l|
    uneven: f64,
}

/// Averages up to the middle of each sample with this memory (s); zero at the start of a run.
fn past(evidence: &Evidence, seconds: f64) -> Vec<Past> {
    let mut all = Vec::with_capacity(evidence.samples().len());
    let (mut past, mut until, mut run) = (Past::default(), 0.0, None);
    for sample in evidence.samples() {
        if run != Some(sample.run) {
            (past, until, run) = (Past::default(), sample.start, Some(sample.run));
        }
        let middle = sample.start + sample.duration / 2.0;
        for held in held(&evidence.tracks()[sample.run], until, middle, evidence.tau()) {
            let PerSide { left, right } = held.speeds;
            let share = -(-held.duration / seconds).exp_m1();
            past.turning += share * ((right - left).abs() - past.turning);
            past.running += share * (left.abs() + right.abs() - past.running);
            past.uneven += share * (right.abs() - left.abs() - past.uneven);
        }
        until = middle;
        all.push(past);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::contrasts::tests::two_runs;
    use super::*;
    use trackdyn_core::real;

    #[test]
    fn the_past_comes_by_and_by_and_goes_likewise() {
        let (seconds, forth, back) = (3.0, 20, 40);
        let evidence = two_runs(&[vec![-0.5; forth], vec![0.3; back]].concat());
        let length = evidence.samples()[0].duration;
        let found = past(&evidence, seconds);
        for (k, past) in found.iter().enumerate() {
            let k = k % (forth + back);
            let [driven, rested] = [k.min(forth), k.saturating_sub(forth)].map(real);
            // plus half a sample up to its middle
            let [driven, rested] =
                if k < forth { [driven + 0.5, 0.0] } else { [driven, rested + 0.5] };
            let [came, stayed] =
                [-(-driven * length / seconds).exp_m1(), (-rested * length / seconds).exp()];
            // |V_r − V_l| is 0.8, then 0 m/s; |V_l| + |V_r| is 0.8, then 0.6 m/s
            assert!((past.turning - 0.8 * came * stayed).abs() < 1e-12, "{k}: {past:?}");
            let running = 0.8 * came * stayed + 0.6 * (1.0 - stayed);
            assert!((past.running - running).abs() < 1e-12, "{k}: {past:?}");
            assert!((past.uneven + 0.2 * came * stayed).abs() < 1e-12, "{k}: {past:?}");
        }
    }
}
