//! Recordings with known truth, for tests and examples.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use trackdyn_core::{PerSide, Pose, Twist, frames, real};
use trackdyn_recording::{
    PoseSample, Recording, Series, Source, StatedNoise, TrackSample, UncheckedRun,
};

/// Constant centres of rotation, in the paper's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantIcr {
    /// x of the left track's ICR, m.
    pub x_left: f64,
    /// x of the right track's ICR, m.
    pub x_right: f64,
    /// y of the ICRs, m.
    pub y: f64,
    /// Belt speed per speed that the encoders show, α, 1.
    pub alpha: PerSide<f64>,
}

impl ConstantIcr {
    /// Twist in ROS axes at the speeds that the encoders show, m/s.
    ///
    /// # Sources
    /// Martinez et al. 2005, (7)-(9), with (20)-(21).
    pub fn twist(&self, speeds: PerSide<f64>) -> Twist {
        let left = self.alpha.left * speeds.left;
        let right = self.alpha.right * speeds.right;
        // ω = (V_r − V_l) / (x_r − x_l)
        let w = (right - left) / (self.x_right - self.x_left);
        // v_x = ω y,  v_y = (V_r + V_l)/2 − ω (x_r + x_l)/2
        let v_x = w * self.y;
        let v_y = f64::midpoint(right, left) - w * f64::midpoint(self.x_right, self.x_left);
        frames::ros_twist_from_paper(&Twist { v_x, v_y, w })
    }
}

/// A time of constant track speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its length, s; a multiple of the track interval, else its end shows late in the readings.
    pub duration: f64,
    /// Track speeds, m/s.
    pub speeds: PerSide<f64>,
}

/// How a synthetic recording is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Synthetic {
    /// How the robot moves.
    pub kinematics: ConstantIcr,
    /// What the tracks do, run by run.
    pub schedules: Vec<Vec<Stretch>>,
    /// Time between readings of the tracks, s.
    pub track_interval: f64,
    /// Time between poses, s.
    pub pose_interval: f64,
    /// Standard deviation of the encoder speeds while the tracks move, m/s.
    pub encoder_noise: f64,
    /// Standard deviation of x and of y of a pose, m.
    pub position_noise: f64,
    /// Standard deviation of the yaw of a pose, rad.
    pub yaw_noise: f64,
    /// Clock offset of the poses against the encoders, s ([`hold`](trackdyn_recording::hold)).
    pub tau: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Synthetic {
    /// One run of random steps on Auriga-alpha's printed centres, without noise.
    fn default() -> Self {
        Self {
            kinematics: ConstantIcr {
                x_left: -0.375,
                x_right: 0.457,
                y: 0.0492,
                alpha: PerSide::new(1.0, 1.0),
            },
            schedules: vec![random_steps(10, 6.0, 1.0, 1)],
            track_interval: 0.05,
            pose_interval: 0.1,
            encoder_noise: 0.0,
            position_noise: 0.0,
            yaw_noise: 0.0,
            tau: 0.0,
            seed: 0,
        }
    }
}

/// Steps to random track speeds between −`fastest` and `fastest` (m/s), each `duration` seconds.
pub fn random_steps(count: usize, duration: f64, fastest: f64, seed: u64) -> Vec<Stretch> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut speed = || fastest * (2.0 * random.random::<f64>() - 1.0);
    (0..count).map(|_| Stretch { duration, speeds: PerSide::new(speed(), speed()) }).collect()
}

impl Synthetic {
    /// Makes the recording. Every run has a random stream of its own: its samples do not depend on
    /// the runs before it.
    ///
    /// # Errors
    /// [`Error::Empty`](trackdyn_recording::Error::Empty) when the schedules are too short for two
    /// poses.
    pub fn recording(&self) -> Result<Recording, trackdyn_recording::Error> {
        let runs = self.schedules.iter().enumerate();
        let runs = runs.map(|(index, schedule)| self.run(index, schedule)).collect();
        let recording =
            Recording::new("synthetic", "synthetic", runs, Source::computed(), Vec::new())?;
        let stated = StatedNoise { position: self.position_noise, yaw: self.yaw_noise };
        let noisy = stated.position > 0.0 && stated.yaw > 0.0;
        Ok(recording.with_stated_noise(noisy.then_some(stated)))
    }

    fn run(&self, index: usize, schedule: &[Stretch]) -> UncheckedRun {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(index as u64);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let course = Course::new(&self.kinematics, schedule);
        let tracks: Vec<TrackSample> = stamps(self.track_interval, course.duration())
            .map(|t| {
                let speeds = course.speeds_at(t).map(|speed| {
                    if speed == 0.0 { 0.0 } else { speed + self.encoder_noise * normal() }
                });
                TrackSample { t, v_left: speeds.left, v_right: speeds.right }
            })
            .collect();
        let poses: Vec<PoseSample> = stamps(self.pose_interval, course.duration())
            .map(|t| {
                let truth = course.pose_at(t - self.tau);
                let pose = Pose::new(
                    truth.x + self.position_noise * normal(),
                    truth.y + self.position_noise * normal(),
                    truth.yaw + self.yaw_noise * normal(),
                );
                PoseSample { t, pose }
            })
            .collect();
        let id = i64::try_from(index).unwrap_or(i64::MAX);
        UncheckedRun { id, tracks: tracks.into(), poses: poses.into(), imu: Series::default() }
    }
}

/// Multiples of an interval up to a duration.
fn stamps(interval: f64, duration: f64) -> impl Iterator<Item = f64> {
    (0..).map(move |step| interval * real(step)).take_while(move |t| *t < duration + 1e-9)
}

/// The true motion; the robot stands before and after.
struct Course<'a> {
    kinematics: &'a ConstantIcr,
    schedule: &'a [Stretch],
    /// Start of each stretch and the pose there, and the end of the last.
    starts: Vec<(f64, Pose)>,
}

impl<'a> Course<'a> {
    fn new(kinematics: &'a ConstantIcr, schedule: &'a [Stretch]) -> Self {
        let mut starts = vec![(0.0, Pose::default())];
        let (mut t, mut pose) = starts[0];
        for stretch in schedule {
            t += stretch.duration;
            pose = pose.compose(&Pose::exp(&kinematics.twist(stretch.speeds), stretch.duration));
            starts.push((t, pose));
        }
        Self { kinematics, schedule, starts }
    }

    fn duration(&self) -> f64 {
        self.starts[self.starts.len() - 1].0
    }

    /// The stretch that a time lies in. A step belongs to the reading with its stamp, whatever
    /// rounding says.
    fn stretch_at(&self, t: f64) -> Option<usize> {
        let after = self.starts.partition_point(|(start, _)| *start <= t + 1e-9);
        after.checked_sub(1).filter(|index| *index < self.schedule.len())
    }

    fn speeds_at(&self, t: f64) -> PerSide<f64> {
        self.stretch_at(t).map_or(PerSide::default(), |index| self.schedule[index].speeds)
    }

    fn pose_at(&self, t: f64) -> Pose {
        let t = t.clamp(0.0, self.duration());
        let Some(index) = self.stretch_at(t) else { return self.starts[self.starts.len() - 1].1 };
        let (start, pose) = self.starts[index];
        let twist = self.kinematics.twist(self.schedule[index].speeds);
        pose.compose(&Pose::exp(&twist, t - start))
    }
}
