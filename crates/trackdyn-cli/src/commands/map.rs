//! `trackdyn map`: ICR map, kinematic parameters, picture.

mod summary;

use crate::commands::Outcome;
use crate::earlier::remove_earlier;
use crate::exit::Exit;
use crate::options::{
    CircumstanceOptions, ModelOptions, command_line, count, model, note_what_steady_icrs_leave_out,
};
use crate::progress::Progress;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::crates::core::output::{fingerprint, prepare_folder, write_file};
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::model::kinematics::{GridSource, KinematicsFile, Source};
use trackdyn::crates::model::{Grid, IcrMap, Status};

/// Options of `trackdyn map`.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    circumstance: CircumstanceOptions,
    /// Speeds per track
    #[arg(long, value_name = "N", default_value_t = 21, value_parser = count)]
    grid: usize,
    /// Largest track speed in m/s
    #[arg(long, value_name = "SPEED", default_value_t = Grid::PAPER_SPEED)]
    speed: f64,
    /// Folder for kinematics.toml and icr_map.png
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
}

/// Solves the map, prints its parameters and writes the files.
pub fn run(options: &Options) -> Outcome {
    let grid = Grid::new(options.grid, options.speed).map_err(|error| format!("--{error}"))?;
    let file = options.model.vehicle_file()?;
    prepare_folder(&options.out)?;

    note_what_steady_icrs_leave_out(&file.effects);
    let model = model(&file);
    let progress = Progress::new(grid.points() * grid.points());
    let map = IcrMap::solve(&model, grid, &options.circumstance.circumstance(), &|pairs| {
        progress.advance(pairs);
    });
    progress.finish();

    let statistics = map.statistics();
    let summary = summary::text(&file, &map, statistics.as_ref());
    let picture = options.out.join("icr_map.png");
    let source = source(&file, &map);
    let caption =
        format!("trackdyn {}, vehicle and effects {}", source.version, source.fingerprint);
    write_file(&picture, &trackdyn::crates::report::icr_map(&map, &model, &caption)?)?;
    let parameters = options.out.join("kinematics.toml");
    let Some(statistics) = statistics else {
        remove_earlier(&parameters, |source| source.grid.is_some())?;
        show(&summary)?;
        say(format_args!("wrote {}; no kinematics.toml, for no motion turns", picture.display()));
        return Ok(Exit::NoResult);
    };
    let contents =
        KinematicsFile::of_map(&statistics, &map.sectors(), source).with_alpha(model.drive().gain);
    write_file(&parameters, contents.to_toml().as_bytes())?;
    show(&summary)?;
    say(format_args!("wrote {} and {}", parameters.display(), picture.display()));
    Ok(Exit::Done)
}

/// Where the numbers come from.
fn source(file: &VehicleFile, map: &IcrMap) -> Source {
    let motions = Status::NAMES
        .iter()
        .zip(map.counts())
        .filter(|(_, count)| *count > 0)
        .map(|(name, count)| (name.replace(' ', "_"), count))
        .collect();
    Source {
        command: command_line(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        vehicle: file.vehicle.name.clone(),
        fingerprint: fingerprint(file.to_toml().as_bytes()),
        grid: Some(GridSource { points: map.grid.points(), max_speed_m_s: map.grid.max_speed() }),
        effects: file.effects.iter().map(ToString::to_string).collect(),
        motions: Some(motions),
        ..Source::default()
    }
}
