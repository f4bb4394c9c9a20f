//! The vehicle file, schema `trackdyn.vehicle/1`.

use crate::contact::Friction;
use crate::effects::{ActiveEffect, EffectError, Effects};
use crate::kinematics::Source;
use crate::model::Model;
use crate::vehicle::{FrictionUncertainty, RunningGear, Uncertainty, Vehicle};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};

const SCHEMA: &str = "trackdyn.vehicle/1";

/// A vehicle and the active effects of its file. Two are equal wherever their numbers come from.
#[derive(Clone, Debug)]
pub struct VehicleFile {
    /// The vehicle.
    pub vehicle: Vehicle,
    /// The `[effect.<id>]` tables.
    pub effects: Effects,
    /// The driving that it was corrected by; none of a vehicle that was measured or assumed.
    pub source: Option<Source>,
}

impl PartialEq for VehicleFile {
    fn eq(&self, other: &Self) -> bool {
        self.vehicle == other.vehicle && self.effects == other.effects
    }
}

impl VehicleFile {
    /// Auriga-alpha, the vehicle of the paper, as in `configs/vehicles/auriga-alpha.toml`.
    ///
    /// # Panics
    /// Never: the file is embedded, and a test reads it.
    pub fn auriga_alpha() -> Self {
        let document =
            Document::new("auriga-alpha.toml (embedded)", include_str!("auriga-alpha.toml"));
        match Self::from_document(&document) {
            Ok(file) => file,
            Err(error) => panic!("{error}"),
        }
    }

    /// Reads and checks a vehicle file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at the line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        let tables: Tables = document.parse_as(SCHEMA)?;
        let vehicle = tables.vehicle(document)?;
        if let Err(problem) = vehicle.check() {
            return Err(document.value_error(
                tables.span_of(problem.key),
                problem.key,
                problem.expected,
            ));
        }
        let effects = tables.effects(document)?;
        Ok(Self { vehicle, effects, source: tables.source })
    }

    /// The balance of forces on it.
    pub fn model(&self) -> Model {
        Model::new(self.vehicle.clone(), self.effects.clone())
    }

    /// The file as text, with keys in a fixed order: equal vehicles of one source have equal texts.
    ///
    /// # Panics
    /// Never: all values can be written as TOML.
    pub fn to_toml(&self) -> String {
        let vehicle = &self.vehicle;
        let uncertainty = &vehicle.uncertainty;
        let (track, wheels) = match &vehicle.running_gear {
            RunningGear::Track { contact_length, belt_width } => (
                Some(Track {
                    contact_length_m: unplaced(*contact_length),
                    belt_width_m: unplaced(*belt_width),
                }),
                None,
            ),
            RunningGear::Wheels { contact_length, width, axles } => (
                None,
                Some(Wheels {
                    contact_length_m: unplaced(*contact_length),
                    width_m: unplaced(*width),
                    axles_m: unplaced(axles.clone()),
                }),
            ),
        };
        let tables = Tables {
            schema: unplaced(SCHEMA.to_owned()),
            name: unplaced(vehicle.name.clone()),
            mass_kg: unplaced(vehicle.mass),
            mass_kg_sd: uncertainty.mass.map(unplaced),
            gauge_m: unplaced(vehicle.gauge),
            gauge_m_sd: uncertainty.gauge.map(unplaced),
            cog_m: unplaced(vehicle.cog.to_vec()),
            cog_m_sd: uncertainty.cog.map(|cog| unplaced(cog.to_vec())),
            track,
            wheels,
            friction: FrictionTable {
                mu_x: unplaced(vehicle.friction.across),
                mu_x_sd: uncertainty.friction.across.map(unplaced),
                mu_y: unplaced(vehicle.friction.along),
                mu_y_sd: uncertainty.friction.along.map(unplaced),
            },
            effect: self
                .effects
                .iter()
                .map(|effect| {
                    let table = effect
                        .stated()
                        .map(|(parameter, value)| {
                            (unplaced(parameter.key.to_owned()), unplaced(value))
                        })
                        .collect();
                    (unplaced(effect.card().id.to_owned()), table)
                })
                .collect(),
            source: self.source.clone(),
        };
        toml::to_string(&tables).expect("numbers, texts and tables are TOML")
    }
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    schema: Spanned<String>,
    name: Spanned<String>,
    mass_kg: Spanned<f64>,
    mass_kg_sd: Option<Spanned<f64>>,
    gauge_m: Spanned<f64>,
    gauge_m_sd: Option<Spanned<f64>>,
    cog_m: Spanned<Vec<f64>>,
    cog_m_sd: Option<Spanned<Vec<f64>>>,
    track: Option<Track>,
    wheels: Option<Wheels>,
    friction: FrictionTable,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    effect: BTreeMap<Spanned<String>, BTreeMap<Spanned<String>, Spanned<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<Source>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Track {
    contact_length_m: Spanned<f64>,
    belt_width_m: Spanned<f64>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Wheels {
    contact_length_m: Spanned<f64>,
    width_m: Spanned<f64>,
    axles_m: Spanned<Vec<f64>>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct FrictionTable {
    mu_x: Spanned<f64>,
    mu_x_sd: Option<Spanned<f64>>,
    mu_y: Spanned<f64>,
    mu_y_sd: Option<Spanned<f64>>,
}

/// A value that is never written to a file.
fn unplaced<T>(value: T) -> Spanned<T> {
    Spanned::new(0..0, value)
}

/// A value that a file may omit.
fn optional<T: Copy>(value: Option<&Spanned<T>>) -> Option<T> {
    value.map(|value| *value.get_ref())
}

impl Tables {
    fn vehicle(&self, document: &Document) -> Result<Vehicle, DocumentError> {
        let running_gear = match (&self.track, &self.wheels) {
            (Some(track), None) => RunningGear::Track {
                contact_length: *track.contact_length_m.get_ref(),
                belt_width: *track.belt_width_m.get_ref(),
            },
            (None, Some(wheels)) => RunningGear::Wheels {
                contact_length: *wheels.contact_length_m.get_ref(),
                width: *wheels.width_m.get_ref(),
                axles: wheels.axles_m.get_ref().clone(),
            },
            (Some(_), Some(wheels)) => {
                let span = wheels.contact_length_m.span();
                let expected = "either [track] or [wheels], not both";
                return Err(document.value_error(span, "wheels.contact_length_m", expected));
            }
            (None, None) => {
                let expected = "a table [track] or [wheels] beside it: what touches the ground";
                return Err(document.value_error(self.gauge_m.span(), "gauge_m", expected));
            }
        };
        let cog_sd = self.cog_m_sd.as_ref().map(|list| document.numbers("cog_m_sd", list));
        Ok(Vehicle {
            name: self.name.get_ref().clone(),
            mass: *self.mass_kg.get_ref(),
            gauge: *self.gauge_m.get_ref(),
            cog: document.numbers("cog_m", &self.cog_m)?,
            running_gear,
            friction: Friction {
                across: *self.friction.mu_x.get_ref(),
                along: *self.friction.mu_y.get_ref(),
            },
            uncertainty: Uncertainty {
                mass: optional(self.mass_kg_sd.as_ref()),
                gauge: optional(self.gauge_m_sd.as_ref()),
                cog: cog_sd.transpose()?,
                friction: FrictionUncertainty {
                    across: optional(self.friction.mu_x_sd.as_ref()),
                    along: optional(self.friction.mu_y_sd.as_ref()),
                },
            },
        })
    }

    fn effects(&self, document: &Document) -> Result<Effects, DocumentError> {
        self.effect
            .iter()
            .map(|(id, parameters)| {
                let settings: Vec<(&str, f64)> = parameters
                    .iter()
                    .map(|(key, value)| (key.get_ref().as_str(), *value.get_ref()))
                    .collect();
                ActiveEffect::new(id.get_ref(), &settings).map_err(|error| {
                    let key = match &error {
                        EffectError::OutOfRange { parameter, .. } => Some(parameter.key),
                        EffectError::UnknownParameter { key, .. } => Some(key.as_str()),
                        _ => None,
                    };
                    let parameter = parameters.iter().find(|(k, _)| key == Some(k.get_ref()));
                    let place = format!("effect.{}", id.get_ref());
                    match parameter {
                        Some((key, value)) => document.value_error(
                            value.span(),
                            format!("{place}.{}", key.get_ref()),
                            error.expected(),
                        ),
                        None => document.value_error(id.span(), place, error.expected()),
                    }
                })
            })
            .collect()
    }

    /// Position in the file of a value that [`Vehicle::check`] names.
    fn span_of(&self, key: &str) -> Range<usize> {
        let (table, name) = key.split_once('.').unwrap_or(("", key));
        let span = match (table, name) {
            ("", "name") => Some(self.name.span()),
            ("", "mass_kg") => Some(self.mass_kg.span()),
            ("", "mass_kg_sd") => self.mass_kg_sd.as_ref().map(Spanned::span),
            ("", "gauge_m") => Some(self.gauge_m.span()),
            ("", "gauge_m_sd") => self.gauge_m_sd.as_ref().map(Spanned::span),
            ("", "cog_m") => Some(self.cog_m.span()),
            ("", "cog_m_sd") => self.cog_m_sd.as_ref().map(Spanned::span),
            ("track", "contact_length_m") => self.track.as_ref().map(|t| t.contact_length_m.span()),
            ("track", "belt_width_m") => self.track.as_ref().map(|t| t.belt_width_m.span()),
            ("wheels", "contact_length_m") => {
                self.wheels.as_ref().map(|w| w.contact_length_m.span())
            }
            ("wheels", "width_m") => self.wheels.as_ref().map(|w| w.width_m.span()),
            ("wheels", "axles_m") => self.wheels.as_ref().map(|w| w.axles_m.span()),
            ("friction", "mu_x") => Some(self.friction.mu_x.span()),
            ("friction", "mu_x_sd") => self.friction.mu_x_sd.as_ref().map(Spanned::span),
            ("friction", "mu_y") => Some(self.friction.mu_y.span()),
            ("friction", "mu_y_sd") => self.friction.mu_y_sd.as_ref().map(Spanned::span),
            _ => None,
        };
        span.unwrap_or(0..0)
    }
}
