//! How fast recordings are read: makes a folder and bags of some 100 MB and times the readers, or
//! times the inspection of the bag that is named.
//!
//! `cargo run --release -p trackdyn-benches --bin bags [bag]`

mod bag;

use std::error::Error;
use std::path::Path;
use std::time::Instant;
use trackdyn_estimate::synthetic::{Synthetic, random_steps};
use trackdyn_recording::rosbag::RosbagOptions;
use trackdyn_recording::{folder, rosbag};

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(bag) = std::env::args_os().nth(1) {
        let bag = Path::new(&bag);
        return time("inspection", megabytes(bag)?, || rosbag::inspect(bag).map(drop));
    }
    let place = tempfile::tempdir()?;
    let synthetic = Synthetic {
        schedules: (0..4).map(|run| random_steps(3_000, 6.0, 1.0, run)).collect(),
        encoder_noise: 0.05,
        position_noise: 0.005,
        yaw_noise: 0.002,
        ..Synthetic::default()
    };
    let csv = place.path().join("folder");
    folder::write(&synthetic.recording()?, &csv)?;
    let size = megabytes(&csv.join("tracks.csv"))? + megabytes(&csv.join("poses.csv"))?;
    time("CSV", size, || folder::read(&csv).map(drop))?;

    let path = place.path().join("bag.mcap");
    let options = RosbagOptions { wheel_radius: Some(0.1), ..RosbagOptions::default() };
    for lidar in [false, true] {
        let content = if lidar { "joints, odometry and lidar" } else { "joints and odometry" };
        let cloud = if lidar { 20_000 } else { 0 };
        bag::write(&path, None, cloud)?;
        let raw = megabytes(&path)?;
        time(&format!("mcap, {content}"), raw, || rosbag::read(&path, &options).map(drop))?;
        for compression in [mcap::Compression::Lz4, mcap::Compression::Zstd] {
            bag::write(&path, Some(compression), cloud)?;
            let what = format!("mcap, {content}, {compression:?} ({:.0} MB)", megabytes(&path)?);
            time(&what, raw, || rosbag::read(&path, &options).map(drop))?;
        }
    }
    Ok(())
}

/// Best of five.
fn time(
    what: &str,
    size: f64,
    mut read: impl FnMut() -> Result<(), trackdyn_recording::Error>,
) -> Result<(), Box<dyn Error>> {
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        read()?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    println!("{what}: {size:.0} MB in {best:.3} s, {:.0} MB/s", size / best);
    Ok(())
}

fn megabytes(path: &Path) -> Result<f64, Box<dyn Error>> {
    Ok(f64::from(u32::try_from(std::fs::metadata(path)?.len() / 1000)?) / 1000.0)
}
