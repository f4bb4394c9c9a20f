//! The two frames and the way between them.
//!
//! - **Paper frame** (Martinez et al. 2005): origin at the centre of the contact area of both
//!   tracks, x right, y forward. Physics, maps and `kinematics.toml` use it.
//! - **ROS frame** (REP-103): same origin, x forward, y left. Recordings, trajectories and exports
//!   use it.
//!
//! The yaw rate is the same in both, and a coordinate on the middle line is y in one and x in the
//! other.

use crate::Twist;

/// Vector in ROS axes from paper axes: `x_ros = y_paper`, `y_ros = −x_paper`.
pub fn ros_from_paper([x, y]: [f64; 2]) -> [f64; 2] {
    [y, -x]
}

/// Vector in paper axes from ROS axes: `x_paper = −y_ros`, `y_paper = x_ros`.
pub fn paper_from_ros([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

/// Twist in ROS axes from paper axes.
pub fn ros_twist_from_paper(twist: &Twist) -> Twist {
    let [v_x, v_y] = ros_from_paper([twist.v_x, twist.v_y]);
    Twist { v_x, v_y, w: twist.w }
}

/// Twist in paper axes from ROS axes.
pub fn paper_twist_from_ros(twist: &Twist) -> Twist {
    let [v_x, v_y] = paper_from_ros([twist.v_x, twist.v_y]);
    Twist { v_x, v_y, w: twist.w }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_is_forward_and_there_and_back_is_nothing() {
        assert_eq!(ros_from_paper([0.0, 1.0]), [1.0, 0.0]);
        assert_eq!(ros_from_paper([1.0, 0.0]), [0.0, -1.0]);
        assert_eq!(paper_from_ros(ros_from_paper([0.3, -0.8])), [0.3, -0.8]);
        let twist = Twist { v_x: 0.1, v_y: 0.2, w: 0.3 };
        assert_eq!(paper_twist_from_ros(&ros_twist_from_paper(&twist)), twist);
    }
}
