//! The log on one axis of time: its runs one after the other.

use super::{Subject, View};
use trackdyn_diagnose::evidence::{Origin, Sample};

/// A run on the axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    /// Its index in the evidence.
    pub index: usize,
    /// Its number in the recording.
    pub name: i64,
    /// Whether nothing was fitted on it.
    pub is_held_out: bool,
    /// Where it begins on the axis, s.
    pub at: f64,
    /// When it begins, s since the recording began.
    pub start: f64,
    /// How long it lasts, s.
    pub duration: f64,
}

/// A sample with what was left of it.
pub(super) struct Entry<'a> {
    /// Index of its view.
    pub view: usize,
    /// Its index in the view.
    pub index: usize,
    /// The sample.
    pub sample: &'a Sample,
    /// Its beginning and its end on the axis, s.
    pub span: [f64; 2],
}

/// Runs one after the other, with all samples in the order of time.
pub(super) struct Log<'a> {
    /// Of the fit, and of the held-out runs.
    pub views: Vec<View<'a>>,
    /// The runs that have samples.
    pub runs: Vec<Run>,
    /// All samples.
    pub entries: Vec<Entry<'a>>,
}

impl<'a> Log<'a> {
    /// The log of a drive; none of a table of steady points, which has no time.
    pub fn of(subject: &Subject<'a>) -> Option<Self> {
        if matches!(subject.evidence().origin(), Origin::SteadyPoints(_)) {
            return None;
        }
        let views = subject.views();
        let names = subject.evidence().runs();
        let mut all: Vec<(usize, usize, &'a Sample)> = Vec::new();
        for (view, of) in views.iter().enumerate() {
            let samples = of.evidence.samples().iter().enumerate();
            all.extend(samples.map(|(index, sample)| (view, index, sample)));
        }
        all.sort_by(|(_, _, a), (_, _, b)| a.run.cmp(&b.run).then(a.start.total_cmp(&b.start)));
        let (mut runs, mut at) = (Vec::new(), 0.0);
        let mut entries = Vec::with_capacity(all.len());
        for run in all.chunk_by(|(_, _, a), (_, _, b)| a.run == b.run) {
            let (view, _, first) = run[0];
            let end = run.iter().map(|(_, _, sample)| sample.start + sample.duration);
            let duration = end.fold(first.start, f64::max) - first.start;
            runs.push(Run {
                index: first.run,
                name: names[first.run],
                is_held_out: views[view].is_held_out,
                at,
                start: first.start,
                duration,
            });
            entries.extend(run.iter().map(|&(view, index, sample)| {
                let begin = at + sample.start - first.start;
                Entry { view, index, sample, span: [begin, begin + sample.duration] }
            }));
            at += duration;
        }
        Some(Self { views, runs, entries })
    }

    /// Length of the axis, s.
    pub fn duration(&self) -> f64 {
        self.runs.last().map_or(0.0, |run| run.at + run.duration)
    }

    /// Whether an entry is the one after another, and begins at the pose where that one ends.
    pub fn follows(before: &Entry, entry: &Entry) -> bool {
        let is_next = before.view == entry.view && before.index + 1 == entry.index;
        is_next && entry.sample.follows
    }
}
