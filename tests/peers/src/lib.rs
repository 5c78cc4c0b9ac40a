//! Peers: other real-time models of soft bodies, implemented for comparison with the rhombus chains.
//!
//! Every peer gets the same [`Job`] (surface, tetrahedra, fixed base, material, contact) and answers the same question
//! ([`Peer`]): what force, and what displacement of every surface vertex. Each cites the publication it follows. Units are
//! SI; depths are positive into the body, forces are on the hand along the outward normal.

mod bem;
mod compliance;
mod contact;
mod fem;
mod job;
mod lem;
mod mass_spring;
mod pcmfs;
mod peer;
mod product;
mod s_chain;
mod sparse_factor;
mod volume;

pub use contact::patch;
pub use job::{Job, Material, SetupError};
pub use lem::Lem;
pub use mass_spring::MassSpring;
pub use peer::{Peer, PeerKind};
pub use s_chain::{MATCHED_DEPTH_M, SChain};
pub use volume::{TetMesh, VolumeError};

/// All peers, strongest first.
#[must_use]
pub fn all() -> &'static [PeerKind] {
    &[
        fem::FIRST_FULL,
        fem::FIRST_PATCH,
        fem::FIRST_FIXED,
        fem::SECOND_FULL,
        fem::SECOND_PATCH,
        fem::SECOND_FIXED,
        mass_spring::KIND,
        s_chain::KIND,
        lem::KIND,
        bem::FULL,
        bem::PATCH,
        pcmfs::KIND,
    ]
}
