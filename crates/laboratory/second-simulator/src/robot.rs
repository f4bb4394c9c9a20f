//! The robot: a rigid body on its shoes, in time.

mod balance;
mod newton;
mod setup;

pub use setup::Setup;

use crate::error::Error;
use crate::gear::Gear;
use crate::mechanism::{Gravity, Inertia, Load, Mechanism, Scene, Step};
use crate::mechanisms::ActiveMechanism;
use balance::{Balance, Trial};
use newton::{Newton, SLIPPING_BELT_UNKNOWNS, TWIST_UNKNOWNS};
use trackdyn_core::{
    Moment, PerSide, Plant, Pose, STANDARD_GRAVITY, Side, Stopped, Trajectory, Twist, frames,
};
use trackdyn_model::Vehicle;

/// Shortest step, s. A motion that needs a shorter one is given up.
const MIN_STEP: f64 = 1e-7;

/// A simulated robot.
///
/// # Law
/// `m (v' + ω × v) = F`, `I ω' = M` at the centre of gravity, with friction, gravity and what the
/// mechanisms add; eqs (14)-(15) are its quasi-static case. Mass is in the terms of inertia only as
/// far as mechanisms put it there; [`Setup::residual_mass`] of it remains.
///
/// # Sources
/// Martinez et al., IJRR 24(10), 2005, eqs (14)-(15), (22)-(23).
#[derive(Debug)]
pub struct Robot {
    vehicle: Vehicle,
    setup: Setup,
    mechanisms: Vec<Box<dyn Mechanism>>,
    inertia: Inertia,
    gear: Gear,
    trial: Gear,
    firm: Newton<TWIST_UNKNOWNS>,
    slipping: Newton<SLIPPING_BELT_UNKNOWNS>,
    t: f64,
    step: f64,
    pose: Pose,
    twist: Twist,
    encoder: PerSide<f64>,
    /// Speeds of the sprockets, as speeds of their belts, m/s.
    sprocket: PerSide<f64>,
    belt: PerSide<f64>,
    traction: PerSide<f64>,
    weight: PerSide<f64>,
}

impl Robot {
    /// A robot at rest.
    ///
    /// # Errors
    /// A vehicle or setting that cannot be, or a mechanism that is switched on twice.
    pub fn new(
        vehicle: &Vehicle,
        active: &[ActiveMechanism],
        setup: &Setup,
    ) -> Result<Self, Error> {
        setup.check()?;
        let mut active: Vec<&ActiveMechanism> = active.iter().collect();
        active.sort_by_key(|mechanism| mechanism.index());
        if let Some(twice) = active.windows(2).find(|pair| pair[0].index() == pair[1].index()) {
            return Err(Error::Repeated(twice[0].sheet().id));
        }
        let mechanisms: Vec<_> = active.iter().map(|active| active.mechanism()).collect();
        let mut vehicle = vehicle.clone();
        for mechanism in &mechanisms {
            mechanism.build(&mut vehicle);
        }
        vehicle.check()?;
        let mut inertia = Inertia {
            transient: setup.residual_mass,
            gyration_radius: vehicle.gauge / 2.0,
            centripetal: 0.0,
        };
        for mechanism in &mechanisms {
            mechanism.inertia(&mut inertia);
        }
        let gear = Gear::new(&vehicle, setup.strips, setup.shoes, setup.seed);
        let half_weight = vehicle.mass * STANDARD_GRAVITY / 2.0;
        Ok(Self {
            trial: gear.clone(),
            gear,
            mechanisms,
            inertia,
            firm: Newton::default(),
            slipping: Newton::default(),
            t: setup.start_time,
            step: setup.shortest_step,
            pose: setup.start,
            twist: Twist::zero(),
            encoder: PerSide::new(0.0, 0.0),
            sprocket: PerSide::new(0.0, 0.0),
            belt: PerSide::new(0.0, 0.0),
            traction: PerSide::new(0.0, 0.0),
            weight: PerSide::new(half_weight, half_weight),
            setup: setup.clone(),
            vehicle,
        })
    }

    /// Sets the hull in motion, REP-103 axes.
    pub fn throw(&mut self, twist: &Twist) {
        self.twist = frames::paper_twist_from_ros(twist);
        self.step = self.setup.shortest_step;
    }

    /// What the pose sensor reports of a true motion: its stamps, poses and twists.
    ///
    /// # Panics
    /// Where mechanisms reorder the stamps; none here does.
    pub fn report(&self, truth: &Trajectory) -> Trajectory {
        let mut moments = truth.moments().to_vec();
        for mechanism in &self.mechanisms {
            mechanism.sense(&mut moments);
        }
        let mut reported = Trajectory::default();
        for moment in moments {
            reported.push(moment);
        }
        reported
    }

    /// Kinetic energy in the terms of inertia, J.
    pub fn kinetic_energy(&self) -> f64 {
        let Inertia { transient, gyration_radius, .. } = self.inertia;
        let [v_x, v_y] = self.twist.velocity_at(self.vehicle.cog);
        let spin = gyration_radius * self.twist.w;
        transient * self.vehicle.mass * (v_x * v_x + v_y * v_y + spin * spin) / 2.0
    }

    /// Makes the next step such that speeds change by what the setup wants, after a change by
    /// `change` (m/s); by a factor within these limits.
    fn adapt(&mut self, change: f64, [least, most]: [f64; 2]) {
        let factor = self.setup.speed_change / change.max(f64::MIN_POSITIVE);
        self.step = (self.step * factor.clamp(least, most))
            .clamp(self.setup.shortest_step, self.setup.longest_step);
    }

    /// Takes a step of `dt`, or none and says why not; gives the change of speed, m/s.
    fn advance(&mut self, dt: f64) -> Result<f64, String> {
        let level = Gravity { along: [0.0, 0.0], normal: STANDARD_GRAVITY };
        let way = Pose::exp(&frames::ros_twist_from_paper(&self.twist), dt / 2.0);
        let mut scene = Scene {
            vehicle: &self.vehicle,
            t: self.t + dt / 2.0,
            pose: self.pose.compose(&way),
            twist: self.twist,
            encoder: self.encoder,
            sprocket: self.sprocket,
            traction: self.traction,
            weight: self.weight,
            gravity: level,
        };
        let mut sprocket = self.encoder;
        let mut fed = Vec::with_capacity(self.mechanisms.len());
        for mechanism in &self.mechanisms {
            fed.push(sprocket);
            mechanism.drive(&scene, dt, &mut sprocket);
        }
        // Where the search begins: belts lose what they lost before.
        let belt = PerSide::from_fn(|side| sprocket[side] + self.belt[side] - self.sprocket[side]);
        let mut gravity = level;
        for mechanism in &self.mechanisms {
            mechanism.gravity(&scene, &mut gravity);
        }
        scene.sprocket = sprocket;
        scene.gravity = gravity;
        let [across, along] = self.vehicle.cog;
        let mut load = Load { across, along: PerSide::new(along, along) };
        for mechanism in &self.mechanisms {
            mechanism.load(&scene, &mut load);
        }
        self.trial.copy_from(&self.gear);
        for side in Side::BOTH {
            // N = W (1/2 ± x_p/L)
            let share = 0.5 + side.sign() * load.across / self.vehicle.gauge;
            let weight = scene.total_weight() * share;
            if weight <= 0.0 {
                return Err(format!("the {side:?} side lifts and the robot tips over"));
            }
            scene.weight[side] = weight;
            self.trial.roll(side, belt[side] * dt / 2.0);
            self.trial.bear(side, weight, load.along[side], |y, extent| {
                let mut stiffness = 1.0;
                for mechanism in &self.mechanisms {
                    mechanism.bed(y, extent, &mut stiffness);
                }
                stiffness
            })?;
        }
        let Setup { elastic_range, .. } = self.setup;
        let mut balance =
            Balance::new(&scene, &self.mechanisms, self.inertia, elastic_range, dt, &self.trial);
        let end = if balance.slips() {
            self.slipping.solve(&mut balance, &belt)?
        } else {
            self.firm.solve(&mut balance, &belt)?
        };
        let outcome = balance.settle(&mut self.trial);
        let Trial { twist, belt } = end;
        for side in Side::BOTH {
            self.trial.roll(side, belt[side] * dt / 2.0);
        }
        let step = Step {
            scene: &scene,
            dt,
            fed: sprocket,
            inertia: self.inertia,
            twist,
            traction: outcome.traction,
            heat: outcome.heat,
        };
        for (mechanism, fed) in self.mechanisms.iter_mut().zip(fed) {
            mechanism.advance(&Step { fed, ..step });
        }
        let change = (twist.v_x - self.twist.v_x)
            .hypot(twist.v_y - self.twist.v_y)
            .hypot(self.vehicle.gauge * (twist.w - self.twist.w));
        self.weight = scene.weight;
        self.traction = outcome.traction;
        self.sprocket = sprocket;
        self.belt = belt;
        self.twist = twist;
        self.pose = self.pose.compose(&Pose::exp(&frames::ros_twist_from_paper(&twist), dt));
        self.t += dt;
        std::mem::swap(&mut self.gear, &mut self.trial);
        Ok(change)
    }
}

impl Plant for Robot {
    fn moment(&self) -> Moment {
        Moment {
            t: self.t,
            pose: self.pose,
            twist: frames::ros_twist_from_paper(&self.twist),
            belt_speed: self.belt,
        }
    }

    fn drive(
        &mut self,
        speeds: PerSide<f64>,
        until: f64,
        trajectory: &mut Trajectory,
    ) -> Result<(), Stopped> {
        // a new command is a change of speed ahead
        let jump = |side: Side| (speeds[side] - self.encoder[side]).abs();
        self.adapt(jump(Side::Left).max(jump(Side::Right)), [0.0, 1.0]);
        self.encoder = speeds;
        while self.t < until {
            let remaining = until - self.t;
            // the last two steps share what is left, so that none is a sliver
            let dt =
                if remaining <= self.step { remaining } else { self.step.min(remaining / 2.0) };
            match self.advance(dt) {
                Ok(change) => {
                    if dt == remaining {
                        self.t = until;
                    }
                    trajectory.push(self.moment());
                    self.adapt(change, [0.3, 1.6]);
                }
                Err(reason) => {
                    self.step = dt / 4.0;
                    if self.step < MIN_STEP {
                        return Err(Stopped { t: self.t, reason });
                    }
                }
            }
        }
        Ok(())
    }
}
