//! Positions of joints that are reported modulo a turn.
//!
//! # Law
//! A joint whose positions all lie within one turn and that steps by more than half a turn has
//! wrapped where the shortest way goes on as the step before did, to a quarter turn. Whole turns
//! are added from there on.
//!
//! # Assumes
//! A wheel turns by less than half a turn between two readings. Any other step by more than half a
//! turn, such as that of an encoder that starts anew, is left as it is and told: what happened is
//! not known.

use crate::recording::Warning;
use crate::rosbag::date::Stamped;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Largest span beyond a turn of positions that are modulo a turn, rad: single precision and coarse
/// encoders round them.
const POSITION_ROUNDING: f64 = 1e-3;

/// Adds whole turns to the positions of a joint that wraps, in the order of time. `seconds` is the
/// time of a stamp.
pub(super) fn unwrap(
    joint: &str,
    angles: &mut [Stamped<f64>],
    seconds: impl Fn(i64) -> f64,
) -> Vec<Warning> {
    let values: Vec<(usize, f64)> = angles.iter().map(|(_, angle)| *angle).enumerate().collect();
    let steps = Steps::of(&values);
    let mut warnings = Vec::new();
    if steps.wraps > 0 {
        for ((_, angle), turns) in angles.iter_mut().zip(&steps.turns) {
            *angle += TAU * turns;
        }
        warnings.push(Warning::TurnsAdded { joint: joint.to_owned(), count: steps.wraps });
    }
    if let Some(&first) = steps.jumps.first() {
        let (t, count) = (seconds(angles[first].0), steps.jumps.len());
        warnings.push(Warning::JointJumps { joint: joint.to_owned(), count, t });
    }
    warnings
}

/// The steps of one joint.
struct Steps {
    /// Whole turns that each position lacks.
    turns: Vec<f64>,
    wraps: usize,
    /// Places after jumps that are no wraps.
    jumps: Vec<usize>,
}

impl Steps {
    fn of(angles: &[(usize, f64)]) -> Self {
        let values = || angles.iter().map(|&(_, angle)| angle);
        let span =
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
        let within_a_turn = span <= TAU + POSITION_ROUNDING;
        let mut steps = Self { turns: Vec::new(), wraps: 0, jumps: Vec::new() };
        let (mut turns, mut before) = (0.0, 0.0);
        steps.turns.extend(values().take(1).map(|_| 0.0));
        for (place, pair) in angles.windows(2).enumerate() {
            let mut step = pair[1].1 - pair[0].1;
            if step.abs() > PI {
                let shortest = step - TAU * step.signum();
                if within_a_turn && (shortest - before).abs() <= FRAC_PI_2 {
                    turns -= step.signum();
                    step = shortest;
                    steps.wraps += 1;
                } else if (step - before).abs() > PI {
                    steps.jumps.push(place + 1);
                }
            }
            steps.turns.push(turns);
            before = step;
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(angles: &[f64]) -> Steps {
        Steps::of(&angles.iter().copied().enumerate().collect::<Vec<_>>())
    }

    #[test]
    fn both_senses_and_both_intervals_are_unwrapped() {
        for (start, step) in [(0.3, 0.9), (6.0, -1.4), (2.0, 1.2)] {
            let truth = |k: u32| start + step * f64::from(k);
            for shift in [0.0, PI] {
                let wrapped: Vec<f64> =
                    (0..40).map(|k| (truth(k) + shift).rem_euclid(TAU) - shift).collect();
                let found = steps(&wrapped);
                assert!(found.wraps >= 5 && found.jumps.is_empty());
                for (k, (angle, turns)) in wrapped.iter().zip(&found.turns).enumerate() {
                    let k = u32::try_from(k).expect("small");
                    // whole turns between the start and its wrapped value are not known
                    let offset = wrapped[0] - truth(0);
                    assert!((angle + TAU * turns - truth(k) - offset).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn fast_joints_that_go_on_over_turns_are_left_alone() {
        let fast: Vec<f64> = (0..30).map(|k| 4.0 * f64::from(k)).collect();
        let found = steps(&fast);
        assert_eq!((found.wraps, found.jumps.len()), (0, 1), "only the start looks like a jump");
    }

    #[test]
    fn an_encoder_that_starts_anew_is_a_jump() {
        let angles: Vec<f64> =
            (0..20).map(|k| 0.5 * f64::from(k) + if k < 10 { 90.0 } else { -5.0 }).collect();
        let found = steps(&angles);
        assert_eq!((found.wraps, found.jumps.as_slice()), (0, &[10][..]));
        assert!(found.turns.iter().all(|turns| *turns == 0.0));
    }

    #[test]
    fn a_jump_within_a_turn_that_breaks_the_motion_is_no_wrap() {
        // half a turn and a bit, at rest: the shortest way is almost half a turn too
        let found = steps(&[5.0, 5.0, 5.0, 1.7, 1.7]);
        assert_eq!((found.wraps, found.jumps.as_slice()), (0, &[3][..]));
        assert!(steps(&[]).turns.is_empty());
    }
}
