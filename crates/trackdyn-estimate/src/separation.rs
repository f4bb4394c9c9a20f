//! The distance between the ICRs from turning alone, where nothing is known of the place.
//!
//! # Law
//! Δψᵢ = k Dᵢ + b Δtᵢ + noise, eq. (9) over a time Δt in which the robot turns by Δψ and the right
//! track runs D further than the left one; x_r − x_l = 1/k, and b is the bias of a gyroscope, 0 in
//! tables of steady points. Residuals count by Huber's loss.
//!
//! # Assumes
//! α = 1 on both sides. Parts of a drive ([`Blocks`]), or points of a table, say
//! nothing of one another: the interval is that of a jackknife over them.

use crate::error::Error;
use crate::gauss_newton::Loss;
use crate::observations::Observations;
use crate::response::Response;
use crate::{Blocks, Clock, Interval, SegmentOptions, clock};
use nalgebra::{Matrix2, Vector2};
use trackdyn_core::real;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_recording::{OperatingPoint, Recording};

/// Fewest turns, of a drive or of a table: two have one degree of freedom left, whose interval is
/// wide as it should be.
const MIN_TURNS: usize = 2;

/// Smallest standard error, as share of the distance: two spins that are timed by hand may agree by
/// chance, and a hand with a watch does not time one to half a percent.
const MIN_ERROR: f64 = 0.005;

/// Least number of turns whose scatter determines their error.
const ENOUGH_TURNS: usize = 5;

/// Least turning of a drive in all, rad: half a turn.
const MIN_YAW: f64 = std::f64::consts::PI;

/// Largest half width of an interval, as share of the distance: with a separation that is known
/// less well, odometry is no better than with a guess.
const MAX_HALF_WIDTH: f64 = 0.25;

/// Least share of the turning against the tracks that a refusal names as its reason, where no
/// distance fits.
const MIN_AGAINST: f64 = 0.2;

/// Share of the turning against the tracks at which every distance is refused.
const MAX_AGAINST: f64 = 0.4;

/// Reweighting has settled long before.
const ITERATIONS: usize = 50;

/// The distance between the ICRs, without where they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// x_r − x_l, m.
    pub gap: Interval,
    /// Turns that it comes from: segments of a drive, or points of a table.
    pub turns: usize,
    /// Parts that count as independent.
    pub groups: usize,
}

/// What a time of driving, or a steady point, says.
#[derive(Clone, Copy)]
struct Turn {
    /// ∫ (V_r − V_l) dt, m; of a point V_r − V_l, m/s.
    difference: f64,
    /// Δψ, rad; of a point ω, rad/s.
    yaw: f64,
    /// Δt, s; 0 for a point.
    duration: f64,
    /// The part that it belongs to.
    group: usize,
}

/// What a recording says whose poses have a yaw alone.
#[derive(Clone, Debug)]
pub struct Turning {
    /// Clock offset.
    pub clock: Clock,
    /// How the poses follow the track speeds; none where the recording is too short to tell.
    pub response: Option<Response>,
    /// Segments.
    pub segments: usize,
    /// The distance of the ICRs.
    pub separation: Separation,
}

impl Turning {
    /// What the yaw of a recording says; `tau` is the clock offset, s, where it is given.
    ///
    /// # Errors
    /// Those of [`Clock::of`] and [`Separation::of_motions`].
    pub fn of(recording: &Recording, tau: Option<f64>) -> Result<Self, Error> {
        let clock = Clock::of(recording, tau, &clock::Settings::default())?;
        let options = SegmentOptions { tau: clock.tau(), ..SegmentOptions::default() };
        let observations = Observations::new(recording, &options);
        let mut separation = Separation::of_motions(&observations)?;
        let response = Response::of(recording, clock.tau());
        if let Some(response) = response.as_ref().filter(|response| !response.is_at_once()) {
            separation.gap = response.gap;
        }
        let separation = separation.with_yaw_scale(recording.yaw_scale_deviation());
        Ok(Self { clock, response, segments: observations.len(), separation })
    }
}

impl Separation {
    /// χ = L/(x_r − x_l), eq. (12), for a gauge, m.
    pub fn steering_efficiency(&self, gauge: f64) -> Interval {
        self.gap.dividing(gauge)
    }

    /// The distance, widened by a relative error of this standard deviation that all yaw shares. No
    /// scatter shows such an error.
    #[must_use]
    pub fn with_yaw_scale(self, deviation: f64) -> Self {
        Self { gap: self.gap.with_error(deviation * self.gap.value), ..self }
    }

    /// The distance by the segments of a drive.
    ///
    /// # Errors
    /// [`Error::NotEstimable`] where the robot turns by less than half a turn in all.
    pub fn of_motions(observations: &Observations) -> Result<Self, Error> {
        let ranges = observations
            .ranges(&observations.blocks(Blocks::MIN_WHOLE_RUNS))
            .into_iter()
            .enumerate();
        let turns: Vec<Turn> = ranges
            .flat_map(|(group, range)| {
                observations.segments()[range].iter().map(move |segment| {
                    let travelled = observations.travelled(segment);
                    let difference = travelled.right - travelled.left;
                    let (yaw, duration) = (segment.motion[2], segment.duration);
                    Turn { difference, yaw, duration, group }
                })
            })
            .collect();
        let turned: f64 = turns.iter().map(|turn| turn.yaw.abs()).sum();
        if turned < MIN_YAW {
            return Err(refused(format!(
                "the robot turns by {turned:.2} rad in all, {MIN_YAW:.1} rad needed: drive turns, \
                 both ways"
            )));
        }
        Self::of_turns(&turns)
    }

    /// The distance by the yaw rates of steady points.
    ///
    /// # Errors
    /// [`Error::NotEstimable`] with fewer than two that turn.
    pub fn of_points(points: &[OperatingPoint]) -> Result<Self, Error> {
        let turns = points.iter().enumerate().filter_map(|(group, point)| {
            let difference = point.v_right - point.v_left;
            Some(Turn { difference, yaw: point.yaw_rate?, duration: 0.0, group })
        });
        Self::of_turns(&turns.filter(|turn| turn.difference != 0.0).collect::<Vec<_>>())
    }

    fn of_turns(turns: &[Turn]) -> Result<Self, Error> {
        let mut groups: Vec<usize> = turns.iter().map(|turn| turn.group).collect();
        groups.dedup();
        if turns.len() < MIN_TURNS || groups.len() < MIN_TURNS {
            let found = groups.len();
            return Err(refused(format!("{found} turns, {MIN_TURNS} needed")));
        }
        let gap = 1.0 / slope(turns.iter());
        let without: Vec<f64> = groups
            .iter()
            .map(|group| 1.0 / slope(turns.iter().filter(|turn| turn.group != *group)))
            .collect();
        let of_scatter = Interval::of_jackknife(gap, &without).map(|found| {
            let is_told = groups.len() >= ENOUGH_TURNS;
            let least = if is_told { 0.0 } else { MIN_ERROR * found.value.abs() };
            Interval::new(found.value, found.deviation.max(least), groups.len(), 1)
        });
        let against = against(turns);
        let goes_against = || {
            refused(format!(
                "{:.0} % of the turning goes against the tracks: yaw falls where the right track \
                 is faster: expected yaw that is positive counter-clockwise, and v_right > v_left \
                 there: a sign is wrong there, or left and right are swapped",
                100.0 * against
            ))
        };
        match of_scatter {
            _ if against >= MAX_AGAINST => Err(goes_against()),
            Some(gap) if gap.low > 0.0 && gap.half_width() <= MAX_HALF_WIDTH * gap.value => {
                Ok(Self { gap, turns: turns.len(), groups: groups.len() })
            }
            Some(gap) if gap.low > 0.0 && gap.high.is_finite() => Err(refused(format!(
                "yaw follows the tracks too loosely: {:.2} m, and 95 % from {:.2} to {:.2} m, \
                 where a quarter of it is needed: drive more turns, both ways, or look at the \
                 gyroscope's axes and at slipping wheels",
                gap.value, gap.low, gap.high
            ))),
            _ if against >= MIN_AGAINST => Err(goes_against()),
            _ => Err(refused(format!(
                "yaw does not follow the tracks: {gap:.3} m, with an interval that holds no \
                 distance of any robot"
            ))),
        }
    }
}

/// Share of the turning that goes against the tracks.
fn against(turns: &[Turn]) -> f64 {
    let sum = |of: &dyn Fn(&Turn) -> f64| turns.iter().map(of).sum::<f64>();
    let against = sum(&|turn| (-turn.yaw * turn.difference.signum()).max(0.0));
    against / sum(&|turn| turn.yaw.abs())
}

fn refused(reason: String) -> Error {
    Error::NotEstimable { what: "the distance of the ICRs", reason }
}

/// k by Huber's loss, from plain squares on.
fn slope<'a>(turns: impl Iterator<Item = &'a Turn>) -> f64 {
    let turns: Vec<Turn> = turns.copied().collect();
    let by = |weight: &dyn Fn(&Turn) -> f64| {
        let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
        for turn in &turns {
            let by = Vector2::new(turn.difference, turn.duration);
            matrix += weight(turn) * by * by.transpose();
            right += weight(turn) * by * turn.yaw;
        }
        // without times, there is no bias
        matrix[(1, 1)] += f64::from(u8::from(matrix[(1, 1)] == 0.0));
        matrix.try_inverse().map_or(Vector2::repeat(f64::NAN), |inverse| inverse * right)
    };
    let mut found = by(&|_| 1.0);
    for _ in 0..ITERATIONS {
        let left = |turn: &Turn| turn.yaw - found.x * turn.difference - found.y * turn.duration;
        let mut sizes: Vec<f64> = turns.iter().map(left).collect();
        // Half of the residuals may be rounded away.
        let least = f64::EPSILON * turns.iter().map(|turn| turn.yaw.abs()).sum::<f64>();
        let spread = deviation_about_zero(&mut sizes).unwrap_or(0.0).max(least / real(turns.len()));
        if spread <= 0.0 {
            break;
        }
        let next = by(&|turn| Loss::Huber.weight(left(turn) / spread));
        let is_settled = (next.x - found.x).abs() <= 1e-12 * found.x.abs();
        found = next;
        if is_settled {
            break;
        }
    }
    found.x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{Synthetic, random_steps};
    use trackdyn_core::Pose;
    use trackdyn_recording::Warning;

    #[test]
    fn spins_timed_by_hand_give_the_distance_with_its_interval() {
        let point = |(v, yaw_rate): (f64, f64)| OperatingPoint {
            v_left: -v,
            v_right: v,
            yaw_rate: Some(yaw_rate),
            ..OperatingPoint::default()
        };
        // 1.02 m, timed to a percent
        let spins = [(0.29, 0.574), (-0.29, -0.563), (0.2, 0.39), (-0.2, -0.396), (0.4, 0.78)];
        let found = Separation::of_points(&spins.map(point)).expect("enough spins");
        assert!(found.gap.low < 1.02 && 1.02 < found.gap.high, "{found:?}");
        assert!(found.gap.half_width() < 0.03, "{found:?}");
        let loose = [(0.29, 0.574), (-0.29, -0.263), (0.2, 0.39), (-0.2, -0.196), (0.4, 0.48)];
        let loose = Separation::of_points(&loose.map(point)).expect_err("any distance");
        assert!(loose.to_string().contains("too loosely"), "{loose}");
        let few = Separation::of_points(&[point(spins[0]), point(spins[1])]).expect("two spins");
        assert!(few.gap.low < 1.02 && 1.02 < few.gap.high, "{few:?}");
        // one degree of freedom: t₀.₉₇₅(1) = 12.7
        assert!(few.gap.half_width() > 0.06, "{few:?}");
        let against = Separation::of_points(&[point(spins[0]), point((-0.29, 0.57))]);
        let against = against.expect_err("both turn left").to_string();
        assert!(against.contains("50 % of the turning goes against the tracks"), "{against}");
        let one = Separation::of_points(&[point(spins[0])]);
        assert!(matches!(one, Err(Error::NotEstimable { .. })));
    }

    #[test]
    fn turning_alone_gives_the_distance_beside_outliers() {
        let synthetic = |seed: u64| Synthetic {
            schedules: (0..4).map(|run| random_steps(20, 2.0, 0.8, 10 * seed + run)).collect(),
            encoder_noise: 0.01,
            yaw_noise: 0.002,
            position_noise: 0.0,
            seed,
            ..Synthetic::default()
        };
        let mut within = 0;
        for seed in 0..20 {
            let recording = synthetic(seed).recording().expect("long enough");
            let runs = recording.runs().iter().cloned().map(|run| {
                let mut rows = run.into_rows();
                for (k, sample) in rows.poses.samples.iter_mut().enumerate() {
                    // places say nothing, and a yaw here and there is wrong
                    sample.pose.x = 0.0;
                    sample.pose.y = 0.0;
                    sample.pose.yaw += if k % 97 == 41 { 0.5 } else { 0.0 };
                    // the bias of a gyroscope
                    sample.pose.yaw += 0.02 * sample.t;
                }
                rows
            });
            let source = trackdyn_recording::Source::computed();
            let alone = trackdyn_recording::Recording::new(
                "yaw",
                "robot",
                runs.collect(),
                source,
                Vec::new(),
            );
            let observations =
                Observations::new(&alone.expect("usable"), &SegmentOptions::default());
            let found = Separation::of_motions(&observations).expect("turns");
            assert!((found.gap.value - 0.832).abs() < 0.01, "{found:?}");
            within += usize::from(found.gap.low < 0.832 && 0.832 < found.gap.high);
        }
        // 95 % of 20, and three standard deviations of the count below it
        assert!(within >= 16, "{within} of 20 intervals");
    }

    /// No scatter shows that a gyroscope says too much of every turn.
    #[test]
    fn the_scale_of_a_gyroscope_is_in_the_interval() {
        let synthetic = Synthetic {
            schedules: (0..4).map(|run| random_steps(20, 2.0, 0.8, run)).collect(),
            yaw_noise: 0.002,
            ..Synthetic::default()
        };
        let drive = synthetic.recording().expect("long enough");
        let gap = |scale: f64, warnings: Vec<Warning>| {
            let runs = drive.runs().iter().cloned().map(|run| {
                let mut rows = run.into_rows();
                for sample in &mut rows.poses.samples {
                    sample.pose = Pose::new(f64::NAN, f64::NAN, scale * sample.pose.yaw);
                }
                rows
            });
            let source = trackdyn_recording::Source::computed();
            let alone = Recording::new("yaw", "robot", runs.collect(), source, warnings);
            let found = Turning::of(&alone.expect("usable"), Some(0.0)).expect("turns");
            found.separation.gap
        };
        let gyroscope = || vec![Warning::YawOfGyroscope { gyroscope: "imu".to_owned() }];
        let measured = gap(1.015, Vec::new());
        assert!(measured.high < 0.832, "{measured:?}");
        let integrated = gap(1.015, gyroscope());
        assert!(integrated.low < 0.832 && 0.832 < integrated.high, "{integrated:?}");
        assert_eq!(integrated.value, measured.value);
        assert!(integrated.half_width() < 0.03 * integrated.value, "{integrated:?}");
    }
}
