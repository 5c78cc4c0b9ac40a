//! Who is compared: our model and its peers behind the same questions, on the same body.

use glam::DVec3;
use rhombus_chain::{Body, Impression, Interaction, SurfaceField, Tissue};
use rhombus_peers::Peer;

use super::truth::{Score, TruthSite};

/// Where a contact is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Point of the surface, m.
    pub(crate) point: DVec3,
    /// Unit outward normal there.
    pub(crate) normal: DVec3,
    /// The nearest vertex.
    pub(crate) vertex: u32,
}

/// Something that answers a contact with a force and a displacement of every surface vertex.
pub(crate) trait Subject {
    /// One haptic period in which the contact has moved: the force on the hand along the normal, N, and the whole field.
    fn moved(&mut self, place: &Place, depth_m: f64) -> f64;

    /// One haptic period in which the contact has stayed where it was, at another depth.
    fn stayed(&mut self, place: &Place, depth_m: f64) -> f64;

    /// At rest at a place: the force, and the field written to `field`.
    fn settled(&mut self, place: &Place, depth_m: f64, field: &mut [DVec3]) -> f64;

    /// What it keeps in memory, bytes.
    fn bytes(&self) -> u64;
}

/// The rhombus chains: a session's own two calls, force and surface.
pub(crate) struct Model<'a> {
    body: &'a Body,
    tissue: &'a Tissue,
    interaction: Interaction,
    field: SurfaceField,
    stamp_ns: i64,
    /// The contact where it last moved to.
    held: Option<Impression>,
}

impl<'a> Model<'a> {
    /// Sets the memory aside.
    pub(crate) fn new(body: &'a Body, tissue: &'a Tissue) -> Self {
        Self {
            body,
            tissue,
            interaction: Interaction::new(),
            field: SurfaceField::new(body, tissue),
            stamp_ns: 0,
            held: None,
        }
    }

    /// The force alone.
    pub(crate) fn force(&mut self, place: &Place, depth_m: f64) -> f64 {
        let probe = place.point + place.normal * (self.tissue.probe_radius_m() - depth_m);
        self.stamp_ns += 1_000_000;
        // A place is finite and stamps rise: there is always an answer.
        self.interaction
            .step(self.body, self.tissue, self.stamp_ns, probe, false)
            .map_or(f64::NAN, |step| step.force_n.dot(place.normal))
    }
}

impl Subject for Model<'_> {
    fn moved(&mut self, place: &Place, depth_m: f64) -> f64 {
        let force_n = self.force(place, depth_m);
        self.held = self.interaction.impressions().next();
        self.field.update(self.body, self.tissue, self.held);
        force_n
    }

    fn stayed(&mut self, place: &Place, depth_m: f64) -> f64 {
        let held = self.held;
        let force_n = self.force(place, depth_m);
        // The probe's way in is straight but for rounding, which would move the contact by a hair's breadth.
        self.field.update(self.body, self.tissue, held.map(|held| Impression { depth_m, ..held }));
        force_n
    }

    fn settled(&mut self, place: &Place, depth_m: f64, field: &mut [DVec3]) -> f64 {
        self.interaction.reset();
        let centre_m = self.tissue.probe_radius_m();
        if depth_m > centre_m {
            // A hand comes from outside. A contact that began with the centre inside might begin on the other side of an edge.
            self.force(place, 0.5 * centre_m);
        }
        let force_n = self.moved(place, depth_m);
        field.fill(DVec3::ZERO);
        for (vertex, displacement) in self.field.vertices().iter().zip(self.field.displacements()) {
            field[*vertex as usize] = *displacement;
        }
        force_n
    }

    fn bytes(&self) -> u64 {
        let body = self.body.mesh().memory_bytes() + self.body.index().memory_bytes();
        let map = self.body.stiffness().map_or(0, rhombus_chain::StiffnessMap::memory_bytes);
        (body + map + self.field.memory_bytes()) as u64
    }
}

/// Anyone at every site, at one depth.
pub(crate) fn judge(subject: &mut dyn Subject, sites: &[TruthSite], depth_m: f64) -> Score {
    let mut field = Vec::new();
    let distances = sites.iter().map(|site| {
        field.resize(site.displacement.len(), DVec3::ZERO);
        let force_n = subject.settled(&Place::from(site), depth_m, &mut field);
        (site.site, site.distance(depth_m, force_n, &field))
    });
    Score(distances.collect())
}

impl From<&TruthSite> for Place {
    fn from(site: &TruthSite) -> Self {
        Self { point: site.point, normal: site.normal, vertex: site.vertex }
    }
}

/// A peer and the field it writes.
pub(crate) struct Other {
    peer: Box<dyn Peer>,
    field: Vec<DVec3>,
}

impl Other {
    /// For a body of so many vertices.
    pub(crate) fn new(peer: Box<dyn Peer>, vertices: usize) -> Self {
        Self { peer, field: vec![DVec3::ZERO; vertices] }
    }
}

impl Subject for Other {
    fn moved(&mut self, place: &Place, depth_m: f64) -> f64 {
        self.peer.touch(place.vertex, place.normal);
        self.peer.query(depth_m, &mut self.field)
    }

    fn stayed(&mut self, _: &Place, depth_m: f64) -> f64 {
        self.peer.query(depth_m, &mut self.field)
    }

    fn settled(&mut self, place: &Place, depth_m: f64, field: &mut [DVec3]) -> f64 {
        self.peer.touch(place.vertex, place.normal);
        self.peer.settle(depth_m, field)
    }

    fn bytes(&self) -> u64 {
        self.peer.bytes()
    }
}
