//! What is touched: a surface and its index.

use crate::mesh::SurfaceMesh;
use crate::surface_index::SurfaceIndex;

/// A body at rest. Immutable; share it between threads in an `Arc`.
#[derive(Clone, Debug)]
pub struct Body {
    mesh: SurfaceMesh,
    index: SurfaceIndex,
}

impl Body {
    /// Builds the spatial index of `mesh`.
    #[must_use]
    pub fn new(mesh: SurfaceMesh) -> Self {
        Self { index: SurfaceIndex::new(&mesh), mesh }
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
}
