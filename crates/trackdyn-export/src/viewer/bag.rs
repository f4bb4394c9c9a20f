//! Layers as one `.mcap` file of messages of ROS 2.
//!
//! Messages stand in the order of time in compressed chunks, so that neither writing nor reading
//! holds more than a chunk in memory. Nothing in the file tells when it was written.

use super::message::{
    self, Float64, Header, JointState, Marker, MarkerArray, Message, PoseStamped, Text,
    TransformStamped, Transforms,
};
use super::schema;
use super::stream::{Stream, merge};
use super::{JointLayer, Layers, MarkerLayer, PathLayer};
use crate::Error;
use mcap::records::{MessageHeader, Metadata};
use mcap::{McapError, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::io::{self, Seek, Write};
use trackdyn_core::real;

/// Most poses of a `nav_msgs/Path`: viewers redraw all of it at once.
pub const MAX_PATH_POSES: usize = 2000;

/// Topic of the transforms.
pub(super) const TF: &str = "/tf";

/// Writes the layers.
///
/// # Errors
/// [`Error::NoPoses`] and [`Error::LateStamp`] as the cause of what is returned; those of writing.
pub fn write(layers: &Layers, to: impl Write + Seek) -> io::Result<()> {
    let refused = |error: Error| io::Error::new(io::ErrorKind::InvalidInput, error);
    layers.check().map_err(refused)?;
    // One thread more or less would not change what is read, but the bytes.
    let options = WriteOptions::new().profile("ros2").library("trackdyn").compression_threads(0);
    let mut writer = options.create(to).map_err(io_error)?;
    let notes = Metadata { name: "trackdyn".to_owned(), metadata: layers.notes.clone() };
    writer.write_metadata(&notes).map_err(io_error)?;
    let streams = streams(layers, &mut writer)?;
    let mut sequences: BTreeMap<u16, u32> = BTreeMap::new();
    merge(streams, |channel_id, stamp, bytes| {
        let sequence = sequences.entry(channel_id).or_default();
        let header =
            MessageHeader { channel_id, sequence: *sequence, log_time: stamp, publish_time: stamp };
        *sequence = sequence.wrapping_add(1);
        writer.write_to_known_channel(&header, bytes).map_err(io_error)
    })?;
    writer.finish().map(drop).map_err(io_error)
}

fn io_error(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        other => io::Error::other(other),
    }
}

/// The messages of all layers.
fn streams<'a, W: Write + Seek>(
    layers: &'a Layers,
    writer: &mut Writer<W>,
) -> io::Result<Vec<Stream<'a>>> {
    let fixed = layers.fixed_frame.as_str();
    let mut streams = Vec::new();
    for path in &layers.paths {
        let poses = channel::<PoseStamped>(writer, &format!("{}/pose", path.topic))?;
        let paths = channel::<message::Path>(writer, &format!("{}/path", path.topic))?;
        let transforms = channel::<Transforms>(writer, TF)?;
        let starts: Vec<u64> = path.starts.iter().map(|start| path.stamps[*start]).collect();
        streams.push(Stream::new(paths, starts, |_, run| {
            message::bytes(&whole_run(path, fixed, run))
        }));
        streams.push(Stream::new(transforms, path.stamps.as_slice(), |stamp, index| {
            let transform = TransformStamped {
                header: Header::new(stamp, fixed),
                child_frame_id: &path.frame,
                transform: (&path.poses[index]).into(),
            };
            message::bytes(&Transforms { transforms: vec![transform] })
        }));
        streams.push(Stream::new(poses, path.stamps.as_slice(), |_, index| {
            message::bytes(&pose(path, fixed, index))
        }));
    }
    for layer in &layers.markers {
        let channel = channel::<MarkerArray>(writer, &layer.topic)?;
        streams.push(Stream::new(channel, layer.stamps.as_slice(), |stamp, index| {
            message::bytes(&markers(layer, stamp, index))
        }));
    }
    for layer in &layers.joints {
        let channel = channel::<JointState>(writer, &layer.topic)?;
        streams.push(Stream::new(channel, layer.stamps.as_slice(), |stamp, index| {
            message::bytes(&joints(layer, stamp, index))
        }));
    }
    for layer in &layers.texts {
        let channel = channel::<Text>(writer, &layer.topic)?;
        streams.push(Stream::new(channel, layer.stamps.as_slice(), |_, index| {
            message::bytes(&Text { data: &layer.texts[index] })
        }));
    }
    for curve in layers.curves() {
        let channel = channel::<Float64>(writer, &curve.topic)?;
        streams.push(Stream::new(channel, curve.trace.stamps.as_slice(), |_, index| {
            message::bytes(&Float64 { data: curve.trace.values[index] })
        }));
    }
    Ok(streams)
}

/// The channel of a topic, made where it is missing.
fn channel<M: Message>(writer: &mut Writer<impl Write + Seek>, topic: &str) -> io::Result<u16> {
    let text = schema::text(M::KIND);
    let schema = writer.add_schema(M::KIND, "ros2msg", text.as_bytes()).map_err(io_error)?;
    writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).map_err(io_error)
}

fn pose<'a>(path: &PathLayer, fixed: &'a str, index: usize) -> PoseStamped<'a> {
    PoseStamped {
        header: Header::new(path.stamps[index], fixed),
        pose: (&path.poses[index]).into(),
    }
}

/// The path of a run, thinned to [`MAX_PATH_POSES`].
fn whole_run<'a>(path: &PathLayer, fixed: &'a str, run: usize) -> message::Path<'a> {
    let first = path.starts[run];
    let until = path.starts.get(run + 1).copied().unwrap_or(path.poses.len());
    let kept = thinned(until - first, MAX_PATH_POSES);
    message::Path {
        header: Header::new(path.stamps[first], fixed),
        poses: kept.map(|index| pose(path, fixed, first + index)).collect(),
    }
}

/// Indices of at most `most` of so many, at equal distances, the first and the last among them.
fn thinned(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let kept = count.min(most);
    let step = if kept > 1 { real(count - 1) / real(kept - 1) } else { 0.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    (0..kept).map(move |place| (real(place) * step).round() as usize)
}

fn markers(layer: &MarkerLayer, stamp: u64, index: usize) -> MarkerArray<'_> {
    let places = layer.points.iter().zip(&layer.places[index]);
    let markers = places.map(|(name, place)| {
        let header = Header::new(stamp, &layer.frame);
        Marker::sphere(header, name, *place, layer.diameter, layer.colour)
    });
    MarkerArray { markers: markers.collect() }
}

fn joints(layer: &JointLayer, stamp: u64, index: usize) -> JointState<'_> {
    let speeds = layer.speeds[index];
    JointState {
        header: Header::new(stamp, ""),
        name: vec![&layer.names.left, &layer.names.right],
        position: Vec::new(),
        velocity: vec![speeds.left, speeds.right],
        effort: Vec::new(),
    }
}
