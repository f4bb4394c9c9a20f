//! ICRs of the moment.

use super::actor::Actor;
use trackdyn_core::frames::ros_from_paper;
use trackdyn_core::{PerSide, Pose, Twist};
use trackdyn_export::viewer::MarkerLayer;
use trackdyn_model::Icrs;

/// Time over which ICRs are told from poses, s.
pub(crate) const PIECE: f64 = 1.0;

/// Least turn of such a time, rad: poses that are 10 mm wrong move an ICR by 0.07 m.
const MIN_TURN: f64 = 0.2;

/// Largest distance of an ICR that is shown, m: on a straight line it is far away.
const MAX_DISTANCE: f64 = 10.0;

/// Diameter of a marker, as a share of the gauge.
const MARKER_SIZE: f64 = 0.15;

/// Names of the points.
const POINTS: [&str; 3] = ["ICR of left track", "ICR of right track", "ICR of robot"];

/// The ICRs of a time.
pub(crate) struct Moment {
    /// Those of the tracks, paper's frame.
    pub(crate) tracks: Icrs,
    /// That of the robot, ROS axes; none on a straight line.
    robot: Option<[f64; 2]>,
}

/// Title, topic and value of a coordinate.
type Coordinate = (&'static str, &'static str, fn(&Icrs) -> f64);

/// The coordinates of the ICRs of tracks.
pub(crate) const COORDINATES: [Coordinate; 3] = [
    ("ICR of left track, to the right of the robot [m]", "x_icr_left", |icrs| icrs.x_left),
    ("ICR of right track, to the right of the robot [m]", "x_icr_right", |icrs| icrs.x_right),
    ("ICRs, in front of the robot [m]", "y_icr", |icrs| icrs.y),
];

impl Moment {
    /// ICRs of the tracks, and a twist, ROS axes.
    ///
    /// # Law
    /// The ICR of the robot is the point that stands: v + ω × p = 0.
    pub(crate) fn new(tracks: Icrs, twist: &Twist) -> Self {
        let Twist { v_x, v_y, w } = *twist;
        Self { tracks, robot: (w != 0.0).then(|| [-v_y / w, v_x / w]) }
    }

    /// The ICRs of a motion with mean track speeds, m/s, as measured; none where it hardly turns,
    /// or turns so far that it does not tell how it did.
    ///
    /// # Law
    /// V_l = v_y + x_l ω and V_r = v_y + x_r ω, eqs (10)-(11), with v_y forward; v_x = ω y,
    /// eq. (7), with v_x to the right.
    pub(crate) fn of_motion(motion: &Pose, duration: f64, speeds: PerSide<f64>) -> Option<Self> {
        if !(MIN_TURN..std::f64::consts::PI).contains(&motion.yaw.abs()) {
            return None;
        }
        let twist = motion.log(duration);
        let tracks = Icrs {
            x_left: (speeds.left - twist.v_x) / twist.w,
            x_right: (speeds.right - twist.v_x) / twist.w,
            y: -twist.v_y / twist.w,
        };
        Some(Self::new(tracks, &twist))
    }
}

/// Markers of ICRs that move with a frame, without places yet.
pub(crate) fn markers(actor: &Actor, frame: &str, gauge: f64) -> MarkerLayer {
    MarkerLayer {
        diameter: MARKER_SIZE * gauge,
        points: POINTS.map(str::to_owned).into(),
        ..actor.markers("icrs", frame)
    }
}

/// The places of the markers of a moment, ROS axes.
pub(crate) fn places(moment: Option<&Moment>) -> Vec<Option<[f64; 2]>> {
    let points = moment.map(|Moment { tracks: Icrs { x_left, x_right, y }, robot }| {
        [Some(ros_from_paper([*x_left, *y])), Some(ros_from_paper([*x_right, *y])), *robot]
    });
    let near = |[x, y]: &[f64; 2]| x.hypot(*y) <= MAX_DISTANCE;
    points.unwrap_or_default().map(|point| point.filter(near)).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::frames::ros_twist_from_paper;
    use trackdyn_model::Kinematics;

    #[test]
    fn a_motion_shows_the_icrs_that_it_was_made_with() {
        let icrs = Icrs { x_left: -0.375, x_right: 0.457, y: 0.049 };
        for speeds in [PerSide::new(0.1, 0.9), PerSide::new(0.6, -0.4)] {
            let twist = ros_twist_from_paper(&Kinematics::new(icrs).twist(speeds));
            let moment = Moment::of_motion(&Pose::exp(&twist, 1.5), 1.5, speeds);
            let moment = moment.expect("it turns");
            for (_, name, value) in COORDINATES {
                let (found, made) = (value(&moment.tracks), value(&icrs));
                assert!((found - made).abs() < 1e-12, "{name}: {found} {made}");
            }
            // the robot's ICR lies on the line through those of its tracks, and stands
            let [x, y] = moment.robot.expect("it turns");
            let still = twist.velocity_at([x, y]);
            assert!((x - 0.049).abs() < 1e-12 && still.iter().all(|of| of.abs() < 1e-12));
            let places = places(Some(&moment));
            let [x, y] = places[0].expect("near");
            assert!((x - 0.049).abs() < 1e-12 && (y - 0.375).abs() < 1e-12);
        }
        let straight = Moment::of_motion(&Pose::new(1.0, 0.0, 0.1), 1.0, PerSide::new(1.0, 1.0));
        assert!(straight.is_none());
        assert_eq!(places(None), [None; 3]);
        let far = Moment::new(icrs, &Twist { v_x: 1.0, v_y: 0.0, w: 0.01 });
        assert!(places(Some(&far))[2].is_none(), "100 m away");
    }
}
