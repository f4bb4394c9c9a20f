//! Schedules. What is read is written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_drive::schedules;
use trackdyn_fuzz::files;

fuzz_target!(|input: &[u8]| {
    match schedules::read(&files::file("schedule.csv", input)) {
        Ok(runs) => {
            let copy = files::file("copy.csv", schedules::text(&runs).as_bytes());
            assert_eq!(schedules::read(&copy).expect("readable"), runs);
        }
        Err(error) => drop(error.to_string()),
    }
});
