//! Normal equations of what is free, with groups of columns beside it.

use crate::normal::{Normal, Prior, Solution};
use nalgebra::Vector3;
use std::ops::Range;

/// A whitened column.
pub type Column = Vec<Vector3<f64>>;

/// Columns of a fit, that of what is free first and groups of others behind, in one list.
#[derive(Clone, Debug, Default)]
pub struct Stack {
    /// The columns.
    pub columns: Vec<Column>,
    /// What is known of the factor of each beforehand.
    pub priors: Vec<Prior>,
    groups: Vec<Range<usize>>,
}

impl Stack {
    /// The columns of what is free.
    pub fn new(columns: Vec<Column>, priors: Vec<Prior>) -> Self {
        Self { columns, priors, groups: Vec::new() }
    }

    /// Puts a group of columns behind.
    pub fn push(&mut self, group: impl IntoIterator<Item = (Column, Prior)>) {
        let first = self.columns.len();
        for (column, prior) in group {
            self.columns.push(column);
            self.priors.push(prior);
        }
        self.groups.push(first..self.columns.len());
    }

    /// Their normal equations, which `normal` makes of the columns.
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

/// Normal equations of what is free, and of groups of columns beside it.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Products of all columns.
    pub normal: Normal,
    /// What is known of the factor of each beforehand.
    pub priors: Vec<Prior>,
    /// Columns of what is free.
    pub free: Vec<usize>,
    /// Columns of each group.
    pub groups: Vec<Vec<usize>>,
}

impl Equations {
    /// The equations with some of the free columns as a group, the last one.
    pub fn with_group(self, columns: &[usize]) -> Self {
        let Self { normal, priors, mut free, mut groups } = self;
        free.retain(|column| !columns.contains(column));
        groups.push(columns.to_vec());
        Self { normal, priors, free, groups }
    }

    /// All columns and the residual with what is free projected out.
    pub fn projected(&self) -> Normal {
        self.normal.projected(&self.free, &self.priors)
    }

    /// The fit of what is free together with more columns.
    pub fn fit_with(&self, more: &[usize]) -> Solution {
        self.fit_of(&self.normal, more)
    }

    /// The fit of what is free together with more columns, where blocks count otherwise.
    pub fn fit_of(&self, counted: &Normal, more: &[usize]) -> Solution {
        let columns: Vec<usize> = self.free.iter().chain(more).copied().collect();
        counted.fit(&columns, &self.priors)
    }
}
