//! The gauge of a vehicle, which is all that identification needs of it.

use crate::{Error, Vehicle};
use trackdyn_core::output::fingerprint;
use trackdyn_model::VehicleFile;

/// Name of the vehicle of a gauge alone.
const NO_VEHICLE: &str = "vehicle not given";

/// Smallest gauge of a vehicle, m.
const MIN_GAUGE: f64 = 1e-6;

/// Largest gauge of a vehicle, m.
const MAX_GAUGE: f64 = 100.0;

/// Distance between the track centre-lines, and the vehicle that has it.
///
/// A vehicle gives its own: what takes `impl Into<Gauge>` takes `&Vehicle`.
///
/// ```
/// let gauge = trackdyn::Gauge::new(0.555)?;
/// assert_eq!((gauge.metres(), gauge.vehicle()), (0.555, "vehicle not given"));
/// # Ok::<(), trackdyn::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    metres: f64,
    vehicle: String,
    fingerprint: String,
    file: Option<Box<VehicleFile>>,
}

impl Gauge {
    /// A gauge that was measured, m, of a vehicle of which nothing else is said.
    ///
    /// # Errors
    /// [`Error::Gauge`] for what is no length of a vehicle.
    pub fn new(metres: f64) -> Result<Self, Error> {
        if !(MIN_GAUGE..=MAX_GAUGE).contains(&metres) {
            return Err(Error::Gauge { metres, most: MAX_GAUGE });
        }
        let fingerprint = fingerprint(format!("gauge_m = {metres:?}\n").as_bytes());
        Ok(Self { metres, vehicle: NO_VEHICLE.to_owned(), fingerprint, file: None })
    }

    /// Its length, m.
    pub fn metres(&self) -> f64 {
        self.metres
    }

    /// Name of the vehicle; `vehicle not given` of a gauge alone.
    pub fn vehicle(&self) -> &str {
        &self.vehicle
    }

    /// Fingerprint of the vehicle file, or of the gauge alone.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// The vehicle with its effects; none of a gauge alone.
    pub fn file(&self) -> Option<&VehicleFile> {
        self.file.as_deref()
    }

    /// The vehicle for a caption.
    pub(crate) fn caption(&self) -> String {
        if self.vehicle == NO_VEHICLE {
            format!("{NO_VEHICLE}, gauge {} m", self.metres)
        } else {
            format!("vehicle {} {}", self.vehicle, self.fingerprint)
        }
    }
}

impl From<&Vehicle> for Gauge {
    fn from(vehicle: &Vehicle) -> Self {
        Self {
            metres: vehicle.gauge(),
            vehicle: vehicle.name().to_owned(),
            fingerprint: vehicle.fingerprint(),
            file: Some(Box::new(vehicle.file().clone())),
        }
    }
}

impl From<&Gauge> for Gauge {
    fn from(gauge: &Gauge) -> Self {
        gauge.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gauge_is_a_length() {
        for metres in [0.0, -0.5, f64::NAN, f64::INFINITY, 555.0] {
            let error = Gauge::new(metres).expect_err("no gauge");
            assert_eq!(error.setting(), Some("gauge"), "{metres}");
            assert!(error.to_string().contains("in m"), "{error}");
        }
        let (one, other) = (Gauge::new(0.5).expect("a gauge"), Gauge::new(0.6).expect("a gauge"));
        assert_ne!(one.fingerprint(), other.fingerprint());
    }
}
