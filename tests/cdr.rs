//! Messages of ROS 2 for bags that tests and measurements write, without the readers.

/// A message in the Common Data Representation, little-endian.
pub struct Message(pub Vec<u8>);

impl Message {
    /// A message that begins with a header: stamp, Unix time in nanoseconds, and frame.
    ///
    /// # Panics
    /// For stamps that a header cannot hold.
    pub fn new(stamp: i64, frame: &str) -> Self {
        let mut message = Self::bare();
        message.header(stamp, frame);
        message
    }

    /// A message without a header.
    pub fn bare() -> Self {
        Self(vec![0, 1, 0, 0])
    }

    /// Appends a header: stamp, Unix time in nanoseconds, and frame.
    ///
    /// # Panics
    /// For stamps that a header cannot hold.
    pub fn header(&mut self, stamp: i64, frame: &str) {
        let [seconds, nanoseconds] = [stamp / 1_000_000_000, stamp % 1_000_000_000];
        self.bytes(4, &i32::try_from(seconds).expect("seconds").to_le_bytes());
        self.bytes(4, &u32::try_from(nanoseconds).expect("a fraction").to_le_bytes());
        self.text(frame);
    }

    /// Appends bytes at a multiple of `size`.
    pub fn bytes(&mut self, size: usize, bytes: &[u8]) {
        self.align(size);
        self.0.extend(bytes);
    }

    fn align(&mut self, size: usize) {
        while !(self.0.len() - 4).is_multiple_of(size) {
            self.0.push(0);
        }
    }

    /// Appends the length of a list.
    ///
    /// # Panics
    /// For more than 2³² members.
    pub fn count(&mut self, count: usize) {
        self.align(4);
        self.0.extend(u32::try_from(count).expect("few").to_le_bytes());
    }

    /// Appends a text.
    pub fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.0.extend(text.as_bytes());
        self.0.push(0);
    }

    /// Appends real numbers.
    pub fn numbers(&mut self, values: &[f64]) {
        for value in values {
            self.align(8);
            self.0.extend(value.to_le_bytes());
        }
    }
}
