//! Hostile and absurd input, of every command: an error in a sentence, soon, and with little
//! memory. Nothing of a file reaches the terminal that the terminal would obey.

mod bombs;
mod files;
mod numbers;

use crate::Workplace;
use rayon::prelude::*;
use std::io::Read;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Memory that a process may ask for, KiB. The program alone takes 60 MB of it.
const MEMORY: u32 = 256 << 10;

/// Time of a processor that a process may take, s: what is refused takes less than a tenth.
const SECONDS: u32 = 2;

/// What a run should come to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// An error of the user's: exit status 1.
    Refused,
    /// Any exit status: the value may be sound.
    Ended,
}

/// A command line, and what should come of it.
struct Case {
    arguments: String,
    outcome: Outcome,
    /// What an error has to name.
    names: Vec<String>,
}

impl Case {
    fn refused(arguments: impl Into<String>, names: &[&str]) -> Self {
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        Self { arguments: arguments.into(), outcome: Outcome::Refused, names }
    }

    fn ended(arguments: impl Into<String>) -> Self {
        Self { arguments: arguments.into(), outcome: Outcome::Ended, names: Vec::new() }
    }

    /// What is wrong with how the program takes it; none where it is as it should be.
    fn problem(&self, place: &Workplace) -> Option<String> {
        let (status, printed) = match run(place, &self.arguments) {
            Ok(ended) => ended,
            Err(problem) => return Some(problem),
        };
        if !(0..=2).contains(&status) || printed.contains("panicked") {
            return Some(format!("status {status}: {}", shown(&printed)));
        }
        if self.outcome == Outcome::Refused && (status != 1 || !printed.contains("error: ")) {
            return Some(format!("status {status} is no refusal: {}", shown(&printed)));
        }
        if printed.chars().any(is_obeyed) {
            return Some(format!("raw characters: {}", shown(&printed)));
        }
        if printed.len() > 8000 && self.outcome == Outcome::Refused {
            return Some(format!("{} bytes: {}", printed.len(), shown(&printed)));
        }
        if printed.split(|c: char| !c.is_ascii_digit()).any(|digits| digits.len() > 30) {
            return Some(format!("a number of many digits: {}", shown(&printed)));
        }
        let printed = crate::unbroken(&printed);
        let lacks = self.names.iter().find(|name| !printed.contains(*name))?;
        Some(format!("{lacks:?} is not in: {}", shown(&printed)))
    }
}

/// The beginning of a text.
fn shown(text: &str) -> String {
    text.chars().take(300).collect::<String>().escape_debug().to_string()
}

/// Whether a terminal obeys a character instead of showing it.
fn is_obeyed(c: char) -> bool {
    (c.is_control() && c != '\n' && c != '\t') || ('\u{202a}'..='\u{202e}').contains(&c)
}

/// Runs the program within its bounds; gives its status and all that it printed. Words of the
/// arguments stand between blanks; `\e` stands for ESC.
fn run(place: &Workplace, arguments: &str) -> Result<(i32, String), String> {
    let limits = format!("ulimit -v {MEMORY}; ulimit -t {SECONDS}; exec \"$@\"");
    let words = arguments.split(' ').map(|word| word.replace("\\e", "\u{1b}"));
    let mut child = Command::new("sh")
        .args(["-c", &limits, "sh", env!("CARGO_BIN_EXE_trackdyn")])
        .args(words)
        .current_dir(place.path())
        .env("RAYON_NUM_THREADS", "2")
        // An arena for each thread would ask for 64 MB more each.
        .env("MALLOC_ARENA_MAX", "1")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("a shell");
    let [out, err] = [
        child.stdout.take().map(|pipe| Box::new(pipe) as Box<dyn Read + Send>),
        child.stderr.take().map(|pipe| Box::new(pipe) as Box<dyn Read + Send>),
    ]
    .map(|pipe| {
        std::thread::spawn(move || {
            let mut text = Vec::new();
            pipe.expect("a pipe").read_to_end(&mut text).expect("readable");
            text
        })
    });
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        if start.elapsed() > Duration::from_secs(120) {
            child.kill().expect("ended");
            child.wait().expect("an end");
            return Err("it does not end".to_owned());
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let [out, err] = [out, err].map(|text| text.join().expect("read"));
    let printed = String::from_utf8_lossy(&[err, out].concat()).into_owned();
    match status.code() {
        Some(code) => Ok((code, printed)),
        None => Err(format!("{status}: {}", shown(&printed))),
    }
}

/// Runs all cases in one place and tells all that are not as they should be.
fn check(place: &Workplace, cases: &[Case]) {
    let problem = |(index, case): (usize, &Case)| {
        // Where results would go, each has a folder of its own.
        let takes_out = ["map", "simulate", "drive", "odometry", "inspect", "identify", "diagnose"]
            .iter()
            .any(|command| case.arguments.starts_with(command));
        let out = if takes_out { format!(" --out out{index}") } else { String::new() };
        let case = Case {
            arguments: format!("{}{out}", case.arguments),
            outcome: case.outcome,
            names: case.names.clone(),
        };
        case.problem(place).map(|problem| format!("{}\n    {problem}", case.arguments))
    };
    let problems: Vec<String> = cases.par_iter().enumerate().filter_map(problem).collect();
    assert!(problems.is_empty(), "{} of {}:\n{}", problems.len(), cases.len(), problems.join("\n"));
}

/// A place with a recording, a kinematics file and a folder.
fn prepared() -> Workplace {
    let place = Workplace::new();
    for command in [
        "map --grid 5 --out m",
        "simulate --schedule manual --run-count 2 --duration 4 --quasi-static --out rec",
    ] {
        let run = place.run(command);
        assert_eq!(run.status, 0, "{}", run.stderr);
    }
    std::fs::create_dir(place.path().join("folder")).expect("a folder");
    place
}
