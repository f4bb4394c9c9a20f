//! What was done to files, as lines on stderr.

use crate::stderr::{say, warn};
use std::path::Path;
use trackdyn::Change;

/// Names the files that were written.
pub fn say_written(changes: &[Change]) {
    for path in written(changes) {
        say(format_args!("wrote {}", path.display()));
    }
}

/// The files that were written.
pub fn written(changes: &[Change]) -> impl Iterator<Item = &Path> {
    changes.iter().filter(|change| matches!(change, Change::Wrote(_))).map(Change::path)
}

/// Names the files that were removed.
pub fn say_removed(changes: &[Change]) {
    for path in removed(changes) {
        say(format_args!("removed {}, of an earlier run", path.display()));
    }
}

/// Names the kinematics files that were removed, because this run determines no parameters.
pub fn say_undetermined(changes: &[Change]) {
    for path in removed(changes) {
        let path = path.display();
        say(format_args!("removed {path}, of an earlier run: this one has none"));
    }
}

fn removed(changes: &[Change]) -> impl Iterator<Item = &Path> {
    changes.iter().filter(|change| matches!(change, Change::Removed(_))).map(Change::path)
}

/// Says that other parts of the answer that the parameters of a file come from contradict them.
pub fn say_doubtful(name: &str) {
    warn(format_args!(
        "{name} is doubtful: what it was identified from contradicts it, and it was \
        written with --force"
    ));
}
