//! Trajectories of the TUM benchmark: the trajectory, a zero byte, the table of track speeds.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_fuzz::{files, reading};
use trackdyn_recording::tum;

fuzz_target!(|input: &[u8]| {
    let [trajectory, tracks] = files::parts::<2>(input);
    let trajectory = files::file("trajectory.tum", trajectory.unwrap_or_default());
    let tracks = files::file("tracks.csv", tracks.unwrap_or_default());
    reading::table(|options| tum::read_by(&trajectory, &tracks, "robot", options));
});
