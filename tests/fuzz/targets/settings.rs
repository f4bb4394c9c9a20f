//! Settings of the methods. Those that differ from the defaults are written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_diagnose::Settings;
use trackdyn_fuzz::round_trip;

fuzz_target!(|text: &str| {
    round_trip::check(text, Settings::from_document, |all| all.differences().to_string());
});
