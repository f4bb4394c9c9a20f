//! The stationary motion as a function of both belt speeds, tabulated.
//!
//! Laws that change the shear stress need a quadrature per solve, and a recording has tens of thousands of
//! readings. Within a sector (the signs of V_l, V_r, V_r − V_l and V_r + V_l) the stationary motion is a
//! smooth function of the direction φ and the size ρ of (V_l, V_r); between sectors it may jump. It is
//! interpolated on Chebyshev nodes of each sector, which lie inside it, so that no node stands on an edge.
//!
//! What is interpolated is the twist beyond the mean belt speed, over the difference of the belt speeds:
//! finite also where a track holds the robot and its other ICR is infinitely far.

use nalgebra::Vector3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_4, PI};
use trackdyn_core::{PerSide, Twist, real};
use trackdyn_motion::{Icrs, Stationary, Status};
use trackdyn_physics::{Circumstance, Model};

/// Sectors of directions.
const SECTORS: usize = 8;

/// Nodes in the direction, and in the size.
const ANGLES: usize = 6;
const SIZES: usize = 8;

/// Ratio of the largest to the smallest tabulated speed. Nodes are even in its logarithm, for friction depends on
/// speeds most where they are small; below, the motion is that of the smallest in proportion.
const RANGE: f64 = 100.0;

/// A table of stationary motions.
#[derive(Clone, Debug)]
pub struct Surface {
    /// 1/ρ_max², ρ_max the largest tabulated speed.
    per_squared: f64,
    /// Per sector, size and direction: (v_x, v_y − V̄, w)/(V_r − V_l).
    nodes: Vec<Vector3<f64>>,
    angles: Nodes<ANGLES>,
    sizes: Nodes<SIZES>,
    unsolved: usize,
}

impl Surface {
    /// The stationary motions of a model whose gain is one, up to belt speeds of size `largest`, m/s.
    ///
    /// `before` is the table of a model that resembles it: each solve starts from there.
    pub fn new(model: &Model, largest: f64, before: Option<&Self>) -> Self {
        let (angles, sizes) = (Nodes::<ANGLES>::new(), Nodes::<SIZES>::new());
        let solver = Stationary::new(model, &Circumstance::default());
        let solved: Vec<Option<Vector3<f64>>> = (0..SECTORS * SIZES * ANGLES)
            .into_par_iter()
            .map(|index| {
                let (sector, rest) = (index / (SIZES * ANGLES), index % (SIZES * ANGLES));
                let (size, angle) = (sizes.at[rest / ANGLES], angles.at[rest % ANGLES]);
                let phi = (real(sector) + angle) * FRAC_PI_4;
                let rho = largest * RANGE.powf(size - 1.0);
                let speeds = PerSide::new(rho * phi.cos(), rho * phi.sin());
                let start = before.and_then(|before| icrs(&before.nodes[index]));
                let solution = solver.starting_at(start).solve(speeds);
                let usable = !matches!(solution.status, Status::NotConverged | Status::Lifts);
                usable.then(|| normalised(speeds, &solution.twist))
            })
            .collect();
        let unsolved = solved.iter().filter(|node| node.is_none()).count();
        let nodes = filled(&solved);
        Self { per_squared: largest.powi(-2), nodes, angles, sizes, unsolved }
    }

    /// Share of the nodes without a motion: part of the contact lifts, or no balance was found.
    pub fn unsolved(&self) -> f64 {
        real(self.unsolved) / real(self.nodes.len())
    }

    /// The stationary motion (paper's frame) at belt speeds.
    pub fn motion(&self, speeds: PerSide<f64>) -> Steady {
        let (difference, mean) =
            (speeds.right - speeds.left, f64::midpoint(speeds.left, speeds.right));
        let beyond = if difference == 0.0 { Vector3::zeros() } else { self.at(speeds) };
        Steady { mean, difference, beyond }
    }

    fn at(&self, speeds: PerSide<f64>) -> Vector3<f64> {
        // ρ = ρ_max R^(u − 1)
        let squared = (speeds.left * speeds.left + speeds.right * speeds.right) * self.per_squared;
        let size = (1.0 + squared.ln() * (0.5 / RANGE.ln())).clamp(0.0, 1.0);
        let phi = speeds.right.atan2(speeds.left).rem_euclid(2.0 * PI) / FRAC_PI_4;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8")]
        let sector = (phi as usize).min(SECTORS - 1);
        let along = self.angles.weights(phi - real(sector));
        let outwards = self.sizes.weights(size);
        let nodes = &self.nodes[sector * SIZES * ANGLES..][..SIZES * ANGLES];
        let mut sum = Vector3::zeros();
        for (row, weight) in nodes.chunks_exact(ANGLES).zip(outwards) {
            for (node, along) in row.iter().zip(along) {
                sum += node * (along * weight);
            }
        }
        sum
    }
}

/// A stationary motion at one pair of belt speeds.
#[derive(Clone, Copy, Debug)]
pub struct Steady {
    mean: f64,
    difference: f64,
    /// (v_x, v_y − V̄, w)/(V_r − V_l).
    beyond: Vector3<f64>,
}

impl Steady {
    /// The ICRs; none where one is infinitely far.
    pub fn icrs(&self) -> Option<Icrs> {
        icrs(&self.beyond)
    }

    /// The twist (paper's frame), with the ICRs moved by `offset` (x_l, x_r, y), m.
    pub fn twist(&self, offset: &[f64; 3]) -> Twist {
        let Self { mean, difference, beyond } = *self;
        let [across, along, turn] = moved(beyond, offset);
        Twist { v_x: across * difference, v_y: along * difference + mean, w: turn * difference }
    }
}

/// The nodes, with the nearest one of the same sector where one has no motion.
fn filled(solved: &[Option<Vector3<f64>>]) -> Vec<Vector3<f64>> {
    let place = |index: usize| (index % (SIZES * ANGLES) / ANGLES, index % ANGLES);
    let fill = |index: usize| {
        let sector = index / (SIZES * ANGLES) * SIZES * ANGLES;
        let (size, angle) = place(index);
        let known =
            (sector..sector + SIZES * ANGLES).filter_map(|other| Some((other, solved[other]?)));
        let nearest = known.min_by_key(|(other, _)| {
            let (other_size, other_angle) = place(*other);
            (other_size.abs_diff(size) + other_angle.abs_diff(angle), *other)
        });
        nearest.map_or(Vector3::zeros(), |(_, node)| node)
    };
    solved.iter().enumerate().map(|(index, node)| node.unwrap_or_else(|| fill(index))).collect()
}

/// The twist beyond the mean belt speed, over the difference of the belt speeds.
pub fn normalised(speeds: PerSide<f64>, twist: &Twist) -> Vector3<f64> {
    let mean = f64::midpoint(speeds.left, speeds.right);
    Vector3::new(twist.v_x, twist.v_y - mean, twist.w) / (speeds.right - speeds.left)
}

/// The ICRs of a normalised twist; none where one is infinitely far.
fn icrs(twist: &Vector3<f64>) -> Option<Icrs> {
    let (middle, half) = (-twist[1] / twist[2], 0.5 / twist[2]);
    let icrs = Icrs { x_left: middle - half, x_right: middle + half, y: twist[0] / twist[2] };
    (twist[2] > 0.0 && half.is_finite()).then_some(icrs)
}

/// A normalised twist after its ICRs were moved by (x_l, x_r, y), m.
fn moved(twist: Vector3<f64>, [left, right, y]: &[f64; 3]) -> [f64; 3] {
    // t = 1/(x_r − x_l); v_x = t y; v_y − V̄ = −t (x_l + x_r)/2
    let turn = twist[2] / (1.0 + twist[2] * (right - left));
    let shrink = 1.0 / (1.0 + twist[2] * (right - left));
    [shrink * twist[0] + turn * y, shrink * twist[1] - turn * (left + right) / 2.0, turn]
}

/// Chebyshev nodes of the first kind on [0, 1].
#[derive(Clone, Debug)]
struct Nodes<const N: usize> {
    at: [f64; N],
    /// 1/Π (x_k − x_j), over all other nodes j.
    weight: [f64; N],
}

impl<const N: usize> Nodes<N> {
    fn new() -> Self {
        let angle = |k: usize| (2.0 * real(k) + 1.0) * PI / (2.0 * real(N));
        let at: [f64; N] = std::array::from_fn(|k| 0.5 - 0.5 * angle(k).cos());
        let weight = std::array::from_fn(|k| {
            let others = (0..N).filter(|j| *j != k);
            others.map(|j| (at[k] - at[j]).recip()).product()
        });
        Self { at, weight }
    }

    /// Values of the Lagrange polynomials, c_k Π (x − x_j) over all other nodes j.
    fn weights(&self, x: f64) -> [f64; N] {
        let mut weights = self.weight;
        let mut product = 1.0;
        for (weight, at) in weights.iter_mut().zip(&self.at) {
            *weight *= product;
            product *= x - at;
        }
        product = 1.0;
        for (weight, at) in weights.iter_mut().zip(&self.at).rev() {
            *weight *= product;
            product *= x - at;
        }
        weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_physics::{Effects, VehicleFile};

    /// Effects of every kind that steady motion shows. The root mean square of the table's error must stay
    /// below what laboratory sensors resolve in a hundred segments, 0.5 mm/s at speeds of up to 1 m/s. A belt
    /// that slips comes to stick near straight driving: that kink lies inside a sector, and is smoothed.
    #[test]
    fn the_table_equals_the_solver() {
        const CLOSE: f64 = 5e-4;
        const KINKED: f64 = 3e-3;
        for id in [
            "",
            "centripetal",
            "motion-resistance",
            "viscous-friction",
            "belt-slip",
            "shear-displacement",
            "friction-creep",
            "stribeck-friction",
            "hitch-drag",
            "directional-lugs",
        ] {
            let effects: Effects =
                id.split_whitespace().map(|text| text.parse().expect("an effect")).collect();
            let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
            let surface = Surface::new(&model, 1.5, None);
            assert!(surface.unsolved() < 0.1, "{id}");
            let solver = Stationary::new(&model, &Circumstance::default());
            let (mut squares, mut count) = (0.0, 0.0);
            for k in 0..400_u32 {
                let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
                let speeds = PerSide::new(2.0 * a.fract() - 1.0, 2.0 * b.fract() - 1.0);
                let solution = solver.solve(speeds);
                if solution.status == Status::NotConverged {
                    continue;
                }
                let (table, twist) = (surface.motion(speeds).twist(&[0.0; 3]), solution.twist);
                // The yaw rate as the speed of a track.
                let off = [table.v_x - twist.v_x, table.v_y - twist.v_y, 0.4 * (table.w - twist.w)];
                squares += off.iter().map(|off| off * off).sum::<f64>();
                count += 1.0;
            }
            let error = (squares / count).sqrt();
            let bound = if model.drive().slip_per_traction > 0.0 { KINKED } else { CLOSE };
            assert!(count > 350.0 && error < bound, "{id}: {error:.1e} m/s");
        }
    }

    #[test]
    fn offsets_move_the_icrs() {
        let model = Model::new(VehicleFile::auriga_alpha().vehicle, Effects::none());
        let surface = Surface::new(&model, 1.5, None);
        let speeds = PerSide::new(0.3, 0.8);
        let icrs = |offset: [f64; 3]| {
            let twist = surface.motion(speeds).twist(&offset);
            trackdyn_motion::Icrs::of_motion(speeds, &twist).expect("turns").to_array()
        };
        let (before, after) = (icrs([0.0; 3]), icrs([0.01, -0.02, 0.03]));
        for (k, by) in [0.01, -0.02, 0.03].into_iter().enumerate() {
            assert!((after[k] - before[k] - by).abs() < 1e-12, "{k}");
        }
    }
}
