//! Parts of a recording: what is fitted on one part is judged on another.

use crate::recording::{Recording, UncheckedRun};
use crate::sample::{Sample, Series};
use crate::{Error, Run};
use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// Numbers of runs, written as a list with ranges: `7,8,20-29`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RunList(Vec<i64>);

impl RunList {
    /// These runs.
    pub fn new(numbers: impl IntoIterator<Item = i64>) -> Self {
        Self(numbers.into_iter().collect())
    }

    /// The numbers, as given.
    pub fn numbers(&self) -> &[i64] {
        &self.0
    }

    /// Whether both have a run.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.0.iter().any(|number| other.0.contains(number))
    }
}

impl FromStr for RunList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const MAX_RUNS: i64 = 1_000_000;
        let expected = || "expected numbers of runs, such as 7,8,20-29".to_owned();
        let number = |text: &str| text.trim().parse::<i64>().map_err(|_| expected());
        let mut numbers = Vec::new();
        for part in text.split(',') {
            match part.trim().split_once('-').filter(|(first, _)| !first.is_empty()) {
                Some((first, last)) => {
                    let (first, last) = (number(first)?, number(last)?);
                    if !(first..first.saturating_add(MAX_RUNS)).contains(&last) {
                        return Err(expected());
                    }
                    numbers.extend(first..=last);
                }
                None => numbers.push(number(part)?),
            }
        }
        Ok(Self(numbers))
    }
}

impl fmt::Display for RunList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranges = self.0.chunk_by(|a, b| *a >= 0 && *b == a + 1);
        for (index, range) in ranges.enumerate() {
            let comma = if index > 0 { "," } else { "" };
            match range {
                [first, .., last] => write!(f, "{comma}{first}-{last}")?,
                [only] => write!(f, "{comma}{only}")?,
                [] => {}
            }
        }
        Ok(())
    }
}

impl Recording {
    /// Indices of runs by their numbers, in the order of the recording.
    ///
    /// # Errors
    /// [`Error::UnknownRun`].
    pub fn indices_of(&self, list: &RunList) -> Result<Vec<usize>, Error> {
        let is_there = |number: &i64| self.runs().iter().any(|run| run.id() == *number);
        if let Some(&run) = list.0.iter().find(|number| !is_there(number)) {
            return Err(Error::UnknownRun { run, expected: expected(self.runs()) });
        }
        let runs = self.runs().iter().enumerate();
        Ok(runs.filter(|(_, run)| list.0.contains(&run.id())).map(|(index, _)| index).collect())
    }

    /// The numbers of all runs.
    pub fn run_list(&self) -> RunList {
        RunList::new(self.runs().iter().map(Run::id))
    }

    /// The recording of some of its runs only. Its fingerprint is that of the whole: it tells where
    /// the runs come from.
    ///
    /// # Errors
    /// [`Error::UnknownRun`].
    pub fn of_runs(&self, list: &RunList) -> Result<Self, Error> {
        let indices = self.indices_of(list)?;
        Ok(self.with_runs(indices.into_iter().map(|index| self.runs()[index].clone()).collect()))
    }

    /// The recording with its runs in the order in which they were driven: by time, where one ends
    /// before the next begins. Runs with clocks of their own stay in their order.
    pub fn as_driven(&self) -> Cow<'_, Self> {
        let ends =
            |run: &Run| [run.tracks().first(), run.tracks().last()].map(|at| at.map(|at| at.t));
        if self.runs().is_sorted_by(|a, b| ends(a) <= ends(b)) {
            return Cow::Borrowed(self);
        }
        let mut runs = self.runs().to_vec();
        runs.sort_by(|a, b| ends(a).partial_cmp(&ends(b)).unwrap_or(Ordering::Equal));
        let follows = |pair: &[Run]| ends(&pair[0])[1] <= ends(&pair[1])[0];
        let have_one_clock = runs.windows(2).all(follows);
        if have_one_clock { Cow::Owned(self.with_runs(runs)) } else { Cow::Borrowed(self) }
    }

    /// The recording of a time only, s from the first reading of each run; runs without readings or
    /// with fewer than two poses in it are left out. Its fingerprint is that of the whole.
    ///
    /// # Errors
    /// [`Error::NothingWithin`] where none is left.
    pub fn within(&self, [from, until]: [f64; 2]) -> Result<Self, Error> {
        let cut = |run: &Run| {
            let start = run.tracks().first().map_or(0.0, |reading| reading.t);
            let time = [start + from, start + until];
            Run::new(
                UncheckedRun {
                    id: run.id(),
                    tracks: rows_within(run.track_series(), time),
                    poses: rows_within(run.pose_series(), time),
                    imu: rows_within(run.imu_series(), time),
                },
                &mut Vec::new(),
            )
            .with_positions_of(run)
        };
        let runs: Vec<Run> = self.runs().iter().map(cut).filter(Run::is_usable).collect();
        if runs.is_empty() {
            let longest = self.runs().iter().map(Run::duration).fold(0.0, f64::max);
            return Err(Error::NothingWithin { from, until, longest });
        }
        Ok(self.with_runs(runs))
    }
}

/// The rows of a time, s.
fn rows_within<S: Sample>(series: &Series<S>, [from, until]: [f64; 2]) -> Series<S> {
    let is_within = |row: &usize| (from..=until).contains(&series.samples[*row].time());
    let rows: Vec<usize> = (0..series.samples.len()).filter(is_within).collect();
    series.part(&rows)
}

/// The numbers of runs, shortened.
fn expected(runs: &[Run]) -> String {
    match runs {
        [first, .., last] if runs.len() > 12 => {
            format!("one of its {} runs, {} to {}", runs.len(), first.id(), last.id())
        }
        runs => {
            let numbers: Vec<String> = runs.iter().map(|run| run.id().to_string()).collect();
            format!("one of {}", numbers.join(", "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Source;
    use crate::sample::{PoseSample, TrackSample};
    use trackdyn_core::{Pose, real};

    fn list(text: &str) -> RunList {
        text.parse().expect("a list")
    }

    fn recording() -> Recording {
        let run = |id: i64| {
            let v = 0.1 * f64::from(u8::try_from(id).expect("a dozen"));
            let reading = |k: u8| TrackSample { t: 0.05 * f64::from(k), v_left: v, v_right: v };
            let pose = |k: u8| {
                let t = 0.1 * f64::from(k);
                PoseSample { t, pose: Pose::new(v * t, 0.0, 0.0) }
            };
            UncheckedRun {
                id,
                tracks: (0..=80).map(reading).collect::<Vec<_>>().into(),
                poses: (0..=40).map(pose).collect::<Vec<_>>().into(),
                imu: Series::default(),
            }
        };
        let runs = (0..12).map(run).collect();
        Recording::new("steady", "robot", runs, Source::computed(), Vec::new()).expect("runs")
    }

    #[test]
    fn lists_are_read_and_written() {
        assert_eq!(list("7, 9,20-22").numbers(), [7, 9, 20, 21, 22]);
        for text in ["7,9,20-22", "-3", "-3,-2,0-1"] {
            assert_eq!(list(text).to_string(), text);
        }
        for bad in ["", "x", "1,,2", "9-7", "1-", "0-9999999999"] {
            assert!(bad.parse::<RunList>().is_err(), "{bad}");
        }
        assert!(list("1-4").overlaps(&list("4,9")) && !list("1-4").overlaps(&list("5-9")));
    }

    #[test]
    fn runs_are_chosen_by_number() {
        let recording = recording();
        let part = recording.of_runs(&list("3,1")).expect("there");
        assert_eq!(part.runs(), [recording.runs()[1].clone(), recording.runs()[3].clone()]);
        assert_eq!(part.fingerprint(), recording.fingerprint());
        assert_eq!(recording.run_list().to_string(), "0-11");
        let error = recording.of_runs(&list("3,99")).expect_err("no run 99");
        assert_eq!(
            error.to_string(),
            "run 99 is not in the recording: expected one of 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11"
        );
    }

    #[test]
    fn runs_are_put_in_the_order_of_their_time_where_they_have_one_clock() {
        let ids = |recording: &Recording| recording.runs().iter().map(Run::id).collect::<Vec<_>>();
        // All runs begin at time 0: each has its own clock.
        let recording = recording();
        assert_eq!(ids(&recording.as_driven()), ids(&recording));

        let later = |(k, run): (usize, &Run)| {
            let shift = 100.0 * real(k);
            let mut tracks = run.track_series().clone();
            tracks.samples.iter_mut().for_each(|reading| reading.t += shift);
            let mut poses = run.pose_series().clone();
            poses.samples.iter_mut().for_each(|pose| pose.t += shift);
            let imu = run.imu_series().clone();
            Run::new(UncheckedRun { id: run.id(), tracks, poses, imu }, &mut Vec::new())
        };
        let mut runs: Vec<Run> = recording.runs().iter().enumerate().map(later).collect();
        runs.reverse();
        let backwards = recording.with_runs(runs);
        assert_eq!(ids(&backwards.as_driven()), ids(&recording));
    }

    #[test]
    fn a_time_is_cut_out_of_every_run() {
        let recording = recording();
        let part = recording.within([1.0, 3.0]).expect("4 s long");
        assert_eq!(part.runs().len(), 12);
        // Readings every 0.05 s and poses every 0.1 s, both ends counted.
        let run = &part.runs()[5];
        assert_eq!((run.tracks().len(), run.poses().len()), (41, 21));
        assert_eq!(run.tracks()[0], recording.runs()[5].tracks()[20]);
        let error = recording.within([9.0, 10.0]).expect_err("too late").to_string();
        assert!(error.contains("9 to 10 s") && error.contains("4.0 s"), "{error}");
    }
}
