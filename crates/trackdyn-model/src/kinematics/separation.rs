//! The distance between the ICRs as a file, where a recording tells no more.

use super::file::Source;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_core::rounding::Digits;

/// What such a file says it is.
const SCHEMA: &str = "trackdyn.separation/1";

/// Digits of the numbers of a file.
const DIGITS: Digits = Digits::Decimals(9);

/// The distance x_r − x_l of the ICRs alone (schema `trackdyn.separation/1`): x_l, x_r and y are
/// open.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeparationFile {
    schema: String,
    /// x_r − x_l, m.
    pub icr_separation_m: Spanned<f64>,
    /// Lower end of its 95 % interval, m.
    pub low95_m: f64,
    /// Upper end of its 95 % interval, m.
    pub high95_m: f64,
    /// χ.
    pub steering_efficiency: Spanned<f64>,
    /// Gauge L of the vehicle, m.
    pub gauge_m: Spanned<f64>,
    /// Where the numbers come from.
    pub source: Source,
}

impl SeparationFile {
    /// The file of a distance with the ends of its 95 % interval, m, on a vehicle with this gauge,
    /// m.
    pub fn new(separation: f64, [low, high]: [f64; 2], gauge: f64, source: Source) -> Self {
        let unplaced = |value| Spanned::new(0..0, DIGITS.round(value));
        Self {
            schema: SCHEMA.to_owned(),
            icr_separation_m: unplaced(separation),
            low95_m: DIGITS.round(low),
            high95_m: DIGITS.round(high),
            // χ = L/(x_r − x_l), eq. (12)
            steering_efficiency: unplaced(gauge / separation),
            gauge_m: unplaced(gauge),
            source,
        }
    }

    /// Whether a document says that it is such a file.
    pub fn is_schema_of(document: &Document) -> bool {
        #[derive(Deserialize)]
        struct Head {
            schema: String,
        }
        document.parse::<Head>().is_ok_and(|head| head.schema == SCHEMA)
    }

    /// Reads and checks a file.
    ///
    /// # Errors
    /// A [`DocumentError`] that points at the line and key.
    pub fn from_document(document: &Document) -> Result<Self, DocumentError> {
        let file: Self = document.parse_as(SCHEMA)?;
        let lengths = [("icr_separation_m", &file.icr_separation_m), ("gauge_m", &file.gauge_m)];
        for (key, length) in lengths {
            if !(*length.get_ref() > 0.0 && length.get_ref().is_finite()) {
                return Err(document.value_error(length.span(), key, "a length in m above 0"));
            }
        }
        Ok(file)
    }

    /// The file's text.
    ///
    /// # Panics
    /// Never: the fields hold only what TOML can say.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("numbers, texts and tables are TOML")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_as_it_was_written_and_bad_lengths_are_refused() {
        let file = SeparationFile::new(1.02, [1.01, 1.03], 0.555, Source::default());
        let text = file.to_toml();
        let document = Document::new("kinematics.toml", text.clone());
        assert!(SeparationFile::is_schema_of(&document));
        let read = SeparationFile::from_document(&document).expect("a file");
        assert_eq!((read.to_toml(), *read.icr_separation_m.get_ref()), (text.clone(), 1.02));
        let bad =
            Document::new("k", text.replace("icr_separation_m = 1.02", "icr_separation_m = -1"));
        let error = SeparationFile::from_document(&bad).expect_err("no length").to_string();
        assert!(error.contains("icr_separation_m = -1"), "{error}");
    }
}
