//! How large packed data may be.

/// Most bytes that one byte of packed data may unpack to. Messages of a driving robot pack to
/// between a third and a twentieth of their size, and those of a standing robot to a hundredth.
/// Data that packs better could fill the memory.
const MAX_RATIO: u64 = 200;

/// Unpacked size that is accepted however well it packs, bytes.
const ACCEPTED_SIZE: u64 = 1 << 26;

/// Largest size that so many bytes may unpack to.
pub(super) fn max_unpacked(packed: u64) -> u64 {
    packed.saturating_mul(MAX_RATIO).max(ACCEPTED_SIZE)
}
