//! From the scene's `body.*` to a body the model can use, and what is worth a warning about it.

use std::fmt;
use std::path::Path;

use glam::DVec3;
use rhombus_chain::{Body, Spread};

use crate::mesh_file::MeshFile;
use crate::{MeshSource, Problem, Scene, SceneError, load_response, read_stiffness_map};

/// A body, and what its owner should know about it.
#[derive(Debug)]
pub struct LoadedBody {
    /// The checked rest surface in metres and its spatial index.
    pub body: Body,
    /// Nothing that stops a session; to be logged.
    pub warnings: Vec<Warning>,
}

/// Something accepted that is probably not meant.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// The body's size is no organ's: most likely the mesh has another unit.
    UnlikelySize {
        /// The mesh file or generated body.
        mesh: String,
        /// Extents along x, y, z in metres, `body.scale` included.
        extents_m: DVec3,
        /// A `body.scale` that gives a likely size, and the unit that means.
        scale: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Warning::UnlikelySize { mesh, extents_m: e, scale } = self;
        write!(
            f,
            "{mesh}: the body is {:.4} x {:.4} x {:.4} m, expected is 0.005 to 2 m; is the mesh in another unit? \
             body.scale: {scale:?} would make it a likely size",
            e.x, e.y, e.z
        )
    }
}

/// Longest extents between which a body is not remarked on, m: a biopsy to a whole patient.
const LIKELY_EXTENT_M: std::ops::RangeInclusive<f64> = 0.005..=2.0;

impl Scene {
    /// Reads or generates the rest surface of `body.mesh`, in metres, and reads its `body.stiffness_map` or `body.response`.
    ///
    /// # Errors
    /// The mesh file cannot be read or is not a closed, manifold, outward oriented surface; the map or the calibrated body
    /// cannot be read or does not fit the mesh or the chains.
    pub fn load_body(&self) -> Result<LoadedBody, SceneError> {
        let scale = self.body.scale;
        let (name, file) = match &self.body.mesh {
            MeshSource::BuiltIn(kind) => (kind.name().to_owned(), MeshFile::generated(*kind)),
            MeshSource::File(path) => (path.display().to_string(), MeshFile::read(path)?),
        };
        let mesh = file.surface(scale)?;
        let [low, high] = mesh.extents();
        let warnings = unlikely_size(name, high - low, scale).into_iter().collect();
        let mut body = Body::new(mesh);
        if let Some(path) = &self.body.stiffness_map {
            let map = read_stiffness_map(path, body.mesh())?;
            body = body.with_stiffness(map).map_err(|error| {
                self.parameters().error("body.stiffness_map", Problem::Stiffness(error.to_string()))
            })?;
        }
        if let Some(path) = &self.body.response {
            body = self.with_response(body, path)?;
        }
        Ok(LoadedBody { body, warnings })
    }

    /// A body as it was calibrated.
    fn with_response(&self, body: Body, path: &Path) -> Result<Body, SceneError> {
        let refused = |reason: String| self.parameters().error("body.response", Problem::Response(reason));
        if self.body.stiffness_map.is_some() {
            return Err(refused(
                "has a stiffness map of its own; accepted: without body.stiffness_map".to_owned(),
            ));
        }
        if self.surface.spread != Spread::Geodesic {
            return Err(refused("is not made for rings; accepted: surface.spread: geodesic".to_owned()));
        }
        let loaded = load_response(path, body.mesh(), &self.law()?)?;
        let body = body.with_stiffness(loaded.stiffness).map_err(|fault| refused(fault.to_string()))?;
        body.with_response(loaded.response).map_err(|fault| refused(fault.to_string()))
    }
}

fn unlikely_size(mesh: String, extents_m: DVec3, scale: f64) -> Option<Warning> {
    let longest = extents_m.max_element();
    if LIKELY_EXTENT_M.contains(&longest) {
        return None;
    }
    // Powers of ten are what units differ by.
    const FACTORS: [f64; 7] = [1e-3, 1e-2, 1e3, 1e-6, 1e6, 1e-1, 1e1];
    let factor = FACTORS.into_iter().find(|factor| (0.02..=1.0).contains(&(longest * factor)));
    let factor = factor.unwrap_or(0.2 / longest);
    Some(Warning::UnlikelySize { mesh, extents_m, scale: scale * factor })
}
