//! The robot that drives, and what its sensors record of it.

use super::ALPHA;
use trackdyn_core::{Command, PerSide, Plant, Pose, Schedule};
use trackdyn_drive::schedules::as_commanded;
use trackdyn_drive::sensors::{Preset, Views};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, ScheduledRun};
use trackdyn_model::{Circumstance, Model, VehicleFile};
use trackdyn_model::{Icrs, Stationary, Transient};
use trackdyn_recording::{Recording, Run, Source};
use trackdyn_tests::parse_effects;

/// Track speed of the spin test, m/s: the middle of what the manual paths use.
const SPIN_SPEED: f64 = 0.4;

/// Readings from one motion that is solved to the next: 0.27 s.
const READINGS: usize = 9;

/// Auriga-alpha as the paper's section 5 has it: the centre of gravity to the left and to the
/// front, in motion with its inertia, and with belts that run at `ALPHA` times the speeds that are
/// shown.
///
/// No motion resistance: on the floor of a laboratory what resists is inside the running gear,
/// which no force on the hull shows.
pub fn auriga() -> Model {
    with_effects(&[&encoder_scale()])
}

/// The robot with belts that run as shown: what a simulation knows that was not told of α.
pub fn auriga_without_alpha() -> Model {
    with_effects(&[])
}

/// The robot at a crawl: the base model, whose ICRs are constant.
pub fn crawling_auriga() -> Model {
    Model::new(VehicleFile::auriga_alpha().vehicle, parse_effects(&[&encoder_scale()]))
}

fn encoder_scale() -> String {
    format!("encoder-scale:left={},right={}", ALPHA.left, ALPHA.right)
}

fn with_effects(effects: &[&str]) -> Model {
    let mut all = vec!["load-transfer:cog_height_m=0.05"];
    all.extend(effects);
    Model::new(VehicleFile::auriga_alpha().vehicle, parse_effects(&all).with_inertia())
}

/// The runs of a generated schedule, driven and recorded.
pub fn recorded(model: &Model, kind: ScheduleKind, seed: u64) -> Recording {
    let schedules = kind.generate(&ScheduleOptions { seed, ..ScheduleOptions::default() });
    drive_and_record(model, &schedules.expect("valid options"), seed)
}

/// A spin test: ten seconds on the spot in each sense, with ramps of half a second.
pub fn recorded_spins(model: &Model, seed: u64) -> Recording {
    let speed = |t: f64| SPIN_SPEED * (t / 0.5).min((10.0 - t) / 0.5).clamp(0.0, 1.0);
    let spin = |id: i64, sense: f64| {
        let commands = (0..=340).map(|k| {
            let t = 0.03 * f64::from(k);
            Command { t, speeds: PerSide::new(-sense * speed(t), sense * speed(t)) }
        });
        ScheduledRun { id, schedule: Schedule::new(commands.collect()).expect("in order") }
    };
    drive_and_record(model, &[spin(0, 1.0), spin(1, -1.0)], seed)
}

/// Mean ICRs of the stationary motions at the track speeds of a recording, weighted by ω²:
/// residuals are ω times the error of an ICR.
pub fn driven_icrs(model: &Model, recording: &Recording) -> Icrs {
    let solver = Stationary::new(model, &Circumstance::default());
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    for reading in recording.runs().iter().flat_map(Run::tracks).step_by(READINGS) {
        let belts = PerSide::new(ALPHA.left * reading.v_left, ALPHA.right * reading.v_right);
        let solution = solver.solve(belts);
        if let Some(icrs) = solution.icrs {
            let weight = solution.twist.w.powi(2);
            weights += weight;
            for (sum, value) in sum.iter_mut().zip(icrs.to_array()) {
                *sum += weight * value;
            }
        }
    }
    Icrs::from_array(sum.map(|sum| sum / weights))
}

fn drive_and_record(model: &Model, schedules: &[ScheduledRun], seed: u64) -> Recording {
    let sensors = Preset::Laboratory.sensors();
    let runs = schedules.iter().map(|ScheduledRun { id, schedule }| {
        let [start, _] = schedule.span();
        let mut robot = Transient::at_rest(model, start, Pose::default());
        let path = robot.follow(schedule).expect("it stays on the ground");
        let encoders = as_commanded(schedule, &path);
        let poses = model.sensor().reported_path(&path);
        let views = Views { encoders: &encoders, body: &path, poses: &poses };
        sensors.observe_views(*id, &views, seed).expect("a motion")
    });
    Recording::new("Auriga-alpha", "Auriga-alpha", runs.collect(), Source::computed(), Vec::new())
        .expect("long enough")
}
