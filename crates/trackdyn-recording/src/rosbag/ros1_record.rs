//! Records of ROS 1 bags, and the chunks that hold them.
//!
//! A record is: length of its head (4 bytes), head, length of its data (4), data. A head is a list
//! of fields: length (4), name, `=`, value.
//!
//! # Sources
//! ROS wiki, "Bags/Format/2.0".

use super::stream::MAX_SIZE;
use super::unpacked::max_unpacked;
use std::io::Read;

/// Operation codes of the records that are read.
pub(super) mod op {
    /// A message.
    pub(in super::super) const MESSAGE: u8 = 0x02;
    /// Times of the messages in the chunk before.
    pub(in super::super) const INDEX: u8 = 0x04;
    /// A chunk of records.
    pub(in super::super) const CHUNK: u8 = 0x05;
    /// What a chunk of a closed bag holds.
    pub(in super::super) const CHUNK_INFO: u8 = 0x06;
    /// Topic and type of a connection.
    pub(in super::super) const CONNECTION: u8 = 0x07;
}

/// The fields of a head.
#[derive(Clone, Copy)]
pub(super) struct Fields<'a>(pub(super) &'a [u8]);

impl<'a> Fields<'a> {
    pub(super) fn get(self, wanted: &str) -> Option<&'a [u8]> {
        let mut rest = self.0;
        loop {
            let (field, after) = split_sized(rest)?;
            let name = field.strip_prefix(wanted.as_bytes());
            if let Some(value) = name.and_then(|value| value.strip_prefix(b"=")) {
                return Some(value);
            }
            rest = after;
        }
    }

    pub(super) fn text(self, wanted: &str) -> Option<String> {
        Some(String::from_utf8_lossy(self.get(wanted)?).into_owned())
    }

    pub(super) fn u32(self, wanted: &str) -> Option<u32> {
        Some(u32::from_le_bytes(self.get(wanted)?.try_into().ok()?))
    }

    /// A time as nanoseconds of Unix time.
    pub(super) fn time(self, wanted: &str) -> Option<u64> {
        nanoseconds(self.get(wanted)?)
    }

    /// The operation code; none where the head is damaged.
    pub(super) fn op(self) -> Option<u8> {
        let [op] = self.get("op")? else { return None };
        Some(*op)
    }
}

/// A time: seconds (4 bytes), nanoseconds (4).
pub(super) fn nanoseconds(time: &[u8]) -> Option<u64> {
    let (seconds, rest) = time.split_first_chunk::<4>()?;
    let nanoseconds = rest.first_chunk::<4>()?;
    let [seconds, nanoseconds] = [*seconds, *nanoseconds].map(u32::from_le_bytes);
    Some(u64::from(seconds) * 1_000_000_000 + u64::from(nanoseconds))
}

/// Bytes after their length, and the rest.
pub(super) fn split_sized(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    rest.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)
}

/// Replaces a buffer by the records of a chunk. Where its data are cut or damaged, the buffer holds
/// what came before.
///
/// # Errors
/// What is wrong with the chunk.
pub(super) fn decompress(head: Fields, data: &[u8], buffer: &mut Vec<u8>) -> Result<(), String> {
    buffer.clear();
    let size = head.u32("size").ok_or("its head has no size")?;
    let most = max_unpacked(data.len() as u64).min(MAX_SIZE);
    if u64::from(size) > most {
        return Err(format!("it claims to hold {size} bytes in {}", data.len()));
    }
    let limit = u64::from(size) + 1;
    let decompressed = match head.get("compression") {
        Some(b"none") => data.take(limit).read_to_end(buffer),
        Some(b"bz2") => bzip2::read::BzDecoder::new(data).take(limit).read_to_end(buffer),
        Some(b"lz4") => lz4::Decoder::new(data).and_then(|lz4| lz4.take(limit).read_to_end(buffer)),
        other => {
            let name = String::from_utf8_lossy(other.unwrap_or_default());
            return Err(format!("its compression {name:?} is not known"));
        }
    };
    decompressed.map_err(|error| format!("it does not decompress: {error}"))?;
    if buffer.len() as u64 != u64::from(size) {
        return Err(format!("it holds {} bytes instead of {size}", buffer.len()));
    }
    Ok(())
}
