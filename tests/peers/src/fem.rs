//! Finite elements, condensed to the surface.
//!
//! Linear elasticity on the tetrahedra of the body, solved before the session: the compliance of the surface,
//! C = S K⁻¹ Sᵀ (K: stiffness of all nodes that can move, S: takes those on the surface), is dense and, for a body of a
//! few thousand vertices, small enough to multiply with. Inner nodes are gone.
//!
//! In second order a disc acts on the vertices and on the middles of edges it covers: with vertices alone a contact of a few nodes
//! is a fifth too soft. So there are columns for both; the answer, like every peer's, has rows for the vertices alone.

mod assembly;
mod condensed;
mod element;
mod fixed_contact;

use crate::PeerKind;
use element::Order;

const CITATION: &str = "M. Bro-Nielsen, S. Cotin, Computer Graphics Forum 15(3), 57-66, 1996; S. Cotin, H. Delingette, N. Ayache, IEEE TVCG 5(1), 62-73, 1999";

macro_rules! kind {
    ($kind:ident, $name:literal, $setup:path, $order:expr) => {
        #[doc = $name]
        pub(crate) const $kind: PeerKind =
            PeerKind { name: $name, citation: CITATION, setup: |job| $setup($name, job, $order) };
    };
}

kind!(FIRST_FULL, "condensed FEM, 1st order, full product", condensed::full, Order::First);
kind!(FIRST_PATCH, "condensed FEM, 1st order, patch columns", condensed::patch, Order::First);
kind!(FIRST_FIXED, "FEM, 1st order, fixed contact", fixed_contact::fixed, Order::First);
kind!(SECOND_FULL, "condensed FEM, 2nd order, full product", condensed::full, Order::Second);
kind!(SECOND_PATCH, "condensed FEM, 2nd order, patch columns", condensed::patch, Order::Second);
kind!(SECOND_FIXED, "FEM, 2nd order, fixed contact", fixed_contact::fixed, Order::Second);
