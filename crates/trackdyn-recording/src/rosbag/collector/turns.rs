//! Positions of joints that wrap.
//!
//! # Law
//! Where the jumps of a joint determine its [modulus], a jump is a wrap if its shortest way
//! continues the step before or after it, to a quarter of the modulus. Where there are too few
//! jumps for that, a joint whose positions all lie within one turn wraps after a whole turn if the
//! steps beside a jump agree. The missing turns are added from there on.
//!
//! # Assumes
//! A joint turns by less than half of the modulus between two readings. Any other jump, such as
//! that of an encoder that starts anew, is left as it is and told: what happened is not known.

use crate::recording::Warning;
use crate::rosbag::date::Stamped;
use modulus::Modulus;
use std::f64::consts::TAU;

mod modulus;

/// Largest span beyond a turn of positions that are modulo a turn, rad: single precision and coarse
/// encoders round them.
const POSITION_ROUNDING: f64 = 1e-3;

/// Adds what is lacking to the positions of a joint that wraps, in the order of time. `seconds` is
/// the time of a stamp.
///
/// # Errors
/// Why the positions cannot be used, where the joint turns too far between two readings.
pub(super) fn unwrap(
    joint: &str,
    angles: &mut [Stamped<f64>],
    seconds: impl Fn(i64) -> f64,
) -> Result<Vec<Warning>, String> {
    let values: Vec<f64> = angles.iter().map(|(_, angle)| *angle).collect();
    let modulus = match Modulus::of(&values) {
        Modulus::Of(modulus) => Some(modulus),
        Modulus::Unknown => None,
        Modulus::Unclear(range) => {
            return Err(format!(
                "{joint}: its position wraps within a range of {range:.4} rad, and steps by about \
                 half of it or more between two readings: which way it turned is not known; \
                 expected more readings a second, or velocities (--joint-signal velocity)"
            ));
        }
    };
    let steps = Steps::of(&values, modulus);
    let mut warnings = Vec::new();
    if steps.wraps > 0 {
        let modulus = modulus.unwrap_or(TAU);
        for ((_, angle), turns) in angles.iter_mut().zip(&steps.turns) {
            *angle += modulus * turns;
        }
        let (joint, count) = (joint.to_owned(), steps.wraps);
        warnings.push(Warning::TurnsAdded { joint, count, modulus });
    }
    if let Some(&first) = steps.jumps.first() {
        let (t, count) = (seconds(angles[first].0), steps.jumps.len());
        warnings.push(Warning::JointJumps { joint: joint.to_owned(), count, t });
    }
    Ok(warnings)
}

/// The steps of one joint.
struct Steps {
    /// How many moduli each position lacks.
    turns: Vec<f64>,
    wraps: usize,
    /// Places after jumps that are no wraps.
    jumps: Vec<usize>,
}

impl Steps {
    fn of(positions: &[f64], known: Option<f64>) -> Self {
        let values = || positions.iter().copied();
        let span =
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
        let modulus = known.unwrap_or(TAU);
        let within_a_turn = span <= TAU + POSITION_ROUNDING;
        let step_after = |place: usize| match positions.get(place + 1..place + 3) {
            Some([first, second]) => Some(second - first),
            _ => None,
        };
        let mut steps = Self { turns: Vec::new(), wraps: 0, jumps: Vec::new() };
        let (mut turns, mut before) = (0.0, None);
        steps.turns.extend(values().take(1).map(|_| 0.0));
        for (place, pair) in positions.windows(2).enumerate() {
            let mut step = pair[1] - pair[0];
            if step.abs() > 0.5 * modulus {
                let shortest = step - modulus * step.signum();
                let last = before.unwrap_or(0.0);
                let goes_on = |other: f64| (shortest - other).abs() <= 0.25 * modulus;
                let after = step_after(place);
                let is_wrap = if known.is_some() {
                    goes_on(last) || after.is_some_and(goes_on)
                } else {
                    let first = before.or(after).unwrap_or(shortest);
                    let is_turn = modulus::is_of_a_turn(step, first, after.unwrap_or(first));
                    within_a_turn && goes_on(last) && is_turn
                };
                if is_wrap {
                    turns -= step.signum();
                    step = shortest;
                    steps.wraps += 1;
                } else if (step - last).abs() > 0.5 * modulus {
                    steps.jumps.push(place + 1);
                }
            }
            steps.turns.push(turns);
            before = Some(step);
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn steps(angles: &[f64]) -> Steps {
        let Modulus::Unclear(range) = Modulus::of(angles) else {
            let modulus = match Modulus::of(angles) {
                Modulus::Of(modulus) => Some(modulus),
                _ => None,
            };
            return Steps::of(angles, modulus);
        };
        panic!("unclear within {range}")
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
