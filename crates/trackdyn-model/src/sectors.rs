//! The plane of both belt speeds in eight sectors, in each of which a stationary motion is smooth.
//!
//! Within a sector (signs of V_l, V_r, V_r − V_l and V_r + V_l) the motion is smooth in the
//! direction φ and the norm ρ of (V_l, V_r); between sectors it may jump. A place in a sector is
//! (s, a): s of the norm, a the part of the sector's 45°, both from 0 to 1. Tables have Chebyshev
//! nodes of the first kind in both, none of which lies on an edge.

use crate::Model;
use crate::effect::Symmetry;
use std::f64::consts::{FRAC_PI_4, PI};
use trackdyn_core::{PerSide, real};

/// Number of sectors.
pub const SECTORS: usize = 8;

/// Spacing of places in ρ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Even in ρ: exact for a square of the speed.
    Even,
    /// Even in ln ρ: friction that depends on slip speed varies most at small ones.
    Logarithmic {
        /// Ratio R of the largest to the smallest tabulated speed; below, the value stays constant.
        range: f64,
        /// 1/(2 ln R).
        scale: f64,
    },
}

impl Spacing {
    /// Even in the logarithm, for this ratio of the largest to the smallest speed.
    pub fn logarithmic(range: f64) -> Self {
        Self::Logarithmic { range, scale: 0.5 / range.ln() }
    }

    /// Even in the logarithm over the ratio `range` where friction depends on the slip speed.
    pub fn of(model: &Model, range: f64) -> Self {
        let depends_on_slip_speed = model.effects().iter().any(|effect| {
            let card = effect.card();
            card.shears() && card.breaks.contains(&Symmetry::SpeedScale)
        });
        if depends_on_slip_speed { Self::logarithmic(range) } else { Self::Even }
    }

    /// R; none where it is even in ρ.
    pub fn range(self) -> Option<f64> {
        match self {
            Self::Even => None,
            Self::Logarithmic { range, .. } => Some(range),
        }
    }

    /// ρ/ρ_max at s.
    fn part(self, place: f64) -> f64 {
        match self {
            Self::Even => place,
            // R^(s − 1)
            Self::Logarithmic { range, .. } => range.powf(place - 1.0),
        }
    }

    /// s of (ρ/ρ_max)².
    #[inline]
    pub fn place(self, squared: f64) -> f64 {
        let place = match self {
            Self::Even => squared.sqrt(),
            Self::Logarithmic { scale, .. } => 1.0 + squared.ln() * scale,
        };
        place.clamp(0.0, 1.0)
    }
}

/// Belt speeds at (s, a) of a sector, m/s; `largest` is ρ_max.
pub fn speeds(largest: f64, spacing: Spacing, sector: usize, [s, a]: [f64; 2]) -> PerSide<f64> {
    let phi = (real(sector) + a) * FRAC_PI_4;
    let rho = largest * spacing.part(s);
    PerSide::new(rho * phi.cos(), rho * phi.sin())
}

/// Sector of belt speeds, and a.
#[inline]
pub fn direction(speeds: PerSide<f64>) -> (usize, f64) {
    let phi = speeds.right.atan2(speeds.left).rem_euclid(2.0 * PI) / FRAC_PI_4;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8")]
    let sector = (phi as usize).min(SECTORS - 1);
    (sector, phi - real(sector))
}

/// Chebyshev node k of n of the first kind, on [0, 1].
pub fn node(k: usize, n: usize) -> f64 {
    let angle = (2.0 * real(k) + 1.0) * PI / (2.0 * real(n));
    0.5 - 0.5 * angle.cos()
}

/// Values at the nodes (of each sector, of each s, of each a) with missing ones replaced by the
/// nearest of the sector; zero where it has none.
pub fn filled<T: Copy + Default>(values: &[Option<T>], [sizes, angles]: [usize; 2]) -> Vec<T> {
    let count = sizes * angles;
    let place = |index: usize| (index % count / angles, index % angles);
    let fill = |index: usize| {
        let sector = index / count * count;
        let (size, angle) = place(index);
        let known = (sector..sector + count).filter_map(|other| Some((other, values[other]?)));
        let nearest = known.min_by_key(|(other, _)| {
            let (other_size, other_angle) = place(*other);
            (other_size.abs_diff(size) + other_angle.abs_diff(angle), *other)
        });
        nearest.map_or_else(T::default, |(_, value)| value)
    };
    values.iter().enumerate().map(|(index, value)| value.unwrap_or_else(|| fill(index))).collect()
}
