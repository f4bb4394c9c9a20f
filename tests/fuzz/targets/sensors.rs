//! Files of sensors. What is read is written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_drive::Sensors;
use trackdyn_fuzz::round_trip;

fuzz_target!(|text: &str| {
    round_trip::check(text, Sensors::from_document, Sensors::to_toml);
});
