//! URDF: the ICR frame as the new root link of the robot.

use crate::number::metres;
use crate::{EquivalentDrive, Frames, Provenance, TextFile};

/// A xacro fragment with the ICR link and the fixed joint that carries the base link.
pub fn fragment(drive: &EquivalentDrive, frames: &Frames, provenance: &Provenance) -> TextFile {
    let (icr, odom, base) = (frames.icr(), frames.odom(), frames.base());
    let pose = frames.icr_from_base(drive);
    let (x, y) = (metres(pose.x), metres(pose.y));
    let notes = format!(
        "{icr} is the point midway between the ICRs of the tracks, at which the robot moves as an \
         ideal\n\
         differential drive. It becomes the root: a controller with base_frame_id {icr} publishes\n\
         {odom} -> {icr}, and a link has one parent. {base} must be the root of the robot's URDF\n\
         until now. Include this file, or launch icr_frame.launch.py, not both.\n"
    );
    let comment = provenance.xml_comment(&notes);
    let text = format!(
        "<?xml version=\"1.0\"?>
{comment}<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">
  <link name=\"{icr}\"/>
  <joint name=\"{icr}_to_{base}\" type=\"fixed\">
    <parent link=\"{icr}\"/>
    <child link=\"{base}\"/>
    <origin xyz=\"{x} {y} 0.0\" rpy=\"0.0 0.0 0.0\"/>
  </joint>
</robot>
"
    );
    TextFile { name: "icr_frame.urdf.xacro", text }
}
