//! Schedules as CSV: `t,v_left,v_right`, and `run` where there are several.

use super::ScheduledRun;
use crate::Error;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use trackdyn_core::output::{OutputError, write_file};
use trackdyn_core::{Command, PerSide, Schedule};
use trackdyn_model::Grid;
use trackdyn_recording::table::Table;

const COLUMNS: [&str; 3] = ["t", "v_left", "v_right"];

/// Reads a table of commands: s and m/s, forward positive. Each holds until the next; the last one
/// of a run ends it.
///
/// # Errors
/// [`Error::Recording`] with line and column of a cell that is not a number, a time that does not
/// increase within its run, or a speed above 1000 m/s; [`Error::TooLittle`] for a run with a single
/// row.
pub fn read(path: &Path) -> Result<Vec<ScheduledRun>, Error> {
    let mut table = Table::open(path, &COLUMNS)?;
    let [time, left, right] = COLUMNS.map(|name| table.column(name).unwrap_or_default());
    let run = table.column("run");
    let mut runs: BTreeMap<i64, Vec<Command>> = BTreeMap::new();
    while table.advance()? {
        let id = run.map_or(Ok(0), |column| table.integer(column))?;
        let t = table.finite(time)?;
        let commands = runs.entry(id).or_default();
        if commands.last().is_some_and(|last| t <= last.t) {
            let expected = "a time after that of the row before it in its run";
            return Err(table.cell_error(time, expected).into());
        }
        let speed = |column| {
            let speed = table.finite(column)?;
            if speed.abs() <= Grid::MAX_SPEED {
                Ok(speed)
            } else {
                Err(table.cell_error(column, "a speed from -1000 to 1000 m/s"))
            }
        };
        commands.push(Command { t, speeds: PerSide::new(speed(left)?, speed(right)?) });
    }
    let too_little = |found| Error::TooLittle {
        path: path.to_owned(),
        found,
        expected: "a row to start with and one to end with",
    };
    if runs.is_empty() {
        return Err(too_little("no rows below the header".to_owned()));
    }
    runs.into_iter()
        .map(|(id, commands)| {
            let schedule = Schedule::new(commands)
                .map_err(|_| too_little(format!("run {id} has a single row")))?;
            Ok(ScheduledRun { id, schedule })
        })
        .collect()
}

/// The text of a table; numbers are printed so that reading them gives the same bits.
pub fn text(runs: &[ScheduledRun]) -> String {
    let with_runs = runs.len() > 1 || runs.iter().any(|run| run.id != 0);
    let mut text = String::from(if with_runs { "run," } else { "" });
    text.push_str("t,v_left,v_right\n");
    for run in runs {
        for Command { t, speeds: PerSide { left, right } } in run.schedule.commands() {
            if with_runs {
                let _ = write!(text, "{},", run.id);
            }
            let _ = writeln!(text, "{t},{left},{right}");
        }
    }
    text
}

/// Writes a table.
///
/// # Errors
/// [`OutputError`].
pub fn write(path: &Path, runs: &[ScheduledRun]) -> Result<(), OutputError> {
    write_file(path, text(runs).as_bytes())
}
