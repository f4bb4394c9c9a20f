//! Kinematics files, and files of the distance of the ICRs alone. What is read is written and read
//! back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_core::PerSide;
use trackdyn_fuzz::round_trip;
use trackdyn_model::kinematics::{KinematicsFile, SeparationFile};

fuzz_target!(|text: &str| {
    let read = round_trip::check(text, KinematicsFile::from_document, KinematicsFile::to_toml);
    if let Some(file) = read {
        file.kinematics_at(PerSide::new(0.4, -0.3));
        file.track_speeds(0.5, 0.2);
    }
    round_trip::check(text, SeparationFile::from_document, SeparationFile::to_toml);
});
