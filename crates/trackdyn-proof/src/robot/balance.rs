//! Forces on the robot at a trial of a step's end.

use crate::gear::{Gear, Shoe};
use crate::mechanism::{Contact, Inertia, Mechanism, Scene};
use trackdyn_core::{PerSide, Side, Twist, Wrench};

/// Newton's law over one step, by the implicit Euler rule.
pub(super) struct Balance<'a> {
    pub(super) scene: &'a Scene<'a>,
    pub(super) mechanisms: &'a [Box<dyn Mechanism>],
    pub(super) inertia: Inertia,
    pub(super) elastic_range: f64,
    pub(super) dt: f64,
}

/// What a step leaves behind beside the motion.
pub(super) struct Outcome {
    /// Force of the ground along each track, N.
    pub(super) traction: PerSide<f64>,
    /// Power that slip turned into heat, W.
    pub(super) heat: PerSide<f64>,
}

/// Force on a shoe and its state at the end of the step.
struct Reaction {
    force: [f64; 2],
    slip: [f64; 2],
    bristle: [f64; 2],
    slid: f64,
}

impl Balance<'_> {
    /// What Newton's law leaves over at a twist, about the origin; zero at the step's end.
    pub(super) fn residual(&self, gear: &Gear, twist: &Twist) -> Wrench {
        let mut sum = self.body(twist);
        for side in Side::BOTH {
            let belt = self.belt_velocity(side);
            for (shoe, extent) in gear.shoes(side) {
                let reaction = self.react(shoe, extent, side, belt, twist);
                sum.add_force(reaction.force, shoe.position);
            }
        }
        sum
    }

    /// Brings the shoes to the step's end.
    pub(super) fn settle(&self, gear: &mut Gear, twist: &Twist) -> Outcome {
        let zero = PerSide::new(0.0, 0.0);
        let mut outcome = Outcome { traction: zero, heat: zero };
        for side in Side::BOTH {
            let belt = self.belt_velocity(side);
            for (shoe, extent) in gear.shoes_mut(side) {
                let Reaction { force, slip, bristle, slid } =
                    self.react(shoe, extent, side, belt, twist);
                outcome.traction[side] += force[1];
                outcome.heat[side] -= force[0] * slip[0] + force[1] * slip[1];
                shoe.bristle = bristle;
                shoe.slid = slid;
            }
        }
        outcome
    }

    /// Inertia, weight and what mechanisms push the hull with.
    fn body(&self, twist: &Twist) -> Wrench {
        let Scene { vehicle, gravity, .. } = self.scene;
        let Inertia { transient, gyration_radius, centripetal } = self.inertia;
        let transient_mass = transient * vehicle.mass;
        let centripetal_mass = centripetal * vehicle.mass;
        let before = self.scene.twist.velocity_at(vehicle.cog);
        let after = twist.velocity_at(vehicle.cog);
        let turning = twist.steady_acceleration_at(vehicle.cog);
        let mut wrench = Wrench::zero();
        let force = std::array::from_fn(|k| {
            // m g − m v' − m ω × v
            vehicle.mass * gravity.along[k]
                - transient_mass * (after[k] - before[k]) / self.dt
                - centripetal_mass * turning[k]
        });
        wrench.add_force(force, vehicle.cog);
        // −I ω'
        wrench.moment -=
            transient_mass * gyration_radius * gyration_radius * (twist.w - self.scene.twist.w)
                / self.dt;
        for mechanism in self.mechanisms {
            mechanism.push(self.scene, twist, &mut wrench);
        }
        wrench
    }

    fn belt_velocity(&self, side: Side) -> [f64; 2] {
        let mut velocity = [0.0, self.scene.belt[side]];
        for mechanism in self.mechanisms {
            mechanism.belt(self.scene, side, &mut velocity);
        }
        velocity
    }

    /// # Law
    /// A bristle z of elastic range z₀: `z' = s` while |z| < z₀, and z stays on |z| = z₀ while it slides;
    /// `F = −[μ] N z/z₀`. Sliding steadily this is `−[μ] N s/|s|`. The end of a step is found by radial
    /// return, which is stable whatever the step.
    #[inline]
    fn react(
        &self,
        shoe: &Shoe,
        extent: [f64; 2],
        side: Side,
        belt: [f64; 2],
        twist: &Twist,
    ) -> Reaction {
        let hull = twist.velocity_at(shoe.position);
        let slip = [hull[0] - belt[0], hull[1] - belt[1]];
        let mut bristle =
            [shoe.bristle[0] + slip[0] * self.dt, shoe.bristle[1] + slip[1] * self.dt];
        let stretch = (bristle[0] * bristle[0] + bristle[1] * bristle[1]).sqrt();
        let mut slid = shoe.slid;
        if stretch > self.elastic_range {
            bristle = bristle.map(|z| z * self.elastic_range / stretch);
            slid += stretch - self.elastic_range;
        }
        let deflection = bristle.map(|z| z / self.elastic_range);
        let friction = self.scene.vehicle.friction;
        let mut mu = [friction.across, friction.along];
        let mut force = [0.0, 0.0];
        if !self.mechanisms.is_empty() {
            let contact = Contact {
                scene: self.scene,
                side,
                position: shoe.position,
                extent,
                slip,
                deflection,
                slid: f64::midpoint(shoe.slid, slid),
                load: shoe.load,
                area: shoe.area,
            };
            for mechanism in self.mechanisms {
                mechanism.friction(&contact, &mut mu);
                mechanism.traction(&contact, &mut force);
            }
        }
        // F = −[μ] N z/z₀
        force[0] -= mu[0] * shoe.load * deflection[0];
        force[1] -= mu[1] * shoe.load * deflection[1];
        Reaction { force, slip, bristle, slid }
    }
}
