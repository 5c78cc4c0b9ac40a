//! A body with everything that is asked on it: sites that judge, a walk that times.

use anyhow::Result;
use rhombus_benches::walk_on_surface;
use rhombus_chain::{Body, SurfaceMesh};
use rhombus_peers::{Job, Material, TetMesh};
use scene::{BodyKind, generate};

use super::REFERENCE;
use crate::report::clockwork::{FEWEST, Times, times};
use crate::report::section::Context;
use crate::report::subject::{self, Model, Place, Subject};
use crate::report::truth::{self, Score, TruthSite};

/// Numbers of a method on a mesh.
pub(crate) struct Case {
    /// Force and field, contact moves between the calls.
    pub(crate) moved: Times,
    /// Force and field, the depth alone changes.
    pub(crate) stayed: Times,
    /// Force alone, contact moves; the model can, a peer has no such call.
    pub(crate) force: Option<Times>,
    /// At the held-out sites.
    pub(crate) score: Score,
    /// From mesh and parameters to the first query, s.
    pub(crate) setup_s: f64,
    /// What it keeps, bytes.
    pub(crate) bytes: u64,
}

/// How deep sites are pressed when methods are timed, m; a share of it more and less.
const DEPTH_M: f64 = 0.005;
/// How deep sites are pressed when methods are judged, m: within the small strains that the references mean, and where the
/// peers with a nonlinear force are matched.
const JUDGED_DEPTH_M: f64 = 0.001;
/// Way of the contact between two queries, m.
const STRIDE_M: f64 = 0.003;
/// Queries of the model up to 5000 vertices; on larger meshes in proportion fewer, and peers get the fewest that make a median.
const MODEL_REPEATS: usize = 300;

/// A mesh with everything that is asked on it.
pub(crate) struct Stage {
    pub(super) body: Body,
    fixed: Vec<bool>,
    sites: Vec<TruthSite>,
    walk: Vec<Place>,
}

impl Stage {
    /// The generated liver of so many vertices. `surface`: that of the reference.
    ///
    /// # Errors
    /// The reference is missing.
    pub(crate) fn new(context: &Context, surface: &Body, vertices: usize) -> Result<Self> {
        let reference = context.lab.reference(REFERENCE)?;
        let shape = generate::body(BodyKind::Liver, vertices);
        let body = Body::new(SurfaceMesh::new(shape.vertices, shape.triangles)?);
        let mesh = body.mesh();
        // The flat underside, by the rule of the reference solutions.
        let fixed: Vec<bool> = mesh.vertex_normals().iter().map(|normal| normal.z < -0.7).collect();
        let sites = truth::on(mesh, &reference, surface, &reference.held_out());
        let walk = walk_on_surface(mesh, 2 * MODEL_REPEATS, STRIDE_M)
            .into_iter()
            .filter_map(|(point, normal)| {
                let (at, _) = body.index().closest(mesh, point, f64::INFINITY)?;
                let corners = mesh.triangles()[at.face as usize];
                let apart = |corner: &u32| mesh.vertices()[*corner as usize].distance(point);
                let vertex = corners.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
                (!fixed[vertex as usize]).then_some(Place { point, normal, vertex })
            })
            .collect();
        Ok(Self { body, fixed, sites, walk })
    }

    /// What a peer is set up for.
    pub(super) fn job<'a>(&'a self, volume: Option<&'a TetMesh>, memory_limit_bytes: u64) -> Job<'a> {
        Job {
            surface: self.body.mesh(),
            volume,
            fixed: volume.map_or(&self.fixed, |volume| &volume.fixed),
            material: Material { young_pa: 10e3, poisson: 0.45 },
            contact_radius_m: DEPTH_M,
            memory_limit_bytes,
        }
    }

    /// Times and judges a peer that is set up.
    pub(super) fn peer(&self, peer: &mut dyn Subject, setup_s: f64) -> Case {
        self.case(peer, FEWEST, setup_s)
    }

    /// Times and judges the model: force and surface, and the force alone.
    pub(crate) fn model(&self, model: &mut Model, setup_s: f64) -> Case {
        let repeats = (MODEL_REPEATS * 5000 / self.body.mesh().vertices().len()).clamp(FEWEST, MODEL_REPEATS);
        Case { force: Some(self.force(model, repeats)), ..self.case(model, repeats, setup_s) }
    }

    /// Times the force alone.
    pub(crate) fn force(&self, model: &mut Model, repeats: usize) -> Times {
        times(repeats, |repeat| model.force(&self.walk[repeat % self.walk.len()], DEPTH_M))
    }

    fn case(&self, subject: &mut dyn Subject, repeats: usize, setup_s: f64) -> Case {
        let place = |repeat: usize| &self.walk[repeat % self.walk.len()];
        let depth = |repeat: usize| DEPTH_M * (1.0 - 0.01 * (repeat % 10) as f64);
        let moved = times(repeats, |repeat| subject.moved(place(repeat), depth(repeat)));
        let last = place(repeats.saturating_sub(1));
        let stayed = times(repeats, |repeat| subject.stayed(last, depth(repeat)));
        let score = subject::judge(subject, &self.sites, JUDGED_DEPTH_M);
        Case { moved, stayed, force: None, score, setup_s, bytes: subject.bytes() }
    }
}
