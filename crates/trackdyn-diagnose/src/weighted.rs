//! Evidence and what its residuals weigh.

use crate::evidence::{Evidence, Origin, Sample};
use crate::normal::{Columns, Normal};
use nalgebra::Vector3;
use std::ops::Deref;
use std::sync::Arc;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_estimate::gauss_newton::Huber;
use trackdyn_estimate::weighting::{Seen, SegmentNoise, Weighting, Whitener};

/// Evidence with the noise by which its residuals are weighed, and without the samples that are
/// lost. Whatever asks what was seen may ask this. The evidence is shared: another noise copies
/// none of it.
#[derive(Clone)]
pub struct Weighted {
    evidence: Arc<Evidence>,
    whitening: Whitening,
    /// By what the whitened residuals of each channel are larger than the noise says.
    scale: [f64; 3],
}

impl Deref for Weighted {
    type Target = Evidence;

    fn deref(&self) -> &Evidence {
        &self.evidence
    }
}

/// What makes residuals white: of unit variance and without correlation.
#[derive(Clone)]
enum Whitening {
    /// Neighbours share a noisy pose.
    Segments { noise: SegmentNoise, whitener: Arc<Whitener>, lost: Arc<[bool]> },
    /// Inverse standard deviations of the channels; zero where one was not measured.
    Points(Arc<[Vector3<f64>]>),
}

impl Whitening {
    /// That of segments in a noise. Those that are lost tell nothing, nor of their neighbours.
    fn of(noise: SegmentNoise, samples: &[Sample], lost: Arc<[bool]>) -> Self {
        let seen = samples.iter().enumerate().map(|(index, sample)| Seen {
            motion: sample.motion.into(),
            duration: sample.duration,
            run: sample.run,
            is_lost: lost[index],
            follows: sample.follows && !(index > 0 && lost[index - 1]),
        });
        let whitener = Arc::new(Whitener::of_motions(&Weighting::Noise(noise), seen));
        Self::Segments { noise, whitener, lost }
    }
}

impl Weighted {
    /// Evidence in the noise that was measured on it without a model, with all samples.
    pub fn new(evidence: impl Into<Arc<Evidence>>) -> Self {
        let evidence = evidence.into();
        let whitening = match evidence.origin() {
            Origin::Drive(noise) => {
                let all = vec![false; evidence.samples().len()];
                Whitening::of(*noise, evidence.samples(), all.into())
            }
            Origin::SteadyPoints(inverse) => Whitening::Points(Arc::clone(inverse)),
        };
        Self { evidence, whitening, scale: [1.0; 3] }
    }

    /// Noise of the segments of a recording; none of a table.
    pub fn noise(&self) -> Option<&SegmentNoise> {
        match &self.whitening {
            Whitening::Segments { noise, .. } => Some(noise),
            Whitening::Points(_) => None,
        }
    }

    /// The segments of a recording in another noise; points of a table as they are.
    pub fn with_noise(&self, noise: SegmentNoise) -> Self {
        let Whitening::Segments { lost, .. } = &self.whitening else { return self.clone() };
        let whitening = Whitening::of(noise, self.samples(), Arc::clone(lost));
        Self { whitening, ..self.clone() }
    }

    /// All segments of a recording, those that were lost among them, in another noise; points of a
    /// table as they are.
    pub fn with_all_in(&self, noise: SegmentNoise) -> Self {
        if matches!(self.whitening, Whitening::Points(_)) {
            return self.clone();
        }
        let all = vec![false; self.samples().len()];
        let whitening = Whitening::of(noise, self.samples(), all.into());
        Self { whitening, ..self.clone() }
    }

    /// The segments of a recording without some more of them; points of a table as they are.
    pub fn without(&self, samples: &[usize]) -> Self {
        let Whitening::Segments { noise, lost, .. } = &self.whitening else { return self.clone() };
        let mut lost = lost.to_vec();
        for &sample in samples {
            lost[sample] = true;
        }
        let whitening = Whitening::of(*noise, self.samples(), lost.into());
        Self { whitening, ..self.clone() }
    }

    /// What other runs of a recording show, in the noise and the scale of these.
    pub fn weigh(&self, others: &Evidence) -> Self {
        let others = Self { scale: self.scale, ..Self::new(others.clone()) };
        match self.noise() {
            Some(noise) => others.with_noise(*noise),
            None => others,
        }
    }

    /// The evidence with white residuals of each channel this much smaller: they are larger than
    /// the noise says.
    pub fn with_scale(&self, scale: [f64; 3]) -> Self {
        Self { scale, ..self.clone() }
    }

    /// By what the whitened residuals of each channel are taken to be larger than the noise says.
    pub fn scale(&self) -> [f64; 3] {
        self.scale
    }

    /// The samples with other readings of the encoders, weighed alike.
    pub fn with_readings(&self, other: impl FnOnce(&Evidence) -> Evidence) -> Self {
        Self { evidence: Arc::new(other(&self.evidence)), ..self.clone() }
    }

    /// Makes a column of residuals or of their derivatives white by the noise, in place: unit
    /// variance, no correlation.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments { whitener, lost, .. } => {
                for (value, _) in column.iter_mut().zip(lost.iter()).filter(|(_, lost)| **lost) {
                    *value = Vector3::zeros();
                }
                whitener.whiten(column);
                for (value, _) in column.iter_mut().zip(lost.iter()).filter(|(_, lost)| **lost) {
                    *value = Vector3::zeros();
                }
            }
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse.iter()) {
                    value.component_mul_assign(inverse);
                }
            }
        }
    }

    /// A column of residuals or of their derivatives, whitened and scaled.
    pub fn white(&self, mut column: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
        self.whiten(&mut column);
        let inverse = Vector3::from(self.scale.map(f64::recip));
        for value in &mut column {
            value.component_mul_assign(&inverse);
        }
        column
    }

    /// The white residual of a prediction.
    pub fn residual(&self, prediction: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let samples = self.samples().iter().zip(prediction);
        self.white(samples.map(|(sample, motion)| sample.motion - motion).collect())
    }

    /// The normal equations of a white residual and white columns, by blocks.
    pub fn normal(&self, residual: &[Vector3<f64>], columns: &[Vec<Vector3<f64>>]) -> Normal {
        let blocks: Vec<usize> = self.samples().iter().map(|sample| sample.block).collect();
        let (weights, count) = (&self.weights(residual), self.blocks());
        Normal::new(&Columns { residual, columns, weights, blocks: &blocks, count })
    }

    /// What each sample of a white residual weighs: less where it lies far out.
    pub fn weights(&self, residual: &[Vector3<f64>]) -> Vec<f64> {
        let huber = self.huber();
        residual.iter().map(|sample| huber.weight(sample.norm())).collect()
    }

    /// Twice the loss of a white residual.
    pub fn loss(&self, residual: &[Vector3<f64>]) -> f64 {
        let huber = self.huber();
        residual.iter().map(|sample| huber.value(sample.norm())).sum()
    }

    /// The loss of the length of a whitened residual.
    fn huber(&self) -> Huber {
        Huber { threshold: self.settings().evidence.huber_threshold }
    }

    /// By what a white residual is larger in each channel than the noise says, from its median: one
    /// where nothing is left but noise.
    pub fn residual_scale(&self, residual: &[Vector3<f64>]) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let measured = residual.iter().enumerate();
            let measured = measured.filter(|(index, _)| self.is_measured(*index, channel));
            let mut values: Vec<f64> =
                measured.map(|(_, z)| z[channel] * self.scale[channel]).collect();
            deviation_about_zero(&mut values).unwrap_or(1.0)
        })
    }

    /// Gives a white column the noise's correlations, in place: the inverse of
    /// [`Weighted::whiten`].
    pub fn colour(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments { whitener, .. } => whitener.colour(column),
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse.iter()) {
                    value.component_div_assign(&inverse.map(|i| if i > 0.0 { i } else { 1.0 }));
                }
            }
        }
    }

    /// Logarithms of the determinants of what whitens each sample, given those before it; none of a
    /// table.
    pub fn ln_determinants(&self) -> Vec<f64> {
        match &self.whitening {
            Whitening::Segments { whitener, .. } => whitener.ln_determinants().collect(),
            Whitening::Points(_) => Vec::new(),
        }
    }

    /// Numbers that were measured: of each sample up to three.
    pub fn measured(&self) -> usize {
        let is_measured =
            |sample| (0..3).filter(|&channel| self.is_measured(sample, channel)).count();
        (0..self.samples().len()).map(is_measured).sum()
    }

    /// Whether a channel of a sample was measured.
    pub fn is_measured(&self, sample: usize, channel: usize) -> bool {
        match &self.whitening {
            Whitening::Segments { lost, .. } => !lost[sample],
            Whitening::Points(inverse) => inverse[sample][channel] > 0.0,
        }
    }
}
