//! Chunks of `.mcap` files: checked as a whole before any of their records is used.

use super::stream::{Dropped, MAX_SIZE};
use super::unpacked::max_unpacked;
use std::io::Read;
use zstd::bulk::Decompressor;

/// Decompresses chunks, and counts those that are damaged.
#[derive(Default)]
pub(super) struct Chunks {
    buffer: Vec<u8>,
    decompressor: Option<Decompressor<'static>>,
    pub(super) dropped: Dropped,
}

/// A chunk that the file holds as a whole.
pub(super) enum Decompressed<'a> {
    /// Its records.
    Records(&'a [u8]),
    /// It is damaged: none of it is used.
    Dropped {
        /// Whether it is the first of its file.
        is_first: bool,
    },
}

/// A chunk as it stands in the file.
struct Chunk<'a> {
    /// Times of the first and the last message, ns.
    first_ns: u64,
    last_ns: u64,
    size: u64,
    /// CRC-32 of its records; zero where the writer took none.
    crc: u32,
    compression: &'a [u8],
    /// Bytes that its records should take in the file.
    packed_size: u64,
    /// What there is of them.
    packed: &'a [u8],
}

impl<'a> Chunk<'a> {
    /// Layout: times of the first and last message (8 bytes each), size of the records (8), their
    /// CRC (4), compression (length of 4, text), compressed size (8), compressed records.
    fn of(data: &'a [u8]) -> Option<Self> {
        let (head, rest) = data.split_first_chunk::<32>()?;
        let number = |at: usize| {
            let mut bytes = [0; 8];
            bytes.copy_from_slice(&head[at..at + 8]);
            u64::from_le_bytes(bytes)
        };
        let last = number(24);
        let (crc, length) = (last & u64::from(u32::MAX), last >> 32);
        let (compression, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
        let (packed_size, packed) = rest.split_first_chunk::<8>()?;
        let packed_size = u64::from_le_bytes(*packed_size);
        let end = usize::try_from(packed_size).unwrap_or(usize::MAX).min(packed.len());
        Some(Self {
            first_ns: number(0),
            last_ns: number(8),
            size: number(16),
            crc: u32::try_from(crc).ok()?,
            compression,
            packed_size,
            packed: &packed[..end],
        })
    }
}

impl Chunks {
    /// The records of a chunk that the file holds as a whole.
    pub(super) fn whole<'a>(&'a mut self, data: &'a [u8]) -> Decompressed<'a> {
        let problem = match Chunk::of(data) {
            None => "its head is damaged".to_owned(),
            Some(chunk) => match self.decompress(&chunk) {
                Ok(()) if chunk.compression.is_empty() => {
                    return Decompressed::Records(chunk.packed);
                }
                Ok(()) => return Decompressed::Records(&self.buffer),
                Err(problem) => {
                    self.dropped.add_time(chunk.first_ns, chunk.last_ns);
                    problem
                }
            },
        };
        let is_first = self.dropped.chunks == 0;
        self.dropped.note(problem);
        Decompressed::Dropped { is_first }
    }

    /// The readable part of a chunk within which its file ends.
    pub(super) fn cut<'a>(&'a mut self, data: &'a [u8]) -> Option<&'a [u8]> {
        let chunk = Chunk::of(data)?;
        self.buffer.clear();
        let most = max_unpacked(chunk.packed.len() as u64).min(MAX_SIZE);
        // Decompression ends with an error where the file does: what came before counts.
        match chunk.compression {
            b"" => return Some(chunk.packed),
            b"zstd" => {
                let decoder = zstd::stream::read::Decoder::with_buffer(chunk.packed).ok()?;
                let _ = decoder.take(most).read_to_end(&mut self.buffer);
            }
            b"lz4" => {
                let decoder = lz4::Decoder::new(chunk.packed).ok()?;
                let _ = decoder.take(most).read_to_end(&mut self.buffer);
            }
            _ => return None,
        }
        Some(&self.buffer)
    }

    /// Checks a chunk; its records stand in the buffer, where they are compressed.
    fn decompress(&mut self, chunk: &Chunk) -> Result<(), String> {
        let most = max_unpacked(chunk.packed.len() as u64).min(MAX_SIZE);
        if chunk.size > most {
            let packed = chunk.packed.len();
            return Err(format!("it claims to hold {} bytes in {packed}", chunk.size));
        }
        if chunk.packed.len() as u64 != chunk.packed_size {
            return Err("its compressed size is wrong".to_owned());
        }
        let size = usize::try_from(chunk.size).map_err(|error| error.to_string())?;
        self.buffer.clear();
        let records = match chunk.compression {
            b"" => chunk.packed,
            b"zstd" => {
                self.buffer.reserve(size);
                let decompressor = match &mut self.decompressor {
                    Some(decompressor) => decompressor,
                    none => none.insert(Decompressor::new().map_err(|error| error.to_string())?),
                };
                let decompressed =
                    decompressor.decompress_to_buffer(chunk.packed, &mut self.buffer);
                decompressed.map_err(|error| format!("it does not decompress: {error}"))?;
                &self.buffer
            }
            b"lz4" => {
                self.buffer.reserve(size);
                let decompressed = lz4::Decoder::new(chunk.packed)
                    .and_then(|lz4| lz4.take(chunk.size + 1).read_to_end(&mut self.buffer));
                decompressed.map_err(|error| format!("it does not decompress: {error}"))?;
                &self.buffer
            }
            other => {
                let name = String::from_utf8_lossy(other);
                return Err(format!("its compression {name:?} is not known"));
            }
        };
        if records.len() != size {
            return Err(format!("it holds {} bytes instead of {size}", records.len()));
        }
        if chunk.crc != 0 {
            let found = crc32fast::hash(records);
            if found != chunk.crc {
                return Err(format!("its CRC is {found:#010x} instead of {:#010x}", chunk.crc));
            }
        }
        Ok(())
    }
}
