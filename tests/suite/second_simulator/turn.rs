//! Steady turns and the ICRs that they show.

use trackdyn_core::{PerSide, Plant, Pose, Trajectory, frames};
use trackdyn_model::{Vehicle, VehicleFile};
use trackdyn_second_simulator::{ActiveMechanism, Robot, Setup};

/// Way of the slower belt until every shoe has come to the ground in the turn, m.
const SETTLING_WAY: f64 = 0.8;

/// Time beside it until mass has followed, s: seven times v/(μ g) of a spin at 1 m/s.
const FOLLOWING_TIME: f64 = 1.0;

/// Way of the slower belt in which the turn is measured, m: one shoe, over which the ripple of
/// shoes that come and go averages out.
const MEASURED_WAY: f64 = 0.025;

/// Distance and angle to which a turn is brought to its target, m and rad: mechanisms of typical
/// size change an ICR by less than 0.1 m in a radian.
const TARGET_DISTANCE: f64 = 2e-3;

/// Auriga-alpha with this centre of gravity, in the friction of the reference numbers.
pub fn auriga(cog: [f64; 2]) -> Vehicle {
    let vehicle = Vehicle { cog, ..VehicleFile::auriga_alpha().vehicle };
    assert_eq!((vehicle.friction.across, vehicle.friction.along), (0.9, 0.7));
    vehicle
}

/// Mechanisms of these ids at their typical sizes.
pub fn typical(ids: &[&str]) -> Vec<ActiveMechanism> {
    ids.iter().map(|id| ActiveMechanism::new(id, &[]).expect("a mechanism")).collect()
}

/// A steady turn to be measured.
pub struct Turn<'a> {
    /// The machine.
    pub vehicle: &'a Vehicle,
    /// What acts beside the base case.
    pub active: &'a [ActiveMechanism],
    /// How finely it is simulated.
    pub setup: &'a Setup,
    /// Speeds of the encoders, left and right, m/s.
    pub speeds: (f64, f64),
    /// Where the middle of the measurement is to be.
    pub target: Pose,
    /// When it is to be, s.
    pub at: f64,
}

impl Turn<'_> {
    /// (x_l, x_r, y) from reported poses, paper's frame, m.
    pub fn icrs(&self) -> [f64; 3] {
        self.icrs_from(&mut Pose::default())
    }

    /// As [`Turn::icrs`]. `start` is where the turn may begin, seen from its target. It becomes
    /// where it begins: a turn of the same way takes one drive from there.
    pub fn icrs_from(&self, start: &mut Pose) -> [f64; 3] {
        // the way to the target depends on where it begins, where the ground is not everywhere the
        // same
        let (truth, reported, [begin, end]) = loop {
            let from = self.target.compose(start);
            let (truth, reported, span) = self.drive(from);
            let middle = truth.pose_at(f64::midpoint(span[0], span[1]));
            let missed = middle.relative(&self.target);
            *start = middle.relative(&from);
            if missed.yaw.abs() < TARGET_DISTANCE && missed.x.hypot(missed.y) < TARGET_DISTANCE {
                break (truth, reported, span);
            }
        };
        let [early, _] = reported.span().expect("a motion");
        let shift = early - truth.span().expect("a motion")[0];
        let (a, b) = (reported.pose_at(begin + shift), reported.pose_at(end + shift));
        let twist = frames::paper_twist_from_ros(&a.relative(&b).log(end - begin));
        let (left, right) = self.speeds;
        // x_j = (V_j − v_y)/ω, y = v_x/ω
        [(left - twist.v_y) / twist.w, (right - twist.v_y) / twist.w, twist.v_x / twist.w]
    }

    fn drive(&self, start: Pose) -> (Trajectory, Trajectory, [f64; 2]) {
        let (left, right) = self.speeds;
        let slower = left.abs().min(right.abs());
        let begin = self.at - 0.5 * MEASURED_WAY / slower;
        let end = begin + MEASURED_WAY / slower;
        let setup = Setup {
            start,
            start_time: begin - FOLLOWING_TIME - SETTLING_WAY / slower,
            ..self.setup.clone()
        };
        let mut robot = Robot::new(self.vehicle, self.active, &setup).expect("a robot");
        let mut truth = Trajectory::default();
        truth.push(robot.moment());
        robot.drive(PerSide::new(left, right), begin, &mut truth).expect("a motion");
        robot.drive(PerSide::new(left, right), end, &mut truth).expect("a motion");
        let reported = robot.report(&truth);
        (truth, reported, [begin, end])
    }
}

/// Largest difference of two triples, m.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
