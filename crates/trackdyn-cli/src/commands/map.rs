//! `trackdyn map`: ICR map, kinematic parameters, picture.

mod summary;

use crate::changes::{say_undetermined, written};
use crate::commands::Outcome;
use crate::exit::Exit;
use crate::folder::prepare_folder;
use crate::options::{CircumstanceOptions, ModelOptions, count, note_what_steady_icrs_leave_out};
use crate::progress::Progress;
use crate::provenance::provenance;
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use std::path::PathBuf;
use trackdyn::{Grid, IcrMap, MapSettings};

/// Options of `trackdyn map`.
#[derive(Args)]
pub struct Options {
    /// Speeds per track
    #[arg(long, value_name = "N", default_value_t = MapSettings::POINTS, value_parser = count)]
    grid: usize,
    /// Largest track speed in m/s
    #[arg(long, value_name = "SPEED", alias = "speed", default_value_t = Grid::PAPER_SPEED)]
    fastest: f64,
    /// Folder for kinematics.toml and icr_map.png
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    circumstance: CircumstanceOptions,
}

/// Solves the map, prints its parameters and writes the files.
pub fn run(options: &Options) -> Outcome {
    let grid = Grid::new(options.grid, options.fastest);
    let grid =
        grid.map_err(|error| format!("--{}", error.to_string().replacen("speed", "fastest", 1)))?;
    let vehicle = options.model.vehicle()?;
    IcrMap::refuse_other(&options.out)?;
    prepare_folder(&options.out)?;
    note_what_steady_icrs_leave_out(vehicle.effects());
    let settings = MapSettings { grid, circumstance: options.circumstance.circumstance() };
    let map = Progress::over(|observer| IcrMap::solve(&vehicle, &settings, observer))?;
    let changes = map.write(&options.out, &provenance())?;
    say_undetermined(&changes);
    show(&summary::text(&vehicle, &map))?;
    let files: Vec<String> = written(&changes).map(|path| path.display().to_string()).collect();
    match files.as_slice() {
        [picture, parameters] => {
            say(format_args!("wrote {parameters} and {picture}"));
            Ok(Exit::Done)
        }
        files => {
            let files = files.join(" and ");
            say(format_args!("wrote {files}; no kinematics.toml, for no motion turns"));
            Ok(Exit::NoResult)
        }
    }
}
