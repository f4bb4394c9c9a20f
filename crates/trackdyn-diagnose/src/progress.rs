//! Progress of a diagnosis, and its cancellation.

use std::cell::Cell;
use std::ops::ControlFlow;

/// A stage of a diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Fit of the base, and noise estimation.
    Noise,
    /// Cleaning of the readings.
    Readings,
    /// Motion with which runs begin.
    Beginnings,
    /// Signatures of all candidates.
    Signatures,
    /// Search for the best hypothesis.
    Search,
    /// Verdicts on its effects.
    Verdicts,
    /// Departures before and after the correction.
    Location,
    /// Errors on held-out runs.
    HeldOut,
    /// Empirical law for what no effect explains.
    Proposal,
    /// Detection limits.
    Limits,
    /// The corrected vehicle, and its dead reckoning.
    Correction,
    /// Differences between two sets of recordings.
    Differences,
}

impl Stage {
    /// All stages of a diagnosis, in order.
    pub const ALL: [Self; 11] = [
        Self::Noise,
        Self::Readings,
        Self::Beginnings,
        Self::Signatures,
        Self::Search,
        Self::Verdicts,
        Self::Location,
        Self::HeldOut,
        Self::Proposal,
        Self::Limits,
        Self::Correction,
    ];

    /// Name in a word or two.
    pub fn name(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::Readings => "readings",
            Self::Beginnings => "beginnings",
            Self::Signatures => "signatures",
            Self::Search => "search",
            Self::Verdicts => "verdicts",
            Self::Location => "location",
            Self::HeldOut => "held-out runs",
            Self::Proposal => "proposal",
            Self::Limits => "limits",
            Self::Correction => "correction",
            Self::Differences => "differences",
        }
    }
}

/// Progress of a diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Stage that is running, or has just finished.
    pub stage: Stage,
    /// Number of finished stages. A repeat that is not needed counts as finished.
    pub done: usize,
    /// Stages of the longest course.
    pub total: usize,
}

/// Callback at the start and end of each stage, before each signature and each refit, which says
/// whether to continue. [`ControlFlow::Break`] ends the diagnosis at once, as cancelled.
pub type Observer<'a> = dyn Fn(Progress) -> ControlFlow<()> + Sync + 'a;

/// An observer that never cancels.
pub fn unobserved(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The observer cancelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// Counts finished stages and calls an observer.
pub struct Watch<'a> {
    observer: &'a Observer<'a>,
    at: Cell<Progress>,
}

impl<'a> Watch<'a> {
    /// A watch over this number of stages.
    pub fn new(observer: &'a Observer<'a>, total: usize) -> Self {
        Self { observer, at: Cell::new(Progress { stage: Stage::Noise, done: 0, total }) }
    }

    /// Runs a stage.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn stage<T>(&self, stage: Stage, work: impl FnOnce() -> T) -> Result<T, Cancelled> {
        self.try_stage(stage, || Ok(work()))
    }

    /// Runs a stage that may fail or be cancelled.
    ///
    /// # Errors
    /// Errors of the work, and [`Cancelled`].
    pub fn try_stage<T, E: From<Cancelled>>(
        &self,
        stage: Stage,
        work: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        self.at.set(Progress { stage, ..self.at.get() });
        self.go_on()?;
        let result = work()?;
        self.skip(1);
        self.go_on()?;
        Ok(result)
    }

    /// Counts stages that are not needed as finished.
    pub fn skip(&self, stages: usize) {
        let at = self.at.get();
        self.at.set(Progress { done: at.done + stages, ..at });
    }

    /// Asks the observer whether to continue; called before each refit.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn go_on(&self) -> Result<(), Cancelled> {
        self.of_tasks()()
    }

    /// [`Self::go_on`] for the tasks of a parallel stage.
    pub fn of_tasks(&self) -> impl Fn() -> Result<(), Cancelled> + Sync + use<'a> {
        let (observer, at) = (self.observer, self.at.get());
        move || match observer(at) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Cancelled),
        }
    }
}

impl Watch<'static> {
    /// A watch without an observer.
    pub fn none() -> Self {
        Self::new(&unobserved, 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn stages_count_to_the_total_and_end_where_the_observer_stops() {
        let seen = Mutex::new(Vec::new());
        let stop_at = |last: usize| {
            let seen = &seen;
            move |at: Progress| {
                seen.lock().expect("one thread").push((at.stage, at.done));
                if at.done < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            }
        };
        let observer = stop_at(2);
        let watch = Watch::new(&observer, 3);
        let first = watch.stage(Stage::Noise, || 7);
        assert_eq!(first, Ok(7));
        let second = watch.try_stage(Stage::Search, || watch.go_on());
        assert_eq!(second, Err(Cancelled), "told when the second stage has ended");
        let expected = [
            (Stage::Noise, 0),
            (Stage::Noise, 1),
            (Stage::Search, 1),
            (Stage::Search, 1),
            (Stage::Search, 2),
        ];
        assert_eq!(*seen.lock().expect("one thread"), expected);
        assert_eq!(watch.of_tasks()(), Err(Cancelled), "tasks are told as well");
    }
}
