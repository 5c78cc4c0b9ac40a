//! What is touched: a surface, its index, and how stiff it is where.

use glam::DVec3;

use crate::mesh::SurfaceMesh;
use crate::proxy::Proxy;
use crate::response::{Response, ResponseError};
use crate::stiffness_map::{StiffnessMap, StiffnessMapError};
use crate::surface_index::SurfaceIndex;

/// A body at rest. Immutable; share it between threads in an `Arc`.
#[derive(Clone, Debug)]
pub struct Body {
    mesh: SurfaceMesh,
    index: SurfaceIndex,
    stiffness: Option<StiffnessMap>,
    response: Option<Response>,
}

impl Body {
    /// Builds the spatial index of `mesh`.
    #[must_use]
    pub fn new(mesh: SurfaceMesh) -> Self {
        Self { index: SurfaceIndex::new(&mesh), mesh, stiffness: None, response: None }
    }

    /// The same body with a factor on the contact law for each point; without one it is as the law says everywhere.
    ///
    /// # Errors
    /// A map made for another surface.
    pub fn with_stiffness(self, map: StiffnessMap) -> Result<Self, StiffnessMapError> {
        map.check(&self.mesh)?;
        Ok(Self { stiffness: Some(map), ..self })
    }

    /// The same body with a calibrated answer of its surface; without one it is that of parallel chains.
    ///
    /// # Errors
    /// A response made for another surface.
    pub fn with_response(self, response: Response) -> Result<Self, ResponseError> {
        response.check(&self.mesh)?;
        Ok(Self { response: Some(response), ..self })
    }

    /// The calibrated answer of the surface, where there is one.
    #[must_use]
    pub fn response(&self) -> Option<&Response> {
        self.response.as_ref()
    }

    /// The factors on the contact law, where they are not all 1.
    #[must_use]
    pub fn stiffness(&self) -> Option<&StiffnessMap> {
        self.stiffness.as_ref()
    }

    /// The rest surface, in the body frame.
    #[must_use]
    pub fn mesh(&self) -> &SurfaceMesh {
        &self.mesh
    }

    /// The spatial index of [`mesh`](Self::mesh).
    #[must_use]
    pub fn index(&self) -> &SurfaceIndex {
        &self.index
    }

    /// Factor on the law and its gradient under a probe, 1 and 1/m.
    #[inline]
    pub(crate) fn stiffness_under(&self, proxy: &Proxy) -> (f64, DVec3) {
        match &self.stiffness {
            None => (1.0, DVec3::ZERO),
            Some(map) => (map.at(&proxy.at), map.gradient_per_m(&self.mesh, proxy)),
        }
    }
}
