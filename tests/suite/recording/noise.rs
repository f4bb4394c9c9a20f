//! Noise figures of synthetic recordings.

use trackdyn_core::PerSide;
use trackdyn_estimate::noise::{self, Method, Noise, PoseNoise, noise};
use trackdyn_estimate::regular::{self, with_regular_poses};
use trackdyn_estimate::synthetic::{Stretch, Synthetic, random_steps};
use trackdyn_recording::{Recording, Source};

/// Random steps with three seconds of standing between them.
fn stop_and_go(count: usize, seed: u64) -> Vec<Stretch> {
    let steps = random_steps(count, 6.0, 1.0, seed);
    let standing = Stretch { duration: 3.0, speeds: PerSide::default() };
    steps.into_iter().flat_map(|step| [step, standing]).collect()
}

fn measured(recording: &Recording, tau: f64) -> Noise {
    noise(recording, tau, &noise::Settings::default())
}

fn noisy(seed: u64) -> Synthetic {
    Synthetic {
        schedules: (0..4).map(|run| stop_and_go(10, 10 * seed + run)).collect(),
        encoder_noise: 0.04,
        position_noise: 0.006,
        yaw_noise: 0.003,
        tau: 0.2,
        seed,
        ..Synthetic::default()
    }
}

/// Pseudo-random numbers, uniform from 0 to 1.
fn uniforms() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / f64::from(u32::MAX)
    }
}

/// Relative error that a median over some thousand overlapping triples stays within.
#[track_caller]
fn assert_within(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found} instead of {expected}");
}

#[test]
fn white_noise_is_found_standing_and_moving() {
    for seed in 0..5 {
        let found = measured(&noisy(seed).recording().expect("long enough"), 0.2);
        let standing = found.standing.expect("three seconds of standing");
        assert_eq!(standing.method, Method::StandStill);
        let moving = found.moving.expect("six seconds of steady driving");
        assert_eq!(moving.method, Method::SteadyIncrements);
        for figures in [standing, moving] {
            assert!(figures.triples > 500);
            assert_within(figures.forward.white, 0.006, 0.15);
            assert_within(figures.lateral.white, 0.006, 0.15);
            assert_within(figures.yaw.white, 0.003, 0.15);
            // A walk q shows at eight steps, over 0.8 s each way, as 0.4 s q beside 1.5 R. Some 40
            // independent triples at stand-still tell a variance to a third of itself, the many
            // moving ones to a tenth.
            let part = if figures.method == Method::StandStill { 1.0 } else { 0.3 };
            for component in [figures.forward, figures.lateral, figures.yaw] {
                let (r, q) = (component.white.powi(2), component.walk.powi(2));
                assert!(0.4 * q < part * 1.5 * r, "{figures:?}");
            }
        }
        for encoder in [found.encoders.left, found.encoders.right] {
            let encoder = encoder.expect("moving tracks");
            assert_within(encoder.deviation, 0.04, 0.1);
            assert!((encoder.update_interval - 0.05).abs() < 1e-9);
        }
    }
}

#[test]
fn a_random_walk_is_told_from_white_noise() {
    // steps of a seeded pseudo-normal walk: 10 mm per √s at 10 Hz
    let walk = 0.010_f64;
    let recording = noisy(7).recording().expect("long enough");
    let mut uniform = uniforms();
    let runs = recording.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        let mut sum = 0.0;
        for sample in &mut rows.poses.samples {
            // the sum of twelve uniforms has variance 1
            let step: f64 = (0..12).map(|_| uniform() - 0.5).sum();
            sum += walk * 0.1_f64.sqrt() * step;
            sample.pose.x += sum;
            sample.pose.y += sum;
        }
        rows
    });
    let walking = Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new());
    let found = measured(&walking.expect("long enough"), 0.2);
    for figures in [found.standing.expect("standing"), found.moving.expect("moving")] {
        // Along the diagonal both coordinates walk together: forward and lateral share it as the
        // heading has it, so their squares add up to 2 walk².
        let total = figures.forward.walk.hypot(figures.lateral.walk);
        assert_within(total, walk * 2.0_f64.sqrt(), 0.35);
        assert_within(figures.yaw.white, 0.003, 0.15);
        assert!(figures.forward.white.hypot(figures.lateral.white) < 0.012, "{figures:?}");
    }
}

#[test]
fn outliers_do_not_count() {
    let recording = noisy(2).recording().expect("long enough");
    let clean = measured(&recording, 0.2).standing.expect("standing");
    let runs = recording.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        for sample in rows.poses.samples.iter_mut().step_by(50) {
            sample.pose.x += 5.0;
        }
        rows
    });
    let hurt = Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new());
    let hurt = measured(&hurt.expect("long enough"), 0.2).standing.expect("standing");
    // 2 % of the poses are in 6 % of the triples: the median moves by about a tenth
    assert_within(hurt.forward.white, clean.forward.white, 0.2);
}

#[test]
fn held_readings_count_once() {
    let recording = noisy(4).recording().expect("long enough");
    let runs = recording.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        let tracks = &mut rows.tracks.samples;
        for index in 0..tracks.len() {
            let source = tracks[index - index % 5];
            (tracks[index].v_left, tracks[index].v_right) = (source.v_left, source.v_right);
        }
        rows
    });
    let held = Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new());
    let encoder = measured(&held.expect("long enough"), 0.2).encoders.left.expect("moving tracks");
    assert!((encoder.update_interval - 0.25).abs() < 1e-9);
    assert_within(encoder.deviation, 0.04, 0.15);
}

#[test]
fn what_cannot_be_seen_is_absent() {
    let always_moving = Synthetic::default().recording().expect("long enough");
    let found = measured(&always_moving, 0.0);
    assert_eq!(found.standing, None);
    assert_eq!(found.encoders, PerSide::new(None, None), "constant speeds differ only at steps");
}

#[test]
fn poses_that_are_stamped_late_by_chance_are_quiet_at_the_times_they_were_due() {
    let even = noisy(3).recording().expect("long enough");
    let mut uniform = uniforms();
    let late = even.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        // standard deviation 10 ms, a tenth of their interval
        rows.poses.samples.iter_mut().for_each(|pose| pose.t += 0.035 * uniform());
        rows
    });
    let late = Recording::new("late", "synthetic", late.collect(), Source::computed(), Vec::new());
    let late = late.expect("long enough");
    let found = |recording: &Recording| {
        measured(recording, 0.2).moving.expect("six seconds of steady driving")
    };
    let due = with_regular_poses(&late, &regular::Settings::default());
    let [even, due, late] = [found(&even), found(&due), found(&late)];
    let yaw = |noise: &PoseNoise| noise.of_pose[2];
    assert!(yaw(&late) > 1.5 * yaw(&even), "{late:?} of {even:?}");
    assert!(yaw(&due) < 1.15 * yaw(&even), "{due:?} of {even:?}");
    // The errors of the stamps are told from the noise of the poses.
    assert!((late.stamp / 0.0101).ln().abs() < 0.3 && even.stamp == 0.0, "{late:?}");
    assert!(late.yaw.white < 1.15 * yaw(&even), "{late:?} of {even:?}");
}
