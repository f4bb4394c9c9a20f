//! A room of its own for a process: a folder under a name that is drawn, without the caller's
//! environment.
//!
//! What the process gets is copied in, what it wrote is taken out when it has ended: neither its
//! arguments nor its working folder lead to anything else.

use crate::error::Error;
use std::any::Any;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Time between two looks at a process.
const POLL_INTERVAL: Duration = Duration::from_millis(20);
/// Largest number of characters that are kept of the last words of a failed process.
const MAX_LAST_WORDS: usize = 4000;
/// What the process says.
const STDERR_FILE: &str = "stderr.txt";
/// The folder that the process writes to, below its own.
pub const OUT: &str = "out";

/// Takes what a signal that ends the program has to do first, as long as what it gives lives.
pub type Guard = fn(Box<dyn FnOnce() + Send>) -> Box<dyn Any>;

/// A program.
pub struct Program {
    /// Where it is.
    pub path: PathBuf,
    /// Its first argument, where it is one of several commands.
    pub first: Option<&'static str>,
    /// Time after which a process is ended.
    pub limit: Duration,
}

/// A folder for one process.
pub struct Room {
    folder: TempDir,
    guard: Guard,
    _removed: Box<dyn Any>,
}

impl Room {
    /// An empty room. A signal that ends the program removes it, and ends its process.
    ///
    /// # Errors
    /// [`Error::System`].
    pub fn new(guard: Guard) -> Result<Self, Error> {
        let folder = tempfile::Builder::new().prefix("trackdyn-").tempdir();
        let folder = folder.map_err(Error::System)?;
        fs::create_dir(folder.path().join(OUT)).map_err(Error::System)?;
        let path = folder.path().to_owned();
        let removed = guard(Box::new(move || {
            // The program ends: there is nobody left to tell.
            let _ = fs::remove_dir_all(path);
        }));
        Ok(Self { folder, guard, _removed: removed })
    }

    /// Copies a file or a folder in, under a name.
    ///
    /// # Errors
    /// [`Error::File`]: what is to be copied, and why it cannot be.
    pub fn bring(&self, from: &Path, name: &str) -> Result<(), Error> {
        let to = self.folder.path().join(name);
        let brought = if from.is_dir() { copy(from, &to) } else { fs::copy(from, to).map(drop) };
        brought.map_err(Error::file(from))
    }

    /// Where the process writes to.
    pub fn out(&self) -> PathBuf {
        self.folder.path().join(OUT)
    }

    /// Runs a program here until it ends, and says why it failed; nothing where it did not.
    ///
    /// # Errors
    /// [`Error::Program`] for one that cannot be run, [`Error::System`].
    pub fn run(&self, program: &Program, arguments: &[&str]) -> Result<Option<String>, Error> {
        let status = self.wait(program, arguments)?;
        let how = match status {
            Some(status) if status.success() => return Ok(None),
            Some(status) => format!("ended with {status}"),
            None => format!("was ended after {} s", program.limit.as_secs()),
        };
        let words = fs::read(self.folder.path().join(STDERR_FILE)).unwrap_or_default();
        let words = String::from_utf8_lossy(&words);
        let start = words.char_indices().rev().nth(MAX_LAST_WORDS).map_or(0, |(place, _)| place);
        Ok(Some(format!("the process {how}\n{}", &words[start..])))
    }

    /// Puts what was written in the place of a folder, whole.
    ///
    /// # Errors
    /// [`Error::File`]: the folder, and why it cannot be put there.
    pub fn take(&self, place: &Path) -> Result<(), Error> {
        self.move_to(place).map_err(Error::file(place))
    }

    fn move_to(&self, place: &Path) -> io::Result<()> {
        let name = place.file_name().unwrap_or_default().to_string_lossy();
        let partial = place.with_file_name(format!(".{name}"));
        let remove = |old: &Path| if old.exists() { fs::remove_dir_all(old) } else { Ok(()) };
        remove(&partial)?;
        copy(&self.out(), &partial)?;
        remove(place)?;
        fs::rename(partial, place)
    }

    /// How the process ended; none where it took too long.
    fn wait(&self, program: &Program, arguments: &[&str]) -> Result<Option<ExitStatus>, Error> {
        let stderr = File::create(self.folder.path().join(STDERR_FILE)).map_err(Error::System)?;
        let mut command = Command::new(&program.path);
        command
            .args(program.first)
            .args(arguments)
            .current_dir(&self.folder)
            .env_clear()
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(stderr);
        lead_a_group(&mut command);
        for name in ["PATH", "RAYON_NUM_THREADS"] {
            if let Some(value) = std::env::var_os(name) {
                command.env(name, value);
            }
        }
        let started = Instant::now();
        let failed = |cause| Error::Program { path: program.path.clone(), cause };
        let process = Arc::new(Mutex::new(command.spawn().map_err(failed)?));
        let also = Arc::clone(&process);
        let _ended = (self.guard)(Box::new(move || {
            let mut process = also.lock().unwrap_or_else(PoisonError::into_inner);
            // It may have ended by itself.
            let _ = end(&mut process);
        }));
        loop {
            let mut process = process.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(status) = process.try_wait().map_err(Error::System)? {
                return Ok(Some(status));
            }
            if started.elapsed() > program.limit {
                end(&mut process).map_err(Error::System)?;
                return Ok(None);
            }
            drop(process);
            std::thread::sleep(POLL_INTERVAL);
        }
    }
}

/// The process and those that it starts are a group, which ends together.
#[cfg(unix)]
fn lead_a_group(command: &mut Command) {
    use std::os::unix::process::CommandExt;
    command.process_group(0);
}

#[cfg(not(unix))]
fn lead_a_group(_: &mut Command) {}

/// Ends a process and what it has started.
#[cfg(unix)]
fn end(process: &mut Child) -> io::Result<()> {
    use rustix::process::{Pid, Signal, kill_process_group};
    kill_process_group(Pid::from_child(process), Signal::KILL)?;
    process.wait().map(drop)
}

/// Ends a process.
#[cfg(not(unix))]
fn end(process: &mut Child) -> io::Result<()> {
    process.kill()?;
    process.wait().map(drop)
}

/// Copies the files of a folder and of those in it. Links and pipes, which lead out of it, stay
/// behind.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let (kind, target) = (entry.file_type()?, to.join(entry.file_name()));
        if kind.is_dir() {
            copy(&entry.path(), &target)?;
        } else if kind.is_file() {
            fs::copy(entry.path(), target)?;
        }
    }
    Ok(())
}
