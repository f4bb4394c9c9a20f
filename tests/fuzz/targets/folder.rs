//! Recording folders: `recording.toml`, `tracks.csv`, `poses.csv`, `imu.csv`, with a zero byte
//! between them.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::{files, reading};
use trackdyn_recording::folder;

const NAMES: [&str; 4] = ["recording.toml", "tracks.csv", "poses.csv", "imu.csv"];

fuzz_target!(|input: &[u8]| {
    for (name, part) in NAMES.iter().zip(files::parts::<4>(input)) {
        match part {
            Some(bytes) => files::file(name, bytes),
            None => files::no_file(name),
        };
    }
    let place = files::folder();
    reading::table(|options| folder::read_by(&place, options));
    // What was read is written, and can be read.
    if let Ok(recording) = folder::read(&place) {
        let copy = place.join("copy");
        folder::write(&recording, &copy).expect("written");
        reading::table(|options| folder::read_by(&copy, options));
    }
});
