//! `trackdyn trial run`: a process per case, which sees nothing of the trial.
//!
//! Recording and vehicle are copied to a folder of their own under a name that is drawn, the process
//! starts there with an empty environment, and what it wrote is taken back when it has ended: neither
//! its arguments nor its working folder lead to the answers.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::progress::Progress;
use clap::Args;
use std::error::Error;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::str::FromStr;
use std::time::{Duration, Instant};
use trackdyn_core::output::write_file;
use trackdyn_trial::driving::HELD_OUT;
use trackdyn_trial::{diagnosis, folder};

/// Time between looks at a process.
const LOOK: Duration = Duration::from_millis(20);
/// Characters of a failed process' last words that are kept.
const LAST_WORDS: usize = 4000;
/// What the process says, and the folder that it writes to.
const TALK: &str = "stderr.txt";
const OUT: &str = "out";

/// Options of `trackdyn trial run`.
#[derive(Args)]
pub struct Options {
    /// Folder of the trial
    trial: PathBuf,
    /// Take every N-th case only, from the I-th on (1 to N)
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Program that is called as `PROGRAM diagnose RECORDING --vehicle FILE --held-out LIST --out DIR`
    /// [default: this one]
    #[arg(long, value_name = "PROGRAM")]
    tool: Option<PathBuf>,
    /// Time after which a process is ended and counts as failed, s
    #[arg(long, value_name = "SECONDS", default_value_t = 3600)]
    limit: u64,
    /// Run cases again whose process failed
    #[arg(long)]
    retry: bool,
}

/// A part of the cases.
#[derive(Clone, Copy)]
struct Shard {
    index: usize,
    of: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(index, of)| {
            Some(Self { index: index.parse().ok()?, of: of.parse().ok()? })
        });
        parts
            .filter(|shard| (1..=shard.of).contains(&shard.index))
            .ok_or_else(|| "expected I/N with I from 1 to N, such as 2/4".to_owned())
    }
}

/// Diagnoses the cases that have not been.
pub fn run(options: &Options) -> Outcome {
    let tool = match &options.tool {
        Some(tool) => std::path::absolute(tool)?,
        None => std::env::current_exe()?,
    };
    let cases = folder::cases(&options.trial)?;
    if cases.is_empty() {
        return Err(format!(
            "{}: no cases: expected a folder of trial make",
            options.trial.display()
        )
        .into());
    }
    let Shard { index, of } = options.shard.unwrap_or(Shard { index: 1, of: 1 });
    let mine: Vec<&PathBuf> = cases.iter().skip(index - 1).step_by(of).collect();
    let is_done = |case: &Path| {
        case.join(folder::DIAGNOSIS).join(diagnosis::FILE).exists()
            || (!options.retry && case.join(folder::FAILURE).exists())
    };
    let open: Vec<&PathBuf> = mine.iter().copied().filter(|case| !is_done(case)).collect();
    let progress = Progress::new(open.len());
    let mut failed = 0;
    for case in &open {
        if let Err(reason) = diagnose(case, &tool, Duration::from_secs(options.limit)) {
            failed += 1;
            let name = case.file_name().unwrap_or_default().to_string_lossy();
            eprintln!("{name}: {}", reason.to_string().lines().next().unwrap_or_default());
            write_file(&case.join(folder::FAILURE), reason.to_string().as_bytes())?;
        }
        progress.advance(1);
    }
    progress.finish();
    let before = mine.len() - open.len();
    println!(
        "{} cases: {} diagnosed now, {failed} failed, {before} before",
        mine.len(),
        open.len() - failed
    );
    Ok(Exit::Done)
}

/// Diagnoses a case in a folder of its own, and takes back what was written.
fn diagnose(case: &Path, tool: &Path, limit: Duration) -> Result<(), Box<dyn Error>> {
    let room = tempfile::Builder::new().prefix("trackdyn-").tempdir()?;
    copy(&case.join(folder::RECORDING), &room.path().join(folder::RECORDING))?;
    fs::copy(case.join(folder::VEHICLE), room.path().join(folder::VEHICLE))?;
    let started = Instant::now();
    let status = run_tool(tool, room.path(), limit)?;
    let seconds = started.elapsed().as_secs_f64();
    let written = room.path().join(OUT);
    if !(status.is_some_and(|status| status.success()) && written.join(diagnosis::FILE).exists()) {
        let how = match status {
            None => format!("was ended after {} s", limit.as_secs()),
            Some(status) if status.success() => format!("wrote no {}", diagnosis::FILE),
            Some(status) => format!("ended with {status}"),
        };
        let words = fs::read_to_string(room.path().join(TALK)).unwrap_or_default();
        let start = words.char_indices().rev().nth(LAST_WORDS).map_or(0, |(place, _)| place);
        return Err(format!("the process {how}\n{}", &words[start..]).into());
    }
    write_file(&written.join("run.toml"), format!("seconds = {seconds:.3}\n").as_bytes())?;
    let partial = case.join(".diagnosis");
    if partial.exists() {
        fs::remove_dir_all(&partial)?;
    }
    copy(&written, &partial)?;
    let place = case.join(folder::DIAGNOSIS);
    if place.exists() {
        fs::remove_dir_all(&place)?;
    }
    fs::rename(&partial, &place)?;
    let failure = case.join(folder::FAILURE);
    if failure.exists() {
        fs::remove_file(failure)?;
    }
    Ok(())
}

/// Runs the tool in a room; none where it took too long.
fn run_tool(tool: &Path, room: &Path, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let mut command = Command::new(tool);
    command
        .args(["diagnose", folder::RECORDING, "--vehicle", folder::VEHICLE])
        .args(["--held-out", HELD_OUT, "--out", OUT])
        .current_dir(room)
        .env_clear()
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(File::create(room.join(TALK))?);
    for name in ["PATH", "RAYON_NUM_THREADS"] {
        if let Some(value) = std::env::var_os(name) {
            command.env(name, value);
        }
    }
    let mut process = command.spawn()?;
    let started = Instant::now();
    loop {
        if let Some(status) = process.try_wait()? {
            return Ok(Some(status));
        }
        if started.elapsed() > limit {
            process.kill()?;
            process.wait()?;
            return Ok(None);
        }
        std::thread::sleep(LOOK);
    }
}

/// Copies the files of a folder and of those in it.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy(&path, &target)?;
        } else {
            fs::copy(&path, &target)?;
        }
    }
    Ok(())
}
