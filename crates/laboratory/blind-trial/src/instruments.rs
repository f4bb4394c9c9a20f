//! The instruments of a case: how good they are, and what the recording says of that.

use crate::difficulty::Difficulty;
use crate::dose;
use crate::ground::Driven;
use crate::machine::Machine;
use crate::random::{happens, log_uniform, normal, sign, uniform};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::rounding::Digits;
use trackdyn_drive::sensors::{PoseFrame, Preset, Sensors, Walk};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_recording::StatedNoise;
use trackdyn_second_simulator::sheet::{InstrumentError, Role, Trial};
use trackdyn_second_simulator::{ActiveMechanism, MECHANISMS, Sheet};

/// Sensors, their mounting, and what is said of them.
#[derive(Clone, Debug)]
pub(crate) struct Instruments {
    /// The sensors.
    pub(crate) sensors: Sensors,
    /// Errors that are mechanisms of the catalogue: mount, scale, clock, drift.
    pub(crate) errors: Vec<ActiveMechanism>,
    /// What the recording states: all do, for a line more would tell a recording from others.
    pub(crate) stated: StatedNoise,
}

impl Instruments {
    /// Sensors of a preset with noise of 0.6 to 1.6 times it. `difficulty` is that of a hard null,
    /// beside small errors of other instruments; a plain null has perfect mounts and clocks.
    pub(crate) fn draw(
        difficulty: Option<Difficulty>,
        is_plain: bool,
        machine: &Machine,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let preset = if happens(random, 0.65) { Preset::Laboratory } else { Preset::Field };
        let mut sensors = preset.sensors();
        sensors.imu = None;
        // places and headings must be those of one world
        sensors.pose.frame = PoseFrame::World;
        let factor = log_uniform(random, 0.6, 1.6);
        let pose = &mut sensors.pose;
        pose.white.position *= factor;
        pose.white.yaw *= factor;
        pose.walk.position *= factor;
        pose.walk.yaw *= factor;
        // what is written down of a walk, and what the oracle whitens by, has no memory
        pose.walk.memory = None;
        if is_plain {
            sensors.pose.delay -= sensors.clock_offset();
        }
        let pose = &mut sensors.pose;
        let mut errors = Vec::new();
        let mut stated = StatedNoise { position: pose.white.position, yaw: pose.white.yaw };
        match difficulty {
            Some(Difficulty::NoiseStatement) => {
                let factor = 2.0_f64.powf(sign(random));
                stated =
                    StatedNoise { position: stated.position * factor, yaw: stated.yaw * factor };
            }
            Some(Difficulty::Outliers) => {
                pose.outlier.share = uniform(random, 0.02, 0.05);
                let size = uniform(random, 10.0, 40.0);
                pose.outlier.position = size * pose.white.position;
                pose.outlier.yaw = size * pose.white.yaw;
            }
            Some(Difficulty::ColouredNoise) => {
                let memory = log_uniform(random, 0.5, 5.0);
                // a lasting standard deviation of one to three times the white one
                let size = uniform(random, 1.0, 3.0) * (2.0 / memory).sqrt();
                pose.walk = Walk {
                    position: size * pose.white.position,
                    yaw: size * pose.white.yaw,
                    memory: Some(memory),
                };
            }
            Some(Difficulty::Instruments(_)) | None => {}
        }
        for (sheet, error) in instruments() {
            // drawn whether used or not, so that what follows does not depend on it
            let small = small_error(sheet, machine, random);
            let is_small = happens(random, error.small_share);
            let large = large_error(sheet, machine, random);
            if difficulty == Some(Difficulty::Instruments(error.large_in)) {
                errors.push(large);
            } else if is_small && !is_plain {
                errors.push(small);
            }
        }
        Self { sensors, errors, stated }
    }

    /// The noise that the recording truly has, for segments of a robot that moves like this with a
    /// distance `gap` (m) between the ICRs.
    ///
    /// # Law
    /// White noise of a pose, and what jitter of its stamp and of the encoders' makes of the
    /// speeds; travel is known to a tick, q²/12 at each end of a segment and each side; the walk
    /// per second.
    pub(crate) fn noise(&self, driven: &[Driven], gap: f64) -> SegmentNoise {
        let [speed, rate] = mean_squares(driven);
        let (pose, encoder) = (&self.sensors.pose, &self.sensors.encoder);
        let jitter = pose.jitter.powi(2) + encoder.jitter.powi(2);
        let tick = encoder.tick.powi(2) / 12.0;
        let (position, yaw) = (pose.white.position.powi(2), pose.white.yaw.powi(2));
        let walk = pose.walk.position.powi(2);
        SegmentNoise {
            pose: [
                position + speed * jitter + tick / 2.0,
                position,
                yaw + rate * jitter + 2.0 * tick / gap.powi(2),
            ],
            walk: [walk, walk, 0.0],
            heading: pose.walk.yaw.powi(2),
            stamp: 0.0,
        }
    }

    /// Share of the time in which poses are there.
    pub(crate) fn presence(&self) -> f64 {
        1.0 - self.sensors.pose.dropout.share
    }
}

/// Errors of instruments.
fn instruments() -> impl Iterator<Item = (&'static Sheet, InstrumentError)> {
    MECHANISMS.iter().filter_map(|sheet| match sheet.trial {
        Trial::Instrument(error) => Some((sheet, error)),
        Trial::Law(_) => None,
    })
}

/// An error as instruments of most cases have it, whether something is concealed or not.
fn small_error(
    sheet: &'static Sheet,
    machine: &Machine,
    random: &mut ChaCha8Rng,
) -> ActiveMechanism {
    reading(sheet, machine, |deviation, _| deviation * normal(random))
}

/// An error that a hard null consists of.
fn large_error(
    sheet: &'static Sheet,
    machine: &Machine,
    random: &mut ChaCha8Rng,
) -> ActiveMechanism {
    reading(sheet, machine, |_, [low, high]| sign(random) * uniform(random, low, high))
}

/// A mechanism whose readings are off by an error that is drawn by its standard deviation where it
/// is small, or by its limits where it is large.
fn reading(
    sheet: &'static Sheet,
    machine: &Machine,
    mut error: impl FnMut(f64, [f64; 2]) -> f64,
) -> ActiveMechanism {
    let values = sheet.parameters.iter().map(|parameter| {
        let scale = dose::of(machine, parameter.draw.scale);
        let value = match parameter.draw.role {
            Role::Reading { exact, small, large } => exact + scale * error(small, large),
            _ => parameter.typical,
        };
        (parameter.key, value)
    });
    mechanism(sheet.id, &values.collect::<Vec<_>>())
}

/// A mechanism whose parameters are in range.
///
/// # Panics
/// Where they are not.
pub(crate) fn mechanism(id: &str, settings: &[(&str, f64)]) -> ActiveMechanism {
    let round = |value: f64| Digits::Decimals(5).round(value);
    let settings: Vec<_> = settings.iter().map(|(key, value)| (*key, round(*value))).collect();
    ActiveMechanism::new(id, &settings).expect("keys of a sheet, and values within its ranges")
}

/// Mean squares of forward speed (m²/s²) and yaw rate (rad²/s²).
fn mean_squares(driven: &[Driven]) -> [f64; 2] {
    let (mut time, mut sums) = (0.0, [0.0; 2]);
    for run in driven {
        for pair in run.body.moments().windows(2) {
            let dt = pair[1].t - pair[0].t;
            time += dt;
            sums[0] += dt * pair[1].twist.v_x.powi(2);
            sums[1] += dt * pair[1].twist.w.powi(2);
        }
    }
    sums.map(|sum| if time > 0.0 { sum / time } else { 0.0 })
}
