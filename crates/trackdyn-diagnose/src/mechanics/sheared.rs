//! What laws of the shear stress change in the motion in time.
//!
//! # Law
//! A motion in time with these laws takes a quadrature for each of many balances of forces. Near it
//! few are enough. With û the motion without the laws, D what they add to it, and G and G₀ the sums
//! of forces with and without them, in each stage of each step of û
//!
//! ```text
//! G(û + D, û̇ + (D − D_b)/(γ h)) = G₀(û, û̇) = 0
//! ```
//!
//! D_b from the stages before, as û has it from its own ([`transient`](trackdyn_model::transient)).
//! The first stage begins at D as it is in stationary motion, the second at that of the first, and
//! both with the derivatives of the stage before, by Broyden's method; a step that, by what the
//! last ones left, ends in balance is taken without a look. Where that leads nowhere, it begins
//! with the derivatives of the stage itself, which are
//!
//! ```text
//! G_u + G_a/(γ h)
//! ```
//!
//! with G_a that without the laws. Where these lead nowhere either, as much of one step is taken as
//! comes nearer to a balance: where a track nearly sticks a law may be steep, and the whole step
//! lead far away.

use crate::settings;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{Twist, real};
use trackdyn_model::Forces;
use trackdyn_model::newton::{self, Convergence, Tolerance};
use trackdyn_model::transient::{GAMMA, Instant, Step};
use trackdyn_recording::TrackSample;

/// A run without the laws.
pub struct Without<'a> {
    /// The steps of its motion in time.
    pub steps: &'a [Step],
    /// Speeds of the belts, m/s.
    pub belts: &'a [TrackSample],
    /// The stationary twist at each of their readings.
    pub steady: &'a [Twist],
    /// The sum of forces in that, which the tables of stationary motions leave.
    pub left: &'a [Vector3<f64>],
}

/// What is known of the derivatives of a stage from those before.
#[derive(Clone, Copy)]
struct Known {
    /// Inverse of them.
    inverse: Matrix3<f64>,
    /// Part of the residual that a step with it is taken to leave.
    leaves: f64,
}

/// What the laws add to the twist (paper's frame) while each reading of a run holds. `forces` are
/// those with and without the laws, `shifts` is what they add to the stationary twist at each
/// reading.
pub fn departures(
    [with, without]: [&Forces; 2],
    run: &Without,
    shifts: &[Twist],
    settings: &settings::Mechanics,
) -> Vec<Twist> {
    let still = Twist::zero();
    let mut departures = vec![still; run.belts.len()];
    let mut ended = Vector3::zeros();
    let mut known = None;
    let mut steps = run.steps.iter().peekable();
    for (reading, pair) in run.belts.windows(2).enumerate() {
        let [from, until] = [pair[0].t, pair[1].t];
        let speeds = pair[0].speeds();
        let (here, shift) = (run.steady[reading] + shifts[reading], vector(&shifts[reading]));
        // What the tables and rules of both leave of a stationary motion is no change of it.
        let rest = with.sum(speeds, &here, &still) - run.left[reading];
        let mut sum = Vector3::zeros();
        while let Some(step) = steps.next_if(|step| step.end <= until) {
            let per_second = (GAMMA * step.duration).recip();
            let [first, second] = step.stages.map(|instant| Stage {
                with,
                without,
                instant,
                per_second,
                rest,
                settings,
            });
            let one = first.solve(&shift, &mut known, &ended);
            let base = ended + (one - ended) * ((1.0 - GAMMA) / GAMMA);
            let two = second.solve(&one, &mut known, &base);
            sum += (one * (1.0 - GAMMA) + two * GAMMA - shift) * step.duration;
            ended = two;
        }
        let held = until - from;
        if held > 0.0 {
            departures[reading] = twist_of(&(sum / held));
        }
    }
    departures
}

/// A stage in which what the laws add is sought.
struct Stage<'a> {
    with: &'a Forces<'a>,
    without: &'a Forces<'a>,
    /// The motion without them.
    instant: Instant,
    /// 1/(γ h), 1/s.
    per_second: f64,
    /// The sum of forces that counts as balance.
    rest: Vector3<f64>,
    settings: &'a settings::Mechanics,
}

impl Stage<'_> {
    /// The motion with something `added`, which was `base` before.
    fn moved(&self, added: &Vector3<f64>, base: &Vector3<f64>) -> (Twist, Twist) {
        let faster = (added - base) * self.per_second;
        (self.instant.twist + twist_of(added), self.instant.rate + twist_of(&faster))
    }

    /// By how much the forces are off balance, over the weight, and the moment over that times the
    /// gauge.
    fn residual(&self, added: &Vector3<f64>, base: &Vector3<f64>) -> Vector3<f64> {
        let (twist, rate) = self.moved(added, base);
        let off = self.with.sum(self.instant.belt_speed, &twist, &rate) - self.rest;
        off.component_div(&self.scale())
    }

    /// What counts as one: the weight for both forces, the weight times the gauge for the moment.
    fn scale(&self) -> Vector3<f64> {
        let vehicle = self.with.model.vehicle();
        Vector3::new(1.0, 1.0, vehicle.gauge) * vehicle.weight()
    }

    /// The inverse of the derivative of that; none where it has none.
    fn inverse(&self, added: &Vector3<f64>, base: &Vector3<f64>) -> Option<Matrix3<f64>> {
        let (twist, rate) = self.moved(added, base);
        let belts = self.instant.belt_speed;
        let by_rate = self.without.by_rate(belts, &twist, &rate) * self.per_second;
        let derivative = self.with.by_twist(belts, &twist, &rate) + by_rate;
        // (S⁻¹ G')⁻¹ = G'⁻¹ S
        Some(derivative.try_inverse()? * Matrix3::from_diagonal(&self.scale()))
    }

    /// What is added, sought from `start`. `known` is that of a stage before, and after it that of
    /// this one.
    fn solve(
        &self,
        start: &Vector3<f64>,
        known: &mut Option<Known>,
        base: &Vector3<f64>,
    ) -> Vector3<f64> {
        let residual = |added| self.residual(&added, base);
        let off = residual(*start);
        let converged = self.settings.balance_tolerance;
        let balanced = Tolerance { converged, rounding: converged };
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

/// Part of the residual that each step of a search left, which began `off` balance.
fn leaves(off: &Vector3<f64>, found: &Convergence<3>) -> f64 {
    if found.iterations == 0 {
        return 1.0;
    }
    (found.residual / off.norm()).powf(real(found.iterations).recip())
}

fn vector(twist: &Twist) -> Vector3<f64> {
    Vector3::new(twist.v_x, twist.v_y, twist.w)
}

fn twist_of(vector: &Vector3<f64>) -> Twist {
    Twist { v_x: vector[0], v_y: vector[1], w: vector[2] }
}
