//! Cases on workers of Dask, which Python has: the rest is done by `trackdyn.fleet.trial`.

use super::Options;
use crate::commands::Outcome;
use std::error::Error;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// What the hand-over needs, and how Python is asked whether it is there.
const NEEDED: &str = "import distributed, trackdyn.fleet";

/// Hands the trial over. On Unix, this process becomes the one that takes it.
///
/// # Errors
/// Where there is no Python, or it lacks the package or Dask.
pub fn hand_over(options: &Options) -> Outcome {
    if options.shard.is_some() {
        return Err("--shard: workers of Dask take all cases: expected --executor local".into());
    }
    let python = python();
    let asked = Command::new(&python).args(["-c", NEEDED]).stdin(Stdio::null()).output();
    let install = "pip install trackdyn[fleet], or --executor local";
    let name = python.display();
    let asked = asked.map_err(|error| {
        format!("--executor dask: {name} cannot be started: {error}: expected Python: {install}")
    })?;
    if !asked.status.success() {
        let said = String::from_utf8_lossy(&asked.stderr);
        let reason = said.lines().last().unwrap_or("it does not say why").to_owned();
        return Err(format!(
            "--executor dask: {name}: {reason}: expected the packages trackdyn and distributed: \
             {install}"
        )
        .into());
    }
    let mut command = Command::new(&python);
    command.args(["-m", "trackdyn.fleet.trial"]).args(words(options));
    ended(&mut command)
}

/// The Python beside this program, as in an environment that brought both; else that of the path.
fn python() -> PathBuf {
    let name = if cfg!(windows) { "python.exe" } else { "python3" };
    let beside = std::env::current_exe().ok().map(|program| program.with_file_name(name));
    beside.filter(|path| path.exists()).unwrap_or_else(|| PathBuf::from(name))
}

/// The options as those of `trackdyn.fleet.trial`.
fn words(options: &Options) -> Vec<OsString> {
    let mut words: Vec<OsString> = vec![options.trial.clone().into()];
    let mut add = |option: &str, value: Option<OsString>| {
        words.extend(value.into_iter().flat_map(|value| [option.into(), value]));
    };
    add("--program", options.program.clone().map(Into::into));
    add("--name", options.name.as_ref().map(|name| name.name().into()));
    add("--limit", Some(options.limit.to_string().into()));
    add("--scheduler", options.scheduler.clone().map(Into::into));
    add("--workers", options.workers.map(|workers| workers.to_string().into()));
    if options.retry {
        words.push("--retry".into());
    }
    words
}

#[cfg(unix)]
fn ended(command: &mut Command) -> Outcome {
    use std::os::unix::process::CommandExt;
    Err(Box::<dyn Error>::from(format!("--executor dask: {}", command.exec())))
}

#[cfg(not(unix))]
fn ended(command: &mut Command) -> Outcome {
    use crate::exit::Exit;
    let status = command.status().map_err(|error| format!("--executor dask: {error}"))?;
    Ok(if status.success() { Exit::Done } else { Exit::BadInput })
}
