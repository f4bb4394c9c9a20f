//! What was driven, in numbers.

use super::travel::travel_ratio;
use trackdyn_core::robust::usual_interval;
use trackdyn_core::{PerSide, real};
use trackdyn_estimate::gyroscope::{self, Gyroscope, Unfit, with_gyroscope};
use trackdyn_estimate::noise::{self, noise};
use trackdyn_estimate::{Clock, Error, Observations, SegmentOptions, Separation, clock};
use trackdyn_recording::{Recording as Motion, Run, TrackSample};

/// Share of the top speed below which a track stands.
const MAX_STANDING_SPEED: f64 = 0.01;

/// Difference of the track speeds, in their sum, up to which driving is straight.
const MAX_STRAIGHT_DIFFERENCE: f64 = 0.1;

/// Slower track in the faster one, from which on tracks that run against each other spin the robot
/// on the spot.
const MIN_SPIN: f64 = 0.5;

/// Turn from which on the yaw of the poses counts as turning and not as noise, rad.
const MIN_TURN: f64 = 0.5;

/// Rows of a series.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rows {
    /// How many.
    pub count: usize,
    /// Median time between them, s.
    pub interval: f64,
    /// Stamps of the first and the last, s.
    pub stamps: [f64; 2],
}

impl Rows {
    /// The rows with these stamps, run by run.
    pub(super) fn of(runs: &[Vec<f64>]) -> Self {
        let all = || runs.iter().flatten().copied();
        let longest = runs.iter().max_by_key(|run| run.len());
        Self {
            count: all().count(),
            interval: longest.map_or(0.0, |run| usual_interval(run.iter().copied())),
            stamps: [all().next().unwrap_or_default(), all().last().unwrap_or_default()],
        }
    }
}

/// What was driven.
#[derive(Clone, Debug)]
pub struct Driving {
    /// The robot, as the recording calls it.
    pub robot: String,
    /// Runs.
    pub runs: usize,
    /// Time of all runs, s.
    pub duration: f64,
    /// Readings of the tracks.
    pub tracks: Rows,
    /// Poses.
    pub poses: Rows,
    /// Readings of an IMU.
    pub imu: Rows,
    /// What its gyroscope would tell of the yaw of the poses, or why it does not serve; none
    /// without one, or without poses.
    pub gyroscope: Option<Result<Gyroscope, Unfit>>,
    /// Whether positions are known, and not yaw alone.
    pub has_positions: bool,
    /// Fastest track speed, m/s.
    pub fastest: f64,
    /// Clock offset, or why none can be right.
    pub clock: Result<Clock, Error>,
    /// Pieces between two poses that readings cover.
    pub segments: usize,
    /// Way of the middle between the tracks, by their readings, m.
    pub distance: f64,
    /// Part of it that is straight, m.
    pub straight: f64,
    /// Turning to the left and to the right, rad.
    pub turned: PerSide<f64>,
    /// Part of it on the spot, rad.
    pub spun: PerSide<f64>,
    /// Turning of the poses, whatever the tracks do, rad.
    pub turned_by_poses: f64,
    /// Time in which both tracks stand, s.
    pub standing: f64,
    /// Whether the noise of the poses can be measured, at rest or in steady driving.
    pub has_noise: bool,
    /// The distance of the ICRs from turning alone, or why it is not determined.
    pub separation: Result<Separation, Error>,
    /// Way of the poses per way of the tracks, turning apart: a wheel radius that is wrong, or
    /// slip; none where poses have no positions, or do not show it.
    pub travel_ratio: Option<f64>,
    pub(super) observations: Observations,
}

impl Driving {
    /// What a recording says of its gyroscope beside this.
    pub(super) fn with_gyroscope(self, motion: &Motion) -> Self {
        let has_both = self.has_positions && self.imu.count > 0;
        let tau = self.clock.as_ref().map_or(0.0, Clock::tau);
        let found = has_both.then(|| with_gyroscope(motion, tau, &gyroscope::Settings::default()));
        let gyroscope = found.map(|found| found.map(|corrected| corrected.gyroscope));
        Self { gyroscope, ..self }
    }

    /// What was driven, without the gyroscope.
    pub(super) fn of(motion: &Motion, tau: Option<f64>) -> Self {
        let runs = motion.runs();
        let clock = Clock::of(motion, tau, &clock::Settings::default());
        let tau = clock.as_ref().map_or(0.0, Clock::tau);
        let noise = noise(motion, tau, &noise::Settings::default());
        let options = SegmentOptions { tau, ..SegmentOptions::default() };
        let observations = Observations::new(motion, &options);
        let rows =
            |stamps: fn(&Run) -> Vec<f64>| Rows::of(&runs.iter().map(stamps).collect::<Vec<_>>());
        let readings = || runs.iter().flat_map(Run::tracks);
        let fastest = readings().map(largest).fold(0.0, f64::max);
        let mut of = Self {
            robot: motion.robot().to_owned(),
            runs: runs.len(),
            duration: motion.duration(),
            tracks: rows(|run| run.tracks().iter().map(|row| row.t).collect()),
            poses: rows(|run| run.poses().iter().map(|row| row.t).collect()),
            imu: rows(|run| run.imu().iter().map(|row| row.t).collect()),
            gyroscope: None,
            has_positions: motion.has_positions(),
            fastest,
            clock,
            segments: observations.len(),
            distance: 0.0,
            straight: 0.0,
            turned: PerSide::default(),
            spun: PerSide::default(),
            turned_by_poses: 0.0,
            standing: runs.iter().map(|run| standing(run.tracks(), fastest)).sum(),
            has_noise: noise.moving.is_some() || noise.standing.is_some(),
            separation: Separation::of_motions(&observations)
                .map(|found| found.with_yaw_scale(motion.yaw_scale_deviation())),
            travel_ratio: None,
            observations,
        };
        of.add_up();
        of
    }

    /// Adds up ways and turning over the segments.
    fn add_up(&mut self) {
        let mut turning = 0.0_f64;
        for segment in self.observations.segments() {
            turning += segment.motion[2];
            if turning.abs() >= MIN_TURN {
                self.turned_by_poses += turning.abs();
                turning = 0.0;
            }
            let PerSide { left, right } = self.observations.travelled(segment);
            let (way, more) = (f64::midpoint(left, right).abs(), right - left);
            let larger = left.abs().max(right.abs());
            self.distance += way;
            if more.abs() <= MAX_STRAIGHT_DIFFERENCE * 2.0 * way {
                self.straight += way;
                continue;
            }
            // The noise of yaw that is no turning cancels.
            let turned = more.signum() * segment.motion[2];
            let of = |sums: &mut PerSide<f64>| {
                *(if more > 0.0 { &mut sums.left } else { &mut sums.right }) += turned;
            };
            of(&mut self.turned);
            let is_spin = left * right < 0.0 && left.abs().min(right.abs()) >= MIN_SPIN * larger;
            if is_spin {
                of(&mut self.spun);
            }
        }
        if self.has_positions {
            self.travel_ratio = travel_ratio(&self.observations);
        }
    }
}

/// The faster track of a reading, m/s.
fn largest(reading: &TrackSample) -> f64 {
    reading.v_left.abs().max(reading.v_right.abs())
}

/// Time in which both tracks stand, s; of readings at usual intervals.
fn standing(tracks: &[TrackSample], fastest: f64) -> f64 {
    let usual = usual_interval(tracks.iter().map(|reading| reading.t));
    let still = tracks.iter().filter(|reading| largest(reading) <= MAX_STANDING_SPEED * fastest);
    usual * real(still.count())
}
