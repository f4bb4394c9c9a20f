//! `trackdyn export`: kinematics and drives as files of other programs.

use crate::changes::{say_doubtful, say_written, written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{ModelOptions, ReplayOptions, pair};
use crate::provenance::provenance;
use crate::stderr::{note, say, warn};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trackdyn::crates::core::PerSide;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::export::ros2::Published;
use trackdyn::crates::export::{Name, NodeName, Residuals, TextFile};
use trackdyn::export::{
    FrameSettings, GzSettings, Ros2Settings, Simulator, WheelChoices, motion_table, simulator,
    write,
};
use trackdyn::{Error, Export, Grid};

/// Options of `trackdyn export`.
#[derive(Args)]
pub struct Options {
    /// For which program
    #[command(subcommand)]
    target: Target,
}

#[derive(Subcommand)]
enum Target {
    /// Parameters of ros2_control's diff_drive_controller, and a launch file that ties its frame to
    /// the robot
    Ros2(Ros2Options),
    /// The TrackedVehicle plugin of Gazebo's gz-sim, as SDF
    Gz(GzOptions),
    /// The frame at which the robot is an ideal differential drive, as a URDF/xacro fragment
    UrdfFrames(UrdfOptions),
    /// Steady motion by the forces on a vehicle, with derivatives, for the robot's computer: a
    /// table and a C header
    Table(TableOptions),
    /// A vehicle with its effects for Gazebo's gz-sim, as SDF
    Sdf(SimulatorOptions),
    /// A vehicle with its effects for MuJoCo, as MJCF: rollers that drive
    Mjcf(SimulatorOptions),
    /// A vehicle with its effects for Isaac Sim, as USD: an articulation
    Usd(SimulatorOptions),
    /// A vehicle's mass properties and contact materials for Project Chrono, as JSON
    Chrono(SimulatorOptions),
    /// A drive for Foxglove, Rerun and PlotJuggler: its path, those of the ideal drive and of
    /// kinematics files, ICRs, speeds and residuals, as messages of ROS 2
    Mcap(Box<McapOptions>),
}

#[derive(Args)]
struct Ros2Options {
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    frames: FrameOptions,
    /// Belt travel in m per radian of the wheel joint: the pitch radius of the sprocket [default:
    /// that with which the log was read]
    #[arg(long, value_name = "M")]
    wheel_radius: Option<f64>,
    /// Wheel joint on the left; repeatable [default: those of the log, else left_wheel_joint]
    #[arg(long, value_name = "JOINT", alias = "left-wheel")]
    left_joint: Vec<Name>,
    /// Wheel joint on the right; repeatable [default: those of the log, else right_wheel_joint]
    #[arg(long, value_name = "JOINT", alias = "right-wheel")]
    right_joint: Vec<Name>,
    /// Name of the controller
    #[arg(long, value_name = "NAME", default_value = Ros2Settings::CONTROLLER)]
    controller: NodeName,
    /// Odometry file (schema trackdyn.odometry/1) of a replay with these kinematics, best of runs
    /// that they were not fitted to: for the covariances
    #[arg(long, value_name = "FILE")]
    residuals: Option<PathBuf>,
    /// Rate in Hz at which the controller publishes, for the covariances
    #[arg(long, value_name = "HZ", default_value_t = Published::DEFAULT_RATE,
          requires = "residuals")]
    publish_rate: f64,
}

impl Ros2Options {
    /// What the kinematics file does not know of the robot.
    fn settings(&self, export: &Export) -> Result<Ros2Settings, Error> {
        let wheels = export.wheels(&WheelChoices {
            joints: PerSide::new(self.left_joint.clone(), self.right_joint.clone()),
            wheel_radius: self.wheel_radius,
        })?;
        if !wheels.from_log.is_empty() {
            let taken = wheels.from_log.join("; ");
            note(format_args!("{taken}: those of the log of {}", export.name()));
        }
        if !wheels.usual.is_empty() {
            let usual = wheels.usual.join("; ");
            note(format_args!(
                "{usual}: the usual names, for the log of {} names no wheel joints; the robot may \
                 have others (--left-joint, --right-joint)",
                export.name()
            ));
        }
        Ok(Ros2Settings {
            frames: self.frames.settings(export)?,
            left_wheels: wheels.joints.left,
            right_wheels: wheels.joints.right,
            controller: self.controller.clone(),
            residuals: self.residuals(export)?,
            publish_rate: self.publish_rate,
            ..Ros2Settings::new(wheels.wheel_radius)
        })
    }

    /// Residuals of the kinematics, where there is a file of them.
    fn residuals(&self, export: &Export) -> Result<Option<Residuals>, Error> {
        let Some(path) = &self.residuals else { return Ok(None) };
        let residuals = export.residuals(&Document::read(path)?)?;
        if !residuals.held_out {
            warn(format_args!(
                "the residuals in {} are of runs that the kinematics were fitted to: covariances \
                 come out too small (replay others, with --runs or --time)",
                residuals.source
            ));
        }
        Ok(Some(residuals))
    }
}

#[derive(Args)]
struct GzOptions {
    #[command(flatten)]
    files: Files,
    /// Link of a track on the left; repeatable
    #[arg(long, value_name = "LINK", default_values_t = GzSettings::default().left_tracks)]
    left_track: Vec<Name>,
    /// Link of a track on the right; repeatable
    #[arg(long, value_name = "LINK", default_values_t = GzSettings::default().right_tracks)]
    right_track: Vec<Name>,
}

#[derive(Args)]
struct UrdfOptions {
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    frames: FrameOptions,
}

#[derive(Args)]
struct TableOptions {
    #[command(flatten)]
    model: ModelOptions,
    /// Largest track speed in m/s
    #[arg(long, value_name = "SPEED", default_value_t = Grid::PAPER_SPEED)]
    fastest: f64,
    /// Folder for motion_table.toml and trackdyn_motion.h
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

impl TableOptions {
    fn run(&self) -> Outcome {
        let vehicle = self.model.vehicle()?;
        let (table, files) = motion_table(&vehicle, self.fastest, &provenance())?;
        say_written(&write(&files, &self.out)?);
        let (error, [sizes, angles]) = (table.error, table.orders);
        note(format_args!(
            "{} polynomials a sector; largest difference from the model {error:.1e} m/s",
            sizes * angles
        ));
        Ok(Exit::Done)
    }
}

#[derive(Args)]
struct SimulatorOptions {
    #[command(flatten)]
    model: ModelOptions,
    /// Folder for the file, whose comments say which effects it has and which it has not
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

impl SimulatorOptions {
    fn run(&self, program: Simulator) -> Outcome {
        let file = simulator(&self.model.vehicle()?, program, &provenance())?;
        say_written(&write(&[file], &self.out)?);
        Ok(Exit::Done)
    }
}

#[derive(Args)]
struct McapOptions {
    /// Folder for odometry.mcap, odometry.foxglove.json and odometry.plotjuggler.xml
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    replay: ReplayOptions,
}

/// What is read and where to write.
#[derive(Args)]
struct Files {
    /// Kinematics file (schema trackdyn.kinematics/1)
    kinematics: PathBuf,
    /// Folder for the files
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

#[derive(Args)]
struct FrameOptions {
    /// Frame of the odometry
    #[arg(long, value_name = "FRAME", default_value_t = FrameSettings::default().odom)]
    odom_frame: Name,
    /// Frame midway between the ICRs: parent of the base frame
    #[arg(long, value_name = "FRAME", default_value_t = FrameSettings::default().icr)]
    icr_frame: Name,
    /// Root link of the robot's URDF [default: the frame whose poses the log has, else base_link]
    #[arg(long, value_name = "FRAME")]
    base_frame: Option<Name>,
    /// Origin of the ICRs in the base frame, in m: forward, left (x, y of ROS, as in the URDF; not
    /// the order of --cog, which is right, forward). Of a map it is the centre of the contact area
    /// of both tracks; of a recording the frame of its poses
    #[arg(long, value_name = "FORWARD,LEFT", value_parser = pair, default_value = "0,0",
          allow_hyphen_values = true)]
    contact_centre: [f64; 2],
}

impl FrameOptions {
    fn settings(&self, export: &Export) -> Result<FrameSettings, Error> {
        let base = export.base_frame(self.base_frame.as_ref())?;
        let name = &base.name;
        match (&base.of_log, &self.base_frame) {
            (Some(frame), None) => note(format_args!(
                "base frame {frame}: the one whose poses the log has; the URDF has to have it as \
                 its root link (--base-frame)"
            )),
            (Some(frame), Some(_)) if *frame != name.to_string() => note(format_args!(
                "ICRs are measured in {frame}, whose poses the log has: --contact-centre has to be \
                 its origin in {name}"
            )),
            _ => {}
        }
        Ok(FrameSettings {
            odom: self.odom_frame.clone(),
            icr: self.icr_frame.clone(),
            base: base.name,
            contact_centre: self.contact_centre,
        })
    }
}

/// Writes the files of one program and names them.
pub fn run(options: &Options) -> Outcome {
    match &options.target {
        Target::Ros2(options) => {
            export(&options.files, |export| export.ros2(&options.settings(export)?))
        }
        Target::Gz(options) => export(&options.files, |export| {
            export.gz(&GzSettings {
                left_tracks: options.left_track.clone(),
                right_tracks: options.right_track.clone(),
            })
        }),
        Target::UrdfFrames(options) => {
            export(&options.files, |export| export.urdf(&options.frames.settings(export)?))
        }
        Target::Table(options) => options.run(),
        Target::Sdf(options) => options.run(Simulator::Gazebo),
        Target::Mjcf(options) => options.run(Simulator::MuJoCo),
        Target::Usd(options) => options.run(Simulator::Usd),
        Target::Chrono(options) => options.run(Simulator::Chrono),
        Target::Mcap(options) => {
            let replay = options.replay.replay()?;
            say_written(&replay.write_layers(&options.out, &provenance())?);
            Ok(Exit::Done)
        }
    }
}

/// Reads the kinematics, writes the files that are made of them and names them.
fn export(files: &Files, made: impl FnOnce(&Export) -> Result<Vec<TextFile>, Error>) -> Outcome {
    let export = Export::open(&files.kinematics, &provenance())?;
    let name = files.kinematics.display();
    let exported = made(&export)?;
    if export.drive().is_separation_alone {
        warn(format_args!(
            "{name} holds the distance of the ICRs alone; the point midway between them is taken \
             for the origin of the base frame"
        ));
    }
    if export.drive().is_doubtful {
        say_doubtful(&name.to_string());
    }
    let sectors = export.drive().sectors;
    if sectors > 0 {
        warn(format_args!(
            "{name} is piecewise with {sectors} sectors; the constants of the whole map \
            stand for all of them"
        ));
    }
    let changes = write(&exported, &files.out)?;
    let written: Vec<String> = written(&changes).map(|path| path.display().to_string()).collect();
    say(format_args!("wrote {}; {}", written.join(" and "), export.vehicle()));
    Ok(Exit::Done)
}
