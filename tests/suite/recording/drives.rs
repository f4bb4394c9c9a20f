//! Drives with known truth, in bags as robots write them.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::PathBuf;
use tempfile::TempDir;
use trackdyn_core::{PerSide, Pose, Twist};
use trackdyn_tests::cdr::Message;

/// Radius of the wheels, m.
pub const RADIUS: f64 = 0.165;

/// Distance of the tracks, m.
pub const SEPARATION: f64 = 1.02;

/// Length of a drive, s.
pub const LENGTH: f64 = 60.0;

/// Length of a drive in whole seconds.
const SECONDS: u32 = 60;

/// Unix time of the beginning, ns.
pub const EPOCH: i64 = 1_700_000_000_000_000_000;

/// Speeds of the wheels, rad/s.
pub fn speeds(t: f64) -> PerSide<f64> {
    PerSide::new(1.5 + 3.0 * (0.7 * t).sin(), 2.0 + 2.5 * (0.4 * t).cos())
}

/// Positions of the wheels, rad: integrals of the speeds.
pub fn angles(t: f64) -> PerSide<f64> {
    PerSide::new(
        1.5 * t + 3.0 / 0.7 * (1.0 - (0.7 * t).cos()),
        2.0 * t + 2.5 / 0.4 * (0.4 * t).sin(),
    )
}

/// Poses of a robot whose tracks are [`SEPARATION`] apart, every 50 ms.
pub fn poses() -> Vec<(f64, Pose)> {
    let mut pose = Pose::default();
    let step = 0.005;
    (0..=200 * SECONDS)
        .map(|k| {
            let t = f64::from(k) * step;
            let found = (t, pose);
            let PerSide { left, right } = speeds(t + 0.5 * step).map(|speed| RADIUS * speed);
            let twist =
                Twist { v_x: 0.5 * (left + right), v_y: 0.0, w: (right - left) / SEPARATION };
            pose = pose.compose(&Pose::exp(&twist, step));
            found
        })
        .step_by(10)
        .collect()
}

/// Times of readings, `rate` a second.
pub fn times(rate: u32) -> impl Iterator<Item = f64> {
    (0..SECONDS * rate).map(move |k| f64::from(k) / f64::from(rate))
}

/// Nanoseconds after the beginning.
#[expect(clippy::cast_possible_truncation, reason = "drives last less than 2⁵³ ns, 104 days")]
pub fn ns(t: f64) -> i64 {
    (t * 1e9).round() as i64
}

/// Quaternion of a yaw, rad.
pub fn quaternion(yaw: f64) -> [f64; 4] {
    [0.0, 0.0, (0.5 * yaw).sin(), (0.5 * yaw).cos()]
}

/// Messages of a bag, written in the order of their logging.
#[derive(Default)]
pub struct Bag {
    messages: Vec<(i64, &'static str, &'static str, Vec<u8>)>,
}

/// When a message is logged and stamped, Unix time in nanoseconds.
pub type Times = (i64, i64);

/// Both times of a message that is logged when it is stamped, `t` s after the beginning.
pub fn at(t: f64) -> Times {
    (EPOCH + ns(t), EPOCH + ns(t))
}

impl Bag {
    /// A `sensor_msgs/JointState`.
    pub fn joints(
        &mut self,
        topic: &'static str,
        (log, stamp): Times,
        names: &[&str],
        [positions, velocities]: [&[f64]; 2],
    ) {
        let mut cdr = Message::new(stamp, "");
        cdr.count(names.len());
        for name in names {
            cdr.text(name);
        }
        for values in [positions, velocities, &[]] {
            cdr.count(values.len());
            cdr.numbers(values);
        }
        self.messages.push((log, topic, "sensor_msgs/msg/JointState", cdr.0));
    }

    /// A `geometry_msgs/PoseStamped` with a quaternion (x, y, z, w).
    pub fn pose(&mut self, (log, stamp): Times, [x, y]: [f64; 2], quaternion: [f64; 4]) {
        let mut cdr = Message::new(stamp, "map");
        cdr.numbers(&[x, y, 0.0]);
        cdr.numbers(&quaternion);
        self.messages.push((log, "/slam/pose", "geometry_msgs/msg/PoseStamped", cdr.0));
    }

    /// A `geometry_msgs/TransformStamped` from one frame to another.
    pub fn transform(
        &mut self,
        (log, stamp): Times,
        [parent, child]: [&str; 2],
        [x, y]: [f64; 2],
        quaternion: [f64; 4],
    ) {
        let mut cdr = Message::new(stamp, parent);
        cdr.text(child);
        cdr.numbers(&[x, y, 0.0]);
        cdr.numbers(&quaternion);
        self.messages.push((log, "/slam/frame", "geometry_msgs/msg/TransformStamped", cdr.0));
    }

    /// A message of any other type.
    pub fn message(&mut self, log: i64, topic: &'static str, kind: &'static str, cdr: Message) {
        self.messages.push((log, topic, kind, cdr.0));
    }

    /// The poses of the drive.
    pub fn with_poses(mut self) -> Self {
        for (t, pose) in poses() {
            self.pose(at(t), [pose.x, pose.y], quaternion(pose.yaw));
        }
        self
    }

    /// The velocities of one wheel on each side, 50 a second.
    pub fn with_wheels(mut self) -> Self {
        for t in times(50) {
            let PerSide { left, right } = speeds(t);
            self.joints(
                "/joint_states",
                at(t),
                &["left_wheel", "right_wheel"],
                [&[], &[left, right]],
            );
        }
        self
    }

    /// Writes it; it is there as long as the folder is kept.
    pub fn write(mut self) -> (TempDir, PathBuf) {
        self.messages.sort_by_key(|(log, ..)| *log);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("drive.mcap");
        let file = BufWriter::new(File::create(&path).expect("a file"));
        let mut writer = mcap::Writer::new(file).expect("a bag");
        let mut channels: BTreeMap<&str, u16> = BTreeMap::new();
        for (sequence, (log, topic, kind, data)) in (0..).zip(self.messages) {
            let id = *channels.entry(topic).or_insert_with(|| {
                let schema = writer.add_schema(kind, "ros2msg", b"").expect("a schema");
                writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).expect("a channel")
            });
            let time = log.cast_unsigned();
            let header = mcap::records::MessageHeader {
                channel_id: id,
                sequence,
                log_time: time,
                publish_time: time,
            };
            writer.write_to_known_channel(&header, &data).expect("written");
        }
        writer.finish().expect("finished");
        (folder, path)
    }
}
