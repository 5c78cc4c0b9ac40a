//! Boundary elements: the body without its inside.
//!
//! Direct collocation with Kelvin's solution on the triangles of the surface, displacement and traction linear on
//! each and continuous (nodes: the vertices). With one row of blocks for each vertex, H u = G t (Brebbia's form). The base is held (its
//! traction is unknown), everywhere else the traction is given, so that one dense factorisation gives the compliance of the
//! free vertices: what ArtDefo precomputes. The force on a vertex is its hat of traction: a third of the adjoining area.

mod boundary;
mod kelvin;
mod quadrature;
mod system;

use crate::PeerKind;
use crate::compliance::Layout;
use crate::product::{FullProduct, PatchColumns};

const CITATION: &str = "D. L. James, D. K. Pai, ArtDefo, SIGGRAPH 1999, 65-72";

/// The full product in every period.
pub(crate) const FULL: PeerKind = PeerKind {
    name: "BEM, full product",
    citation: CITATION,
    setup: |job| {
        let compliance = system::surface_compliance(job, Layout::Rows)?;
        Ok(Box::new(FullProduct::new(FULL.name, job, compliance)))
    },
};

/// The columns of the touched vertices only.
pub(crate) const PATCH: PeerKind = PeerKind {
    name: "BEM, patch columns",
    citation: CITATION,
    setup: |job| {
        let compliance = system::surface_compliance(job, Layout::Columns)?;
        Ok(Box::new(PatchColumns::new(PATCH.name, job, compliance)))
    },
};
