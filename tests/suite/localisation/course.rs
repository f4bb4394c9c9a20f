//! Paths through the furnished room.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{Pose, Twist};
use trackdyn_localisation::{Reference, Room, Scan, Scanner};

/// Random number in a range.
pub(super) fn between(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.random::<f64>()
}

pub(super) fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A pose on the free ground of the furnished room.
pub(super) fn free_pose(random: &mut ChaCha8Rng) -> Pose {
    let pi = std::f64::consts::PI;
    Pose::new(between(random, 2.3, 7.7), between(random, 2.0, 6.2), between(random, -pi, pi))
}

/// A motion between two scans: up to 1 m/s ahead or back, 0.1 m/s aside, 2 rad/s.
pub(super) fn motion(random: &mut ChaCha8Rng, period: f64) -> Pose {
    let v_x = between(random, -1.0, 1.0);
    let v_y = between(random, -0.1, 0.1);
    Pose::exp(&Twist { v_x, v_y, w: between(random, -2.0, 2.0) }, period)
}

/// The lines that a scan at the first pose shows, if its ranges have this noise (m), and a scan at
/// the second pose; each trial has noise of its own.
pub(super) fn reference_and_scan(
    room: &Room,
    scanner: &Scanner,
    trial: u64,
    [before, after]: [Pose; 2],
    noise: f64,
) -> (Reference, Scan) {
    let scan = |index, pose: Pose| scanner.scan(room, 0.0, index, |_| pose).expect("a scan");
    let reference = Reference::new(&scan(2 * trial, before), noise).expect("lines");
    (reference, scan(2 * trial + 1, after))
}

/// A path of true poses, one for each scan, on the free ground: arcs that turn away from the walls.
pub(super) fn path(seed: u64, length: f64, period: f64) -> Vec<Pose> {
    let mut random = random(seed);
    let mut pose = Pose::new(5.0, 4.0, between(&mut random, -3.0, 3.0));
    let mut poses = vec![pose];
    let (mut driven, mut left) = (0.0, 0);
    let (mut speed, mut rate) = (0.0, 0.0);
    while driven < length {
        if left == 0 {
            left = random.random_range(4..=12);
            speed = between(&mut random, 0.3, 1.0);
            rate = between(&mut random, -1.0, 1.0);
        }
        left -= 1;
        // A second and a half ahead, the robot must still be on free ground; else it turns to the
        // middle.
        let ahead = pose.compose(&Pose::exp(&Twist { v_x: speed, v_y: 0.0, w: rate }, 1.5));
        if !((2.3..7.7).contains(&ahead.x) && (2.0..6.2).contains(&ahead.y)) {
            let to_middle = (4.0 - pose.y).atan2(5.0 - pose.x);
            let off = trackdyn_core::pose::wrap_angle(to_middle - pose.yaw);
            (speed, rate) = (0.4, 1.2_f64.copysign(off));
        }
        let step = Pose::exp(&Twist { v_x: speed, v_y: 0.0, w: rate }, period);
        driven += speed * period;
        pose = pose.compose(&step);
        poses.push(pose);
    }
    poses
}

/// Scans along true poses.
pub(super) fn scans(room: &Room, scanner: &Scanner, poses: &[Pose]) -> Vec<Scan> {
    let stamped = poses.iter().zip(0_u32..);
    stamped
        .map(|(pose, index)| {
            let stamp = f64::from(index) * scanner.period;
            scanner.scan(room, stamp, u64::from(index), |_| *pose).expect("a scan")
        })
        .collect()
}

/// Odometry along true poses: each motion off by up to a tenth, and yaw by up to 0.1 rad.
pub(super) fn odometry(poses: &[Pose], seed: u64) -> Vec<Pose> {
    let mut random = random(seed);
    let mut pose = poses[0];
    let mut odometry = vec![pose];
    for pair in poses.windows(2) {
        let step = pair[0].relative(&pair[1]);
        let mut off = || between(&mut random, -0.1, 0.1);
        let guess = Pose::new(step.x + off(), step.y + off(), step.yaw + off());
        pose = pose.compose(&guess);
        odometry.push(pose);
    }
    odometry
}
