//! `trackdyn export`: the kinematics as files of other programs.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{command_line, pair};
use crate::stderr::say;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::output::{fingerprint, prepare_folder, write_file};
use trackdyn::crates::export::ros2::{Published, Wheels};
use trackdyn::crates::export::{
    EquivalentDrive, Error, Frames, Name, NodeName, Provenance, Residuals, TextFile, gz, ros2, urdf,
};

/// Options of `trackdyn export`.
#[derive(Args)]
pub struct Options {
    /// For which program
    #[command(subcommand)]
    target: Target,
}

#[derive(Subcommand)]
enum Target {
    /// Parameters of ros2_control's diff_drive_controller, and a launch file that ties its frame to the robot
    Ros2(Ros2Options),
    /// The TrackedVehicle plugin of Gazebo's gz-sim, as SDF
    Gz(GzOptions),
    /// The frame at which the robot is an ideal differential drive, as a URDF/xacro fragment
    UrdfFrames(UrdfOptions),
}

#[derive(Args)]
struct Ros2Options {
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    frames: FrameOptions,
    /// Belt travel in m per radian of the wheel joint: the pitch radius of the sprocket
    #[arg(long, value_name = "M")]
    wheel_radius: f64,
    /// Wheel joint on the left; repeatable
    #[arg(long, value_name = "JOINT", default_value = "left_wheel_joint")]
    left_wheel: Vec<Name>,
    /// Wheel joint on the right; repeatable
    #[arg(long, value_name = "JOINT", default_value = "right_wheel_joint")]
    right_wheel: Vec<Name>,
    /// Name of the controller
    #[arg(long, value_name = "NAME", default_value = "diff_drive_controller")]
    controller: NodeName,
    /// Odometry file (schema trackdyn.odometry/1) of a replay with these kinematics, best of runs that they were
    /// not fitted to: for the covariances
    #[arg(long, value_name = "FILE")]
    residuals: Option<PathBuf>,
    /// Rate in Hz at which the controller publishes, for the covariances
    #[arg(long, value_name = "HZ", default_value_t = Published::DEFAULT_RATE,
          requires = "residuals")]
    publish_rate: f64,
}

impl Ros2Options {
    /// Residuals of the kinematics with this fingerprint, where there is a file of them.
    fn published(
        &self,
        fingerprint: &str,
    ) -> Result<Option<Published>, Box<dyn std::error::Error>> {
        let Some(path) = &self.residuals else { return Ok(None) };
        let residuals =
            Residuals::from_document(&Document::read(path)?, fingerprint).map_err(|error| {
                match error.downcast::<Error>() {
                    Ok(error) => option(*error).into(),
                    Err(error) => error,
                }
            })?;
        if !residuals.held_out {
            say(format_args!(
                "warning: the residuals in {} are of runs that the kinematics were fitted to: covariances \
                 come out too small (replay others, with --runs or --time)",
                residuals.source
            ));
        }
        Ok(Some(Published::new(residuals, self.publish_rate).map_err(option)?))
    }
}

#[derive(Args)]
struct GzOptions {
    #[command(flatten)]
    files: Files,
    /// Link of a track on the left; repeatable
    #[arg(long, value_name = "LINK", default_value = "left_track")]
    left_track: Vec<Name>,
    /// Link of a track on the right; repeatable
    #[arg(long, value_name = "LINK", default_value = "right_track")]
    right_track: Vec<Name>,
}

#[derive(Args)]
struct UrdfOptions {
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    frames: FrameOptions,
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
    #[arg(long, value_name = "FRAME", default_value = "odom")]
    odom_frame: Name,
    /// Frame midway between the ICRs: parent of the base frame
    #[arg(long, value_name = "FRAME", default_value = "icr_link")]
    icr_frame: Name,
    /// Root link of the robot's URDF
    #[arg(long, value_name = "FRAME", default_value = "base_link")]
    base_frame: Name,
    /// Origin of the ICRs in the base frame, in m: forward, left (ROS axes). Of a map it is the centre of the contact area of
    /// both tracks; of a recording the frame of its poses
    #[arg(long, value_name = "X,Y", value_parser = pair, default_value = "0,0",
          allow_hyphen_values = true)]
    contact_centre: [f64; 2],
}

impl FrameOptions {
    fn frames(&self) -> Result<Frames, String> {
        let (odom, icr) = (self.odom_frame.clone(), self.icr_frame.clone());
        Frames::new(odom, icr, self.base_frame.clone(), self.contact_centre).map_err(option)
    }
}

/// Reads the kinematics, writes the files of one program and names them.
pub fn run(options: &Options) -> Outcome {
    let files = match &options.target {
        Target::Ros2(options) => &options.files,
        Target::Gz(options) => &options.files,
        Target::UrdfFrames(options) => &options.files,
    };
    let document = Document::read(&files.kinematics)?;
    let drive = EquivalentDrive::from_document(&document)?;
    let provenance = Provenance {
        source: document.name().to_owned(),
        fingerprint: fingerprint(document.text().as_bytes()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        command: command_line(),
    };
    let exported = export(&options.target, &drive, &provenance)?;

    if drive.sectors > 0 {
        say(format_args!(
            "warning: {} is piecewise with {} sectors; the constants of the whole map stand for all of them",
            document.name(),
            drive.sectors
        ));
    }
    prepare_folder(&files.out)?;
    let mut written = Vec::new();
    for TextFile { name, text } in exported {
        let path = files.out.join(name);
        write_file(&path, text.as_bytes())?;
        written.push(path.display().to_string());
    }
    say(format_args!("wrote {}", written.join(" and ")));
    Ok(Exit::Done)
}

/// The files of one program.
fn export(
    target: &Target,
    drive: &EquivalentDrive,
    provenance: &Provenance,
) -> Result<Vec<TextFile>, Box<dyn std::error::Error>> {
    Ok(match target {
        Target::Ros2(options) => {
            let frames = options.frames.frames()?;
            let (left, right) = (options.left_wheel.clone(), options.right_wheel.clone());
            let wheels = Wheels::new(options.wheel_radius, left, right).map_err(option)?;
            let published = options.published(&provenance.fingerprint)?;
            let controller = &options.controller;
            ros2::files(drive, &frames, &wheels, controller, published.as_ref(), provenance)
        }
        Target::Gz(options) => {
            let (left, right) = (&options.left_track, &options.right_track);
            vec![gz::plugin(drive, left, right, provenance).map_err(option)?]
        }
        Target::UrdfFrames(options) => {
            vec![urdf::fragment(drive, &options.frames.frames()?, provenance)]
        }
    })
}

/// The message of an error in an option: errors begin with its name.
#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
fn option(error: Error) -> String {
    format!("--{error}")
}
