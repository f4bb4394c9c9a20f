//! How residuals are measured.

use crate::evidence::Evidence;
use crate::normal::{Columns, Normal};
use nalgebra::Vector3;
use trackdyn_recording::robust::NORMAL_FROM_MAD;

/// Length of a whitened residual from which on it counts linearly: 1 % of normal residuals are longer.
const FAR: f64 = 3.4;

/// How residuals are measured: what part of the evidence counts, and in which scale.
#[derive(Clone, Debug)]
pub struct Metric {
    /// By what the whitened residuals of each channel are larger than the noise says.
    pub scale: [f64; 3],
    /// Whether each run counts.
    pub runs: Vec<bool>,
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

    /// The weight of each sample: one near, less far out, none where its run does not count.
    pub fn weights(&self, evidence: &Evidence, residual: &[Vector3<f64>]) -> Vec<f64> {
        let samples = evidence.samples().iter().zip(residual);
        samples
            .map(|(sample, z)| {
                if !self.runs[sample.run] {
                    return 0.0;
                }
                let length = z.norm();
                if length > FAR { FAR / length } else { 1.0 }
            })
            .collect()
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
            weights: &self.weights(evidence, residual),
            blocks: &blocks,
            count: evidence.blocks(),
        })
    }

    /// By what the residuals of each channel are larger than this metric takes them to be, from their
    /// medians: one where nothing is left but noise.
    pub fn residual_scale(&self, evidence: &Evidence, residual: &[Vector3<f64>]) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let samples = evidence.samples().iter().zip(residual).enumerate();
            let mut sizes: Vec<f64> = samples
                .filter(|(index, (sample, _))| {
                    self.runs[sample.run] && evidence.is_measured(*index, channel)
                })
                .map(|(_, (_, z))| z[channel].abs() * self.scale[channel])
                .collect();
            sizes.sort_by(f64::total_cmp);
            sizes.get(sizes.len() / 2).map_or(1.0, |median| NORMAL_FROM_MAD * median)
        })
    }

    /// Twice the robust loss.
    pub fn loss(&self, evidence: &Evidence, residual: &[Vector3<f64>]) -> f64 {
        let samples = evidence.samples().iter().zip(residual);
        samples
            .filter(|(sample, _)| self.runs[sample.run])
            .map(|(_, z)| {
                let length = z.norm();
                if length > FAR { FAR * (2.0 * length - FAR) } else { length * length }
            })
            .sum()
    }
}
