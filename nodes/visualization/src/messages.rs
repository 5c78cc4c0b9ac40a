//! Between ROS messages and plain data.

use glam::DVec3;
use node_kit::convert;
use r2r::rhombus_haptics_msgs::msg::ContactState;
use r2r::shape_msgs::msg::Mesh;
use r2r::std_msgs::msg::{ColorRGBA, Header};
use r2r::visualization_msgs::msg::{Marker, MarkerArray};
use rhombus_chain::{Pose, frame_of_message};

use crate::colour::Colour;
use crate::device_view::{Contact, Mode};
use crate::drawing::{Drawing, Key, Shape};
use crate::picture::Update;
use crate::surface::{BodySurface, MeshError};

// r2r gives every constant of a message a type of its own.
const CONTACT: u8 = ContactState::CONTACT as u8;
const GRASP: u8 = ContactState::GRASP as u8;
const TRIANGLE_LIST: i32 = Marker::TRIANGLE_LIST as i32;
const LINE_LIST: i32 = Marker::LINE_LIST as i32;
const SPHERE: i32 = Marker::SPHERE as i32;
const SPHERE_LIST: i32 = Marker::SPHERE_LIST as i32;
const ARROW: i32 = Marker::ARROW as i32;
const ADD: i32 = Marker::ADD as i32;
const DELETE: i32 = Marker::DELETE as i32;

/// The rest surface of a latched mesh with this topology version.
pub(crate) fn surface(mesh: &Mesh, topology_version: u32) -> Result<BodySurface, MeshError> {
    let vertices = mesh.vertices.iter().map(convert::dvec3).collect();
    // A triangle always has three corners; r2r makes the fixed-size array a Vec.
    let corners = |indices: &[u32]| [indices[0], indices[1], indices[2]];
    let triangles = mesh.triangles.iter().map(|triangle| corners(&triangle.vertex_indices)).collect();
    BodySurface::new(vertices, triangles, topology_version)
}

/// A contact, unchecked: whoever shows it judges it. A mode that is not known touches nothing.
pub(crate) fn contact(state: &ContactState) -> Contact {
    Contact {
        frame_id: frame_of_message(&state.header.frame_id).to_owned(),
        mode: match state.mode {
            CONTACT => Mode::Touch,
            GRASP => Mode::Grasp,
            _ => Mode::None,
        },
        saturated: state.saturated,
        clutched: state.clutched,
        probe_m: convert::dvec3(&state.probe),
        proxy_m: convert::dvec3(&state.proxy),
        normal: convert::dvec3_of_vector(&state.normal),
        depth_m: state.depth,
        force_n: state.force,
        stiffness_n_per_m: state.stiffness,
        stamp_ns: convert::stamp_ns(&state.header.stamp),
    }
}

/// Markers for an update. Their stamp is zero: a viewer takes the newest transform it has, which a picture wants.
pub(crate) fn marker_array(update: Update) -> MarkerArray {
    let deleted = update.deleted.into_iter().map(deletion);
    MarkerArray { markers: deleted.chain(update.drawings.into_iter().map(marker)).collect() }
}

fn deletion(key: Key) -> Marker {
    Marker { ns: key.thing.name().to_owned(), id: key.id, action: DELETE, ..Marker::default() }
}

fn marker(drawing: Drawing) -> Marker {
    let Drawing { key, frame_id, shape, mut points_m, colour: whole, colours } = drawing;
    let (type_, scale) = match shape {
        Shape::Triangles => (TRIANGLE_LIST, DVec3::ONE),
        Shape::Lines { width_m } => (LINE_LIST, DVec3::new(width_m, 0.0, 0.0)),
        Shape::Sphere { diameter_m } => (SPHERE, DVec3::splat(diameter_m)),
        Shape::Spheres { diameter_m } => (SPHERE_LIST, DVec3::splat(diameter_m)),
        Shape::Arrow { shaft_m, head_m, head_length_m } => {
            (ARROW, DVec3::new(shaft_m, head_m, head_length_m))
        }
    };
    let mut pose = Pose::IDENTITY;
    if let Shape::Sphere { .. } = shape {
        pose.translation = points_m.pop().unwrap_or_default();
    }
    Marker {
        header: Header { frame_id, ..Header::default() },
        ns: key.thing.name().to_owned(),
        id: key.id,
        type_,
        action: ADD,
        pose: convert::pose(&pose),
        scale: convert::vector(scale),
        color: colour(whole),
        points: points_m.into_iter().map(convert::point).collect(),
        colors: colours.into_iter().map(colour).collect(),
        ..Marker::default()
    }
}

fn colour(colour: Colour) -> ColorRGBA {
    ColorRGBA { r: colour.r, g: colour.g, b: colour.b, a: colour.a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{self, Thing};

    #[test]
    fn a_sphere_stands_at_its_pose_and_a_list_at_its_points() {
        let sphere = marker(drawing::probe(1, "base", DVec3::new(1.0, 2.0, 3.0), 0.005, false));
        assert_eq!((sphere.type_, sphere.id, sphere.ns.as_str()), (SPHERE, 1, "probe"));
        assert_eq!((sphere.pose.position.y, sphere.pose.orientation.w, sphere.scale.x), (2.0, 1.0, 0.01));
        assert!(sphere.points.is_empty());
        let arrow = drawing::force(0, "base", DVec3::ZERO, DVec3::Z, 0.005, false).map(marker).unwrap();
        assert_eq!((arrow.type_, arrow.points.len(), arrow.scale.x), (ARROW, 2, 0.002));
    }

    #[test]
    fn deletions_come_first_and_name_what_they_delete() {
        let update = Update {
            drawings: vec![drawing::probe(0, "base", DVec3::ZERO, 0.005, false)],
            deleted: vec![Key { thing: Thing::Chains, id: 2 }],
        };
        let markers = marker_array(update).markers;
        assert_eq!((markers[0].action, markers[0].ns.as_str(), markers[0].id), (DELETE, "chains", 2));
        assert_eq!(markers[1].action, ADD);
    }
}
