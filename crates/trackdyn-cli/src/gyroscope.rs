//! What gyroscopes do to poses, as lines on stderr.

use crate::stderr::note;
use trackdyn::crates::estimate::Gyroscope;
use trackdyn::crates::estimate::gyroscope::Unfit;

/// Says what each gyroscope tells of the yaw of the poses, or why it is left out.
pub fn say_gyroscopes<'a>(found: impl IntoIterator<Item = &'a Result<Gyroscope, Unfit>>) {
    for gyroscope in found {
        match gyroscope {
            Ok(gyroscope) => note(format_args!("by the gyroscope, {gyroscope}")),
            Err(reason) => note(format_args!("the gyroscope is left out: {reason}")),
        }
    }
}
