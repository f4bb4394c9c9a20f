//! Progress of long work, on stderr.

use crate::stderr::say;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use trackdyn::{Error, Observer};

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);

/// Time between two lines in a log.
const LINE_INTERVAL: Duration = Duration::from_secs(30);

/// A bar that appears where work takes long; where stderr is not a terminal, a line now and then.
pub struct Progress {
    total: u64,
    done: AtomicU64,
    start: Instant,
    shown: Shown,
}

/// What is shown of it.
enum Shown {
    Bar(OnceLock<ProgressBar>),
    Lines(Mutex<Lines>),
}

impl Progress {
    /// A bar over `total` items.
    pub fn new(total: usize) -> Self {
        let shown = if stderr().is_terminal() {
            Shown::Bar(OnceLock::new())
        } else {
            Shown::Lines(Mutex::new(Lines { due: LINE_INTERVAL }))
        };
        Self { total: total as u64, done: AtomicU64::new(0), start: Instant::now(), shown }
    }

    /// A bar over the parts of a use case of the library, which does it meanwhile.
    pub fn over<T>(work: impl FnOnce(&Observer) -> Result<T, Error>) -> Result<T, Error> {
        let bar = Self::new(0);
        let result = work(&|progress: trackdyn::Progress| {
            bar.show(progress.stage, progress.done as u64, progress.total as u64);
            ControlFlow::Continue(())
        });
        bar.finish();
        result
    }

    /// Notes `count` more finished items.
    pub fn advance(&self, count: usize) {
        let done = self.done.fetch_add(count as u64, Ordering::Relaxed) + count as u64;
        self.show("", done, self.total);
    }

    /// Shows how far the work has come, and its stage, in a word.
    fn show(&self, stage: &'static str, done: u64, total: u64) {
        let elapsed = self.start.elapsed();
        match &self.shown {
            Shown::Bar(bar) if elapsed > PATIENCE => {
                let bar = bar.get_or_init(|| {
                    // Stages take from a tenth of a second to minutes: what they have taken says
                    // nothing of what is left.
                    let template = if stage.is_empty() {
                        "{bar:40} {pos} of {len}, {eta} left"
                    } else {
                        "{bar:40} {pos} of {len}, {elapsed}: {msg}"
                    };
                    let style = ProgressStyle::with_template(template)
                        .unwrap_or_else(|_| ProgressStyle::default_bar());
                    let bar = ProgressBar::new(total).with_style(style).with_elapsed(elapsed);
                    bar.enable_steady_tick(PATIENCE);
                    bar
                });
                bar.set_message(stage);
                bar.set_position(done);
            }
            Shown::Bar(_) => {}
            Shown::Lines(lines) => {
                let mut lines = lines.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some(line) = lines.line(stage, (done, total), elapsed) {
                    say(format_args!("{line}"));
                }
            }
        }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Shown::Bar(bar) = &self.shown
            && let Some(bar) = bar.get()
        {
            bar.finish_and_clear();
        }
    }
}

/// Lines of a log.
struct Lines {
    /// Time from the start before which there is no further one.
    due: Duration,
}

impl Lines {
    /// The line to be written now, if any; none of work that is done.
    fn line(
        &mut self,
        stage: &str,
        (done, total): (u64, u64),
        elapsed: Duration,
    ) -> Option<String> {
        if elapsed < self.due || done >= total {
            return None;
        }
        self.due = elapsed + LINE_INTERVAL;
        let now = if stage.is_empty() { String::new() } else { format!(", now {stage}") };
        Some(format!("{done} of {total} done after {} s{now}", elapsed.as_secs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_gets_a_line_now_and_then_while_work_goes_on() {
        let mut lines = Lines { due: LINE_INTERVAL };
        let mut at =
            |stage, done, seconds| lines.line(stage, (done, 9), Duration::from_secs(seconds));
        assert_eq!(at("", 1, 29), None);
        assert_eq!(at("", 2, 31).as_deref(), Some("2 of 9 done after 31 s"));
        assert_eq!(at("search", 3, 60), None);
        assert_eq!(at("search", 4, 61).as_deref(), Some("4 of 9 done after 61 s, now search"));
        assert_eq!(at("", 9, 100), None);
    }
}
