//! The angle that a gyroscope measures between two times.

use trackdyn_core::robust::usual_interval;
use trackdyn_recording::Run;
use trackdyn_recording::recording::longest_interval;

/// Readings of a gyroscope without a gap between them, and their integral.
pub(super) struct Turned {
    times: Vec<f64>,
    rates: Vec<f64>,
    /// G at the times, by the trapezoidal rule, rad.
    angles: Vec<f64>,
}

impl Turned {
    /// The readings of a run between its gaps, where these are so many in a row.
    pub(super) fn of_run(run: &Run, min_readings: usize) -> Vec<Self> {
        let readings = run.imu();
        let longest = longest_interval(usual_interval(readings.iter().map(|reading| reading.t)));
        let rows = readings.chunk_by(|a, b| b.t - a.t <= longest);
        let long = rows.filter(|row| row.len() >= min_readings);
        long.map(|row| {
            let (times, rates) = row.iter().map(|reading| (reading.t, reading.gyro_z)).unzip();
            Self::new(times, rates)
        })
        .collect()
    }

    fn new(times: Vec<f64>, rates: Vec<f64>) -> Self {
        let mut angle = 0.0;
        let steps = (1..times.len()).map(|k| {
            angle += (times[k] - times[k - 1]) * f64::midpoint(rates[k - 1], rates[k]);
            angle
        });
        let angles = std::iter::once(0.0).chain(steps).collect();
        Self { times, rates, angles }
    }

    /// Second differences of the yaw rate by √6, rad/s: each is as large as the noise of a reading.
    /// Those while `is_still` holds at all three times, or all of them.
    pub(super) fn scatter(&self, is_still: &dyn Fn(f64) -> bool) -> [Vec<f64>; 2] {
        let mut all: [Vec<f64>; 2] = Default::default();
        for (times, rates) in self.times.windows(3).zip(self.rates.windows(3)) {
            let change = (rates[0] - 2.0 * rates[1] + rates[2]) / 6.0_f64.sqrt();
            if times.iter().all(|t| is_still(*t)) {
                all[0].push(change);
            }
            all[1].push(change);
        }
        all
    }

    /// First and last time, s.
    pub(super) fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// Angle G (rad) and yaw rate (rad/s) at a time within the span: the rate is linear between two
    /// readings.
    pub(super) fn at(&self, t: f64) -> (f64, f64) {
        let after = self.times.partition_point(|time| *time <= t).clamp(1, self.times.len() - 1);
        let (start, since) = (after - 1, t - self.times[after - 1]);
        let slope =
            (self.rates[after] - self.rates[start]) / (self.times[after] - self.times[start]);
        let rate = self.rates[start] + slope * since;
        // G(t) = G₀ + (ω₀ + ω(t))/2 (t − t₀)
        (self.angles[start] + f64::midpoint(self.rates[start], rate) * since, rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_that_grows_evenly_is_integrated_exactly() {
        let times: Vec<f64> = [0.0, 0.1, 0.25, 0.3, 0.5].to_vec();
        let rates = times.iter().map(|t| 0.2 + 0.6 * t).collect();
        let turned = Turned::new(times, rates);
        for t in [0.0, 0.07, 0.26, 0.5] {
            let (angle, rate) = turned.at(t);
            assert!((angle - (0.2 * t + 0.3 * t * t)).abs() < 1e-15, "{t}: {angle}");
            assert!((rate - (0.2 + 0.6 * t)).abs() < 1e-15, "{t}: {rate}");
        }
    }
}
