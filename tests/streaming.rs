//! Bags are read as a stream: memory does not grow with the file.

#[path = "../benches/bags/bag.rs"]
mod bag;

use trackdyn_recording::rosbag::{self, RosbagOptions};

/// Largest memory of this process so far, MiB; none where the system does not tell.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? / 1024)
}

#[test]
fn a_gigabyte_takes_little_memory() {
    let place = tempfile::tempdir().expect("a temporary folder");
    let path = place.path().join("big.mcap");
    bag::write(&path, None, 100_000).expect("written");
    let size = std::fs::metadata(&path).expect("there").len();
    assert!(size > 1_000_000_000, "{size}");
    let Some(before) = peak() else {
        println!("skipped: this system does not tell the memory of a process");
        return;
    };
    rosbag::inspect(&path).expect("readable");
    let inspected = peak().expect("told before");
    let options = RosbagOptions { wheel_radius: Some(0.1), ..RosbagOptions::default() };
    let recording = rosbag::read(&path, &options).expect("readable");
    assert_eq!(recording.runs()[0].tracks().len(), 100_000);
    let read = peak().expect("told before");
    println!("{before} MiB, then {inspected} inspected, then {read} read");
    // a piece of the file, a chunk of it and a message, 1 MB each
    assert!(inspected - before < 16, "{} MiB", inspected - before);
    // and 140,000 samples, three times over: as they are read, as a run, and while that grows
    assert!(read - before < 64, "{} MiB", read - before);
}
