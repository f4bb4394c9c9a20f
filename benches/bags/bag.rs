//! Bags for measurements, written without the readers.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use trackdyn_tests::cdr::Message;

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

/// The header of the message of a tick, a hundredth of a second after the other.
fn message(tick: u32, frame: &str) -> Message {
    Message::new(1_000_000_000 + i64::from(tick) * 10_000_000, frame)
}

fn joint_state(tick: u32, speeds: [f64; 2]) -> Vec<u8> {
    let mut cdr = message(tick, "");
    cdr.count(2);
    cdr.text("left_sprocket");
    cdr.text("right_sprocket");
    cdr.count(0);
    cdr.count(2);
    cdr.numbers(&speeds);
    cdr.count(0);
    cdr.0
}

fn odometry_message(tick: u32, [x, y, yaw]: [f64; 3]) -> Vec<u8> {
    let mut cdr = message(tick, "odom");
    cdr.text("base_link");
    cdr.numbers(&[x, y, 0.0, 0.0, 0.0, (yaw / 2.0).sin(), (yaw / 2.0).cos()]);
    cdr.numbers(&[0.0; 36 + 6 + 36]);
    cdr.0
}
