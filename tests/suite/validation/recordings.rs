//! What is identified from public recordings of real robots.
//!
//! Source: norlab-ulaval DRIVE (BSD-3-Clause).

use trackdyn_estimate::genetic::GeneticOptions;
use trackdyn_estimate::identification::{Options, identify};
use trackdyn_estimate::{Identification, Nuisance};
use trackdyn_recording::sample::Cells;
use trackdyn_recording::{Recording, Run, RunList};

/// All methods on a recording of a vehicle with this gauge, m; these fitted beside the ICRs.
pub fn identified(recording: &Recording, gauge: f64, nuisances: &[Nuisance]) -> Identification {
    // Least squares does not depend on the genetic algorithm.
    let genetic = GeneticOptions { generations: 1, ..GeneticOptions::default() };
    let options = Options { nuisances: nuisances.to_vec(), genetic, ..Options::new(gauge) };
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
