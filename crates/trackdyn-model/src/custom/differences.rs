//! Results of a law with derivatives by differences.

use super::together::ask;
use super::{Batch, CustomLaw};
use trackdyn_core::Scalar;

/// Step of a difference in sizes of the argument: the cube root of the rounding, where errors of
/// rounding and of the third derivative are alike.
const STEP: f64 = 6e-6;

/// Largest argument of any unit at which a law is asked. A solver that goes astray may come to
/// motions that no robot has; what lies beyond counts as no motion.
const MAX_ARGUMENT: f64 = 1e12;

/// Results of a law at states of A arguments each. A state that no robot has makes all results NaN.
///
/// A law that tells what its function reads is differentiated by that alone, and once more where it
/// turns out to have read something else: at other states, it may go other ways.
pub fn results<S: Scalar, const A: usize, const R: usize>(
    law: &'static CustomLaw,
    values: &[f64],
    states: &[[S; A]],
) -> Vec<[S; R]> {
    let is_sane = |state: &[S; A]| state.iter().all(|one| one.value().abs() < MAX_ARGUMENT);
    if !states.iter().all(is_sane) {
        return vec![[S::from(f64::NAN); R]; states.len()];
    }
    loop {
        let sought = if S::HAS_DERIVATIVES { law.sought() } else { Vec::new() };
        let found = results_by(law, values, states, &sought);
        if !S::HAS_DERIVATIVES || !law.is_read_beyond(&sought) {
            return found;
        }
    }
}

/// Results with derivatives by the arguments at these places.
fn results_by<S: Scalar, const A: usize, const R: usize>(
    law: &'static CustomLaw,
    values: &[f64],
    states: &[[S; A]],
    sought: &[usize],
) -> Vec<[S; R]> {
    let count = states.len();
    let rows = count * (1 + 2 * sought.len());
    let arguments = law.kind().arguments();
    let step = |place: usize, value: f64| STEP * value.abs().max(arguments[place].scale());
    // Columns of the states, of those a step ahead and a step behind in the first argument, …
    let mut columns = vec![0.0; A * rows];
    for (place, column) in columns.chunks_exact_mut(rows).enumerate() {
        for block in column.chunks_exact_mut(count) {
            for (value, state) in block.iter_mut().zip(states) {
                *value = state[place].value();
            }
        }
        if let Some(order) = sought.iter().position(|one| *one == place) {
            let (ahead, behind) =
                column[(1 + 2 * order) * count..(3 + 2 * order) * count].split_at_mut(count);
            for (ahead, behind) in ahead.iter_mut().zip(behind) {
                let step = step(place, *ahead);
                *ahead += step;
                *behind -= step;
            }
        }
    }
    let at = Batch::new(law.kind(), rows, &columns);
    let found = ask(law, &at, values).unwrap_or_else(|failure| failure.unwind());
    if let Some(failure) = law.not_finite(&at, values, &found, count) {
        failure.unwind();
    }
    let of_state = |(row, state): (usize, &[S; A])| {
        std::array::from_fn(|result| {
            let column = &found[result * rows..][..rows];
            let here = column[row];
            let mut partials = [0.0; A];
            for (order, &place) in sought.iter().enumerate() {
                let [ahead, behind] = [1, 2].map(|k| column[(k + 2 * order) * count + row]);
                partials[place] = slope(here, ahead, behind, step(place, state[place].value()));
            }
            S::chain(here, partials, *state)
        })
    };
    states.iter().enumerate().map(of_state).collect()
}

/// Slope of three values a step apart. At the end of the domain of a law it is that of one side.
fn slope(here: f64, ahead: f64, behind: f64, step: f64) -> f64 {
    match (ahead.is_finite(), behind.is_finite()) {
        (true, true) => (ahead - behind) / (2.0 * step),
        (true, false) => (ahead - here) / step,
        (false, true) => (here - behind) / step,
        (false, false) => 0.0,
    }
}
