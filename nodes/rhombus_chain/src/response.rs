//! A calibrated body: how its surface answers a contact, by the direction in which a place lies and by where it is touched
//! (MODEL section 4, directional chains).
//!
//! With `phi` the direction of a vertex around the contact normal `n`, `r` and `f` the unit vectors away from and around the
//! contact, `g_p` the shape of chain p, `w_p = min(1, arc / max(h_p, r_c))`:
//!
//! ```text
//! u(v) = DL sum_p g_p(s) ( [a_p0 + w_p sum_k (a_pk cos k phi + b_pk sin k phi)] n
//!                        + w_p [c_p0 + sum_k (c_pk cos k phi + d_pk sin k phi)] r
//!                        + w_p sum_k (e_pk cos k phi + o_pk sin k phi) f )  +  DL w sum_j z_j Phi_j(v)
//! ```
//!
//! Every coefficient and every amplitude `z_j` has a value for each vertex and is linear on faces, in a frame that is turned
//! with the normal. `phi` counts from the first vector of [`tangent_frame`] towards the second. `sum_p a_p0 = 1`: the contact
//! moves by exactly `DL n`, which is why the modes rise from zero there, with `w` of the widest chain.

mod arc_table;
mod contact_frame;
mod directional;
mod grid;
mod lanes;
mod modes;
mod moved;
mod profiles;

use glam::DVec3;
use thiserror::Error;

use crate::mesh::{SurfaceMesh, SurfacePoint};

pub(crate) use directional::DirectionalField;

/// Harmonics that a response may have.
pub const MOST_HARMONICS: usize = 2;
/// Chains that a response may have.
pub const MOST_CHAINS: usize = 8;
/// Body modes that a response may have.
pub const MOST_MODES: usize = 256;
/// How much `sum_p a_p0` may differ from 1: what single precision loses.
const CLOSURE: f32 = 1e-5;
/// Size that no coefficient reaches.
const LARGEST: f32 = 1e4;

/// Numbers of a response, for each vertex in the order of the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResponseParts {
    /// P.
    pub chains: usize,
    /// H, 0 to 2.
    pub harmonics: usize,
    /// J.
    pub modes: usize,
    /// V x P x (2 + 6 H): for each chain `a_0 a_1 b_1 .. b_H`, `c_0 c_1 d_1 .. d_H`, `e_1 o_1 .. o_H`, in the frame of the vertex.
    pub coefficients: Vec<f32>,
    /// V x J: `z_j` where the body is touched.
    pub amplitudes: Vec<f32>,
    /// J x V x 3: `Phi_j`, body frame.
    pub mode_fields: Vec<f32>,
}

/// How a body's surface answers. Immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    parts: ResponseParts,
    vertices: usize,
}

/// Why a response is refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ResponseError {
    /// Too many of something.
    #[error("{count} {of}; accepted: {accepted}")]
    Size {
        /// Of what.
        of: &'static str,
        /// How many.
        count: usize,
        /// Range in words.
        accepted: &'static str,
    },
    /// Not as many numbers as there have to be.
    #[error("{found} {of}; accepted: {wanted}, for {vertices} vertices")]
    Count {
        /// Which numbers.
        of: &'static str,
        /// How many there are.
        found: usize,
        /// How many there have to be.
        wanted: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// A number that is none or far too large.
    #[error("{of} of vertex {vertex} (counted from 0): {value}; accepted: numbers below {LARGEST:e} in size")]
    Value {
        /// Which numbers.
        of: &'static str,
        /// Where.
        vertex: usize,
        /// The value.
        value: f32,
    },
    /// The contact would not move by its depth.
    #[error("the shares of the chains at vertex {vertex} (counted from 0) add up to {sum}; accepted: 1")]
    Closure {
        /// Where.
        vertex: usize,
        /// What they add up to.
        sum: f32,
    },
    /// Made for another surface.
    #[error(
        "the body's response is for {response} vertices, and the mesh has {mesh}; accepted: one made for this mesh"
    )]
    OtherMesh {
        /// Vertices of the response.
        response: usize,
        /// Vertices of the mesh.
        mesh: usize,
    },
}

impl ResponseParts {
    /// Coefficients of one chain at one vertex.
    #[must_use]
    pub fn coefficients_per_chain(&self) -> usize {
        2 + 6 * self.harmonics
    }
}

impl Response {
    /// Checks the numbers.
    ///
    /// # Errors
    /// What does not fit the mesh, is no number, or does not move the contact by its depth.
    pub fn new(parts: ResponseParts, mesh: &SurfaceMesh) -> Result<Self, ResponseError> {
        let vertices = mesh.vertices().len();
        let ResponseParts { chains, harmonics, modes, .. } = parts;
        let sizes = [
            ("chains", chains, 1..=MOST_CHAINS, "1 to 8"),
            ("harmonics", harmonics, 0..=MOST_HARMONICS, "0 to 2"),
            ("body modes", modes, 0..=MOST_MODES, "0 to 256"),
        ];
        for (of, count, range, accepted) in sizes {
            if !range.contains(&count) {
                return Err(ResponseError::Size { of, count, accepted });
            }
        }
        let per_vertex = chains * parts.coefficients_per_chain();
        let arrays = [
            ("coefficients", &parts.coefficients, vertices * per_vertex, per_vertex),
            ("amplitudes", &parts.amplitudes, vertices * modes, modes),
            ("numbers of body modes", &parts.mode_fields, 3 * vertices * modes, 3),
        ];
        for (of, numbers, wanted, each) in arrays {
            if numbers.len() != wanted {
                return Err(ResponseError::Count { of, found: numbers.len(), wanted, vertices });
            }
            let refused = |number: &f32| number.is_nan() || number.abs() >= LARGEST;
            if let Some(place) = numbers.iter().position(refused) {
                let vertex = place / each.max(1) % vertices;
                return Err(ResponseError::Value { of, vertex, value: numbers[place] });
            }
        }
        for (vertex, here) in parts.coefficients.chunks_exact(per_vertex).enumerate() {
            let sum: f32 = here.iter().step_by(parts.coefficients_per_chain()).sum();
            if (sum - 1.0).abs() > CLOSURE {
                return Err(ResponseError::Closure { vertex, sum });
            }
        }
        Ok(Self { parts, vertices })
    }

    /// P.
    #[must_use]
    pub fn chains(&self) -> usize {
        self.parts.chains
    }

    /// H.
    #[must_use]
    pub fn harmonics(&self) -> usize {
        self.parts.harmonics
    }

    /// J.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.parts.modes
    }

    /// The numbers themselves.
    #[must_use]
    pub fn parts(&self) -> &ResponseParts {
        &self.parts
    }

    /// Whether it can have been made for `mesh`.
    pub(crate) fn check(&self, mesh: &SurfaceMesh) -> Result<(), ResponseError> {
        let vertices = mesh.vertices().len();
        match vertices == self.vertices {
            true => Ok(()),
            false => Err(ResponseError::OtherMesh { response: self.vertices, mesh: vertices }),
        }
    }

    /// Bytes of memory it occupies.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let ResponseParts { coefficients, amplitudes, mode_fields, .. } = &self.parts;
        [coefficients, amplitudes, mode_fields].iter().map(|numbers| size_of_val(numbers.as_slice())).sum()
    }

    /// Writes coefficients (P x (2 + 6 H), in the tangent frame of `normal`) and amplitudes (J) of a contact at `at`.
    fn at(
        &self,
        mesh: &SurfaceMesh,
        at: SurfacePoint,
        normal: DVec3,
        coefficients: &mut [f32],
        amplitudes: &mut [f32],
    ) {
        coefficients.fill(0.0);
        amplitudes.fill(0.0);
        let corners = mesh.triangles()[at.face as usize];
        for (vertex, share) in corners.into_iter().zip(at.barycentric.to_array()) {
            let vertex = vertex as usize;
            let turn = turn(mesh.vertex_normals()[vertex], normal);
            let share = share as f32;
            let here =
                self.parts.coefficients.chunks_exact(coefficients.len()).nth(vertex).unwrap_or_default();
            let per_chain = self.parts.coefficients_per_chain();
            for (sum, chain) in coefficients.chunks_exact_mut(per_chain).zip(here.chunks_exact(per_chain)) {
                self.add_turned(sum, chain, turn, share);
            }
            let modes = amplitudes.len();
            for (sum, z) in amplitudes.iter_mut().zip(&self.parts.amplitudes[vertex * modes..]) {
                *sum += share * z;
            }
        }
    }

    /// Adds `share` of one chain's coefficients, each pair turned by k times the angle whose cosine and sine are `turn`.
    fn add_turned(&self, sum: &mut [f32], chain: &[f32], turn: [f32; 2], share: f32) {
        let pairs = 2 * self.parts.harmonics;
        let mut place = 0;
        for has_constant in [true, true, false] {
            if has_constant {
                sum[place] += share * chain[place];
                place += 1;
            }
            let (mut cosine, mut sine) = (turn[0], turn[1]);
            for pair in (place..place + pairs).step_by(2) {
                let (a, b) = (chain[pair], chain[pair + 1]);
                sum[pair] += share * (a * cosine - b * sine);
                sum[pair + 1] += share * (a * sine + b * cosine);
                (cosine, sine) = (cosine * turn[0] - sine * turn[1], sine * turn[0] + cosine * turn[1]);
            }
            place += pairs;
        }
    }
}

/// Two unit vectors that make a right-handed frame with the unit vector `normal`: `normal`, first, second. Across the axis to
/// which the normal is least parallel, so that no normal is special.
#[must_use]
pub fn tangent_frame(normal: DVec3) -> [DVec3; 2] {
    let size = normal.abs();
    let axis = if size.x <= size.y && size.x <= size.z {
        DVec3::X
    } else if size.y <= size.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let across = normal.cross(axis);
    let first = across / libm::sqrt(across.length_squared());
    [first, normal.cross(first)]
}

/// Cosine and sine of the angle at which the first vector of `from`'s frame stands in the frame of `to` when it is carried there
/// by the shortest turn.
fn turn(from: DVec3, to: DVec3) -> [f32; 2] {
    let ([first, _], [x, y]) = (tangent_frame(from), tangent_frame(to));
    let sum = 1.0 + from.dot(to);
    // Opposite normals have no shortest turn; a face between them has no normal either.
    let carried = if sum > 1e-9 { first - (from + to) * (to.dot(first) / sum) } else { first };
    let (cosine, sine) = (carried.dot(x), carried.dot(y));
    let size = libm::hypot(cosine, sine);
    if size > 0.0 { [(cosine / size) as f32, (sine / size) as f32] } else { [1.0, 0.0] }
}
