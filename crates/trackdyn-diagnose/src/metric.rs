//! How residuals are measured.

use crate::evidence::Evidence;
use crate::normal::{Columns, Normal};
use nalgebra::Vector3;
use trackdyn_recording::robust::NORMAL_FROM_MAD;

/// Length of a whitened residual from which on it counts linearly: 1 % of normal residuals are longer.
const FAR: f64 = 3.4;

/// How residuals are measured.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// By what the whitened residuals of each channel are larger than the noise says.
    pub scale: [f64; 3],
}

impl Default for Metric {
    /// That of the noise as it is.
    fn default() -> Self {
        Self { scale: [1.0; 3] }
    }
}

impl Metric {
    /// The residual column of a prediction.
    pub fn residual(&self, evidence: &Evidence, prediction: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let samples = evidence.samples().iter().zip(prediction);
        self.white(evidence, samples.map(|(sample, motion)| sample.motion - motion).collect())
    }

    /// A column, whitened and scaled.
    pub fn white(&self, evidence: &Evidence, mut column: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
        evidence.whiten(&mut column);
        let inverse = Vector3::from(self.scale.map(f64::recip));
        for value in &mut column {
            value.component_mul_assign(&inverse);
        }
        column
    }

    /// The weight of each sample: one near, less far out.
    pub fn weights(residual: &[Vector3<f64>]) -> Vec<f64> {
        let lengths = residual.iter().map(Vector3::norm);
        lengths.map(|length| if length > FAR { FAR / length } else { 1.0 }).collect()
    }

    /// The normal equations of whitened residuals and columns, by the evidence's blocks.
    pub fn normal(
        &self,
        evidence: &Evidence,
        residual: &[Vector3<f64>],
        columns: &[Vec<Vector3<f64>>],
    ) -> Normal {
        let blocks: Vec<usize> = evidence.samples().iter().map(|sample| sample.block).collect();
        Normal::new(&Columns {
            residual,
            columns,
            weights: &Self::weights(residual),
            blocks: &blocks,
            count: evidence.blocks(),
        })
    }

    /// By what the residuals of each channel are larger than this metric takes them to be, from their
    /// medians: one where nothing is left but noise.
    pub fn residual_scale(&self, evidence: &Evidence, residual: &[Vector3<f64>]) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let measured = residual.iter().enumerate();
            let measured = measured.filter(|(index, _)| evidence.is_measured(*index, channel));
            let mut sizes: Vec<f64> =
                measured.map(|(_, z)| z[channel].abs() * self.scale[channel]).collect();
            sizes.sort_by(f64::total_cmp);
            sizes.get(sizes.len() / 2).map_or(1.0, |median| NORMAL_FROM_MAD * median)
        })
    }

    /// Twice the robust loss.
    pub fn loss(residual: &[Vector3<f64>]) -> f64 {
        let lengths = residual.iter().map(Vector3::norm);
        lengths
            .map(|length| if length > FAR { FAR * (2.0 * length - FAR) } else { length * length })
            .sum()
    }
}
