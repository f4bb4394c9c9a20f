//! How far a diagnosis has come, and whether it shall go on.

use std::cell::Cell;
use std::ops::ControlFlow;

/// A stage of a diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// The base, and the noise that is left beside it.
    Noise,
    /// Readings without the errors of a recorder.
    Readings,
    /// What each candidate would change.
    Signatures,
    /// The best hypothesis.
    Search,
    /// What of it is claimed.
    Verdicts,
    /// Where the evidence departs, before and after.
    Location,
    /// Errors on the runs that judge.
    HeldOut,
    /// A form for what no effect explains.
    Proposal,
    /// What this evidence could have shown.
    Limits,
}

impl Stage {
    /// All of them, in order.
    pub const ALL: [Self; 9] = [
        Self::Noise,
        Self::Readings,
        Self::Signatures,
        Self::Search,
        Self::Verdicts,
        Self::Location,
        Self::HeldOut,
        Self::Proposal,
        Self::Limits,
    ];

    /// Its name in a word or two.
    pub fn name(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::Readings => "readings",
            Self::Signatures => "signatures",
            Self::Search => "search",
            Self::Verdicts => "verdicts",
            Self::Location => "location",
            Self::HeldOut => "held-out runs",
            Self::Proposal => "proposal",
            Self::Limits => "limits",
        }
    }
}

/// How far a diagnosis has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done, or was just finished.
    pub stage: Stage,
    /// Stages that are finished. A repeat that turned out not to be needed counts as finished.
    pub done: usize,
    /// Stages of the longest way.
    pub total: usize,
}

/// A function that is told where a stage begins, where it ends and before each refit, and says
/// whether to go on. After [`ControlFlow::Break`] the diagnosis ends at once, as cancelled.
pub type Observer<'a> = dyn Fn(Progress) -> ControlFlow<()> + Sync + 'a;

/// The observer that looks at nothing and never stops.
pub fn unobserved(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The observer wants no more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// Counts finished stages and tells an observer.
pub struct Watch<'a> {
    observer: &'a Observer<'a>,
    at: Cell<Progress>,
}

impl<'a> Watch<'a> {
    /// A watch over so many stages.
    pub fn new(observer: &'a Observer<'a>, total: usize) -> Self {
        Self { observer, at: Cell::new(Progress { stage: Stage::Noise, done: 0, total }) }
    }

    /// Does the work of a stage.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn stage<T>(&self, stage: Stage, work: impl FnOnce() -> T) -> Result<T, Cancelled> {
        self.try_stage(stage, || Ok(work()))
    }

    /// Does the work of a stage that may fail, or be cancelled meanwhile.
    ///
    /// # Errors
    /// Those of the work, and [`Cancelled`].
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

    /// Counts stages that are not needed.
    pub fn skip(&self, stages: usize) {
        let at = self.at.get();
        self.at.set(Progress { done: at.done + stages, ..at });
    }

    /// Whether to go on, asked before each refit.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn go_on(&self) -> Result<(), Cancelled> {
        match (self.observer)(self.at.get()) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Cancelled),
        }
    }
}

impl Watch<'static> {
    /// The watch of what is done for itself, without an observer.
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
    }
}
