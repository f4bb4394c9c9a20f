//! Reading the payload of a message: Common Data Representation (ROS 2) or ROS 1 serialization.
//!
//! ROS 1 writes numbers of the low byte first and without alignment, and texts without a closing
//! zero. Its header begins with a sequence number.
//!
//! # Sources
//! OMG DDSI-RTPS 2.5, section 10 (encapsulation header); OMG DDS-XTypes 1.3, section 7.4
//! (alignment: XCDR1 aligns to the size of the primitive, XCDR2 to at most 4); ROS wiki, `msg`,
//! "Fields" (ROS 1).

/// First bytes of a frame (RFC 8878, section 3.1.1).
const ZSTD_MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

/// Whether bytes begin as a frame of zstd does.
pub(super) fn is_zstd(bytes: &[u8]) -> bool {
    bytes.starts_with(&ZSTD_MAGIC)
}

/// How a message is encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Common Data Representation, that of ROS 2.
    Cdr,
    /// ROS 1 serialization.
    Ros1,
}

impl Encoding {
    /// The encoding by its name in a bag; none where it cannot be read.
    pub(super) fn of(name: &str) -> Option<Self> {
        match name {
            "cdr" => Some(Self::Cdr),
            "ros1" => Some(Self::Ros1),
            _ => None,
        }
    }
}

/// Numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Number {
    /// Its size in bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

/// Why a payload cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum PayloadError {
    /// It ends too early.
    Short {
        /// Bytes that were needed.
        needed: usize,
        /// Bytes that there are.
        length: usize,
    },
    /// An encapsulation that is not plain CDR.
    Encapsulation(u8),
    /// A message that is compressed and does not decompress.
    Compressed,
    /// A text that is not UTF-8.
    Text,
}

impl std::fmt::Display for PayloadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Short { needed, length } => write!(f, "it needs {needed} bytes and has {length}"),
            Self::Encapsulation(id) => write!(f, "its encapsulation is {id:#04x}, not plain CDR"),
            Self::Compressed => write!(f, "it is compressed (zstd) and damaged"),
            Self::Text => write!(f, "a text in it is not UTF-8"),
        }
    }
}

/// A place in a payload.
#[derive(Clone, Debug)]
pub(super) struct Payload<'a> {
    body: &'a [u8],
    at: usize,
    encoding: Encoding,
    little: bool,
    widest: usize,
}

impl<'a> Payload<'a> {
    /// The start of a payload in an encoding.
    pub(super) fn of(encoding: Encoding, payload: &'a [u8]) -> Result<Self, PayloadError> {
        match encoding {
            Encoding::Cdr => Self::new(payload),
            Encoding::Ros1 => Ok(Self { body: payload, at: 0, encoding, little: true, widest: 1 }),
        }
    }

    /// The start of a payload of CDR with its encapsulation header of 4 bytes.
    pub(super) fn new(payload: &'a [u8]) -> Result<Self, PayloadError> {
        let Some((header, body)) = payload.split_at_checked(4) else {
            return Err(PayloadError::Short { needed: 4, length: payload.len() });
        };
        if is_zstd(payload) {
            return Err(PayloadError::Compressed);
        }
        let (little, widest) = match header[1] {
            0x00 => (false, 8),
            0x01 => (true, 8),
            0x06 => (false, 4),
            0x07 => (true, 4),
            other => return Err(PayloadError::Encapsulation(other)),
        };
        Ok(Self { body, at: 0, encoding: Encoding::Cdr, little, widest })
    }

    /// How the payload is encoded.
    pub(super) fn encoding(&self) -> Encoding {
        self.encoding
    }

    fn bytes(&mut self, count: usize) -> Result<&'a [u8], PayloadError> {
        let end = self.at.saturating_add(count);
        let Some(bytes) = self.body.get(self.at..end) else {
            return Err(PayloadError::Short { needed: end, length: self.body.len() });
        };
        self.at = end;
        Ok(bytes)
    }

    fn align(&mut self, size: usize) {
        self.at = self.at.next_multiple_of(size.min(self.widest));
    }

    /// An unsigned integer of 4 bytes.
    pub(super) fn u32(&mut self) -> Result<u32, PayloadError> {
        Ok(u32::from_le_bytes(self.low_first()?))
    }

    /// The bytes of a number, the low one first.
    fn low_first<const N: usize>(&mut self) -> Result<[u8; N], PayloadError> {
        self.align(N);
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.bytes(N)?);
        if !self.little {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// A number.
    #[expect(clippy::cast_precision_loss, reason = "counts and speeds are below 2⁵³")]
    pub(super) fn number(&mut self, number: Number) -> Result<f64, PayloadError> {
        Ok(match number {
            Number::I8 => f64::from(i8::from_le_bytes(self.low_first()?)),
            Number::U8 => f64::from(u8::from_le_bytes(self.low_first()?)),
            Number::I16 => f64::from(i16::from_le_bytes(self.low_first()?)),
            Number::U16 => f64::from(u16::from_le_bytes(self.low_first()?)),
            Number::I32 => f64::from(i32::from_le_bytes(self.low_first()?)),
            Number::U32 => f64::from(u32::from_le_bytes(self.low_first()?)),
            Number::I64 => i64::from_le_bytes(self.low_first()?) as f64,
            Number::U64 => u64::from_le_bytes(self.low_first()?) as f64,
            Number::F32 => f64::from(f32::from_le_bytes(self.low_first()?)),
            Number::F64 => f64::from_le_bytes(self.low_first()?),
        })
    }

    /// Whether a length in bytes stands before arrays of other than numbers, as in XCDR2.
    pub(super) fn delimits_arrays(&self) -> bool {
        self.encoding == Encoding::Cdr && self.widest < 8
    }

    /// Passes over `count` numbers of `size` bytes.
    pub(super) fn skip(&mut self, size: usize, count: usize) -> Result<(), PayloadError> {
        if count == 0 {
            return Ok(());
        }
        self.align(size);
        self.bytes(size.saturating_mul(count)).map(drop)
    }

    /// A signed integer of 4 bytes.
    pub(super) fn i32(&mut self) -> Result<i32, PayloadError> {
        self.u32().map(u32::cast_signed)
    }

    /// A real number of 8 bytes.
    pub(super) fn f64(&mut self) -> Result<f64, PayloadError> {
        Ok(f64::from_le_bytes(self.low_first()?))
    }

    /// Real numbers that follow one another.
    pub(super) fn f64s<const N: usize>(&mut self) -> Result<[f64; N], PayloadError> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.f64()?;
        }
        Ok(values)
    }

    /// Passes over `count` real numbers.
    pub(super) fn skip_f64s(&mut self, count: usize) -> Result<(), PayloadError> {
        self.skip(8, count)
    }

    /// A text; the closing zero that CDR writes is not part of it.
    pub(super) fn text(&mut self) -> Result<&'a str, PayloadError> {
        let length = self.length()?;
        let bytes = self.bytes(length)?;
        let bytes = match self.encoding {
            Encoding::Cdr => bytes.strip_suffix(&[0]).unwrap_or(bytes),
            Encoding::Ros1 => bytes,
        };
        std::str::from_utf8(bytes).map_err(|_| PayloadError::Text)
    }

    /// The number of elements of a sequence.
    pub(super) fn length(&mut self) -> Result<usize, PayloadError> {
        let length = self.u32()?;
        Ok(usize::try_from(length).unwrap_or(usize::MAX))
    }

    /// The place of a sequence of real numbers and their count; goes past it.
    pub(super) fn f64_sequence(&mut self) -> Result<(Self, usize), PayloadError> {
        let count = self.length()?;
        let place = self.clone();
        if count > 0 {
            self.skip_f64s(count)?;
        }
        Ok((place, count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A `u32` 7, the text "ab" and the number 1.5, in both byte orders and both alignments.
    const LITTLE_ENDIAN: &[u8] =
        &[0, 1, 0, 0, 7, 0, 0, 0, 3, 0, 0, 0, b'a', b'b', 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f];
    const BIG_ENDIAN: &[u8] = &[
        0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0, 3, b'a', b'b', 0, 0, 0, 0, 0, 0, 0x3f, 0xf8, 0, 0, 0, 0,
        0, 0,
    ];
    const COMPACT_PAYLOAD: &[u8] =
        &[0, 7, 0, 0, 7, 0, 0, 0, 3, 0, 0, 0, b'a', b'b', 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f];

    fn fields(payload: &[u8]) -> Result<(u32, String, f64), PayloadError> {
        fields_in(Encoding::Cdr, payload)
    }

    fn fields_in(encoding: Encoding, payload: &[u8]) -> Result<(u32, String, f64), PayloadError> {
        let mut payload = Payload::of(encoding, payload)?;
        Ok((payload.u32()?, payload.text()?.to_owned(), payload.f64()?))
    }

    #[test]
    fn byte_order_and_alignment_follow_the_header() {
        let expected = Ok((7, "ab".to_owned(), 1.5));
        assert_eq!(fields(COMPACT_PAYLOAD), expected);
        let mut little = LITTLE_ENDIAN[..16].to_vec();
        little.extend([0; 4]);
        little.extend(1.5_f64.to_le_bytes());
        assert_eq!(fields(&little), expected);
        assert_eq!(fields(BIG_ENDIAN), expected);
    }

    #[test]
    fn ros_1_aligns_nothing_and_closes_no_text() {
        let mut bytes = vec![7, 0, 0, 0, 2, 0, 0, 0, b'a', b'b'];
        bytes.extend(1.5_f64.to_le_bytes());
        assert_eq!(fields_in(Encoding::Ros1, &bytes), Ok((7, "ab".to_owned(), 1.5)));
        let cut = fields_in(Encoding::Ros1, &bytes[..17]);
        assert_eq!(cut, Err(PayloadError::Short { needed: 18, length: 17 }));
    }

    #[test]
    fn every_cut_is_an_error_and_no_panic() {
        for end in 0..BIG_ENDIAN.len() {
            assert!(matches!(fields(&BIG_ENDIAN[..end]), Err(PayloadError::Short { .. })), "{end}");
        }
    }

    #[test]
    fn a_length_beyond_the_payload_is_an_error() {
        let mut payload = vec![0, 1, 0, 0];
        payload.extend(u32::MAX.to_le_bytes());
        let mut payload = Payload::new(&payload).expect("a header");
        assert!(matches!(payload.f64_sequence(), Err(PayloadError::Short { .. })));
    }

    #[test]
    fn parameter_lists_are_refused() {
        assert_eq!(
            Payload::new(&[0, 3, 0, 0]).expect_err("refused"),
            PayloadError::Encapsulation(3)
        );
    }
}
