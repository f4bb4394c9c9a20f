//! Contrasts: functions of the driving that break one symmetry each.
//!
//! Functions on the sectors of (V_l, V_r) are even or odd under reversal R and mirroring M. With c
//! the sign of V_l + V_r and d that of V_r − V_l: c is odd under R, d under R and M, c d under M.
//! Of the ICRs, the middle a = (x_l + x_r)/2 is odd under M; half their distance h and y are even.

use super::departures::{Contrasts, middle_half_y};
use super::{IcrColumns, past};
use crate::evidence::{Evidence, Origin, Sample};
use crate::settings;
use nalgebra::Vector3;
use trackdyn_core::{PerSide, Side};
use trackdyn_model::effect::Symmetry;
use trackdyn_recording::hold::held;

/// Kind of motion of a sample, by its track speeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Manoeuvre {
    /// Equal track speeds.
    Straight,
    /// Both tracks forward, or both backward.
    Arc,
    /// Opposite directions at different speeds.
    CounterRotation,
    /// Opposite directions at about equal speeds.
    Spin,
}

impl Manoeuvre {
    /// Manoeuvre of a sample, by the ratio of its slower to its faster track, from −1 (spin) to 1
    /// (straight).
    pub fn of(sample: &Sample, settings: &settings::Location) -> Self {
        let (left, right) = (sample.speeds.left, sample.speeds.right);
        let (slow, fast) = if left.abs() < right.abs() { (left, right) } else { (right, left) };
        let ratio = if fast == 0.0 { 1.0 } else { slow / fast };
        if ratio > settings.min_straight_ratio {
            Self::Straight
        } else if ratio >= 0.0 {
            Self::Arc
        } else if ratio > settings.max_spin_ratio {
            Self::CounterRotation
        } else {
            Self::Spin
        }
    }

    /// Name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Straight => "straight driving",
            Self::Arc => "arcs",
            Self::CounterRotation => "counter-rotation",
            Self::Spin => "spins",
        }
    }
}

/// Contrasts of all symmetries that the evidence can test, not whitened.
///
/// `icrs` is the Jacobian of the prediction by x_l, x_r and y.
pub fn contrasts(evidence: &Evidence, icrs: &IcrColumns) -> Vec<Contrasts> {
    let mut all = contrasts_within(&Scales::of(evidence), evidence, icrs);
    for one in &mut all {
        one.columns.retain(|column| column.iter().any(|value| value.norm() > 0.0));
    }
    all.retain(|one| !one.columns.is_empty());
    all
}

/// Ranges to which the functions of the driving are scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Largest track speed, m/s.
    fastest: f64,
    /// Ranges of x (m), y (m) and time (s).
    ranges: [[f64; 2]; 3],
}

impl Scales {
    /// Those of evidence.
    pub fn of(evidence: &Evidence) -> Self {
        let of: [fn(&Sample) -> f64; 3] = [|s| s.pose.x, |s| s.pose.y, |s| s.start];
        let ranges = of.map(|of| {
            let values = evidence.samples().iter().map(of);
            values.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)])
        });
        Self { fastest: evidence.fastest().max(f64::MIN_POSITIVE), ranges }
    }

    /// Ranges that hold those of both.
    pub fn joined(&self, other: &Self) -> Self {
        let range = |k: usize| {
            let ([a, b], [c, d]) = (self.ranges[k], other.ranges[k]);
            [a.min(c), b.max(d)]
        };
        Self { fastest: self.fastest.max(other.fastest), ranges: [0, 1, 2].map(range) }
    }

    /// A coordinate of a sample, scaled to the range from −1 to 1.
    fn scaled(&self, axis: usize, of: impl Fn(&Sample) -> f64) -> impl Fn(&Sample) -> f64 {
        let [low, high] = self.ranges[axis];
        let (middle, half) =
            (f64::midpoint(low, high), ((high - low) / 2.0).max(f64::MIN_POSITIVE));
        move |sample| (of(sample) - middle) / half
    }
}

/// Contrasts scaled to these ranges. Each has all its columns, also those that are zero here: two
/// sets of recordings have the same ones.
pub fn contrasts_within(scales: &Scales, evidence: &Evidence, icrs: &IcrColumns) -> Vec<Contrasts> {
    let moved = &middle_half_y(icrs);
    let (samples, settings) = (evidence.samples(), &evidence.settings().location);
    let mut collector = Collector { samples, settings, moved, scales, all: Vec::new() };
    let fastest = scales.fastest;
    collector.of_speed_and_direction(fastest);
    collector.of_straight_driving();
    if matches!(evidence.origin(), Origin::SteadyPoints(_)) {
        return collector.all;
    }
    if evidence.has_world() {
        collector.of_heading();
        collector.of_place();
    }
    collector.of_time();
    collector.of_changes_of_speed(fastest);
    collector.of_turning_round(&turned(evidence));
    let mut all = collector.all;
    all.push(past::contrasts(evidence, moved));
    all
}

/// Collects contrasts, symmetry by symmetry.
struct Collector<'a> {
    samples: &'a [Sample],
    settings: &'a settings::Location,
    /// Jacobian by a, h and y.
    moved: &'a [Vec<Vector3<f64>>; 3],
    scales: &'a Scales,
    all: Vec<Contrasts>,
}

impl Collector<'_> {
    /// Adds a column multiplied by a function of the sample's index.
    fn add_each(&mut self, symmetry: Symmetry, of: &[Vector3<f64>], by: impl Fn(usize) -> f64) {
        let column: Vec<Vector3<f64>> =
            of.iter().enumerate().map(|(index, value)| value * by(index)).collect();
        match self.all.iter_mut().find(|one| one.symmetry == symmetry) {
            Some(contrasts) => contrasts.columns.push(column),
            None => self.all.push(Contrasts { symmetry, beside: &[], columns: vec![column] }),
        }
    }

    fn add(&mut self, symmetry: Symmetry, of: &[Vector3<f64>], by: impl Fn(&Sample) -> f64) {
        let samples = self.samples;
        self.add_each(symmetry, of, |index| by(&samples[index]));
    }

    /// Unit column of a channel: forward, left or yaw.
    fn along(&self, channel: usize) -> Vec<Vector3<f64>> {
        vec![Vector3::from_fn(|k, _| if k == channel { 1.0 } else { 0.0 }); self.samples.len()]
    }

    fn of_speed_and_direction(&mut self, fastest: f64) {
        let speed =
            |sample: &Sample| sample.speeds.left.abs().max(sample.speeds.right.abs()) / fastest;
        let settings = self.settings;
        for of in self.moved {
            self.add(Symmetry::SpeedScale, of, |s| speed(s) - 0.5);
            self.add(Symmetry::SpeedScale, of, |s| (speed(s) - 0.5).powi(2));
            self.add(Symmetry::Reversal, of, direction);
            self.add(Symmetry::Reversal, of, turn);
            self.add(Symmetry::Manoeuvre, of, |s| is(s, Manoeuvre::Arc, settings));
            let counter = |s: &Sample| is(s, Manoeuvre::CounterRotation, settings);
            self.add(Symmetry::Manoeuvre, of, counter);
        }
        let [middle, half, y] = self.moved;
        for of in [half, y] {
            self.add(Symmetry::Mirror, of, |s| direction(s) * turn(s));
            self.add(Symmetry::Mirror, of, turn);
        }
        self.add(Symmetry::Mirror, middle, direction);
    }

    fn of_straight_driving(&mut self) {
        let settings = self.settings;
        let straight = |s: &Sample| is(s, Manoeuvre::Straight, settings) * s.duration;
        let speed = |s: &Sample| f64::midpoint(s.speeds.left, s.speeds.right);
        for channel in 0..3 {
            let along = self.along(channel);
            self.add(Symmetry::Straight, &along, straight);
            self.add(Symmetry::Straight, &along, |s| straight(s) * speed(s));
        }
    }

    fn of_heading(&mut self) {
        for of in self.moved {
            for by in [f64::cos, f64::sin] {
                self.add(Symmetry::Heading, of, |s| by(s.pose.yaw));
                self.add(Symmetry::Heading, of, |s| by(s.pose.yaw) * turn(s));
                self.add(Symmetry::Heading, of, |s| by(2.0 * s.pose.yaw));
            }
        }
    }

    fn of_place(&mut self) {
        let x = self.scales.scaled(0, |s| s.pose.x);
        let y = self.scales.scaled(1, |s| s.pose.y);
        for of in self.moved {
            self.add(Symmetry::Place, of, &x);
            self.add(Symmetry::Place, of, &y);
            self.add(Symmetry::Place, of, |s| x(s) * y(s));
            self.add(Symmetry::Place, of, |s| x(s).powi(2) - 0.3);
            self.add(Symmetry::Place, of, |s| y(s).powi(2) - 0.3);
        }
    }

    fn of_time(&mut self) {
        let time = self.scales.scaled(2, |s| s.start);
        for of in self.moved {
            self.add(Symmetry::Time, of, &time);
            self.add(Symmetry::Time, of, |s| time(s).powi(2) - 0.3);
        }
    }

    /// Motion ahead of or behind the speeds, and ICRs that move as speeds change.
    fn of_changes_of_speed(&mut self, fastest: f64) {
        let change = |s: &Sample| (s.acceleration.left + s.acceleration.right) * s.duration / 2.0;
        let turning = |s: &Sample| (s.acceleration.right - s.acceleration.left) * s.duration;
        let [forward, left, yaw] = [0, 1, 2].map(|channel| self.along(channel));
        self.add(Symmetry::Transient, &forward, change);
        self.add(Symmetry::Transient, &left, turning);
        self.add(Symmetry::Transient, &yaw, turning);
        let size = |s: &Sample| s.acceleration.left.abs() + s.acceleration.right.abs();
        for of in self.moved {
            self.add(Symmetry::Transient, of, |s| size(s) * s.duration / fastest);
        }
    }

    /// Reversals of a track: backlash in its drive, or soil that yields the other way.
    fn of_turning_round(&mut self, turned: &[PerSide<f64>]) {
        let [forward, left, yaw] = [0, 1, 2].map(|channel| self.along(channel));
        self.add_each(Symmetry::Transient, &forward, |k| turned[k].right + turned[k].left);
        for of in [left, yaw] {
            self.add_each(Symmetry::Transient, &of, |k| turned[k].right - turned[k].left);
        }
    }
}

fn direction(sample: &Sample) -> f64 {
    sign(sample.speeds.left + sample.speeds.right)
}

fn turn(sample: &Sample) -> f64 {
    sign(sample.speeds.right - sample.speeds.left)
}

fn is(sample: &Sample, manoeuvre: Manoeuvre, settings: &settings::Location) -> f64 {
    if Manoeuvre::of(sample, settings) == manoeuvre { 1.0 } else { 0.0 }
}

/// Reversals of each track in each sample: positive to forward, negative to backward.
fn turned(evidence: &Evidence) -> Vec<PerSide<f64>> {
    let slowest = evidence.settings().location.min_running_speed * evidence.fastest();
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

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::settings::Settings;
    use trackdyn_core::Pose;
    use trackdyn_estimate::weighting::SegmentNoise;
    use trackdyn_recording::TrackSample;

    /// Two runs with these speeds of the left track, one per sample, and 0.3 m/s of the right one.
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
        let noise = SegmentNoise { pose: [1e-6; 3], walk: [1e-6; 3], heading: 0.0, stamp: 0.0 };
        Evidence::planned(&[run(), run()], noise, 0.0, &Settings::default(), |evidence| {
            vec![Vector3::zeros(); evidence.samples().len()]
        })
    }

    #[test]
    fn a_track_turns_round_where_it_goes_the_other_way_after_whatever_rest() {
        // forward, rest, backward, noise of a standing encoder, forward; the right track runs
        // steadily
        let left = [0.5, 0.5, 0.0, -0.4, -0.001, 0.001, 0.6, 0.6];
        let evidence = two_runs(&left);
        let once = [0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0];
        let found = turned(&evidence);
        // no memory of the previous run
        let expected = [once, once].concat();
        assert_eq!(found.iter().map(|turned| turned.left).collect::<Vec<_>>(), expected);
        assert!(found.iter().all(|turned| turned.right == 0.0));
    }
}
