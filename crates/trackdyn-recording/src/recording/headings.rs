//! Yaw from a gyroscope, where nothing else has poses.

use super::UncheckedRun;
use crate::sample::PoseSample;
use trackdyn_core::Pose;

/// Gives a run the yaw of its gyroscope for poses.
pub(crate) fn turn_by_gyroscope(run: &mut UncheckedRun) {
    let rates = run.imu.samples.iter().map(|reading| [reading.t, reading.gyro_z]);
    let mut rates: Vec<[f64; 2]> =
        rates.filter(|[t, rate]| t.is_finite() && rate.is_finite()).collect();
    rates.sort_by(|[a, _], [b, _]| a.total_cmp(b));
    let poses = rates.iter().zip(headings(&rates)).map(|([t, _], yaw)| {
        let pose = Pose::new(f64::NAN, f64::NAN, yaw);
        PoseSample { t: *t, pose }
    });
    run.poses.samples = poses.collect();
}

/// The yaw, from 0 on, at each of these yaw rates, in rad: pairs (s, rad/s) in the order of time.
///
/// Δψ = ∫ ω dt by the trapezoidal rule
///
/// # Assumes
/// The bias of the gyroscope is not removed here: fits of the yaw estimate it.
pub(crate) fn headings(rates: &[[f64; 2]]) -> Vec<f64> {
    let mut yaw = 0.0;
    let turns = rates.windows(2).map(|pair| {
        let [[start, first], [end, last]] = [pair[0], pair[1]];
        yaw += (end - start) * f64::midpoint(first, last);
        yaw
    });
    std::iter::once(0.0).chain(turns).take(rates.len()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn yaw_is_the_integral_of_the_yaw_rate() {
        // ω = 0.2 t at 10 Hz: ψ = 0.1 t²
        let rates: Vec<[f64; 2]> =
            (0..=50).map(|k| [0.1 * f64::from(k), 0.02 * f64::from(k)]).collect();
        let found = headings(&rates);
        assert_eq!(found.len(), 51);
        assert!((found[50] - 2.5).abs() < 1e-9 && found[0] == 0.0);
        assert!(headings(&[]).is_empty());
    }
}
