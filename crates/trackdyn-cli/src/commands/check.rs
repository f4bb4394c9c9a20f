//! `trackdyn check`: the regression check that a user's CI calls.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{note_what_steady_icrs_leave_out, say_default};
use crate::stderr::note;
use crate::stdout::show;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use trackdyn::check::CheckedCase;
use trackdyn::crates::model::Status;
use trackdyn::{Reference, Vehicle, check};

/// Options of `trackdyn check`.
#[derive(Args)]
pub struct Options {
    /// Reference file (schema trackdyn.reference/1)
    reference: PathBuf,
    /// Check this vehicle instead of those that the cases name; a case's cog_m and effects still
    /// replace its own
    #[arg(long, value_name = "FILE|NAME")]
    vehicle: Option<PathBuf>,
}

/// Recomputes every case, prints a table, and fails where a number leaves its tolerance.
pub fn run(options: &Options) -> Outcome {
    let reference = Reference::open(&options.reference)?;
    let vehicle = options.vehicle.as_deref().map(Vehicle::choose).transpose()?;

    let mut text = String::new();
    let mut misses = 0;
    let mut checked = 0;
    for case in &reference.cases {
        if vehicle.is_none() && case.vehicle.is_none() {
            say_default();
        }
        let case = check(&reference, case, vehicle.as_ref())?;
        note_what_steady_icrs_leave_out(case.vehicle.effects());
        note_gaps(&case);
        let _ = writeln!(text, "{}: {}", case.name, case.vehicle.name());
        let _ = writeln!(
            text,
            "  {:26}{:>12}{:>12}{:>12}{:>12}",
            "", "expected", "computed", "off by", "tolerance"
        );
        for number in &case.numbers {
            misses += usize::from(!number.holds());
            checked += 1;
            let (computed, error) = (number.computed, number.error());
            let _ = writeln!(
                text,
                "  {:26}{:>12.6}{computed:>12.6}{error:>12.1e}{:>12.1e}  {}",
                number.key,
                number.expected.value,
                number.expected.tolerance,
                if number.holds() { "ok" } else { "MISS" }
            );
        }
    }
    let _ = writeln!(text, "{} of {checked} values within tolerance", checked - misses);
    show(&text)?;
    Ok(if misses == 0 { Exit::Done } else { Exit::BadInput })
}

/// Notes motions that enter no mean.
fn note_gaps(case: &CheckedCase) {
    let (name, map) = (&case.name, case.map.solved());
    let counts = map.counts();
    let gaps = counts[Status::Tips.index()] + counts[Status::NotConverged.index()];
    if gaps > 0 {
        note(format_args!(
            "case \"{name}\": at {gaps} of {} pairs of speeds the robot tips over or no \
             forces balance: they enter no mean (expect turning_pairs to watch how many do)",
            map.solutions.len()
        ));
    }
    if case.map.statistics().is_none() {
        note(format_args!("case \"{name}\": no motion turns, so there are no ICRs"));
    }
}
