//! Encoders: belt travel in ticks, and the speed that a driver makes of them.

use super::stamps::{Stamper, moments};
use crate::odometer::Odometer;
use crate::random::{Purpose, stream};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use trackdyn_core::{PerSide, Side, Trajectory};
use trackdyn_recording::TrackSample;

/// The encoders of both tracks.
///
/// # Law
/// At the moments t_k = k T the counter of a side shows n_k = ⌊S(t_k)/(α q) + φ⌋, with the belt's
/// travel S, the tick q, and a phase φ that nobody knows, uniform in \[0, 1). The driver reports
/// v_k = q (n_k − n_{k−1})/T. With f the fraction of a tick in a step of travel, its error has mean
/// zero over φ and variance f (1 − f) q²/T²: on average over speeds q²/(6 T²). Errors do not add
/// up: travel is always known to a tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Encoder {
    /// T, s.
    #[serde(rename = "interval_s")]
    pub interval: f64,
    /// q, belt travel per tick, m; 0 for no quantisation.
    #[serde(rename = "tick_m")]
    pub tick: f64,
    /// Which end of its interval a reading is stamped with.
    pub stamp_at: StampAt,
    /// Time by which stamps are late, s.
    #[serde(rename = "delay_s")]
    pub delay: f64,
    /// Standard deviation of stamps, uniform, s; intervals themselves are exact.
    #[serde(rename = "jitter_s")]
    pub jitter: f64,
    /// α_l: true speed per speed shown, eq. (20). A robot that has this error in its own drive does
    /// not need it here again.
    pub alpha_left: f64,
    /// α_r, eq. (21).
    pub alpha_right: f64,
}

/// Which end of its interval a reading is stamped with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StampAt {
    /// The start, so that a reading held until the next one shows the truth.
    Start,
    /// The end, as a driver does that counts and reports.
    End,
}

impl Default for Encoder {
    fn default() -> Self {
        Self {
            interval: 0.03,
            tick: 2e-4,
            stamp_at: StampAt::End,
            delay: 0.0,
            jitter: 1e-3,
            alpha_left: 1.0,
            alpha_right: 1.0,
        }
    }
}

impl Encoder {
    /// α of both sides.
    pub fn alpha(&self) -> PerSide<f64> {
        PerSide::new(self.alpha_left, self.alpha_right)
    }

    pub(super) fn observe(&self, run: i64, trajectory: &Trajectory, seed: u64) -> Vec<TrackSample> {
        let Some(span) = trajectory.span() else { return Vec::new() };
        let mut random = stream(seed, run, Purpose::EncoderPhase);
        let phase = PerSide::from_fn(|_| random.random::<f64>());
        let (jitter, delay) = (self.jitter, self.delay);
        let mut stamper = Stamper::new(seed, run, Purpose::EncoderStamp, delay, jitter);
        let mut odometer = Odometer::new(trajectory);
        let mut before: Option<(f64, PerSide<f64>)> = None;
        let mut readings = Vec::new();
        for t in moments(span, self.interval) {
            let travel = odometer.travel(t);
            let shown = PerSide::from_fn(|side: Side| {
                let travel = travel[side] / self.alpha()[side];
                if self.tick > 0.0 {
                    self.tick * (travel / self.tick + phase[side]).floor()
                } else {
                    travel
                }
            });
            if let Some((start, from)) = before.replace((t, shown)) {
                let stamp = stamper.stamp(match self.stamp_at {
                    StampAt::Start => start,
                    StampAt::End => t,
                });
                let speed = |side: Side| (shown[side] - from[side]) / self.interval;
                readings.push(TrackSample {
                    t: stamp,
                    v_left: speed(Side::Left),
                    v_right: speed(Side::Right),
                });
            }
        }
        readings
    }
}
