//! `trackdyn drive`: a path, followed with the ideal differential drive and with kinematic parameters.

mod document;

use crate::commands::Outcome;
use crate::earlier::remove_of;
use crate::exit::Exit;
use crate::options::{ModelOptions, finite, in_time, model, note_what_no_sensor_reports, of_drive};
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::output::{fingerprint, prepare_folder, write_file};
use trackdyn::crates::drive::tracking::{DriveOptions, Estimate};
use trackdyn::crates::drive::{Ending, Journey, Path, Steering, Tracker, drive};
use trackdyn::crates::model::Model;
use trackdyn::crates::model::kinematics::KinematicsFile;
use trackdyn::crates::model::{Kinematics, Transient};
use trackdyn::crates::report::{TrackedDrive, path_tracking};

/// Options of `trackdyn drive`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Path to follow, a table x,y in m [default: a square of 3 m, once to the left]
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,
    /// Parameters to drive with beside the ideal drive (schema trackdyn.kinematics/1); repeatable
    #[arg(long, value_name = "FILE")]
    kinematics: Vec<PathBuf>,
    /// How the robot knows its pose
    #[arg(long, value_enum, default_value_t = Knows::Truth)]
    estimate: Knows,
    /// Speed on open ground, m/s
    #[arg(long, value_name = "SPEED", default_value_t = Tracker::default().speed, value_parser = finite)]
    speed: f64,
    /// Look-ahead of the path tracker, m
    #[arg(long, value_name = "M", default_value_t = Tracker::default().look_ahead, value_parser = finite)]
    look_ahead: f64,
    /// Leave inertia out: the robot is at its stationary motion at once
    #[arg(long)]
    quasi_static: bool,
    /// Folder for drive.toml, drive.png and tables of the cross-track error
    #[arg(long, value_name = "DIR", default_value = "out/drive")]
    out: PathBuf,
}

/// How the robot knows its pose.
#[derive(Clone, Copy, ValueEnum)]
pub enum Knows {
    /// By a perfect localisation
    Truth,
    /// By dead reckoning with the same kinematics
    Odometry,
}

/// One drive.
pub struct Drive {
    name: String,
    fingerprint: Option<String>,
    journey: Journey,
}

/// Drives, prints the table of errors and writes the files.
pub fn run(options: &Options) -> Outcome {
    let mut file = options.model.vehicle_file()?;
    file.effects = in_time(file.effects, options.quasi_static);
    note_what_no_sensor_reports(&file.effects);
    let path = match &options.path {
        Some(path) => Path::read(path)?,
        None => Path::square(3.0, true, 1)?,
    };
    let mut steerings: Vec<(String, Option<String>, Box<dyn Steering>)> =
        vec![("ideal drive".to_owned(), None, Box::new(Kinematics::ideal(file.vehicle.gauge)))];
    // The point whose error counts lies where a robot turns about, by the first parameters.
    let mut point = [0.0, 0.0];
    for (index, path) in options.kinematics.iter().enumerate() {
        let document = Document::read(path)?;
        let parameters = KinematicsFile::from_document(&document)?;
        if index == 0 {
            // forward in both frames, on the middle line
            point = [parameters.y_icr_m, 0.0];
            if point[0].abs() > Tracker::FARTHEST {
                let (name, y, most) = (path.display(), point[0], Tracker::FARTHEST);
                return Err(format!("{name}: y_icr_m = {y}: expected at most {most} m from the middle, to follow a path with").into());
            }
        }
        let print = fingerprint(document.text().as_bytes());
        steerings.push((path.display().to_string(), Some(print), Box::new(parameters)));
    }
    let tracker = Tracker {
        speed: options.speed,
        look_ahead: options.look_ahead,
        point,
        ..Tracker::default()
    };
    if tracker.speed > tracker.belt_speed {
        let most = tracker.belt_speed;
        return Err(format!(
            "--speed {}: expected at most that of the tracks, {most} m/s",
            tracker.speed
        )
        .into());
    }
    prepare_folder(&options.out)?;

    let model = model(&file);
    let mut drives = Vec::new();
    for (name, fingerprint, steering) in steerings {
        let journey = follow(&model, &path, &tracker, &*steering, options)
            .map_err(|error| of_drive(&error))?;
        drives.push(Drive { name, fingerprint, journey });
    }

    let tracked: Vec<TrackedDrive> = drives
        .iter()
        .map(|drive| TrackedDrive { name: &drive.name, journey: &drive.journey })
        .collect();
    let knows = match options.estimate {
        Knows::Truth => "the robot knows its pose",
        Knows::Odometry => "the robot locates itself by dead reckoning",
    };
    let title = format!("{}: {knows}", file.vehicle.name);
    let vehicle = fingerprint(file.to_toml().as_bytes());
    let caption = format!("trackdyn {}, vehicle and effects {vehicle}", env!("CARGO_PKG_VERSION"));
    let picture = path_tracking(&path, &tracked, point, &title, &caption)?;
    write_file(&options.out.join("drive.png"), &picture)?;
    let table = |index: usize| options.out.join(format!("cross_track_{index}.csv"));
    for (index, drive) in drives.iter().enumerate() {
        write_file(&table(index), drive.journey.cross_track_csv().as_bytes())?;
    }
    let further = (drives.len()..).map(table).take_while(|table| table.exists());
    remove_of(&options.out.join("drive.toml"), further)?;
    write_file(&options.out.join("path.csv"), path.to_csv().as_bytes())?;
    let text = document::text(&file, &path, &tracker, &drives)?;
    write_file(&options.out.join("drive.toml"), text.as_bytes())?;
    show(&document::summary(&path, &tracker, &drives))?;
    say(format_args!("wrote drive.toml, drive.png and tables to {}", options.out.display()));
    let arrived = drives.iter().all(|drive| drive.journey.ending == Ending::Arrived);
    Ok(if arrived { Exit::Done } else { Exit::NoResult })
}

fn follow(
    model: &Model,
    path: &Path,
    tracker: &Tracker,
    steering: &dyn Steering,
    options: &Options,
) -> Result<Journey, trackdyn::crates::drive::Error> {
    const PARTS: usize = 1000;
    let mut robot = Transient::at_rest(model, 0.0, path.start());
    let estimate = match options.estimate {
        Knows::Truth => Estimate::Truth,
        Knows::Odometry => Estimate::Odometry,
    };
    let settings = DriveOptions { estimate, time_limit: None };
    let progress = Progress::new(PARTS);
    let done = AtomicUsize::new(0);
    let journey = drive(&mut robot, path, tracker, steering, &settings, &|share| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a share of a thousand"
        )]
        let part = (share.clamp(0.0, 1.0) * PARTS as f64) as usize;
        let before = done.fetch_max(part, Ordering::Relaxed);
        progress.advance(part.saturating_sub(before));
    });
    progress.finish();
    journey
}
