//! Which vehicle is meant.

use super::{VEHICLE, number, pair};
use crate::shell;
use crate::stderr::note;
use clap::Args;
use std::error::Error;
use std::path::PathBuf;
use trackdyn::{ActiveEffect, Gauge, Vehicle, refuse_repeated};

/// The vehicle and its effects.
#[derive(Args)]
#[command(next_help_heading = VEHICLE)]
pub struct ModelOptions {
    /// Vehicle: a file (schema trackdyn.vehicle/1), or a name such as husky-a200 [default:
    /// auriga-alpha]
    #[arg(long, value_name = "FILE|NAME")]
    pub vehicle: Option<PathBuf>,
    /// Centre of gravity in m from the centre of the contact area: right, forward (x, y of the
    /// vehicle file; not the order of ROS, in which it is forward, left)
    #[arg(long, value_name = "RIGHT,FORWARD", value_parser = pair, allow_hyphen_values = true)]
    pub cog: Option<[f64; 2]>,
    /// Switch an effect on, with its typical size or this one; repeatable (see `trackdyn effects`)
    #[arg(long = "effect", value_name = "ID[:PARAMETER=VALUE,...]")]
    pub effects: Vec<ActiveEffect>,
}

impl ModelOptions {
    /// The vehicle with the changes of the command line.
    ///
    /// # Errors
    /// A message that names the file, line and key, or the option.
    pub fn vehicle(&self) -> Result<Vehicle, Box<dyn Error>> {
        let mut vehicle = match &self.vehicle {
            Some(path) => Vehicle::choose(path)?,
            None => default_vehicle(),
        };
        if let Some(cog) = self.cog {
            vehicle = vehicle.with_cog(cog)?;
        }
        refuse_repeated(&self.effects)?;
        for effect in &self.effects {
            if vehicle.effects().get(effect.card().id).is_some() {
                note(format_args!(
                    "--effect {effect} replaces the vehicle file's, all its parameters"
                ));
            }
            vehicle = vehicle.with_active(effect.clone());
        }
        Ok(vehicle)
    }
}

/// The vehicle where none is chosen, which is never taken in silence.
fn default_vehicle() -> Vehicle {
    say_default();
    Vehicle::auriga_alpha()
}

/// Says that the vehicle is the default one.
pub fn say_default() {
    note(format_args!(
        "vehicle: {} (default; --vehicle FILE|NAME takes another)",
        Vehicle::DEFAULT
    ));
}

/// The vehicle where its gauge alone counts.
#[derive(Args)]
#[command(next_help_heading = VEHICLE)]
pub struct GaugeOptions {
    /// Vehicle: a file (schema trackdyn.vehicle/1), or a name such as husky-a200. To identify, its
    /// gauge alone counts; a replay has its forces too
    #[arg(long, value_name = "FILE|NAME", conflicts_with = "gauge")]
    vehicle: Option<PathBuf>,
    /// Gauge alone, in place of a vehicle: distance in m between the middles of the left and the
    /// right belts or tyres
    #[arg(long, value_name = "M", value_parser = number)]
    gauge: Option<f64>,
}

impl GaugeOptions {
    /// The gauge; none where nothing is given.
    ///
    /// # Errors
    /// A message that names the file, line and key, or the option.
    pub fn gauge(&self) -> Result<Option<Gauge>, trackdyn::Error> {
        match (&self.vehicle, self.gauge) {
            (Some(path), _) => Ok(Some(Gauge::from(&Vehicle::choose(path)?))),
            (None, Some(metres)) => Gauge::new(metres).map(Some),
            (None, None) => Ok(None),
        }
    }

    /// The gauge of a command that needs one.
    ///
    /// # Errors
    /// Those of [`GaugeOptions::gauge`]; a message that names the options.
    pub fn expect_gauge(&self) -> Result<Gauge, Box<dyn Error>> {
        self.gauge()?.ok_or_else(|| "expected --vehicle FILE|NAME, or --gauge METRES".into())
    }

    /// The vehicle as an option that a user may copy; none where none is given.
    pub fn vehicle_option(&self) -> Option<String> {
        self.vehicle.as_deref().map(|path| format!("--vehicle {}", shell::path(path)))
    }

    /// The gauge as an option that a user may copy; none where it is not given alone.
    pub fn gauge_option(&self) -> Option<String> {
        self.gauge.map(|metres| shell::option("gauge", &metres.to_string()))
    }
}
