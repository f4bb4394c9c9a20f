//! Public recordings of real robots, which the project does not carry: `TRACKDYN_DATA` names their folder, else
//! it is `../shared/data` beside the checkout. Without them tests say that they skip.
//!
//! Source: norlab-ulaval DRIVE (BSD-3-Clause).

use std::path::{Path, PathBuf};
use trackdyn_identify::genetic::GeneticOptions;
use trackdyn_identify::identification::{Options, identify};
use trackdyn_identify::{Identification, Nuisance};
use trackdyn_recording::recording::Cells;
use trackdyn_recording::rosbag::RosbagOptions;
use trackdyn_recording::{Recording, Run, RunList};

/// Reads a recording; none where it is not at hand.
pub fn read(name: &str) -> Option<Recording> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("TRACKDYN_DATA").map_or_else(beside, PathBuf::from).join(name);
    if !folder.is_dir() {
        println!("skipped: {name} is not there (TRACKDYN_DATA names the folder of recordings)");
        return None;
    }
    Some(trackdyn_recording::read(&folder, &RosbagOptions::default()).expect(name))
}

/// All methods on a recording of a vehicle with this gauge, m; these fitted beside the ICRs.
pub fn identified(recording: &Recording, gauge: f64, nuisances: &[Nuisance]) -> Identification {
    // Least squares does not hang on the genetic algorithm.
    let genetic = GeneticOptions { generations: 1, ..GeneticOptions::default() };
    let options =
        Options { gauge, tau: None, settle: None, nuisances: nuisances.to_vec(), genetic };
    identify(recording, &options, &|_| ()).expect("enough segments")
}

/// The runs that are marked as steady from their first reading to their last.
pub fn steady(recording: &Recording) -> RunList {
    let is_steady = |run: &&Run| {
        let mut columns = run.track_series().extra.iter();
        let marks = columns.find(|column| column.name == "steady").map(|column| &column.cells);
        matches!(marks, Some(Cells::Numbers(marks)) if marks.iter().all(|mark| *mark == 1.0))
    };
    RunList::new(recording.runs().iter().filter(is_steady).map(Run::id))
}

/// The runs whose readings are 0.05 s apart on the mean, within 1 %.
pub fn at_20_hertz(recording: &Recording) -> RunList {
    let is_right = |run: &&Run| {
        #[expect(clippy::cast_precision_loss, reason = "40 readings")]
        let intervals = (run.tracks().len() - 1) as f64;
        (run.duration() / intervals / 0.05 - 1.0).abs() < 0.01
    };
    RunList::new(recording.runs().iter().filter(is_right).map(Run::id))
}
