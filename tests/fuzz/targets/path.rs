//! Paths to follow. What is read is written and read back.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trackdyn_drive::Path;
use trackdyn_fuzz::files;

fuzz_target!(|input: &[u8]| {
    match Path::read(&files::file("path.csv", input)) {
        Ok(path) => {
            let copy = files::file("copy.csv", path.to_csv().as_bytes());
            assert_eq!(Path::read(&copy).expect("readable"), path);
        }
        Err(error) => drop(error.to_string()),
    }
});
