//! Stationary motion at a pair of track speeds.
//!
//! # Law
//! The twist at which all forces on the body balance, eqs (14)-(15).
//!
//! # Unknowns
//! The ICR (x, y) of one track, the *anchor*, and the turn t = w/(V_r − V_l) = 1/(x_r − x_l). All
//! three stay finite for small speed differences, where the twist degenerates, and for t → 0, where
//! the other track's ICR goes to infinity.
//!
//! # When a robot does not turn
//! A track with much more load than the other can hold the robot: it sticks, the robot drives
//! straight at its speed, and the other track slips. The sticking track has no slip direction, so
//! the balance has no solution with t > 0. The residual is continued to t < 0 by multiplying the
//! force of the slipping track and all forces besides friction by 1 − L t. A root there means that
//! the anchor would break loose only under that multiple of the forces: it holds. One Newton
//! iteration thus decides between turning and holding.

mod solution;

pub use solution::{Solution, Status};

use crate::icr::Icrs;
use crate::newton::{self, Convergence, Evaluation, Tolerance};
use crate::{Balance, Circumstance, Ground, Model, Motion, Support};
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{Dual, PerSide, Scalar, Side, Twist};

/// Speed of the spin that represents the limit of slow driving, m/s.
const SPIN_SPEED: f64 = 1e-6;

/// Tolerance of the residual over the weight; and, for belts that slip, of the change of belt
/// speeds over the faster one.
const TOLERANCE: Tolerance = Tolerance { converged: 1e-13, rounding: 1e-11, is_trusting: false };

/// Largest number of iterations between belt speeds and traction.
const MAX_ALTERNATIONS: usize = 100;

/// A similar motion: start of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Near {
    /// A turning motion with these ICRs.
    Turning(Icrs),
    /// The track of this side holds the robot.
    Held(Side),
    /// A motion of a similar model.
    Linearised(Linearised),
}

/// A motion with its inverse Jacobian, so that Broyden's method can start there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearised {
    anchor: Side,
    /// The unknowns.
    point: Vector3<f64>,
    /// Inverse of the Jacobian of the residual.
    inverse: Matrix3<f64>,
}

/// ICRs of both tracks from that of the anchor and the turn; none without a turn.
fn icrs(anchor: Side, unknowns: &Vector3<f64>) -> Option<Icrs> {
    let [x, y, turn] = [unknowns[0], unknowns[1], unknowns[2]];
    let other = x - anchor.sign() / turn;
    (turn > 0.0).then_some(match anchor {
        Side::Left => Icrs { x_left: x, x_right: other, y },
        Side::Right => Icrs { x_left: other, x_right: x, y },
    })
}

/// Solver for the stationary motions of a model at one place, heading and time.
#[derive(Clone, Debug)]
pub struct Stationary<'m> {
    model: &'m Model,
    ground: Ground,
    /// Unit of force and moment in the residual, N and N·m.
    scale: [f64; 2],
    /// First start of each solve.
    near: Option<Near>,
}

impl<'m> Stationary<'m> {
    /// A solver for a model.
    ///
    /// It solves one slow spin: without effects all motions share its ICRs (the constancy theorem),
    /// and with effects it is a good start.
    pub fn new(model: &'m Model, circumstance: &Circumstance) -> Self {
        let mut solver = Self::from_start(model, circumstance, None);
        let spin = solver.solve_belts(PerSide::new(-SPIN_SPEED, SPIN_SPEED));
        solver.near = spin.near();
        solver
    }

    /// A solver that starts from this motion instead of the slow spin.
    pub fn from_start(model: &'m Model, circumstance: &Circumstance, near: Option<Near>) -> Self {
        let weight = model.vehicle().weight();
        let scale = [weight, weight * model.vehicle().gauge];
        Self { model, ground: model.ground(circumstance), scale, near }
    }

    /// The solver with this motion as first start; unchanged for none.
    pub fn starting_at(&self, near: Option<Near>) -> Self {
        Self { near: near.or(self.near), ..self.clone() }
    }

    /// Stationary motion at these encoder speeds, m/s.
    ///
    /// Each pair of speeds is solved independently, so the order does not matter. Check the status
    /// of the result first.
    ///
    /// Where belts slip on their sprockets, speeds and traction are iterated in turn: Coulomb
    /// friction depends on ratios of speeds only, so traction hardly changes.
    pub fn solve(&self, track_speed: PerSide<f64>) -> Solution {
        let driven = self.model.drive().driven(track_speed, self.ground.circumstance.time);
        let mut solution = self.solve_belts(driven);
        if self.model.drive().slip_per_traction != 0.0 {
            solution = self.slipping(driven, solution);
            solution.icrs = solution.icrs.and_then(|_| Icrs::of_motion(driven, &solution.twist));
        }
        Solution { track_speed, ..solution }
    }

    /// Motion of belts that slip on sprockets with these speeds (m/s), starting from the motion
    /// without slip.
    fn slipping(&self, driven: PerSide<f64>, firm: Solution) -> Solution {
        let settled = TOLERANCE.at(self.model.resolution()).converged;
        let tolerance = settled * driven.left.abs().max(driven.right.abs());
        let mut solution = firm;
        let (mut share, mut last) = (1.0, PerSide::new(0.0, 0.0));
        let mut may_be_straight = true;
        for _ in 0..MAX_ALTERNATIONS {
            let Some(traction) = self.traction(&solution) else { break };
            let belts = solution.belt_speed;
            let next = self.model.drive().belt_speed(driven, traction);
            let step = PerSide::from_fn(|side| next[side] - belts[side]);
            let change = step.left.abs().max(step.right.abs());
            if change <= tolerance {
                return solution;
            }
            // Before belts stick in straight driving, traction reverses the turn.
            if may_be_straight && difference(&next) * difference(&belts) <= 0.0 {
                if let Some(straight) = self.straight(driven) {
                    return straight;
                }
                may_be_straight = false;
            }
            // An oscillating iteration takes half steps.
            if step.left * last.left + step.right * last.right < 0.0 {
                share *= 0.5;
            }
            last = step;
            let belts = PerSide::from_fn(|side| belts[side] + share * step[side]);
            solution = self.starting_at(solution.near()).solve_belts(belts);
        }
        Solution { status: Status::NotConverged, ..solution }
    }

    /// Straight motion behind sprockets with these speeds (m/s), where slip takes up their
    /// difference; none where it does not.
    ///
    /// # Law
    /// Both tracks stick: κ T/N = (V_d − V)/|V_d| with one V on both sides, and T_l + T_r + F = 0,
    /// with F the load along the tracks. They hold where friction in a vanishing turn to either
    /// side would turn the robot back.
    fn straight(&self, driven: PerSide<f64>) -> Option<Solution> {
        if driven.left == 0.0 || driven.right == 0.0 {
            return None; // a standing belt cannot slip on its sprocket
        }
        let slip = self.model.drive().slip_per_traction;
        let rolling = PerSide::from_fn(|_| f64::midpoint(driven.left, driven.right));
        let rolling = Motion::anchored(rolling, Side::Left, [0.0, 0.0], 0.0);
        let Balance { load, normal_load, .. } = self.model.balance(&self.ground, &rolling);
        let weight = PerSide::from_fn(|side| normal_load[side] / driven[side].abs());
        let sum = weight.left * driven.left + weight.right * driven.right;
        // V = (Σ N V_d/|V_d| + κ F)/Σ N/|V_d|
        let speed = (sum + slip * load.force_y) / (weight.left + weight.right);
        let departing = |difference: f64| {
            let belts = PerSide::new(speed - difference / 2.0, speed + difference / 2.0);
            self.solve_belts(belts)
        };
        let left = departing(SPIN_SPEED * speed.abs());
        let right = departing(-SPIN_SPEED * speed.abs());
        let turns = |solution| {
            Some(difference(&self.model.drive().belt_speed(driven, self.traction(solution)?)))
        };
        let holds = turns(&left)? <= 0.0 && turns(&right)? >= 0.0;
        let tips = [&left, &right].iter().any(|end| end.status == Status::Tips);
        holds.then(|| Solution {
            status: if tips { Status::Tips } else { Status::Straight },
            is_lifted: left.is_lifted || right.is_lifted,
            belt_speed: PerSide::new(speed, speed),
            twist: Twist { v_x: 0.0, v_y: speed, w: 0.0 },
            icrs: None,
            residual: left.residual.max(right.residual),
            ..left
        })
    }

    /// Traction of each side over its normal load, forward positive; none without a motion.
    fn traction(&self, solution: &Solution) -> Option<PerSide<f64>> {
        let anchor = match solution.status {
            Status::NotConverged => return None,
            Status::Holds(side) => side,
            Status::Turning | Status::Straight | Status::Tips => Side::Left,
        };
        let motion = match solution.icrs {
            Some(Icrs { x_left, x_right, y }) => {
                let turn = 1.0 / (x_right - x_left);
                Motion::anchored(solution.belt_speed, Side::Left, [x_left, y], turn)
            }
            None => Motion::anchored(solution.belt_speed, anchor, [0.0, 0.0], 0.0),
        };
        let balance = self.model.balance(&self.ground, &motion);
        let mut traction = balance.friction.map(|wrench| wrench.force_y);
        if let Status::Holds(side) = solution.status {
            // The holding track balances all other forces.
            let held = -balance.load.force_y - traction[side.other()];
            traction = match side {
                Side::Left => PerSide::new(held, traction.right),
                Side::Right => PerSide::new(traction.left, held),
            };
        }
        Some(PerSide::from_fn(|side| traction[side] / balance.normal_load[side]))
    }

    /// Stationary motion at these belt speeds, m/s.
    ///
    /// # Panics
    /// Never: at least four starts are tried.
    fn solve_belts(&self, belt_speed: PerSide<f64>) -> Solution {
        let first = match self.near {
            Some(Near::Held(side)) => side,
            Some(Near::Linearised(known)) => {
                let problem = Problem { solver: self, belt_speed, anchor: known.anchor };
                if let Some(end) = problem.solve_beside(&known) {
                    return end.solution();
                }
                known.anchor
            }
            _ => self.better_anchor(),
        };
        let problems =
            [first, first.other()].map(|anchor| Problem { solver: self, belt_speed, anchor });
        let ends =
            problems.iter().flat_map(|problem| problem.starts().map(|start| problem.solve(start)));
        newton::first_root(ends, |end| &end.convergence)
            .expect("several starts were tried")
            .solution()
    }

    /// The side with more grip, which is more likely to hold.
    fn better_anchor(&self) -> Side {
        let vehicle = self.model.vehicle();
        let grip = |side: Side| {
            let share = 0.5 + side.sign() * vehicle.cog[0] / vehicle.gauge;
            share * self.ground.friction[side].along
        };
        if grip(Side::Right) > grip(Side::Left) { Side::Right } else { Side::Left }
    }
}

/// Speed of the right minus that of the left belt, m/s.
fn difference(belt_speed: &PerSide<f64>) -> f64 {
    belt_speed.right - belt_speed.left
}

/// A pair of speeds, anchored at one track.
#[derive(Clone, Copy)]
struct Problem<'s> {
    solver: &'s Stationary<'s>,
    belt_speed: PerSide<f64>,
    anchor: Side,
}

/// Result of Newton's iteration.
struct Root<'s> {
    problem: Problem<'s>,
    convergence: Convergence<3>,
}

impl<'s> Problem<'s> {
    /// Starts, most promising first.
    fn starts(&self) -> impl Iterator<Item = Vector3<f64>> {
        let model = self.solver.model;
        let (gauge, cog_y) = (model.vehicle().gauge, model.vehicle().cog[1]);
        let outwards = self.anchor.sign();
        // Both tracks turn about points a quarter of the contact length outside their centre-lines.
        let pressed = model.pressed(cog_y);
        let [rear, front] = pressed.ends;
        let x = gauge / 2.0 + (front - rear) / 4.0;
        let turning = Vector3::new(outwards * x, cog_y, 0.5 / x);
        // The anchor breaks loose under twice the other track's friction, with the gauge as lever.
        let x = gauge / 2.0 + pressed.gyration_squared / gauge;
        let holding = Vector3::new(outwards * x, cog_y, -1.0 / gauge);
        let from = |icrs: Icrs| {
            let x = match self.anchor {
                Side::Left => icrs.x_left,
                Side::Right => icrs.x_right,
            };
            Vector3::new(x, icrs.y, 1.0 / (icrs.x_right - icrs.x_left))
        };
        let near = self.solver.near.map(|near| match near {
            Near::Turning(icrs) => from(icrs),
            Near::Held(_) => holding,
            Near::Linearised(known) => icrs(known.anchor, &known.point).map_or(holding, from),
        });
        near.into_iter().chain([turning, holding])
    }

    fn solve(self, start: Vector3<f64>) -> Root<'s> {
        let model = self.solver.model;
        let [rear, front] = model.footprint().ends;
        let half_size = model.vehicle().gauge.hypot(front - rear) / 2.0;
        let convergence = newton::solve(
            start,
            half_size,
            TOLERANCE.at(model.resolution()),
            |z| Evaluation::of_dual(self.residual(Dual::variables(z.into()))),
            |z| Vector3::from(self.residual([z[0], z[1], z[2]])),
        );
        Root { problem: self, convergence }
    }

    /// Broyden's method from a known root of this anchor; none where it does not converge.
    fn solve_beside(self, known: &Linearised) -> Option<Root<'s>> {
        let residual = |z: Vector3<f64>| Vector3::from(self.residual([z[0], z[1], z[2]]));
        let tolerance = TOLERANCE.at(self.solver.model.resolution());
        let start = (known.point, residual(known.point));
        let convergence = newton::from_near(start, known.inverse, tolerance, residual)?;
        Some(Root { problem: self, convergence })
    }

    fn motion<S: Scalar>(&self, [x, y, turn]: [S; 3]) -> Motion<S> {
        let turn = if turn.value() > 0.0 { turn } else { S::from(0.0) };
        Motion::anchored(self.belt_speed, self.anchor, [x, y], turn)
    }

    /// Residual: force over weight, and moment over weight times gauge.
    #[inline]
    fn residual<S: Scalar>(&self, z: [S; 3]) -> [S; 3] {
        let balance = self.solver.model.balance(&self.solver.ground, &self.motion(z));
        // Load on the holding track: if it bears a multiple above one, it bears the load itself.
        let mut borne = balance.load;
        borne += balance.friction[self.anchor.other()];
        if z[2].value() <= 0.0 {
            let excess = -z[2] * self.solver.model.vehicle().gauge + 1.0;
            borne = borne.scaled(excess);
        }
        let mut sum = balance.friction[self.anchor];
        sum += borne;
        let [force, moment] = self.solver.scale;
        [sum.force_x * force.recip(), sum.force_y * force.recip(), sum.moment * moment.recip()]
    }
}

impl Root<'_> {
    fn solution(&self) -> Solution {
        let Problem { solver, belt_speed, anchor, .. } = self.problem;
        let z = self.convergence.point;
        let motion = self.problem.motion([z[0], z[1], z[2]]);
        let turn = z[2];
        let support = solver.model.support(&solver.ground, &motion);
        let status = if !self.convergence.is_root {
            Status::NotConverged
        } else if support == Support::Tips {
            Status::Tips
        } else if belt_speed.left == belt_speed.right {
            Status::Straight
        } else if turn <= 0.0 {
            Status::Holds(anchor)
        } else {
            Status::Turning
        };
        // A held robot, or one with equal track speeds, moves straight.
        let twist = if turn <= 0.0 || belt_speed.left == belt_speed.right {
            Twist { v_x: 0.0, v_y: belt_speed[anchor], w: 0.0 }
        } else {
            motion.twist
        };
        let inverse = self.convergence.inverse.filter(|_| self.convergence.is_root);
        Solution {
            status,
            track_speed: belt_speed,
            belt_speed,
            twist,
            icrs: icrs(anchor, &z),
            residual: self.convergence.residual,
            is_lifted: support == Support::Part,
            iterations: self.convergence.iterations,
            linearised: inverse.map(|inverse| Linearised { anchor, point: z, inverse }),
        }
    }
}
