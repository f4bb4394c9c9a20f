//! Transient motion: simulation over time.
//!
//! # Law
//! All forces on the body balance at every moment, eqs (14)-(15). With the effects `yaw-inertia`
//! and `centripetal` they include inertia and are Newton's second law. Without, the motion is
//! always the stationary one.
//!
//! # Tipping
//! A simulation stops where the load lies outside the contact for 0.3 s. Until then one side
//! bears all of it, and the other none.
//!
//! # Stick and slip
//! Coulomb friction is undefined where a whole track sticks. Only there it is regularised: the
//! friction wrench of a side is multiplied by σ/√(σ² + ε²), with σ the root mean square of its slip
//! velocity. As a fraction of a wrench that opposes the slip, it never adds energy. With the
//! default ε = [`STICKING_SLIP_VELOCITY`], friction of a track that slips at 1 cm/s is exact to
//! 5·10⁻⁹, and a parked robot creeps less than 0.1 mm a minute at up to 80 % of the friction limit.
//!
//! # Method
//! Two-stage singly diagonally implicit Runge-Kutta method of order 2 (Alexander 1977), which is
//! L-stable. Each stage is a balance of forces with the acceleration (u − u_b)/(γ h): the
//! stationary equations with inertia, solved by Broyden's method from the last balance, or else by
//! Newton's method with exact derivatives. Where belts slip on their sprockets, the traction of
//! both sides is solved with the twist: near straight driving friction reverses within a small
//! slip, and belt speeds by an earlier traction would oscillate.
//!
//! # Sources
//! Alexander, SIAM Journal on Numerical Analysis 14(6), 1977.

mod stage;
mod tangent;

pub(crate) use stage::gripping;
pub use tangent::tangents;

use crate::newton::Tolerance;
use crate::{Circumstance, Model, Motion, Solution, Stationary, Status, Support};
use stage::{Balanced, Known, Stage, Start, TOLERANCE};
use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{Moment, PerSide, Plant, Pose, Stopped, Trajectory, Twist};

/// Slip velocity ε below which a track sticks, m/s.
pub const STICKING_SLIP_VELOCITY: f64 = 1e-6;

/// Coefficient γ = 1 − 1/√2 of the method, whose second stage is the end of the step.
pub const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Share of the step at which the error would be the tolerance that the next one takes.
const SAFETY: f64 = 0.8;

/// Largest growth from one step to the next, and largest loss at a try.
const GROWTH: [f64; 2] = [0.3, 4.0];

/// Time for which the load may lie outside the contact, s: a body a metre high falls as an inverted
/// pendulum does, with √(h/g) = 0.3 s. A jolt of the track speeds lifts a side for less.
const FALL_TIME: f64 = 0.3;

/// Why a simulation stops then.
const TIPPING_MESSAGE: &str = "the robot tips over: gentler changes of speed, or a lower centre \
                               of gravity, keep it on the ground";

/// Largest number of halvings of a step for convergence.
const MAX_HALVINGS: u32 = 10;

/// Base of the acceleration in the second stage of a step, from the twists at its start and in its
/// first stage.
#[inline]
pub fn base_of_second(start: Twist, first: Twist) -> Twist {
    // u_b = u_n + (1 − γ)/γ (u₁ − u_n)
    start + (first - start) * ((1.0 - GAMMA) / GAMMA)
}

/// Twist by which the body moves over a step, from those in its stages.
#[inline]
pub fn mean_of_stages([first, second]: [Twist; 2]) -> Twist {
    // (1 − γ) u₁ + γ u₂
    first * (1.0 - GAMMA) + second * GAMMA
}

/// A step of the simulation.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// End time, s.
    pub end: f64,
    /// Duration h, s.
    pub duration: f64,
    /// Its stages; the second one is its end. The body moves by their [`mean_of_stages`].
    pub stages: [Instant; 2],
}

/// A motion in which all forces balance.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// Sprocket speeds, m/s.
    pub driven: PerSide<f64>,
    /// Belt speeds, m/s.
    pub belt_speed: PerSide<f64>,
    /// Twist, paper's frame.
    pub twist: Twist,
    /// Rate of the twist in the method: (u − u_b)/(γ h).
    pub rate: Twist,
}

/// Simulation of a robot over time.
#[derive(Clone, Debug)]
pub struct Transient<'m> {
    model: &'m Model,
    longest_step: f64,
    /// Error by which steps are chosen; none for even steps.
    accuracy: Option<Accuracy>,
    /// Slip velocity below which a track sticks, m/s.
    creep: f64,
    /// Residual over the weight that counts as balance.
    tolerance: Tolerance,
    /// Whether forces depend on acceleration. Without inertia the twist jumps, and its rate is
    /// meaningless.
    has_inertia: bool,
    /// Recorded steps; none unless requested.
    steps: Option<Vec<Step>>,
    state: State,
}

/// Steps by their error.
#[derive(Clone, Copy, Debug)]
struct Accuracy {
    /// Estimated error of the twist above which a step is shortened, m/s.
    tolerance: f64,
    /// Shortest step, whatever its error, s.
    shortest: f64,
    /// Step with which an interval of equal encoder speeds is begun, s.
    first: f64,
}

impl Accuracy {
    /// The step after one of this length with this error, or in its place. The error grows with
    /// the square of the step.
    fn next(&self, step: f64, error: f64) -> f64 {
        let [least, most] = GROWTH;
        let factor = SAFETY * (self.tolerance / error).sqrt();
        (step * factor.clamp(least, most)).max(self.shortest)
    }
}

/// State at the start of a step.
#[derive(Clone, Copy, Debug)]
struct State {
    t: f64,
    pose: Pose,
    /// Twist, paper's frame.
    twist: Twist,
    /// Sprocket speeds, after gain and lag, m/s.
    driven: PerSide<f64>,
    /// Belt speeds, m/s.
    belt_speed: PerSide<f64>,
    /// Traction over normal load, forward positive, where belts slip on their sprockets; else zero.
    traction: PerSide<f64>,
    /// Time for which the resultant load has lain outside the contact, s; zero where it does not.
    tipping: f64,
    /// What is known of the Jacobian of the last balance.
    known: Known,
}

impl<'m> Transient<'m> {
    /// Default of the longest step, s. Its accuracy is measured in docs/theory/transient.md.
    pub const STEP: f64 = 0.01;

    /// A robot at rest at a pose (REP-103) and time.
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
            tipping: 0.0,
            known: Known::default(),
        };
        Self {
            model,
            longest_step: Self::STEP,
            accuracy: None,
            creep: STICKING_SLIP_VELOCITY,
            tolerance: TOLERANCE.at(model.resolution()),
            has_inertia: Self::feels_inertia(model),
            steps: None,
            state,
        }
    }

    /// Sets the longest step, s.
    pub fn with_step(self, longest_step: f64) -> Self {
        Self { longest_step, ..self }
    }

    /// Lets steps be as long as an estimated error of the twist (m/s) allows, up to the longest and
    /// at least `shortest`, s; the yaw rate counts as a track speed. Without, steps are even.
    pub fn with_tolerance(self, tolerance: f64, shortest: f64) -> Self {
        Self { accuracy: Some(Accuracy { tolerance, shortest, first: shortest }), ..self }
    }

    /// Sets the slip velocity below which a track sticks (default [`STICKING_SLIP_VELOCITY`]), m/s;
    /// a larger one is faster.
    pub fn with_creep(self, creep: f64) -> Self {
        Self { creep, ..self }
    }

    /// Sets a residual over the weight that counts as balance, which is faster; by default none
    /// beyond rounding does.
    pub fn with_balance(self, balance: f64) -> Self {
        Self { tolerance: self.tolerance.at_least(balance), ..self }
    }

    /// Records the steps.
    pub fn with_steps(self) -> Self {
        Self { steps: Some(Vec::new()), ..self }
    }

    /// The recorded steps.
    pub fn into_steps(self) -> Vec<Step> {
        self.steps.unwrap_or_default()
    }

    /// Sets the twist (paper's frame).
    pub fn with_twist(mut self, twist: Twist) -> Self {
        self.state.twist = twist;
        self
    }

    /// Starts in the stationary motion at these encoder speeds (m/s) instead of at rest, with belts
    /// that have caught up; at rest where no motion is stationary.
    pub fn moving_at(mut self, shown: PerSide<f64>) -> Self {
        let State { t, pose, .. } = self.state;
        let circumstance = Circumstance { position: [pose.x, pose.y], heading: pose.yaw, time: t };
        let Solution { status, twist, belt_speed, .. } =
            Stationary::new(self.model, &circumstance).solve(shown);
        if !matches!(status, Status::NotConverged | Status::Tips) {
            let driven = self.model.drive().driven(shown, t);
            self.state = State { twist, driven, belt_speed, ..self.state };
        }
        self
    }

    /// One step to time `end` at the encoder speeds `shown`, halved if it does not converge.
    fn step(&mut self, shown: PerSide<f64>, end: f64, halvings: u32) -> Result<(), Stopped> {
        if let Some((state, stages, _)) = self.advanced(shown, end) {
            self.accept(&state, stages);
            return Ok(());
        }
        if halvings == MAX_HALVINGS {
            let unbalanced = "no motion balances the forces on the robot";
            let tips = self.state.tipping > 0.0;
            return Err(self.stopped(if tips { TIPPING_MESSAGE } else { unbalanced }));
        }
        self.step(shown, f64::midpoint(self.state.t, end), halvings + 1)?;
        self.step(shown, end, halvings + 1)
    }

    /// One step towards time `until`, as long as its error allows and `step` at most, s; returns
    /// what the next one may be.
    fn step_within(
        &mut self,
        accuracy: Accuracy,
        shown: PerSide<f64>,
        until: f64,
        mut step: f64,
    ) -> Result<f64, Stopped> {
        loop {
            let start = self.state.t;
            // Asked before the end is rounded, which may make a step longer.
            let is_shortest = step <= accuracy.shortest;
            // The rest in one step, or in two equal ones rather than a long and a short one.
            let left = until - start;
            let end = match left / step {
                whole if whole < 1.0 + 1e-9 => until,
                halves if halves < 2.0 => start + left / 2.0,
                _ => start + step,
            };
            step = end - start;
            match self.advanced(shown, end) {
                Some((state, stages, error)) => {
                    let next = accuracy.next(step, error);
                    if error <= accuracy.tolerance || is_shortest {
                        self.accept(&state, stages);
                        return Ok(next);
                    }
                    step = next;
                }
                None if is_shortest => {
                    self.step(shown, end, 0)?;
                    return Ok(accuracy.shortest);
                }
                None => step = (step / 2.0).max(accuracy.shortest),
            }
        }
    }

    fn stopped(&self, reason: &str) -> Stopped {
        Stopped { t: self.state.t, reason: reason.to_owned() }
    }

    /// Records where a step led.
    fn arrived(&self, trajectory: &mut Trajectory) -> Result<(), Stopped> {
        trajectory.push(self.moment());
        if self.state.tipping > FALL_TIME {
            return Err(self.stopped(TIPPING_MESSAGE));
        }
        Ok(())
    }

    /// Goes on to the end of a step with these stages.
    fn accept(&mut self, state: &State, stages: [Instant; 2]) {
        let duration = state.t - self.state.t;
        self.state = *state;
        if let Some(steps) = &mut self.steps {
            steps.push(Step { end: state.t, duration, stages });
        }
    }

    /// State at the end of a step, its stages, and the estimated error of its twist, m/s; none
    /// without convergence.
    fn advanced(&self, shown: PerSide<f64>, end: f64) -> Option<(State, [Instant; 2], f64)> {
        let start = self.state;
        let h = end - start.t;
        // Stage 1 at t + γ h from u, stage 2 at t + h from u + (1 − γ) h u̇₁.
        let first = self.stage(&start, shown, GAMMA * h, GAMMA * h, start.twist, start.twist)?;
        let base = base_of_second(start.twist, first.twist);
        let second = self.stage(&first, shown, h, GAMMA * h, base, first.twist)?;
        let twist = mean_of_stages([first.twist, second.twist]);
        let pose = start.pose.compose(&Pose::exp(&ros_twist_from_paper(&twist), h));
        // Error estimate: difference from the method of order 1, u + h u̇₁.
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
            let State { driven, belt_speed, twist, .. } = *state;
            Instant { driven, belt_speed, twist, rate }
        };
        let stages = [instant(&first, &start.twist), instant(&second, &base)];
        Some((State { t: end, pose, ..second }, stages, error))
    }

    /// Solves the balance `after` seconds from the start of the step, with the acceleration (u −
    /// `base`)/`duration`; `guess` is the start.
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
        let target = drive.driven(shown, self.state.t + after);
        let driven = PerSide::from_fn(|side| {
            let lag = drive.time_constant[side];
            // T dV/dt = V_e − V at constant V_e
            let remaining = if lag > 0.0 { (-after / lag).exp() } else { 0.0 };
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
        let Self { model, creep, tolerance, .. } = *self;
        let stage = Stage { model, ground: &ground, driven, base, per_second, creep };
        let start = Start {
            twist: guess,
            belt_speed: before.belt_speed,
            traction: before.traction,
            known: before.known,
            tolerance,
        };
        let Balanced { motion, traction, known } = stage.solve(&start)?;
        let tips = self.model.support(&ground, &motion) == Support::Tips;
        let tipping = if tips { self.state.tipping + after } else { 0.0 };
        let Motion { twist, belt_speed, .. } = motion;
        Some(State { twist, driven, belt_speed, traction, tipping, known, ..*before })
    }

    /// Whether forces other than friction depend on acceleration; otherwise the motion is always
    /// the stationary one.
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
        if let Some(accuracy) = self.accuracy {
            let mut step = accuracy.first.min(self.longest_step);
            let mut first = None;
            while self.state.t < until {
                step = self.step_within(accuracy, speeds, until, step)?.min(self.longest_step);
                first.get_or_insert(step);
                self.arrived(trajectory)?;
            }
            // Encoder speeds jump from reading to reading alike.
            self.accuracy = Some(Accuracy { first: first.unwrap_or(step), ..accuracy });
            return Ok(());
        }
        let start = self.state.t;
        let interval = until - start;
        let steps = (interval / self.longest_step - 1e-9).ceil().max(1.0);
        let mut count = 0.0;
        while count < steps {
            count += 1.0;
            let end = if count < steps { start + interval * count / steps } else { until };
            self.step(speeds, end, 0)?;
            self.arrived(trajectory)?;
        }
        Ok(())
    }
}
