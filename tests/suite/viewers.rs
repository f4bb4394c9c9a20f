//! Files for Foxglove, Rerun and PlotJuggler, read back by their definitions and by the project's
//! own reader.

mod bags;
mod diagnosis;
mod layouts;
mod values;

use mcap::MessageStream;
use std::collections::BTreeMap;
use trackdyn::crates::export::viewer::bag;
use trackdyn::viewer::Layers;
use trackdyn::{Gauge, Odometry, OdometrySettings, Parameters, Provenance, Recording, odometry};
use trackdyn_core::PerSide;
use trackdyn_core::document::Document;
use trackdyn_estimate::synthetic::{ConstantIcr, Synthetic, random_steps};
use trackdyn_tests::ros2msg::{Members, Value, read};

/// ICRs of the robot: left, right, in front, m.
const ICRS: [f64; 3] = [-0.4, 0.45, 0.05];

/// Two runs that each begin at 0, without noise.
fn synthetic() -> Synthetic {
    let [x_left, x_right, y] = ICRS;
    let alpha = PerSide::new(1.0, 1.0);
    Synthetic {
        kinematics: ConstantIcr { x_left, x_right, y, alpha },
        schedules: (0..2).map(|seed| random_steps(8, 3.0, 0.8, seed)).collect(),
        ..Synthetic::default()
    }
}

/// A replay with the ideal drive, and with the ICRs of the robot under a name.
fn replay(recording: &Recording, name: &str) -> Odometry {
    let [x_left, x_right, y] = ICRS;
    let text = format!(
        "schema = \"trackdyn.kinematics/1\"\nframe = \"paper\"\nx_icr_left_m = {x_left}\n\
         x_icr_right_m = {x_right}\ny_icr_m = {y}\nsteering_efficiency = 0.5\n\
         eccentricity = 0.0\n[source]\ncommand = \"\"\nversion = \"\"\nvehicle = \"\"\n\
         fingerprint = \"\"\n"
    );
    let document = Document::new(format!("{name}.toml"), text);
    let parameters = Parameters::from_document(document).expect("parameters");
    let gauge = Gauge::new(0.42).expect("a gauge");
    let settings = OdometrySettings { tau: Some(0.0), ..OdometrySettings::default() };
    odometry(recording, gauge, &[parameters], &settings).expect("it moves")
}

fn layers(recording: &Recording, name: &str) -> Layers {
    replay(recording, name).layers(&Provenance::default()).expect("layers")
}

/// The layers of the synthetic runs.
fn synthetic_layers() -> Layers {
    layers(&synthetic().recording().expect("runs").into(), "my-fit")
}

fn bytes(layers: &Layers) -> Vec<u8> {
    let mut file = std::io::Cursor::new(Vec::new());
    bag::write(layers, &mut file).expect("written");
    file.into_inner()
}

/// A message as it was read back.
struct Message {
    /// Time of its logging, ns.
    log: u64,
    kind: String,
    members: Members,
}

impl Message {
    fn number(&self, path: &str) -> f64 {
        match self.members.get(path) {
            Some(Value::Number(number)) => *number,
            other => panic!("{path}: {other:?} in {:?}", self.members),
        }
    }

    fn text(&self, path: &str) -> &str {
        match self.members.get(path) {
            Some(Value::Text(text)) => text,
            other => panic!("{path}: {other:?} in {:?}", self.members),
        }
    }
}

/// The messages of a file by their topics, each in the order of time; all in the order of time.
fn messages(file: &[u8]) -> BTreeMap<String, Vec<Message>> {
    let mut topics: BTreeMap<String, Vec<Message>> = BTreeMap::new();
    let mut last = 0;
    for message in MessageStream::new(file).expect("a bag") {
        let message = message.expect("a message");
        assert!(message.log_time >= last && message.publish_time == message.log_time);
        last = message.log_time;
        let schema = message.channel.schema.as_ref().expect("a schema");
        assert_eq!((&*schema.encoding, &*message.channel.message_encoding), ("ros2msg", "cdr"));
        let definition = std::str::from_utf8(&schema.data).expect("a text");
        let of_topic = topics.entry(message.channel.topic.clone()).or_default();
        assert_eq!(message.sequence as usize, of_topic.len(), "{}", message.channel.topic);
        of_topic.push(Message {
            log: message.log_time,
            kind: schema.name.clone(),
            members: read(definition, &message.data),
        });
    }
    topics
}
