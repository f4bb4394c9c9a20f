//! Friction wrench of a rectangle by Gauss-Legendre quadrature.
//!
//! Used where the closed form does not reach: laws that change along the track, and ICRs so far
//! away that the slip direction is nearly uniform.

use crate::contact::{Friction, Patch, Pressure, SlipField};
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
}

/// For ICRs at least six half diagonals away the error falls as 12^(−2n): rounding at n = 8.
static FAR_FIELD: LazyLock<Rule> = LazyLock::new(|| Rule::new(8, 8));

/// Resolves a shear stress that builds up over a few percent of the track's length.
static SHEAR_LAW: LazyLock<Rule> = LazyLock::new(|| Rule::new(8, 24));

/// Friction wrench under the base law where the ICR is far from every patch, about the origin.
pub fn far_field_wrench<S: Scalar>(
    patches: &[Patch],
    friction: Friction,
    pressure: &Pressure<S>,
    slip: &SlipField<S>,
) -> Wrench<S> {
    let unit = S::from(1.0);
    let mut wrench = Wrench::zero();
    for patch in patches {
        wrench += integrate(&FAR_FIELD, patch, slip, |site| {
            site.traction(friction, pressure, [unit, unit])
        });
    }
    wrench
}

/// Wrench about the origin of the stress that a shear law adds to the base law.
///
/// `mobilised` gives the factors on μ_x and μ_y at a site, 1 where the base law holds. Only their
/// departure from 1 is integrated, on panels cut at the ICR: the base law itself stays exact, and a
/// weak effect has a small error.
pub fn departure_wrench<S: Scalar>(
    patches: &[Patch],
    friction: Friction,
    pressure: &Pressure<S>,
    slip: &SlipField<S>,
    mut mobilised: impl FnMut(&Patch, &SlipSite<S>) -> [S; 2],
) -> Wrench<S> {
    let mut wrench = Wrench::zero();
    for patch in patches {
        wrench += integrate(&SHEAR_LAW, patch, slip, |site| {
            let departure = mobilised(patch, &site).map(|factor| factor - 1.0);
            site.traction(friction, pressure, departure)
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
    /// Length of the unit slip, positive.
    pub unit_slip_length: S,
}

impl<S: Scalar> SlipSite<S> {
    /// Shear stress on the body, Pa, with factors on the two friction coefficients.
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

/// Integrates a shear stress over the patch, panel by panel, into a wrench about the origin.
///
/// The slip direction jumps at the ICR, so a patch is cut there and the nodes move with it: the sum
/// stays a smooth function of the motion.
fn integrate<S: Scalar>(
    rule: &Rule,
    patch: &Patch,
    slip: &SlipField<S>,
    mut stress: impl FnMut(SlipSite<S>) -> [S; 2],
) -> Wrench<S> {
    let [icr_x, icr_y] = slip.icr();
    let (columns, rows) = (panels(patch.x, icr_x), panels(patch.y, icr_y));
    let mut wrench = Wrench::zero();
    for [left, right] in columns.into_iter().flatten() {
        let (mid_x, half_x) = ((left + right) * 0.5, (right - left) * 0.5);
        for [rear, front] in rows.into_iter().flatten() {
            let (mid_y, half_y) = ((rear + front) * 0.5, (front - rear) * 0.5);
            for &(node_y, weight_y) in &rule.along {
                let y = mid_y + half_y * node_y;
                for &(node_x, weight_x) in &rule.across {
                    let x = mid_x + half_x * node_x;
                    let unit_slip = slip.direction_at([x, y]);
                    let squared = unit_slip[0] * unit_slip[0] + unit_slip[1] * unit_slip[1];
                    // A node on the ICR itself: no direction, and no area.
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

/// The interval, cut in two where `cut` lies inside it.
fn panels<S: Scalar>([low, high]: [f64; 2], cut: S) -> [Option<[S; 2]>; 2] {
    let (low_edge, high_edge) = (S::from(low), S::from(high));
    if cut.value() > low && cut.value() < high {
        [Some([low_edge, cut]), Some([cut, high_edge])]
    } else {
        [Some([low_edge, high_edge]), None]
    }
}
