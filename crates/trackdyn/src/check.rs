//! Whether vehicles still give the ICRs that a reference file states: a regression check.

mod reference;

pub use reference::{Case, Expected, Quantity, Reference};

use crate::{Error, IcrMap, MapSettings, Vehicle, icr_map};
use std::path::Path;

/// A number that was checked.
#[derive(Clone, Copy, Debug)]
pub struct CheckedNumber {
    /// Its name in `kinematics.toml`.
    pub key: &'static str,
    /// What must come out.
    pub expected: Expected,
    /// What came out; not a number where no motion turns.
    pub computed: f64,
}

impl CheckedNumber {
    /// By how much it is off.
    pub fn error(&self) -> f64 {
        self.computed - self.expected.value
    }

    /// Whether it is within its tolerance. What is not a number is not.
    pub fn holds(&self) -> bool {
        self.error().abs() <= self.expected.tolerance
    }
}

/// A case that was recomputed.
#[derive(Clone, Debug)]
pub struct CheckedCase {
    /// Its name.
    pub name: String,
    /// Its vehicle.
    pub vehicle: Vehicle,
    /// The map of the vehicle.
    pub map: IcrMap,
    /// Its numbers.
    pub numbers: Vec<CheckedNumber>,
}

/// Recomputes a case; `vehicle` counts in place of the one that it names.
///
/// # Errors
/// [`Error::Case`] for a vehicle that cannot be read, or with which the case does not go.
pub fn check(
    reference: &Reference,
    case: &Case,
    vehicle: Option<&Vehicle>,
) -> Result<CheckedCase, Error> {
    let vehicle = vehicle_of(reference, case, vehicle).map_err(|cause| Error::Case {
        reference: reference.path.display().to_string(),
        case: case.name.clone(),
        cause: Box::new(cause),
    })?;
    let map = icr_map(&vehicle, &MapSettings { grid: reference.grid, ..MapSettings::default() });
    let numbers = case.expect.iter().map(|(quantity, expected)| CheckedNumber {
        key: quantity.key(),
        expected: *expected,
        computed: quantity.of(map.statistics()),
    });
    let numbers = numbers.collect();
    Ok(CheckedCase { name: case.name.clone(), vehicle, map, numbers })
}

/// The vehicle of a case: the given one, that of the case, or the embedded one.
fn vehicle_of(
    reference: &Reference,
    case: &Case,
    given: Option<&Vehicle>,
) -> Result<Vehicle, Error> {
    let mut vehicle = match (given, &case.vehicle) {
        (Some(vehicle), _) => vehicle.clone(),
        (None, Some(path)) => {
            let folder = reference.path.parent().unwrap_or(Path::new("."));
            Vehicle::open(folder.join(path))?
        }
        (None, None) => Vehicle::auriga_alpha(),
    };
    if let Some(cog) = case.cog {
        vehicle = vehicle.with_cog(cog)?;
    }
    for effect in &case.effects {
        vehicle = vehicle.with_active(effect.clone());
    }
    Ok(vehicle)
}
