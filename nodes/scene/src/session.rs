//! The session that a scene describes, ready for its first pose.

use rhombus_chain::{Body, FrameTree, Session, SessionParts};

use crate::frame_names::{frame_id, frame_id_of_device};
use crate::{Scene, SceneError, Warning};

/// A session and what was found while it was made.
#[derive(Clone, Debug)]
pub struct LoadedSession {
    /// Before its first pose.
    pub session: Session,
    /// Nothing that stops it.
    pub warnings: Vec<Warning>,
    /// What ties a surface displacement to the body's mesh; see [`topology_version`].
    pub topology_version: u32,
}

impl Scene {
    /// The session of all devices, for a node in `namespace` ("/" for none).
    ///
    /// # Errors
    /// As [`Scene::tissue`] and [`Scene::load_body`].
    pub fn load_session(&self, namespace: &str) -> Result<LoadedSession, SceneError> {
        let tissue = self.tissue()?;
        let loaded = self.load_body()?;
        let topology_version = topology_of(&loaded.body);
        let surface = self.surface_field(&loaded.body, &tissue);
        let session = Session::new(SessionParts {
            body: loaded.body,
            tissue,
            body_frame: frame_id(namespace, &self.body.frame_id),
            frames: self.frames(namespace),
            devices: self.session.devices.len(),
            motion_scale: self.device.motion_scale,
            close_below_rad: self.grasp.close_below_rad,
            surface,
        });
        Ok(LoadedSession { session, warnings: loaded.warnings, topology_version })
    }

    /// Where the parameters put body and devices in the scene. With several devices `device.scene_from_device` is the
    /// place of all of them only when somebody says so; otherwise each driver says where its own stands, on `/tf_static`.
    pub fn frames(&self, namespace: &str) -> FrameTree {
        let scene_frame = frame_id(namespace, &self.session.scene_frame_id);
        let mut frames = FrameTree::new();
        let body_frame = frame_id(namespace, &self.body.frame_id);
        frames.set_from_parameters(&scene_frame, &body_frame, self.body.scene_from_body);
        let devices = &self.session.devices;
        if devices.len() == 1 || self.parameters().is_given("device.scene_from_device") {
            for device in devices {
                let device_frame = frame_id_of_device(namespace, device, &self.device.frame_id);
                frames.set_from_parameters(&scene_frame, &device_frame, self.device.scene_from_device);
            }
        }
        frames
    }
}

fn topology_of(body: &Body) -> u32 {
    let vertices = body.mesh().vertices().iter().map(|vertex| vertex.to_array());
    topology_version(vertices, body.mesh().triangles().iter().flatten().copied())
}

/// What ties a surface displacement to a mesh: the CRC-32 of the little-endian bytes of the mesh message's vertices
/// (x, y, z in m as f64) and then of its triangles (u32).
pub fn topology_version(
    vertices: impl IntoIterator<Item = [f64; 3]>,
    corners: impl IntoIterator<Item = u32>,
) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    for coordinate in vertices.into_iter().flatten() {
        crc.update(&coordinate.to_le_bytes());
    }
    for corner in corners {
        crc.update(&corner.to_le_bytes());
    }
    crc.finalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_topology_version_is_the_crc_of_vertices_and_triangles() {
        // zlib.crc32(struct.pack("<9d3I", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)) of Python.
        let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(topology_version(vertices, [0, 1, 2]), 0x0b3183a2);
    }
}
