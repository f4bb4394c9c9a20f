//! Markers: spheres that move with a frame.

use super::{Header, Message, Pose, Time, Vector};
use crate::viewer::Rgb;
use serde::Serialize;
use trackdyn_core::Pose as PlanarPose;

/// `visualization_msgs/MarkerArray`
#[derive(Debug, Serialize)]
pub(in crate::viewer) struct MarkerArray<'a> {
    pub(in crate::viewer) markers: Vec<Marker<'a>>,
}

impl Message for MarkerArray<'_> {
    const KIND: &'static str = "visualization_msgs/msg/MarkerArray";
}

/// `visualization_msgs/Marker`
#[derive(Debug, Serialize)]
pub(in crate::viewer) struct Marker<'a> {
    header: Header<'a>,
    ns: &'a str,
    id: i32,
    kind: i32,
    action: i32,
    pose: Pose,
    scale: Vector,
    color: Colour,
    lifetime: Time,
    frame_locked: bool,
    points: Empty,
    colors: Empty,
    texture_resource: &'a str,
    texture: Image<'a>,
    uv_coordinates: Empty,
    text: &'a str,
    mesh_resource: &'a str,
    mesh_file: MeshFile<'a>,
    mesh_use_embedded_materials: bool,
}

/// A sequence without elements: its bytes do not depend on what it has none of.
type Empty = &'static [u8];

/// `std_msgs/ColorRGBA`
#[derive(Clone, Copy, Debug, Serialize)]
struct Colour {
    r: f32,
    g: f32,
    b: f32,
    a: f32,
}

/// `sensor_msgs/CompressedImage`
#[derive(Debug, Serialize)]
struct Image<'a> {
    header: Header<'a>,
    format: &'a str,
    data: Empty,
}

/// `visualization_msgs/MeshFile`
#[derive(Debug, Serialize)]
struct MeshFile<'a> {
    filename: &'a str,
    data: Empty,
}

/// `visualization_msgs/Marker`: SPHERE, ADD and DELETE.
const SPHERE: i32 = 2;
const ADD: i32 = 0;
const DELETE: i32 = 2;

impl<'a> Marker<'a> {
    /// A sphere of this diameter, m, at a place of the frame of the header, to which it stays tied;
    /// none: it is taken away.
    pub(in crate::viewer) fn sphere(
        header: Header<'a>,
        name: &'a str,
        place: Option<[f64; 2]>,
        diameter: f64,
        colour: Rgb,
    ) -> Self {
        let [x, y] = place.unwrap_or_default();
        let [r, g, b] = colour.map(|part| f32::from(part) / 255.0);
        Self {
            header,
            ns: name,
            id: 0,
            kind: SPHERE,
            action: if place.is_some() { ADD } else { DELETE },
            pose: (&PlanarPose::new(x, y, 0.0)).into(),
            scale: Vector { x: diameter, y: diameter, z: diameter },
            color: Colour { r, g, b, a: 1.0 },
            // until it is replaced
            lifetime: Time::new(0),
            frame_locked: true,
            points: &[],
            colors: &[],
            texture_resource: "",
            texture: Image { header: Header::new(0, ""), format: "", data: &[] },
            uv_coordinates: &[],
            text: "",
            mesh_resource: "",
            mesh_file: MeshFile { filename: "", data: &[] },
            mesh_use_embedded_materials: false,
        }
    }
}
