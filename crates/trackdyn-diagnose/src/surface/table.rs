//! Table of a piecewise smooth function of both belt speeds.
//!
//! Each of the [sectors](trackdyn_model::sectors) is interpolated on its Chebyshev nodes.

use nalgebra::Vector3;
use trackdyn_core::PerSide;
use trackdyn_model::sectors::{self, SECTORS, Spacing};

/// Number of nodes in direction, and in norm.
const ANGLES: usize = 6;
const SIZES: usize = 10;

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
        let place = [self.sizes.at[rest / ANGLES], self.angles.at[rest % ANGLES]];
        sectors::speeds(self.largest, self.spacing, sector, place)
    }
}

impl Table {
    /// Table of the values at all nodes, in order; a missing one takes that of the nearest node of
    /// its sector, or zero.
    pub fn new(grid: Grid, values: &[Option<Vector3<f64>>]) -> Self {
        Self { grid, nodes: sectors::filled(values, [SIZES, ANGLES]) }
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
        let (sector, angle) = sectors::direction(speeds);
        let along = angles.weights(angle);
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

/// Chebyshev nodes of the first kind on [0, 1].
#[derive(Clone, Debug, PartialEq)]
struct Nodes<const N: usize> {
    at: [f64; N],
    /// Barycentric weight c_k = 1/Π (x_k − x_j), over all other nodes j.
    weight: [f64; N],
}

impl<const N: usize> Nodes<N> {
    fn new() -> Self {
        let at: [f64; N] = std::array::from_fn(|k| sectors::node(k, N));
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
