//! Evidence with the noise model that whitens its residuals.

mod starts;

use crate::equations::Column;
use crate::evidence::{Evidence, Origin, Sample};
use crate::normal::{Columns, Normal, Prior};
use nalgebra::{Matrix3, Vector3};
use starts::Starts;
use std::ops::Deref;
use std::sync::Arc;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_core::{Pose, Twist};
use trackdyn_estimate::gauss_newton::Huber;
use trackdyn_estimate::weighting::{Seen, SegmentNoise, Stretch, Weighting, Whitener, about_poses};

/// Evidence with the noise that weighs its residuals, and without the samples marked lost. It
/// dereferences to [`Evidence`], which is shared: a copy with other noise copies no samples.
#[derive(Clone)]
pub struct Weighted {
    evidence: Arc<Evidence>,
    whitening: Whitening,
    /// Factor by which whitened residuals of each channel exceed the noise model.
    scale: [f64; 3],
}

impl Deref for Weighted {
    type Target = Evidence;

    fn deref(&self) -> &Evidence {
        &self.evidence
    }
}

/// How residuals become white: unit variance, no correlation.
#[derive(Clone)]
enum Whitening {
    /// Segments of a drive: neighbours share a noisy pose, so their errors correlate.
    Segments(Segments, Arc<Whitener>, Option<Arc<Starts>>),
    /// Independent points: inverse standard deviation of each channel; zero where not measured.
    Points(Arc<[Vector3<f64>]>),
}

/// Mean of u uᵀ about the first and about the last pose of each sample, u the twist of the body
/// along its axes there: forward (m/s), left (m/s), yaw (rad/s). An error of a pose's stamp
/// displaces it along the twist.
type Twists = Arc<[[Matrix3<f64>; 2]]>;

/// What the whitening of segments depends on beside the samples.
#[derive(Clone)]
struct Segments {
    noise: SegmentNoise,
    /// Which segments are lost: they have no weight and share no pose with their neighbours.
    lost: Arc<[bool]>,
    twists: Twists,
    /// Change of each sample by each axis of the twist with which its run begins, times the prior
    /// deviation of that axis; none where all runs begin in stationary motion.
    by_starts: Option<Arc<[Column; 3]>>,
}

impl Segments {
    /// What the noise of each sample depends on.
    fn motions<'a>(&'a self, samples: &'a [Sample]) -> impl Iterator<Item = Seen> + use<'a> {
        let Self { lost, twists, .. } = self;
        samples.iter().enumerate().map(|(index, sample)| Seen {
            motion: sample.motion.into(),
            duration: sample.duration,
            run: sample.run,
            twists: twists[index],
            has_place: sample.has_place,
            is_lost: lost[index],
            follows: sample.follows && !(index > 0 && lost[index - 1]),
        })
    }

    /// The whitening of these samples.
    fn whitening(self, samples: &[Sample]) -> Whitening {
        let weighting = Weighting::Noise(self.noise);
        let whitener = Arc::new(Whitener::of_motions(&weighting, self.motions(samples)));
        let starts = self.by_starts.as_ref().map(|columns| {
            let white = columns.each_ref().map(|column| {
                let mut column = column.clone();
                self.by_noise(&whitener, &mut column);
                column
            });
            Arc::new(Starts::new(samples, &white))
        });
        Whitening::Segments(self, whitener, starts)
    }

    /// Whitens a column by the noise alone, in place: lost samples tell nothing.
    fn by_noise(&self, whitener: &Whitener, column: &mut [Vector3<f64>]) {
        self.lose(column);
        whitener.whiten(column);
        self.lose(column);
    }

    /// Clears a column where samples are lost, in place.
    fn lose(&self, column: &mut [Vector3<f64>]) {
        for (value, _) in column.iter_mut().zip(&*self.lost).filter(|(_, lost)| **lost) {
            *value = Vector3::zeros();
        }
    }
}

impl Weighted {
    /// Evidence with all samples and the noise that was measured without a model. Until a model
    /// predicts the motion ([`Weighted::moving_as`]), errors of stamps displace poses along the
    /// observed one.
    pub fn new(evidence: impl Into<Arc<Evidence>>) -> Self {
        let evidence = evidence.into();
        let whitening = match evidence.origin() {
            Origin::Drive(noise) => {
                let samples = evidence.samples();
                let observed: Vec<_> = samples.iter().map(|sample| sample.motion).collect();
                let twists = twists(&evidence, &observed);
                let lost = none_lost(samples);
                Segments { noise: *noise, lost, twists, by_starts: None }.whitening(samples)
            }
            Origin::SteadyPoints(inverse) => Whitening::Points(Arc::clone(inverse)),
        };
        Self { evidence, whitening, scale: [1.0; 3] }
    }

    /// Noise of the segments of a recording; none for a table.
    pub fn noise(&self) -> Option<&SegmentNoise> {
        match &self.whitening {
            Whitening::Segments(segments, ..) => Some(&segments.noise),
            Whitening::Points(_) => None,
        }
    }

    /// What the noise of each sample of a drive depends on; none for a table.
    pub fn motions(&self) -> Vec<Seen> {
        match &self.whitening {
            Whitening::Segments(segments, ..) => segments.motions(self.samples()).collect(),
            Whitening::Points(_) => Vec::new(),
        }
    }

    /// The evidence with another noise; a table stays as it is.
    pub fn with_noise(&self, noise: SegmentNoise) -> Self {
        self.with_segments(|segments| segments.noise = noise)
    }

    /// The evidence in which errors of stamps displace poses along the motion that is predicted for
    /// each sample; a table stays as it is.
    pub fn moving_as(&self, prediction: &[Vector3<f64>]) -> Self {
        self.with_segments(|segments| segments.twists = twists(self, prediction))
    }

    /// The evidence that allows for a change of each sample by each axis of the twist with which
    /// its run begins, times its prior deviation.
    pub fn allowing_for_starts(&self, by_starts: [Column; 3]) -> Self {
        self.with_segments(|segments| segments.by_starts = Some(Arc::new(by_starts)))
    }

    /// ln of the density that unknown beginnings of the runs cost; zero where they are known.
    pub fn ln_determinant_of_starts(&self) -> f64 {
        match &self.whitening {
            Whitening::Segments(.., Some(starts)) => starts.ln_determinant(),
            Whitening::Segments(.., None) | Whitening::Points(_) => 0.0,
        }
    }

    /// The evidence with another noise and all segments, lost ones restored; a table stays as it
    /// is.
    pub fn with_all_in(&self, noise: SegmentNoise) -> Self {
        self.with_segments(|segments| {
            segments.noise = noise;
            segments.lost = none_lost(self.samples());
        })
    }

    /// The evidence with these segments marked lost, too; a table stays as it is.
    pub fn without(&self, samples: &[usize]) -> Self {
        self.with_segments(|segments| {
            let mut lost = segments.lost.to_vec();
            for &sample in samples {
                lost[sample] = true;
            }
            segments.lost = lost.into();
        })
    }

    /// The evidence after a change of what its whitening depends on; a table stays as it is.
    fn with_segments(&self, change: impl FnOnce(&mut Segments)) -> Self {
        let Whitening::Segments(segments, ..) = &self.whitening else { return self.clone() };
        let mut segments = segments.clone();
        change(&mut segments);
        Self { whitening: segments.whitening(self.samples()), ..self.clone() }
    }

    /// Other runs of the recording, with the noise and scale of these.
    pub fn weigh(&self, others: &Evidence) -> Self {
        let others = Self { scale: self.scale, ..Self::new(others.clone()) };
        match self.noise() {
            Some(noise) => others.with_noise(*noise),
            None => others,
        }
    }

    /// The evidence with whitened residuals of each channel divided by `scale`.
    pub fn with_scale(&self, scale: [f64; 3]) -> Self {
        Self { scale, ..self.clone() }
    }

    /// Factor by which whitened residuals of each channel are divided, since they exceed the noise.
    pub fn scale(&self) -> [f64; 3] {
        self.scale
    }

    /// The samples with other encoder readings and the present weights.
    pub fn with_readings(&self, other: impl FnOnce(&Evidence) -> Evidence) -> Self {
        Self { evidence: Arc::new(other(&self.evidence)), ..self.clone() }
    }

    /// Whitens a column of residuals or derivatives in place: unit variance, no correlation.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments(segments, whitener, starts) => {
                segments.by_noise(whitener, column);
                if let Some(starts) = starts {
                    starts.whiten(column);
                }
            }
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse.iter()) {
                    value.component_mul_assign(inverse);
                }
            }
        }
    }

    /// Multiplies a column by the transpose of [`Weighted::whiten`], in place.
    pub fn whiten_transposed(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments(segments, whitener, starts) => {
                // what starts do is symmetric
                if let Some(starts) = starts {
                    starts.whiten(column);
                }
                whitener.whiten_transposed(column);
                segments.lose(column);
            }
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse.iter()) {
                    value.component_mul_assign(inverse);
                }
            }
        }
    }

    /// A column of residuals or derivatives, whitened and scaled.
    pub fn white(&self, mut column: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
        self.whiten(&mut column);
        let inverse = Vector3::from(self.scale.map(f64::recip));
        for value in &mut column {
            value.component_mul_assign(&inverse);
        }
        column
    }

    /// The error that the yaw of all samples shares, whitened and scaled, with the prior of its
    /// factor: the scale of the gyroscope that corrects it.
    pub fn shared_error(&self) -> Option<(Column, Prior)> {
        let known = self.serving_gyroscope()?.scale_deviation;
        let turned = self.samples().iter().map(|sample| Vector3::new(0.0, 0.0, sample.motion[2]));
        Some((self.white(turned.collect()), Prior::normal(0.0, known)))
    }

    /// A whitened and scaled column as it was before: the inverse of [`Weighted::white`].
    pub fn raw(&self, mut column: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
        let scale = Vector3::from(self.scale);
        for value in &mut column {
            value.component_mul_assign(&scale);
        }
        self.colour(&mut column);
        column
    }

    /// Whitened and scaled residual, observed minus predicted.
    pub fn residual(&self, prediction: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let samples = self.samples().iter().zip(prediction);
        self.white(samples.map(|(sample, motion)| sample.motion - motion).collect())
    }

    /// Normal equations of whitened residual and columns, summed by blocks.
    pub fn normal(&self, residual: &[Vector3<f64>], columns: &[Vec<Vector3<f64>>]) -> Normal {
        let blocks: Vec<usize> = self.samples().iter().map(|sample| sample.block).collect();
        let (weights, count) = (&self.weights(residual), self.blocks());
        Normal::new(&Columns { residual, columns, weights, blocks: &blocks, count })
    }

    /// Huber weight of each sample of a whitened residual.
    pub fn weights(&self, residual: &[Vector3<f64>]) -> Vec<f64> {
        let huber = self.huber();
        residual.iter().map(|sample| huber.weight(sample.norm())).collect()
    }

    /// Twice the Huber loss of a whitened residual.
    pub fn loss(&self, residual: &[Vector3<f64>]) -> f64 {
        let huber = self.huber();
        residual.iter().map(|sample| huber.value(sample.norm())).sum()
    }

    /// Huber's loss of the norm of a whitened residual.
    fn huber(&self) -> Huber {
        Huber { threshold: self.settings().evidence.huber_threshold }
    }

    /// Ratio of residual to modelled noise for each channel, by the median absolute residual: one
    /// where only noise is left.
    pub fn residual_scale(&self, residual: &[Vector3<f64>]) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let measured = residual.iter().enumerate();
            let measured = measured.filter(|(index, _)| self.is_measured(*index, channel));
            let mut values: Vec<f64> =
                measured.map(|(_, z)| z[channel] * self.scale[channel]).collect();
            deviation_about_zero(&mut values).unwrap_or(1.0)
        })
    }

    /// The evidence with residuals scaled down to the noise; none where they do not exceed it by
    /// more than they did.
    pub fn rescaled(&self, residual: &[Vector3<f64>]) -> Option<Self> {
        let scale = self.residual_scale(residual).map(|scale| scale.max(1.0));
        let most = self.settings().noise.max_residual_scale;
        let grows = scale.iter().zip(&self.scale).any(|(scale, present)| *scale > most * present);
        grows.then(|| self.with_scale(scale))
    }

    /// Colours a white column in place: the inverse of [`Weighted::whiten`].
    pub fn colour(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments(_, whitener, starts) => {
                if let Some(starts) = starts {
                    starts.colour(column);
                }
                whitener.colour(column);
            }
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse.iter()) {
                    value.component_div_assign(&inverse.map(|i| if i > 0.0 { i } else { 1.0 }));
                }
            }
        }
    }

    /// Log determinant of the whitening of each sample, given those before it; none for a table.
    pub fn ln_determinants(&self) -> Vec<f64> {
        match &self.whitening {
            Whitening::Segments(_, whitener, _) => whitener.ln_determinants().collect(),
            Whitening::Points(_) => Vec::new(),
        }
    }

    /// Number of measured values: up to three for each sample.
    pub fn measured(&self) -> usize {
        let is_measured =
            |sample| (0..3).filter(|&channel| self.is_measured(sample, channel)).count();
        (0..self.samples().len()).map(is_measured).sum()
    }

    /// Whether all samples that are lost here are lost in other evidence, too.
    pub fn lost_are_lost(&self, other: &Self) -> bool {
        (0..self.samples().len()).all(|sample| {
            (0..3).all(|channel| {
                self.is_measured(sample, channel) || !other.is_measured(sample, channel)
            })
        })
    }

    /// Whether a channel of a sample was measured.
    pub fn is_measured(&self, sample: usize, channel: usize) -> bool {
        match &self.whitening {
            Whitening::Segments(segments, ..) => {
                let is_seen = channel == 2 || self.samples()[sample].has_place[1];
                is_seen && !segments.lost[sample]
            }
            Whitening::Points(inverse) => inverse[sample][channel] > 0.0,
        }
    }
}

/// No sample lost.
fn none_lost(samples: &[Sample]) -> Arc<[bool]> {
    vec![false; samples.len()].into()
}

/// Twists about the poses of samples that move as predicted. An error of a stamp does not turn a
/// pose whose yaw is a gyroscope's.
fn twists(evidence: &Evidence, prediction: &[Vector3<f64>]) -> Twists {
    let turns = if evidence.serving_gyroscope().is_some() { 0.0 } else { 1.0 };
    let within: Vec<Stretch> = (evidence.samples().iter().zip(prediction))
        .map(|(sample, motion)| {
            let Twist { v_x, v_y, w } =
                Pose::new(motion[0], motion[1], motion[2]).log(sample.duration);
            let w = turns * w;
            Stretch { twists: [[v_x, v_y, w]; 2], follows: sample.follows }
        })
        .collect();
    about_poses(&within).into()
}
