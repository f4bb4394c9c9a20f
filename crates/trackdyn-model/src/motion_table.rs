//! The stationary motion over both track speeds as polynomials, for a robot's computer.
//!
//! Expanded is, in each of the [sectors] of the plane of both belt speeds,
//!
//! ```text
//! b = (v_x − V̄, v_y, w)/D,   D = V_r − V_l,   V̄ = (V_l + V_r)/2
//! ```
//!
//! in ROS axes, which stays finite where the robot is held straight. Where belts slip on their
//! sprockets a load costs speed even without a difference: there D = ρ. With (s, a) the place in
//! the sector,
//!
//! ```text
//! b(V_l, V_r) = Σ c_jk T_j(2 s − 1) T_k(2 a − 1),   0 ≤ a, s ≤ 1
//! ```
//!
//! with Chebyshev's polynomials T. The coefficients follow from the motions at Chebyshev's nodes.
//! There are as many as the accuracy takes, from a single one: all motions without effects share
//! their ICRs (the constancy theorem).

use crate::effect::Symmetry;
use crate::sectors::{self, SECTORS, Spacing, node};
use crate::{Circumstance, Model, Stationary, Status};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_4;
use trackdyn_core::frames::ros_twist_from_paper;
use trackdyn_core::{PerSide, Twist, real};

/// Numbers of polynomials in s and in a that are tried, fewest first.
const ORDERS: [[usize; 2]; 8] =
    [[1, 1], [1, 6], [1, 10], [4, 6], [6, 8], [8, 10], [10, 12], [14, 14]];

/// Error that is small enough, m/s; the yaw rate counts as a track speed.
pub const TOLERANCE: f64 = 1e-6;

/// Points each way of a sector at which a table is compared with the model, none of them a node.
const CHECK_POINTS: usize = 15;

/// Ratio R of the largest to the smallest speed where the table is even in ln ρ: motion at smaller
/// speeds is in proportion.
const RANGE: f64 = 30.0;

/// The stationary motion of a model over both track speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionTable {
    /// Ratio of belt to encoder speed, 1.
    pub gain: PerSide<f64>,
    /// ρ_max, the largest norm of both belt speeds, m/s: beyond, ICRs stay as they are there.
    pub largest: f64,
    /// Spacing in ρ.
    pub spacing: Spacing,
    /// Whether D = ρ: belts slip on their sprockets.
    pub slips: bool,
    /// Numbers of polynomials in s and in a.
    pub orders: [usize; 2],
    /// Coefficients c: of each sector, of each polynomial in s, of each in a; forward, left (1) and
    /// yaw (1/m).
    pub coefficients: Vec<[f64; 3]>,
    /// Largest difference from the model between the nodes, m/s; the yaw rate counts as a track
    /// speed.
    pub error: f64,
    /// Part of the speeds at which the robot tips over or no forces balance; they have the motion
    /// of their neighbours.
    pub unsolved: f64,
}

/// A motion and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabulated {
    /// Twist in ROS axes.
    pub twist: Twist,
    /// Derivatives of its components forward, left and yaw by the speeds of the left and the right
    /// encoder.
    pub by_speed: [[f64; 2]; 3],
}

/// The shape of a table.
#[derive(Clone, Copy)]
struct Shape {
    largest: f64,
    spacing: Spacing,
    slips: bool,
}

/// Where a pair of belt speeds lies in a table.
struct Place {
    sector: usize,
    /// s and a.
    at: [f64; 2],
    /// Derivatives of s and a by both speeds; zero where s ends.
    by_speed: [[f64; 2]; 2],
}

impl MotionTable {
    /// The table of a model, for encoder speeds up to `fastest`, m/s, with the fewest polynomials
    /// that are as accurate as [`TOLERANCE`]; the most accurate one where none is. Laws of place,
    /// heading and time count as at the origin.
    ///
    /// # Panics
    /// Never: several orders are tried.
    pub fn of(model: &Model, fastest: f64) -> Self {
        let breaks_scale = model
            .effects()
            .iter()
            .any(|effect| effect.card().breaks.contains(&Symmetry::SpeedScale));
        let gain = model.drive().gain;
        let shape = Shape {
            largest: std::f64::consts::SQRT_2 * fastest * gain.left.abs().max(gain.right.abs()),
            spacing: Spacing::of(model, RANGE),
            slips: model.drive().slip_per_traction != 0.0,
        };
        let solver = Stationary::new(model, &Circumstance::default());
        // b at belt speeds; none where there is no motion
        let solved = |belts: PerSide<f64>| -> Option<[f64; 3]> {
            let solution = solver.solve(PerSide::from_fn(|side| belts[side] / gain[side]));
            let usable = !matches!(solution.status, Status::NotConverged | Status::Tips);
            usable.then(|| shape.beyond(belts, &ros_twist_from_paper(&solution.twist)))
        };
        let checked: Vec<(PerSide<f64>, Option<[f64; 3]>)> = shape
            .points([CHECK_POINTS; 2], |k, _| (real(k) + 0.5) / real(CHECK_POINTS))
            .into_par_iter()
            .map(|belts| (belts, solved(belts)))
            .collect();
        let unsolved = checked.iter().filter(|(_, motion)| motion.is_none()).count();
        let mut best: Option<Self> = None;
        for orders in ORDERS {
            // One speed stands for all only where ratios of speeds alone count.
            if orders[0] == 1 && breaks_scale {
                continue;
            }
            let nodes: Vec<Option<[f64; 3]>> =
                shape.points(orders, node).into_par_iter().map(solved).collect();
            let mut table = Self {
                gain,
                largest: shape.largest,
                spacing: shape.spacing,
                slips: shape.slips,
                orders,
                coefficients: coefficients(&sectors::filled(&nodes, orders), orders),
                error: 0.0,
                unsolved: real(unsolved) / real(checked.len()),
            };
            let gauge = model.vehicle().gauge;
            let errors = checked.iter().filter_map(|(belts, motion)| {
                let found = table.expanded(&shape.place(*belts))[0];
                let motion = (*motion)?;
                let off: [f64; 3] = std::array::from_fn(|k| found[k] - motion[k]);
                Some(shape.scale(*belts).abs() * off[0].hypot(off[1]).hypot(gauge / 2.0 * off[2]))
            });
            table.error = errors.fold(0.0, f64::max);
            if best.as_ref().is_none_or(|best| table.error < best.error) {
                best = Some(table);
            }
            if best.as_ref().is_some_and(|best| best.error <= TOLERANCE) {
                break;
            }
        }
        best.expect("several orders were tried")
    }

    /// Belt speeds at encoder speeds, m/s.
    pub fn belts(&self, speeds: PerSide<f64>) -> PerSide<f64> {
        PerSide::from_fn(|side| self.gain[side] * speeds[side])
    }

    /// The motion at encoder speeds, m/s.
    pub fn at(&self, speeds: PerSide<f64>) -> Tabulated {
        let belts = self.belts(speeds);
        let shape = Shape { largest: self.largest, spacing: self.spacing, slips: self.slips };
        let place = shape.place(belts);
        let [value, by_s, by_a] = self.expanded(&place);
        let scale = shape.scale(belts);
        let by_scale = shape.scale_by_speed(belts);
        let mean = [f64::midpoint(belts.left, belts.right), 0.0, 0.0];
        let [forward, left, yaw] = std::array::from_fn(|k| value[k] * scale + mean[k]);
        let gain = [self.gain.left, self.gain.right];
        let by_speed = std::array::from_fn(|k| {
            std::array::from_fn(|side| {
                let [s, a] = place.by_speed;
                let by_belt = (by_s[k] * s[side] + by_a[k] * a[side]) * scale
                    + value[k] * by_scale[side]
                    + if k == 0 { 0.5 } else { 0.0 };
                gain[side] * by_belt
            })
        });
        Tabulated { twist: Twist { v_x: forward, v_y: left, w: yaw }, by_speed }
    }

    /// b at a place, and its derivatives by s and a.
    fn expanded(&self, place: &Place) -> [[f64; 3]; 3] {
        let [sizes, angles] = self.orders;
        let [(t_s, d_s), (t_a, d_a)] =
            [(sizes, place.at[0]), (angles, place.at[1])].map(|(count, at)| chebyshev(count, at));
        let mut sums = [[0.0; 3]; 3];
        let of_sector = &self.coefficients[place.sector * sizes * angles..][..sizes * angles];
        for (j, row) in of_sector.chunks_exact(angles).enumerate() {
            for (k, c) in row.iter().enumerate() {
                let factors = [t_s[j] * t_a[k], d_s[j] * t_a[k], t_s[j] * d_a[k]];
                for (sum, factor) in sums.iter_mut().zip(factors) {
                    *sum = std::array::from_fn(|component| sum[component] + factor * c[component]);
                }
            }
        }
        sums
    }
}

impl Shape {
    /// D.
    fn scale(self, belts: PerSide<f64>) -> f64 {
        if self.slips { belts.left.hypot(belts.right) } else { belts.right - belts.left }
    }

    fn scale_by_speed(self, belts: PerSide<f64>) -> [f64; 2] {
        if !self.slips {
            return [-1.0, 1.0];
        }
        let norm = belts.left.hypot(belts.right);
        if norm > 0.0 { [belts.left / norm, belts.right / norm] } else { [0.0; 2] }
    }

    /// b of a twist in ROS axes.
    fn beyond(self, belts: PerSide<f64>, twist: &Twist) -> [f64; 3] {
        let mean = f64::midpoint(belts.left, belts.right);
        [twist.v_x - mean, twist.v_y, twist.w].map(|value| value / self.scale(belts))
    }

    /// Belt speeds at points of all sectors, `at(k, n)` the places in both directions.
    fn points(
        self,
        [sizes, angles]: [usize; 2],
        at: impl Fn(usize, usize) -> f64,
    ) -> Vec<PerSide<f64>> {
        let point = |index: usize| {
            let (sector, rest) = (index / (sizes * angles), index % (sizes * angles));
            let place = [at(rest / angles, sizes), at(rest % angles, angles)];
            sectors::speeds(self.largest, self.spacing, sector, place)
        };
        (0..SECTORS * sizes * angles).map(point).collect()
    }

    fn place(self, belts: PerSide<f64>) -> Place {
        let PerSide { left, right } = belts;
        let squared = left * left + right * right;
        if squared == 0.0 {
            return Place { sector: 0, at: [0.0; 2], by_speed: [[0.0; 2]; 2] };
        }
        let part = squared / (self.largest * self.largest);
        let s = self.spacing.place(part);
        // ∂s/∂V = V/ρ ds/dρ
        let by_speed = match self.spacing {
            _ if part > 1.0 || s == 0.0 => 0.0,
            Spacing::Even => (squared.sqrt() * self.largest).recip(),
            Spacing::Logarithmic { scale, .. } => 2.0 * scale / squared,
        };
        let (sector, a) = sectors::direction(belts);
        Place {
            sector,
            at: [s, a],
            by_speed: [
                [left * by_speed, right * by_speed],
                [-right / (squared * FRAC_PI_4), left / (squared * FRAC_PI_4)],
            ],
        }
    }
}

/// T_0 to T_(n−1) at 2 x − 1, and their derivatives by x.
fn chebyshev(count: usize, x: f64) -> (Vec<f64>, Vec<f64>) {
    let z = 2.0 * x - 1.0;
    let (mut values, mut slopes) = (vec![1.0, z], vec![0.0, 2.0]);
    for k in 2..count {
        // T_(k+1) = 2 z T_k − T_(k−1)
        values.push(2.0 * z * values[k - 1] - values[k - 2]);
        slopes.push(4.0 * values[k - 1] + 2.0 * z * slopes[k - 1] - slopes[k - 2]);
    }
    (values, slopes)
}

/// Coefficients from the values at the nodes.
///
/// # Law
/// c_jk = w_j w_k Σ_pq f_pq T_j(x_p) T_k(x_q), w_0 = 1/n, else 2/n: Chebyshev's polynomials are
/// orthogonal over their nodes.
fn coefficients(values: &[[f64; 3]], [sizes, angles]: [usize; 2]) -> Vec<[f64; 3]> {
    let polynomials = |count: usize| -> Vec<Vec<f64>> {
        (0..count).map(|k| chebyshev(count, node(k, count)).0).collect()
    };
    let (of_s, of_a) = (polynomials(sizes), polynomials(angles));
    let weight = |k: usize, n: usize| if k == 0 { 1.0 } else { 2.0 } / real(n);
    let of_sector = |values: &[[f64; 3]]| -> Vec<[f64; 3]> {
        let coefficient = |index: usize| {
            let (j, k) = (index / angles, index % angles);
            let mut sum = [0.0; 3];
            for (place, value) in values.iter().enumerate() {
                let factor = of_s[place / angles][j] * of_a[place % angles][k];
                sum = std::array::from_fn(|component| sum[component] + factor * value[component]);
            }
            sum.map(|sum| weight(j, sizes) * weight(k, angles) * sum)
        };
        (0..sizes * angles).map(coefficient).collect()
    };
    values.chunks_exact(sizes * angles).flat_map(of_sector).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ActiveEffect, Effects, VehicleFile};

    fn model(effects: &str) -> Model {
        let effects: Effects = effects
            .split_whitespace()
            .map(|text| text.parse::<ActiveEffect>().expect("an effect"))
            .collect();
        Model::new(VehicleFile::auriga_alpha().vehicle, effects)
    }

    /// Pairs of speeds in all sectors, none of them on a grid.
    fn speeds() -> impl Iterator<Item = PerSide<f64>> {
        (1..300_u32).map(|k| {
            let (a, b) = (f64::from(k) * 0.618_034, f64::from(k) * 0.414_214);
            PerSide::new(2.0 * a.fract() - 1.0, 2.0 * b.fract() - 1.0)
        })
    }

    #[test]
    fn tables_are_as_small_as_their_accuracy_takes_and_as_accurate_as_they_say() {
        for (effects, most) in [
            ("", 1),
            ("encoder-scale:left=1.03,right=0.98", 1),
            ("motion-resistance", 10),
            ("centripetal load-transfer:cog_height_m=0.15", 80),
            ("viscous-friction", 196),
            ("belt-slip", 196),
        ] {
            let model = model(effects);
            let table = MotionTable::of(&model, 1.0);
            let count = table.orders[0] * table.orders[1];
            assert!(count <= most, "{effects}: {count} polynomials, {:.1e} m/s", table.error);
            let solver = Stationary::new(&model, &Circumstance::default());
            let mut largest = 0.0_f64;
            for speeds in speeds() {
                let twist = ros_twist_from_paper(&solver.solve(speeds).twist);
                let off = table.at(speeds).twist - twist;
                largest = largest.max(off.v_x.hypot(off.v_y).hypot(0.21 * off.w));
            }
            println!("{effects}: {count}, {:.1e} and {largest:.1e} m/s", table.error);
            // other points than those that were checked
            let known = 3.0 * table.error.max(TOLERANCE);
            assert!(largest < known, "{effects}: {largest:.1e} m/s of {:.1e}", table.error);
        }
    }

    #[test]
    fn derivatives_are_quotients_of_differences() {
        const STEP: f64 = 1e-6;
        for effects in
            ["", "encoder-scale:left=1.03 centripetal", "viscous-friction", "belt-slip:slip=0.05"]
        {
            let table = MotionTable::of(&model(effects), 1.0);
            for speeds in speeds() {
                let by_speed = table.at(speeds).by_speed;
                for side in 0..2 {
                    let moved = |by: f64| {
                        let [left, right] = if side == 0 { [by, 0.0] } else { [0.0, by] };
                        table.at(PerSide::new(speeds.left + left, speeds.right + right)).twist
                    };
                    let quotient = (moved(STEP) - moved(-STEP)) * (0.5 / STEP);
                    let [forward, left, yaw] = by_speed.map(|of| of[side]);
                    let off = [quotient.v_x - forward, quotient.v_y - left, quotient.w - yaw];
                    let off = off.map(f64::abs).into_iter().fold(0.0, f64::max);
                    assert!(off < 1e-5, "{effects}, {speeds:?}, {side}: {off:.1e}");
                }
            }
        }
    }
}
