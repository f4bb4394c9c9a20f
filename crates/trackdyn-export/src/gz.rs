//! Gazebo: the `TrackedVehicle` system.

use crate::number::{metres, number};
use crate::{EquivalentDrive, Error, Name, Provenance, TextFile};
use std::fmt::Write;

/// The plugin element for a model with these track links.
///
/// # Law
/// The system commands V_r,l = v ± ω s/(2 χ), with s its `tracks_separation` and χ its
/// `steering_efficiency`: equations (10)-(11) of the paper for symmetric ICRs.
///
/// # Errors
/// [`Error::Repeated`].
///
/// # Sources
/// gz-sim, `src/systems/tracked_vehicle/TrackedVehicle.cc`.
pub fn plugin(
    drive: &EquivalentDrive,
    left: &[Name],
    right: &[Name],
    provenance: &Provenance,
) -> Result<TextFile, Error> {
    Name::all_differ("left-track, --right-track", left, right)?;
    let (separation, [x, y]) = (metres(drive.separation), drive.point);
    let (x, y) = (metres(x), metres(y));
    let mut notes = format!(
        "Put this into the <model>, beside one TrackController system per track.\n\
         tracks_separation (m): gauge = steering_efficiency * (x_icr_right_m - x_icr_left_m).\n\
         What the system cannot carry:\n\
         - eccentricity and y_icr_m: commands are those of the point midway between the ICRs, from \
           the\n  \
           centre of the tracks' contact area {x} m forward and\n  \
           {y} m left, not of the model's origin;\n\
         - steering_efficiency in its own odometry: that of a differential drive with wheels\n  \
           tracks_separation apart, whose yaw rate is too large by 1/steering_efficiency. Where \
           that\n  \
           odometry is used, write tracks_separation {separation} and\n  \
           steering_efficiency 1.0: the same commands, and odometry that agrees with them.\n"
    );
    if (drive.alpha.left, drive.alpha.right) != (1.0, 1.0) {
        let (left, right) = (number(drive.alpha.left), number(drive.alpha.right));
        let _ = writeln!(
            notes,
            "- alpha_left {left} and alpha_right {right}: the system's tracks run at the speeds it \
             commands."
        );
    }
    let mut text = provenance.xml_comment(&notes);
    text += &element(drive, left, right, "");
    Ok(TextFile { name: "tracked_vehicle.sdf", text })
}

/// The plugin element, each line behind an indent.
pub(crate) fn element(
    drive: &EquivalentDrive,
    left: &[Name],
    right: &[Name],
    indent: &str,
) -> String {
    let mut text = format!(
        "{indent}<plugin filename=\"gz-sim-tracked-vehicle-system\" \
         name=\"gz::sim::systems::TrackedVehicle\">\n"
    );
    for (element, names) in [("left_track", left), ("right_track", right)] {
        for name in names {
            let _ = writeln!(
                text,
                "{indent}  <{element}>\n{indent}    <link>{name}</link>\n{indent}  </{element}>"
            );
        }
    }
    let (gauge, efficiency) = (number(drive.gauge), number(drive.steering_efficiency()));
    let _ = writeln!(text, "{indent}  <tracks_separation>{gauge}</tracks_separation>");
    let _ = writeln!(text, "{indent}  <steering_efficiency>{efficiency}</steering_efficiency>");
    text + indent + "</plugin>\n"
}
