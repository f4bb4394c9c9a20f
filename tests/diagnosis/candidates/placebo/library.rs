//! The family: what is free, the signatures of the catalogue, and placebos.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::f64::consts::TAU;
use trackdyn_core::real;
use trackdyn_diagnose::base::Base;
use trackdyn_diagnose::candidate::{Beside, variants};
use trackdyn_diagnose::evidence::{Evidence, Sample};
use trackdyn_diagnose::locate::{IcrColumns, icr_columns};
use trackdyn_diagnose::normal::{Normal, Prior};
use trackdyn_diagnose::prior::priors;
use trackdyn_diagnose::progress::Watch;
use trackdyn_diagnose::{Settings, Weighted};
use trackdyn_estimate::synthetic::{Synthetic, random_steps};
use trackdyn_model::{EffectId, VehicleFile};

/// Placebos in a library.
pub const PLACEBOS: usize = 20;

/// A size that a roboticist may meet: of a change of an ICR, m, and of a speed or yaw rate, m/s or
/// rad/s.
const TYPICAL_SIZES: [f64; 2] = [0.03, 0.02];

/// Whitened columns of a family of candidates on one recording.
pub struct Library {
    /// The recording.
    pub evidence: Weighted,
    /// What is free in every hypothesis.
    pub base: Vec<Vec<Vector3<f64>>>,
    /// The signatures of the catalogue.
    pub candidates: Vec<Vec<Vector3<f64>>>,
    /// Those that belong together: the sizes of a variant.
    pub groups: Vec<Vec<usize>>,
    /// The placebos, per typical size.
    pub placebos: Vec<Vec<Vector3<f64>>>,
    known: Vec<Prior>,
}

impl Library {
    /// A drive of nine runs with constant ICRs, and the placebos of a seed.
    pub fn new(seed: u64) -> Self {
        let synthetic = Synthetic {
            schedules: (0..9).map(|run| random_steps(14, 1.98, 0.8, 900 + run)).collect(),
            track_interval: 0.03,
            pose_interval: 0.09,
            encoder_noise: 0.02,
            position_noise: 0.002,
            yaw_noise: 0.002,
            seed: 9,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let file = VehicleFile::auriga_alpha();
        let evidence = Evidence::of_recording(&recording, file.vehicle.gauge, &Settings::default())
            .expect("enough");
        let evidence = Weighted::new(evidence);
        let base = Base::new(&file, &evidence, &Watch::none());
        let Base { fit, instruments, .. } = base.expect("not cancelled");
        let tried: Vec<_> = EffectId::all()
            .filter(|effect| !instruments.contains(effect))
            .flat_map(|effect| variants(effect, &evidence))
            .collect();
        let entries = Beside::new(&fit.hypothesis, &evidence).signatures(&tried);
        let (mut candidates, mut groups) = (Vec::new(), Vec::new());
        for (_, signatures) in entries {
            let first = candidates.len();
            candidates.extend(signatures.into_iter().map(|signature| signature.column));
            groups.push((first..candidates.len()).collect());
        }
        let icrs = icr_columns(&evidence, &fit);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let placebos = (0..PLACEBOS).map(|place| {
            let column = placebo(place, &evidence, &icrs, &mut random);
            evidence.white(column)
        });
        let placebos = placebos.collect();
        let known = priors(&fit.hypothesis, &fit.unknowns, &evidence);
        Self { base: fit.columns, candidates, groups, placebos, known, evidence }
    }

    /// The normal equations of a residual that is scaled by this, with the base and more columns
    /// that are not.
    pub fn normal(
        &self,
        scale: [f64; 3],
        residual: &[Vector3<f64>],
        more: &[Vec<Vector3<f64>>],
    ) -> Normal {
        let scale = Vector3::from(scale);
        let scaled = |column: &Vec<Vector3<f64>>| -> Vec<Vector3<f64>> {
            column.iter().map(|value| value.component_div(&scale)).collect()
        };
        let columns: Vec<Vec<Vector3<f64>>> = self.base.iter().chain(more).map(scaled).collect();
        self.evidence.normal(residual, &columns)
    }

    /// What is known of the base and of so many columns more, of three typical sizes each.
    pub fn priors(&self, more: usize) -> Vec<Prior> {
        let size = Prior::normal(0.0, 3.0);
        let base = self.known.iter().map(|known| Prior { mean: 0.0, ..*known });
        base.chain(std::iter::repeat_n(size, more)).collect()
    }
}

/// A random smooth function of how, where and when the robot was driven, at its typical size: a
/// change of an ICR, or of a component of the twist.
fn placebo(
    place: usize,
    evidence: &Evidence,
    icrs: &IcrColumns,
    random: &mut ChaCha8Rng,
) -> Vec<Vector3<f64>> {
    let smooth = Smooth::new(place % 5, evidence, random);
    let changes = random.random_range(0..6_usize);
    let samples = evidence.samples().iter().enumerate();
    samples
        .map(|(index, sample)| {
            let value = smooth.at(sample);
            match changes {
                icr @ 0..3 => icrs[icr][index] * (TYPICAL_SIZES[0] * value),
                channel => {
                    let unit = |k: usize, _| if k == channel - 3 { 1.0 } else { 0.0 };
                    Vector3::from_fn(unit) * (TYPICAL_SIZES[1] * value * sample.duration)
                }
            }
        })
        .collect()
}

/// A sum of three waves over some arguments, each of at most one period over the range of the
/// recording.
struct Smooth {
    arguments: fn(&Sample) -> [f64; 2],
    scale: [f64; 2],
    waves: [[f64; 4]; 3],
}

impl Smooth {
    fn new(kind: usize, evidence: &Evidence, random: &mut ChaCha8Rng) -> Self {
        let arguments: fn(&Sample) -> [f64; 2] = match kind {
            0 => |sample| [sample.speeds.left, sample.speeds.right],
            1 => |sample| [sample.pose.yaw.cos(), sample.pose.yaw.sin()],
            2 => |sample| [sample.pose.x, sample.pose.y],
            3 => |sample| [sample.start, real(sample.run)],
            _ => |sample| [sample.acceleration.left, sample.acceleration.right],
        };
        let widest = |k: usize| {
            let values = evidence.samples().iter().map(|sample| arguments(sample)[k].abs());
            values.fold(f64::MIN_POSITIVE, f64::max)
        };
        let waves = [0; 3].map(|_| {
            let wave = [0; 2].map(|_| TAU / 2.0 * (2.0 * random.random::<f64>() - 1.0));
            [wave[0], wave[1], TAU * random.random::<f64>(), random.sample(StandardNormal)]
        });
        Self { arguments, scale: [widest(0), widest(1)], waves }
    }

    fn at(&self, sample: &Sample) -> f64 {
        let [a, b] = (self.arguments)(sample);
        let (a, b) = (a / self.scale[0], b / self.scale[1]);
        self.waves.iter().map(|[p, q, phase, size]| size * (p * a + q * b + phase).cos()).sum()
    }
}
