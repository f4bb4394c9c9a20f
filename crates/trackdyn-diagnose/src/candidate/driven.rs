//! Time that was driven, without the pauses between runs.
//!
//! A change at some time shows only while the robot drives. So no times are tried in the pauses
//! between runs, which may last hours.

use crate::evidence::Evidence;
use trackdyn_core::real;

/// The clock of a recording against the time that was driven until then.
pub(super) struct Driven {
    /// Beginning and duration of each sample, s, by time.
    samples: Vec<[f64; 2]>,
    /// Time that was driven until each, s, and at the end.
    until: Vec<f64>,
}

impl Driven {
    /// That of the samples.
    pub(super) fn of(evidence: &Evidence) -> Self {
        let samples = evidence.samples().iter();
        let mut samples: Vec<[f64; 2]> =
            samples.map(|sample| [sample.start, sample.duration]).collect();
        samples.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut until = vec![0.0];
        until.extend(samples.iter().scan(0.0, |sum, [_, duration]| {
            *sum += duration;
            Some(*sum)
        }));
        Self { samples, until }
    }

    /// Time that was driven in all, s.
    pub(super) fn whole(&self) -> f64 {
        self.until[self.samples.len()]
    }

    /// Time that was driven until a time of the clock, s; before the first sample it is negative.
    pub(super) fn at(&self, clock: f64) -> f64 {
        let place = self.samples.partition_point(|[start, _]| *start <= clock);
        let Some(place) = place.checked_sub(1) else {
            return self.samples.first().map_or(0.0, |[start, _]| clock - start);
        };
        let [start, duration] = self.samples[place];
        let is_last = place + 1 == self.samples.len();
        let since = clock - start;
        self.until[place] + if is_last { since } else { since.min(duration) }
    }

    /// The time of the clock until which so much was driven, s.
    pub(super) fn clock(&self, driven: f64) -> f64 {
        let place = self.until[..self.samples.len()].partition_point(|until| *until <= driven);
        let place = place.saturating_sub(1);
        self.samples.get(place).map_or(driven, |[start, _]| start + driven - self.until[place])
    }

    /// The mean time of a sample, s.
    pub(super) fn sample(&self) -> f64 {
        self.whole() / real(self.samples.len().max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_are_no_time() {
        // two runs of two samples each, with a pause of 96 s
        let samples = vec![[10.0, 1.0], [11.0, 1.0], [108.0, 1.0], [109.0, 2.0]];
        let driven = Driven { samples, until: vec![0.0, 1.0, 2.0, 3.0, 5.0] };
        for (clock, time) in [(10.0, 0.0), (11.5, 1.5), (108.5, 2.5), (110.5, 4.5)] {
            assert_eq!(driven.at(clock), time);
            assert_eq!(driven.clock(time), clock);
        }
        assert_eq!(driven.at(60.0), 2.0);
        assert_eq!([driven.at(7.0), driven.clock(-3.0)], [-3.0, 7.0]);
        assert_eq!([driven.at(113.0), driven.clock(7.0)], [7.0, 113.0]);
        assert_eq!(driven.whole(), 5.0);
    }
}
