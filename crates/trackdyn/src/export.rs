//! Kinematic parameters as files of other programs: ROS 2, URDF, Gazebo; forces as a table;
//! vehicles for simulators.

mod robot;

pub use robot::{BaseFrame, RobotWheels, WheelChoices};

use crate::change::Folder;
use crate::kinematics::source_of;
use crate::law::guarded;
use crate::{Change, Error, Parameters, Provenance, Vehicle};
use std::path::Path;
use trackdyn_core::Side;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::output::fingerprint;
use trackdyn_export::ros2::{Published, Wheels};
use trackdyn_export::{
    EquivalentDrive, Frames, LeftOut, Name, NodeName, Residuals, Robot, TextFile,
};
use trackdyn_model::effect::Symmetry;
use trackdyn_model::kinematics::BagSource;
use trackdyn_model::{ActiveEffect, MotionTable};

/// The frames of a robot, and where its ICRs are measured from.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSettings {
    /// Frame of the odometry. Default: `odom`.
    pub odom: Name,
    /// Frame midway between the ICRs, the parent of the base frame. Default: `icr_link`.
    pub icr: Name,
    /// Root link of the robot's URDF. Default: `base_link`.
    pub base: Name,
    /// Origin of the ICRs in the base frame, m, forward and left: of a map the centre of the
    /// contact area of both tracks, of a recording the frame of its poses. Default: the origin of
    /// the base frame.
    pub contact_centre: [f64; 2],
}

impl Default for FrameSettings {
    fn default() -> Self {
        let [odom, icr, base] = ["odom", "icr_link", "base_link"].map(name);
        Self { odom, icr, base, contact_centre: [0.0, 0.0] }
    }
}

impl FrameSettings {
    fn frames(&self) -> Result<Frames, Error> {
        let Self { odom, icr, base, contact_centre } = self.clone();
        Ok(Frames::new(odom, icr, base, contact_centre)?)
    }
}

/// What a kinematics file does not know of a robot that ROS 2 drives.
#[derive(Clone, Debug, PartialEq)]
pub struct Ros2Settings {
    /// The frames.
    pub frames: FrameSettings,
    /// Belt travel per radian of the wheel joint, m: the pitch radius of the sprocket. There is no
    /// default.
    pub wheel_radius: f64,
    /// Wheel joints on the left. Default: `left_wheel_joint`.
    pub left_wheels: Vec<Name>,
    /// Wheel joints on the right. Default: `right_wheel_joint`.
    pub right_wheels: Vec<Name>,
    /// Name of the controller. Default: `diff_drive_controller`.
    pub controller: NodeName,
    /// How wrong odometry is with these parameters, for the covariances. Default: unknown, and none
    /// are written.
    pub residuals: Option<Residuals>,
    /// Rate at which the controller publishes, Hz.
    pub publish_rate: f64,
}

impl Ros2Settings {
    /// Usual name of the controller.
    pub const CONTROLLER: &str = "diff_drive_controller";

    /// The usual names, for this pitch radius of the sprocket, m.
    ///
    /// # Panics
    /// Never: the names are names.
    pub fn new(wheel_radius: f64) -> Self {
        Self {
            frames: FrameSettings::default(),
            wheel_radius,
            left_wheels: vec![usual_joint(Side::Left)],
            right_wheels: vec![usual_joint(Side::Right)],
            controller: Self::CONTROLLER.parse().expect("a name of a node"),
            residuals: None,
            publish_rate: Published::DEFAULT_RATE,
        }
    }
}

/// Links of the tracks of a robot in Gazebo.
#[derive(Clone, Debug, PartialEq)]
pub struct GzSettings {
    /// Links on the left. Default: `left_track`.
    pub left_tracks: Vec<Name>,
    /// Links on the right. Default: `right_track`.
    pub right_tracks: Vec<Name>,
}

impl Default for GzSettings {
    fn default() -> Self {
        let [left, right] = ["left_track", "right_track"].map(name);
        Self { left_tracks: vec![left], right_tracks: vec![right] }
    }
}

/// The usual name of the wheel joint of a side.
fn usual_joint(side: Side) -> Name {
    name(match side {
        Side::Left => "left_wheel_joint",
        Side::Right => "right_wheel_joint",
    })
}

fn name(text: &str) -> Name {
    text.parse().expect("a name")
}

/// Parameters that are being exported.
#[derive(Clone, Debug)]
pub struct Export {
    drive: EquivalentDrive,
    /// What the log that the parameters come from calls the parts of the robot.
    bag: Option<BagSource>,
    provenance: trackdyn_export::Provenance,
}

impl Export {
    /// The export of parameters.
    ///
    /// # Errors
    /// None for parameters that were read or computed.
    pub fn new(parameters: &Parameters, provenance: &Provenance) -> Result<Self, Error> {
        Self::of(parameters.document(), provenance)
    }

    /// The export of a kinematics file, be it that the distance of the ICRs is all it holds.
    ///
    /// # Errors
    /// [`Error::Document`], which names file, line and key.
    pub fn open(path: impl AsRef<Path>, provenance: &Provenance) -> Result<Self, Error> {
        Self::of(&Document::read(path.as_ref())?, provenance)
    }

    fn of(document: &Document, provenance: &Provenance) -> Result<Self, Error> {
        let Provenance { command, version } = provenance.clone();
        let drive = EquivalentDrive::from_document(document)?;
        let source = source_of(document)?;
        Ok(Self {
            drive,
            bag: source.bag,
            provenance: trackdyn_export::Provenance {
                source: document.name().to_owned(),
                vehicle: source.vehicle,
                fingerprint: fingerprint(document.text().as_bytes()),
                version,
                command,
            },
        })
    }

    /// The ideal differential drive that the robot is, seen midway between its ICRs.
    pub fn drive(&self) -> &EquivalentDrive {
        &self.drive
    }

    /// The name of the parameters' file.
    pub fn name(&self) -> &str {
        &self.provenance.source
    }

    /// The vehicle whose parameters they are, in words.
    pub fn vehicle(&self) -> &str {
        &self.provenance.vehicle
    }

    /// How wrong odometry is with these parameters, from an odometry file (schema
    /// `trackdyn.odometry/1`) of a replay with them, best of driving that they were not fitted to.
    ///
    /// # Errors
    /// [`Error::Document`], which names file, line and key; [`Error::Export`] for a replay with
    /// others.
    pub fn residuals(&self, odometry: &Document) -> Result<Residuals, Error> {
        let residuals = Residuals::from_document(odometry, &self.provenance.fingerprint);
        residuals.map_err(|error| match error.downcast::<trackdyn_export::Error>() {
            Ok(error) => Error::Export(*error),
            Err(error) => match error.downcast::<DocumentError>() {
                Ok(error) => Error::Document(error),
                Err(other) => Error::Residuals(other.to_string()),
            },
        })
    }

    /// Parameters of ros2_control's `diff_drive_controller`, and a launch file that ties its frame
    /// to the robot.
    ///
    /// # Errors
    /// [`Error::Export`], with the setting that is not accepted.
    pub fn ros2(&self, settings: &Ros2Settings) -> Result<Vec<TextFile>, Error> {
        let frames = settings.frames.frames()?;
        let (left, right) = (settings.left_wheels.clone(), settings.right_wheels.clone());
        let wheels = Wheels::new(settings.wheel_radius, left, right)?;
        let residuals = settings.residuals.clone();
        let published =
            residuals.map(|of| Published::new(of, settings.publish_rate)).transpose()?;
        let (controller, provenance) = (&settings.controller, &self.provenance);
        let published = published.as_ref();
        let drive = &self.drive;
        Ok(trackdyn_export::ros2::files(drive, &frames, &wheels, controller, published, provenance))
    }

    /// The `TrackedVehicle` plugin of Gazebo's gz-sim, SDF.
    ///
    /// # Errors
    /// [`Error::Export`], with the setting that is not accepted; [`Error::SeparationAlone`].
    pub fn gz(&self, settings: &GzSettings) -> Result<Vec<TextFile>, Error> {
        self.expect_point()?;
        let GzSettings { left_tracks, right_tracks } = settings;
        let (drive, provenance) = (&self.drive, &self.provenance);
        Ok(vec![trackdyn_export::gz::plugin(drive, left_tracks, right_tracks, provenance)?])
    }

    /// Refuses a distance of the ICRs where the point between them is what is asked for.
    fn expect_point(&self) -> Result<(), Error> {
        if self.drive.is_separation_alone {
            return Err(Error::SeparationAlone { name: self.provenance.source.clone() });
        }
        Ok(())
    }

    /// The frame at which the robot is an ideal differential drive, a fragment of URDF or xacro.
    ///
    /// # Errors
    /// [`Error::Export`], with the setting that is not accepted; [`Error::SeparationAlone`].
    pub fn urdf(&self, settings: &FrameSettings) -> Result<Vec<TextFile>, Error> {
        self.expect_point()?;
        let frames = settings.frames()?;
        Ok(vec![trackdyn_export::urdf::fragment(&self.drive, &frames, &self.provenance)])
    }
}

/// Steady motion by the forces on a vehicle, for encoder speeds up to `fastest`, m/s: as
/// `motion_table.toml`, and as a C header for the robot's computer. Effects of heading, place or
/// time are left out, which both say.
///
/// ```
/// let robot = trackdyn::Vehicle::auriga_alpha();
/// let (table, _) = trackdyn::export::motion_table(&robot, 1.0, &Default::default())?;
/// assert!(table.error < 1e-6);
/// # Ok::<(), trackdyn::Error>(())
/// ```
///
/// # Errors
/// [`Error::FastestSpeed`] for what is no speed of a robot, [`Error::Law`].
pub fn motion_table(
    vehicle: &Vehicle,
    fastest: f64,
    provenance: &Provenance,
) -> Result<(MotionTable, [TextFile; 2]), Error> {
    if !(MIN_TABLE_SPEED..=MAX_TABLE_SPEED).contains(&fastest) {
        return Err(Error::FastestSpeed { fastest, most: MAX_TABLE_SPEED });
    }
    // A table of speeds knows no heading, place or time; of the others it has what is steady.
    let breaks = |effect: &ActiveEffect, any: &[Symmetry]| {
        effect.card().breaks.iter().any(|symmetry| any.contains(symmetry))
    };
    let world = [Symmetry::Heading, Symmetry::Place, Symmetry::Time];
    // Nor has it two gains for one belt.
    let is_alone = |effect: &ActiveEffect| {
        let alone = vehicle.clone().with_effects([effect.clone()].into_iter().collect());
        !breaks(effect, &world) && alone.model().drive().has_one_gain()
    };
    let is_left_out =
        |effect: &&ActiveEffect| !is_alone(effect) || breaks(effect, &[Symmetry::Transient]);
    let effects = vehicle.effects().iter();
    let of_speeds = effects.clone().filter(|effect| is_alone(effect)).cloned();
    let model = vehicle.clone().with_effects(of_speeds.collect()).model();
    let table = guarded(|| Ok(MotionTable::of(&model, fastest)))?;
    let left_out = LeftOut {
        effects: effects.filter(is_left_out).map(ToString::to_string).collect(),
        lag: model.drive().mean_lag(),
    };
    let provenance = of_vehicle(vehicle, provenance);
    let files = trackdyn_export::motion_table::files(&table, &left_out, &provenance);
    Ok((table, files))
}

/// A simulator of rigid bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simulator {
    /// Gazebo's gz-sim: SDF.
    Gazebo,
    /// MuJoCo: MJCF.
    MuJoCo,
    /// Isaac Sim and other readers of USD.
    Usd,
    /// Project Chrono: JSON of Chrono::Vehicle.
    Chrono,
}

/// A vehicle with its effects for a simulator. Comments in the file say which effects it has, which
/// it has not, and by how much it turns otherwise.
///
/// ```
/// use trackdyn::export::{Simulator, simulator};
///
/// let robot = trackdyn::Vehicle::auriga_alpha().with_effect("viscous-friction")?;
/// let file = simulator(&robot, Simulator::MuJoCo, &Default::default())?;
/// assert!(file.text.contains("Effects of the vehicle that this file does not have"));
/// # Ok::<(), trackdyn::Error>(())
/// ```
///
/// # Errors
/// [`Error::Export`] for a vehicle that its forces do not let turn.
pub fn simulator(
    vehicle: &Vehicle,
    simulator: Simulator,
    provenance: &Provenance,
) -> Result<TextFile, Error> {
    let robot = guarded(|| Ok(Robot::of(vehicle.file())?))?;
    let provenance = of_vehicle(vehicle, provenance);
    Ok(match simulator {
        Simulator::Gazebo => trackdyn_export::sdf::model(&robot, &provenance),
        Simulator::MuJoCo => trackdyn_export::mjcf::model(&robot, &provenance),
        Simulator::Usd => trackdyn_export::usd::stage(&robot, &provenance),
        Simulator::Chrono => trackdyn_export::chrono::model(&robot, &provenance),
    })
}

/// The origin of a file that is made from a vehicle.
fn of_vehicle(vehicle: &Vehicle, provenance: &Provenance) -> trackdyn_export::Provenance {
    let Provenance { command, version } = provenance.clone();
    trackdyn_export::Provenance {
        source: format!("vehicle {}", vehicle.name()),
        vehicle: vehicle.name().to_owned(),
        fingerprint: vehicle.fingerprint(),
        version,
        command,
    }
}

/// Smallest largest speed of a table, m/s, as of a map.
const MIN_TABLE_SPEED: f64 = trackdyn_model::Grid::MIN_SPEED;

/// Largest speed of a table, m/s.
const MAX_TABLE_SPEED: f64 = 100.0;

/// Writes exported files into a folder.
///
/// # Errors
/// [`Error::Output`].
pub fn write(files: &[TextFile], folder: impl AsRef<Path>) -> Result<Vec<Change>, Error> {
    let mut folder = Folder::prepare(folder.as_ref())?;
    for TextFile { name, text } in files {
        folder.write(name, text.as_bytes())?;
    }
    Ok(folder.changes())
}
