//! Time and memory of a diagnosis: of a recording as long as the paper's, of four and of sixteen
//! times as long, with nothing concealed and with load transfer.
//!
//! `diagnose_speed [--longest N]` prints a table; N is 1, 4 or 16 (default 16).

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::Instant;
use trackdyn::diagnose::every_fourth;
use trackdyn_diagnose::{Evidence, Options, Progress, Settings, Stage, diagnose};
use trackdyn_drive::sensors::Preset;
use trackdyn_drive::{ScheduleKind, ScheduleOptions};
use trackdyn_recording::Recording;
use trackdyn_tests::concealed::{Drive, named, owned, sensors};

/// Runs of the paper, and the time of each that gives its 1807 segments, three poses of 0.1 s each,
/// s.
const RUNS: usize = 9;
const RUN_TIME: f64 = 60.3;

/// What is concealed.
const CONCEALED_EFFECTS: [&[&str]; 2] = [&[], &["load-transfer:cog_height_m=0.15"]];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let longest: usize = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => 16,
        ["--longest", times] => times.parse()?,
        _ => return Err("usage: diagnose_speed [--longest N]".into()),
    };
    println!(
        "| concealed | segments | seconds | CPU seconds | searches | {} | before [MiB] | peak \
         [MiB] | named |",
        Stage::ALL.map(Stage::name).join(" | ")
    );
    println!("|{}", "---|".repeat(8 + Stage::ALL.len()));
    for times in [1, 4, 16].into_iter().filter(|times| *times <= longest) {
        for concealed in CONCEALED_EFFECTS {
            report(&recording(times, concealed)?, concealed)?;
        }
    }
    Ok(())
}

/// A drive by hand, so many times as long as the paper's.
fn recording(times: usize, concealed: &[&str]) -> Result<Recording, Box<dyn Error>> {
    let options = ScheduleOptions {
        runs: Some(times * RUNS),
        duration: Some(RUN_TIME),
        ..ScheduleOptions::default()
    };
    let runs = ScheduleKind::Manual.generate(&options)?;
    let drive = Drive::new(&owned(concealed).vehicle, concealed, &runs, 1)?;
    Ok(drive.recording(&sensors(Preset::Laboratory), 1))
}

/// Time that a diagnosis spent so far.
struct Times {
    /// When it last told where it is.
    last: Instant,
    /// Stages that were finished then.
    done: usize,
    /// Time of each stage, s.
    seconds: [f64; Stage::ALL.len()],
    /// Searches that were finished.
    searches: usize,
}

impl Times {
    fn reach(&mut self, at: Progress) {
        let stage = Stage::ALL.iter().position(|stage| *stage == at.stage).unwrap_or(0);
        self.seconds[stage] += self.last.elapsed().as_secs_f64();
        self.searches += usize::from(at.stage == Stage::Search && at.done > self.done);
        (self.last, self.done) = (Instant::now(), at.done);
    }
}

/// Diagnoses and prints a row.
fn report(recording: &Recording, concealed: &[&str]) -> Result<(), Box<dyn Error>> {
    let file = owned(concealed);
    forget_peak();
    let before = status("VmRSS:");
    let (begun, spent) = (Instant::now(), cpu_seconds());
    let evidence = Evidence::of_recording(recording, file.vehicle.gauge, &Settings::default())?;
    let held_out = every_fourth(recording.runs().len());
    let options = Options { held_out, ..Options::default() };
    let times = Mutex::new(Times {
        last: Instant::now(),
        done: 0,
        seconds: [0.0; Stage::ALL.len()],
        searches: 0,
    });
    let diagnosis = diagnose(&evidence, &file, &options, &|at| {
        times.lock().expect("one thread at a time").reach(at);
        ControlFlow::Continue(())
    })?;
    let whole = begun.elapsed().as_secs_f64();
    let spent = cpu_seconds() - spent;
    let Times { seconds, searches, .. } = times.into_inner().expect("no thread failed");
    let seconds: Vec<String> = seconds.iter().map(|s| format!("{s:.2}")).collect();
    let named: Vec<String> = named(&diagnosis)
        .into_iter()
        .map(|(_, members)| members.into_iter().collect::<Vec<_>>().join(" or "))
        .collect();
    println!(
        "| {} | {} | {whole:.1} | {spent:.1} | {searches} | {} | {before} | {} | {} |",
        concealed.first().unwrap_or(&"nothing"),
        evidence.samples().len(),
        seconds.join(" | "),
        status("VmHWM:"),
        named.join(", ")
    );
    Ok(())
}

/// Lets the system count the peak of memory anew, where it can.
fn forget_peak() {
    // Where it cannot, the peak is that of the whole process: the table says more than there is.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Time that the processors have spent on this process, s; 0 where the system does not say.
fn cpu_seconds() -> f64 {
    /// Ticks of a second in the account of Linux.
    const TICKS: f64 = 100.0;
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the name in brackets: user and system time are the 12th and 13th.
    let rest = text.rsplit(')').next().unwrap_or_default();
    let ticks = rest.split_whitespace().skip(11).take(2);
    ticks.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / TICKS
}

/// A line of the system's account of this process, MiB; `-` where there is none.
fn status(key: &str) -> String {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with(key));
    let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kib.map_or("-".to_owned(), |kib| format!("{:.0}", kib / 1024.0))
}
