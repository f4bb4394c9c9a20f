//! Validity of a vehicle's values.

use crate::contact::pressure::Footprint;
use crate::vehicle::{RunningGear, Vehicle};
use trackdyn_core::Side;
use trackdyn_core::lines::shortened;

/// Values that a vehicle can have, from a model on a table to the largest excavators of mines
/// (10⁷ kg), and beyond them where experiments of thought go. Far outside, sums of forces and
/// moments leave the range of numbers.
struct Range {
    what: &'static str,
    least: f64,
    most: f64,
}

/// Largest length of a vehicle, m.
const MAX_LENGTH: f64 = 100.0;

/// Smallest length or width, m.
const MIN_LENGTH: f64 = 1e-6;

/// Most axles of a side: trains of many trailers have less.
const MAX_AXLES: usize = 100;

/// Most characters of a name.
const MAX_NAME: usize = 200;

const MASS: Range = Range { what: "a positive mass in kg", least: 1e-3, most: 1e8 };
const GAUGE: Range = Range {
    what: "a positive distance between the track centre-lines in m",
    least: MIN_LENGTH,
    most: MAX_LENGTH,
};
const LENGTH: Range =
    Range { what: "a positive contact length in m", least: MIN_LENGTH, most: MAX_LENGTH };
const WIDTH: Range = Range { what: "a positive width in m", least: MIN_LENGTH, most: MAX_LENGTH };
const FRICTION: Range = Range { what: "a positive friction coefficient", least: 1e-6, most: 1e3 };

/// An invalid value of a vehicle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key} = {value}: expected {expected}")]
pub struct VehicleError {
    /// Key in the vehicle file.
    pub key: &'static str,
    /// The value.
    pub value: String,
    /// Expected values.
    pub expected: String,
}

impl Vehicle {
    /// Checks all values, and that the robot stands on its contact.
    ///
    /// # Errors
    /// The first invalid value; for a centre of gravity outside the limits, the error names the end
    /// or side over which it tips.
    pub fn check(&self) -> Result<(), VehicleError> {
        self.check_name()?;
        MASS.check("mass_kg", self.mass)?;
        GAUGE.check("gauge_m", self.gauge)?;
        self.check_running_gear()?;
        FRICTION.check("friction.mu_x", self.friction.across)?;
        FRICTION.check("friction.mu_y", self.friction.along)?;
        self.check_support()?;
        self.uncertainty.check()
    }

    fn check_name(&self) -> Result<(), VehicleError> {
        if self.name.chars().count() <= MAX_NAME {
            return Ok(());
        }
        Err(VehicleError {
            key: "name",
            value: shortened(&self.name, MAX_NAME),
            expected: format!("a name of at most {MAX_NAME} characters"),
        })
    }

    fn check_running_gear(&self) -> Result<(), VehicleError> {
        let (width_key, width) = match &self.running_gear {
            RunningGear::Track { contact_length, belt_width } => {
                LENGTH.check("track.contact_length_m", *contact_length)?;
                WIDTH.check("track.belt_width_m", *belt_width)?;
                ("track.belt_width_m", *belt_width)
            }
            RunningGear::Wheels { contact_length, width: wheel_width, axles } => {
                LENGTH.check("wheels.contact_length_m", *contact_length)?;
                WIDTH.check("wheels.width_m", *wheel_width)?;
                let mut sorted = axles.clone();
                sorted.sort_by(f64::total_cmp);
                let apart = sorted.windows(2).all(|pair| pair[1] - pair[0] >= *contact_length);
                let are_near = axles.iter().all(|y| y.abs() <= MAX_LENGTH);
                if !(1..=MAX_AXLES).contains(&axles.len()) || !are_near || !apart {
                    return Err(VehicleError {
                        key: "wheels.axles_m",
                        value: shortened(&format!("{axles:?}"), MAX_NAME),
                        expected: format!(
                            "the y of one to {MAX_AXLES} axles in m, up to {MAX_LENGTH}, at \
                             least a contact length ({contact_length} m) apart"
                        ),
                    });
                }
                ("wheels.width_m", *wheel_width)
            }
        };
        if width > self.gauge {
            return Err(VehicleError {
                key: width_key,
                value: width.to_string(),
                expected: format!("less than the gauge ({} m): the sides overlap", self.gauge),
            });
        }
        Ok(())
    }

    /// The centre of gravity must lie above the contact: |x_c| < L/2, and for one track |y_c| <
    /// l/2.
    fn check_support(&self) -> Result<(), VehicleError> {
        let [x, y] = self.cog;
        let error = |expected: String| VehicleError {
            key: "cog_m",
            value: format!("[{x}, {y}]"),
            expected,
        };
        if !(x.is_finite() && y.is_finite()) {
            return Err(error("two finite numbers, right and forward, in m".to_owned()));
        }
        let half_gauge = self.gauge / 2.0;
        if x.abs() >= half_gauge {
            let side = if x > 0.0 { "right" } else { "left" };
            return Err(error(format!(
                "x between {:.4} and {half_gauge:.4} m (half the gauge): the robot tips over its \
                 {side} side",
                -half_gauge
            )));
        }
        let [rear, front] = Footprint::of(&self.patches(Side::Left)).ends;
        if y <= rear || y >= front {
            let end = if y >= front { "front" } else { "rear" };
            return Err(error(format!(
                "y between {rear:.4} and {front:.4} m (the ends of the contact): the robot tips \
                 over its {end} end"
            )));
        }
        Ok(())
    }
}

impl Range {
    fn check(&self, key: &'static str, value: f64) -> Result<(), VehicleError> {
        let Self { what, least, most } = *self;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        let expected = format!("{what}, from {least} to {most}");
        Err(VehicleError { key, value: value.to_string(), expected })
    }
}
