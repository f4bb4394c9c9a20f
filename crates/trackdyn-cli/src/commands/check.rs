//! `trackdyn check`: the regression check that a user's CI calls.

mod reference;

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{model, note_what_steady_icrs_leave_out, read_vehicle};
use crate::stderr::say;
use crate::stdout::show;
use clap::Args;
use reference::{Case, Reference};
use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::model::map::Statistics;
use trackdyn::crates::model::{Circumstance, VehicleFile};
use trackdyn::crates::model::{Grid, IcrMap, Status};

/// Options of `trackdyn check`.
#[derive(Args)]
pub struct Options {
    /// Reference file (schema trackdyn.reference/1)
    reference: PathBuf,
    /// Check this vehicle instead of those that the cases name; a case's cog_m and effects still replace its own
    #[arg(long, value_name = "FILE")]
    vehicle: Option<PathBuf>,
}

/// Recomputes every case, prints a table, and fails where a number leaves its tolerance.
pub fn run(options: &Options) -> Outcome {
    let document = Document::read(&options.reference)?;
    let reference = Reference::from_document(&document)?;
    let override_vehicle = options.vehicle.as_deref().map(read_vehicle).transpose()?;

    let mut text = String::new();
    let mut misses = 0;
    let mut checked = 0;
    for case in &reference.cases {
        let vehicle = vehicle(case, override_vehicle.as_ref(), options)?;
        note_what_steady_icrs_leave_out(&vehicle.effects);
        let statistics = solve(&vehicle, reference.grid, case);
        let _ = writeln!(text, "{}: {}", case.name, vehicle.vehicle.name);
        let _ = writeln!(
            text,
            "  {:26}{:>12}{:>12}{:>12}{:>12}",
            "", "expected", "computed", "off by", "tolerance"
        );
        for (quantity, expected) in &case.expect {
            let computed = quantity.of(statistics.as_ref());
            let error = computed - expected.value;
            // NaN is a miss.
            let holds = error.abs() <= expected.tolerance;
            misses += usize::from(!holds);
            checked += 1;
            let _ = writeln!(
                text,
                "  {:26}{:>12.6}{computed:>12.6}{error:>12.1e}{:>12.1e}  {}",
                quantity.key(),
                expected.value,
                expected.tolerance,
                if holds { "ok" } else { "MISS" }
            );
        }
    }
    let _ = writeln!(text, "{} of {checked} values within tolerance", checked - misses);
    show(&text)?;
    Ok(if misses == 0 { Exit::Done } else { Exit::BadInput })
}

/// The vehicle of a case: that of the command line, of the case, or the embedded one.
fn vehicle(
    case: &Case,
    override_vehicle: Option<&VehicleFile>,
    options: &Options,
) -> Result<VehicleFile, Box<dyn Error>> {
    let mut file = match (override_vehicle, &case.vehicle) {
        (Some(file), _) => file.clone(),
        (None, Some(path)) => {
            let folder = options.reference.parent().unwrap_or(std::path::Path::new("."));
            read_vehicle(&folder.join(path)).map_err(|error| of_case(options, case, &*error))?
        }
        (None, None) => VehicleFile::auriga_alpha(),
    };
    if let Some(cog) = case.cog {
        file.vehicle.cog = cog;
        file.vehicle.uncertainty.cog = None; // the file's is of the value that this one replaces
        file.vehicle.check().map_err(|error| of_case(options, case, &error))?;
    }
    for effect in &case.effects {
        file.effects.insert(effect.clone());
    }
    Ok(file)
}

/// What is wrong with a case.
fn of_case(options: &Options, case: &Case, error: &dyn Error) -> String {
    format!("{}: case \"{}\": {error}", options.reference.display(), case.name)
}

/// The means of a case's map; none where no motion turns.
fn solve(file: &VehicleFile, grid: Grid, case: &Case) -> Option<Statistics> {
    let map = IcrMap::solve(&model(file), grid, &Circumstance::default(), &|_| ());
    let counts = map.counts();
    let gaps = counts[Status::Lifts.index()] + counts[Status::NotConverged.index()];
    if gaps > 0 {
        say(format_args!(
            "note: case \"{}\": at {gaps} of {} pairs of speeds part of the contact lifts or no forces balance: \
             they enter no mean (expect turning_pairs to watch how many do)",
            case.name,
            map.solutions.len()
        ));
    }
    let statistics = map.statistics();
    if statistics.is_none() {
        say(format_args!("note: case \"{}\": no motion turns, so there are no ICRs", case.name));
    }
    statistics
}
