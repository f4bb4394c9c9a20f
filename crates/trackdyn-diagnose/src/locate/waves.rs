//! Contrasts that vary with the place: waves of the ground.
//!
//! # Law
//! Any dependence on place is a sum of waves. To first order a field φ of the ground's friction
//! moves half the distance of the ICRs with its value, and their middle and y with its gradient
//! across and along the body:
//!
//! δh ∝ φ,  δa ∝ ∂φ/∂left,  δy ∝ ∂φ/∂forward,  φ = A cos k·p + B sin k·p
//!
//! so that each wave number k has six columns. Wave numbers are as dense as the driven area
//! resolves, longest waves first.

use super::IcrColumns;
use super::departures::middle_half_y;
use crate::evidence::{Evidence, Sample};
use crate::resampling::Resampling;
use crate::settings;
use crate::significance::{Group, Test, test_family};
use crate::weighted::Weighted;
use faer::Mat;
use nalgebra::{DMatrix, DVector, Vector2, Vector3};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use trackdyn_core::real;

/// A wave of the ground, with its test, family-wise over all waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Wavelength, m.
    pub length: f64,
    /// Direction of the wave vector in the frame of the poses, rad, from −π/2 to π/2.
    pub direction: f64,
    /// Its test.
    pub test: Test,
}

/// The most significant wave in a residual, beside other columns that may explain it; none
/// where samples share no world.
///
/// `residual` and the columns `beside` are whitened, `icrs` are not.
pub fn strongest_wave(
    evidence: &Weighted,
    residual: &[Vector3<f64>],
    beside: &[Vec<Vector3<f64>>],
    icrs: &IcrColumns,
    resampling: Resampling,
) -> Option<Wave> {
    if !evidence.has_world() {
        return None;
    }
    let numbers = numbers(evidence);
    let remainder = Remainder::new(evidence, residual, beside);
    let departures = middle_half_y(icrs);
    let groups: Vec<Group> = numbers
        .par_iter()
        .map(|number| {
            let columns = columns(evidence, &departures, *number);
            let columns = columns.map(|column| evidence.white(column));
            remainder.group(&columns, &evidence.settings().location)
        })
        .collect();
    let tests = test_family(&groups, resampling);
    let waves = numbers.into_iter().zip(tests).map(|(number, test)| Wave {
        length: TAU / number.norm(),
        direction: (number.y / number.x).atan(),
        test,
    });
    waves.reduce(|best, wave| if wave.test.is_stronger(&best.test) { wave } else { best })
}

/// Wave vectors k, rad/m, one of each pair ±k, longest waves first.
fn numbers(evidence: &Evidence) -> Vec<Vector2<f64>> {
    let settings = &evidence.settings().location;
    // without the outermost poses, which may be stray
    let extent = |of: &dyn Fn(&Sample) -> f64| {
        let mut values: Vec<f64> = evidence.samples().iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of them"
        )]
        let aside = (settings.outer_share * real(values.len())) as usize;
        let [low, high] = [values[aside], values[values.len() - 1 - aside]];
        (high - low).max(2.0 * settings.min_wavelength)
    };
    let step = Vector2::new(extent(&|s| s.pose.x), extent(&|s| s.pose.y))
        .map(|extent| TAU / (settings.waves_per_length * extent));
    // half an ellipse holds π/2 K²/(Δk_x Δk_y) wave vectors
    let largest = (2.0 * real(settings.max_waves) * step.x * step.y / PI).sqrt();
    let largest = largest.min(TAU / settings.min_wavelength);
    let multiples =
        |step: f64| (0..).map(move |k: u32| step * f64::from(k)).take_while(move |k| *k <= largest);
    // k and −k are equivalent
    let other = |[x, y]: [f64; 2]| (x > 0.0 && y > 0.0).then_some([x, -y]);
    let mut numbers: Vec<Vector2<f64>> = multiples(step.x)
        .flat_map(|x| multiples(step.y).map(move |y| [x, y]))
        .flat_map(|number| std::iter::once(number).chain(other(number)))
        .map(Vector2::from)
        .filter(|number| number.norm() > 0.0 && number.norm() <= largest)
        .collect();
    numbers.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    numbers
}

/// The six columns of a wave, not whitened.
fn columns(
    evidence: &Evidence,
    [middle, half, y]: &[Vec<Vector3<f64>>; 3],
    number: Vector2<f64>,
) -> [Vec<Vector3<f64>>; 6] {
    let mut columns = std::array::from_fn(|_| Vec::with_capacity(half.len()));
    let across_crests = number.normalize();
    for (k, sample) in evidence.samples().iter().enumerate() {
        let pose = &sample.pose;
        let (phase_sin, phase_cos) = (number.x * pose.x + number.y * pose.y).sin_cos();
        let (sin, cos) = pose.yaw.sin_cos();
        let left = across_crests.y * cos - across_crests.x * sin;
        let forward = across_crests.x * cos + across_crests.y * sin;
        let by = [half[k], middle[k] * left, y[k] * forward];
        for (place, departure) in by.into_iter().enumerate() {
            columns[2 * place].push(departure * phase_cos);
            columns[2 * place + 1].push(departure * phase_sin);
        }
    }
    columns
}

/// A residual with the other columns projected out, and the square roots of the sample weights.
struct Remainder {
    roots: Vec<f64>,
    blocks: Vec<Range<usize>>,
    /// Orthonormal basis of the other columns.
    beside: DMatrix<f64>,
    residual: DVector<f64>,
}

impl Remainder {
    fn new(evidence: &Weighted, residual: &[Vector3<f64>], beside: &[Vec<Vector3<f64>>]) -> Self {
        let weights = evidence.weights(residual);
        let roots: Vec<f64> = weights.into_iter().map(f64::sqrt).collect();
        let flat = |column: &[Vector3<f64>]| {
            let values = column.iter().zip(&roots).flat_map(|(value, root)| {
                let value = value * *root;
                [value.x, value.y, value.z]
            });
            DVector::from_iterator(3 * column.len(), values)
        };
        let columns: Vec<DVector<f64>> = beside.iter().map(|column| flat(column)).collect();
        let mut residual = flat(residual);
        let beside = orthonormal_basis(&columns, residual.len());
        residual -= &beside * beside.tr_mul(&residual);
        let mut blocks = vec![Range { start: usize::MAX, end: 0 }; evidence.blocks()];
        for (k, sample) in evidence.samples().iter().enumerate() {
            let block: &mut Range<usize> = &mut blocks[sample.block];
            *block = block.start.min(3 * k)..3 * k + 3;
        }
        Self { roots, blocks, beside, residual }
    }

    fn group(&self, columns: &[Vec<Vector3<f64>>; 6], settings: &settings::Location) -> Group {
        let mut matrix = DMatrix::zeros(self.residual.len(), columns.len());
        for (c, column) in columns.iter().enumerate() {
            for (k, (value, root)) in column.iter().zip(&self.roots).enumerate() {
                matrix.fixed_view_mut::<3, 1>(3 * k, c).copy_from(&(value * *root));
            }
        }
        matrix -= &self.beside * self.beside.tr_mul(&matrix);
        let blocks = self.blocks.iter().map(|rows| {
            let (first, count) = (rows.start.min(rows.end), rows.len());
            let of = matrix.rows(first, count);
            (of.tr_mul(&self.residual.rows(first, count)), of.tr_mul(&of))
        });
        Group::of(&blocks.collect::<Vec<_>>(), settings)
    }
}

/// An orthonormal basis of what columns of this length span, by QR decomposition with pivots.
fn orthonormal_basis(columns: &[DVector<f64>], length: usize) -> DMatrix<f64> {
    /// Part of a column's length that must stand out of those before it.
    const MIN_INDEPENDENT: f64 = 1e-6;
    let lengths: Vec<f64> = columns.iter().map(DVector::norm).collect();
    let unit: Vec<usize> = (0..columns.len()).filter(|&k| lengths[k] > 0.0).collect();
    let matrix =
        Mat::from_fn(length, unit.len(), |row, k| columns[unit[k]][row] / lengths[unit[k]]);
    let decomposition = matrix.col_piv_qr();
    let (basis, triangle) = (decomposition.compute_thin_Q(), decomposition.thin_R());
    let sizes = (0..length.min(unit.len())).map(|k| triangle[(k, k)].abs());
    let rank = sizes.take_while(|size| *size > MIN_INDEPENDENT).count();
    DMatrix::from_fn(length, rank, |row, k| basis[(row, k)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_basis_spans_its_columns_and_no_more() {
        let value = |row: usize, k: usize| real((7 * row + 3 * k * k) % 11) - 5.0;
        let column = |k: usize| DVector::from_fn(60, |row, _| value(row, k));
        let [first, second] = [column(0), column(1)];
        let columns =
            [1e-3 * &first, 1e4 * &second, &first - 2.0 * &second, DVector::zeros(60), column(2)];
        let basis = orthonormal_basis(&columns, 60);
        assert_eq!(basis.ncols(), 3);
        assert!((basis.tr_mul(&basis) - DMatrix::identity(3, 3)).amax() < 1e-12);
        for column in &columns {
            let left = column - &basis * basis.tr_mul(column);
            assert!(left.norm() <= 1e-12 * column.norm());
        }
        assert_eq!(orthonormal_basis(&[], 60).ncols(), 0);
    }
}
