//! The program as a user meets it.

mod bad_input;
#[cfg(target_os = "linux")]
mod bounds;
mod check;
mod compare;
mod diagnose;
mod documents;
mod export;
mod identify;
mod init;
mod inspect;
mod interrupted;
mod map;
mod odometry;
mod origins;
mod plan;
mod proposal;
mod recordings;
mod sealed_trial;
mod simulate;
mod simulators;
mod stdout;
mod tables;
mod trial;
mod vehicles;
mod words;

use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use trackdyn_estimate::synthetic::{Stretch, Synthetic};

/// What a run left behind.
struct Run {
    status: i32,
    stdout: String,
    /// Notes and errors, each in one line.
    stderr: String,
    /// Notes and errors in the lines of a terminal.
    printed: String,
}

/// An empty folder in which the program runs.
struct Workplace(TempDir);

impl Workplace {
    fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path().join(name), text).expect("written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path().join(name)).expect(name)
    }

    /// Runs `trackdyn` with these arguments, separated by white space.
    fn run(&self, arguments: &str) -> Run {
        self.run_with_threads(arguments, 2)
    }

    /// `trackdyn` with these arguments, to be started here.
    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trackdyn"));
        command.args(arguments.split_whitespace()).current_dir(self.path());
        command
    }

    fn run_with_threads(&self, arguments: &str, threads: u32) -> Run {
        let output = self
            .command(arguments)
            .env("RAYON_NUM_THREADS", threads.to_string())
            .output()
            .expect("the program starts");
        let printed = String::from_utf8(output.stderr).expect("text");
        Run {
            status: output.status.code().expect("no signal"),
            stdout: String::from_utf8(output.stdout).expect("text"),
            stderr: unbroken(&printed),
            printed,
        }
    }

    /// Names of all files below the folder.
    fn files(&self) -> Vec<PathBuf> {
        let mut found = Vec::new();
        let mut folders = vec![self.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).expect("a folder") {
                let path = entry.expect("an entry").path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    found.push(path.strip_prefix(self.path()).expect("below").to_owned());
                }
            }
        }
        found.sort();
        found
    }
}

/// Notes, warnings and errors in one line each: their further lines stand below their beginning.
fn unbroken(text: &str) -> String {
    let mut whole = String::new();
    let mut label = 0;
    for line in text.lines() {
        let indent = line.len() - line.trim_start().len();
        if label > 0 && indent == label {
            whole.push(' ');
            whole += line.trim_start();
            continue;
        }
        let labels = ["note: ", "warning: ", "error: "];
        label = labels.iter().find(|of| line.starts_with(**of)).map_or(0, |of| of.len());
        whole += if whole.is_empty() { "" } else { "\n" };
        whole += line;
    }
    if text.ends_with('\n') { whole + "\n" } else { whole }
}

/// A file of the project.
fn project_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

/// The vehicle file of Auriga-alpha.
fn vehicle() -> String {
    project_file("configs/vehicles/auriga-alpha.toml").display().to_string()
}

/// A drive of Auriga-alpha's size, with the noise of a laboratory and poses that come late.
fn auriga_alpha(schedules: Vec<Vec<Stretch>>) -> Synthetic {
    Synthetic {
        schedules,
        encoder_noise: 0.01,
        position_noise: 0.002,
        yaw_noise: 0.002,
        tau: 0.1,
        ..Synthetic::default()
    }
}

/// The text of a file of the project.
fn project_text(name: &str) -> String {
    std::fs::read_to_string(project_file(name)).expect(name)
}
