//! Validity of a vehicle's values.

use crate::contact::pressure::Footprint;
use crate::vehicle::{RunningGear, Vehicle};
use trackdyn_core::Side;

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
        positive("mass_kg", self.mass, "a positive mass in kg")?;
        positive("gauge_m", self.gauge, "a positive distance between the track centre-lines in m")?;
        self.check_running_gear()?;
        let friction = "a positive friction coefficient";
        positive("friction.mu_x", self.friction.across, friction)?;
        positive("friction.mu_y", self.friction.along, friction)?;
        self.check_support()?;
        self.uncertainty.check()
    }

    fn check_running_gear(&self) -> Result<(), VehicleError> {
        let (length, width) = ("a positive contact length in m", "a positive width in m");
        let (width_key, width) = match &self.running_gear {
            RunningGear::Track { contact_length, belt_width } => {
                positive("track.contact_length_m", *contact_length, length)?;
                positive("track.belt_width_m", *belt_width, width)?;
                ("track.belt_width_m", *belt_width)
            }
            RunningGear::Wheels { contact_length, width: wheel_width, axles } => {
                positive("wheels.contact_length_m", *contact_length, length)?;
                positive("wheels.width_m", *wheel_width, width)?;
                let mut sorted = axles.clone();
                sorted.sort_by(f64::total_cmp);
                let apart = sorted.windows(2).all(|pair| pair[1] - pair[0] >= *contact_length);
                if axles.is_empty() || !axles.iter().all(|y| y.is_finite()) || !apart {
                    return Err(VehicleError {
                        key: "wheels.axles_m",
                        value: format!("{axles:?}"),
                        expected: format!(
                            "the y of one or more axles in m, at least a contact length \
                             ({contact_length} m) apart"
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

fn positive(key: &'static str, value: f64, expected: &str) -> Result<(), VehicleError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(VehicleError { key, value: value.to_string(), expected: expected.to_owned() })
    }
}
