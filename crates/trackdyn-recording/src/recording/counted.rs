//! Numbers that are read as speeds and are positions: ticks of encoders, angles, ways.
//!
//! # Law
//! A number is the way of a track so far, and not its speed, on two conditions: its change in a
//! piece is p s + q φ of the poses at some delay, and its integral is so at none. Wraps of a
//! counter are changes that are far larger than nearly all others, and are left out.

use super::Run;
use super::by_poses::{ByDelay, Row, larger, unexplained};
use crate::doubt::Doubt;
use trackdyn_core::robust::quantile;
use trackdyn_core::{PerSide, Side};

/// Least part of the squares that the poses leave of speeds that are none.
const MIN_SPEED_RESIDUAL: f64 = 0.4;

/// Largest part that they leave of the changes of positions.
const MAX_CHANGE_RESIDUAL: f64 = 0.15;

/// Share of the changes that are nearly all, and by how much a wrap is larger.
const MAIN_SHARE: f64 = 0.9;
const MIN_WRAP_RATIO: f64 = 5.0;

/// Sides of which positions were taken for speeds.
pub(super) fn of(runs: &[Run], by_delay: &ByDelay) -> Option<Doubt> {
    if !runs.iter().all(Run::has_positions) {
        return None;
    }
    let found = PerSide::from_fn(|side: Side| is_counted(by_delay, side));
    let (side, unexplained) = found.either(larger)?;
    Some(Doubt::Positions { side, unexplained })
}

/// What the poses leave of a number and of its changes; none where it is no position.
fn is_counted(by_delay: &ByDelay, side: Side) -> Option<[f64; 2]> {
    let of_speed = |rows: &[Row]| unexplained(rows, |row| row.ways[side]);
    // Of most logs the first delay says so.
    if by_delay.rows().any(|rows| of_speed(rows) < MIN_SPEED_RESIDUAL) {
        return None;
    }
    let least = |of: &dyn Fn(&[Row]) -> f64| by_delay.rows().map(of).min_by(f64::total_cmp);
    let as_speed = least(&of_speed)?;
    let as_position = least(&|rows| {
        let mut sizes: Vec<f64> = rows.iter().map(|row| row.changes[side].abs()).collect();
        let limit = MIN_WRAP_RATIO * quantile(&mut sizes, MAIN_SHARE).unwrap_or_default();
        let is_change = |row: &&Row| row.changes[side].abs() <= limit;
        let rows: Vec<Row> = rows.iter().filter(is_change).copied().collect();
        let moves = rows.iter().any(|row| row.changes[side] != 0.0);
        if moves { unexplained(&rows, |row| row.changes[side]) } else { 1.0 }
    })?;
    (as_position <= MAX_CHANGE_RESIDUAL).then_some([as_speed, as_position])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::UncheckedRun;
    use crate::sample::{PoseSample, TrackSample};
    use trackdyn_core::Pose;

    /// Speeds of both sides, m/s; they do not repeat: the integral of a sine is a late sine.
    fn speeds(t: f64) -> [f64; 2] {
        let [left, right] = [0.31 * t + 0.004 * t * t, 0.23 * t + 0.003 * t * t + 1.0];
        [0.4 * left.sin() + 0.2, 0.5 * right.sin() + 0.1]
    }

    /// A drive with the numbers that `read` makes of the speeds and of the ways so far.
    fn drive(late: f64, read: impl Fn([f64; 2], [f64; 2]) -> [f64; 2]) -> Vec<Run> {
        let (step, mut at, mut ways) = (0.02, Pose::default(), [0.0_f64; 2]);
        let mut rows = UncheckedRun::default();
        for k in 0..6000_u32 {
            let t = step * f64::from(k);
            let [left, right] = speeds(t);
            let [v_left, v_right] = read([left, right], ways);
            rows.tracks.samples.push(TrackSample { t, v_left, v_right });
            if k % 5 == 0 {
                rows.poses.samples.push(PoseSample { t: t + late, pose: at });
            }
            let (turn, way) = (step * (right - left), 0.5 * step * (left + right));
            let (sin, cos) = (at.yaw + 0.5 * turn).sin_cos();
            at = Pose::new(at.x + way * cos, at.y + way * sin, at.yaw + turn);
            ways = [ways[0] + step * left, ways[1] + step * right];
        }
        vec![Run::new(rows, &mut Vec::new())]
    }

    /// The sides that are said to be positions.
    fn found(runs: &[Run]) -> Vec<Side> {
        match of(runs, &ByDelay::new(runs)) {
            Some(Doubt::Positions { side: Some(side), .. }) => vec![side],
            Some(Doubt::Positions { side: None, .. }) => Side::BOTH.to_vec(),
            _ => Vec::new(),
        }
    }

    #[test]
    fn ticks_are_no_speeds() {
        let ticks = |way: f64| (4000.0 * way).round();
        let of_16_bits = |way: f64| (ticks(way) + 32_768.0).rem_euclid(65_536.0) - 32_768.0;
        for late in [0.0, 0.4, 2.0] {
            assert_eq!(found(&drive(late, |_, ways| ways.map(ticks))), Side::BOTH, "{late}");
            assert_eq!(found(&drive(late, |_, ways| ways.map(of_16_bits))), Side::BOTH, "{late}");
            let left = drive(late, |[_, right], [way, _]| [way, right]);
            assert_eq!(found(&left), [Side::Left], "{late}");
        }
    }

    #[test]
    fn speeds_are_fine_however_late() {
        for late in [0.0, 0.4, 2.0, 7.3, 20.0] {
            assert_eq!(found(&drive(late, |speeds, _| speeds)), [], "{late}");
            let coarse = |v: f64| (5.0 * v).round() / 5.0;
            assert_eq!(found(&drive(late, |speeds, _| speeds.map(coarse))), [], "{late}");
            assert_eq!(found(&drive(late, |speeds, _| speeds.map(f64::abs))), [], "{late}");
        }
    }
}
