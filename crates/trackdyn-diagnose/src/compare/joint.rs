//! Normal equations of two sets together.
//!
//! A number that both sets have has two columns: one in both sets, for what they share, and one in
//! the second set alone, for what it has more. All that is free in a set by itself has columns that
//! are zero in the other one.

use crate::equations::{Column, Equations, Stack};
use crate::normal::{Columns, Normal, Prior};
use crate::weighted::Weighted;
use nalgebra::{DVector, Vector3};

/// Two sets with their residuals and what is free in each by itself.
pub(super) struct Joint<'a> {
    evidence: [&'a Weighted; 2],
    /// Residuals of the fits, by which samples are weighed.
    residuals: [&'a [Vector3<f64>]; 2],
    /// Residuals with the part of what is compared added back.
    shifted: [Vec<Vector3<f64>>; 2],
    columns: Vec<Column>,
    priors: Vec<Prior>,
}

impl<'a> Joint<'a> {
    /// Two sets with their residuals.
    pub fn new(evidence: [&'a Weighted; 2], residuals: [&'a [Vector3<f64>]; 2]) -> Self {
        let shifted = residuals.map(<[_]>::to_vec);
        Self { evidence, residuals, shifted, columns: Vec::new(), priors: Vec::new() }
    }

    /// Adds a column that is free in one set by itself; its index.
    pub fn free_in(&mut self, set: usize, column: &[Vector3<f64>], prior: Prior) -> usize {
        self.push(self.alone(set, column), prior)
    }

    /// Adds a column that both sets share; its index.
    pub fn free_in_both(&mut self, columns: [&[Vector3<f64>]; 2], prior: Prior) -> usize {
        self.push(columns.concat(), prior)
    }

    fn push(&mut self, column: Column, prior: Prior) -> usize {
        self.columns.push(column);
        self.priors.push(prior);
        self.columns.len() - 1
    }

    /// Factors of all columns, by their indices; those that would cross a bound stay zero.
    /// `crosses` says so of a column and its factor.
    pub fn factors(&self, crosses: impl Fn(usize, f64) -> bool) -> DVector<f64> {
        let equations = self.equations(Vec::new());
        let mut free = equations.free.clone();
        loop {
            let solution = equations.normal.fit(&free, &equations.priors);
            let steps = || free.iter().zip(solution.estimate.iter());
            let Some(place) = steps().position(|(&column, &by)| crosses(column, by)) else {
                let mut factors = DVector::zeros(self.columns.len());
                for (&column, &by) in steps() {
                    factors[column] = by;
                }
                return factors;
            };
            free.remove(place);
        }
    }

    /// Adds a part of the prediction of a set back to its residual.
    pub fn add_back(&mut self, set: usize, column: &[Vector3<f64>], factor: f64) {
        for (value, by) in self.shifted[set].iter_mut().zip(column) {
            *value += by * factor;
        }
    }

    /// A column of one set, zero in the other.
    pub fn alone(&self, set: usize, column: &[Vector3<f64>]) -> Column {
        let [first, second] = self.residuals.map(|residual| vec![Vector3::zeros(); residual.len()]);
        if set == 0 { [column, &second].concat() } else { [&first, column].concat() }
    }

    /// Normal equations of all that is free, and of groups of further columns.
    pub fn equations(&self, groups: Vec<Vec<(Column, Prior)>>) -> Equations {
        let mut stack = Stack::new(self.columns.clone(), self.priors.clone());
        for group in groups {
            stack.push(group);
        }
        stack.equations(|columns| self.normal(columns))
    }

    /// What is left of each residual after all that is free.
    pub fn left(&self) -> [Vec<Vector3<f64>>; 2] {
        let equations = self.equations(Vec::new());
        let solution = equations.fit_with(&[]);
        let mut left = self.shifted.concat();
        for (&column, by) in equations.free.iter().zip(solution.estimate.iter()) {
            for (value, of) in left.iter_mut().zip(&self.columns[column]) {
                *value -= of * *by;
            }
        }
        let second = left.split_off(self.residuals[0].len());
        [left, second]
    }

    fn normal(&self, columns: &[Column]) -> Normal {
        let of = |set: usize| self.evidence[set].weights(self.residuals[set]);
        let first = self.evidence[0].blocks();
        let blocks = |set: usize| {
            let samples = self.evidence[set].samples().iter();
            samples.map(move |sample| sample.block + set * first)
        };
        Normal::new(&Columns {
            residual: &self.shifted.concat(),
            columns,
            weights: &[of(0), of(1)].concat(),
            blocks: &blocks(0).chain(blocks(1)).collect::<Vec<_>>(),
            count: first + self.evidence[1].blocks(),
        })
    }
}
