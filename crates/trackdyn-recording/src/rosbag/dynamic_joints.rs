//! `control_msgs/DynamicJointState`: joints whose signals are told by the names of interfaces.

use super::payload::{Payload, PayloadError};

/// The interfaces that are read: position, rad, and velocity, rad/s.
const INTERFACES: [&str; 2] = ["position", "velocity"];

/// What a message says of joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct DynamicJoints<'a> {
    pub(super) names: Vec<&'a str>,
    /// Positions and velocities, NaN where a joint has none; empty where no joint has one.
    pub(super) signals: [Vec<f64>; 2],
}

/// Reads a message after its header: `string[] joint_names, InterfaceValue[] interface_values`;
/// an `InterfaceValue` is `string[] interface_names, float64[] values`.
///
/// # Errors
/// A message that ends too early.
pub(super) fn read<'a>(payload: &mut Payload<'a>) -> Result<DynamicJoints<'a>, PayloadError> {
    let mut joints = DynamicJoints::default();
    for _ in 0..payload.length()? {
        joints.names.push(payload.text()?);
    }
    let count = joints.names.len();
    joints.signals = [vec![f64::NAN; count], vec![f64::NAN; count]];
    let mut has = [false; 2];
    for joint in 0..payload.length()? {
        let mut interfaces = Vec::new();
        for _ in 0..payload.length()? {
            let name = payload.text()?;
            interfaces.push(INTERFACES.iter().position(|known| *known == name));
        }
        let (mut values, values_count) = payload.f64_sequence()?;
        for place in 0..values_count {
            let value = values.f64()?;
            if let Some(Some(signal)) = interfaces.get(place)
                && let Some(kept) = joints.signals[*signal].get_mut(joint)
            {
                *kept = value;
                has[*signal] = true;
            }
        }
    }
    for (signal, has) in joints.signals.iter_mut().zip(has) {
        if !has {
            signal.clear();
        }
    }
    Ok(joints)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rosbag::payload::Encoding;

    /// A message of ROS 1, whose texts and lists follow one another without gaps.
    fn message(joints: &[(&str, &[(&str, f64)])]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let count = |bytes: &mut Vec<u8>, count: usize| {
            bytes.extend(u32::try_from(count).expect("few").to_le_bytes());
        };
        let text = |bytes: &mut Vec<u8>, text: &str| {
            count(bytes, text.len());
            bytes.extend(text.bytes());
        };
        count(&mut bytes, joints.len());
        for (name, _) in joints {
            text(&mut bytes, name);
        }
        count(&mut bytes, joints.len());
        for (_, interfaces) in joints {
            count(&mut bytes, interfaces.len());
            for (name, _) in *interfaces {
                text(&mut bytes, name);
            }
            count(&mut bytes, interfaces.len());
            bytes.extend(interfaces.iter().flat_map(|(_, value)| value.to_le_bytes()));
        }
        bytes
    }

    fn read_all(bytes: &[u8]) -> Result<DynamicJoints<'_>, PayloadError> {
        read(&mut Payload::of(Encoding::Ros1, bytes)?)
    }

    #[test]
    fn interfaces_are_told_by_name_in_any_order() {
        let bytes = message(&[
            ("left", &[("velocity", 1.5), ("effort", 9.0)]),
            ("arm", &[("effort", 8.0)]),
            ("right", &[("temperature", 7.0), ("velocity", 2.5)]),
        ]);
        let joints = read_all(&bytes).expect("a message");
        assert_eq!(joints.names, ["left", "arm", "right"]);
        let [positions, velocities] = joints.signals;
        assert!(positions.is_empty());
        assert_eq!([velocities[0], velocities[2]], [1.5, 2.5]);
        assert!(velocities[1].is_nan());
    }

    #[test]
    fn every_cut_is_an_error() {
        let bytes = message(&[("l", &[("position", 1.0)])]);
        for end in 0..bytes.len() {
            assert!(read_all(&bytes[..end]).is_err(), "{end}");
        }
    }
}
