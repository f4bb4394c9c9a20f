//! Normal equations of the free columns, with groups of further columns.

use crate::normal::{Normal, Prior, Solution};
use nalgebra::Vector3;
use std::ops::Range;

/// A whitened column.
pub type Column = Vec<Vector3<f64>>;

/// Square of the norm of a column.
pub fn square(column: &Column) -> f64 {
    column.iter().map(Vector3::norm_squared).sum()
}

/// The part of a column at right angles to another.
pub fn at_right_angles(mut column: Column, to: &Column) -> Column {
    let product: f64 = column.iter().zip(to).map(|(a, b)| a.dot(b)).sum();
    let factor = product / square(to).max(f64::MIN_POSITIVE);
    for (value, along) in column.iter_mut().zip(to) {
        *value -= along * factor;
    }
    column
}

/// Columns of a linear fit in one list: the free ones first, then groups of others.
#[derive(Clone, Debug, Default)]
pub struct Stack {
    /// The columns.
    pub columns: Vec<Column>,
    /// Prior of the factor of each column.
    pub priors: Vec<Prior>,
    groups: Vec<Range<usize>>,
}

impl Stack {
    /// A stack of the free columns.
    pub fn new(columns: Vec<Column>, priors: Vec<Prior>) -> Self {
        Self { columns, priors, groups: Vec::new() }
    }

    /// The stack with more free columns, before any group.
    pub fn with_free(mut self, columns: &[Column], priors: &[Prior]) -> Self {
        self.columns.extend_from_slice(columns);
        self.priors.extend_from_slice(priors);
        self
    }

    /// Appends a group of columns.
    pub fn push(&mut self, group: impl IntoIterator<Item = (Column, Prior)>) {
        let first = self.columns.len();
        for (column, prior) in group {
            self.columns.push(column);
            self.priors.push(prior);
        }
        self.groups.push(first..self.columns.len());
    }

    /// Normal equations of all columns, computed by `normal`.
    pub fn equations(self, normal: impl FnOnce(&[Column]) -> Normal) -> Equations {
        let first = self.groups.first().map_or(self.columns.len(), |group| group.start);
        Equations {
            normal: normal(&self.columns),
            priors: self.priors,
            free: (0..first).collect(),
            groups: self.groups.into_iter().map(Iterator::collect).collect(),
        }
    }
}

/// Normal equations of the free columns and of groups of further columns.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Products of all columns.
    pub normal: Normal,
    /// Prior of the factor of each column.
    pub priors: Vec<Prior>,
    /// Free columns.
    pub free: Vec<usize>,
    /// Columns of each group.
    pub groups: Vec<Vec<usize>>,
}

impl Equations {
    /// The equations with some of the free columns moved to a new group, the last one.
    pub fn with_group(self, columns: &[usize]) -> Self {
        let Self { normal, priors, mut free, mut groups } = self;
        free.retain(|column| !columns.contains(column));
        groups.push(columns.to_vec());
        Self { normal, priors, free, groups }
    }

    /// All other columns and the residual, with the free columns projected out.
    pub fn projected(&self) -> Normal {
        self.normal.projected(&self.free, &self.priors)
    }

    /// Fit of the free columns together with others.
    pub fn fit_with(&self, more: &[usize]) -> Solution {
        self.fit_of(&self.normal, more)
    }

    /// Fit of the free columns together with others, on reweighted blocks.
    pub fn fit_of(&self, counted: &Normal, more: &[usize]) -> Solution {
        let columns: Vec<usize> = self.free.iter().chain(more).copied().collect();
        counted.fit(&columns, &self.priors)
    }
}
