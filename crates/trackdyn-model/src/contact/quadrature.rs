//! Friction wrench of a rectangle by Gauss-Legendre quadrature.
//!
//! Used where the closed form does not apply: laws that change the shear stress, and ICRs so far
//! away that the slip direction is nearly uniform.

use crate::contact::{Friction, Patch, Pressure, ShearStress, SlipField};
use gauss_quad::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;
use trackdyn_core::{Scalar, Wrench};

/// Nodes across and along a panel, on (−1, 1).
struct Rule {
    across: Vec<(f64, f64)>,
    along: Vec<(f64, f64)>,
}

impl Rule {
    fn new(across: usize, along: usize) -> Self {
        let nodes = |degree: usize| {
            let degree = NonZeroUsize::new(degree).expect("a rule has nodes");
            GaussLegendre::new(degree).as_node_weight_pairs().to_vec()
        };
        Self { across: nodes(across), along: nodes(along) }
    }

    /// A rule with nodes concentrated at both ends of a panel, u → (3u − u³)/2: a stress that
    /// builds up from the point of entry is steep there.
    fn graded(across: usize, along: usize) -> Self {
        let mut rule = Self::new(across, along);
        for (node, weight) in &mut rule.along {
            *weight *= 1.5 * (1.0 - *node * *node);
            *node *= 1.5 - 0.5 * *node * *node;
        }
        rule
    }
}

/// Distances of the ICR, in half diagonals of the patch, beyond which n nodes each way suffice.
/// Pressure and lever are linear along the track, so the error is (2 d)^(2−2n): 10⁻¹⁶ at these,
/// except for the last, which begins where the closed form ends.
const NODES_BY_DISTANCE: [(f64, usize); 6] =
    [(5000.0, 3), (232.0, 4), (50.0, 5), (20.0, 6), (10.8, 7), (0.0, 8)];

/// The rules of [`NODES_BY_DISTANCE`].
static FAR_FIELD_RULES: LazyLock<[Rule; NODES_BY_DISTANCE.len()]> =
    LazyLock::new(|| NODES_BY_DISTANCE.map(|(_, n)| Rule::new(n, n)));

/// Rules for half the digits, 10⁻⁸: the exponent 2n − 2 is halved.
static COARSE_FAR_FIELD_RULES: LazyLock<[Rule; NODES_BY_DISTANCE.len()]> =
    LazyLock::new(|| NODES_BY_DISTANCE.map(|(_, n)| n / 2 + 1).map(|n| Rule::new(n, n)));

/// Resolves a shear stress that builds up over a percent of the track's length.
static FINE_RULE: LazyLock<Rule> = LazyLock::new(|| Rule::graded(8, 24));

/// Resolves the change by a law to half a percent, and where a stress builds up over a few percent
/// of the length to one percent, in an eighth of the time of [`FINE_RULE`].
static COARSE_RULE: LazyLock<Rule> = LazyLock::new(|| Rule::graded(2, 8));

/// Resolves the change by a law to a tenth, in a third of the time of [`COARSE_RULE`].
static ROUGH_RULE: LazyLock<Rule> = LazyLock::new(|| Rule::graded(1, 5));

/// [`ROUGH_RULE`] for a patch hardly longer than wide.
static SHORT_ROUGH_RULE: LazyLock<Rule> = LazyLock::new(|| Rule::graded(2, 3));

/// Resolution of the shear-stress quadrature.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resolution {
    /// Base law to all digits; changes by other laws as accurately as their kinks allow.
    #[default]
    Fine,
    /// Base law to eight digits, changes by other laws to a percent: for noisy data, on a ground
    /// whose law is never known that well.
    Coarse,
    /// Base law to eight digits, changes by other laws to a tenth: for corrections.
    Rough,
}

/// Friction wrench of the base law about the origin, where the ICR is far from every patch.
pub fn far_field_wrench<S: Scalar>(
    patches: impl Iterator<Item = Patch<S>>,
    friction: Friction,
    pressure: &Pressure<S>,
    slip: &SlipField<S>,
    resolution: Resolution,
) -> Wrench<S> {
    let rules =
        if resolution == Resolution::Fine { &FAR_FIELD_RULES } else { &COARSE_FAR_FIELD_RULES };
    let unit = S::from(1.0);
    let mut wrench = Wrench::zero();
    for patch in patches {
        let distance = slip.icr_distance_squared(&patch.value()).sqrt();
        let reached = NODES_BY_DISTANCE.iter().position(|(from, _)| distance >= *from);
        let rule = &rules[reached.unwrap_or(NODES_BY_DISTANCE.len() - 1)];
        wrench += integrate(rule, &Panels::whole(&patch), slip, |site| {
            site.traction(friction, pressure, [unit, unit])
        });
    }
    wrench
}

/// Wrench about the origin of the change of stress by shear laws.
///
/// `law` gives factor f and added stress at a site. Only the difference f (τ + τ_added) − τ from
/// the base law is integrated, on panels cut at the ICR: the base law stays exact, and a weak
/// effect has a small error.
pub fn departure_wrench<S: Scalar>(
    patches: impl Iterator<Item = Patch<S>>,
    friction: Friction,
    pressure: &Pressure<S>,
    slip: &SlipField<S>,
    resolution: Resolution,
    mut law: impl FnMut(&Patch<S>, &SlipSite<S>) -> ShearStress<S>,
) -> Wrench<S> {
    let mut wrench = Wrench::zero();
    for patch in patches {
        let is_short = patch.length().value() < 2.0 * patch.width();
        let rule = match (resolution, is_short) {
            (Resolution::Fine, _) => &FINE_RULE,
            (Resolution::Coarse, _) => &COARSE_RULE,
            (Resolution::Rough, false) => &ROUGH_RULE,
            (Resolution::Rough, true) => &SHORT_ROUGH_RULE,
        };
        let panels = Panels::cut(&patch, slip);
        wrench += integrate(rule, &panels, slip, |site| {
            let ShearStress { factor, added } = law(&patch, &site);
            let base = site.traction(friction, pressure, factor.map(|f| f - 1.0));
            [base[0] + factor[0] * added[0], base[1] + factor[1] * added[1]]
        });
    }
    wrench
}

/// A point of the contact and the slip there.
pub struct SlipSite<S> {
    /// Body point (x, y), m.
    pub position: [S; 2],
    /// Unit slip (see [`SlipField::direction_at`]).
    pub unit_slip: [S; 2],
    /// Norm of the unit slip, positive.
    pub unit_slip_length: S,
}

impl<S: Scalar> SlipSite<S> {
    /// Shear stress on the body, Pa, with factors on both friction coefficients.
    #[inline]
    fn traction(&self, friction: Friction, pressure: &Pressure<S>, factors: [S; 2]) -> [S; 2] {
        // τ = −[μ] p s/|s|, eq. (22)
        let scale = -pressure.at(self.position[1]) / self.unit_slip_length;
        [
            factors[0] * friction.across * self.unit_slip[0] * scale,
            factors[1] * friction.along * self.unit_slip[1] * scale,
        ]
    }
}

/// Integrates a shear stress over a patch, panel by panel, into a wrench about the origin.
fn integrate<S: Scalar>(
    rule: &Rule,
    panels: &Panels<S>,
    slip: &SlipField<S>,
    mut stress: impl FnMut(SlipSite<S>) -> [S; 2],
) -> Wrench<S> {
    let Panels { columns, rows } = panels;
    let mut wrench = Wrench::zero();
    for &[left, right] in columns.iter().flatten() {
        let (mid_x, half_x) = ((left + right) * 0.5, (right - left) * 0.5);
        for &[rear, front] in rows.iter().flatten() {
            let (mid_y, half_y) = ((rear + front) * 0.5, (front - rear) * 0.5);
            for &(node_y, weight_y) in &rule.along {
                let y = mid_y + half_y * node_y;
                for &(node_x, weight_x) in &rule.across {
                    let x = mid_x + half_x * node_x;
                    let unit_slip = slip.direction_at([x, y]);
                    let squared = unit_slip[0] * unit_slip[0] + unit_slip[1] * unit_slip[1];
                    // A node on the ICR itself has no slip direction, and no area.
                    if squared.value() < f64::MIN_POSITIVE {
                        continue;
                    }
                    let [stress_x, stress_y] = stress(SlipSite {
                        position: [x, y],
                        unit_slip,
                        unit_slip_length: squared.sqrt(),
                    });
                    let area = half_x * half_y * (weight_x * weight_y);
                    wrench.force_x += stress_x * area;
                    wrench.force_y += stress_y * area;
                    wrench.moment += (x * stress_y - y * stress_x) * area;
                }
            }
        }
    }
    wrench
}

/// A patch in panels on which the integrand is smooth.
struct Panels<S> {
    columns: [Option<[S; 2]>; 2],
    rows: [Option<[S; 2]>; 2],
}

/// Smallest change of the unit slip over the patch for which it is cut at the ICR: below, the ICR
/// is so far away that the cut has no significant digits.
const MIN_TURN: f64 = 1e-9;

impl<S: Scalar> Panels<S> {
    /// The whole patch.
    fn whole(patch: &Patch<S>) -> Self {
        Self { columns: [Some(patch.x.map(S::from)), None], rows: [Some(patch.y), None] }
    }

    /// The patch, cut at the ICR.
    ///
    /// The slip direction jumps at the ICR, and its components change sign along the lines through
    /// it. The nodes move with the cuts, so the sum stays a smooth function of the motion.
    fn cut(patch: &Patch<S>, slip: &SlipField<S>) -> Self {
        let diagonal = patch.width().hypot(patch.length().value());
        if slip.rotation.value().abs() * diagonal < MIN_TURN {
            return Self::whole(patch);
        }
        let [icr_x, icr_y] = slip.icr();
        Self { columns: cut(patch.x.map(S::from), icr_x), rows: cut(patch.y, icr_y) }
    }
}

/// The interval, cut in two if `at` lies inside.
fn cut<S: Scalar>([low, high]: [S; 2], at: S) -> [Option<[S; 2]>; 2] {
    if at.value() > low.value() && at.value() < high.value() {
        [Some([low, at]), Some([at, high])]
    } else {
        [Some([low, high]), None]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rule has fewer nodes the farther away the ICR is, at equal accuracy.
    #[test]
    fn far_fields_are_exact_at_every_distance() {
        let patch = Patch::centred([0.2, -0.3], 0.1, 0.4);
        let friction = Friction { across: 0.6, along: 0.9 };
        let pressure = Pressure { at_origin: 1000.0, gradient: 300.0 };
        let finest = Rule::new(12, 12);
        for k in 0..400 {
            let distance = 6.0 * 1.03_f64.powi(k) * patch.width().hypot(patch.length()) / 2.0;
            let [sin, cos] = [f64::from(k).sin(), f64::from(k).cos()];
            let icr = [patch.centre()[0] + distance * cos, patch.centre()[1] + distance * sin];
            let rotation = 1.0 / distance;
            let slip = SlipField {
                lateral: rotation * icr[1],
                forward: -rotation * icr[0],
                rotation,
                speed: 1.0,
            };
            let exact = integrate(&finest, &Panels::whole(&patch), &slip, |site| {
                site.traction(friction, &pressure, [1.0, 1.0])
            });
            let force = 1000.0 * patch.area();
            for (resolution, error) in [(Resolution::Fine, 2e-14), (Resolution::Coarse, 1e-8)] {
                let patches = [patch];
                let chosen =
                    far_field_wrench(patches.into_iter(), friction, &pressure, &slip, resolution);
                for (a, b) in [
                    (chosen.force_x, exact.force_x),
                    (chosen.force_y, exact.force_y),
                    (chosen.moment, exact.moment),
                ] {
                    assert!((a - b).abs() < error * force, "{distance} m: {a} {b}");
                }
            }
        }
    }
}
