//! Compares displacements as a field on the vertices: a vertex that is not listed is at rest.

use super::judge::{Found, Place};
use crate::messages::SurfaceDisplacement;

/// Compares vertex by vertex. A listed vertex without displacement is the same as one that is not listed.
///
/// # Errors
/// When a list is not ascending or has not three components for each vertex.
pub(super) fn on_vertices(
    golden: &SurfaceDisplacement,
    computed: &SurfaceDisplacement,
    found: &mut Found,
) -> Result<(), String> {
    let mut golden = Listed::new(golden).map_err(|reason| format!("golden: {reason}"))?;
    let mut computed = Listed::new(computed).map_err(|reason| format!("computed: {reason}"))?;
    while let Some(vertex) = [golden.vertex(), computed.vertex()].into_iter().flatten().min() {
        let (own, other) = (golden.take(vertex), computed.take(vertex));
        for (component, (golden, computed)) in ['x', 'y', 'z'].into_iter().zip(own.into_iter().zip(other)) {
            found.single(Place::Vertex(vertex, component), golden, computed);
        }
    }
    Ok(())
}

/// The vertices of a message, from the first.
struct Listed<'a> {
    vertices: &'a [u32],
    components: &'a [f32],
}

impl<'a> Listed<'a> {
    fn new(message: &'a SurfaceDisplacement) -> Result<Self, String> {
        let SurfaceDisplacement { vertex: vertices, displacement: components, .. } = message;
        if components.len() / 3 != vertices.len() || components.len() % 3 != 0 {
            let (vertices, components) = (vertices.len(), components.len());
            return Err(format!(
                "{components} components of displacement for {vertices} vertices; accepted are three each"
            ));
        }
        if let Some(place) = vertices.array_windows().position(|[one, next]| one >= next) {
            return Err(format!(
                "vertex[{}] is not above vertex[{place}]; accepted is an ascending list",
                place + 1
            ));
        }
        Ok(Self { vertices, components })
    }

    fn vertex(&self) -> Option<u32> {
        self.vertices.first().copied()
    }

    /// The displacement of a vertex that is not before the next listed one. A rest has no sign: no vertex differs by being
    /// listed with a negative zero.
    fn take(&mut self, vertex: u32) -> [f32; 3] {
        if self.vertex() != Some(vertex) {
            return [0.0; 3];
        }
        let (own, rest) = self.components.split_first_chunk().unwrap_or((&[0.0; 3], &[]));
        self.components = rest;
        self.vertices = self.vertices.get(1..).unwrap_or_default();
        if own.iter().all(|component| *component == 0.0) { [0.0; 3] } else { *own }
    }
}
