//! What a mechanism is and what it can touch.

use trackdyn_core::{Moment, PerSide, Pose, Side, Twist, Wrench, frames};
use trackdyn_model::Vehicle;

use crate::form::Draws;
use crate::sheet::Sheet;

/// Physics of the simulated robot, its ground or its sensors, that may be switched on.
///
/// A hook adds to or multiplies what it is given. Hooks see the state at the start of a step, or a
/// trial of its end; they do not change the mechanism. What a mechanism remembers it updates in
/// [`Mechanism::advance`], once for every step that is taken.
pub trait Mechanism: std::fmt::Debug + Send + Sync {
    /// Changes the machine before it is put on the ground.
    fn build(&self, _vehicle: &mut Vehicle) {}

    /// What follows Newton's law beyond the quasi-static balance.
    fn inertia(&self, _inertia: &mut Inertia) {}

    /// Mean speeds of the sprockets as speeds of their belts, m/s, in a step of `dt` seconds, from
    /// what the encoders show.
    fn drive(&self, _scene: &Scene, _dt: f64, _sprocket: &mut PerSide<f64>) {}

    /// Whether belts slip on their sprockets ([`Mechanism::slip`]).
    fn slips(&self) -> bool {
        false
    }

    /// Mean part of its sprocket's speed that a belt loses in a step of `dt` seconds, with this
    /// traction over load in the sense of the sprocket.
    fn slip(&self, _side: Side, _traction: f64, _dt: f64) -> f64 {
        0.0
    }

    /// Velocity of a belt's contact over the hull, m/s, paper's frame.
    fn belt(&self, _scene: &Scene, _side: Side, _velocity: &mut [f64; 2]) {}

    /// Gravity along the ground (paper's frame) and into it, m/s².
    fn gravity(&self, _scene: &Scene, _gravity: &mut Gravity) {}

    /// Where the weight acts.
    fn load(&self, _scene: &Scene, _load: &mut Load) {}

    /// Relative stiffness of the running gear above a point of a contact that reaches from
    /// `extent[0]` to `extent[1]` along y, m.
    fn bed(&self, _y: f64, _extent: [f64; 2], _stiffness: &mut f64) {}

    /// Friction coefficients μ_x and μ_y under a shoe.
    fn friction(&self, _contact: &Contact, _mu: &mut [f64; 2]) {}

    /// Shear force of the ground on a shoe beside friction, N, paper's frame.
    fn traction(&self, _contact: &Contact, _force: &mut [f64; 2]) {}

    /// Force along the track that holds a shoe's frame back, beside what the belt delivers, N.
    fn resistance(&self, _contact: &Contact, _force: &mut f64) {}

    /// Friction, traction and resistance of many shoes: one call, in which those of a mechanism are
    /// inlined.
    fn act(&self, contacts: &[Contact], shoes: &mut [Acting]) {
        for (contact, Acting { mu, force, resistance }) in contacts.iter().zip(shoes) {
            self.friction(contact, mu);
            self.traction(contact, force);
            self.resistance(contact, resistance);
        }
    }

    /// Force and moment on the hull at a trial twist, N and N m, paper's frame.
    fn push(&self, _scene: &Scene, _twist: &Twist, _wrench: &mut Wrench) {}

    /// Takes note of a step.
    fn advance(&mut self, _step: &Step) {}

    /// What the pose sensor reports of a motion: stamps, poses and twists.
    fn sense(&self, _moments: &mut [Moment]) {}
}

/// A mechanism with its description.
pub trait Described: Mechanism + Sized + 'static {
    /// Description and parameters.
    const SHEET: Sheet;

    /// The mechanism with its parameters in the order of the sheet, each within its range.
    fn from_values(values: &[f64]) -> Self;

    /// The mechanism in a form that is drawn from its family ([`Sheet::family`]); the plain one
    /// where there is no family.
    fn drawn(values: &[f64], _random: &mut Draws) -> Self {
        Self::from_values(values)
    }
}

/// What acts on a shoe.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Acting {
    /// Friction coefficients μ_x and μ_y.
    pub mu: [f64; 2],
    /// Shear force of the ground, N, paper's frame.
    pub force: [f64; 2],
    /// Force along the track beside it, N.
    pub resistance: f64,
}

/// How much of Newton's law acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// Share of the mass in m v' and I ω'.
    pub transient: f64,
    /// Radius of gyration about the vertical through the centre of gravity, m.
    pub gyration_radius: f64,
    /// Share of the mass in m ω × v.
    pub centripetal: f64,
}

/// Gravity in the robot's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    /// Along the ground, paper's frame, m/s².
    pub along: [f64; 2],
    /// Into the ground, m/s².
    pub normal: f64,
}

/// Where the weight acts on the running gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// x of the centre of pressure of the whole machine, m.
    pub across: f64,
    /// y of the centre of pressure of each side, m.
    pub along: PerSide<f64>,
}

/// The state at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The machine.
    pub vehicle: &'a Vehicle,
    /// Time in the middle of the step, s.
    pub t: f64,
    /// Pose in the world, REP-103, extrapolated to the middle of the step.
    pub pose: Pose,
    /// Twist in the paper's frame.
    pub twist: Twist,
    /// Speeds that the encoders show during the step, m/s.
    pub encoder: PerSide<f64>,
    /// Mean speeds of the sprockets as speeds of their belts, m/s; those of the step before in the
    /// stage `drive`.
    pub sprocket: PerSide<f64>,
    /// Shear force of the ground along each track in the step before, forward positive, N.
    pub traction: PerSide<f64>,
    /// Load on each side in the step before, N.
    pub weight: PerSide<f64>,
    /// Gravity; level where it is asked for.
    pub gravity: Gravity,
}

impl Scene<'_> {
    /// Place in the world (REP-103) of a point in the paper's frame, m.
    pub fn world_from_body(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = frames::ros_from_paper(point);
        let place = self.pose.compose(&Pose::new(x, y, 0.0));
        [place.x, place.y]
    }

    /// Vector in the world's axes from the paper's.
    pub fn world_axes_from_body(&self, vector: [f64; 2]) -> [f64; 2] {
        let [x, y] = frames::ros_from_paper(vector);
        let (sin, cos) = self.pose.yaw.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    }

    /// Vector in the paper's axes from the world's.
    pub fn body_axes_from_world(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.pose.yaw.sin_cos();
        frames::paper_from_ros([cos * x + sin * y, -sin * x + cos * y])
    }

    /// The machine's weight into the ground, N.
    pub fn total_weight(&self) -> f64 {
        self.vehicle.mass * self.gravity.normal
    }
}

/// A shoe on the ground at a trial of a step's end.
#[derive(Clone, Copy, Debug)]
pub struct Contact<'a> {
    /// The scene.
    pub scene: &'a Scene<'a>,
    /// Whose shoe it is.
    pub side: Side,
    /// Where it is, paper's frame, m.
    pub position: [f64; 2],
    /// Rear and front end of all contacts of its side, m.
    pub extent: [f64; 2],
    /// Slip velocity over the ground, paper's axes, m/s.
    pub slip: [f64; 2],
    /// Deflection over its elastic range: the slip direction where the shoe slides, shorter where
    /// it sticks.
    pub deflection: [f64; 2],
    /// Way that it has slid since it came to the ground, until the middle of the step, m.
    pub slid: f64,
    /// Load on it, N.
    pub load: f64,
    /// Its area on the ground, m².
    pub area: f64,
}

impl Contact<'_> {
    /// Slip speed, m/s.
    pub fn slip_speed(&self) -> f64 {
        let [x, y] = self.slip;
        (x * x + y * y).sqrt()
    }

    /// Place in the world (REP-103), m.
    pub fn world(&self) -> [f64; 2] {
        self.scene.world_from_body(self.position)
    }

    /// y over the half length of its side's contact, from −1 at the rear to 1 at the front.
    pub fn relative_y(&self) -> f64 {
        let [rear, front] = self.extent;
        (2.0 * self.position[1] - rear - front) / (front - rear)
    }
}

/// A step that was taken.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The state at its start.
    pub scene: &'a Scene<'a>,
    /// Its length, s.
    pub dt: f64,
    /// Speeds that the mechanism's `drive` was given, m/s.
    pub fed: PerSide<f64>,
    /// What stands against acceleration.
    pub inertia: Inertia,
    /// Twist at its end, paper's frame.
    pub twist: Twist,
    /// Shear force of the ground along each track, forward positive, N.
    pub traction: PerSide<f64>,
    /// Power that slip turned into heat on each side, W.
    pub heat: PerSide<f64>,
}

/// Multiplies the ratio μ_x/μ_y by a factor, of which this power goes to μ_x and the rest to μ_y.
pub fn share_ratio(mu: &mut [f64; 2], factor: f64, across: f64) {
    mu[0] *= factor.powf(across);
    mu[1] *= factor.powf(across - 1.0);
}

/// Multiplies the ratio μ_x/μ_y and keeps the product.
pub fn scale_ratio(mu: &mut [f64; 2], factor: f64) {
    let root = factor.sqrt();
    mu[0] *= root;
    mu[1] /= root;
}
