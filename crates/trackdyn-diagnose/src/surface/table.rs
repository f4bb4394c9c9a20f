//! Table of a piecewise smooth function of both belt speeds.
//!
//! Within a sector (signs of V_l, V_r, V_r − V_l and V_r + V_l) the function is smooth in the
//! direction φ and norm ρ of (V_l, V_r); between sectors it may jump. Each sector is interpolated
//! on Chebyshev nodes of the first kind, none of which lies on an edge.

use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_4, PI};
use trackdyn_core::{PerSide, real};

/// Number of sectors.
const SECTORS: usize = 8;

/// Number of nodes in direction, and in norm.
const ANGLES: usize = 6;
const SIZES: usize = 10;

/// Spacing of the nodes in ρ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Even in ρ: exact for a square of the speed.
    Even,
    /// Even in ln ρ: friction that depends on slip speed varies most at small ones.
    Logarithmic {
        /// Ratio R of the largest to the smallest tabulated speed; below, the value stays constant.
        range: f64,
        /// 1/(2 ln R).
        scale: f64,
    },
}

impl Spacing {
    /// Even in the logarithm, for this ratio of the largest to the smallest speed.
    pub fn logarithmic(range: f64) -> Self {
        Self::Logarithmic { range, scale: 0.5 / range.ln() }
    }

    /// ρ/ρ_max at a coordinate in [0, 1].
    fn part(self, place: f64) -> f64 {
        match self {
            Self::Even => place,
            // R^(u − 1)
            Self::Logarithmic { range, .. } => range.powf(place - 1.0),
        }
    }

    /// Coordinate in [0, 1] of (ρ/ρ_max)².
    fn place(self, squared: f64) -> f64 {
        let place = match self {
            Self::Even => squared.sqrt(),
            Self::Logarithmic { scale, .. } => 1.0 + squared.ln() * scale,
        };
        place.clamp(0.0, 1.0)
    }
}

/// Nodes of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// ρ_max, the largest tabulated speed, m/s.
    largest: f64,
    spacing: Spacing,
    angles: Nodes<ANGLES>,
    sizes: Nodes<SIZES>,
}

/// Values at the nodes.
#[derive(Clone, Debug)]
pub struct Table {
    grid: Grid,
    nodes: Vec<Vector3<f64>>,
}

impl Grid {
    /// Number of nodes.
    pub const NODES: usize = SECTORS * SIZES * ANGLES;

    /// Nodes for belt speeds of size up to `largest`, m/s.
    pub fn new(largest: f64, spacing: Spacing) -> Self {
        Self { largest, spacing, angles: Nodes::new(), sizes: Nodes::new() }
    }

    /// Belt speeds of a node, m/s.
    pub fn speeds(&self, index: usize) -> PerSide<f64> {
        let (sector, rest) = (index / (SIZES * ANGLES), index % (SIZES * ANGLES));
        let (size, angle) = (self.sizes.at[rest / ANGLES], self.angles.at[rest % ANGLES]);
        let phi = (real(sector) + angle) * FRAC_PI_4;
        let rho = self.largest * self.spacing.part(size);
        PerSide::new(rho * phi.cos(), rho * phi.sin())
    }
}

impl Table {
    /// Table of the values at all nodes, in order; a missing one takes that of the nearest node of
    /// its sector, or zero.
    pub fn new(grid: Grid, values: &[Option<Vector3<f64>>]) -> Self {
        Self { grid, nodes: filled(values) }
    }

    /// Values at the nodes.
    #[cfg(test)]
    pub fn nodes(&self) -> &[Vector3<f64>] {
        &self.nodes
    }

    /// Nodes of the table.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Interpolated value at belt speeds.
    pub fn at(&self, speeds: PerSide<f64>) -> Vector3<f64> {
        let Grid { largest, spacing, angles, sizes } = &self.grid;
        let squared =
            (speeds.left * speeds.left + speeds.right * speeds.right) / (largest * largest);
        let size = spacing.place(squared);
        let phi = speeds.right.atan2(speeds.left).rem_euclid(2.0 * PI) / FRAC_PI_4;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8")]
        let sector = (phi as usize).min(SECTORS - 1);
        let along = angles.weights(phi - real(sector));
        let outwards = sizes.weights(size);
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

/// Values with missing ones replaced by the nearest node of the sector.
fn filled(values: &[Option<Vector3<f64>>]) -> Vec<Vector3<f64>> {
    let place = |index: usize| (index % (SIZES * ANGLES) / ANGLES, index % ANGLES);
    let fill = |index: usize| {
        let sector = index / (SIZES * ANGLES) * SIZES * ANGLES;
        let (size, angle) = place(index);
        let known =
            (sector..sector + SIZES * ANGLES).filter_map(|other| Some((other, values[other]?)));
        let nearest = known.min_by_key(|(other, _)| {
            let (other_size, other_angle) = place(*other);
            (other_size.abs_diff(size) + other_angle.abs_diff(angle), *other)
        });
        nearest.map_or_else(Vector3::zeros, |(_, node)| node)
    };
    values.iter().enumerate().map(|(index, node)| node.unwrap_or_else(|| fill(index))).collect()
}

/// Chebyshev nodes of the first kind on [0, 1].
#[derive(Clone, Debug, PartialEq)]
struct Nodes<const N: usize> {
    at: [f64; N],
    /// Barycentric weight c_k = 1/Π (x_k − x_j), over all other nodes j.
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
