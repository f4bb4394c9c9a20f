//! Change of the transient motion by shear-stress laws.
//!
//! # Law
//! A transient simulation with these laws takes a quadrature for each evaluation of the forces. Few
//! are enough if it starts from the motion û without the laws. With D their addition to it, and G
//! and G₀ the sums of forces with and without them, each stage of each step of û solves
//!
//! ```text
//! G(û + D, û̇ + (D − D_b)/(γ h)) = G₀(û, û̇) = 0
//! ```
//!
//! D_b follows from the previous stages, by the scheme of û
//! ([`transient`](trackdyn_model::transient)). The first stage starts at D of the stationary
//! motion, the second at that of the first. Both use Broyden's method with the inverse Jacobian of
//! the previous stage. A step that by the last rate of convergence ends in balance is not evaluated
//! again. Where that fails, the Jacobian is computed anew, G_a without the laws:
//!
//! ```text
//! G_u + G_a/(γ h)
//! ```
//!
//! Where that fails too, a share of one step that lowers the residual is taken: near sticking a law
//! may be steep, and the whole step would lead far away.
//!
//! Where û has been near the stationary motion for a while, so is the motion with the laws, and D
//! is that of the stationary motion. Most of a drive is like this, so few stages need an
//! evaluation. These times depend on û alone, so that D stays smooth in the numbers of the laws.

use crate::settings;
use nalgebra::{Matrix3, Vector3};
use std::cell::LazyCell;
use trackdyn_core::{Twist, real};
use trackdyn_model::Forces;
use trackdyn_model::newton::{self, Convergence, Tolerance};
use trackdyn_model::transient::{GAMMA, Instant, Step, base_of_second};
use trackdyn_recording::TrackSample;

/// A run simulated without the laws.
pub struct Without<'a> {
    /// Steps of its transient motion.
    pub steps: &'a [Step],
    /// Belt speeds, m/s.
    pub belts: &'a [TrackSample],
    /// Stationary twist at each of these readings.
    pub steady: &'a [Twist],
    /// Sum of forces in it, nonzero by the error of the tables.
    pub left: &'a [Vector3<f64>],
}

/// Inverse Jacobian carried over from the previous stage.
#[derive(Clone, Copy)]
struct Known {
    /// The inverse.
    inverse: Matrix3<f64>,
    /// Expected ratio of the residual after a step to that before.
    leaves: f64,
}

/// Change of the twist (paper's frame) by the laws in both stages of each step of a run. `forces`
/// are those with and without the laws, `shifts` their change of the stationary twist at each
/// reading.
pub fn changes(
    [with, without]: [&Forces; 2],
    run: &Without,
    shifts: &[Twist],
    settings: &settings::Mechanics,
) -> Vec<[Twist; 2]> {
    let still = Twist::zero();
    let gauge = with.model.vehicle().gauge;
    let fastest = run.steady.iter().map(|twist| size(*twist, gauge)).fold(0.0, f64::max);
    let departing = settings.max_steady_departure * fastest;
    let mut steady_for = 0.0;
    let mut changes = Vec::with_capacity(run.steps.len());
    let mut ended = still;
    let mut known = None;
    let mut steps = run.steps.iter().peekable();
    for (reading, pair) in run.belts.windows(2).enumerate() {
        let until = pair[1].t;
        let shift = shifts[reading];
        // What tables and quadrature leave unbalanced in the stationary motion counts as balance.
        let rest = LazyCell::new(|| {
            let twist = run.steady[reading] + shift;
            with.sum(pair[0].speeds(), &twist, &still) - run.left[reading]
        });
        while let Some(step) = steps.next_if(|step| step.end <= until) {
            let departs =
                |instant: &Instant| size(instant.twist - run.steady[reading], gauge) > departing;
            let departs = step.stages.iter().any(departs);
            steady_for = if departs { 0.0 } else { steady_for + step.duration };
            if steady_for > settings.min_steady_time {
                changes.push([shift; 2]);
                ended = shift;
                continue;
            }
            let per_second = (GAMMA * step.duration).recip();
            let [first, second] = step.stages.map(|instant| Stage {
                with,
                without,
                instant,
                per_second,
                rest: *rest,
                settings,
            });
            let one = first.solve(shift, &mut known, ended);
            let two = second.solve(one, &mut known, base_of_second(ended, one));
            changes.push([one, two]);
            ended = two;
        }
    }
    changes
}

/// Largest speed of a twist, m/s; that of turning is the speed of the belts.
fn size(twist: Twist, gauge: f64) -> f64 {
    let turning = twist.w * gauge / 2.0;
    [twist.v_x, twist.v_y, turning].into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// A stage whose change D by the laws is sought.
struct Stage<'a> {
    with: &'a Forces<'a>,
    without: &'a Forces<'a>,
    /// Motion without the laws.
    instant: Instant,
    /// 1/(γ h), 1/s.
    per_second: f64,
    /// Sum of forces that counts as balance.
    rest: Vector3<f64>,
    settings: &'a settings::Mechanics,
}

impl Stage<'_> {
    /// Twist and acceleration with a change `added` of the twist; `base` is D_b.
    fn moved(&self, added: &Vector3<f64>, base: Twist) -> (Twist, Twist) {
        let added = Twist::from_array((*added).into());
        let faster = (added - base) * self.per_second;
        (self.instant.twist + added, self.instant.rate + faster)
    }

    /// Unbalanced forces over the weight, and moment over weight times gauge.
    fn residual(&self, added: &Vector3<f64>, base: Twist) -> Vector3<f64> {
        let (twist, rate) = self.moved(added, base);
        let off = self.with.sum(self.instant.belt_speed, &twist, &rate) - self.rest;
        off.component_div(&self.scale())
    }

    /// Unit of the residual: weight for both forces, weight times gauge for the moment.
    fn scale(&self) -> Vector3<f64> {
        let vehicle = self.with.model.vehicle();
        Vector3::new(1.0, 1.0, vehicle.gauge) * vehicle.weight()
    }

    /// Inverse Jacobian of the residual; none where it is singular.
    fn inverse(&self, added: &Vector3<f64>, base: Twist) -> Option<Matrix3<f64>> {
        let (twist, rate) = self.moved(added, base);
        let belts = self.instant.belt_speed;
        let by_rate = self.without.by_rate(belts, &twist, &rate) * self.per_second;
        let derivative = self.with.by_twist(belts, &twist, &rate) + by_rate;
        // (S⁻¹ G')⁻¹ = G'⁻¹ S
        Some(derivative.try_inverse()? * Matrix3::from_diagonal(&self.scale()))
    }

    /// Solves for the change, starting at `start`. `known` is the inverse Jacobian of the previous
    /// stage, and is replaced by that of this one.
    fn solve(&self, start: Twist, known: &mut Option<Known>, base: Twist) -> Twist {
        let start = Vector3::from(start.to_array());
        Twist::from_array(self.solved(&start, known, base).into())
    }

    fn solved(&self, start: &Vector3<f64>, known: &mut Option<Known>, base: Twist) -> Vector3<f64> {
        let residual = |added| self.residual(&added, base);
        let off = residual(*start);
        let converged = self.settings.balance_tolerance;
        let balanced = Tolerance { converged, rounding: converged, is_trusting: true };
        if let Some(known) = known
            && known.leaves * off.norm() <= balanced.converged
        {
            known.leaves *= self.settings.unchecked_growth;
            return start - known.inverse * off;
        }
        let near = |inverse| newton::from_near((*start, off), inverse, balanced, residual);
        let mut inverse = known.map(|known| known.inverse);
        let found = inverse.and_then(near).or_else(|| {
            inverse = self.inverse(start, base);
            near(inverse?)
        });
        if let Some(found) = found {
            *known = found.inverse.map(|inverse| Known { inverse, leaves: leaves(&off, &found) });
            return found.point;
        }
        *known = inverse.map(|inverse| Known { inverse, leaves: 1.0 });
        let Some(inverse) = inverse else { return *start };
        let mut shares =
            self.settings.balance_shares.iter().map(|share| start - inverse * off * *share);
        shares.find(|added| residual(*added).norm() < off.norm()).unwrap_or(*start)
    }
}

/// Mean ratio of the residual after a step to that before, of a solve that began at `off`.
fn leaves(off: &Vector3<f64>, found: &Convergence<3>) -> f64 {
    if found.iterations == 0 {
        return 1.0;
    }
    (found.residual / off.norm()).powf(real(found.iterations).recip())
}
