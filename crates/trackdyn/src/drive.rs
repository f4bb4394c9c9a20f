//! A path, followed with the ideal differential drive and with kinematic parameters.

mod document;

use crate::change::Folder;
use crate::law::guarded;
use crate::progress::Counter;
use crate::{Change, Error, Figure, Observer, Parameters, Provenance, Vehicle, unobserved};
use std::path::Path as FilePath;
use trackdyn_core::{Moment, PerSide, Plant, Stopped, Trajectory};
use trackdyn_drive::tracking::{DriveOptions, Estimate};
use trackdyn_drive::{Ending, Journey, Path, Steering, Tracker};
use trackdyn_model::{Kinematics, MotionTable, Transient};
use trackdyn_report::{TrackedDrive, path_tracking};

/// Name of the document that every drive writes.
const FILE: &str = "drive.toml";

/// How to follow a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveSettings {
    /// Speed on open ground, m/s.
    pub speed: f64,
    /// Look-ahead of the path tracker, m.
    pub look_ahead: f64,
    /// How the robot knows its pose. Default: by a perfect localisation.
    pub estimate: Estimate,
    /// Whether the robot has inertia; without, it is at its stationary motion at once. Default: it
    /// has.
    pub inertia: bool,
    /// Whether to drive by the steady motion of the vehicle's own forces, too. Default: no.
    pub forces: bool,
}

impl Default for DriveSettings {
    fn default() -> Self {
        let Tracker { speed, look_ahead, .. } = Tracker::default();
        Self { speed, look_ahead, estimate: Estimate::Truth, inertia: true, forces: false }
    }
}

/// Follows a path with the ideal drive of the vehicle's gauge, with each of these parameters, and
/// by the vehicle's own forces where the settings say so.
/// The point whose error counts is where the robot turns about by the first of them.
///
/// # Errors
/// Those of [`Prepared::new`] and [`Prepared::run`].
pub fn drive(
    vehicle: &Vehicle,
    path: &Path,
    parameters: &[Parameters],
    settings: &DriveSettings,
) -> Result<Drives, Error> {
    Prepared::new(vehicle, path, parameters, settings)?.run(&unobserved)
}

/// Drives whose inputs and settings go together.
#[derive(Clone, Debug)]
pub struct Prepared {
    vehicle: Vehicle,
    path: Path,
    parameters: Vec<Parameters>,
    forces: Option<MotionTable>,
    tracker: Tracker,
    estimate: Estimate,
}

impl Prepared {
    /// Checks that inputs and settings go together.
    ///
    /// # Errors
    /// [`Error::IcrTooFar`] for a robot that turns about a point too far from its middle,
    /// [`Error::TooFast`].
    pub fn new(
        vehicle: &Vehicle,
        path: &Path,
        parameters: &[Parameters],
        settings: &DriveSettings,
    ) -> Result<Self, Error> {
        let mut point = [0.0, 0.0];
        if let Some(first) = parameters.first() {
            // forward in both frames, on the middle line
            point = [first.file().y_icr_m, 0.0];
            if point[0].abs() > Tracker::MAX_POINT_DISTANCE {
                let (file, most) = (first.name().to_owned(), Tracker::MAX_POINT_DISTANCE);
                return Err(Error::IcrTooFar { file, y: point[0], most });
            }
        }
        let DriveSettings { speed, look_ahead, estimate, inertia, forces } = *settings;
        let tracker = Tracker { speed, look_ahead, point, ..Tracker::default() };
        if tracker.speed > tracker.belt_speed {
            return Err(Error::TooFast { speed, most: tracker.belt_speed });
        }
        let table = || Ok(MotionTable::of(&vehicle.model(), tracker.belt_speed));
        let forces = forces.then(|| guarded(table)).transpose()?;
        Ok(Self {
            vehicle: vehicle.clone().with_inertia(inertia),
            path: path.clone(),
            parameters: parameters.to_vec(),
            forces,
            tracker,
            estimate,
        })
    }

    /// The vehicle, with its inertia where the settings say so.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Drives, observed: a part is a thousandth of a drive.
    ///
    /// # Errors
    /// [`Error::Driving`] for settings that no tracker has, [`Error::Cancelled`].
    pub fn run(self, observer: &Observer) -> Result<Drives, Error> {
        let ideal = Kinematics::ideal(self.vehicle.gauge());
        let mut drives = vec![Drive {
            name: "ideal drive".to_owned(),
            fingerprint: None,
            journey: self.follow(&ideal, observer)?,
        }];
        for parameters in &self.parameters {
            drives.push(Drive {
                name: parameters.name().to_owned(),
                fingerprint: Some(parameters.fingerprint()),
                journey: self.follow(parameters.file(), observer)?,
            });
        }
        if let Some(forces) = &self.forces {
            drives.push(Drive {
                name: format!("forces on {}", self.vehicle.name()),
                fingerprint: Some(self.vehicle.fingerprint()),
                journey: self.follow(forces, observer)?,
            });
        }
        Ok(Drives { drives, of: self })
    }

    fn follow(&self, steering: &dyn Steering, observer: &Observer) -> Result<Journey, Error> {
        const PARTS: usize = 1000;
        let model = self.vehicle.model();
        let counter = Counter::new(observer, PARTS);
        let robot = Transient::at_rest(&model, 0.0, self.path.start());
        let mut robot = Watched { robot, counter: &counter };
        let options = DriveOptions { estimate: self.estimate, time_limit: None };
        let progress = |share: f64| {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "a share of a thousand"
            )]
            let part = (share.clamp(0.0, 1.0) * PARTS as f64) as usize;
            // the robot stops where the observer wants no more
            let _ = counter.reach("drive", part);
        };
        let (path, tracker) = (&self.path, &self.tracker);
        let mut drive =
            || trackdyn_drive::drive(&mut robot, path, tracker, steering, &options, &progress);
        let journey = guarded(|| Ok(drive()?))?;
        counter.check()?;
        Ok(journey)
    }
}

/// A robot that stops where an observer wants no more.
struct Watched<'a> {
    robot: Transient<'a>,
    counter: &'a Counter<'a>,
}

impl Plant for Watched<'_> {
    fn moment(&self) -> Moment {
        self.robot.moment()
    }

    fn drive(
        &mut self,
        speeds: PerSide<f64>,
        until: f64,
        trajectory: &mut Trajectory,
    ) -> Result<(), Stopped> {
        if self.counter.state().is_break() {
            return Err(Stopped { t: self.moment().t, reason: "cancelled".to_owned() });
        }
        self.robot.drive(speeds, until, trajectory)
    }
}

/// One drive along the path.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name of the kinematics.
    pub name: String,
    /// Fingerprint of the kinematics file, or of the vehicle; none of the ideal drive.
    pub fingerprint: Option<String>,
    /// What came of it.
    pub journey: Journey,
}

/// Drives along a path: the ideal drive, then one for each set of parameters, and one by forces
/// where the settings say so.
#[derive(Clone, Debug)]
pub struct Drives {
    drives: Vec<Drive>,
    of: Prepared,
}

impl Drives {
    /// The drives.
    pub fn drives(&self) -> &[Drive] {
        &self.drives
    }

    /// The vehicle that drove.
    pub fn vehicle(&self) -> &Vehicle {
        &self.of.vehicle
    }

    /// The path.
    pub fn path(&self) -> &Path {
        &self.of.path
    }

    /// How it was tracked.
    pub fn tracker(&self) -> &Tracker {
        &self.of.tracker
    }

    /// Whether all drives came to the end of the path.
    pub fn all_arrived(&self) -> bool {
        self.drives.iter().all(|drive| drive.journey.ending == Ending::Arrived)
    }

    /// The text of `drive.toml` (schema `trackdyn.drive/1`).
    pub fn to_toml(&self, provenance: &Provenance) -> String {
        document::text(self, provenance)
    }

    /// The drives as a figure.
    pub fn figure(&self, provenance: &Provenance) -> Figure {
        let tracked: Vec<TrackedDrive> = self
            .drives
            .iter()
            .map(|drive| TrackedDrive { name: &drive.name, journey: &drive.journey })
            .collect();
        let knows = match self.of.estimate {
            Estimate::Truth => "the robot knows its pose",
            Estimate::Odometry => "the robot locates itself by dead reckoning",
        };
        let (vehicle, version) = (&self.of.vehicle, &provenance.version);
        let title = format!("{}: {knows}", vehicle.name());
        let caption = format!("trackdyn {version}, vehicle and effects {}", vehicle.fingerprint());
        path_tracking(&self.of.path, &tracked, self.of.tracker.point, &title, &caption)
    }

    /// Writes `drive.png`, a table of the cross-track error of each drive, `path.csv` and
    /// `drive.toml`. Tables of an earlier run go where this one has none.
    ///
    /// # Errors
    /// [`Error::Output`], [`Error::NotRemoved`], [`Error::Figure`].
    pub fn write(
        &self,
        folder: impl AsRef<FilePath>,
        provenance: &Provenance,
    ) -> Result<Vec<Change>, Error> {
        let table = |index: usize| format!("cross_track_{index}.csv");
        let mut folder = Folder::prepare(folder.as_ref())?;
        folder.write("drive.png", &self.figure(provenance).to_png()?)?;
        for (index, drive) in self.drives.iter().enumerate() {
            folder.write(&table(index), drive.journey.cross_track_csv().as_bytes())?;
        }
        let further = (self.drives.len()..).map(|index| folder.file(&table(index)));
        let further: Vec<_> = further.take_while(|table| table.exists()).collect();
        folder.remove_earlier(FILE, further)?;
        folder.write("path.csv", self.of.path.to_csv().as_bytes())?;
        folder.write(FILE, self.to_toml(provenance).as_bytes())?;
        Ok(folder.changes())
    }
}

/// How a drive ended, in a few words.
pub fn ending(ending: &Ending) -> String {
    match ending {
        Ending::Arrived => "arrived".to_owned(),
        Ending::OutOfTime => "out of time".to_owned(),
        Ending::Stopped(stopped) => stopped.to_string(),
        other => format!("{other:?}"),
    }
}
