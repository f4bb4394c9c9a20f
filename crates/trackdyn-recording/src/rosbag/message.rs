//! The message types, from their definitions in `common_interfaces` and `geometry2`.

use super::payload::{Encoding, Number, Payload, PayloadError};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// Time stamp and frame of a message.
pub(super) struct Header<'a> {
    /// Nanoseconds of Unix time; none where the stamp is zero.
    pub(super) stamp_ns: Option<i64>,
    /// The frame that the message is expressed in.
    pub(super) frame: &'a str,
}

/// `std_msgs/Header`: `builtin_interfaces/Time stamp, string frame_id`; that of ROS 1 has `uint32
/// seq` before.
pub(super) fn header<'a>(payload: &mut Payload<'a>) -> Result<Header<'a>, PayloadError> {
    if payload.encoding() == Encoding::Ros1 {
        payload.u32()?;
    }
    let (seconds, nanoseconds) = (payload.i32()?, payload.u32()?);
    let stamp = i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds);
    Ok(Header { stamp_ns: (stamp != 0).then_some(stamp), frame: payload.text()? })
}

/// `geometry_msgs/Pose` or `Transform`: three coordinates and a quaternion, as (x, y, yaw) and this
/// quaternion (x, y, z, w).
pub(super) fn oriented_pose(payload: &mut Payload) -> Result<([f64; 3], [f64; 4]), PayloadError> {
    let [x, y, _, quaternion @ ..]: [f64; 7] = payload.f64s()?;
    Ok(([x, y, yaw_of_quaternion(quaternion)], quaternion))
}

/// `geometry_msgs/Transform` in space; none where it is not finite or its quaternion is zero.
pub(super) fn rigid(payload: &mut Payload) -> Result<Option<Isometry3<f64>>, PayloadError> {
    let values: [f64; 7] = payload.f64s()?;
    let [x, y, z, i, j, k, w] = values;
    let rotation = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 1e-6);
    let is_finite = values.iter().all(|value| value.is_finite());
    Ok(rotation
        .filter(|_| is_finite)
        .map(|rotation| Isometry3::from_parts(Translation3::new(x, y, z), rotation)))
}

/// (x, y, yaw) of a transform in space.
pub(super) fn planar(transform: &Isometry3<f64>) -> [f64; 3] {
    let [x, y, _]: [f64; 3] = transform.translation.vector.into();
    [x, y, yaw_of_quaternion(transform.rotation.coords.into())]
}

/// `sensor_msgs/Imu` after its header: angular velocity and linear acceleration along its axes; and
/// the yaw of its orientation, where it has one.
pub(super) fn imu(payload: &mut Payload) -> Result<([[f64; 3]; 2], Option<f64>), PayloadError> {
    let orientation: [f64; 4] = payload.f64s()?;
    // The first element of the covariance is -1 where there is no orientation.
    let [unknown]: [f64; 1] = payload.f64s()?;
    payload.skip_f64s(8)?;
    let rate: [f64; 3] = payload.f64s()?;
    payload.skip_f64s(9)?;
    let force: [f64; 3] = payload.f64s()?;
    let yaw = yaw_of_quaternion(orientation);
    Ok(([rate, force], Some(yaw).filter(|yaw| unknown != -1.0 && yaw.is_finite())))
}

/// `sensor_msgs/NavSatFix` after its header: latitude and longitude in degrees, altitude in metres;
/// none where the receiver has no fix.
pub(super) fn fix(payload: &mut Payload) -> Result<Option<[f64; 3]>, PayloadError> {
    let status = payload.number(Number::I8)?;
    // the satellite systems
    payload.skip(2, 1)?;
    let fix: [f64; 3] = payload.f64s()?;
    let [latitude, longitude, _] = fix;
    let is_place = latitude.abs() <= 90.0 && longitude.abs() <= 180.0;
    Ok((status >= 0.0 && is_place).then_some(fix))
}

/// Yaw of a rotation that need not be normalised; NaN for the zero quaternion.
pub(crate) fn yaw_of_quaternion([x, y, z, w]: [f64; 4]) -> f64 {
    if [x, y, z, w] == [0.0; 4] {
        return f64::NAN;
    }
    // yaw = atan2(2 (w z + x y), w² + x² − y² − z²)
    (2.0 * (w * z + x * y)).atan2(w * w + x * x - y * y - z * z)
}

#[cfg(test)]
mod tests {
    use super::yaw_of_quaternion;

    #[test]
    fn yaw_survives_scale_sign_and_tilt() {
        let (sin, cos) = (0.6_f64 / 2.0).sin_cos();
        for scale in [1.0, -1.0, 3.0] {
            let yaw = yaw_of_quaternion([0.0, 0.0, scale * sin, scale * cos]);
            assert!((yaw - 0.6).abs() < 1e-15);
        }
        // yaw 0.6 after a roll of 0.3: q = q_z(0.6) q_x(0.3)
        let (roll_sin, roll_cos) = 0.15_f64.sin_cos();
        let tilted = [cos * roll_sin, sin * roll_sin, sin * roll_cos, cos * roll_cos];
        assert!((yaw_of_quaternion(tilted) - 0.6).abs() < 1e-15);
        assert!(yaw_of_quaternion([0.0; 4]).is_nan());
    }
}
