//! Yaw from a gyroscope, where a bag has no poses.

use super::Received;
use crate::rosbag::date::seconds;

/// The yaw, from 0 on, that the yaw rates of an IMU add up to; positions are no numbers. `imu`
/// holds the yaw rate, rad/s, and the specific forces.
///
/// Δψ = ∫ ω dt by the trapezoidal rule
///
/// # Assumes
/// The bias of the gyroscope, which is not removed here, is found by who fits the yaw.
pub(super) fn headings(imu: &[Received<[f64; 3]>]) -> Vec<Received<[f64; 3]>> {
    let at = |reading: &Received<[f64; 3]>| reading.stamp_ns.unwrap_or(reading.log_ns);
    let mut readings: Vec<&Received<[f64; 3]>> = imu.iter().collect();
    readings.sort_by_key(|reading| at(reading));
    let mut yaw = 0.0;
    let mut before: Option<&Received<[f64; 3]>> = None;
    let mut headings = Vec::with_capacity(readings.len());
    for reading in readings.into_iter().filter(|reading| reading.value[0].is_finite()) {
        if let Some(before) = before {
            let interval = seconds(at(before), at(reading));
            yaw += interval * f64::midpoint(before.value[0], reading.value[0]);
        }
        headings.push(Received { value: [f64::NAN, f64::NAN, yaw], ..*reading });
        before = Some(reading);
    }
    headings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn yaw_is_the_integral_of_the_yaw_rate() {
        // ω = 0.2 t at 10 Hz, out of order: ψ = 0.1 t²
        let reading = |k: i64| Received {
            stamp_ns: Some(100_000_000 * k),
            log_ns: 0,
            value: [0.02 * f64::from(i32::try_from(k).expect("small")), 0.0, 9.8],
        };
        let mut readings: Vec<_> = (0..=50).map(reading).collect();
        readings.swap(3, 4);
        readings[10].value[0] = f64::NAN;
        let headings = headings(&readings);
        assert_eq!(headings.len(), 50);
        let last = headings.last().expect("some");
        assert!((last.value[2] - 2.5).abs() < 1e-9 && last.value[0].is_nan());
    }
}
