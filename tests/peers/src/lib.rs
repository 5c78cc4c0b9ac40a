//! Peers: other real-time models of soft bodies, implemented for comparison with the rhombus chains.
//!
//! Every peer gets the same [`Job`] (surface, tetrahedra, fixed base, material, contact) and answers the same question
//! ([`Peer`]): what force, and what displacement of every surface vertex. Each cites the publication it follows. Units are
//! SI; depths are positive into the body, forces are on the hand along the outward normal.

mod contact;
mod job;
mod peer;
mod volume;

pub use contact::patch;
pub use job::{Job, Material, SetupError};
pub use peer::{Peer, PeerKind};
pub use volume::{TetMesh, VolumeError};

/// All peers, strongest first.
#[must_use]
pub fn all() -> &'static [PeerKind] {
    &[]
}
