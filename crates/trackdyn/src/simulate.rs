//! A drive in time over ground with any of the effects, recorded with realistic sensors.

mod batch;
mod document;
mod driving;
mod ground;

pub use batch::simulate_all;
pub use driving::Driving;
pub use ground::{Ground, Model, Motion};

use crate::change::Folder;
use crate::law::guarded;
use crate::progress::Counter;
use crate::{Change, Error, Observer, Provenance, Recording, Vehicle, unobserved};
use std::path::Path;
use trackdyn_core::{PerSide, Pose, Trajectory};
use trackdyn_drive::schedules::{self, ScheduleOptions, ScheduledRun, as_commanded};
use trackdyn_drive::sensors::{PoseFrame as SensorFrame, Preset, Sensors, Views};
use trackdyn_drive::{Error as DrivingError, truth};
use trackdyn_model::custom::together;
use trackdyn_model::{Circumstance, Stationary, Transient};
use trackdyn_recording::{PoseFrame, Recording as Recorded, Source, UncheckedRun, folder};

/// Name of the document that every simulation writes.
const FILE: &str = "simulation.toml";

/// Most moments of all runs together. A moment takes 72 bytes, and there are three copies: as the
/// body moves, as the sensor sees it, and as the encoders do.
const MAX_MOMENTS: f64 = 4e6;

/// How to simulate.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulateSettings {
    /// What the tracks do. Default: driven by hand.
    pub driving: Driving,
    /// Runs of driving that is generated. Default: what is usual for it.
    pub runs: Option<usize>,
    /// Time of each run of driving that is generated, s. Default: as long as it takes.
    pub duration: Option<f64>,
    /// Largest track speed of driving that is generated, m/s. Default: 1.
    pub fastest: Option<f64>,
    /// The sensors. Default: those of a laboratory.
    pub sensors: Sensors,
    /// Where each run begins. Default: the origin.
    pub start: Pose,
    /// Whether the robot has inertia; without, it is at its stationary motion at once. Default: it
    /// has.
    pub inertia: bool,
    /// Longest step of the integration, s.
    pub longest_step: f64,
    /// Seed of driving and noise. Default: 1.
    pub seed: u64,
}

impl Default for SimulateSettings {
    fn default() -> Self {
        Self {
            driving: Driving::default(),
            runs: None,
            duration: None,
            fastest: None,
            sensors: Preset::Laboratory.sensors(),
            start: Pose::default(),
            inertia: true,
            longest_step: Transient::STEP,
            seed: 1,
        }
    }
}

/// Simulates a robot and records it.
///
/// # Errors
/// Those of [`Prepared::new`] and [`Prepared::run`].
pub fn simulate(vehicle: &Vehicle, settings: &SimulateSettings) -> Result<Simulation, Error> {
    Prepared::new(vehicle, settings)?.run(&unobserved)
}

/// A simulation whose inputs and settings go together.
#[derive(Clone, Debug)]
pub struct Prepared {
    vehicle: Vehicle,
    settings: SimulateSettings,
    schedules: Vec<ScheduledRun>,
}

impl Prepared {
    /// Reads or generates the driving.
    ///
    /// # Errors
    /// [`Error::Driving`] for driving that cannot be read or generated, [`Error::GeneratedOnly`]
    /// for settings that a file has no use for.
    pub fn new(vehicle: &Vehicle, settings: &SimulateSettings) -> Result<Self, Error> {
        let vehicle = vehicle.clone().with_inertia(settings.inertia);
        let schedules = guarded(|| schedules(&vehicle, settings))?;
        check_duration(&schedules, settings.longest_step)?;
        Ok(Self { vehicle, settings: settings.clone(), schedules })
    }

    /// The vehicle, with its inertia where the settings say so.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Simulates on the ground of the vehicle's effects, observed: a part is a run.
    ///
    /// # Errors
    /// As [`Prepared::run_on`].
    pub fn run(&self, observer: &Observer) -> Result<Simulation, Error> {
        let ground = Model::new(&self.vehicle, &self.settings);
        self.run_on(&ground, observer)
    }

    /// Simulates on any ground, runs in parallel, observed: a part is a run.
    ///
    /// # Errors
    /// [`Error::Run`] for a run that cannot be driven or observed, of several the first;
    /// [`Error::Law`], [`Error::Cancelled`].
    pub fn run_on(&self, ground: &dyn Ground, observer: &Observer) -> Result<Simulation, Error> {
        // Laws that know the time begin where the recording begins, whatever its clock shows.
        let starts = self.schedules.iter().map(|run| run.schedule.span()[0]);
        let origin = starts.fold(f64::INFINITY, f64::min).floor();
        let counter = Counter::new(observer, self.schedules.len());
        let one = |run: &ScheduledRun| -> Result<Driven, Error> {
            counter.check()?;
            let driven = guarded(|| Driven::new(ground, run, origin, &self.settings));
            counter.advance("runs", 1).is_continue().then_some(driven).ok_or(Error::Cancelled)?
        };
        let share_calls = self.vehicle.effects().share_calls();
        let runs = together(&self.schedules, share_calls, one);
        // of several errors that of the first run, on any number of threads
        let runs: Vec<Driven> = runs.into_iter().collect::<Result<_, _>>()?;
        let robot = self.vehicle.name();
        let observed = runs.iter().map(|run| run.observed.clone()).collect();
        let name = format!("simulated {robot}");
        let recorded = Recorded::new(name, robot, observed, Source::computed(), Vec::new())?
            .with_pose_frame(self.pose_frame());
        let paths = runs.into_iter().map(|run| (run.id, run.path)).collect();
        Ok(Simulation {
            recording: recorded.clone().into(),
            paths,
            recorded,
            ground: ground.name(),
            mechanisms: ground.mechanisms(),
            made_from: self.clone(),
        })
    }

    /// The frame that all poses share: runs begin at one pose, so that their first poses stand in
    /// one frame. None where each has one of its own, which is to be found.
    fn pose_frame(&self) -> Option<PoseFrame> {
        let is_own = self.settings.sensors.pose.frame == SensorFrame::Random;
        (!is_own).then_some(PoseFrame::World)
    }
}

/// Refuses driving whose moments memory would not hold, such as a schedule in which a clock is set.
fn check_duration(schedules: &[ScheduledRun], longest_step: f64) -> Result<(), Error> {
    let longest = MAX_MOMENTS * longest_step;
    let duration: f64 = schedules.iter().map(|run| run.schedule.duration()).sum();
    if duration <= longest {
        return Ok(());
    }
    let lasting = |run: &ScheduledRun| (run.schedule.duration(), run.id);
    let by_time = |a: &(f64, i64), b: &(f64, i64)| a.0.total_cmp(&b.0);
    let (most, id) = schedules.iter().map(lasting).max_by(by_time).unwrap_or_default();
    Err(Error::Driving(DrivingError::Option {
        name: "schedule",
        value: format!("of {duration} s, of which run {id} takes {most} s"),
        expected: format!(
            "at most {longest} s in all runs together, whose moments every {longest_step} s take \
             1 GB of memory: fewer or shorter runs, or a longer step"
        ),
    }))
}

/// The driving that the settings ask for.
fn schedules(vehicle: &Vehicle, settings: &SimulateSettings) -> Result<Vec<ScheduledRun>, Error> {
    let given = [
        ("runs", settings.runs.is_some()),
        ("duration", settings.duration.is_some()),
        ("fastest", settings.fastest.is_some()),
    ];
    let given = given.into_iter().find_map(|(setting, given)| given.then_some(setting));
    settings.driving.refuse(given)?;
    let usual = ScheduleOptions::default();
    let fastest = settings.fastest.unwrap_or(usual.fastest);
    // Turns of squares are measured by the ICRs of this very robot.
    let spin = PerSide::new(-fastest / 2.0, fastest / 2.0);
    let icrs = Stationary::new(&vehicle.model(), &Circumstance::default()).solve(spin).icrs;
    let icr_distance = icrs.map_or(usual.icr_distance, |icrs| icrs.x_right - icrs.x_left);
    let SimulateSettings { runs, seed, duration, .. } = *settings;
    let options = ScheduleOptions { runs, seed, fastest, duration, icr_distance, ..usual };
    settings.driving.schedules(&options)
}

/// One run, driven and seen.
struct Driven {
    id: i64,
    path: Trajectory,
    observed: UncheckedRun,
}

impl Driven {
    fn new(
        ground: &dyn Ground,
        run: &ScheduledRun,
        origin: f64,
        settings: &SimulateSettings,
    ) -> Result<Self, Error> {
        let ScheduledRun { id, schedule } = run;
        let failed = |cause| Error::Run { run: *id, cause };
        let from_origin = schedule.clone().later(-origin);
        let Motion { body, reported } = ground.drive(&from_origin).map_err(failed)?;
        let (path, poses) = (body.later(origin), reported.later(origin));
        let encoders = as_commanded(schedule, &path);
        let views = Views { encoders: &encoders, body: &path, poses: &poses };
        let observed = settings.sensors.observe_views(*id, &views, settings.seed);
        let observed = observed.map_err(|error| failed(error.into()))?;
        Ok(Self { id: *id, path, observed })
    }
}

/// A robot that was driven in simulation: what its sensors recorded, and how it really moved.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// What the sensors recorded.
    pub recording: Recording,
    /// The true motion of each run, with its number.
    pub paths: Vec<(i64, Trajectory)>,
    recorded: Recorded,
    ground: String,
    mechanisms: Vec<String>,
    made_from: Prepared,
}

impl Simulation {
    /// The vehicle as it was driven.
    pub fn vehicle(&self) -> &Vehicle {
        &self.made_from.vehicle
    }

    /// The sensors.
    pub fn sensors(&self) -> &Sensors {
        &self.made_from.settings.sensors
    }

    /// Length of the path of a run, m; none of a run that there is not.
    pub fn path_length(&self, run: i64) -> Option<f64> {
        let (_, path) = self.paths.iter().find(|(id, _)| *id == run)?;
        let steps = path.moments().windows(2);
        Some(
            steps
                .map(|step| {
                    (step[1].pose.x - step[0].pose.x).hypot(step[1].pose.y - step[0].pose.y)
                })
                .sum(),
        )
    }

    /// The text of `simulation.toml` (schema `trackdyn.simulation/1`): what the recording was made
    /// from.
    pub fn to_toml(&self, provenance: &Provenance) -> String {
        document::text(self, provenance)
    }

    /// Writes the recording into a folder, with the true motion (`truth.csv`) and what it was made
    /// from: `simulation.toml`, `schedule.csv`, `vehicle.toml`, `sensors.toml`.
    ///
    /// # Errors
    /// [`Error::NotSimulated`] where the folder holds one of these that no simulation wrote;
    /// [`Error::Output`], [`Error::Recording`].
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let path = folder.as_ref();
        refuse_other(path)?;
        let mut folder = Folder::prepare(path)?;
        // It comes first: it says that all others may be replaced.
        folder.write(FILE, self.to_toml(provenance).as_bytes())?;
        let truth = truth::text(self.paths.iter().map(|(id, path)| (*id, path)));
        folder.write(truth::FILE, truth.as_bytes())?;
        let schedule = schedules::text(&self.made_from.schedules);
        folder.write("schedule.csv", schedule.as_bytes())?;
        folder.write("vehicle.toml", self.vehicle().to_toml().as_bytes())?;
        folder.write("sensors.toml", self.sensors().to_toml().as_bytes())?;
        folder::write(&self.recorded, path)?;
        folder.wrote(folder::MANIFEST);
        Ok(folder.changes())
    }
}

/// Refuses a folder that holds what no simulation wrote, be it a recording or the vehicle's own
/// file: a simulation would replace it.
///
/// # Errors
/// [`Error::NotSimulated`].
pub fn refuse_other(folder: &Path) -> Result<(), Error> {
    const OWN_FILES: [&str; 8] = [
        "recording.toml",
        "tracks.csv",
        "poses.csv",
        "imu.csv",
        "truth.csv",
        "vehicle.toml",
        "sensors.toml",
        "schedule.csv",
    ];
    let is_there = |name: &&str| folder.join(name).exists();
    match OWN_FILES.into_iter().find(is_there).filter(|_| !is_there(&FILE)) {
        Some(file) => Err(Error::NotSimulated { folder: folder.to_owned(), file }),
        None => Ok(()),
    }
}

/// The sensors of a preset's name, or of a file.
///
/// # Errors
/// [`Error::Driving`] for a file that is not accepted, [`Error::NoSensors`] for what is neither.
pub fn sensors(choice: &str) -> Result<Sensors, Error> {
    match Preset::named(choice) {
        Some(preset) => Ok(preset.sensors()),
        None if Path::new(choice).exists() => Ok(Sensors::read(Path::new(choice))?),
        None => Err(Error::NoSensors { choice: choice.to_owned() }),
    }
}
