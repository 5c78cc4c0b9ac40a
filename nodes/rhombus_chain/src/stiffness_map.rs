//! Regional stiffness c(p): how many times as stiff as the contact law a body is at each point (MODEL section 5).
//!
//! One factor for each vertex, linear on faces. The stored energy of a contact is `W = c(p(x)) E(depth(x))`, so the force
//! on the hand is
//!
//! ```text
//! -grad W = c F n - E grad_x c
//! ```
//!
//! with the gradient taken through the proxy's projection `x = sum_i b_i (p_i + t n_i)`: with `q_i = p_i + t n_i`,
//! `N = sum_i b_i n_i`,
//!
//! ```text
//! dx = (q_1 - q_0) db_1 + (q_2 - q_0) db_2 + N dt,     grad_x c = (c_1 - c_0) grad b_1 + (c_2 - c_0) grad b_2
//! grad b_1 = (q_2 - q_0) x N / det,     grad b_2 = N x (q_1 - q_0) / det,     det = ((q_1 - q_0) x (q_2 - q_0)) . N
//! ```
//!
//! It is perpendicular to N: moving along the normal does not move the proxy. Without its term a probe could gain energy by
//! going in where the body is soft and coming out where it is stiff.

use std::ops::RangeInclusive;

use glam::DVec3;
use thiserror::Error;

use crate::mesh::{SurfaceMesh, SurfacePoint, length};
use crate::proxy::Proxy;

/// What a factor may be.
const ACCEPTED: RangeInclusive<f64> = 1e-3..=1e3;

/// Where corner normals have almost crossed, a proxy runs this many times as fast as its probe at most; a surface point under
/// a probe that is less deep than nine tenths of the radius of curvature never does.
const FASTEST_PROXY: f64 = 10.0;

/// A factor on the contact law for each point of one surface. Immutable.
///
/// ```
/// use glam::DVec3;
/// use rhombus_chain::{Body, StiffnessMap, SurfaceMesh, SurfacePoint};
///
/// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
/// let mesh = SurfaceMesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
/// let map = StiffnessMap::new(vec![1.0, 1.0, 1.0, 5.0], &mesh)?;
/// let halfway_up = SurfacePoint { face: 1, barycentric: DVec3::new(0.5, 0.0, 0.5) };
/// assert_eq!(map.at(&halfway_up), 3.0);
/// let body = Body::new(mesh).with_stiffness(map)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StiffnessMap {
    /// Factors at the corners of each triangle.
    corners: Vec<[f64; 3]>,
    vertices: usize,
    range: (f64, f64),
}

/// Why factors are refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum StiffnessMapError {
    /// Not one factor for each vertex.
    #[error(
        "{factors} stiffness factors; accepted: one for each of the mesh's {vertices} vertices, in their order"
    )]
    Count {
        /// Number of factors.
        factors: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// A factor that is not accepted.
    #[error(
        "stiffness factor {factor} of vertex {vertex} (counted from 0); accepted: a number from 0.001 to 1000"
    )]
    Factor {
        /// The vertex, counted from 0.
        vertex: usize,
        /// Its factor.
        factor: f64,
    },
    /// The map was made for another surface than the body's.
    #[error(
        "the stiffness map is for {vertices} vertices and {triangles} triangles; accepted: one made for the body's surface"
    )]
    OtherMesh {
        /// Vertices of the surface the map was made for.
        vertices: usize,
        /// Its triangles.
        triangles: usize,
    },
}

impl StiffnessMap {
    /// One factor for each vertex of `mesh`, in the order of its vertices.
    ///
    /// # Errors
    /// Another number of factors than vertices; a factor outside 0.001 to 1000.
    pub fn new(factors: Vec<f64>, mesh: &SurfaceMesh) -> Result<Self, StiffnessMapError> {
        let vertices = mesh.vertices().len();
        if factors.len() != vertices {
            return Err(StiffnessMapError::Count { factors: factors.len(), vertices });
        }
        if let Some(vertex) = factors.iter().position(|factor| !ACCEPTED.contains(factor)) {
            return Err(StiffnessMapError::Factor { vertex, factor: factors[vertex] });
        }
        let range =
            factors.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), c| (low.min(*c), high.max(*c)));
        let corners = mesh.triangles().iter().map(|t| t.map(|vertex| factors[vertex as usize])).collect();
        Ok(Self { corners, vertices, range })
    }

    /// The factor at a point of the surface. Real-time safe.
    ///
    /// # Panics
    /// When there is no such face, as with an index into a slice.
    #[must_use]
    #[inline]
    pub fn at(&self, at: &SurfacePoint) -> f64 {
        let [c0, c1, c2] = self.corners[at.face as usize];
        c0 + at.barycentric.y * (c1 - c0) + at.barycentric.z * (c2 - c0)
    }

    /// The smallest and the largest factor.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        self.range
    }

    /// Bytes of memory the map occupies.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.corners.as_slice())
    }

    /// Whether the map can have been made for `mesh`.
    pub(crate) fn check(&self, mesh: &SurfaceMesh) -> Result<(), StiffnessMapError> {
        let (vertices, triangles) = (self.vertices, self.corners.len());
        if (vertices, triangles) == (mesh.vertices().len(), mesh.triangles().len()) {
            Ok(())
        } else {
            Err(StiffnessMapError::OtherMesh { vertices, triangles })
        }
    }

    /// `grad_x c` for the probe whose proxy this is, 1/m; perpendicular to the proxy's normal. Real-time safe.
    ///
    /// Where the proxy is no projection along interpolated normals it moves as on the plane of its face.
    #[inline]
    pub(crate) fn gradient_per_m(&self, mesh: &SurfaceMesh, proxy: &Proxy) -> DVec3 {
        let face = proxy.at.face;
        let factors = self.corners[face as usize];
        let corners = mesh.corners(face);
        let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let on_plane = gradient(factors, corners, area);
        let gradient = match proxy.is_projection {
            true => {
                through_projection(factors, corners, mesh.corner_normals(face), proxy).unwrap_or(on_plane)
            }
            false => on_plane - proxy.normal * on_plane.dot(proxy.normal),
        };
        let (size, limit) = (length(gradient), FASTEST_PROXY * length(on_plane));
        let gradient = if size > limit { gradient * (limit / size) } else { gradient };
        if gradient.is_finite() { gradient } else { DVec3::ZERO }
    }
}

fn through_projection(
    factors: [f64; 3],
    corners: [DVec3; 3],
    normals: [DVec3; 3],
    proxy: &Proxy,
) -> Option<DVec3> {
    let weights = proxy.at.barycentric;
    let mean = normals[0] * weights.x + normals[1] * weights.y + normals[2] * weights.z;
    // The probe is t N above its proxy.
    let height = proxy.distance_m / length(mean);
    let moved: [DVec3; 3] = std::array::from_fn(|k| corners[k] + normals[k] * height);
    let along = gradient(factors, moved, mean);
    along.is_finite().then_some(along)
}

/// Gradient of the corner factors at a point of the triangle, whose weights do not change along `across`.
fn gradient(factors: [f64; 3], corners: [DVec3; 3], across: DVec3) -> DVec3 {
    let (u, v) = (corners[1] - corners[0], corners[2] - corners[0]);
    let determinant = u.cross(v).dot(across);
    (v.cross(across) * (factors[1] - factors[0]) + across.cross(u) * (factors[2] - factors[0])) / determinant
}
