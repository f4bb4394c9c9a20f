//! How large packed data may be.

/// Most bytes that a byte of packed data may stand for. Messages of a robot pack to a third or a
/// twentieth, those of a robot that stands to a hundredth; what packs better would fill the memory.
const MAX_RATIO: u64 = 200;

/// Unpacked size that is accepted however well it packs, bytes.
const ACCEPTED_SIZE: u64 = 1 << 26;

/// Largest size that so many bytes may unpack to.
pub(super) fn max_unpacked(packed: u64) -> u64 {
    packed.saturating_mul(MAX_RATIO).max(ACCEPTED_SIZE)
}
