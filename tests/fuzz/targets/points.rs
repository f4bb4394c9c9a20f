//! Tables of steady operating points.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::files;
use trackdyn_recording::OperatingPoints;

fuzz_target!(|input: &[u8]| {
    let _ = OperatingPoints::read(&files::file("points.csv", input)).map_err(|e| e.to_string());
});
