//! Contact of rollers with the ground, and how a robot turns on it.

use super::Robot;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{PerSide, STANDARD_GRAVITY, Side, Twist, real};
use trackdyn_model::Icrs;
use trackdyn_model::contact::Friction;

/// Rollers under a patch that is a track. With eight, χ of Auriga-alpha is 0.3 % off that of an
/// even pressure.
const ROLLERS_OF_TRACK: usize = 8;

/// Rollers under a patch that is a tyre: two have its second moment.
const ROLLERS_OF_TYRE: usize = 2;

/// A roller under a track or tyre: a wheel that turns with the belt, on a spring of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roller {
    /// Side of the robot.
    pub side: Side,
    /// Number on that side, from the rear.
    pub index: usize,
    /// Place of its contact, forward and left of the origin, m.
    pub place: [f64; 2],
    /// Preload over the mean load of a roller: 1 where pressure is linear.
    pub preload: f64,
    /// Friction on the ground.
    pub friction: Friction,
}

impl Roller {
    /// Both ends of its contact across: with them, a roller has the second moment of the width b.
    ///
    /// # Law
    /// y = ±b/(2√3), so that the mean of y² is b²/12.
    pub fn half_width(width: f64) -> f64 {
        width / 12.0_f64.sqrt()
    }
}

/// A point of a contact with friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Side of the robot.
    pub side: Side,
    /// Place, forward and left of the origin, m.
    pub place: [f64; 2],
    /// Normal load, N.
    pub load: f64,
    /// Friction.
    pub friction: Friction,
}

/// The rollers of a robot, from the left rear to the right front.
///
/// # Law
/// n rollers l/√(n² − 1) apart have the second moment l²/12 of a patch as long as l. Springs that
/// are alike bear a linear pressure; a preload adds κ p̄ (3 η² − 1)/2.
pub fn rollers(robot: &Robot) -> Vec<Roller> {
    let is_track = robot.patches.len() == 1;
    let count = if is_track { ROLLERS_OF_TRACK } else { ROLLERS_OF_TYRE };
    let n = real(count);
    let [rear, front] = robot.ends();
    let mut along: Vec<(f64, f64)> = Vec::new();
    let mut patches = robot.patches.clone();
    patches.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for [start, end] in patches {
        let (middle, length) = (f64::midpoint(start, end), end - start);
        let spacing = length / (n * n - 1.0).sqrt();
        let offset = |k: usize| spacing * (real(k) - (n - 1.0) / 2.0);
        let bulge = |k: usize| (3.0 * (2.0 * offset(k) / length).powi(2) - 1.0) / 2.0;
        let mean = (0..count).map(bulge).sum::<f64>() / n;
        along.extend((0..count).map(|k| {
            // p ← p + κ p̄ (3 η² − 1)/2
            let preload = 1.0 + robot.body.pressure_concentration * (bulge(k) - mean);
            (middle + offset(k), preload)
        }));
    }
    let of_side = |side: Side| {
        let y = -side.sign() * robot.gauge / 2.0;
        along.iter().enumerate().map(move |(index, &(x, preload))| {
            // μ (1 + γ η), η = ±1 at the ends of the contact
            let eta = (2.0 * x - rear - front) / (front - rear);
            let factor = 1.0 + robot.body.friction_gradient * eta;
            let Friction { across, along } = robot.friction[side];
            let friction = Friction { across: across * factor, along: along * factor };
            Roller { side, index, place: [x, y], preload, friction }
        })
    };
    of_side(Side::Left).chain(of_side(Side::Right)).collect()
}

/// Contact points of rollers on level ground, at rest.
pub fn contact_points(robot: &Robot, rollers: &[Roller]) -> Vec<ContactPoint> {
    let weight = robot.mass * STANDARD_GRAVITY;
    let half = Roller::half_width(robot.width);
    let mut points = Vec::new();
    for side in Side::BOTH {
        let of_side: Vec<&Roller> = rollers.iter().filter(|roller| roller.side == side).collect();
        // N = W/2 (1 ± x_c/(L/2))
        let load = weight * (0.5 - side.sign() * robot.cog[1] / robot.gauge);
        for (roller, load) in of_side.iter().zip(loads(&of_side, load, robot.cog[0])) {
            let [x, y] = roller.place;
            points.extend([-half, half].map(|offset| ContactPoint {
                side,
                place: [x, y + offset],
                load: load / 2.0,
                friction: roller.friction,
            }));
        }
    }
    points
}

/// Loads of rollers on equal springs that push and never pull, N, with their resultant at `centre`.
fn loads(rollers: &[&Roller], load: f64, centre: f64) -> Vec<f64> {
    let mut bears = vec![true; rollers.len()];
    loop {
        let of_bearing = || rollers.iter().zip(&bears).filter(|(_, bears)| **bears);
        let count = real(of_bearing().count());
        let mean = of_bearing().map(|(roller, _)| roller.place[0]).sum::<f64>() / count;
        let square =
            of_bearing().map(|(roller, _)| (roller.place[0] - mean).powi(2)).sum::<f64>() / count;
        let tilt = if square > 0.0 { (centre - mean) / square } else { 0.0 };
        // N_i = N/n (1 + (x_c − x̄)(x_i − x̄)/ρ² + preload)
        let all: Vec<f64> = rollers
            .iter()
            .map(|roller| load / count * (roller.preload + tilt * (roller.place[0] - mean)))
            .collect();
        let lifted = (0..all.len()).filter(|&k| bears[k] && all[k] < 0.0).collect::<Vec<_>>();
        if lifted.is_empty() || lifted.len() + 2 > bears.iter().filter(|bears| **bears).count() {
            return all
                .iter()
                .zip(&bears)
                .map(|(n, b)| if *b { n.max(0.0) } else { 0.0 })
                .collect();
        }
        for k in lifted {
            bears[k] = false;
        }
    }
}

/// Smoothing speeds, in units of the belt speed: from nearly linear friction to dry friction.
const FIRST_SMOOTHING: f64 = 0.3;
const LAST_SMOOTHING: f64 = 1e-7;

/// Steps of Newton's method at one smoothing speed; five do.
const MAX_STEPS: usize = 50;

/// ICRs of the tracks where friction lies on an ellipse and is opposed to slip as much as that
/// allows: the law of elliptic friction cones. None if the robot does not turn.
///
/// # Law
/// The motion in a spin at V_r = −V_l = 1 is the minimum of the dissipation
/// Σ N √(μ_y² s_y² + μ_x² s_x²), a convex function of the twist. Along an isotropic contact this is
/// equation (22); else the force is μ_i² s_i/√(…), not μ_i s_i/|s|.
pub fn icrs(points: &[ContactPoint]) -> Option<Icrs> {
    let belt_speed = PerSide::new(-1.0, 1.0);
    let extent = points.iter().map(|p| p.place[0].hypot(p.place[1])).fold(0.0, f64::max);
    let scale: f64 = points.iter().map(|p| p.load * p.friction.along.max(p.friction.across)).sum();
    // Forward, left, and turn times the size of the contact.
    let mut twist = Vector3::new(0.0, 0.0, 0.5);
    let mut smoothing = FIRST_SMOOTHING;
    while smoothing > LAST_SMOOTHING {
        for _ in 0..MAX_STEPS {
            let (value, gradient, hessian) =
                dissipation(points, belt_speed, extent, smoothing, &twist);
            if gradient.norm() < 1e-12 * scale {
                break;
            }
            let step = hessian.cholesky()?.solve(&gradient);
            let mut length = 1.0;
            let descent = gradient.dot(&step);
            let falls = |length: f64| {
                let there = twist - step * length;
                let (there, ..) = dissipation(points, belt_speed, extent, smoothing, &there);
                there <= value - 1e-4 * length * descent
            };
            while !falls(length) && length > 1e-9 {
                length /= 2.0;
            }
            twist -= step * length;
        }
        smoothing /= 3.0;
    }
    let twist = Twist { v_x: -twist[1], v_y: twist[0], w: twist[2] / extent };
    Icrs::of_motion(belt_speed, &twist).filter(|icrs| icrs.x_right > icrs.x_left)
}

/// Dissipation, smoothed, with its derivatives by forward and left speed and turn.
fn dissipation(
    points: &[ContactPoint],
    belt_speed: PerSide<f64>,
    extent: f64,
    smoothing: f64,
    twist: &Vector3<f64>,
) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let (mut value, mut gradient, mut hessian) = (0.0, Vector3::zeros(), Matrix3::zeros());
    for ContactPoint { side, place: [x, y], load, friction } in points {
        // s = (v_x − ω y − V, v_y + ω x), forward and left
        let forward = Vector3::new(1.0, 0.0, -y / extent) * friction.along;
        let left = Vector3::new(0.0, 1.0, x / extent) * friction.across;
        let along = forward.dot(twist) - belt_speed[*side] * friction.along;
        let across = left.dot(twist);
        let soft = smoothing * friction.along.max(friction.across);
        let norm = (along * along + across * across + soft * soft).sqrt();
        let slope = forward * along + left * across;
        value += load * norm;
        gradient += slope * (load / norm);
        hessian += (forward * forward.transpose() + left * left.transpose()) * (load / norm)
            - slope * slope.transpose() * (load / norm.powi(3));
    }
    (value, gradient, hessian)
}

/// Smallest and largest factor on friction across that is tried.
const FACTORS: [f64; 2] = [0.05, 20.0];

/// Factor on friction across with which the rollers turn with the χ of the robot, and how they turn
/// then. None where no factor does.
pub fn matched(robot: &Robot, rollers: &[Roller]) -> Option<(f64, Icrs)> {
    let wanted = robot.icrs.x_right - robot.icrs.x_left;
    let points = contact_points(robot, rollers);
    let turns = |factor: f64| {
        let mut scaled = points.clone();
        for point in &mut scaled {
            point.friction.across *= factor;
        }
        icrs(&scaled)
    };
    let is_wide = |icrs: &Option<Icrs>| icrs.is_none_or(|of| of.x_right - of.x_left > wanted);
    let [mut low, mut high] = FACTORS;
    if is_wide(&turns(low)) || !is_wide(&turns(high)) {
        return None;
    }
    // The separation of the ICRs grows with friction across.
    while high / low > 1.0 + 1e-9 {
        let middle = (low * high).sqrt();
        if is_wide(&turns(middle)) { high = middle } else { low = middle }
    }
    turns(low).map(|icrs| (low, icrs))
}
