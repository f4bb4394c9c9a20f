//! What gyroscopes do to poses, as lines on stderr.

use crate::stderr::say;
use trackdyn::crates::estimate::Gyroscope;
use trackdyn::crates::estimate::gyroscope::Unfit;

/// Says what each gyroscope tells of the yaw of the poses, or why it is left out.
pub fn say_gyroscopes<'a>(found: impl IntoIterator<Item = &'a Result<Gyroscope, Unfit>>) {
    for gyroscope in found {
        match gyroscope {
            Ok(gyroscope) => say(format_args!("note: by the gyroscope, {gyroscope}")),
            Err(reason) => say(format_args!("note: the gyroscope is left out: {reason}")),
        }
    }
}
