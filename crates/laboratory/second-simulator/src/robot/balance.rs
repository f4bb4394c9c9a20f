//! Forces on the robot at a trial of a step's end.

use crate::gear::Gear;
use crate::mechanism::{Acting, Contact, Inertia, Mechanism, Scene};
use trackdyn_core::{PerSide, Side, Twist, Wrench};

/// Newton's law over one step, by the implicit Euler rule.
pub(super) struct Balance<'a> {
    scene: &'a Scene<'a>,
    mechanisms: &'a [Box<dyn Mechanism>],
    inertia: Inertia,
    elastic_range: f64,
    dt: f64,
    slips: bool,
    shoes: PerSide<Shoes<'a>>,
}

/// A trial of a step's end.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    /// Twist, paper's frame.
    pub(super) twist: Twist,
    /// Speeds of the belts over the hull, m/s.
    pub(super) belt: PerSide<f64>,
}

/// What a trial leaves over; nothing at the step's end.
pub(super) struct Residual {
    /// Of Newton's law, about the origin.
    pub(super) wrench: Wrench,
    /// By how much belts are faster than their slip allows, m/s.
    pub(super) belt: PerSide<f64>,
}

/// The shoes of a side at the trial that was looked at last.
struct Shoes<'a> {
    contacts: Vec<Contact<'a>>,
    /// Deflection and way slid at the step's start.
    start: Vec<State>,
    /// State at the end of the step.
    end: Vec<State>,
    acting: Vec<Acting>,
}

/// What a shoe carries from step to step.
#[derive(Clone, Copy)]
struct State {
    bristle: [f64; 2],
    slid: f64,
}

/// What a step leaves behind beside the motion.
pub(super) struct Outcome {
    /// Shear force of the ground along each track, N.
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
            let extent = gear.extent(side);
            let shoes = gear.shoes(side).iter();
            let contacts: Vec<_> = shoes
                .clone()
                .map(|shoe| Contact {
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
            let start: Vec<_> =
                shoes.map(|shoe| State { bristle: shoe.bristle, slid: shoe.slid }).collect();
            let acting = vec![Acting::default(); start.len()];
            Shoes { contacts, end: start.clone(), start, acting }
        });
        let slips = mechanisms.iter().any(|mechanism| mechanism.slips());
        Self { scene, mechanisms, inertia, elastic_range, dt, slips, shoes }
    }

    /// The state at the step's start.
    pub(super) fn scene(&self) -> &'a Scene<'a> {
        self.scene
    }

    /// Whether belts may be slower than their sprockets.
    pub(super) fn slips(&self) -> bool {
        self.slips
    }

    /// What a trial leaves over.
    pub(super) fn residual(&mut self, trial: &Trial) -> Residual {
        let mut wrench = self.body(&trial.twist);
        let mut belt = PerSide::new(0.0, 0.0);
        for side in Side::BOTH {
            self.react(side, trial);
            let mut traction = 0.0;
            let Shoes { contacts, acting, .. } = &self.shoes[side];
            for (contact, Acting { force, resistance, .. }) in contacts.iter().zip(acting) {
                traction += force[1];
                wrench.add_force([force[0], force[1] + resistance], contact.position);
            }
            belt[side] = trial.belt[side] - self.belt(side, traction);
        }
        Residual { wrench, belt }
    }

    /// Speed of a belt under this traction, N, m/s.
    fn belt(&self, side: Side, traction: f64) -> f64 {
        let sprocket = self.scene.sprocket[side];
        let traction = sprocket.signum() * traction / self.scene.weight[side];
        let slips = self.mechanisms.iter().map(|m| m.slip(side, traction, self.dt));
        sprocket * (1.0 - slips.sum::<f64>())
    }

    /// Brings the shoes to the step's end, which is the trial that was looked at last.
    pub(super) fn settle(&self, gear: &mut Gear) -> Outcome {
        let zero = PerSide::new(0.0, 0.0);
        let mut outcome = Outcome { traction: zero, heat: zero };
        for side in Side::BOTH {
            let Shoes { contacts, end, acting, .. } = &self.shoes[side];
            for (Contact { slip, .. }, Acting { force, .. }) in contacts.iter().zip(acting) {
                outcome.traction[side] += force[1];
                outcome.heat[side] -= force[0] * slip[0] + force[1] * slip[1];
            }
            for (shoe, State { bristle, slid }) in gear.shoes_mut(side).iter_mut().zip(end) {
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

    fn belt_velocity(&self, side: Side, speed: f64) -> [f64; 2] {
        let mut velocity = [0.0, speed];
        for mechanism in self.mechanisms {
            mechanism.belt(self.scene, side, &mut velocity);
        }
        velocity
    }

    /// # Law
    /// A bristle z of elastic range z₀: `z' = s` while |z| < z₀, and z stays on |z| = z₀ while it
    /// slides; `F = −[μ] N z/z₀`. Sliding steadily this is `−[μ] N s/|s|`. The end of a step is
    /// found by radial return, which is stable whatever the step.
    fn react(&mut self, side: Side, Trial { twist, belt }: &Trial) {
        let belt = self.belt_velocity(side, belt[side]);
        let friction = self.scene.vehicle.friction;
        let Shoes { contacts, start, end, acting } = &mut self.shoes[side];
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
        acting.fill(Acting { mu: [friction.across, friction.along], ..Acting::default() });
        for mechanism in self.mechanisms {
            mechanism.act(contacts, acting);
        }
        for (Contact { load, deflection, .. }, Acting { mu, force, .. }) in
            contacts.iter().zip(acting)
        {
            // F = −[μ] N z/z₀
            force[0] -= mu[0] * load * deflection[0];
            force[1] -= mu[1] * load * deflection[1];
        }
    }
}
