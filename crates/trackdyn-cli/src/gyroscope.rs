//! What gyroscopes do to poses, as lines on stderr.

use crate::stderr::note;
use trackdyn::Recording;
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

/// Says what each gyroscope that is not used would tell; `tau` is the time by which poses lag
/// behind the track speeds, s, where it is known.
pub fn say_unused_gyroscopes(recordings: &[Recording], tau: Option<f64>) {
    for recording in recordings {
        if let Some(Ok(found)) = recording.with_gyroscope(tau).gyroscope() {
            let name = recording.name();
            note(format_args!("{name}: its gyroscope is not used; with --gyroscope {found}"));
        }
    }
}
