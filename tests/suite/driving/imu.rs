//! What an IMU reports.

use crate::driving::plant::auriga;
use trackdyn_core::{Command, PerSide, Plant, Schedule};
use trackdyn_drive::Sensors;
use trackdyn_drive::sensors::{Imu, Preset};
use trackdyn_recording::ImuSample;

fn circling(imu: Imu, run: i64) -> Vec<ImuSample> {
    let speeds = PerSide::new(0.2, 0.8);
    let commands = [0.0, 20.0].map(|t| Command { t, speeds });
    let schedule = Schedule::new(commands.to_vec()).expect("a schedule");
    let trajectory = auriga().follow(&schedule).expect("it rolls");
    let sensors = Sensors { imu: Some(imu), ..Preset::Perfect.sensors() };
    sensors.observe(run, &trajectory, 2).expect("a motion").imu.samples
}

#[test]
fn circling_is_felt_as_centripetal_acceleration_at_the_sensor() {
    let perfect = Preset::Perfect.sensors().imu.expect("an IMU");
    let w = 0.6 / 0.832;
    // twist at the origin, ROS: (7)-(8) with v_x to the right
    let (ahead, left) = (0.5 - w * 0.041, -w * 0.0492);
    for [x, y] in [[0.0, 0.0], [0.4, -0.2]] {
        let readings = circling(Imu { forward: x, left: y, ..perfect }, 0);
        // a = ω × (v + ω × r)
        let (v_x, v_y) = (ahead - w * y, left + w * x);
        for sample in &readings[1..] {
            assert!((sample.gyro_z - w).abs() < 1e-9);
            // the mean over 10 ms is shorter than the vector by (ω T)²/24 = 2e-6
            assert!((sample.acc_x + w * v_y).abs() < 1e-5, "{sample:?}");
            assert!((sample.acc_y - w * v_x).abs() < 1e-5, "{sample:?}");
        }
    }
}

#[test]
fn bias_belongs_to_the_run_and_noise_to_the_reading() {
    let perfect = Preset::Perfect.sensors().imu.expect("an IMU");
    let imu = Imu { gyro: 0.01, gyro_bias: 0.05, ..perfect };
    let w = 0.6 / 0.832;
    let biases: Vec<f64> = (0..40)
        .map(|run| {
            let errors: Vec<f64> =
                circling(imu, run)[1..].iter().map(|sample| sample.gyro_z - w).collect();
            #[expect(clippy::cast_precision_loss, reason = "2000 readings")]
            let count = errors.len() as f64;
            let mean = errors.iter().sum::<f64>() / count;
            let squares = errors.iter().map(|error| (error - mean).powi(2)).sum::<f64>();
            // 2000 readings tell a deviation to 1.6 %
            assert!(((squares / count).sqrt() / 0.01 - 1.0).abs() < 0.08);
            mean
        })
        .collect();
    let deviation = (biases.iter().map(|bias| bias * bias).sum::<f64>() / 40.0).sqrt();
    // 40 biases: 11 %
    assert!((deviation / 0.05 - 1.0).abs() < 0.4, "{deviation}");
}
