//! Where on a surface is the point closest to the probe, and is the probe inside?

mod build;
mod traverse;

use glam::DVec3;

use crate::mesh::{SurfaceMesh, SurfacePoint, is_usable};

/// Children of a node, and triangles of a leaf, at most.
const WIDTH: usize = 4;

/// Spatial index over the triangles of one surface: a tree of bounding boxes, four to a node.
///
/// Boxes are stored in single precision, rounded outward: half the memory traffic, and still exact answers,
/// because boxes only decide what need not be looked at. The tree is balanced by counting, so that its depth
/// is bounded (logarithm to the base 4 of the triangle count) and a query needs a small fixed stack and no
/// allocation, whatever the mesh.
#[derive(Clone, Debug)]
pub struct SurfaceIndex {
    nodes: Vec<Node>,
    /// Triangle numbers in the order of the leaves.
    order: Vec<u32>,
    bounds: [DVec3; 2],
}

/// Boxes and numbers of up to four children.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Node {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    /// A node number, or [`LEAF`] + a place in `order`.
    children: [u32; WIDTH],
    /// Triangles of a leaf; 0 for a node. An absent child has an empty box.
    counts: [u8; WIDTH],
}

impl SurfaceIndex {
    /// Sorts the triangles of `mesh`.
    #[must_use]
    pub fn new(mesh: &SurfaceMesh) -> Self {
        let (nodes, order) = build::build(mesh);
        Self { nodes, order, bounds: mesh.extents() }
    }

    /// The surface point closest to `point` and its distance in metres, among those at most `within_m` away.
    ///
    /// `mesh` is the surface the index was made of. `None` also for a point that is not finite or more than
    /// 1e6 m from the origin. Of several equally close points one is returned, always the same. Real-time
    /// safe: bounded work, no allocation. The work grows with the number of triangles about as close as the
    /// closest one: all of them for the centre of a sphere.
    #[must_use]
    pub fn closest(&self, mesh: &SurfaceMesh, point: DVec3, within_m: f64) -> Option<(SurfacePoint, f64)> {
        if is_usable(point) { traverse::closest(self, mesh, point, within_m) } else { None }
    }

    /// Whether `point` is inside the body. Real-time safe. Points on the surface may count as either.
    #[must_use]
    pub fn encloses(&self, mesh: &SurfaceMesh, point: DVec3) -> bool {
        let [low, high] = self.bounds;
        point.cmpge(low).all() && point.cmple(high).all() && traverse::winding(self, mesh, point) != 0
    }

    /// Whether `point` is farther than `distance_m` from the box around the body. Costs nothing.
    #[must_use]
    #[inline]
    pub fn is_farther_than(&self, point: DVec3, distance_m: f64) -> bool {
        let [low, high] = self.bounds;
        point.cmplt(low - distance_m).any() || point.cmpgt(high + distance_m).any()
    }

    /// Bytes of memory the index occupies.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.order.as_slice())
    }
}
