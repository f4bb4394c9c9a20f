//! Messages of ROS 1 and ROS 2, without the readers.

/// How numbers and texts stand in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ros {
    /// ROS 1: without alignment, texts without a closing zero.
    One,
    /// ROS 2: the Common Data Representation.
    Two,
}

/// A message that is built.
pub struct Encoder {
    ros: Ros,
    bytes: Vec<u8>,
}

impl Encoder {
    /// An empty message.
    pub fn new(ros: Ros) -> Self {
        let start: &[u8] = if ros == Ros::Two { &[0, 1, 0, 0] } else { &[] };
        Self { ros, bytes: start.to_vec() }
    }

    /// A message that begins with a header, `ns` nanoseconds after 1970.
    pub fn stamped(ros: Ros, ns: u64, frame: &str) -> Self {
        Self::new(ros).header(ns, frame)
    }

    /// The message.
    pub fn bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Appends a header.
    pub fn header(mut self, ns: u64, frame: &str) -> Self {
        if self.ros == Ros::One {
            self = self.count(0);
        }
        let [seconds, rest] = [ns / 1_000_000_000, ns % 1_000_000_000];
        self.count(seconds).count(rest).text(frame)
    }

    /// Appends the length of a list.
    pub fn count(mut self, count: u64) -> Self {
        self.align(4);
        self.bytes.extend(&count.to_le_bytes()[..4]);
        self
    }

    /// Appends a text.
    pub fn text(mut self, text: &str) -> Self {
        let end: &[u8] = if self.ros == Ros::Two { &[0] } else { &[] };
        self = self.count((text.len() + end.len()) as u64);
        self.bytes.extend(text.as_bytes());
        self.bytes.extend(end);
        self
    }

    /// Appends bytes.
    pub fn raw(mut self, bytes: &[u8]) -> Self {
        self.bytes.extend(bytes);
        self
    }

    /// Appends real numbers.
    pub fn numbers(mut self, values: &[f64]) -> Self {
        for value in values {
            self.align(8);
            self.bytes.extend(value.to_le_bytes());
        }
        self
    }

    /// Appends a list of real numbers.
    pub fn list(self, values: &[f64]) -> Self {
        self.count(values.len() as u64).numbers(values)
    }

    /// Appends position and orientation.
    pub fn pose(self, [x, y, yaw]: [f64; 3]) -> Self {
        let (sin, cos) = (0.5 * yaw).sin_cos();
        self.numbers(&[x, y, 0.1, 0.0, 0.0, sin, cos])
    }

    fn align(&mut self, size: usize) {
        while self.ros == Ros::Two && !(self.bytes.len() - 4).is_multiple_of(size) {
            self.bytes.push(0);
        }
    }
}
