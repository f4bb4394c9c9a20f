//! What encoders show.

use crate::driving::plant::auriga;
use trackdyn_core::{Command, PerSide, Plant, Schedule, Trajectory};
use trackdyn_drive::sensors::{Encoder, Preset, StampAt};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, Sensors};
use trackdyn_recording::TrackSample;
use trackdyn_recording::hold::travelled;

fn manual() -> Trajectory {
    let options = ScheduleOptions { runs: Some(1), ..ScheduleOptions::default() };
    let runs = ScheduleKind::Manual.generate(&options).expect("valid");
    auriga().follow(&runs[0].schedule).expect("it rolls")
}

/// Readings of perfect sensors with this encoder.
fn readings(trajectory: &Trajectory, encoder: Encoder, seed: u64) -> Vec<TrackSample> {
    let sensors = Sensors { encoder, ..Preset::Perfect.sensors() };
    sensors.observe(0, trajectory, seed).expect("a motion").tracks.samples
}

#[test]
fn perfect_readings_are_the_commands() {
    let options = ScheduleOptions { runs: Some(1), ..ScheduleOptions::default() };
    let runs = ScheduleKind::Designed.generate(&options).expect("valid");
    let trajectory = auriga().follow(&runs[0].schedule).expect("it rolls");
    let seen = readings(&trajectory, Preset::Perfect.sensors().encoder, 0);
    for (sample, command) in seen.iter().zip(runs[0].schedule.commands()) {
        assert!((sample.t - command.t).abs() < 1e-9);
        // the robot of the test takes a microsecond of 30 ms to change speed
        assert!((sample.v_left - command.speeds.left).abs() < 1e-4);
        assert!((sample.v_right - command.speeds.right).abs() < 1e-4);
    }
    assert_eq!(seen.len(), runs[0].schedule.commands().len() - 1);
}

#[test]
fn ticks_lose_no_travel() {
    let trajectory = manual();
    let perfect = Preset::Perfect.sensors().encoder;
    let exact = readings(&trajectory, perfect, 0);
    for tick in [2e-4, 2e-3, 2e-2] {
        let coarse = readings(&trajectory, Encoder { tick, ..perfect }, 5);
        for end in [3.0, 10.0, 25.0] {
            let [a, b] = [&exact, &coarse].map(|tracks| travelled(tracks, 0.0, end, 0.0));
            for (a, b) in [(a.left, b.left), (a.right, b.right)] {
                assert!((a - b).abs() <= tick * (1.0 + 1e-9), "{a} {b}");
            }
        }
        for sample in &coarse {
            let ticks = sample.v_left * perfect.interval / tick;
            assert!((ticks - ticks.round()).abs() < 1e-6);
        }
    }
}

#[test]
fn quantisation_has_mean_zero_and_the_variance_of_its_law() {
    let perfect = Preset::Perfect.sensors().encoder;
    let tick = 1e-3;
    // 0.07 m/s · 30 ms = 2.1 ticks: a fraction of 0.1; 0.05 m/s: 1.5 ticks
    for (speed, fraction) in [(0.07_f64, 0.1), (0.05, 0.5)] {
        let held = PerSide::new(speed, speed);
        let commands = [0.0, 0.6].map(|t| Command { t, speeds: held });
        let schedule = Schedule::new(commands.to_vec()).expect("a schedule");
        let trajectory = auriga().follow(&schedule).expect("it rolls");
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
        for seed in 0..20_000 {
            // one reading per phase: readings of one run share theirs
            let sample = readings(&trajectory, Encoder { tick, ..perfect }, seed)[10];
            for error in [sample.v_left - speed, sample.v_right - speed] {
                sum += error;
                squares += error * error;
                count += 1.0;
            }
        }
        let per_tick = tick / perfect.interval;
        let variance: f64 = fraction * (1.0 - fraction) * per_tick * per_tick;
        // five standard errors of a mean, and 5 % of a variance of two values
        assert!((sum / count).abs() < 5.0 * (variance / count).sqrt(), "{}", sum / count);
        assert!((squares / count / variance - 1.0).abs() < 0.05, "{}", squares / count / variance);
    }
}

#[test]
fn stamps_keep_their_order_and_have_the_stated_scatter() {
    let trajectory = manual();
    let encoder = Encoder {
        jitter: 0.0075,
        delay: 0.2,
        stamp_at: StampAt::End,
        ..Preset::Perfect.sensors().encoder
    };
    let stamps: Vec<f64> = (0..20)
        .flat_map(|seed| {
            let seen = readings(&trajectory, encoder, seed);
            assert!(seen.windows(2).all(|pair| pair[1].t > pair[0].t));
            let late = |(k, sample): (u32, TrackSample)| sample.t - 0.03 * f64::from(k + 1) - 0.2;
            (0..).zip(seen).map(late).collect::<Vec<_>>()
        })
        .collect();
    #[expect(clippy::cast_precision_loss, reason = "a few thousand readings")]
    let count = stamps.len() as f64;
    let mean = stamps.iter().sum::<f64>() / count;
    let deviation = (stamps.iter().map(|late| late * late).sum::<f64>() / count).sqrt();
    // 20 000 stamps: the mean to 0.05 ms, the deviation of a uniform scatter to 0.3 %
    assert!(mean.abs() < 2.5e-4 && (deviation / 0.0075 - 1.0).abs() < 0.02, "{mean} {deviation}");
}

#[test]
fn alpha_divides_what_is_shown() {
    let trajectory = manual();
    let perfect = Preset::Perfect.sensors().encoder;
    let plain = readings(&trajectory, perfect, 0);
    let scaled = readings(&trajectory, Encoder { alpha_left: 0.95, ..perfect }, 0);
    for (plain, scaled) in plain.iter().zip(&scaled) {
        assert!((plain.v_left - 0.95 * scaled.v_left).abs() < 1e-12);
        assert_eq!(plain.v_right, scaled.v_right);
    }
}
