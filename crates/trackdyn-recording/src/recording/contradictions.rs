//! Tracks and poses that contradict each other: units, signs and clocks that cannot be right.
//!
//! # Law
//! Every finding is a ratio or a correlation over many stretches of a recording, so that neither
//! slip nor single wrong readings decide. What slip can explain is left alone.

use super::by_poses::ByDelay;
use super::linear::{self, Linear};
use super::motion::Following;
use super::stretches::{Stretch, path_extent, stretches};
use super::{Run, UncheckedRun, counted, idle, jumps, saturated_gyro, stuck, unsigned};
use crate::doubt::Doubt;
use crate::sample::Stream;
use crate::unit;
use std::f64::consts::TAU;
use trackdyn_core::robust::{median, usual_interval};
use trackdyn_core::{Side, real};

/// Fewest stretches that a finding needs.
const MIN_STRETCHES: usize = 20;

/// Travel of the tracks per travel of the poses, or the reverse, that no slip explains.
const MIN_CONTRADICTION: f64 = 5.0;

/// Largest ratio of the upper to the lower quartile of this ratio: units change all stretches
/// alike, tracks that spin on the spot do not.
const MAX_QUARTILE_RATIO: f64 = 2.0;

/// Largest ratio of the effects of two columns on the turn, or on the way forward, at which they
/// are no pair of left and right. Both sides of a robot turn it alike, within a factor of its α and
/// ICRs.
const MAX_PART: f64 = 0.3;

/// Standard errors of that ratio that are allowed for.
const MIN_ERRORS: f64 = 3.0;

/// Correlation from which on two motions are one.
const MIN_CORRELATION: f64 = 0.7;

/// Least difference of the correlations of two explanations.
const MIN_CONTRAST: f64 = 0.3;

/// Longest usual interval of poses, s.
const MAX_INTERVAL: f64 = 2.0;

/// Least way that one track runs more than the other, m, before yaw has to have changed.
const MIN_WAY_DIFFERENCE: f64 = 1.0;

/// Least turning in degrees per metre that one track runs more than the other: that of ICRs 14 m
/// apart; in radians, of ICRs 0.25 m apart.
const MIN_DEGREES_PER_METRE: f64 = 4.0;

/// Least ratio of ways that differ by that of two units, where all stretches agree.
const MIN_UNIT_RATIO: f64 = 3.0;

/// Largest factor between such a ratio and that of the units.
const MAX_UNIT_ERROR: f64 = 1.15;

/// Largest ratio of its quartiles.
const MAX_UNIT_QUARTILE_RATIO: f64 = 1.3;

/// Largest distance of twice the sum of path and heading from half a turn, rad, at which the
/// heading is that of a compass.
const MAX_COMPASS_DEVIATION: f64 = 0.5;

/// Share of the rows with the stamp of another one from which on stamps are too coarse.
const MIN_COARSE_SHARE: f64 = 0.5;

/// What contradicts the rows of a run before they are cleaned.
pub(super) fn of_rows(rows: &UncheckedRun) -> Option<Doubt> {
    coarse_stamps(rows).or_else(|| yaw_unit(rows))
}

/// Stamps that most rows share with the one before, of which they are no copies.
fn coarse_stamps(rows: &UncheckedRun) -> Option<Doubt> {
    let shared = |stream: Stream, shared: usize, of: usize| {
        (real(shared) > MIN_COARSE_SHARE * real(of)).then_some(Doubt::CoarseStamps {
            stream,
            shared,
            of,
        })
    };
    let (tracks, poses) = (&rows.tracks.samples, &rows.poses.samples);
    let of_tracks = tracks
        .windows(2)
        .filter(|pair| pair[0].t == pair[1].t && pair[0].speeds() != pair[1].speeds());
    let of_poses =
        poses.windows(2).filter(|pair| pair[0].t == pair[1].t && pair[0].pose != pair[1].pose);
    shared(Stream::Tracks, of_tracks.count(), tracks.len())
        .or_else(|| shared(Stream::Poses, of_poses.count(), poses.len()))
}

/// Yaw that follows the path in degrees, or as a compass shows it.
fn yaw_unit(rows: &UncheckedRun) -> Option<Doubt> {
    let poses = &rows.poses.samples;
    let steps = path_extent(poses).map(|extent| extent / 40.0).filter(|step| *step > 0.0)?;
    let mut paths = Directions::default();
    // in radians and in degrees, each counter-clockwise from x and clockwise
    let mut radians = [Directions::default(); 2];
    let mut degrees = [Directions::default(); 2];
    let finite = |pose: &trackdyn_core::Pose| pose.x.is_finite() && pose.yaw.is_finite();
    let mut finite = poses.iter().map(|sample| sample.pose).filter(finite);
    let mut start = finite.next()?;
    for pose in finite {
        let (x, y) = (pose.x - start.x, pose.y - start.y);
        if x.hypot(y) < steps {
            continue;
        }
        let path = y.atan2(x);
        paths.add(path);
        for (unit, sums) in [(1.0, &mut radians), (TAU / 360.0, &mut degrees)] {
            let turn = trackdyn_core::pose::wrap_angle(unit * (pose.yaw - start.yaw));
            if turn.abs() < 0.5 {
                let heading = unit * start.yaw + 0.5 * turn;
                sums[0].add(path - heading);
                sums[1].add(path + heading);
            }
        }
        start = pose;
    }
    let is_large = poses.iter().any(|sample| sample.pose.yaw.abs() > TAU);
    // A straight path follows a heading that hardly changes, whatever its unit.
    let is_curved = paths.agreement() < 0.8;
    let follows = |of: &Directions| is_curved && of.count >= MIN_STRETCHES && of.agreement() > 0.9;
    let [by_radians, by_degrees] = [&radians[0], &degrees[0]];
    let is_compass = |of: &Directions, other: &Directions| {
        follows(of) && of.is_across() && other.agreement() < 0.6
    };
    let is_no_radian =
        is_large && (by_radians.count < degrees[0].count / 4 || by_radians.agreement() < 0.6);
    if is_compass(&radians[1], by_radians) {
        return Some(Doubt::YawOfCompass);
    }
    // On ice the path says nothing of the heading, but yaw does not outrun the tracks.
    if !is_no_radian || turned_per_difference(rows) <= MIN_DEGREES_PER_METRE {
        return None;
    }
    if is_compass(&degrees[1], by_degrees) {
        return Some(Doubt::YawOfCompass);
    }
    follows(by_degrees).then_some(Doubt::YawInDegrees)
}

/// Sum of directions, of which forward and backward are one.
#[derive(Clone, Copy, Default)]
struct Directions {
    cos: f64,
    sin: f64,
    count: usize,
}

impl Directions {
    fn add(&mut self, angle: f64) {
        let (sin, cos) = (2.0 * angle).sin_cos();
        *self = Self { cos: self.cos + cos, sin: self.sin + sin, count: self.count + 1 };
    }

    /// R = |Σ exp(2i φ)| / n: 1 where all are one.
    fn agreement(&self) -> f64 {
        self.cos.hypot(self.sin) / real(self.count.max(1))
    }

    /// Whether their mean is nearly a right angle: path and heading add up to it where the heading
    /// is clockwise from the y axis.
    fn is_across(&self) -> bool {
        self.sin.atan2(-self.cos).abs() < MAX_COMPASS_DEVIATION
    }
}

/// Unit of yaw per way that one track runs more than the other, 1/m: less than the inverse of the
/// distance of the ICRs where yaw is in radians.
fn turned_per_difference(run: &UncheckedRun) -> f64 {
    let finite = |value: &f64| value.is_finite();
    let turns =
        run.poses.samples.windows(2).map(|pair| (pair[1].pose.yaw - pair[0].pose.yaw).abs());
    let turned: f64 = turns.filter(finite).sum();
    let differences = run.tracks.samples.windows(2);
    let differences = differences
        .map(|pair| (pair[0].v_right - pair[0].v_left).abs() * (pair[1].t - pair[0].t).max(0.0));
    turned / differences.filter(finite).sum::<f64>()
}

/// What contradicts what in cleaned runs, the gravest first.
pub(super) fn of_runs(runs: &[Run]) -> Vec<Doubt> {
    let late =
        |tau: f64| -> Vec<Stretch> { runs.iter().flat_map(|run| stretches(run, tau)).collect() };
    let stretches = late(0.0);
    let explained = Senses::of(&stretches).explained();
    let stuck = stuck::stuck_poses(runs, explained);
    let orientation = if stuck.is_none() { orientation(runs) } else { None };
    let mut doubts: Vec<Doubt> = runs.iter().find_map(of_times).into_iter().collect();
    let by_delay = ByDelay::new(runs);
    doubts.extend(counted::of(runs, &by_delay));
    doubts.extend(jumps::of(runs));
    doubts.extend(stuck.or(orientation));
    if !runs.iter().any(Run::has_positions)
        && let Some(following) = Following::of(runs, &|_, _, _| false)
    {
        doubts.extend(turn_in_degrees(&following));
        doubts.extend(saturated_gyro::of(runs, &following));
    }
    doubts.extend(idle::dead_encoder(runs, &late));
    doubts.extend(travel(runs, &stretches));
    doubts.extend(unsigned::of(runs, &by_delay));
    doubts.extend(of_columns(runs));
    doubts.extend(signs(&stretches, &late));
    doubts
}

/// Columns of which one alone moves the robot and the other alone turns it.
fn of_columns(runs: &[Run]) -> Option<Doubt> {
    if !runs.iter().all(Run::has_positions) {
        return None;
    }
    let linear = Linear::of(runs, linear::MIN_PIECE, &|_, _, _| false)?;
    // Whether one number is small beside another one, surely.
    let is_small = |[small, error]: [f64; 2], [large, _]: [f64; 2]| {
        small.abs() + MIN_ERRORS * error < MAX_PART * large.abs()
    };
    let turn = |column: usize| linear.number(|[turn, _]| turn[column]);
    let way = |column: usize| linear.number(|[_, forward]| forward[column]);
    [[0, 1], [1, 0]].into_iter().find_map(|[moving, turning]| {
        let is_apart = is_small(turn(moving), turn(turning)) && is_small(way(turning), way(moving));
        let column = if moving == 0 { Side::Left } else { Side::Right };
        let [per_unit, _] = turn(turning);
        is_apart.then_some(Doubt::NotSides { moving: column, per_unit })
    })
}

/// Yaw in degrees, where it is all that is known and follows the tracks.
fn turn_in_degrees(following: &Following) -> Option<Doubt> {
    let per_metre = following.turn;
    (per_metre > MIN_DEGREES_PER_METRE).then_some(Doubt::TurnInDegrees { per_metre })
}

/// Sides that count backwards or are swapped.
fn signs(stretches: &[Stretch], late: &dyn Fn(f64) -> Vec<Stretch>) -> Option<Doubt> {
    // A clock that is off must not look like a sign: the delay that explains most decides.
    let senses = Senses::of(stretches);
    let doubt = senses.doubt()?;
    let lags = LAGS.into_iter().flat_map(|tau| [tau, -tau]);
    let others = lags.map(|tau| Senses::of(&late(tau)));
    let best = others.max_by(|a, b| a.explained().total_cmp(&b.explained()));
    match best.filter(|best| best.explained() > senses.explained() + MIN_LAG_GAIN) {
        Some(best) => best.doubt(),
        None => Some(doubt),
    }
}

/// Fractions of a second in which stamps are written.
const FRACTIONS: [(f64, &str); 3] =
    [(1e3, "milliseconds"), (1e6, "microseconds"), (1e9, "nanoseconds")];

/// Tables of different units of time.
fn of_times(run: &Run) -> Option<Doubt> {
    let (poses, tracks) = (run.poses(), run.tracks());
    let [.., last] = poses else { return None };
    let covered = [last.t - poses[0].t, run.duration()];
    let overlap = last.t.min(tracks[tracks.len() - 1].t) - poses[0].t.max(tracks[0].t);
    let ratio = (covered[0] / covered[1]).max(covered[1] / covered[0]);
    let fraction = FRACTIONS.iter().find(|(unit, _)| (0.9..1.1).contains(&(ratio / unit)));
    let unit = fraction.filter(|_| overlap < 0.1 * covered[0].max(covered[1]))?.1;
    let interval = pose_interval(run);
    Some(Doubt::Stamps { interval, unit: Some(unit) })
}

fn pose_interval(run: &Run) -> f64 {
    usual_interval(run.poses().iter().map(|sample| sample.t))
}

/// Yaw that stays the same to the last digits while one track runs more than the other.
fn orientation(runs: &[Run]) -> Option<Doubt> {
    let is_constant = |run: &Run| {
        let first = run.poses()[0].pose.yaw;
        run.poses().iter().all(|sample| (sample.pose.yaw - first).abs() <= 1e-9)
    };
    let turning = |run: &Run| -> f64 {
        let steps = run.tracks().windows(2);
        steps.map(|pair| (pair[0].v_right - pair[0].v_left).abs() * (pair[1].t - pair[0].t)).sum()
    };
    let turning: f64 = runs.iter().map(turning).sum();
    (turning >= MIN_WAY_DIFFERENCE && runs.iter().all(is_constant))
        .then_some(Doubt::ConstantOrientation { turning })
}

/// A ratio of the ways of tracks and poses that no slip explains.
fn travel(runs: &[Run], stretches: &[Stretch]) -> Option<Doubt> {
    let straight = stretches.iter().filter(|stretch| stretch.is_straight);
    let mut ratios: Vec<f64> =
        straight.map(|stretch| stretch.forward_of_tracks().abs() / stretch.distance).collect();
    ratios.sort_by(f64::total_cmp);
    let count = ratios.len();
    if count < MIN_STRETCHES {
        return None;
    }
    let [lower, ratio, upper] = [count / 4, count / 2, count * 3 / 4].map(|at| ratios[at]);
    let size = ratio.max(1.0 / ratio);
    let spread = if lower > 0.0 { upper / lower } else { f64::INFINITY };
    let is_of_units = size >= MIN_UNIT_RATIO
        && spread <= MAX_UNIT_QUARTILE_RATIO
        && unit::error(ratio).is_some_and(|error| error <= MAX_UNIT_ERROR);
    let is_off = spread <= MAX_QUARTILE_RATIO && size >= MIN_CONTRADICTION;
    if !(is_of_units || is_off) {
        return None;
    }
    let interval = runs.first().map_or(0.0, pose_interval);
    if ratio > 1.0 && interval >= MAX_INTERVAL {
        let is_near = |unit: f64| (size / unit).max(unit / size) <= MAX_QUARTILE_RATIO;
        let unit = FRACTIONS.iter().find(|(unit, _)| is_near(*unit)).map(|(_, name)| *name);
        return Some(Doubt::Stamps { interval, unit });
    }
    Some(Doubt::Travel { ratio, units: unit::mixed_up(ratio) })
}

/// Delays of the poses that are tried before a sign is doubted, s.
const LAGS: [f64; 8] = [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0];

/// Least gain of the sum of two squared correlations by a delay.
const MIN_LAG_GAIN: f64 = 0.1;

/// How tracks and poses go together: correlations over the stretches.
///
/// With F = (V_l + V_r)/2 and D = V_r − V_l, F goes with the way forward and D with the turn. Where
/// a side counts backwards, F goes with the turn and D with the way.
#[derive(Clone, Copy, Debug, Default)]
struct Senses {
    /// Of F with the way, and of D with the turn.
    right: [f64; 2],
    /// Of D with the way, and of F with the turn.
    crossed: [f64; 2],
}

impl Senses {
    fn of(stretches: &[Stretch]) -> Self {
        if stretches.len() < MIN_STRETCHES {
            return Self::default();
        }
        let series = |of: &dyn Fn(&Stretch) -> f64| limited(stretches.iter().map(of).collect());
        let mean = series(&Stretch::forward_of_tracks);
        let difference = series(&|stretch| stretch.tracks.right - stretch.tracks.left);
        let forward = series(&|stretch| stretch.forward);
        let turn = series(&|stretch| stretch.turn);
        Self {
            right: [correlation(&mean, &forward), correlation(&difference, &turn)],
            crossed: [correlation(&difference, &forward), correlation(&mean, &turn)],
        }
    }

    /// Sum of the squared correlations of the better explanation.
    fn explained(&self) -> f64 {
        let sum = |[a, b]: [f64; 2]| a * a + b * b;
        sum(self.right).max(sum(self.crossed))
    }

    /// Sides that count backwards or are swapped.
    fn doubt(&self) -> Option<Doubt> {
        let Self { right, crossed } = *self;
        let is_strong = |correlation: f64| correlation.abs() >= MIN_CORRELATION;
        let is_crossed = (0..2).any(|at| {
            is_strong(crossed[at]) && right[at].abs() <= crossed[at].abs() - MIN_CONTRAST
        });
        if is_crossed && !right.into_iter().any(is_strong) {
            // Right reversed: D = −2 F of the robot. Left reversed: D = +2 F.
            let side = if crossed[0] + crossed[1] < 0.0 { Side::Right } else { Side::Left };
            return Some(Doubt::Reversed(side));
        }
        let is_against = right.map(|correlation| correlation <= -MIN_CORRELATION);
        match is_against {
            [true, true] => Some(Doubt::BothReversed),
            [false, true] => Some(Doubt::Swapped),
            [true, false] => (right[1] >= MIN_CORRELATION).then_some(Doubt::Backwards),
            [false, false] => None,
        }
    }
}

/// Values limited to three medians of the sizes of those that are not zero.
fn limited(mut values: Vec<f64>) -> Vec<f64> {
    let mut sizes: Vec<f64> = values.iter().map(|v| v.abs()).filter(|size| *size > 0.0).collect();
    let limit = 3.0 * median(&mut sizes).unwrap_or_default();
    for value in &mut values {
        *value = value.clamp(-limit, limit);
    }
    values
}

/// Correlation about zero; 0 where one of them is zero.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scale = (sum(a, a) * sum(b, b)).sqrt();
    if scale > 0.0 { sum(a, b) / scale } else { 0.0 }
}
