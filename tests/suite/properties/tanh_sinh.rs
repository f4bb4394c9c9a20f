//! Tanh-sinh quadrature over rectangles: an integration that shares nothing with the closed form.

use std::f64::consts::FRAC_PI_2;

/// Nodes and weights on (−1, 1) for the step 1/5, halved so often: x = tanh(π/2 sinh t). A node is
/// given by its sign and 1 − |x|, which keeps its digits near the ends.
fn nodes(halvings: u32) -> Vec<(f64, f64, f64)> {
    let per_unit = 5 << halvings;
    let step = 1.0 / f64::from(per_unit);
    let count = 34 * per_unit / 10;
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
fn points([low, high]: [f64; 2], halvings: u32) -> Vec<(f64, f64)> {
    let half = (high - low) / 2.0;
    nodes(halvings)
        .into_iter()
        .map(|(sign, from_end, weight)| {
            let point = if sign < 0.0 { low + half * from_end } else { high - half * from_end };
            (point, weight * half)
        })
        .collect()
}

/// ∬ f over `u` × `v`, cut at u = 0 and v = 0 where these lie inside, with the step halved until
/// the integral settles.
pub fn integrate<const K: usize>(
    u: [f64; 2],
    v: [f64; 2],
    f: impl Fn(f64, f64) -> [f64; K],
) -> [f64; K] {
    let cut = |[low, high]: [f64; 2]| {
        if low < 0.0 && high > 0.0 { vec![[low, 0.0], [0.0, high]] } else { vec![[low, high]] }
    };
    let after = |halvings: u32| {
        let mut sum = [0.0; K];
        for columns in cut(u) {
            let across = points(columns, halvings);
            for rows in cut(v) {
                for &(y, weight_y) in &points(rows, halvings) {
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
    let mut coarse = after(0);
    for halvings in 1..=4 {
        let fine = after(halvings);
        let change = fine.iter().zip(&coarse).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let size = fine.iter().map(|a| a.abs()).fold(0.0, f64::max);
        coarse = fine;
        if change < 1e-13 * size {
            break;
        }
    }
    coarse
}
