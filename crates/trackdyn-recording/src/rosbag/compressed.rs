//! Messages that are compressed one by one, as rosbag2 does with `compression_mode: MESSAGE`.
//!
//! A payload of CDR begins with a zero, a frame of zstd with another byte: what is compressed shows
//! without the metadata of the bag, which a file alone may lack.

use super::payload::is_zstd;
use super::stream::MAX_SIZE;
use super::topic::Topic;
use super::unpacked::max_unpacked;
use super::visitor::Visitor;
use crate::table::MAX_ROWS;
use std::io::Read;
use zstd::bulk::Decompressor;

/// Payload that counts as a further message, bytes: one message may hold the states of many joints.
const SHARE_SIZE: u64 = 4096;

/// Shows messages to a visitor, decompressed, and no more of them than memory holds.
pub(super) struct Decompressing<'a> {
    visitor: &'a mut dyn Visitor,
    shown: u64,
    decompressor: Option<Decompressor<'static>>,
    buffer: Vec<u8>,
}

impl<'a> Decompressing<'a> {
    pub(super) fn new(visitor: &'a mut dyn Visitor) -> Self {
        Self { visitor, shown: 0, decompressor: None, buffer: Vec::new() }
    }

    /// Whether messages were left out, since memory would not hold them.
    pub(super) fn is_full(&self) -> bool {
        self.shown > MAX_ROWS
    }

    /// Fills the buffer; false where the frame is damaged.
    fn decompress(&mut self, payload: &[u8]) -> bool {
        self.buffer.clear();
        let Some(size) = Decompressor::upper_bound(payload) else { return self.stream(payload) };
        if size as u64 > max_unpacked(payload.len() as u64).min(MAX_SIZE) {
            return false;
        }
        self.buffer.reserve(size);
        if self.decompressor.is_none() {
            self.decompressor = Decompressor::new().ok();
        }
        let Some(decompressor) = &mut self.decompressor else { return false };
        decompressor.decompress_to_buffer(payload, &mut self.buffer).is_ok()
    }

    /// A frame that does not announce its size.
    fn stream(&mut self, payload: &[u8]) -> bool {
        let Ok(decoder) = zstd::stream::read::Decoder::with_buffer(payload) else { return false };
        let most = max_unpacked(payload.len() as u64).min(MAX_SIZE);
        let size = decoder.take(most + 1).read_to_end(&mut self.buffer);
        size.is_ok_and(|size| size as u64 <= most)
    }
}

impl Visitor for Decompressing<'_> {
    fn defines(&mut self, kind: &str, text: &str) {
        self.visitor.defines(kind, text);
    }

    fn wants(&mut self, topic: &Topic) -> bool {
        self.visitor.wants(topic)
    }

    fn message(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) {
        self.shown += 1 + payload.len() as u64 / SHARE_SIZE;
        if self.is_full() {
            return;
        }
        if topic.encoding == "cdr" && is_zstd(payload) && self.decompress(payload) {
            self.visitor.message(topic, log_ns, &self.buffer);
        } else {
            // One that does not decompress is told as damaged when it is decoded.
            self.visitor.message(topic, log_ns, payload);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Kept(Vec<Vec<u8>>);

    impl Visitor for Kept {
        fn wants(&mut self, _: &Topic) -> bool {
            true
        }

        fn message(&mut self, _: &Topic, _: i64, payload: &[u8]) {
            self.0.push(payload.to_vec());
        }
    }

    #[test]
    fn frames_with_and_without_their_size_are_decompressed_and_damage_stays() {
        let topic =
            Topic { name: "/a".to_owned(), kind: "a/B".to_owned(), encoding: "cdr".to_owned() };
        let plain = [&[0, 1, 0, 0][..], &[7; 5000]].concat();
        let sized = zstd::bulk::compress(&plain, 3).expect("compressed");
        let unsized_frame = zstd::stream::encode_all(&plain[..], 3).expect("compressed");
        assert_eq!(Decompressor::upper_bound(&sized), Some(plain.len()));
        let mut damaged = sized.clone();
        damaged.truncate(sized.len() - 3);
        let mut kept = Kept(Vec::new());
        let mut decompressing = Decompressing::new(&mut kept);
        for payload in [&plain, &sized, &unsized_frame, &damaged] {
            decompressing.message(&topic, 0, payload);
        }
        assert_eq!(kept.0, [plain.clone(), plain.clone(), plain, damaged]);
    }
}
