//! Measurement uncertainties of a vehicle's values.

use crate::vehicle::VehicleError;

/// Largest standard deviation: the largest mass, kg.
const MAX_DEVIATION: f64 = 1e8;

/// Standard deviations of measured values of a vehicle; none where unknown.
///
/// Zero means exact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uncertainty {
    /// Of the mass, kg.
    pub mass: Option<f64>,
    /// Of the gauge, m.
    pub gauge: Option<f64>,
    /// Of the centre of gravity (x_c, y_c), m.
    pub cog: Option<[f64; 2]>,
    /// Of the friction coefficients.
    pub friction: FrictionUncertainty,
}

/// Standard deviations of the friction coefficients.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrictionUncertainty {
    /// Of the coefficient across the track, μ_x, 1.
    pub across: Option<f64>,
    /// Of the coefficient along the track, μ_y, 1.
    pub along: Option<f64>,
}

impl Uncertainty {
    /// Checks that all deviations are finite and none is negative.
    pub(super) fn check(&self) -> Result<(), VehicleError> {
        let Self { mass, gauge, cog, friction } = self;
        let coefficient = "a standard deviation, zero or more";
        for (key, deviations, expected) in [
            ("mass_kg_sd", mass.as_slice(), "a standard deviation in kg, zero or more"),
            ("gauge_m_sd", gauge.as_slice(), "a standard deviation in m, zero or more"),
            (
                "cog_m_sd",
                cog.as_slice().as_flattened(),
                "two standard deviations, right and forward, in m, zero or more",
            ),
            ("friction.mu_x_sd", friction.across.as_slice(), coefficient),
            ("friction.mu_y_sd", friction.along.as_slice(), coefficient),
        ] {
            if !deviations.iter().all(|deviation| (0.0..=MAX_DEVIATION).contains(deviation)) {
                let value = match deviations {
                    [deviation] => deviation.to_string(),
                    several => format!("{several:?}"),
                };
                return Err(VehicleError { key, value, expected: expected.to_owned() });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VehicleFile;
    use trackdyn_core::document::Document;

    /// Auriga-alpha as written by the program, with deviations.
    const MEASURED_VEHICLE: &str = r#"schema = "trackdyn.vehicle/1"
name = "Auriga-alpha"
mass_kg = 258.0
mass_kg_sd = 0.5
gauge_m = 0.42
gauge_m_sd = 0.0
cog_m = [-0.015, 0.04]
cog_m_sd = [0.005, 0.01]

[track]
contact_length_m = 0.7
belt_width_m = 0.15

[friction]
mu_x = 0.9
mu_x_sd = 0.2
mu_y = 0.7
mu_y_sd = 0.1
"#;

    fn read(text: &str) -> Result<VehicleFile, String> {
        VehicleFile::from_document(&Document::new("robot.toml", text))
            .map_err(|error| error.to_string())
    }

    #[test]
    fn deviations_are_read_and_written_back() {
        let file = read(MEASURED_VEHICLE).expect("a vehicle");
        let friction = FrictionUncertainty { across: Some(0.2), along: Some(0.1) };
        assert_eq!(
            file.vehicle.uncertainty,
            Uncertainty { mass: Some(0.5), gauge: Some(0.0), cog: Some([0.005, 0.01]), friction }
        );
        assert_eq!(file.to_toml(), MEASURED_VEHICLE);
        // Keys are independent of each other.
        for line in MEASURED_VEHICLE.split_inclusive('\n').filter(|line| line.contains("_sd")) {
            let text = MEASURED_VEHICLE.replace(line, "");
            assert_eq!(read(&text).expect("a vehicle").to_toml(), text);
        }
    }

    #[test]
    fn a_file_without_deviations_keeps_its_text_and_so_its_fingerprint() {
        let lines = MEASURED_VEHICLE.split_inclusive('\n');
        let text: String = lines.filter(|line| !line.contains("_sd")).collect();
        let file = VehicleFile::auriga_alpha();
        assert_eq!(file.vehicle.uncertainty, Uncertainty::default());
        assert_eq!(file.to_toml(), text);
    }

    #[test]
    fn a_deviation_that_cannot_be_is_refused_at_its_line() {
        for (from, to, message) in [
            (
                "mass_kg_sd = 0.5",
                "mass_kg_sd = -0.5",
                "robot.toml:4: mass_kg_sd = -0.5: expected a standard deviation in kg, zero or \
                 more",
            ),
            (
                "gauge_m_sd = 0.0",
                "gauge_m_sd = inf",
                "robot.toml:6: gauge_m_sd = inf: expected a standard deviation in m, zero or more",
            ),
            (
                "[0.005, 0.01]",
                "[0.005, -0.01]",
                "robot.toml:8: cog_m_sd = [0.005, -0.01]: expected two standard deviations, right \
                 and forward, in m, zero or more",
            ),
            (
                "mu_x_sd = 0.2",
                "mu_x_sd = nan",
                "robot.toml:16: friction.mu_x_sd = nan: expected a standard deviation, zero or \
                 more",
            ),
            (
                "mu_y_sd = 0.1",
                "mu_y_sd = -1e-9",
                "robot.toml:18: friction.mu_y_sd = -1e-9: expected a standard deviation, zero or \
                 more",
            ),
        ] {
            let refusal = read(&MEASURED_VEHICLE.replace(from, to)).expect_err("no deviation");
            assert!(refusal.starts_with(message), "{refusal}");
        }
    }
}
