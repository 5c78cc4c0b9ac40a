//! Responses the tests share.
#![allow(dead_code, reason = "every test file uses its own selection")]
#![allow(clippy::expect_used, reason = "what is made here is valid by construction")]

use glam::{DMat3, DVec3};
use rhombus_chain::{
    Body, Impression, Response, ResponseParts, Spread, SurfaceField, SurfaceMesh, SurfacePoint, Tissue,
    tangent_frame,
};

use crate::common::{surface, tissue_with};

pub(crate) const CHAINS: usize = 3;

pub(crate) fn tissue() -> Tissue {
    tissue_with(CHAINS, surface(0.0, Spread::Geodesic))
}

pub(crate) fn press(mesh: &SurfaceMesh, at: SurfacePoint, depth_m: f64) -> Impression {
    let (position, normal) = (mesh.position(at), mesh.normal(at));
    Impression { at, position, normal, depth_m, lateral_m: DVec3::ZERO }
}

/// A body under test. Its memory takes a second to make, so it is made once.
pub(crate) struct Pressed<'a> {
    body: &'a Body,
    tissue: &'a Tissue,
    field: SurfaceField,
}

impl<'a> Pressed<'a> {
    pub(crate) fn new(body: &'a Body, tissue: &'a Tissue) -> Self {
        Self { body, tissue, field: SurfaceField::new(body, tissue) }
    }

    /// Displacement of every vertex.
    pub(crate) fn by(&mut self, impressions: &[Impression]) -> Vec<DVec3> {
        self.field.update(self.body, self.tissue, impressions.iter().copied());
        let mut moved = vec![DVec3::ZERO; self.body.mesh().vertices().len()];
        for (vertex, displacement) in self.field.vertices().iter().zip(self.field.displacements()) {
            moved[*vertex as usize] = *displacement;
        }
        moved
    }
}

/// Equal shares, and nothing that has a direction.
pub(crate) fn plain(mesh: &SurfaceMesh, harmonics: usize) -> ResponseParts {
    let mut parts = ResponseParts { chains: CHAINS, harmonics, ..ResponseParts::default() };
    let mut chain = vec![0.0; parts.coefficients_per_chain()];
    chain[0] = 1.0 / CHAINS as f32;
    parts.coefficients = chain.repeat(CHAINS * mesh.vertices().len());
    parts
}

/// A response whose vectors and tensors are given in the body: what belongs to a direction there, in whatever frame.
pub(crate) fn turned(mesh: &SurfaceMesh, rotation: DMat3) -> ResponseParts {
    let mut parts = plain(mesh, 2);
    let per_chain = parts.coefficients_per_chain();
    let vectors = [DVec3::new(0.2, -0.1, 0.3), DVec3::new(-0.1, 0.25, 0.1), DVec3::new(0.15, 0.1, -0.2)];
    let axes = [DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.8, 0.0, -0.6)];
    for (normal, here) in
        mesh.vertex_normals().iter().zip(parts.coefficients.chunks_exact_mut(CHAINS * per_chain))
    {
        let [first, second] = tangent_frame(*normal);
        for chain in here.chunks_exact_mut(per_chain) {
            chain[5] = 0.1;
            for (begin, (vector, axis)) in [1, 6, 10].into_iter().zip(vectors.into_iter().zip(axes)) {
                let (vector, axis) = (rotation * vector, rotation * axis);
                let (x, y) = (axis.dot(first), axis.dot(second));
                chain[begin] = vector.dot(first) as f32;
                chain[begin + 1] = vector.dot(second) as f32;
                chain[begin + 2] = (0.2 * (x * x - y * y)) as f32;
                chain[begin + 3] = (0.4 * x * y) as f32;
            }
        }
    }
    parts.modes = 2;
    parts.amplitudes = mesh
        .vertices()
        .iter()
        .flat_map(|v| {
            let v = rotation.transpose() * *v;
            [(3.0 * v.x) as f32, (1.0 + 5.0 * v.y) as f32]
        })
        .collect();
    let mode = |bend: f64| {
        mesh.vertices().iter().flat_map(move |v| {
            let v = rotation.transpose() * *v;
            (rotation * DVec3::new(bend * v.y, v.z, bend * v.x)).as_vec3().to_array()
        })
    };
    parts.mode_fields = mode(1.0).chain(mode(-0.5)).collect();
    parts
}

pub(crate) fn calibrated(mesh: SurfaceMesh, parts: ResponseParts) -> Body {
    let response = Response::new(parts, &mesh).expect("accepted numbers");
    Body::new(mesh).with_response(response).expect("its own response")
}

pub(crate) fn mesh(points: (Vec<DVec3>, Vec<[u32; 3]>)) -> SurfaceMesh {
    SurfaceMesh::new(points.0, points.1).expect("a closed surface")
}
