//! Why a triangle list is not a body's surface.

use glam::DVec3;
use thiserror::Error;

use super::COORDINATE_LIMIT_M;

/// Why [`SurfaceMesh::new`](super::SurfaceMesh::new) refuses a mesh. Vertices and triangles are numbered from
/// 0.
///
/// A surface that is accepted has an inside: every edge joins two triangles that run through it in
/// opposite directions, counter-clockwise seen from outside.
///
/// ```text
///      right: the shared edge a-b              wrong: both triangles run a -> b
///      is a -> b in one, b -> a in the other
///          a ------ d                              a ------ d
///         / \      /                              / \      /
///        /   \  ↻ /     (both ↻)                 / ↻ \  ↺ /
///       c ---- b                                c ---- b
/// ```
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// No surface at all.
    #[error(
        "the mesh has {vertices} vertices and {triangles} triangles; accepted: a closed surface (at least 4 triangles)"
    )]
    Empty {
        /// Number of vertices.
        vertices: usize,
        /// Number of triangles.
        triangles: usize,
    },
    /// More than 32-bit half-edge numbers can count.
    #[error("the mesh has {triangles} triangles; accepted: up to {}", super::TRIANGLE_LIMIT)]
    TooManyTriangles {
        /// Number of triangles.
        triangles: usize,
    },
    /// A coordinate is NaN, infinite, or too large for squares and cubes of it to be of use.
    #[error(
        "vertex {vertex} is at {position}; accepted: finite coordinates of at most {COORDINATE_LIMIT_M:e} m in size"
    )]
    Coordinate {
        /// The vertex.
        vertex: usize,
        /// Where the mesh says it is, in metres.
        position: DVec3,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} uses vertex {index}; accepted: 0 to {} ({vertices} vertices)", .vertices.saturating_sub(1))]
    IndexOutOfRange {
        /// The triangle.
        triangle: usize,
        /// The vertex number it uses.
        index: u32,
        /// Number of vertices in the mesh.
        vertices: usize,
    },
    /// A triangle uses one vertex twice.
    #[error("triangle {triangle} has the corners {corners:?}; accepted: three different vertices")]
    RepeatedCorner {
        /// The triangle.
        triangle: usize,
        /// Its vertices.
        corners: [u32; 3],
    },
    /// A triangle without area: it has no normal.
    #[error(
        "triangle {triangle} with the corners {corners:?} is degenerate: {height_m:e} m high over its longest edge of \
         {longest_edge_m:e} m; accepted: higher than {:e} of that edge (merge its close vertices or flip that edge)",
        super::DEGENERATE_HEIGHT
    )]
    Degenerate {
        /// The triangle.
        triangle: usize,
        /// Its vertices.
        corners: [u32; 3],
        /// Length of its longest edge in metres.
        longest_edge_m: f64,
        /// Its height over that edge in metres.
        height_m: f64,
    },
    /// An edge belongs to one triangle only.
    #[error(
        "the surface is open: the edge between vertices {} and {} belongs to triangle {triangle} alone, and {count} edges \
         are like it; accepted: a closed surface, every edge shared by two triangles (fill the holes, merge double vertices)",
        .edge[0], .edge[1]
    )]
    OpenEdge {
        /// The first such edge.
        edge: [u32; 2],
        /// The triangle it belongs to.
        triangle: usize,
        /// How many edges of the mesh are open.
        count: usize,
    },
    /// An edge belongs to three or more triangles.
    #[error(
        "the surface is not manifold: the edge between vertices {} and {} belongs to {triangles} triangles (one is \
         {triangle}), and {count} edges are like it; accepted: two triangles at every edge (remove doubled and inner faces)",
        .edge[0], .edge[1]
    )]
    NonManifoldEdge {
        /// The first such edge.
        edge: [u32; 2],
        /// One of its triangles.
        triangle: usize,
        /// How many triangles use it.
        triangles: usize,
        /// How many edges of the mesh belong to more than two triangles.
        count: usize,
    },
    /// Two neighbouring triangles turn in opposite senses.
    #[error(
        "the triangles {} and {} run through their common edge from vertex {} to {} in the same direction, and {count} \
         edges are like it; accepted: all triangles counter-clockwise seen from outside (make the orientation consistent)",
        .triangles[0], .triangles[1], .edge[0], .edge[1]
    )]
    InconsistentOrientation {
        /// The first such edge, in the direction both triangles use.
        edge: [u32; 2],
        /// The two triangles.
        triangles: [usize; 2],
        /// How many edges of the mesh are like it.
        count: usize,
    },
    /// Parts of the surface meet in one vertex only.
    #[error(
        "the surface is not manifold: vertex {vertex} is the tip of {fans} separate fans of triangles, and {count} vertices \
         are like it; accepted: one closed fan around every vertex (give each fan a vertex of its own)"
    )]
    NonManifoldVertex {
        /// The first such vertex.
        vertex: usize,
        /// How many fans meet in it.
        fans: usize,
        /// How many vertices of the mesh are like it.
        count: usize,
    },
    /// A vertex belongs to no triangle.
    #[error(
        "vertex {vertex} belongs to no triangle, and {count} vertices are like it; accepted: only vertices of triangles (remove it)"
    )]
    Unreferenced {
        /// The first such vertex.
        vertex: usize,
        /// How many vertices of the mesh are like it.
        count: usize,
    },
    /// The surface encloses nothing.
    #[error(
        "the surface encloses {volume_m3:e} m3 within {area_m2:e} m2 of surface; accepted: a body with an inside, \
         not a folded sheet"
    )]
    NoVolume {
        /// The signed volume.
        volume_m3: f64,
        /// The surface area.
        area_m2: f64,
    },
    /// The normals point into the body.
    #[error(
        "the surface is flipped: the closed part of {triangles} triangles around triangle {triangle} has its normals \
         pointing inward (signed volume {volume_m3:e} m3); accepted: triangles counter-clockwise seen from outside \
         (swap two corners of every triangle of that part)"
    )]
    Flipped {
        /// The first triangle of the flipped part.
        triangle: usize,
        /// How many triangles that part has.
        triangles: usize,
        /// Its signed volume, negative.
        volume_m3: f64,
    },
}
