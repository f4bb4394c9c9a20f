//! Yaw from a gyroscope, where a bag has no poses.

use super::Received;
use crate::recording;
use crate::rosbag::date::seconds;

/// The yaw, from 0 on, that the yaw rates of an IMU add up to; positions are no numbers. `imu`
/// holds the yaw rate, rad/s, and the specific forces.
pub(super) fn headings(imu: &[Received<[f64; 3]>]) -> Vec<Received<[f64; 3]>> {
    let at = |reading: &Received<[f64; 3]>| reading.stamp_ns.unwrap_or(reading.log_ns);
    let finite = imu.iter().filter(|reading| reading.value[0].is_finite());
    let mut readings: Vec<&Received<[f64; 3]>> = finite.collect();
    readings.sort_by_key(|reading| at(reading));
    let Some(start) = readings.first().map(|reading| at(reading)) else { return Vec::new() };
    let rate = |reading: &&Received<[f64; 3]>| [seconds(start, at(reading)), reading.value[0]];
    let rates: Vec<[f64; 2]> = readings.iter().map(rate).collect();
    let turned = readings.into_iter().zip(recording::headings(&rates));
    turned.map(|(reading, yaw)| Received { value: [f64::NAN, f64::NAN, yaw], ..*reading }).collect()
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
