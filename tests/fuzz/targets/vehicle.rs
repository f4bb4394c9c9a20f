//! Vehicle files. What is read is written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::round_trip;
use trackdyn_model::VehicleFile;

fuzz_target!(|text: &str| {
    let read = round_trip::check(text, VehicleFile::from_document, VehicleFile::to_toml);
    if let Some(file) = read {
        file.model();
    }
});
