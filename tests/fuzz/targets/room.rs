//! Room files. What is read is written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::round_trip;
use trackdyn_localisation::Room;

fuzz_target!(|text: &str| {
    round_trip::check(text, Room::from_document, Room::to_toml);
});
