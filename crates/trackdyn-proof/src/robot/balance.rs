//! Forces on the robot at a trial of a step's end.

use crate::gear::Gear;
use crate::mechanism::{Contact, Inertia, Mechanism, Scene};
use trackdyn_core::{PerSide, Side, Twist, Wrench};

/// Newton's law over one step, by the implicit Euler rule.
pub(super) struct Balance<'a> {
    scene: &'a Scene<'a>,
    mechanisms: &'a [Box<dyn Mechanism>],
    inertia: Inertia,
    elastic_range: f64,
    dt: f64,
    shoes: PerSide<Shoes<'a>>,
}

/// The shoes of a side at the trial that was looked at last.
struct Shoes<'a> {
    contacts: Vec<Contact<'a>>,
    /// Deflection and way slid at the step's start.
    start: Vec<State>,
    /// The same at its end.
    end: Vec<State>,
    /// Friction coefficients.
    mu: Vec<[f64; 2]>,
    /// Forces, N.
    force: Vec<[f64; 2]>,
}

/// What a shoe carries from step to step.
#[derive(Clone, Copy)]
struct State {
    bristle: [f64; 2],
    slid: f64,
}

/// What a step leaves behind beside the motion.
pub(super) struct Outcome {
    /// Force of the ground along each track, N.
    pub(super) traction: PerSide<f64>,
    /// Power that slip turned into heat, W.
    pub(super) heat: PerSide<f64>,
}

impl<'a> Balance<'a> {
    /// The balance of a step of `dt` seconds of a gear that bears its load.
    pub(super) fn new(
        scene: &'a Scene<'a>,
        mechanisms: &'a [Box<dyn Mechanism>],
        inertia: Inertia,
        elastic_range: f64,
        dt: f64,
        gear: &Gear,
    ) -> Self {
        let shoes = PerSide::from_fn(|side| {
            let contacts: Vec<_> = gear
                .shoes(side)
                .map(|(shoe, extent)| Contact {
                    scene,
                    side,
                    position: shoe.position,
                    extent,
                    slip: [0.0, 0.0],
                    deflection: [0.0, 0.0],
                    slid: shoe.slid,
                    load: shoe.load,
                    area: shoe.area,
                })
                .collect();
            let start: Vec<_> = gear
                .shoes(side)
                .map(|(shoe, _)| State { bristle: shoe.bristle, slid: shoe.slid })
                .collect();
            let count = start.len();
            Shoes {
                contacts,
                end: start.clone(),
                start,
                mu: vec![[0.0, 0.0]; count],
                force: vec![[0.0, 0.0]; count],
            }
        });
        Self { scene, mechanisms, inertia, elastic_range, dt, shoes }
    }

    /// The state at the step's start.
    pub(super) fn scene(&self) -> &'a Scene<'a> {
        self.scene
    }

    /// What Newton's law leaves over at a twist, about the origin; zero at the step's end.
    pub(super) fn residual(&mut self, twist: &Twist) -> Wrench {
        let mut sum = self.body(twist);
        for side in Side::BOTH {
            self.react(side, twist);
            let Shoes { contacts, force, .. } = &self.shoes[side];
            for (contact, force) in contacts.iter().zip(force) {
                sum.add_force(*force, contact.position);
            }
        }
        sum
    }

    /// Brings the shoes to the step's end.
    pub(super) fn settle(&mut self, gear: &mut Gear, twist: &Twist) -> Outcome {
        let zero = PerSide::new(0.0, 0.0);
        let mut outcome = Outcome { traction: zero, heat: zero };
        for side in Side::BOTH {
            self.react(side, twist);
            let Shoes { contacts, end, force, .. } = &self.shoes[side];
            for (Contact { slip, .. }, force) in contacts.iter().zip(force) {
                outcome.traction[side] += force[1];
                outcome.heat[side] -= force[0] * slip[0] + force[1] * slip[1];
            }
            for ((shoe, _), State { bristle, slid }) in gear.shoes_mut(side).zip(end) {
                shoe.bristle = *bristle;
                shoe.slid = *slid;
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
    fn react(&mut self, side: Side, twist: &Twist) {
        let belt = self.belt_velocity(side);
        let friction = self.scene.vehicle.friction;
        let Shoes { contacts, start, end, mu, force } = &mut self.shoes[side];
        for ((contact, start), end) in contacts.iter_mut().zip(start).zip(end) {
            let hull = twist.velocity_at(contact.position);
            let slip = [hull[0] - belt[0], hull[1] - belt[1]];
            let State { mut bristle, mut slid } = *start;
            bristle = [bristle[0] + slip[0] * self.dt, bristle[1] + slip[1] * self.dt];
            let stretch = (bristle[0] * bristle[0] + bristle[1] * bristle[1]).sqrt();
            if stretch > self.elastic_range {
                let share = self.elastic_range / stretch;
                bristle = bristle.map(|z| z * share);
                slid += stretch - self.elastic_range;
            }
            contact.slip = slip;
            contact.deflection = bristle.map(|z| z / self.elastic_range);
            contact.slid = f64::midpoint(start.slid, slid);
            *end = State { bristle, slid };
        }
        mu.fill([friction.across, friction.along]);
        force.fill([0.0, 0.0]);
        for mechanism in self.mechanisms {
            mechanism.act(contacts, mu, force);
        }
        for ((Contact { load, deflection, .. }, mu), force) in contacts.iter().zip(mu).zip(force) {
            // F = −[μ] N z/z₀
            force[0] -= mu[0] * load * deflection[0];
            force[1] -= mu[1] * load * deflection[1];
        }
    }
}
