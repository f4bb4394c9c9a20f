//! Gaps: times in which no reading of the tracks came.
//!
//! Within them nobody knows what the tracks did: the last reading holds on, and is wrong.

use trackdyn_core::robust::usual_interval;
use trackdyn_recording::TrackSample;
use trackdyn_recording::recording::longest_interval;

/// The gaps between the readings of a run.
#[derive(Clone, Debug, Default)]
pub struct Gaps {
    /// From the reading before to the one after, s, in order.
    gaps: Vec<[f64; 2]>,
}

impl Gaps {
    /// Intervals that are longer than usual ([`longest_interval`]).
    pub fn of(tracks: &[TrackSample]) -> Self {
        Self::longer_than(
            longest_interval(usual_interval(tracks.iter().map(|sample| sample.t))),
            tracks,
        )
    }

    /// Intervals longer than this, s.
    pub fn longer_than(longest: f64, tracks: &[TrackSample]) -> Self {
        let intervals = tracks.windows(2).map(|pair| [pair[0].t, pair[1].t]);
        Self { gaps: intervals.filter(|[before, after]| after - before > longest).collect() }
    }

    /// Whether one of them lies in some part within two times of the encoders, s.
    pub fn meet(&self, from: f64, until: f64) -> bool {
        let next = self.gaps.partition_point(|[_, after]| *after <= from);
        self.gaps.get(next).is_some_and(|[before, _]| *before <= until)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_met_from_its_first_moment_to_its_last() {
        let stamps = [0.0, 0.1, 0.2, 0.9, 1.0, 1.1, 1.2];
        let tracks = stamps.map(|t| TrackSample { t, v_left: 0.0, v_right: 0.0 });
        let gaps = Gaps::of(&tracks);
        assert!(gaps.meet(0.15, 0.2) && gaps.meet(0.3, 0.4) && gaps.meet(0.89, 1.0));
        assert!(!gaps.meet(0.0, 0.19) && !gaps.meet(0.9, 1.2));
        assert!(!Gaps::of(&tracks[..1]).meet(0.0, 1.0));
    }
}
