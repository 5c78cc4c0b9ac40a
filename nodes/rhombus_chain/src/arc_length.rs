//! Arc lengths along the rest surface from one point to the vertices around it.

mod labelling;
mod labels;
mod roughness;
mod shelves;
mod table;
mod windows;

use crate::mesh::{SurfaceMesh, SurfacePoint};
use labelling::Labelling;
use windows::Windows;

/// Arc lengths from a point of one surface, with the scratch memory to compute them.
///
/// On a smooth mesh vertices are labelled outward from the point, each from two neighbours: within 5 % of the
/// shortest way over the triangles, and quick. Where that could be worse, because corners as sharp as a
/// cube's are as coarse as the mesh, windows are sent across the edges instead: exact, and five times slower.
/// A fine mesh is labelled even so: windows become too many, and only the vertices right behind a sharp
/// corner get arcs up to 13 % short. The choice depends on the mesh alone. Both ways, arcs depend
/// continuously on the point.
///
/// Made once for a surface. A query looks only at what is in reach.
#[derive(Clone, Debug)]
pub struct ArcLengths {
    method: Method,
}

/// Vertices of a mesh up to which windows are used. Their number grows with the power 1.5 of the vertices in
/// reach.
const WINDOWS_UP_TO: usize = 10_000;

#[derive(Clone, Debug)]
enum Method {
    Labelling(Labelling),
    Windows(Windows),
}

impl ArcLengths {
    /// Prepares the queries on `mesh`.
    #[must_use]
    pub fn new(mesh: &SurfaceMesh) -> Self {
        let affords_windows = mesh.vertices().len() <= WINDOWS_UP_TO;
        let method = if affords_windows && !roughness::is_smooth(mesh) {
            Method::Windows(Windows::new(mesh))
        } else {
            Method::Labelling(Labelling::new(mesh))
        };
        Self { method }
    }

    /// Computes the arcs from `source` to all vertices nearer than `limit_m`. `mesh` is the surface this was
    /// made for.
    ///
    /// An arc below the limit does not depend on the limit; labelled ones right at the limit may, by up to
    /// 0.5 %. Nothing is allocated on a smooth mesh; on a rough one memory grows until it has seen its
    /// largest query.
    pub fn solve(&mut self, mesh: &SurfaceMesh, source: SurfacePoint, limit_m: f64) {
        match &mut self.method {
            Method::Labelling(labelling) => labelling.solve(mesh, source, limit_m),
            Method::Windows(windows) => windows.solve(mesh, source, limit_m),
        }
    }

    /// Vertices nearer than the limit of the last query, in no particular order, and their arc lengths in
    /// metres.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, f64)> + '_ {
        let known = match &self.method {
            Method::Labelling(labelling) => labelling.known(),
            Method::Windows(windows) => windows.known(),
        };
        known.iter().map(|&vertex| {
            let arc_m = match &self.method {
                Method::Labelling(labelling) => labelling.arc_m(vertex),
                Method::Windows(windows) => windows.arc_m(vertex),
            };
            (vertex, arc_m)
        })
    }

    /// Whether the arcs are the exact shortest ways over the triangles.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        matches!(self.method, Method::Windows(_))
    }

    /// Bytes of memory the scratch occupies.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        match &self.method {
            Method::Labelling(labelling) => labelling.memory_bytes(),
            Method::Windows(windows) => windows.memory_bytes(),
        }
    }
}
