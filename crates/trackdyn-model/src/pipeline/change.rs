//! A change at a time.

/// Time that a change takes, s: a fit needs its derivative, and nothing changes at once.
const DURATION: f64 = 2.0;

/// Part of a change at `at` (s) that is done at `time` (s): it rises evenly, half of it before.
pub fn done_at(time: f64, at: f64) -> f64 {
    // φ = (t − t₀)/d + ½, within 0 and 1
    ((time - at) / DURATION + 0.5).clamp(0.0, 1.0)
}
