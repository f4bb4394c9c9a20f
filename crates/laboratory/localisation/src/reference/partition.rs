//! A scan, cut into straight pieces.
//!
//! In the plane a line is n · p = d, so along a beam of direction u it stands at 1/ρ = a · u with
//! a = n/d: linear. The pieces are those of least cost
//!
//! Σ over pieces ( min over a of Σ ρ⁴ (1/ρ − a · u)²/σ² + 3 ln N ),
//!
//! the Bayesian information criterion: two numbers of the line and one for its end. The least is
//! found exactly.
//!
//! # Sources
//! Killick, Fearnhead and Eckley, Optimal detection of changepoints with a linear computational
//! cost, JASA 107 (2012), 1590-1598: what is pruned can never again be part of the optimum.

use crate::scan::Return;
use std::ops::Range;

/// A place where the last piece may start.
struct Start {
    /// Index of its first return.
    at: usize,
    /// Least cost of all returns before it, its own penalty included.
    before: f64,
    moments: Moments,
}

/// Sums of a piece, with directions (c, s) against its first return: numbers of like size, so that
/// short pieces lose no digits.
#[derive(Default)]
struct Moments {
    count: usize,
    cc: f64,
    cs: f64,
    ss: f64,
    qc: f64,
    qs: f64,
    qq: f64,
}

/// The straight pieces of a scan: ranges of indices that cover all returns.
#[expect(clippy::cast_precision_loss, reason = "beams are few")]
pub(super) fn pieces(returns: &[Return], range_noise: f64) -> Vec<Range<usize>> {
    let penalty = 3.0 * (returns.len().max(1) as f64).ln();
    let per_variance = (range_noise * range_noise).recip();
    let mut starts: Vec<Start> = Vec::new();
    // For the returns up to each one, where the last piece starts.
    let mut last_start = Vec::with_capacity(returns.len());
    let mut least = 0.0;
    for (index, hit) in returns.iter().enumerate() {
        starts.push(Start { at: index, before: least + penalty, moments: Moments::default() });
        let mut best = (f64::INFINITY, index);
        let mut totals = Vec::with_capacity(starts.len());
        for start in &mut starts {
            start.moments.add(hit, returns[start.at].direction);
            let total = start.before + start.moments.squares() * per_variance;
            totals.push(total);
            if total < best.0 {
                best = (total, start.at);
            }
        }
        least = best.0;
        last_start.push(best.1);
        let mut totals = totals.into_iter();
        starts.retain(|_| totals.next().is_some_and(|total| total <= least + penalty));
    }
    let mut pieces = Vec::new();
    let mut end = returns.len();
    while end > 0 {
        let start = last_start[end - 1];
        pieces.push(start..end);
        end = start;
    }
    pieces.reverse();
    pieces
}

impl Moments {
    fn add(&mut self, hit: &Return, first: [f64; 2]) {
        let [u, v] = hit.direction;
        let (c, s) = (u * first[0] + v * first[1], v * first[0] - u * first[1]);
        // Var 1/ρ = σ²/ρ⁴
        let (r2, q_weight) = (hit.range * hit.range, hit.range * hit.range * hit.range);
        let weight = r2 * r2;
        self.count += 1;
        self.cc += weight * c * c;
        self.cs += weight * c * s;
        self.ss += weight * s * s;
        self.qc += q_weight * c;
        self.qs += q_weight * s;
        self.qq += r2;
    }

    /// min over a of Σ ρ⁴ (1/ρ − a · u)², m².
    fn squares(&self) -> f64 {
        if self.count <= 2 {
            return 0.0;
        }
        let Self { cc, cs, ss, qc, qs, qq, .. } = *self;
        let determinant = cc * ss - cs * cs;
        let explained = (qc * qc * ss - 2.0 * qc * qs * cs + qs * qs * cc) / determinant;
        (qq - explained).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn returns(range: impl Fn(f64) -> f64) -> Vec<Return> {
        (0..181)
            .map(|beam| {
                let angle = f64::from(beam).to_radians() - std::f64::consts::FRAC_PI_2;
                let (sin, cos) = angle.sin_cos();
                let at = usize::try_from(beam).unwrap_or_default();
                Return { beam: at, direction: [cos, sin], range: range(angle) }
            })
            .collect()
    }

    #[test]
    fn two_walls_are_cut_at_their_corner() {
        // Walls x = 3 and y = 2 meet at atan(2/3) = 33.7 degrees: beam 124 is the first beyond.
        let hits = returns(|angle| {
            let (sin, cos) = angle.sin_cos();
            (3.0 / cos.max(0.2)).min(2.0 / sin.max(0.01))
        });
        let pieces = pieces(&hits[40..], 0.001);
        assert!(pieces.contains(&(84..141)), "{pieces:?}");
    }

    #[test]
    fn no_return_gives_no_piece() {
        assert!(pieces(&[], 0.01).is_empty());
    }
}
