//! A pose sensor: laser odometry, a camera above, a tracking station.

use super::stamps::{Stamper, moments};
use super::walk::Process;
use crate::random::{Purpose, normal, stream};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use trackdyn_core::{Pose, Trajectory};
use trackdyn_recording::PoseSample;

/// Half the width of the square in which frames of runs are laid, m.
const MAX_FRAME_OFFSET: f64 = 10.0;

/// What measures poses.
///
/// # Law
/// reported = frame_from_world · world_from_body(t) · body_from_sensor + walk + white (+ outlier),
/// stamped t + delay + jitter. Errors add to x, y and yaw in the axes of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PoseSensor {
    /// Time between poses, s.
    #[serde(rename = "interval_s")]
    pub interval: f64,
    /// Time by which stamps are late, s.
    #[serde(rename = "delay_s")]
    pub delay: f64,
    /// Standard deviation of stamps, uniform, s.
    #[serde(rename = "jitter_s")]
    pub jitter: f64,
    /// The frame of the poses.
    pub frame: PoseFrame,
    /// Where the sensor sits; its own pose is reported as the robot's.
    pub mount: Mount,
    /// Error of each pose by itself.
    pub white: White,
    /// Error that goes on from pose to pose.
    pub walk: Walk,
    /// Poses that are wrong.
    pub outlier: Outlier,
    /// Poses that are missing.
    pub dropout: Dropout,
}

/// The frame of the poses of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PoseFrame {
    /// The world of the motion.
    World,
    /// The sensor's first pose, as odometry has it.
    Start,
    /// Anywhere, within 10 m either way and with any heading: one for each run.
    Random,
}

/// Where the sensor sits: `body_from_sensor`, REP-103.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mount {
    /// Before the centre of the contact area, m.
    #[serde(rename = "forward_m")]
    pub forward: f64,
    /// Left of it, m.
    #[serde(rename = "left_m")]
    pub left: f64,
    /// Turned counter-clockwise, rad.
    #[serde(rename = "yaw_rad")]
    pub yaw: f64,
}

impl Mount {
    /// `body_from_sensor`.
    pub fn pose(&self) -> Pose {
        Pose::new(self.forward, self.left, self.yaw)
    }
}

/// White noise: standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct White {
    /// Of x and of y, m.
    #[serde(rename = "position_m")]
    pub position: f64,
    /// Of yaw, rad.
    #[serde(rename = "yaw_rad")]
    pub yaw: f64,
}

/// Coloured noise: a random walk, or with a memory an Ornstein-Uhlenbeck process.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Walk {
    /// √q of x and of y, m/√s.
    #[serde(rename = "position_m_per_sqrt_s")]
    pub position: f64,
    /// √q of yaw, rad/√s.
    #[serde(rename = "yaw_rad_per_sqrt_s")]
    pub yaw: f64,
    /// Time after which an error is forgotten, s; never where absent.
    #[serde(rename = "memory_s", skip_serializing_if = "Option::is_none")]
    pub memory: Option<f64>,
}

/// Poses that are wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Outlier {
    /// Share of the poses.
    pub share: f64,
    /// Standard deviation of their x and y, m.
    #[serde(rename = "position_m")]
    pub position: f64,
    /// Standard deviation of their yaw, rad.
    #[serde(rename = "yaw_rad")]
    pub yaw: f64,
}

/// Poses that are missing: a sensor that fails and comes back at random.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dropout {
    /// Share of the time.
    pub share: f64,
    /// Mean time without poses, s.
    #[serde(rename = "duration_s")]
    pub duration: f64,
}

impl Default for PoseSensor {
    fn default() -> Self {
        Self {
            interval: 0.1,
            delay: 0.06,
            jitter: 2e-3,
            frame: PoseFrame::Start,
            mount: Mount::default(),
            white: White::default(),
            walk: Walk::default(),
            outlier: Outlier::default(),
            dropout: Dropout::default(),
        }
    }
}

impl Default for White {
    fn default() -> Self {
        Self { position: 3e-3, yaw: 2e-3 }
    }
}

impl Default for Walk {
    fn default() -> Self {
        Self { position: 1e-3, yaw: 5e-4, memory: None }
    }
}

impl PoseSensor {
    pub(super) fn observe(
        &self,
        run: i64,
        trajectory: &Trajectory,
        span: [f64; 2],
        seed: u64,
    ) -> Vec<PoseSample> {
        let of = |purpose| stream(seed, run, purpose);
        let mount = self.mount.pose();
        let sensor = |t: f64| trajectory.pose_at(t).compose(&mount);
        let frame = self.frame_from_world(&sensor(span[0]), &mut of(Purpose::PoseFrame));
        let (jitter, delay) = (self.jitter, self.delay);
        let mut stamper = Stamper::new(seed, run, Purpose::PoseStamp, delay, jitter);
        let mut white = of(Purpose::PoseWhite);
        let mut wrong = of(Purpose::PoseOutlier);
        let mut walking = of(Purpose::PoseWalk);
        let Walk { position, yaw, memory } = self.walk;
        let mut walk =
            [position, position, yaw].map(|strength| Process::new(strength, memory, &mut walking));
        let mut absence = Absence::new(self.dropout, of(Purpose::PoseDropout));
        let mut before = span[0];
        let mut poses = Vec::new();
        for t in moments(span, self.interval) {
            // every draw is made for every pose, reported or not
            let walked = walk.each_mut().map(|process| process.after(t - before, &mut walking));
            let White { position, yaw } = self.white;
            let noise = [position, position, yaw].map(|deviation| deviation * normal(&mut white));
            let error = self.outlying(&mut wrong);
            let stamp = stamper.stamp(t);
            let missing = absence.at(t - before);
            before = t;
            if missing {
                continue;
            }
            let truth = frame.compose(&sensor(t));
            let of = |k: usize| walked[k] + noise[k] + error[k];
            let pose = Pose::new(truth.x + of(0), truth.y + of(1), truth.yaw + of(2));
            poses.push(PoseSample { t: stamp, pose });
        }
        poses
    }

    fn frame_from_world(&self, first: &Pose, random: &mut ChaCha8Rng) -> Pose {
        match self.frame {
            PoseFrame::World => Pose::default(),
            PoseFrame::Start => first.inverse(),
            PoseFrame::Random => Pose::new(
                random.random_range(-MAX_FRAME_OFFSET..MAX_FRAME_OFFSET),
                random.random_range(-MAX_FRAME_OFFSET..MAX_FRAME_OFFSET),
                random.random_range(0.0..TAU),
            ),
        }
    }

    fn outlying(&self, random: &mut ChaCha8Rng) -> [f64; 3] {
        let Outlier { share, position, yaw } = self.outlier;
        let drawn: f64 = random.random();
        let errors = [position, position, yaw].map(|deviation| deviation * normal(random));
        if drawn < share { errors } else { [0.0; 3] }
    }
}

/// A sensor that fails and comes back: two states with exponential times, of which the share p and
/// the mean absence D are given, so that it fails at the rate p/((1 − p) D) and comes back at the
/// rate 1/D.
struct Absence {
    dropout: Dropout,
    random: ChaCha8Rng,
    absent: bool,
}

impl Absence {
    fn new(dropout: Dropout, mut random: ChaCha8Rng) -> Self {
        let absent = random.random::<f64>() < dropout.share;
        Self { dropout, random, absent }
    }

    /// Whether it is absent after a step, s.
    fn at(&mut self, step: f64) -> bool {
        let Dropout { share, duration } = self.dropout;
        let drawn: f64 = self.random.random();
        // the chance relaxes to p at the sum of both rates, 1/((1 − p) D)
        let keep = if share > 0.0 { (-step / ((1.0 - share) * duration)).exp() } else { 0.0 };
        let now = if self.absent { 1.0 } else { 0.0 };
        self.absent = drawn < share + (now - share) * keep;
        self.absent
    }
}
