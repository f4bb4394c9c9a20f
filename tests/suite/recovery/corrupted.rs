//! A few bad readings do not move the parameters.

use crate::recovery::{drive, fit};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::sync::LazyLock;
use trackdyn_estimate::{Free, Interval};
use trackdyn_recording::{Recording, Run, Source, TrackSample, Warning};

/// Largest share of the readings that are wrong.
const MAX_BAD_SHARE: f64 = 0.02;

/// What can be wrong with a reading of one side.
#[derive(Clone, Copy, Debug)]
enum Fault {
    /// A speed that no wheel has.
    Spike,
    /// A counter that begins anew, or wraps: one difference of many radians.
    Restart,
    /// The sign of one reading.
    Flip,
    /// Half a second of zeros.
    Dead,
    /// Three seconds at the speed before.
    Stuck,
}

impl Fault {
    /// Those that may come in any number.
    const ALL: [Self; 4] = [Self::Spike, Self::Restart, Self::Flip, Self::Dead];

    /// How many readings it spoils.
    fn length(self) -> usize {
        match self {
            Self::Dead => 16,
            Self::Stuck => 100,
            Self::Spike | Self::Restart | Self::Flip => 1,
        }
    }

    fn apply(self, readings: &mut [TrackSample], side: usize, random: &mut ChaCha8Rng) {
        let first = readings[0].speeds();
        for reading in readings {
            let speed = if side == 0 { &mut reading.v_left } else { &mut reading.v_right };
            let sign = if random.random_bool(0.5) { 1.0 } else { -1.0 };
            *speed = match self {
                Self::Spike => sign * random.random_range(3.0..1000.0),
                Self::Restart => sign * 0.1 * random.random_range(20.0..4000.0) / 0.03,
                Self::Flip => -*speed,
                Self::Dead => 0.0,
                Self::Stuck if side == 0 => first.left,
                Self::Stuck => first.right,
            };
        }
    }
}

/// The recording with a random number of faults of these kinds.
fn corrupted(recording: &Recording, kinds: &[Fault], seed: u64) -> Recording {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let readings: usize = recording.runs().iter().map(|run| run.tracks().len()).sum();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share")]
    let most = (MAX_BAD_SHARE * trackdyn_core::real(readings)) as usize;
    let mut left = random.random_range(1..=most);
    let mut runs: Vec<_> = recording.runs().iter().cloned().map(Run::into_rows).collect();
    while left > 0 {
        let kind = kinds[random.random_range(0..kinds.len())];
        let length = kind.length().min(left);
        let run = random.random_range(0..runs.len());
        let tracks = &mut runs[run].tracks.samples;
        let first = random.random_range(0..tracks.len() - length);
        let side = random.random_range(0..2);
        kind.apply(&mut tracks[first..first + length], side, &mut random);
        left -= length;
    }
    Recording::new("hurt", "robot", runs, Source::computed(), Vec::new()).expect("usable")
}

/// Number of drives that are corrupted in turn.
const DRIVES: u64 = 20;

/// These drives, each with its x_r − x_l.
static WHOLE_DRIVES: LazyLock<Vec<(Recording, Interval)>> = LazyLock::new(|| {
    let whole = (0..DRIVES).into_par_iter().map(|seed| {
        let whole = drive(seed);
        let good = fit(&whole, Free::Icrs).expect("settles").gap();
        (whole, good)
    });
    whole.collect()
});

/// By how many standard errors x_r − x_l of a corrupted drive is off that of the whole one.
fn off(hurt: &Recording, good: &Interval) -> f64 {
    let hurt = fit(hurt, Free::Icrs).expect("settles").gap();
    (hurt.value - good.value).abs() / hurt.deviation.max(good.deviation)
}

/// By how many standard errors x_r − x_l moves, over this many logs: the largest and the mean.
fn moved(kinds: &[Fault], logs: u64) -> [f64; 2] {
    let cases: Vec<_> = (0..logs).zip(WHOLE_DRIVES.iter().cycle()).collect();
    let moved: Vec<f64> = cases
        .into_par_iter()
        .map(|(seed, (whole, good))| off(&corrupted(whole, kinds, seed), good))
        .collect();
    let mean = moved.iter().sum::<f64>() / trackdyn_core::real(moved.len());
    [moved.into_iter().fold(0.0, f64::max), mean]
}

#[test]
fn single_bad_readings_move_the_distance_by_less_than_its_standard_error() {
    for kind in [Fault::Spike, Fault::Restart, Fault::Flip] {
        let [largest, mean] = moved(&[kind], 170);
        println!("{kind:?}: largest {largest:.2}, mean {mean:.2} standard errors");
        assert!(largest < 1.0, "{kind:?}: {largest}");
    }
}

/// Half a second in which an encoder shows nothing looks like driving: the poses tell that it is
/// none.
#[test]
fn dead_stretches_move_the_distance_by_less_than_its_standard_error() {
    let [largest, mean] = moved(&Fault::ALL, 500);
    println!("all: largest {largest:.2}, mean {mean:.2} standard errors");
    assert!(largest < 1.0 && mean < 0.2, "{largest} {mean}");
}

/// An encoder that shows its last speed for three seconds.
#[test]
fn stuck_stretches_move_the_distance_by_less_than_its_standard_error() {
    let [largest, mean] = moved(&[Fault::Stuck], 100);
    println!("stuck: largest {largest:.2}, mean {mean:.2} standard errors");
    assert!(largest < 1.0 && mean < 0.2, "{largest} {mean}");
}

/// A level that no track has, for three readings up to more than a second.
#[test]
fn a_wide_spike_moves_the_distance_by_less_than_its_standard_error() {
    let cases: Vec<(u64, _)> = (0..24).zip(WHOLE_DRIVES.iter().cycle()).collect();
    cases.into_par_iter().for_each(|(seed, (whole, good))| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut runs: Vec<_> = whole.runs().iter().cloned().map(Run::into_rows).collect();
        let run = random.random_range(0..runs.len());
        let tracks = &mut runs[run].tracks.samples;
        let width = random.random_range(3..50);
        let first = random.random_range(0..tracks.len() - width);
        let level = random.random_range(3.0..1000.0) * if seed % 2 == 0 { 1.0 } else { -1.0 };
        for reading in &mut tracks[first..first + width] {
            let speed = if seed % 4 < 2 { &mut reading.v_left } else { &mut reading.v_right };
            *speed = level;
        }
        let hurt = Recording::new("hurt", "robot", runs, Source::computed(), Vec::new());
        let hurt = hurt.expect("usable");
        let told = format!("up to {:.1} m/s", level.abs());
        assert!(
            hurt.warnings().iter().any(|warning| warning.to_string().contains(&told)),
            "{seed}"
        );
        let moved = off(&hurt, good);
        assert!(moved < 1.0, "{seed}: {width} readings of {level} m/s: {moved}");
    });
}

#[test]
fn what_was_mended_is_counted() {
    let hurt = corrupted(&drive(3), &[Fault::Spike], 3);
    let is_told =
        |warning: &Warning| warning.to_string().contains("jump away from their neighbours");
    assert!(hurt.warnings().iter().any(is_told), "{:?}", hurt.warnings());
}
