//! Normal pressure under one side.

use crate::contact::{Extent, Patch};
use trackdyn_core::Scalar;

/// Normal pressure of one side, linear along the track and constant across it:
/// `p(y) = at_origin + gradient · y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressure<S = f64> {
    /// Pressure at y = 0, Pa.
    pub at_origin: S,
    /// Slope of the pressure along y, Pa/m.
    pub gradient: S,
}

impl<S: Scalar> Pressure<S> {
    /// Pressure at y, Pa.
    #[inline]
    pub fn at(&self, y: S) -> S {
        self.at_origin + self.gradient * y
    }
}

/// Distribution of the load of one side over its patches: area, centroid and radius of gyration of
/// the contact along y.
///
/// A rigid hull on equal springs sinks linearly, so one linear pressure serves a long track and a
/// row of wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Contact area, m².
    pub area: f64,
    /// Mean y of the area, m.
    pub centroid: f64,
    /// Mean of (y − centroid)² over the area, m²; l²/12 for one track.
    pub gyration_squared: f64,
    /// Rear and front end of the contact, m.
    pub ends: [f64; 2],
}

impl Footprint {
    /// The footprint of the patches of one side.
    pub fn of(patches: &[Patch]) -> Self {
        let area: f64 = patches.iter().map(Patch::area).sum();
        let mean = |f: &dyn Fn(&Patch) -> f64| {
            patches.iter().map(|patch| patch.area() * f(patch)).sum::<f64>() / area
        };
        let centroid = mean(&|patch| patch.centre()[1]);
        Self {
            area,
            centroid,
            gyration_squared: mean(&|patch| {
                patch.length().powi(2) / 12.0 + (patch.centre()[1] - centroid).powi(2)
            }),
            ends: [
                patches.iter().map(|p| p.y[0]).fold(f64::INFINITY, f64::min),
                patches.iter().map(|p| p.y[1]).fold(f64::NEG_INFINITY, f64::max),
            ],
        }
    }

    /// Centre and size of the contact of these patches, which differ in y only.
    pub fn extent(&self, patches: &[Patch]) -> Extent {
        // All patches of a side have the same width and centre-line.
        let patch = &patches[0];
        Extent {
            middle: [patch.centre()[0], self.centroid],
            radius: (self.gyration_squared + patch.width().powi(2) / 12.0).sqrt(),
        }
    }

    /// Rearmost and foremost centre of pressure (y, m) at which the pressure is positive
    /// everywhere; ±l/6 for one track.
    pub fn support(&self) -> [f64; 2] {
        // 1 + (y_p − ȳ)(y_end − ȳ)/ρ² = 0 at the opposite end
        let [rear, front] = self.ends;
        [front, rear].map(|end| self.centroid - self.gyration_squared / (end - self.centroid))
    }

    /// The pressure that carries `normal_load` (N) with its resultant at `centre_of_pressure`
    /// (y, m) if all of the contact bears; negative where it would lift.
    #[inline]
    pub fn pressure<S: Scalar>(&self, normal_load: S, centre_of_pressure: S) -> Pressure<S> {
        // p(y) = N/A (1 + (y_p − ȳ)(y − ȳ)/ρ²), Fig. 5; with ρ² = l²/12 and ȳ = 0 it is
        // N/(l b) (1 + 12 y_p y/l²)
        let mean = normal_load / self.area;
        let gradient = mean * (centre_of_pressure - self.centroid) / self.gyration_squared;
        Pressure { at_origin: mean - gradient * self.centroid, gradient }
    }
}
