//! A launch file with the static transform between the ICR frame and the base frame.

use crate::number::metres;
use crate::{EquivalentDrive, Frames, Provenance, TextFile};

/// The launch file.
pub(super) fn launch_file(
    drive: &EquivalentDrive,
    frames: &Frames,
    provenance: &Provenance,
) -> TextFile {
    let (icr, odom, base) = (frames.icr(), frames.odom(), frames.base());
    let pose = frames.icr_from_base(drive);
    let (x, y) = (metres(pose.x), metres(pose.y));
    let notes = format!(
        "Static transform {icr} -> {base}, in m.\n\
         {icr} is the parent: the controller publishes {odom} -> {icr}, and a frame has one \
         parent.\n\
         {base} must be the root of the robot's URDF, and nothing else may publish {odom} -> \
         {base}.\n"
    );
    let body = format!(
        "
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package=\"tf2_ros\",
                executable=\"static_transform_publisher\",
                name=\"icr_frame\",
                arguments=[
                    \"--x\", \"{x}\",
                    \"--y\", \"{y}\",
                    \"--z\", \"0.0\",
                    \"--roll\", \"0.0\",
                    \"--pitch\", \"0.0\",
                    \"--yaw\", \"0.0\",
                    \"--frame-id\", \"{icr}\",
                    \"--child-frame-id\", \"{base}\",
                ],
            ),
        ]
    )
"
    );
    TextFile { name: "icr_frame.launch.py", text: provenance.hash_comment(&notes) + &body }
}
