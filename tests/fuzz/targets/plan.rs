//! What `trackdyn plan` reads of a diagnosis file: the questions that it left open.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_core::document::Document;
use trackdyn_diagnose::plan::Question;

fuzz_target!(|text: &str| {
    let read = Question::of(&Document::new("diagnosis.toml", text));
    let _ = read.map_err(|error| error.to_string());
});
