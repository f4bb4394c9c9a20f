//! Drives on the independent ground with something concealed, and what a diagnosis says of them.

use crate::uniform;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use trackdyn::diagnose::every_fourth;
use trackdyn_core::{Plant, Pose, Trajectory};
use trackdyn_diagnose::diagnosis::{Examination, Kind, Missing, examine};
use trackdyn_diagnose::{Diagnosis, Error, Evidence, Options, Settings, diagnose, unobserved};
use trackdyn_drive::schedules::as_commanded;
use trackdyn_drive::sensors::{PoseFrame, Preset, Sensors, Views};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, ScheduledRun};
use trackdyn_model::{Effects, Vehicle, VehicleFile};
use trackdyn_recording::{Recording, Source, UncheckedRun};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup};

/// Half the width of the square in which runs start, m.
const START: f64 = 1.5;

/// Newton's law: every robot has it, and its owner knows.
pub const INERTIA: [&str; 2] = ["yaw-inertia", "centripetal"];

/// A drive on the independent ground, before any sensor sees it.
pub struct Drive {
    runs: Vec<Driven>,
}

/// A run as it was driven.
struct Driven {
    id: i64,
    /// What the encoders see.
    encoders: Trajectory,
    /// The body's motion.
    body: Trajectory,
    /// What the pose sensor takes it for, before noise.
    poses: Trajectory,
}

impl Drive {
    /// Drives a vehicle with what is concealed (`id:key=value`) and with Newton's law, each run
    /// from a place and a heading that are drawn.
    ///
    /// # Errors
    /// What no mechanism is, and a robot that tips over.
    pub fn new(
        vehicle: &Vehicle,
        concealed: &[&str],
        runs: &[ScheduledRun],
        seed: u64,
    ) -> Result<Self, String> {
        let mut active = Vec::new();
        for text in concealed {
            active.push(text.parse().map_err(|error| format!("{text}: {error}"))?);
        }
        let is_concealed =
            |id: &str| active.iter().any(|mechanism: &ActiveMechanism| mechanism.sheet().id == id);
        let known: Vec<&str> = INERTIA.into_iter().filter(|id| !is_concealed(id)).collect();
        for id in known {
            active.push(ActiveMechanism::new(id, &[]).map_err(|error| error.to_string())?);
        }
        let runs = runs.par_iter().map(|run| Driven::new(vehicle, &active, run, seed));
        Ok(Self { runs: runs.collect::<Result<_, _>>()? })
    }

    /// What sensors make of it.
    ///
    /// # Panics
    /// For sensors that cannot be, and runs of less than two poses.
    pub fn recording(&self, sensors: &Sensors, seed: u64) -> Recording {
        let runs = self.runs.iter().map(|run| {
            let views = Views { encoders: &run.encoders, body: &run.body, poses: &run.poses };
            sensors.observe_views(run.id, &views, seed).expect("sensors that can be")
        });
        recording(runs.collect())
    }
}

impl Driven {
    fn new(
        vehicle: &Vehicle,
        active: &[ActiveMechanism],
        run: &ScheduledRun,
        seed: u64,
    ) -> Result<Self, String> {
        let ScheduledRun { id, schedule } = run;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(id.cast_unsigned());
        let place = [uniform(&mut random, -START, START), uniform(&mut random, -START, START)];
        let start = Pose::new(place[0], place[1], uniform(&mut random, -PI, PI));
        let [start_time, _] = schedule.span();
        let seed = seed.wrapping_add(id.cast_unsigned());
        let setup = Setup { start, start_time, seed, ..Setup::default() };
        let mut robot = Robot::new(vehicle, active, &setup).map_err(|error| error.to_string())?;
        let body = robot.follow(schedule).map_err(|stopped| stopped.to_string())?;
        let poses = robot.report(&body);
        Ok(Self { id: *id, encoders: as_commanded(schedule, &body), body, poses })
    }
}

/// A recording of these rows.
///
/// # Panics
/// Where no run has two poses.
pub fn recording(runs: Vec<UncheckedRun>) -> Recording {
    Recording::new("concealed", "robot", runs, Source::computed(), Vec::new()).expect("poses")
}

/// Runs of a kind, as long as is usual for it.
///
/// # Panics
/// Never: the options are the usual ones.
pub fn runs(kind: ScheduleKind, count: usize, seed: u64) -> Vec<ScheduledRun> {
    let duration = (kind == ScheduleKind::Designed).then_some(45.0);
    let options =
        ScheduleOptions { runs: Some(count), seed, duration, ..ScheduleOptions::default() };
    kind.generate(&options).expect("a schedule")
}

/// Sensors of a preset whose poses are those of one world: places and headings mean the same in all
/// runs.
pub fn sensors(preset: Preset) -> Sensors {
    let mut sensors = preset.sensors();
    sensors.imu = None;
    sensors.pose.frame = PoseFrame::World;
    sensors
}

/// Auriga-alpha as its owner knows it: all of it, Newton's law as well, but what is concealed.
///
/// # Panics
/// Never: effects are of the catalogue.
pub fn owned(concealed: &[&str]) -> VehicleFile {
    let id = |text: &str| text.split(':').next().unwrap_or_default().to_owned();
    let known = INERTIA.into_iter().filter(|of| !concealed.iter().any(|text| id(text) == *of));
    let effects: Effects = known.map(|id| id.parse().expect("an effect")).collect();
    VehicleFile { effects, ..VehicleFile::auriga_alpha() }
}

/// The diagnosis of a recording, every fourth run held out where there are eight or more.
///
/// # Errors
/// Why there is none.
pub fn diagnosed(recording: &Recording, file: &VehicleFile) -> Result<Diagnosis, Error> {
    diagnosed_by(recording, file, &Settings::default())
}

/// The diagnosis of eight runs with a law that the owner does not know of.
///
/// # Panics
/// For a law that nobody knows of, and where there is no diagnosis.
pub fn diagnosed_law(law: &str, kind: ScheduleKind, seed: u64) -> Diagnosis {
    let file = owned(&[]);
    let drive = Drive::new(&file.vehicle, &[law], &runs(kind, 8, seed), seed).expect("it drives");
    let recording = drive.recording(&sensors(Preset::Laboratory), seed);
    diagnosed(&recording, &file).expect("enough to say something")
}

/// Its diagnosis by other settings.
///
/// # Errors
/// Why there is none.
pub fn diagnosed_by(
    recording: &Recording,
    file: &VehicleFile,
    settings: &Settings,
) -> Result<Diagnosis, Error> {
    of_evidence(&Evidence::of_recording(recording, file.vehicle.gauge, settings)?, file)
}

/// The diagnosis of a recording whose gyroscope corrects the yaw of its poses.
///
/// # Errors
/// Why there is none.
pub fn diagnosed_by_gyroscope(
    recording: &Recording,
    file: &VehicleFile,
) -> Result<Diagnosis, Error> {
    let settings = Settings::default();
    of_evidence(&Evidence::of_drive(recording, file.vehicle.gauge, &settings, true, None)?, file)
}

fn of_evidence(evidence: &Evidence, file: &VehicleFile) -> Result<Diagnosis, Error> {
    let held_out = every_fourth(evidence.runs().len());
    diagnose(evidence, file, &Options { held_out, ..Options::default() }, &unobserved)
}

/// The diagnosis of a recording with its search, nothing held out.
///
/// # Errors
/// Why there is none.
pub fn examined(recording: &Recording, file: &VehicleFile) -> Result<Examination, Error> {
    let evidence = Evidence::of_recording(recording, file.vehicle.gauge, &Settings::default())?;
    examine(&evidence, file, &Options::default(), &unobserved)
}

/// Members of an answer by their names.
pub fn members(missing: &Missing) -> BTreeSet<&'static str> {
    missing.verdict.one_of.iter().map(|&effect| effect.name()).collect()
}

/// All that is named, with its kind.
pub fn named(diagnosis: &Diagnosis) -> Vec<(Kind, BTreeSet<&'static str>)> {
    diagnosis.answer.missing.iter().map(|missing| (missing.kind, members(missing))).collect()
}
