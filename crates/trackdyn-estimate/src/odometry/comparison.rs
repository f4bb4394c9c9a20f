//! Several parameter sets on the same runs.

mod component;
mod path;
mod span;

pub use component::Component;
pub use path::{Path, PathErrors};
pub use span::{SetErrors, SpanErrors};

use crate::odometry::{Error, ParameterSet, Span, Stretch, replay, stretch};
use crate::{Blocks, SegmentOptions};
use trackdyn_recording::Recording;

/// The replays of runs with several parameter sets, and their errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The parameter sets; the first is the one that others are compared with.
    pub sets: Vec<ParameterSet>,
    /// Clock offset, s.
    pub tau: f64,
    /// What was replayed, in the order of the runs.
    pub paths: Vec<Path>,
    /// Numbers of runs that were left out: their readings and poses have no time in common.
    pub left_out: Vec<i64>,
    /// What confidence intervals are made from.
    pub blocks: Blocks,
    /// Errors over each span that occurs, in the order of [`Span::ALL`].
    pub spans: Vec<SpanErrors>,
}

impl Comparison {
    /// Replays all runs with every parameter set at clock offset `tau`, s.
    ///
    /// # Errors
    /// [`Error::NotCovered`] when no run can be replayed, [`Error::Stopped`] when the forces of a
    /// set do not move the robot through all of them, [`Error::NoSegments`], [`Error::Standing`].
    pub fn new(recording: &Recording, sets: Vec<ParameterSet>, tau: f64) -> Result<Self, Error> {
        let mut paths = Vec::new();
        let mut left_out = Vec::new();
        let mut first_error = None;
        let begin = recording.begin();
        for (index, run) in recording.runs().iter().enumerate() {
            match sets.iter().map(|set| replay(run, set, tau, begin)).collect::<Result<Vec<_>, _>>()
            {
                Ok(trajectories) => paths.push(Path::new(index, run, &trajectories, tau)),
                Err(error @ Error::Stopped { .. }) => return Err(error),
                Err(error) => {
                    left_out.push(run.id());
                    first_error.get_or_insert(error);
                }
            }
        }
        if let (true, Some(error)) = (paths.is_empty(), first_error) {
            return Err(error);
        }
        let options = SegmentOptions { tau, ..SegmentOptions::default() };
        let segments = stretch::of_segments(recording, &options);
        check(&segments, &paths, &options)?;
        let blocks = Blocks::new(paths.iter().map(Path::extent), Blocks::MIN_WHOLE_RUNS);
        let spans = Span::ALL.into_iter().filter_map(|span| {
            let stretches = stretch::joined(&segments, span);
            SpanErrors::new(span, &stretches, &paths, sets.len(), &blocks)
        });
        let spans = spans.collect();
        Ok(Self { sets, tau, paths, left_out, blocks, spans })
    }

    /// Errors over segments.
    pub fn segments(&self) -> Option<&SpanErrors> {
        self.over(Span::Segment)
    }

    /// Errors over a span.
    pub fn over(&self, span: Span) -> Option<&SpanErrors> {
        self.spans.iter().find(|errors| errors.span == span)
    }

    /// The spans over which errors are shown growing, from segments on. They are distances, or
    /// durations where runs are too short for two distances with [`Comparison::MIN_STRETCHES`]
    /// stretches.
    pub fn growth(&self) -> Vec<&SpanErrors> {
        let of = |is: fn(&Span) -> bool| -> Vec<&SpanErrors> {
            let often = |errors: &&SpanErrors| errors.count >= Self::MIN_STRETCHES;
            self.spans.iter().filter(|errors| is(&errors.span)).filter(often).collect()
        };
        let distances = of(|span| matches!(span, Span::Segment | Span::Distance(_)));
        let durations = of(|span| matches!(span, Span::Segment | Span::Duration(_)));
        if distances.len() > 2 || durations.len() < 2 { distances } else { durations }
    }

    /// The span over which a drift is reported: the longest of [`Comparison::growth`], or segments
    /// where there is none.
    pub fn drift(&self) -> Option<&SpanErrors> {
        self.growth().last().copied().or_else(|| self.segments())
    }

    /// Least number of stretches from which a statistic is shown.
    pub const MIN_STRETCHES: usize = 20;

    /// Time that was replayed, s.
    pub fn duration(&self) -> f64 {
        self.paths.iter().map(Path::duration).sum()
    }

    /// Distance that was replayed, m.
    pub fn distance(&self) -> f64 {
        self.paths.iter().map(Path::length).sum()
    }
}

/// Checks that there is something to compare.
fn check(segments: &[Stretch], paths: &[Path], options: &SegmentOptions) -> Result<(), Error> {
    let runs = paths.len();
    if segments.is_empty() {
        let SegmentOptions { minimum_duration: duration, minimum_readings: readings, .. } =
            *options;
        return Err(Error::NoSegments { runs, duration, readings });
    }
    if paths.iter().all(|path| path.rests) {
        return Err(Error::Standing { runs, duration: paths.iter().map(Path::duration).sum() });
    }
    Ok(())
}
