//! Power: what is found against how strongly it shows.

use super::verdict::Judged;

/// Limits of z between bins: those of what is distinct and what is detectable are among them.
const Z_LIMITS: [f64; 10] = [0.0, 2.0, 3.0, 4.0, 5.0, 8.0, 12.5, 20.0, 32.0, f64::INFINITY];

/// Single effects of the catalogue within limits of z.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerBin {
    /// Which z: `z_det` or `z_iso`.
    pub of: &'static str,
    /// Lower and upper limit of z.
    pub limits: [f64; 2],
    /// Cases within.
    pub cases: usize,
    /// Those with the truth in a reported set.
    pub in_set: usize,
    /// Those in which the truth is named exactly.
    pub exact: usize,
}

/// Power against both z.
pub(super) fn power(judged: &[Judged]) -> Vec<PowerBin> {
    let mut bins = Vec::new();
    for of in ["z_det", "z_iso"] {
        for limits in Z_LIMITS.windows(2) {
            let mut bin =
                PowerBin { of, limits: [limits[0], limits[1]], cases: 0, in_set: 0, exact: 0 };
            for case in judged.iter().filter(|case| !case.is_constant()) {
                let Some(truth) = case.only() else { continue };
                let z = if of == "z_det" { truth.z_det } else { truth.z_iso };
                if (limits[0]..limits[1]).contains(&z) {
                    bin.cases += 1;
                    bin.in_set += usize::from(case.set_with(&truth.mechanism).is_some());
                    bin.exact += usize::from(case.names_exactly(&[&truth.mechanism]));
                }
            }
            bins.push(bin);
        }
    }
    bins
}
