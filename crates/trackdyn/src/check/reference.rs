//! Reference files, schema `trackdyn.reference/1`.

use crate::Error;
use crate::vehicle::repeated;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::real;
use trackdyn_model::map::{GridError, Statistics};
use trackdyn_model::{ActiveEffect, Grid};

const SCHEMA: &str = "trackdyn.reference/1";

/// ICRs of vehicles with the tolerances that they must keep (schema `trackdyn.reference/1`).
#[derive(Clone, Debug)]
pub struct Reference {
    /// The file as given.
    pub path: PathBuf,
    /// Track speeds of every case.
    pub grid: Grid,
    /// The cases, in the file's order.
    pub cases: Vec<Case>,
}

/// One vehicle and the numbers that it must give.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name in the table.
    pub name: String,
    /// Vehicle file, relative to the reference file.
    pub vehicle: Option<PathBuf>,
    /// Centre of gravity that replaces the vehicle's, m.
    pub cog: Option<[f64; 2]>,
    /// Effects on top of the vehicle's own.
    pub effects: Vec<ActiveEffect>,
    /// What must come out.
    pub expect: Vec<(Quantity, Expected)>,
}

/// A number and how far off it may be.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// The number.
    pub value: f64,
    /// Largest deviation.
    pub tolerance: f64,
}

/// A number of a kinematics file.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    key: &'static str,
    of: fn(&Statistics) -> f64,
    of_none: f64,
}

/// The quantities that can be checked, under their names in `kinematics.toml`; and how many pairs
/// of speeds turn.
const QUANTITIES: [Quantity; 8] = [
    Quantity::mean("x_icr_left_m", |s| s.mean.x_left),
    Quantity::mean("x_icr_right_m", |s| s.mean.x_right),
    Quantity::mean("y_icr_m", |s| s.mean.y),
    Quantity::mean("steering_efficiency", |s| s.steering_efficiency),
    Quantity::mean("eccentricity", |s| s.eccentricity),
    Quantity::mean("mean_steering_efficiency", |s| s.mean_steering_efficiency),
    Quantity::mean("mean_eccentricity", |s| s.mean_eccentricity),
    Quantity { key: "turning_pairs", of: |s| real(s.count), of_none: 0.0 },
];

impl Quantity {
    /// Name in files.
    pub fn key(&self) -> &'static str {
        self.key
    }

    /// A mean, which is no number where nothing turns.
    const fn mean(key: &'static str, of: fn(&Statistics) -> f64) -> Self {
        Self { key, of, of_none: f64::NAN }
    }

    /// Its value in a map; none: of one in which no motion turns.
    pub fn of(&self, statistics: Option<&Statistics>) -> f64 {
        statistics.map_or(self.of_none, self.of)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    schema: Spanned<String>,
    grid: Spanned<usize>,
    #[serde(default = "paper_speed")]
    max_speed_m_s: Spanned<f64>,
    case: Vec<CaseTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseTable {
    name: String,
    vehicle: Option<PathBuf>,
    cog_m: Option<Spanned<Vec<f64>>>,
    #[serde(default)]
    effects: Vec<Spanned<String>>,
    expect: Spanned<BTreeMap<Spanned<String>, Spanned<Expected>>>,
}

fn paper_speed() -> Spanned<f64> {
    Spanned::new(0..0, Grid::PAPER_SPEED)
}

impl Reference {
    /// Reads and checks a reference file.
    ///
    /// # Errors
    /// [`Error::Document`], which names file, line and key.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Ok(Self::from_document(&Document::read(path)?, path)?)
    }

    fn from_document(document: &Document, path: &Path) -> Result<Self, DocumentError> {
        let tables: Tables = document.parse_as(SCHEMA)?;
        let (points, speed) = (*tables.grid.get_ref(), *tables.max_speed_m_s.get_ref());
        let grid = Grid::new(points, speed).map_err(|error| {
            let (key, span) = match error {
                GridError::Speed(_) => ("max_speed_m_s", tables.max_speed_m_s.span()),
                _ => ("grid", tables.grid.span()),
            };
            document.value_error(span, key, error.expected())
        })?;
        if tables.case.is_empty() {
            let expected = "a file with a [[case]]: nothing would be checked";
            return Err(document.value_error(tables.schema.span(), "schema", expected));
        }
        let cases = tables
            .case
            .into_iter()
            .map(|table| table.case(document))
            .collect::<Result<Vec<Case>, DocumentError>>()?;
        Ok(Self { path: path.to_owned(), grid, cases })
    }
}

impl CaseTable {
    fn case(self, document: &Document) -> Result<Case, DocumentError> {
        let effects = self
            .effects
            .iter()
            .map(|text| {
                text.get_ref()
                    .parse::<ActiveEffect>()
                    .map_err(|error| document.value_error(text.span(), "effects", error.expected()))
            })
            .collect::<Result<Vec<ActiveEffect>, DocumentError>>()?;
        if let Some(place) = repeated(&effects) {
            let expected = "each effect once, with all its parameters";
            return Err(document.value_error(self.effects[place].span(), "effects", expected));
        }
        if self.expect.get_ref().is_empty() {
            let keys = QUANTITIES.map(|quantity| quantity.key).join(", ");
            let expected = format!("at least one of {keys}: nothing would be checked");
            return Err(document.value_error(self.expect.span(), "expect", expected));
        }
        let expect = self
            .expect
            .get_ref()
            .iter()
            .map(|(key, expected)| {
                let name = key.get_ref();
                let quantity = QUANTITIES.into_iter().find(|q| q.key == name).ok_or_else(|| {
                    let keys = QUANTITIES.map(|quantity| quantity.key).join(", ");
                    document.value_error(key.span(), "expect", format!("one of {keys}"))
                })?;
                let Expected { value, tolerance } = *expected.get_ref();
                if !(value.is_finite() && tolerance.is_finite() && tolerance >= 0.0) {
                    let expected_text = "a finite value and a finite tolerance, not negative";
                    return Err(document.value_error(expected.span(), name, expected_text));
                }
                Ok((quantity, Expected { value, tolerance }))
            })
            .collect::<Result<_, _>>()?;
        let cog = self.cog_m.map(|list| document.numbers("cog_m", &list)).transpose()?;
        Ok(Case { name: self.name, vehicle: self.vehicle, cog, effects, expect })
    }
}
