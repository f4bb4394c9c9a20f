//! Definitions of the messages, as files of bags carry them.
//!
//! # Sources
//! ROS 2 Humble: `common_interfaces` 4.2, `geometry2` 0.25, `rcl_interfaces` 1.2. MCAP format
//! registry, "ros2msg".

use std::fmt::Write;

/// Members of each type, by its name without `msg/`.
const MEMBERS: [(&str, &str); 21] = [
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec"),
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"),
    ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id"),
    ("std_msgs/Float64", "float64 data"),
    ("std_msgs/String", "string data"),
    ("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a"),
    ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"),
    ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z"),
    ("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w"),
    ("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation"),
    ("geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose"),
    (
        "geometry_msgs/Transform",
        "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation",
    ),
    (
        "geometry_msgs/TransformStamped",
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform",
    ),
    ("tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms"),
    ("nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses"),
    (
        "sensor_msgs/JointState",
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n\
         float64[] effort",
    ),
    ("sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data"),
    ("visualization_msgs/UVCoordinate", "float32 u\nfloat32 v"),
    ("visualization_msgs/MeshFile", "string filename\nuint8[] data"),
    (
        "visualization_msgs/Marker",
        "int32 SPHERE=2\nint32 ADD=0\nint32 DELETE=2\n\
         std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n\
         geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n\
         builtin_interfaces/Duration lifetime\nbool frame_locked\n\
         geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n\
         sensor_msgs/CompressedImage texture\n\
         visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n\
         visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials",
    ),
    ("visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers"),
];

/// Stands between the definitions of a text.
const RULE: &str =
    "================================================================================";

/// The definition of a type (`package/msg/Type`), followed by those of the types that it holds.
pub(super) fn text(kind: &str) -> String {
    let mut kinds = vec![kind.replace("/msg/", "/")];
    let mut text = String::new();
    let mut next = 0;
    while let Some(kind) = kinds.get(next).cloned() {
        let members = members(&kind);
        if next > 0 {
            let _ = writeln!(text, "{RULE}\nMSG: {kind}");
        }
        text += members;
        text.push('\n');
        for held in members.lines().filter_map(|line| line.split([' ', '[']).next()) {
            if held.contains('/') && !kinds.iter().any(|known| known == held) {
                kinds.push(held.to_owned());
            }
        }
        next += 1;
    }
    text
}

fn members(kind: &str) -> &'static str {
    let found = MEMBERS.iter().find(|(name, _)| *name == kind);
    found.map(|(_, members)| *members).expect("types of messages are defined above")
}
