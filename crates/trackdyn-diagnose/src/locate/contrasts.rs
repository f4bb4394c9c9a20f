//! Functions of how the robot was driven that break one symmetry each.
//!
//! Over the sectors of (V_l, V_r) a function is even or odd under reversal R and mirror M. With c the sign of
//! V_l + V_r and d that of V_r − V_l: c is odd under R, d under R and M, c d under M. Of the ICRs, the
//! middle a = (x_l + x_r)/2 is odd under M, half their distance h and y are even.

use super::{IcrColumns, past};
use crate::evidence::{Evidence, Sample};
use nalgebra::Vector3;
use trackdyn_core::{PerSide, Side};
use trackdyn_physics::effect::Symmetry;
use trackdyn_recording::hold::held;

/// Ratio of the slower to the faster track, from −1 (spin) to 1 (straight), beyond which driving counts as
/// straight or as spinning.
const STRAIGHT: f64 = 0.9;
const SPIN: f64 = -0.7;

/// How a sample was driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Manoeuvre {
    /// Tracks alike.
    Straight,
    /// Both tracks forward, or both backward.
    Arc,
    /// Tracks against each other at different speeds.
    CounterRotation,
    /// Tracks against each other at about the same speed.
    Spin,
}

impl Manoeuvre {
    /// The manoeuvre of a sample.
    pub fn of(sample: &Sample) -> Self {
        let (left, right) = (sample.speeds.left, sample.speeds.right);
        let (slow, fast) = if left.abs() < right.abs() { (left, right) } else { (right, left) };
        let ratio = if fast == 0.0 { 1.0 } else { slow / fast };
        if ratio > STRAIGHT {
            Self::Straight
        } else if ratio >= 0.0 {
            Self::Arc
        } else if ratio > SPIN {
            Self::CounterRotation
        } else {
            Self::Spin
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Straight => "straight driving",
            Self::Arc => "arcs",
            Self::CounterRotation => "counter-rotation",
            Self::Spin => "spins",
        }
    }
}

/// Departures that break one symmetry in one way.
#[derive(Clone, Debug)]
pub struct Contrasts {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// Symmetries whose plain contrasts, those beside nothing, do not count as departures of this kind.
    pub beside: &'static [Symmetry],
    /// The departures, not whitened.
    pub columns: Vec<Vec<Vector3<f64>>>,
}

/// Derivatives of the prediction by a = (x_l + x_r)/2, h = (x_r − x_l)/2 and y, each ICR as far as it moves.
pub fn middle_half_y([left, right, y]: &IcrColumns) -> [Vec<Vector3<f64>>; 3] {
    let combine = |sign: f64| -> Vec<Vector3<f64>> {
        left.iter().zip(right).map(|(left, right)| right + left * sign).collect()
    };
    [combine(1.0), combine(-1.0), y.clone()]
}

/// Columns that break a symmetry, not whitened; none of what the evidence has no spread in.
///
/// `icrs` are the derivatives of the prediction by x_l, x_r and y.
pub fn contrasts(evidence: &Evidence, icrs: &IcrColumns) -> Vec<Contrasts> {
    let samples = evidence.samples();
    let [middle, half, y] = &middle_half_y(icrs);
    let mut all: Vec<Contrasts> = Vec::new();
    let mut add_each = |symmetry: Symmetry, of: &[Vector3<f64>], by: &dyn Fn(usize) -> f64| {
        let column: Vec<Vector3<f64>> =
            of.iter().enumerate().map(|(index, value)| value * by(index)).collect();
        if column.iter().all(|value| value.norm() == 0.0) {
            return;
        }
        match all.iter_mut().find(|one| one.symmetry == symmetry) {
            Some(contrasts) => contrasts.columns.push(column),
            None => all.push(Contrasts { symmetry, beside: &[], columns: vec![column] }),
        }
    };
    let mut add = |symmetry: Symmetry, of: &[Vector3<f64>], by: &dyn Fn(&Sample) -> f64| {
        add_each(symmetry, of, &|index| by(&samples[index]));
    };

    let fastest = evidence.fastest().max(f64::MIN_POSITIVE);
    let speed = |sample: &Sample| sample.speeds.left.abs().max(sample.speeds.right.abs()) / fastest;
    let direction = |sample: &Sample| sign(sample.speeds.left + sample.speeds.right);
    let turn = |sample: &Sample| sign(sample.speeds.right - sample.speeds.left);
    let is = |sample: &Sample, manoeuvre: Manoeuvre| {
        if Manoeuvre::of(sample) == manoeuvre { 1.0 } else { 0.0 }
    };

    for of in [middle, half, y] {
        add(Symmetry::SpeedScale, of, &|s| speed(s) - 0.5);
        add(Symmetry::SpeedScale, of, &|s| (speed(s) - 0.5).powi(2));
        add(Symmetry::Reversal, of, &direction);
        add(Symmetry::Reversal, of, &turn);
        add(Symmetry::Manoeuvre, of, &|s| is(s, Manoeuvre::Arc));
        add(Symmetry::Manoeuvre, of, &|s| is(s, Manoeuvre::CounterRotation));
    }
    for of in [half, y] {
        add(Symmetry::Mirror, of, &|s| direction(s) * turn(s));
        add(Symmetry::Mirror, of, &turn);
    }
    add(Symmetry::Mirror, middle, &direction);
    let straight = |s: &Sample| is(s, Manoeuvre::Straight) * s.duration;
    for channel in 0..3 {
        let unit =
            vec![Vector3::from_fn(|k, _| if k == channel { 1.0 } else { 0.0 }); samples.len()];
        add(Symmetry::Straight, &unit, &straight);
        add(Symmetry::Straight, &unit, &|s| {
            straight(s) * f64::midpoint(s.speeds.left, s.speeds.right)
        });
    }
    if evidence.is_steady() {
        return all;
    }

    for of in [middle, half, y] {
        for by in [f64::cos, f64::sin] {
            add(Symmetry::Heading, of, &|s| by(s.pose.yaw));
            add(Symmetry::Heading, of, &|s| by(s.pose.yaw) * turn(s));
            add(Symmetry::Heading, of, &|s| by(2.0 * s.pose.yaw));
        }
    }
    let (x_at, y_at) =
        (scaled(samples, |s: &Sample| s.pose.x), scaled(samples, |s: &Sample| s.pose.y));
    for of in [middle, half, y] {
        add(Symmetry::Place, of, &x_at);
        add(Symmetry::Place, of, &y_at);
        add(Symmetry::Place, of, &|s| x_at(s) * y_at(s));
        add(Symmetry::Place, of, &|s| x_at(s).powi(2) - 0.3);
        add(Symmetry::Place, of, &|s| y_at(s).powi(2) - 0.3);
    }
    let time = scaled(samples, |s: &Sample| s.start);
    for of in [middle, half, y] {
        add(Symmetry::Time, of, &time);
        add(Symmetry::Time, of, &|s| time(s).powi(2) - 0.3);
    }
    // What changes of speed do: the motion is ahead of the speeds or behind them.
    let change = |s: &Sample| (s.acceleration.left + s.acceleration.right) * s.duration / 2.0;
    let turning = |s: &Sample| (s.acceleration.right - s.acceleration.left) * s.duration;
    let along = |channel: usize| {
        vec![Vector3::from_fn(|k, _| if k == channel { 1.0 } else { 0.0 }); samples.len()]
    };
    add(Symmetry::Transient, &along(0), &change);
    add(Symmetry::Transient, &along(1), &turning);
    add(Symmetry::Transient, &along(2), &turning);
    let hurry = |s: &Sample| {
        (s.acceleration.left.abs() + s.acceleration.right.abs()) * s.duration / fastest
    };
    for of in [middle, half, y] {
        add(Symmetry::Transient, of, &hurry);
    }
    // What a track does where it turns round: play in its drive, or soil that yields the other way.
    let turned = turned(evidence);
    add_each(Symmetry::Transient, &along(0), &|k| turned[k].right + turned[k].left);
    for channel in [1, 2] {
        add_each(Symmetry::Transient, &along(channel), &|k| turned[k].right - turned[k].left);
    }
    all.extend(past::contrasts(evidence, [middle, half, y]));
    all
}

/// Part of the fastest speed from which on a track counts as running.
const RUNNING: f64 = 0.02;

/// How often each track turns round in each sample: to forward positive, to backward negative.
fn turned(evidence: &Evidence) -> Vec<PerSide<f64>> {
    let slowest = RUNNING * evidence.fastest();
    let mut turned = Vec::with_capacity(evidence.samples().len());
    let mut before = (0, PerSide::new(0.0, 0.0));
    for sample in evidence.samples() {
        if before.0 != sample.run {
            before = (sample.run, PerSide::new(0.0, 0.0));
        }
        let until = sample.start + sample.duration;
        let mut sum = PerSide::new(0.0, 0.0);
        for held in held(&evidence.tracks()[sample.run], sample.start, until, evidence.tau()) {
            for side in Side::BOTH.into_iter().filter(|side| held.speeds[*side].abs() > slowest) {
                let now = held.speeds[side].signum();
                if before.1[side] * now < 0.0 {
                    sum[side] += now;
                }
                before.1[side] = now;
            }
        }
        turned.push(sum);
    }
    turned
}

fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

/// A coordinate from −1 to 1 over the samples.
fn scaled(samples: &[Sample], of: impl Fn(&Sample) -> f64) -> impl Fn(&Sample) -> f64 {
    let range = samples.iter().map(&of);
    let (low, high) =
        range.fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
    let (middle, half) = (f64::midpoint(low, high), ((high - low) / 2.0).max(f64::MIN_POSITIVE));
    move |sample| (of(sample) - middle) / half
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use trackdyn_core::Pose;
    use trackdyn_identify::weighting::SegmentNoise;
    use trackdyn_recording::TrackSample;

    /// Two runs through the same speeds of the left track, one per sample, the right one at 0.3 m/s.
    pub(in crate::locate) fn two_runs(left: &[f64]) -> Evidence {
        let last = left.last().copied().expect("a speed");
        let speeds = left.iter().flat_map(|speed| std::iter::repeat_n(*speed, READINGS));
        let reading = |(k, speed): (u32, f64)| TrackSample {
            t: 0.03 * f64::from(k),
            v_left: speed,
            v_right: 0.3,
        };
        let tracks: Vec<TrackSample> = (0..).zip(speeds.chain([last])).map(reading).collect();
        let run = || PlannedRun { pose: Pose::default(), tracks: tracks.clone(), blocks: vec![0] };
        let noise = SegmentNoise { pose: [1e-6; 3], walk: [1e-6; 3], heading: 0.0 };
        Evidence::planned(&[run(), run()], noise, 0.0, |evidence| {
            vec![Vector3::zeros(); evidence.samples().len()]
        })
    }

    #[test]
    fn a_track_turns_round_where_it_goes_the_other_way_after_whatever_rest() {
        // forward, rest, backward, noise of a standing encoder, forward; the other track runs on
        let left = [0.5, 0.5, 0.0, -0.4, -0.001, 0.001, 0.6, 0.6];
        let evidence = two_runs(&left);
        let once = [0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0];
        let found = turned(&evidence);
        // a run knows nothing of the one before
        let expected = [once, once].concat();
        assert_eq!(found.iter().map(|turned| turned.left).collect::<Vec<_>>(), expected);
        assert!(found.iter().all(|turned| turned.right == 0.0));
    }
}
