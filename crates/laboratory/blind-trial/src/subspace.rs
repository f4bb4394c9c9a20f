//! A space of whitened columns, by an orthonormal basis.

/// Columns of which less than this share is new add nothing.
const NEW: f64 = 1e-6;

/// What is spanned by the columns that were added.
#[derive(Clone, Debug, Default)]
pub(crate) struct Subspace {
    basis: Vec<Vec<f64>>,
}

impl Subspace {
    /// Adds a column.
    pub(crate) fn add(&mut self, mut column: Vec<f64>) {
        let before = norm(&column);
        self.remove_from(&mut column);
        let size = norm(&column);
        if size > NEW * before && size.is_finite() {
            for value in &mut column {
                *value /= size;
            }
            self.basis.push(column);
        }
    }

    /// The space with these columns as well.
    pub(crate) fn with(&self, columns: &[Vec<f64>]) -> Self {
        let mut space = self.clone();
        for column in columns {
            space.add(column.clone());
        }
        space
    }

    /// Takes away of a column what lies in the space; twice, for rounding.
    pub(crate) fn remove_from(&self, column: &mut [f64]) {
        for _ in 0..2 {
            for axis in &self.basis {
                let share: f64 = axis.iter().zip(column.iter()).map(|(a, b)| a * b).sum();
                column.iter_mut().zip(axis).for_each(|(value, axis)| *value -= share * axis);
            }
        }
    }

    /// Length of what is left of a column outside the space.
    pub(crate) fn outside(&self, column: &[f64]) -> f64 {
        let mut left = column.to_vec();
        self.remove_from(&mut left);
        norm(&left)
    }
}

/// Length of a column.
fn norm(column: &[f64]) -> f64 {
    column.iter().map(|value| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_perpendicular_and_what_is_spanned_is_gone() {
        let mut space = Subspace::default();
        space.add(vec![1.0, 1.0, 0.0, 0.0]);
        space.add(vec![1.0, 0.0, 1.0, 0.0]);
        space.add(vec![2.0, 1.0, 1.0, 0.0]);
        assert_eq!(space.basis.len(), 2);
        assert!(space.outside(&[5.0, 3.0, 2.0, 0.0]) < 1e-14);
        // (1, 0, 0, 2) leaves (1, −1, −1, 6)/3
        assert!((space.outside(&[1.0, 0.0, 0.0, 2.0]) - 39.0_f64.sqrt() / 3.0).abs() < 1e-14);
    }
}
