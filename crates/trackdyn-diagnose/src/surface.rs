//! Table of the stationary motion over both belt speeds.
//!
//! Shear-stress laws need a quadrature per solve, and a recording has tens of thousands of
//! readings.
//!
//! The table holds the twist minus the mean belt speed, divided by the difference of the belt
//! speeds: this stays finite where one track holds the robot and the other ICR is at infinity.
//! Where friction depends on slip speed, it holds the change of that by the laws of the shear
//! stress, beside a table of the motion without them. With belts that slip on their sprockets, a
//! load along the tracks costs speed even without a difference: then it is divided by the norm of
//! the speeds.

mod table;

use nalgebra::Vector3;
use std::sync::Arc;
use table::{Grid, Table};
use trackdyn_core::{PerSide, Side, Twist, real};
use trackdyn_model::contact::Resolution;
use trackdyn_model::custom::together;
use trackdyn_model::sectors::Spacing;
use trackdyn_model::{Circumstance, Effects, Model, Vehicle};
use trackdyn_model::{Icrs, Near, Stationary, Status};

/// A table of stationary motions.
#[derive(Clone, Debug)]
pub struct Surface(Arc<Tabulated>);

/// What a table holds.
#[derive(Debug)]
struct Tabulated {
    robot: Robot,
    /// (v_x, v_y − V̄, w) divided by the scale; with `plain`, what is added to that.
    beyond: Table,
    /// The motion without laws of the shear stress, on nodes of its own.
    plain: Option<Plain>,
    scale: Scale,
    /// Start of the solve at each node, for a similar model.
    starts: Vec<Option<Near>>,
    unsolved: usize,
}

/// What a table is of.
#[derive(Debug, PartialEq)]
struct Robot {
    vehicle: Vehicle,
    effects: Effects,
    resolution: Resolution,
    largest: f64,
    range: f64,
}

/// A motion to which a table adds the change by laws of the shear stress: its error is a share of
/// that change, and none where the laws have no size.
#[derive(Debug)]
struct Plain {
    surface: Surface,
    /// Its twist, divided by the scale, at the nodes of the changes.
    nodes: Arc<Vec<Option<Vector3<f64>>>>,
}

/// Divisor of the tabulated twist.
#[derive(Clone, Copy, Debug)]
enum Scale {
    /// V_r − V_l.
    Difference,
    /// √(V_l² + V_r²).
    Size,
}

impl Scale {
    fn of(self, speeds: PerSide<f64>) -> f64 {
        match self {
            Self::Difference => speeds.right - speeds.left,
            Self::Size => speeds.left.hypot(speeds.right),
        }
    }
}

impl Surface {
    /// Tabulates the stationary motions of a model with unit gain, up to belt speeds of norm
    /// `largest`, m/s.
    ///
    /// Where friction depends on slip speed, nodes are even in the logarithm of the speed over the
    /// ratio `range`. `before` is the table of a similar model, from which solves start; that of
    /// this very model is taken as it is.
    pub fn new(model: &Model, largest: f64, range: f64, before: Option<&Self>) -> Self {
        let robot = Robot::new(model, largest, range);
        let mut known = [before, before.and_then(Self::plain)].into_iter().flatten();
        if let Some(known) = known.find(|known| known.0.robot == robot) {
            return known.clone();
        }
        let spacing = Spacing::of(model, range);
        let grid = Grid::new(largest, spacing);
        let slips = model.drive().slip_per_traction != 0.0;
        let scale = if slips { Scale::Size } else { Scale::Difference };
        let plain = spacing.range().map(|_| Plain::of(model, &robot, (&grid, scale), before));
        let tabulated = Solved::of(model, (&grid, scale), before);
        let added = |(index, node): (usize, &Option<Vector3<f64>>)| match &plain {
            Some(plain) => Some((*node)? - plain.nodes[index]?),
            None => *node,
        };
        let values: Vec<_> = tabulated.nodes.iter().enumerate().map(added).collect();
        let unsolved = values.iter().filter(|node| node.is_none()).count();
        let beyond = Table::new(grid, &values);
        let starts = tabulated.starts;
        Self(Arc::new(Tabulated { robot, beyond, plain, scale, starts, unsolved }))
    }

    /// The table of the same robot without laws of the shear stress, if this one is beside it.
    fn plain(&self) -> Option<&Self> {
        self.0.plain.as_ref().map(|plain| &plain.surface)
    }

    /// Whether both are one table.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// Start of the solve at a node of a grid.
    fn near(&self, index: usize, grid: &Grid) -> Option<Near> {
        let known = self.0.starts[index].filter(|_| self.0.beyond.grid() == grid);
        known.or_else(|| self.motion(grid.speeds(index)).near())
    }

    /// Share of the nodes without a motion: the robot tips over, or the solve failed.
    pub fn unsolved(&self) -> f64 {
        real(self.0.unsolved) / real(Grid::NODES)
    }

    /// Stationary motion (paper's frame) at these belt speeds.
    pub fn motion(&self, speeds: PerSide<f64>) -> Steady {
        let (difference, mean) =
            (speeds.right - speeds.left, f64::midpoint(speeds.left, speeds.right));
        if let Scale::Difference = self.0.scale {
            let is_straight = difference == 0.0;
            let beyond = if is_straight { Vector3::zeros() } else { self.beyond(speeds) };
            return Steady { mean, difference, beyond };
        }
        let beyond = self.beyond(speeds) * self.0.scale.of(speeds);
        if difference == 0.0 {
            return Steady { mean: mean + beyond[1], difference, beyond: Vector3::zeros() };
        }
        Steady { mean, difference, beyond: beyond / difference }
    }

    /// (v_x, v_y − V̄, w) divided by the scale.
    fn beyond(&self, speeds: PerSide<f64>) -> Vector3<f64> {
        let own = self.0.beyond.at(speeds);
        self.plain().map_or(own, |plain| plain.beyond(speeds) + own)
    }
}

impl Robot {
    fn new(model: &Model, largest: f64, range: f64) -> Self {
        let (vehicle, effects) = (model.vehicle().clone(), model.effects().clone());
        Self { vehicle, effects, resolution: model.resolution(), largest, range }
    }
}

impl Plain {
    /// The motion of a model without its laws of the shear stress, with its nodes on the grid of
    /// these. `before` is the table of a similar model.
    fn of(model: &Model, robot: &Robot, grid: (&Grid, Scale), before: Option<&Surface>) -> Self {
        let plain = model.without_shear_laws();
        let known = before.and_then(|before| before.0.plain.as_ref());
        let resembling = known.map(|known| &known.surface).or(before);
        let surface = Surface::new(&plain, robot.largest, robot.range, resembling);
        let same = known.filter(|known| known.surface.is(&surface));
        let same = same.filter(|_| before.is_some_and(|before| before.0.beyond.grid() == grid.0));
        let nodes = match same {
            Some(same) => Arc::clone(&same.nodes),
            None => Arc::new(Solved::of(&plain, grid, Some(&surface)).nodes),
        };
        Self { surface, nodes }
    }
}

/// Motions at the nodes of a grid.
struct Solved {
    /// (v_x, v_y − V̄, w) divided by the scale; none where there is no motion.
    nodes: Vec<Option<Vector3<f64>>>,
    /// Start of the solve at each node, for a similar model.
    starts: Vec<Option<Near>>,
}

/// Stride through the nodes that are solved first, as a sample.
const SAMPLE_STRIDE: usize = 8;

/// Largest share of the sample that may have no motion. Above it the other nodes are not tried: a
/// search takes longest where no forces balance.
pub const MAX_UNSOLVED_SAMPLE_SHARE: f64 = 0.5;

impl Solved {
    fn of(model: &Model, (grid, scale): (&Grid, Scale), before: Option<&Surface>) -> Self {
        let solver = Stationary::new(model, &Circumstance::default());
        let solved = |index: usize| {
            let speeds = grid.speeds(index);
            let near = before.and_then(|before| before.near(index, grid));
            let solution = solver.starting_at(near).solve(speeds);
            let usable = !matches!(solution.status, Status::NotConverged | Status::Tips);
            let node = usable.then(|| beyond(speeds, &solution.twist) / scale.of(speeds));
            (node, solution.linearised.map(Near::Linearised))
        };
        let share_calls = model.effects().share_calls();
        let sampled: Vec<usize> = (0..Grid::NODES).step_by(SAMPLE_STRIDE).collect();
        let sample = together(&sampled, share_calls, |index| solved(*index));
        let without = sample.iter().filter(|(node, _)| node.is_none()).count();
        let is_hopeless = real(without) > MAX_UNSOLVED_SAMPLE_SHARE * real(sample.len());
        let node = |&index: &usize| {
            if index.is_multiple_of(SAMPLE_STRIDE) {
                sample[index / SAMPLE_STRIDE]
            } else if is_hopeless {
                (None, None)
            } else {
                solved(index)
            }
        };
        let all: Vec<usize> = (0..Grid::NODES).collect();
        let (nodes, starts) = together(&all, share_calls, node).into_iter().unzip();
        Self { nodes, starts }
    }
}

/// Stationary motion at one pair of belt speeds.
#[derive(Clone, Copy, Debug)]
pub struct Steady {
    /// Mean speed V̄, m/s; for equal belt speeds, the speed of the motion.
    mean: f64,
    difference: f64,
    /// (v_x, v_y − V̄, w)/(V_r − V_l).
    beyond: Vector3<f64>,
}

impl Steady {
    /// Start for a solve of this motion; none for straight driving.
    pub fn near(&self) -> Option<Near> {
        near(&self.beyond).filter(|_| self.difference != 0.0)
    }

    /// Twist (paper's frame), with the ICRs shifted by `offset` (x_l, x_r, y), m.
    pub fn twist(&self, offset: &[f64; 3]) -> Twist {
        let Self { mean, difference, beyond } = *self;
        let [across, along, turn] = moved(beyond, offset);
        Twist { v_x: across * difference, v_y: along * difference + mean, w: turn * difference }
    }
}

/// Twist minus the mean belt speed, (v_x, v_y − V̄, w).
fn beyond(speeds: PerSide<f64>, twist: &Twist) -> Vector3<f64> {
    let mean = f64::midpoint(speeds.left, speeds.right);
    Vector3::new(twist.v_x, twist.v_y - mean, twist.w)
}

/// Start for a solve of a motion with this normalised twist.
fn near(twist: &Vector3<f64>) -> Option<Near> {
    let (middle, half) = (-twist[1] / twist[2], 0.5 / twist[2]);
    let icrs = Icrs { x_left: middle - half, x_right: middle + half, y: twist[0] / twist[2] };
    if half.is_finite() {
        return (half > 0.0).then_some(Near::Turning(icrs));
    }
    // straight at the speed of the left belt, V̄ − (V_r − V_l)/2, or of the right one
    Some(Near::Held(if twist[1] < 0.0 { Side::Left } else { Side::Right }))
}

/// Normalised twist with its ICRs shifted by (x_l, x_r, y), m.
fn moved(twist: Vector3<f64>, [left, right, y]: &[f64; 3]) -> [f64; 3] {
    // t = 1/(x_r − x_l); v_x = t y; v_y − V̄ = −t (x_l + x_r)/2
    let turn = twist[2] / (1.0 + twist[2] * (right - left));
    let shrink = 1.0 / (1.0 + twist[2] * (right - left));
    [shrink * twist[0] + turn * y, shrink * twist[1] - turn * (left + right) / 2.0, turn]
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::contact::Friction;
    use trackdyn_model::{RunningGear, VehicleFile};

    /// Speed ratio of a logarithmic table.
    const RANGE: f64 = 30.0;

    /// Typical effects, by names separated by spaces.
    fn effects(ids: &str) -> Effects {
        ids.split_whitespace().map(|id| id.parse().expect("an effect")).collect()
    }

    /// Effects of every kind that steady motion shows. The rms error of the table must stay below
    /// what laboratory sensors resolve in a hundred segments, 0.5 mm/s at speeds up to 1 m/s. A
    /// slipping belt starts to stick near straight driving: that kink lies inside a sector, and is
    /// smoothed.
    #[test]
    fn the_table_equals_the_solver() {
        const MAX_ERROR: f64 = 5e-4;
        const MAX_ERROR_WITH_KINK: f64 = 2e-3;
        for id in [
            "",
            "centripetal",
            "motion-resistance",
            "viscous-friction",
            "belt-slip",
            "belt-slip motion-resistance",
            "shear-displacement",
            "friction-creep",
            "stribeck-friction",
            "hitch-drag",
            "directional-lugs",
        ] {
            let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects(id));
            let surface = Surface::new(&model, 1.5, RANGE, None);
            assert!(surface.unsolved() < 0.1, "{id}");
            let solver = Stationary::new(&model, &Circumstance::default());
            let (mut squares, mut count) = (0.0, 0.0);
            for k in 0..400_u32 {
                let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
                let left = 2.0 * a.fract() - 1.0;
                // every fifth is straight
                let right = if k % 5 == 0 { left } else { 2.0 * b.fract() - 1.0 };
                let speeds = PerSide::new(left, right);
                let solution = solver.solve(speeds);
                if solution.status == Status::NotConverged {
                    continue;
                }
                let (table, twist) = (surface.motion(speeds).twist(&[0.0; 3]), solution.twist);
                // The yaw rate as a track speed.
                let off = [table.v_x - twist.v_x, table.v_y - twist.v_y, 0.4 * (table.w - twist.w)];
                squares += off.iter().map(|off| off * off).sum::<f64>();
                count += 1.0;
            }
            let error = (squares / count).sqrt();
            let bound =
                if model.drive().slip_per_traction > 0.0 { MAX_ERROR_WITH_KINK } else { MAX_ERROR };
            assert!(count > 350.0 && error < bound, "{id}: {error:.1e} m/s");
        }
    }

    /// A recording of some minutes determines a yaw rate to less than a thousandth: the table must
    /// be far better for inertia that grows with the square of the speed, or its error looks like
    /// an effect.
    #[test]
    fn the_table_of_a_quick_robot_on_wheels_is_finer_than_its_sensors() {
        let mut vehicle = VehicleFile::auriga_alpha().vehicle;
        vehicle.gauge = 0.35;
        vehicle.running_gear =
            RunningGear::Wheels { contact_length: 0.067, width: 0.087, axles: vec![0.182, -0.182] };
        vehicle.friction = Friction { across: 0.53, along: 0.58 };
        for (id, cog) in [("centripetal", [-0.04, -0.003]), ("load-transfer", [-0.005, -0.003])] {
            vehicle.cog = cog;
            let model = Model::new(vehicle.clone(), effects(id));
            let surface = Surface::new(&model, 1.2, RANGE, None);
            let solver = Stationary::new(&model, &Circumstance::default());
            let (mut squares, mut count) = (0.0, 0.0);
            for k in 0..400_u32 {
                let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
                let speeds = PerSide::new(1.8 * a.fract() - 0.9, 1.8 * b.fract() - 0.9);
                let twist = solver.solve(speeds).twist;
                if twist.w.abs() > 0.2 {
                    squares += (surface.motion(speeds).twist(&[0.0; 3]).w / twist.w - 1.0).powi(2);
                    count += 1.0;
                }
            }
            let error = (squares / count).sqrt();
            assert!(count > 300.0 && error < 3e-5, "{id}: {error:.1e}");
        }
    }

    #[test]
    fn a_table_that_starts_from_that_of_a_similar_model_is_the_same() {
        const MAX_DIFFERENCE: f64 = 1e-5;
        for id in [
            "centripetal",
            "belt-slip motion-resistance",
            "shear-displacement",
            "friction-creep",
            "stribeck-friction load-transfer",
            "hitch-drag",
        ] {
            let model = |cog| {
                let mut vehicle = VehicleFile::auriga_alpha().vehicle;
                vehicle.cog = cog;
                Model::new(vehicle, effects(id)).with_resolution(Resolution::Coarse)
            };
            let before = Surface::new(&model([0.0, 0.0]), 1.5, RANGE, None);
            let there = model([-0.02, 0.03]);
            let [anew, beside] =
                [None, Some(&before)].map(|before| Surface::new(&there, 1.5, RANGE, before));
            let nodes = anew.0.beyond.nodes().iter().zip(beside.0.beyond.nodes());
            let off = nodes.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            println!("{id}: {off:.1e}, {} and {}", anew.0.unsolved, beside.0.unsolved);
            assert!(
                off < MAX_DIFFERENCE && anew.unsolved() == beside.unsolved(),
                "{id}: {off:.1e}"
            );
        }
    }

    #[test]
    fn offsets_move_the_icrs() {
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, Effects::none());
        let surface = Surface::new(&model, 1.5, RANGE, None);
        let speeds = PerSide::new(0.3, 0.8);
        let icrs = |offset: [f64; 3]| {
            let twist = surface.motion(speeds).twist(&offset);
            trackdyn_model::Icrs::of_motion(speeds, &twist).expect("turns").to_array()
        };
        let (before, after) = (icrs([0.0; 3]), icrs([0.01, -0.02, 0.03]));
        for (k, by) in [0.01, -0.02, 0.03].into_iter().enumerate() {
            assert!((after[k] - before[k] - by).abs() < 1e-12, "{k}");
        }
    }
}
