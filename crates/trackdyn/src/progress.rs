//! How far a use case has come, and whether it shall go on.

use crate::Error;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// How far a use case has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Progress {
    /// What is being done, in a word: a stage of the method.
    pub stage: &'static str,
    /// Finished parts.
    pub done: usize,
    /// All parts.
    pub total: usize,
}

/// A function that is told of each finished part, from any thread, and says whether to go on.
/// Where a part takes long it may be told of the last one again.
///
/// After [`ControlFlow::Break`] the use case ends with [`Error::Cancelled`] when the parts that are
/// being worked on are finished.
pub type Observer<'a> = dyn Fn(Progress) -> ControlFlow<()> + Sync + 'a;

/// The observer that looks at nothing and never stops.
pub fn unobserved(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Counts finished parts and tells an observer.
pub(crate) struct Counter<'a> {
    observer: &'a Observer<'a>,
    total: usize,
    done: AtomicUsize,
    is_stopped: AtomicBool,
}

impl<'a> Counter<'a> {
    /// A counter of so many parts.
    pub(crate) fn new(observer: &'a Observer<'a>, total: usize) -> Self {
        Self { observer, total, done: AtomicUsize::new(0), is_stopped: AtomicBool::new(false) }
    }

    /// Notes `count` more finished parts of a stage. Break: the observer wants no more.
    pub(crate) fn advance(&self, stage: &'static str, count: usize) -> ControlFlow<()> {
        let done = self.done.fetch_add(count, Ordering::Relaxed) + count;
        self.tell(stage, done)
    }

    /// Notes that so many parts of a stage are finished.
    pub(crate) fn reach(&self, stage: &'static str, done: usize) -> ControlFlow<()> {
        let before = self.done.fetch_max(done, Ordering::Relaxed);
        if done > before { self.tell(stage, done) } else { self.state() }
    }

    /// Whether the observer wants no more.
    pub(crate) fn state(&self) -> ControlFlow<()> {
        if self.is_stopped.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// An error where the observer wants no more.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        if self.state().is_break() { Err(Error::Cancelled) } else { Ok(()) }
    }

    fn tell(&self, stage: &'static str, done: usize) -> ControlFlow<()> {
        let progress = Progress { stage, done, total: self.total };
        if (self.observer)(progress).is_break() {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
        self.state()
    }
}
