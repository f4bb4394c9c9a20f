//! Conceals every effect of the catalogue, at three sizes and in two kinds of driving, on the
//! independent ground, and asks the diagnosis for it.
//!
//! `recovery --out DIR [--only ID,ID,...] [--driving manual|designed] [--runs N]` writes a line per
//! case to `DIR/recovery.csv`. Cases that have a line are skipped, so a run can be stopped and
//! continued. From all lines it then makes `recovery.md`, `confusion.csv` and `confusion.png`.

mod case;
mod confusion;
mod figure;
mod table;

use case::{Case, Setting};
use confusion::Confusion;
use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;
use table::Table;
use trackdyn_core::output::{prepare_folder, write_file};
use trackdyn_drive::ScheduleKind;

const USAGE: &str =
    "usage: recovery --out DIR [--only ID,ID,...] [--driving manual|designed] [--runs N]";

/// What is asked for.
struct Arguments {
    out: PathBuf,
    only: Option<Vec<String>>,
    driving: Option<ScheduleKind>,
    runs: usize,
}

fn arguments() -> Result<Arguments, Box<dyn Error>> {
    let mut found = Arguments { out: PathBuf::new(), only: None, driving: None, runs: 9 };
    let mut texts = std::env::args().skip(1);
    while let Some(key) = texts.next() {
        let value = texts.next().ok_or(USAGE)?;
        match key.as_str() {
            "--out" => found.out = value.into(),
            "--only" => found.only = Some(value.split(',').map(str::to_owned).collect()),
            "--driving" => found.driving = Some(value.parse()?),
            "--runs" => found.runs = value.parse()?,
            _ => return Err(USAGE.into()),
        }
    }
    if found.out.as_os_str().is_empty() { Err(USAGE.into()) } else { Ok(found) }
}

fn main() -> Result<(), Box<dyn Error>> {
    let Arguments { out, only, driving, runs } = arguments()?;
    prepare_folder(&out)?;
    let path = out.join("recovery.csv");
    let mut table = Table::read(&path)?;
    let asked = |setting: &&Setting| {
        only.as_ref().is_none_or(|only| only.iter().any(|id| id == setting.id()))
            && driving.is_none_or(|driving| driving == setting.driving)
    };
    let all = Setting::all();
    let asked: Vec<&Setting> = all.iter().filter(asked).collect();
    let begun = Instant::now();
    for (number, setting) in asked.iter().enumerate() {
        if table.holds(setting) {
            continue;
        }
        let case = Case::of(setting, runs);
        eprintln!(
            "{} of {}, {:.0} s: {} {} {}: {}",
            number + 1,
            asked.len(),
            begun.elapsed().as_secs_f64(),
            setting.id(),
            setting.size.name(),
            setting.driving.name(),
            case.in_short()
        );
        table.add(setting, &case);
        write_file(&path, table.csv().as_bytes())?;
    }
    let confusion = Confusion::of(&table);
    write_file(&out.join("recovery.md"), table.markdown().as_bytes())?;
    write_file(&out.join("confusion.csv"), confusion.csv().as_bytes())?;
    write_file(&out.join("confusion.png"), &figure::of(&confusion).to_small_png()?)?;
    print!("{}", table.summary());
    eprintln!(
        "wrote recovery.csv, recovery.md, confusion.csv and confusion.png to {}",
        out.display()
    );
    Ok(())
}
