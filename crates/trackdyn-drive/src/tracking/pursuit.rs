//! The tracker at work: which leg, how far on it, and what comes next.

use super::Tracker;
use crate::path::Path;
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;

/// Smallest share of the look-ahead: it shrinks towards the end of a leg.
const MIN_LOOK_AHEAD_SHARE: f64 = 0.2;

/// Smallest ratio of the look-ahead to the distance by which the tracked point lies behind the
/// pivot: 2 is the limit of stability.
const MIN_LOOK_AHEAD_RATIO: f64 = 3.0;

/// Largest tan θ/2 of a corner that is taken into account (θ = 127°): sharper lines meet far away.
const MAX_CORNER_TANGENT: f64 = 2.0;

/// Number of commands in which the remaining distance or turn would be covered: each command at the
/// end takes one part in this many.
const APPROACH_COMMANDS: f64 = 5.0;

/// Forward speed and yaw rate that are asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SetPoint {
    /// m/s.
    pub(super) forward: f64,
    /// rad/s.
    pub(super) yaw_rate: f64,
}

/// A path that is being followed.
pub(super) struct Pursuit<'a> {
    tracker: &'a Tracker,
    path: &'a Path,
    /// Start and end of each leg between corners, lengths along the path.
    legs: Vec<[f64; 2]>,
    leg: usize,
    turning: bool,
    /// Length along the path that has been reached.
    along: f64,
    last: SetPoint,
}

impl<'a> Pursuit<'a> {
    pub(super) fn new(tracker: &'a Tracker, path: &'a Path) -> Self {
        let mut ends = vec![0.0];
        ends.extend(path.corners(tracker.corner));
        ends.push(path.length());
        let legs = ends.windows(2).map(|ends| [ends[0], ends[1]]).collect();
        Self { tracker, path, legs, leg: 0, turning: true, along: 0.0, last: SetPoint::default() }
    }

    /// Number of legs.
    pub(super) fn legs(&self) -> usize {
        self.legs.len()
    }

    /// Length along the path that has been reached, m.
    pub(super) fn along(&self) -> f64 {
        self.along
    }

    /// The set-points that go with the last command.
    pub(super) fn last(&self) -> SetPoint {
        self.last
    }

    /// The next set-points of a robot that takes itself to be at a pose and turns about points at
    /// `pivot` before its origin (m); none at the end of the path.
    pub(super) fn next(&mut self, pose: &Pose, pivot: f64) -> Option<SetPoint> {
        self.last = self.follow(pose, pivot)?;
        Some(self.last)
    }

    fn follow(&mut self, pose: &Pose, pivot: f64) -> Option<SetPoint> {
        let point = position(pose, self.tracker.point);
        while let Some(&[start, end]) = self.legs.get(self.leg) {
            let error = wrap_angle(self.path.direction_at(start) - pose.yaw);
            if self.turning && error.abs() > self.largest_error() {
                return Some(self.turn(error));
            }
            if self.turning {
                self.turning = false;
                self.last = SetPoint::default();
            }
            let reach = [self.along, (self.along + self.tracker.look_ahead).min(end)];
            self.along = self.path.nearest(point, reach).along;
            let passed = if self.along < end { 0.0 } else { self.passed(point, end) };
            let remaining = end - self.stop_before(end, pivot) - self.along - passed;
            if remaining > self.tracker.close {
                let goal = self.goal(point, end, passed, pivot - self.tracker.point[0]);
                return Some(self.pursue(pose, point, goal, remaining, pivot));
            }
            self.along = end;
            self.leg += 1;
            self.turning = true;
            self.last = SetPoint::default();
        }
        None
    }

    /// Error of the heading with which a leg is begun, rad: a turn once begun goes all the way, but
    /// what would not be a corner is driven round.
    fn largest_error(&self) -> f64 {
        let begins = self.leg == 0 && self.last == SetPoint::default();
        if begins { self.tracker.corner } else { self.tracker.aligned }
    }

    /// Length by which the point is beyond the end of a leg, on its straight continuation.
    fn passed(&self, point: [f64; 2], end: f64) -> f64 {
        let last = self.path.point_at(end);
        let (sin, cos) = self.path.direction_at(end.next_down()).sin_cos();
        cos * (point[0] - last[0]) + sin * (point[1] - last[1])
    }

    /// How far before the end of a leg the tracked point has to stop, so that a turn on the spot by
    /// θ brings it onto the next leg: the pivot runs beside the path by −p_y and turns where both
    /// its lines meet, y − p_x − p_y tan θ/2 later than the point. At the end of the path nothing
    /// turns.
    fn stop_before(&self, end: f64, pivot: f64) -> f64 {
        if self.leg + 1 == self.legs.len() {
            return 0.0;
        }
        let [before, after] = [end.next_down(), end].map(|along| self.path.direction_at(along));
        let half = wrap_angle(after - before) / 2.0;
        let [p_x, p_y] = self.tracker.point;
        pivot - p_x - p_y * half.tan().clamp(-MAX_CORNER_TANGENT, MAX_CORNER_TANGENT)
    }

    /// Towards a goal, with a length remaining to the next stop.
    fn pursue(
        &self,
        pose: &Pose,
        point: [f64; 2],
        goal: [f64; 2],
        remaining: f64,
        pivot: f64,
    ) -> SetPoint {
        let tracker = self.tracker;
        let (sin, cos) = pose.yaw.sin_cos();
        let [east, north] = [goal[0] - point[0], goal[1] - point[1]];
        // Δ in the axes of the body
        let [ahead, left] = [cos * east + sin * north, cos * north - sin * east];
        if ahead <= 0.0 {
            return self.turn(left.atan2(ahead));
        }
        let forward = (self.last.forward + tracker.acceleration * tracker.interval)
            .min(tracker.speed)
            .min(approach(remaining, tracker.acceleration, tracker.interval));
        // ω/v = Δ_y/(p_y Δ_y + L²/2 − (y − p_x) Δ_x)
        let [p_x, p_y] = tracker.point;
        let half = f64::midpoint(ahead * ahead, left * left);
        let below = p_y * left + half - (pivot - p_x) * ahead;
        if below * tracker.yaw_rate <= left.abs() * forward {
            // A sharper turn than the yaw rate allows: less speed, not less curvature
            let yaw_rate = tracker.yaw_rate.copysign(left);
            let forward = (yaw_rate * below / left).max(0.0);
            return SetPoint { forward, yaw_rate };
        }
        SetPoint { forward, yaw_rate: forward * left / below }
    }

    /// Where the leg leaves the circle of the look-ahead; near its end a smaller one, and at last a
    /// point on its straight continuation. `lag` is the distance of the point behind the pivot, m.
    fn goal(&self, point: [f64; 2], end: f64, passed: f64, lag: f64) -> [f64; 2] {
        let look_ahead = self.tracker.look_ahead;
        let goal = self.path.leaves_circle(point, look_ahead, [self.along, end]);
        goal.unwrap_or_else(|| {
            let last = self.path.point_at(end);
            let shortest =
                (MIN_LOOK_AHEAD_SHARE * look_ahead).max(MIN_LOOK_AHEAD_RATIO * lag).min(look_ahead);
            let distance = crate::path::distance(point, last);
            let away = if passed > 0.0 { -distance } else { distance };
            let beyond = (shortest - away).max(0.0);
            // of the piece before the corner
            let (sin, cos) = self.path.direction_at(end.next_down()).sin_cos();
            [last[0] + beyond * cos, last[1] + beyond * sin]
        })
    }

    /// A turn on the spot by an angle, rad.
    fn turn(&self, angle: f64) -> SetPoint {
        let Tracker { interval, yaw_rate, yaw_acceleration, .. } = *self.tracker;
        let rate = (self.last.yaw_rate.abs() + yaw_acceleration * interval)
            .min(yaw_rate)
            .min(approach(angle.abs(), yaw_acceleration, interval));
        SetPoint { forward: 0.0, yaw_rate: rate.copysign(angle) }
    }
}

/// The rate at which something that is left can still be brought to a stop: √(2 a d), and for the
/// last bit a fixed part of it per command.
fn approach(left: f64, acceleration: f64, interval: f64) -> f64 {
    (2.0 * acceleration * left).sqrt().min(left / (APPROACH_COMMANDS * interval))
}

/// Where a body point is.
pub(super) fn position(pose: &Pose, [x, y]: [f64; 2]) -> [f64; 2] {
    let there = pose.compose(&Pose::new(x, y, 0.0));
    [there.x, there.y]
}
