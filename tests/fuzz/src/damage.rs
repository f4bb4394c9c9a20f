//! Damage to a file or a message.

use arbitrary::Arbitrary;

/// A value that is written over what was there.
#[derive(Arbitrary, Clone, Copy, Debug)]
pub struct Patch {
    /// Where it is written, modulo the length.
    at: u16,
    value: Value,
}

/// What is written.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Value {
    Byte(u8),
    Count(u32),
    Size(u64),
    Real(f64),
}

impl Patch {
    /// Writes the value, as far as there is room.
    pub fn apply(self, bytes: &mut [u8]) {
        let at = usize::from(self.at) % bytes.len().max(1);
        let value = match self.value {
            Value::Byte(value) => value.to_le_bytes().to_vec(),
            Value::Count(value) => value.to_le_bytes().to_vec(),
            Value::Size(value) => value.to_le_bytes().to_vec(),
            Value::Real(value) => value.to_le_bytes().to_vec(),
        };
        for (byte, value) in bytes[at..].iter_mut().zip(value) {
            *byte = value;
        }
    }
}

/// What is wrong with a file as a whole.
#[derive(Arbitrary, Clone, Debug)]
pub struct Damage {
    /// The first eight of them count.
    patches: Vec<Patch>,
    /// How many bytes at the end are missing.
    missing: Option<u16>,
}

impl Damage {
    /// Damages a file.
    pub fn apply(&self, bytes: &mut Vec<u8>) {
        for patch in self.patches.iter().take(8) {
            patch.apply(bytes);
        }
        let missing = self.missing.map_or(0, usize::from);
        bytes.truncate(bytes.len().saturating_sub(missing));
    }
}
