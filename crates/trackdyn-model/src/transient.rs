//! The motion in time.
//!
//! # Law
//! At every moment all forces on the body balance, eqs (14)-(15), inertia among them where the
//! effects `yaw-inertia` and `centripetal` are on: together they are Newton's second law. Without
//! them the robot is at its stationary motion at once.
//!
//! # Stick and slip
//! Coulomb friction has no value where a whole track sticks. There, and only there, it is
//! regularised: the friction wrench of a side is multiplied by σ/√(σ² + ε²), where σ is the root
//! mean square of its slip velocity. A wrench of the exact law opposes the slip, and so does a
//! fraction of it: energy never grows. With the default ε = [`STICKING_SLIP_VELOCITY`], a track
//! that slips at 1 cm/s has friction exact to 5·10⁻⁹, and a parked robot creeps less than 0.1 mm in
//! a minute at up to 80 % of the friction limit.
//!
//! # Method
//! The two-stage singly diagonal implicit Runge-Kutta method of order 2 (Alexander 1977), which
//! damps stiff parts at once. Each stage is one balance of forces with the acceleration (u −
//! u_b)/(γ h): the same equations as the stationary ones, solved by Broyden's method from the last
//! balance, else by the same Newton iteration with exact derivatives. Where belts slip on their
//! sprockets, the traction of both sides is sought with the twist: near straight driving friction
//! turns over within a small slip, and belts at speeds by an earlier traction would jump to and
//! fro.
//!
//! # Sources
//! Alexander, SIAM Journal on Numerical Analysis 14(6), 1977.

mod stage;

pub(crate) use stage::gripping;

use crate::{Circumstance, Model, Motion};
use stage::{Balanced, Inverse, Stage, Start};
use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{Moment, PerSide, Plant, Pose, Stopped, Trajectory, Twist};

/// Slip velocity ε below which a track sticks, m/s.
pub const STICKING_SLIP_VELOCITY: f64 = 1e-6;

/// Coefficient γ = 1 − 1/√2 of the method: it makes the second stage the end of the step.
pub const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Largest number of halvings of a step for its error.
const MAX_REFINEMENTS: u32 = 2;

/// Largest number of halvings of a step for convergence.
const MAX_HALVINGS: u32 = 10;

/// A step as it was taken.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Its end, s.
    pub end: f64,
    /// Its length h, s.
    pub duration: f64,
    /// Its stages, the second of which is its end. The body moves by 1 − γ of the first twist and γ
    /// of the second.
    pub stages: [Instant; 2],
}

/// A motion in which the forces on a body balance.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// Speeds of the belts, m/s.
    pub belt_speed: PerSide<f64>,
    /// Twist, paper's frame.
    pub twist: Twist,
    /// Its rate, as the method takes it: (u − u_b)/(γ h).
    pub rate: Twist,
}

/// A robot that moves in time.
#[derive(Clone, Debug)]
pub struct Transient<'m> {
    model: &'m Model,
    longest_step: f64,
    /// Estimated error of the twist, m/s, from which on a step is halved.
    tolerance: f64,
    /// Slip velocity below which a track sticks, m/s.
    creep: f64,
    /// Whether some force depends on acceleration. A body without inertia jumps, and its
    /// acceleration means nothing.
    has_inertia: bool,
    /// Whether the motion continues where some of the contact would have to pull.
    may_pull: bool,
    /// The steps so far; none where they are not asked for.
    steps: Option<Vec<Step>>,
    state: State,
}

/// What the next step starts from.
#[derive(Clone, Copy, Debug)]
struct State {
    t: f64,
    pose: Pose,
    /// Twist, paper's frame.
    twist: Twist,
    /// Speeds of the sprockets, after gain and lag, m/s.
    driven: PerSide<f64>,
    /// Speeds of the belts, m/s.
    belt_speed: PerSide<f64>,
    /// Traction over normal load, forward positive, where belts slip on their sprockets; else zero.
    traction: PerSide<f64>,
    /// Whether some of the contact would have to pull.
    lifts: bool,
    /// Whether no pressure, not even a pulling one, can bear the load.
    tips: bool,
    /// What is known of the Jacobian of the last balance.
    inverse: Inverse,
}

impl<'m> Transient<'m> {
    /// Longest step, s, unless another one is asked for. What it costs in accuracy is measured in
    /// docs/theory/transient.md.
    pub const STEP: f64 = 0.01;

    /// The robot at rest at a pose (REP-103) and time.
    pub fn at_rest(model: &'m Model, t: f64, pose: Pose) -> Self {
        let still = PerSide::new(0.0, 0.0);
        let twist = Twist::zero();
        let state = State {
            t,
            pose,
            twist,
            driven: still,
            belt_speed: still,
            traction: still,
            lifts: false,
            tips: false,
            inverse: Inverse::default(),
        };
        Self {
            model,
            longest_step: Self::STEP,
            tolerance: f64::INFINITY,
            creep: STICKING_SLIP_VELOCITY,
            has_inertia: Self::feels_inertia(model),
            may_pull: false,
            steps: None,
            state,
        }
    }

    /// This motion with another longest step, s.
    pub fn with_step(self, longest_step: f64) -> Self {
        Self { longest_step, ..self }
    }

    /// This motion with steps halved where the estimated error of the twist is larger than
    /// `tolerance`, m/s; the yaw rate counts by the speeds of the tracks.
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// This motion with tracks that stick below another slip velocity than
    /// [`STICKING_SLIP_VELOCITY`], m/s: larger ones are solved sooner.
    pub fn with_creep(self, creep: f64) -> Self {
        Self { creep, ..self }
    }

    /// This motion, continued where part of the contact lifts until the robot tips over: the
    /// pressure stays linear, and pulls there. Where the load shifts by 1 + ε times what keeps all
    /// of the contact down, forces are off by a part of ε².
    pub fn with_pull(self) -> Self {
        Self { may_pull: true, ..self }
    }

    /// This motion, keeping its steps.
    pub fn with_steps(self) -> Self {
        Self { steps: Some(Vec::new()), ..self }
    }

    /// The steps since they were asked for.
    pub fn into_steps(self) -> Vec<Step> {
        self.steps.unwrap_or_default()
    }

    /// This motion with another twist (paper's frame).
    pub fn with_twist(mut self, twist: Twist) -> Self {
        self.state.twist = twist;
        self
    }

    /// One step to the time `end` at the speeds `shown` by the encoders, in halves where it does
    /// not converge, or its error is larger than asked for.
    fn step(&mut self, shown: PerSide<f64>, end: f64, halvings: u32) -> Result<(), Stopped> {
        if let Some((state, stages, error)) = self.advanced(shown, end)
            && (error <= self.tolerance || halvings >= MAX_REFINEMENTS)
        {
            let duration = end - self.state.t;
            self.state = state;
            if let Some(steps) = &mut self.steps {
                steps.push(Step { end, duration, stages });
            }
            return Ok(());
        }
        if halvings == MAX_HALVINGS {
            let reason = "no motion balances the forces on the robot".to_owned();
            return Err(Stopped { t: self.state.t, reason });
        }
        self.step(shown, f64::midpoint(self.state.t, end), halvings + 1)?;
        self.step(shown, end, halvings + 1)
    }

    /// The state at the end of a step, its stages, and the estimated error of its twist, m/s; none
    /// where no balance is found.
    fn advanced(&self, shown: PerSide<f64>, end: f64) -> Option<(State, [Instant; 2], f64)> {
        let start = self.state;
        let h = end - start.t;
        // Stage 1 at t + γ h from u, stage 2 at t + h from u + (1 − γ) h u̇₁.
        let first = self.stage(&start, shown, GAMMA * h, GAMMA * h, start.twist, start.twist)?;
        let rate = |a: f64, b: f64| a + (1.0 - GAMMA) / GAMMA * (b - a);
        let base = Twist {
            v_x: rate(start.twist.v_x, first.twist.v_x),
            v_y: rate(start.twist.v_y, first.twist.v_y),
            w: rate(start.twist.w, first.twist.w),
        };
        let second = self.stage(&first, shown, h, GAMMA * h, base, first.twist)?;
        // The pose moves by the weighted twists of the stages.
        let mean = |a: f64, b: f64| (1.0 - GAMMA) * a + GAMMA * b;
        let twist = Twist {
            v_x: mean(first.twist.v_x, second.twist.v_x),
            v_y: mean(first.twist.v_y, second.twist.v_y),
            w: mean(first.twist.w, second.twist.w),
        };
        let pose = start.pose.compose(&Pose::exp(&ros_twist_from_paper(&twist), h));
        // Beside the method of order 1, u + h u̇₁.
        let off = |a: f64, b: f64, c: f64| c - (a + (b - a) / GAMMA);
        let (u, u_1, u_2) = (start.twist, first.twist, second.twist);
        let turn = off(u.w, u_1.w, u_2.w) * self.model.vehicle().gauge / 2.0;
        let error = off(u.v_x, u_1.v_x, u_2.v_x).hypot(off(u.v_y, u_1.v_y, u_2.v_y)).hypot(turn);
        let instant = |state: &State, base: &Twist| {
            // u̇ = (u − u_b)/(γ h)
            let rate = |a: f64, b: f64| (a - b) / (GAMMA * h);
            let Twist { v_x, v_y, w } = state.twist;
            let rate =
                Twist { v_x: rate(v_x, base.v_x), v_y: rate(v_y, base.v_y), w: rate(w, base.w) };
            Instant { belt_speed: state.belt_speed, twist: state.twist, rate }
        };
        let stages = [instant(&first, &start.twist), instant(&second, &base)];
        Some((State { t: end, pose, ..second }, stages, error))
    }

    /// Solves the balance `after` seconds from the start of the step, with the acceleration
    /// (u − `base`)/`duration`; `guess` is where the search starts.
    fn stage(
        &self,
        before: &State,
        shown: PerSide<f64>,
        after: f64,
        duration: f64,
        base: Twist,
        guess: Twist,
    ) -> Option<State> {
        let drive = self.model.drive();
        let target = drive.driven(shown);
        let lag = drive.time_constant;
        // T dV/dt = V_e − V while V_e is held
        let remaining = if lag > 0.0 { (-after / lag).exp() } else { 0.0 };
        let driven = PerSide::from_fn(|side| {
            target[side] + remaining * (self.state.driven[side] - target[side])
        });
        let step = Pose::exp(&ros_twist_from_paper(&guess), after);
        let pose = self.state.pose.compose(&step);
        let ground = self.model.ground(&Circumstance {
            position: [pose.x, pose.y],
            heading: pose.yaw,
            time: self.state.t + after,
        });
        let per_second = if self.has_inertia { duration.recip() } else { 0.0 };
        let Self { model, creep, .. } = *self;
        let stage = Stage { model, ground: &ground, driven, base, per_second, creep };
        let start = Start {
            twist: guess,
            belt_speed: before.belt_speed,
            traction: before.traction,
            inverse: before.inverse,
        };
        let Balanced { motion, traction, inverse } = stage.solve(&start)?;
        let lifts = self.model.lifts(&ground, &motion);
        let tips = lifts && self.may_pull && self.model.tips(&ground, &motion);
        let Motion { twist, belt_speed, .. } = motion;
        Some(State { twist, driven, belt_speed, traction, lifts, tips, inverse, ..*before })
    }

    /// Whether the forces beside friction depend on the acceleration: else the robot is at its
    /// stationary motion at once.
    pub fn feels_inertia(model: &Model) -> bool {
        let still = Twist::zero();
        let force = |acceleration: Twist| {
            let motion = Motion::departing(PerSide::default(), still, acceleration, model.extent());
            model.balance(&model.ground(&Circumstance::default()), &motion).load
        };
        force(Twist { v_x: 1.0, v_y: 1.0, w: 1.0 }) != force(still)
    }
}

impl Plant for Transient<'_> {
    fn moment(&self) -> Moment {
        let State { t, pose, twist, belt_speed, .. } = self.state;
        Moment { t, pose, twist: ros_twist_from_paper(&twist), belt_speed }
    }

    fn drive(
        &mut self,
        speeds: PerSide<f64>,
        until: f64,
        trajectory: &mut Trajectory,
    ) -> Result<(), Stopped> {
        let start = self.state.t;
        let interval = until - start;
        let steps = (interval / self.longest_step - 1e-9).ceil().max(1.0);
        let mut count = 0.0;
        while count < steps {
            count += 1.0;
            let end = if count < steps { start + interval * count / steps } else { until };
            self.step(speeds, end, 0)?;
            trajectory.push(self.moment());
            if self.state.tips {
                return Err(Stopped { t: end, reason: "the robot tips over".to_owned() });
            }
            if self.state.lifts && !self.may_pull {
                let reason =
                    "part of the contact lifts off the ground, for the load shifts too far; \
                              gentler changes of speed, or a lower centre of gravity, keep it down"
                        .to_owned();
                return Err(Stopped { t: end, reason });
            }
        }
        Ok(())
    }
}
