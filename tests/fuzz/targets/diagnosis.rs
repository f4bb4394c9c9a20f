//! Diagnosis files. What is read is written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_core::document::{Document, DocumentError};
use trackdyn_diagnose::DiagnosisFile;
use trackdyn_fuzz::round_trip;

/// A file, which is equal to another where both are shown alike.
#[derive(Debug)]
struct Shown(DiagnosisFile);

impl PartialEq for Shown {
    fn eq(&self, other: &Self) -> bool {
        format!("{self:?}") == format!("{other:?}")
    }
}

fn read(document: &Document) -> Result<Shown, DocumentError> {
    DiagnosisFile::from_document(document).map(Shown)
}

fuzz_target!(|text: &str| {
    if let Some(Shown(file)) = round_trip::check(text, read, |file| file.0.to_toml()) {
        let _ = file.noise.map(|noise| noise.noise());
    }
});
