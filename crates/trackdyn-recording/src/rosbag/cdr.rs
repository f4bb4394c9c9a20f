//! Reading the Common Data Representation.
//!
//! # Sources
//! OMG DDSI-RTPS 2.5, section 10 (encapsulation header); OMG DDS-XTypes 1.3, section 7.4
//! (alignment: XCDR1 aligns to the size of the primitive, XCDR2 to at most 4).

/// Why a payload cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum CdrError {
    /// It ends too early.
    Short {
        /// Bytes that were needed.
        needed: usize,
        /// Bytes that there are.
        length: usize,
    },
    /// An encapsulation that is not plain CDR.
    Encapsulation(u8),
    /// A text that is not UTF-8.
    Text,
}

impl std::fmt::Display for CdrError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Short { needed, length } => write!(f, "it needs {needed} bytes and has {length}"),
            Self::Encapsulation(id) => write!(f, "its encapsulation is {id:#04x}, not plain CDR"),
            Self::Text => write!(f, "a text in it is not UTF-8"),
        }
    }
}

/// A place in a payload.
#[derive(Clone, Debug)]
pub(super) struct Cdr<'a> {
    body: &'a [u8],
    at: usize,
    little: bool,
    widest: usize,
}

impl<'a> Cdr<'a> {
    /// The start of a payload with its encapsulation header of 4 bytes.
    pub(super) fn new(payload: &'a [u8]) -> Result<Self, CdrError> {
        let Some((header, body)) = payload.split_at_checked(4) else {
            return Err(CdrError::Short { needed: 4, length: payload.len() });
        };
        let (little, widest) = match header[1] {
            0x00 => (false, 8),
            0x01 => (true, 8),
            0x06 => (false, 4),
            0x07 => (true, 4),
            other => return Err(CdrError::Encapsulation(other)),
        };
        Ok(Self { body, at: 0, little, widest })
    }

    fn bytes(&mut self, count: usize) -> Result<&'a [u8], CdrError> {
        let end = self.at.saturating_add(count);
        let Some(bytes) = self.body.get(self.at..end) else {
            return Err(CdrError::Short { needed: end, length: self.body.len() });
        };
        self.at = end;
        Ok(bytes)
    }

    fn align(&mut self, size: usize) {
        self.at = self.at.next_multiple_of(size.min(self.widest));
    }

    /// An unsigned integer of 4 bytes.
    pub(super) fn u32(&mut self) -> Result<u32, CdrError> {
        self.align(4);
        let mut bytes = [0; 4];
        bytes.copy_from_slice(self.bytes(4)?);
        Ok(if self.little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    }

    /// A signed integer of 4 bytes.
    pub(super) fn i32(&mut self) -> Result<i32, CdrError> {
        self.u32().map(u32::cast_signed)
    }

    /// A real number of 8 bytes.
    pub(super) fn f64(&mut self) -> Result<f64, CdrError> {
        self.align(8);
        let mut bytes = [0; 8];
        bytes.copy_from_slice(self.bytes(8)?);
        Ok(if self.little { f64::from_le_bytes(bytes) } else { f64::from_be_bytes(bytes) })
    }

    /// Real numbers that follow one another.
    pub(super) fn f64s<const N: usize>(&mut self) -> Result<[f64; N], CdrError> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.f64()?;
        }
        Ok(values)
    }

    /// Passes over `count` real numbers.
    pub(super) fn skip_f64s(&mut self, count: usize) -> Result<(), CdrError> {
        self.align(8);
        self.bytes(count.saturating_mul(8)).map(drop)
    }

    /// A text; its closing zero is not part of it.
    pub(super) fn text(&mut self) -> Result<&'a str, CdrError> {
        let length = self.length()?;
        let bytes = self.bytes(length)?;
        let bytes = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        std::str::from_utf8(bytes).map_err(|_| CdrError::Text)
    }

    /// The number of elements of a sequence.
    pub(super) fn length(&mut self) -> Result<usize, CdrError> {
        let length = self.u32()?;
        Ok(usize::try_from(length).unwrap_or(usize::MAX))
    }

    /// The place of a sequence of real numbers and their count; goes past it.
    pub(super) fn f64_sequence(&mut self) -> Result<(Self, usize), CdrError> {
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
    const LITTLE: &[u8] =
        &[0, 1, 0, 0, 7, 0, 0, 0, 3, 0, 0, 0, b'a', b'b', 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f];
    const BIG: &[u8] = &[
        0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0, 3, b'a', b'b', 0, 0, 0, 0, 0, 0, 0x3f, 0xf8, 0, 0, 0, 0,
        0, 0,
    ];
    const COMPACT: &[u8] =
        &[0, 7, 0, 0, 7, 0, 0, 0, 3, 0, 0, 0, b'a', b'b', 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f];

    fn fields(payload: &[u8]) -> Result<(u32, String, f64), CdrError> {
        let mut cdr = Cdr::new(payload)?;
        Ok((cdr.u32()?, cdr.text()?.to_owned(), cdr.f64()?))
    }

    #[test]
    fn byte_order_and_alignment_follow_the_header() {
        let expected = Ok((7, "ab".to_owned(), 1.5));
        assert_eq!(fields(COMPACT), expected);
        let mut little = LITTLE[..16].to_vec();
        little.extend([0; 4]);
        little.extend(1.5_f64.to_le_bytes());
        assert_eq!(fields(&little), expected);
        assert_eq!(fields(BIG), expected);
    }

    #[test]
    fn every_cut_is_an_error_and_no_panic() {
        for end in 0..BIG.len() {
            assert!(matches!(fields(&BIG[..end]), Err(CdrError::Short { .. })), "{end}");
        }
    }

    #[test]
    fn a_length_beyond_the_payload_is_an_error() {
        let mut payload = vec![0, 1, 0, 0];
        payload.extend(u32::MAX.to_le_bytes());
        let mut cdr = Cdr::new(&payload).expect("a header");
        assert!(matches!(cdr.f64_sequence(), Err(CdrError::Short { .. })));
    }

    #[test]
    fn parameter_lists_are_refused() {
        assert_eq!(Cdr::new(&[0, 3, 0, 0]).expect_err("refused"), CdrError::Encapsulation(3));
    }
}
