//! Tanh-sinh quadrature over rectangles: an integration that shares nothing with the closed form.

use std::f64::consts::FRAC_PI_2;

/// Nodes and weights on (−1, 1) for step h: x = tanh(π/2 sinh t). Returns 1 − |x| as well, which keeps
/// its digits near the ends.
fn nodes(step: f64) -> Vec<(f64, f64, f64)> {
    let count = (3.4 / step) as i32;
    (-count..=count)
        .map(|k| {
            let t = f64::from(k) * step;
            let (sinh, cosh) = (t.sinh(), t.cosh());
            let weight = step * FRAC_PI_2 * cosh / (FRAC_PI_2 * sinh).cosh().powi(2);
            let from_end = 2.0 / (1.0 + (std::f64::consts::PI * sinh.abs()).exp());
            (sinh.signum(), from_end, weight)
        })
        .collect()
}

/// The points and weights of an interval, accurate relative to both ends.
fn points([low, high]: [f64; 2], step: f64) -> Vec<(f64, f64)> {
    let half = (high - low) / 2.0;
    nodes(step)
        .into_iter()
        .map(|(sign, from_end, weight)| {
            let point = if sign < 0.0 { low + half * from_end } else { high - half * from_end };
            (point, weight * half)
        })
        .collect()
}

/// ∬ f over `u` × `v`, cut at u = 0 and v = 0 where these lie inside, with the step halved until the
/// integral settles.
pub fn integrate<const K: usize>(
    u: [f64; 2],
    v: [f64; 2],
    f: impl Fn(f64, f64) -> [f64; K],
) -> [f64; K] {
    let cut = |[low, high]: [f64; 2]| {
        if low < 0.0 && high > 0.0 { vec![[low, 0.0], [0.0, high]] } else { vec![[low, high]] }
    };
    let at_step = |step: f64| {
        let mut sum = [0.0; K];
        for columns in cut(u) {
            let across = points(columns, step);
            for rows in cut(v) {
                for &(y, weight_y) in &points(rows, step) {
                    for &(x, weight_x) in &across {
                        for (sum, value) in sum.iter_mut().zip(f(x, y)) {
                            *sum += value * weight_x * weight_y;
                        }
                    }
                }
            }
        }
        sum
    };
    let mut coarse = at_step(0.2);
    for step in [0.1, 0.05, 0.025, 0.0125] {
        let fine = at_step(step);
        let change = fine.iter().zip(&coarse).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let size = fine.iter().map(|a| a.abs()).fold(0.0, f64::max);
        coarse = fine;
        if change < 1e-13 * size {
            break;
        }
    }
    coarse
}
