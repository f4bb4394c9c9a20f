//! `.mcap` files of any bytes.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::{files, reading};

fuzz_target!(|input: &[u8]| {
    reading::bag(&files::file("bag.mcap", input), reading::Wanted::default());
});
