//! What every peer answers.

use glam::DVec3;

use crate::{Job, SetupError};

/// A model of one body, set up for one job.
///
/// A contact is a rigid flat disc, see [`patch`](crate::patch): its vertices have `u . normal = -depth` and are free along
/// the disc; the base is fixed.
pub trait Peer {
    /// The name of its kind, as in [`PeerKind::name`].
    fn name(&self) -> &'static str;

    /// What its precomputed data and its state take, in bytes.
    fn bytes(&self) -> u64;

    /// The contact moves: the disc now lies at a surface vertex, with the unit outward normal given. What a session
    /// pays whenever the contact moves. To be called before the first query.
    fn touch(&mut self, vertex: u32, normal: DVec3);

    /// One haptic period: the displacement of every surface vertex in metres (body frame, all entries are written), and
    /// the force on the hand along the normal in N, positive pushes out. Allocates nothing.
    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64;

    /// As [`query`](Self::query), at rest: models that step through time step until nothing moves.
    fn settle(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        self.query(depth_m, displacements)
    }
}

/// A kind of peer.
#[derive(Clone, Copy, Debug)]
pub struct PeerKind {
    /// Short name for tables and plots.
    pub name: &'static str,
    /// The publication it follows.
    pub citation: &'static str,
    /// Prepares it for a job; may take minutes.
    pub setup: fn(&Job) -> Result<Box<dyn Peer>, SetupError>,
}
