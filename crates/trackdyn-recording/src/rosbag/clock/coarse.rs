//! Stamps that are too coarse to date readings.

use crate::rosbag::date::Received;
use nalgebra::Isometry3;
use trackdyn_core::real;

/// Smallest share of readings with the stamp of another one before, from which on stamps are too
/// coarse.
const MIN_COARSE_SHARE: f64 = 0.5;

/// The content of a message, which is compared with that of another one.
pub(in crate::rosbag) trait Reading {
    /// Whether both have the same content; NaN in both is the same.
    fn repeats(&self, other: &Self) -> bool;
}

impl Reading for f64 {
    fn repeats(&self, other: &Self) -> bool {
        self == other || (self.is_nan() && other.is_nan())
    }
}

impl<const N: usize> Reading for [f64; N] {
    fn repeats(&self, other: &Self) -> bool {
        self.iter().zip(other).all(|(a, b)| a.repeats(b))
    }
}

impl Reading for Isometry3<f64> {
    fn repeats(&self, other: &Self) -> bool {
        self == other
    }
}

/// Whether most readings have the stamp of the one before, are other readings, and were logged at
/// times of their own.
pub(super) fn are_coarse<T: Reading>(received: &[Received<T>]) -> bool {
    let shares = |pair: &&[Received<T>]| {
        let [before, next] = pair else { return false };
        next.stamp_ns.is_some()
            && next.stamp_ns == before.stamp_ns
            && !next.value.repeats(&before.value)
            && next.log_ns != before.log_ns
    };
    let count = received.windows(2).filter(shares).count();
    real(count) > MIN_COARSE_SHARE * real(received.len())
}
