//! Bags for measurements, written without the readers.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Writes a bag as robots make them: 2000 s of joints at 50 Hz and odometry at 20 Hz; at 5 Hz a
/// lidar whose clouds have so many bytes, or none.
pub fn write(
    path: &Path,
    compression: Option<mcap::Compression>,
    cloud: usize,
) -> Result<(), Box<dyn Error>> {
    let options = mcap::WriteOptions::new().compression(compression).chunk_size(Some(786_432));
    let mut writer = options.create(BufWriter::new(File::create(path)?))?;
    let channel = |topic: &str, kind: &str, writer: &mut mcap::Writer<_>| {
        let schema = writer.add_schema(kind, "ros2msg", b"")?;
        writer.add_channel(schema, topic, "cdr", &BTreeMap::new())
    };
    let joints = channel("/joint_states", "sensor_msgs/msg/JointState", &mut writer)?;
    let odometry = channel("/odom", "nav_msgs/msg/Odometry", &mut writer)?;
    let lidar = channel("/points", "sensor_msgs/msg/PointCloud2", &mut writer)?;
    let mut noise = 1_u32;
    let cloud: Vec<u8> = std::iter::repeat_with(|| {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        noise.to_le_bytes()[3]
    })
    .take(cloud)
    .collect();
    for tick in 0..200_000_u32 {
        let nanoseconds = u64::from(tick) * 10_000_000;
        let mut put = |channel_id, data: &[u8]| {
            let (log_time, publish_time) = (nanoseconds, nanoseconds);
            let header =
                mcap::records::MessageHeader { channel_id, sequence: tick, log_time, publish_time };
            writer.write_to_known_channel(&header, data)
        };
        let t = f64::from(tick) * 0.01;
        if tick % 2 == 0 {
            put(joints, &joint_state(tick, [t.sin(), t.cos()]))?;
        }
        if tick % 5 == 0 {
            put(odometry, &odometry_message(tick, [t, t.sin(), 0.1 * t]))?;
        }
        if !cloud.is_empty() && tick % 20 == 0 {
            put(lidar, &cloud)?;
        }
    }
    writer.finish()?;
    Ok(())
}

/// Little-endian CDR.
struct Message(Vec<u8>);

impl Message {
    fn new(tick: u32, frame: &str) -> Self {
        let mut message = Self(vec![0, 1, 0, 0]);
        message.u32(1 + tick / 100);
        message.u32(tick % 100 * 10_000_000);
        message.text(frame);
        message
    }

    fn align(&mut self, size: usize) {
        while !(self.0.len() - 4).is_multiple_of(size) {
            self.0.push(0);
        }
    }

    fn u32(&mut self, value: u32) {
        self.align(4);
        self.0.extend(value.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.u32(u32::try_from(text.len() + 1).unwrap_or(u32::MAX));
        self.0.extend(text.as_bytes());
        self.0.push(0);
    }

    fn numbers(&mut self, values: &[f64]) {
        for value in values {
            self.align(8);
            self.0.extend(value.to_le_bytes());
        }
    }
}

fn joint_state(tick: u32, speeds: [f64; 2]) -> Vec<u8> {
    let mut message = Message::new(tick, "");
    message.u32(2);
    message.text("left_sprocket");
    message.text("right_sprocket");
    message.u32(0);
    message.u32(2);
    message.numbers(&speeds);
    message.u32(0);
    message.0
}

fn odometry_message(tick: u32, [x, y, yaw]: [f64; 3]) -> Vec<u8> {
    let mut message = Message::new(tick, "odom");
    message.text("base_link");
    message.numbers(&[x, y, 0.0, 0.0, 0.0, (yaw / 2.0).sin(), (yaw / 2.0).cos()]);
    message.numbers(&[0.0; 36 + 6 + 36]);
    message.0
}
