//! A vehicle file from a few measured numbers.

use crate::{Error, Vehicle};
use std::path::Path;
use trackdyn_core::document::Document;
use trackdyn_core::output::write_file;
use trackdyn_model::contact::Friction;
use trackdyn_model::vehicle::{RunningGear, Uncertainty};
use trackdyn_model::{Effects, Vehicle as Measured, VehicleError, VehicleFile};

/// Column at which remarks begin.
const REMARKS: usize = 35;

/// The numbers of a vehicle file, as far as they were measured.
///
/// ```
/// use trackdyn::{RunningGear, VehicleSketch};
/// let belts = RunningGear::Track { contact_length: 0.7, belt_width: 0.15 };
/// let sketch = VehicleSketch::new("my robot", 0.42, 258.0, belts);
/// assert_eq!(sketch.vehicle()?.gauge(), 0.42);
/// # Ok::<(), trackdyn::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleSketch {
    /// Name for titles and outputs.
    pub name: String,
    /// Distance between the centre-lines of the two sides, m.
    pub gauge: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Tracks or wheels.
    pub running_gear: RunningGear,
    /// Centre of gravity right and forward of the centre of the contact area, m. Default: there.
    pub cog: Option<[f64; 2]>,
    /// Friction coefficients across and along. Default: a guess.
    pub friction: Option<[f64; 2]>,
    /// Belt travel in m per radian of the joints, which stands in the file as a remark.
    pub wheel_radius: Option<f64>,
}

impl VehicleSketch {
    /// Friction coefficients across and along where none were measured: rubber on dry ground.
    pub const USUAL_FRICTION: [f64; 2] = [0.8, 0.8];

    /// A vehicle of which this much is known.
    pub fn new(name: &str, gauge: f64, mass: f64, running_gear: RunningGear) -> Self {
        let (cog, friction, wheel_radius) = (None, None, None);
        Self { name: name.to_owned(), gauge, mass, running_gear, cog, friction, wheel_radius }
    }

    /// The vehicle.
    ///
    /// # Errors
    /// [`Error::Vehicle`], which names key, value and what was expected.
    pub fn vehicle(&self) -> Result<Vehicle, Error> {
        let [across, along] = self.friction.unwrap_or(Self::USUAL_FRICTION);
        let vehicle = Measured {
            name: self.name.clone(),
            mass: self.mass,
            gauge: self.gauge,
            cog: self.cog.unwrap_or_default(),
            running_gear: self.running_gear.clone(),
            friction: Friction { across, along },
            uncertainty: Uncertainty::default(),
        };
        vehicle.check().map_err(Error::Vehicle)?;
        if self.name.trim().is_empty() {
            let (key, value) = ("name", format!("{:?}", self.name));
            let expected = "what outputs call the vehicle".to_owned();
            return Err(Error::Vehicle(VehicleError { key, value, expected }));
        }
        Ok(VehicleFile { vehicle, effects: Effects::default(), source: None }.into())
    }

    /// The text of its file (schema `trackdyn.vehicle/1`), with remarks.
    ///
    /// # Errors
    /// Those of [`VehicleSketch::vehicle`].
    pub fn to_toml(&self) -> Result<String, Error> {
        self.vehicle()?;
        let name = toml::Value::String(self.name.clone());
        let [across, along] = self.friction.unwrap_or(Self::USUAL_FRICTION);
        let or = |is_known: bool, guess: &str| {
            if is_known { String::new() } else { format!("; {guess}") }
        };
        let cog = or(self.cog.is_some(), "not measured");
        let guess = or(self.friction.is_some(), "a guess");
        let mut lines = vec![
            "# A vehicle in m and kg, for `map`, `identify`, `odometry` and `diagnose`. How well a \
             value"
                .to_owned(),
            "# is known goes beside it, as in gauge_m_sd = 0.005: a diagnosis does not blame a well"
                .to_owned(),
            "# measured one.".to_owned(),
            "schema = \"trackdyn.vehicle/1\"".to_owned(),
            format!("name = {name}"),
            remarked(&format!("mass_kg = {:?}", self.mass), "with all that it carries"),
            remarked(
                &format!("gauge_m = {:?}", self.gauge),
                "between the middles of the left and the right belts or tyres",
            ),
            remarked(
                &format!("cog_m = {:?}", self.cog.unwrap_or_default()),
                &format!("right, forward of the centre of the contact area{cog}"),
            ),
            String::new(),
        ];
        lines.extend(of_running_gear(&self.running_gear));
        lines.extend([
            String::new(),
            remarked("[friction]", "at low speed only the ratio mu_x / mu_y counts"),
            remarked(&format!("mu_x = {across:?}"), &format!("across{guess}")),
            remarked(&format!("mu_y = {along:?}"), &format!("along{guess}")),
        ]);
        if let Some(radius) = self.wheel_radius {
            lines.push(String::new());
            lines.push(format!(
                "# Belt travel per radian of the joints, for logs: --wheel-radius {radius:?}"
            ));
        }
        Ok(lines.join("\n") + "\n")
    }

    /// Writes its file.
    ///
    /// # Errors
    /// Those of [`VehicleSketch::to_toml`]; [`Error::Output`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let text = self.to_toml()?;
        let name = path.as_ref().display().to_string();
        // What is written is what is read.
        Vehicle::from_document(&Document::new(name, text.as_str()))?;
        Ok(write_file(path.as_ref(), text.as_bytes())?)
    }
}

fn of_running_gear(gear: &RunningGear) -> Vec<String> {
    match gear {
        RunningGear::Track { contact_length, belt_width } => vec![
            "[track]".to_owned(),
            remarked(
                &format!("contact_length_m = {contact_length:?}"),
                "of a belt on flat ground, between the outer road wheels",
            ),
            format!("belt_width_m = {belt_width:?}"),
        ],
        RunningGear::Wheels { contact_length, width, axles } => vec![
            "[wheels]".to_owned(),
            remarked(&format!("contact_length_m = {contact_length:?}"), "of one tyre"),
            remarked(&format!("width_m = {width:?}"), "of one tyre"),
            remarked(&format!("axles_m = {axles:?}"), "forward of the middle"),
        ],
    }
}

/// A line with a remark behind it.
fn remarked(line: &str, remark: &str) -> String {
    format!("{line:REMARKS$}# {remark}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn belts() -> RunningGear {
        RunningGear::Track { contact_length: 0.7, belt_width: 0.15 }
    }

    fn sketches() -> Vec<VehicleSketch> {
        let axles = vec![0.256, -0.256];
        let wheels = RunningGear::Wheels { contact_length: 0.1, width: 0.12, axles };
        let known = VehicleSketch {
            cog: Some([-0.015, 0.04]),
            friction: Some([0.9, 0.7]),
            wheel_radius: Some(0.165),
            ..VehicleSketch::new("a \"robot\"\\ of\nours", 0.555, 75.0, wheels)
        };
        vec![VehicleSketch::new("robot", 0.42, 258.0, belts()), known]
    }

    #[test]
    fn the_text_is_the_vehicle() {
        for sketch in sketches() {
            let text = sketch.to_toml().expect("sound");
            let read = Vehicle::from_document(&Document::new("text", text.as_str()));
            assert_eq!(read.expect("a vehicle file"), sketch.vehicle().expect("sound"), "{text}");
            assert!(text.lines().all(|line| line.chars().count() <= 110), "{text}");
            assert_eq!(text.contains("a guess"), sketch.friction.is_none(), "{text}");
            assert_eq!(text.contains("--wheel-radius 0.165"), sketch.wheel_radius.is_some());
        }
    }

    #[test]
    fn errors_name_key_value_and_what_was_expected() {
        let robot = || VehicleSketch::new("robot", 0.42, 258.0, belts());
        let wheels = RunningGear::Wheels { contact_length: 0.3, width: 0.1, axles: vec![0.1, 0.0] };
        for (sketch, part) in [
            (VehicleSketch { gauge: -0.4, ..robot() }, "gauge_m = -0.4: expected"),
            (VehicleSketch { mass: f64::NAN, ..robot() }, "mass_kg = NaN: expected"),
            (VehicleSketch { cog: Some([0.0, 3.0]), ..robot() }, "cog_m = [0, 3]: expected"),
            (VehicleSketch { friction: Some([0.0, 1.0]), ..robot() }, "friction.mu_x = 0: expect"),
            (VehicleSketch { running_gear: wheels, ..robot() }, "wheels.axles_m = [0.1, 0.0]"),
            (VehicleSketch { name: " ".to_owned(), ..robot() }, "name = \" \": expected"),
        ] {
            let error = sketch.to_toml().expect_err("refused").to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
