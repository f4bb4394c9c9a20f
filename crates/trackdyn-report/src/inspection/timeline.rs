//! The time of several runs, one after another.

use crate::figure::Axis;
use crate::ticks::Ticks;
use trackdyn_core::real;
use trackdyn_estimate::RunRates;

/// Least distance of two texts below the axis, pixels.
const MIN_TEXT_DISTANCE: f64 = 150.0;

/// Runs above which the lines between them would hide what is shown.
const MAX_LINES: usize = 40;

/// Where runs begin when they stand one after another.
pub(super) struct Timeline {
    starts: Vec<f64>,
    numbers: Vec<i64>,
    durations: Vec<f64>,
    /// Time of all runs, s.
    length: f64,
    width: i32,
}

impl Timeline {
    /// The runs on an axis of so many pixels.
    pub(super) fn new(runs: &[RunRates], width: i32) -> Self {
        let mut length = 0.0;
        let starts = runs.iter().map(|run| {
            let start = length;
            length += run.duration;
            start
        });
        let starts = starts.collect();
        let length = if length > 0.0 { length } else { 1.0 };
        let (numbers, durations) = runs.iter().map(|run| (run.run, run.duration)).unzip();
        Self { starts, numbers, durations, length, width }
    }

    /// Beginning of each run, s.
    pub(super) fn starts(&self) -> &[f64] {
        &self.starts
    }

    /// Whether runs are too many to be told apart.
    pub(super) fn is_crowded(&self) -> bool {
        self.starts.len() > MAX_LINES
    }

    /// Time of a column of pixels, s.
    pub(super) fn column(&self) -> f64 {
        self.length / f64::from(self.width)
    }

    /// The axis: seconds of a single run; of several the number of each and the seconds within it,
    /// as far as there is room. Without numbers where a panel below has them.
    pub(super) fn axis(&self, has_numbers: bool) -> Axis {
        let range = [0.0, self.length];
        let one = Axis::new("time from the first reading of the tracks", "s", range);
        if self.starts.len() < 2 {
            return if has_numbers { one } else { one.at(Vec::new()) };
        }
        let quantity = "number of the run, and s within it";
        let axis = Axis::new(quantity, "", range).without_grid();
        axis.at(if has_numbers { self.ticks() } else { Vec::new() })
    }

    fn ticks(&self) -> Vec<(f64, String)> {
        let apart = MIN_TEXT_DISTANCE * self.column();
        let within = Ticks::along([0.0, self.length], self.width, 150).step;
        let mut ticks: Vec<(f64, String)> = Vec::new();
        for ((start, number), duration) in
            self.starts.iter().zip(&self.numbers).zip(&self.durations)
        {
            let is_free = |ticks: &[(f64, String)], at: f64| {
                ticks.last().is_none_or(|(last, _)| at - last >= apart)
            };
            if is_free(&ticks, *start) {
                ticks.push((*start, format!("run {number}")));
            }
            let seconds = (1..).map(|k| real(k) * within).take_while(|s| *s > 0.0 && s < duration);
            for second in seconds {
                // the next run needs room for its number
                let is_last = start + second + apart > start + duration;
                if is_free(&ticks, start + second) && !is_last {
                    ticks.push((start + second, format!("{second} s")));
                }
            }
        }
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timeline(durations: &[f64]) -> Timeline {
        let run = |(run, &duration): (i64, &f64)| RunRates {
            run,
            duration,
            tracks: Vec::new(),
            rates: Vec::new(),
        };
        Timeline::new(&(3..).zip(durations).map(run).collect::<Vec<_>>(), 2000)
    }

    #[test]
    fn runs_are_numbered_where_there_is_room() {
        let few = timeline(&[100.0, 50.0]);
        assert_eq!(few.starts(), [0.0, 100.0]);
        let texts: Vec<String> = few.ticks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(texts[..2], ["run 3", "20 s"]);
        assert!(texts.contains(&"run 4".to_owned()), "{texts:?}");
        let many = timeline(&[2.0; 600]);
        assert!(many.is_crowded());
        let ticks = many.ticks();
        assert!((8..=14).contains(&ticks.len()), "{ticks:?}");
        let apart = MIN_TEXT_DISTANCE * many.column();
        assert!(ticks.windows(2).all(|pair| pair[1].0 - pair[0].0 >= apart));
    }

    #[test]
    fn a_recording_without_time_has_an_axis() {
        assert_eq!(timeline(&[0.0]).axis(true).range, [0.0, 1.0]);
        assert_eq!(timeline(&[]).axis(true).range, [0.0, 1.0]);
    }
}
