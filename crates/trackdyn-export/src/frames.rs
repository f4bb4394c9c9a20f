//! The frame at which the robot is an ideal differential drive, and the robot's own.

use crate::number::MAX_LENGTH;
use crate::{EquivalentDrive, Error, Name};
use trackdyn_core::Pose;

/// The chain odometry frame → ICR frame → base frame.
///
/// The ICR frame is the parent of the base frame: an odometry that integrates an ideal differential
/// drive moves the ICR frame, and a frame has one parent. The base frame must then be the root of
/// the robot's own tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames {
    odom: Name,
    icr: Name,
    base: Name,
    contact_centre: [f64; 2],
}

impl Frames {
    /// The names, and the centre of the contact area of both tracks in the base frame, m, in ROS
    /// axes (forward, left).
    ///
    /// # Errors
    /// [`Error::SameFrame`], [`Error::ContactCentre`].
    pub fn new(odom: Name, icr: Name, base: Name, contact_centre: [f64; 2]) -> Result<Self, Error> {
        let [x, y] = contact_centre;
        if ![x, y].iter().all(|coordinate| (-MAX_LENGTH..=MAX_LENGTH).contains(coordinate)) {
            return Err(Error::ContactCentre { x, y });
        }
        let chain = [("odom-frame", &odom), ("icr-frame", &icr), ("base-frame", &base)];
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            if chain[a].1 == chain[b].1 {
                let name = chain[a].1.to_string();
                return Err(Error::SameFrame { first: chain[a].0, second: chain[b].0, name });
            }
        }
        Ok(Self { odom, icr, base, contact_centre })
    }

    /// Frame of the odometry.
    pub fn odom(&self) -> &Name {
        &self.odom
    }

    /// Frame midway between the ICRs.
    pub fn icr(&self) -> &Name {
        &self.icr
    }

    /// Base frame, the root of the robot's own tree.
    pub fn base(&self) -> &Name {
        &self.base
    }

    /// Pose `icr_from_base`, m and rad: the transform with the ICR frame as parent.
    pub fn icr_from_base(&self, drive: &EquivalentDrive) -> Pose {
        let ([x, y], [centre_x, centre_y]) = (drive.point, self.contact_centre);
        let base_from_icr = Pose::new(centre_x + x, centre_y + y, 0.0);
        base_from_icr.inverse()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::drive::tests::drive;

    pub(crate) fn frames() -> Frames {
        let name = |text: &str| text.parse().expect("a name");
        Frames::new(name("odom"), name("icr_link"), name("base_link"), [0.0, 0.0])
            .expect("three frames")
    }

    #[test]
    fn the_transform_is_the_inverse_of_the_offset() {
        // x = y_ICR and y = −(x_r + x_l)/2 from base to ICR, so the base lies behind and to the
        // left.
        let pose = frames().icr_from_base(&drive());
        assert!(
            (pose.x + 0.049_235).abs() < 1e-15 && (pose.y - 0.040_988).abs() < 1e-15,
            "{pose:?}"
        );
        assert_eq!(pose.yaw, 0.0);
        let moved = Frames { contact_centre: [-0.1, 0.02], ..frames() };
        let pose = moved.icr_from_base(&drive());
        assert!(
            (pose.x - 0.050_765).abs() < 1e-15 && (pose.y - 0.020_988).abs() < 1e-15,
            "{pose:?}"
        );
    }

    #[test]
    fn a_frame_is_not_its_own_parent() {
        let name = |text: &str| text.parse().expect("a name");
        let error = Frames::new(name("odom"), name("base_link"), name("base_link"), [0.0, 0.0]);
        assert!(matches!(error, Err(Error::SameFrame { first: "icr-frame", .. })), "{error:?}");
    }
}
