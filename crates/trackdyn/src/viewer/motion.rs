//! Curves of motion.

use super::actor::{ROOT, plot};
use std::f64::consts::PI;
use trackdyn_core::{PerSide, Pose};
use trackdyn_export::viewer::{Curve, JointLayer, Plot, Trace};
use trackdyn_report::figure::entry_colour;

/// Title, topic and value of a quantity of a motion that lasts a time.
type Quantity = (&'static str, &'static str, fn(&Pose, f64) -> Option<f64>);

/// Mean rates of a motion. Its twist is that of a constant motion, which half turns do not tell.
pub(crate) const RATES: [Quantity; 2] = [
    ("Yaw rate [rad/s]", "yaw_rate", |motion, duration| Some(motion.yaw / duration)),
    ("Forward speed [m/s]", "forward_speed", |motion, duration| {
        (motion.yaw.abs() < PI).then(|| motion.log(duration).v_x)
    }),
];

/// Speeds of the two tracks, without readings yet.
pub(crate) fn tracks() -> JointLayer {
    JointLayer {
        topic: format!("{ROOT}/tracks"),
        names: PerSide::new("left_track".to_owned(), "right_track".to_owned()),
        ..JointLayer::default()
    }
}

/// Speeds of the two tracks as a plot.
pub(crate) fn track_speeds(tracks: &JointLayer) -> Plot {
    let curve = |name: &str, entry, value: fn(&PerSide<f64>) -> f64| Curve {
        name: name.to_owned(),
        topic: format!("{ROOT}/track_speed/{name}"),
        colour: entry_colour(entry),
        trace: Trace {
            stamps: tracks.stamps.clone(),
            values: tracks.speeds.iter().map(value).collect(),
        },
    };
    let curves = [curve("left", 1, |of| of.left), curve("right", 0, |of| of.right)];
    plot("Track speeds [m/s]", curves)
}
