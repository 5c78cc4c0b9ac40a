//! Every method on every mesh: set up, timed, judged.

use std::collections::BTreeMap;
use std::time::Instant;

use anyhow::Result;
use glam::DVec3;
use rhombus_benches::walk_on_surface;
use rhombus_chain::{Body, StiffnessMap, SurfaceMesh};
use rhombus_peers::{Job, Material, PeerKind, SetupError, TetMesh};
use scene::{BodyKind, generate};

use super::{REFERENCE, VERTICES};
use crate::report::clockwork::{FEWEST, Times, times};
use crate::report::lab::{Calibrated, MOST_CHAINS, SHORT_REACH_M};
use crate::report::section::{Context, Mode};
use crate::report::subject::{Model, Other, Place, Subject};
use crate::report::truth::{self, Score, TruthSite};

/// A method on a mesh, and what became of it.
pub(super) struct Entry {
    /// The peer's name, or `rhombus chains`.
    pub(super) method: &'static str,
    /// The publication a peer follows.
    pub(super) citation: &'static str,
    /// Parallel chains and how they were calibrated; `None` for a peer.
    pub(super) chains: Option<(usize, Variety)>,
    /// The number of chains that a user would choose, by the sites used: it stands in the verdicts.
    pub(super) chosen: bool,
    /// Vertices of the surface.
    pub(super) vertices: usize,
    /// Its numbers, or why it could not be set up.
    pub(super) outcome: Result<Case, String>,
}

/// How chains were calibrated.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Variety {
    /// One stiffness for the whole body.
    Constant,
    /// With the regional map.
    Map,
    /// With the map, and a surface that ends [`SHORT_REACH_M`] from the contact.
    Short,
}

impl Variety {
    const ALL: [Variety; 3] = [Variety::Constant, Variety::Map, Variety::Short];

    /// In tables and legends.
    pub(super) fn name(self) -> String {
        match self {
            Variety::Constant => "constant".to_owned(),
            Variety::Map => "map".to_owned(),
            Variety::Short => format!("map, reach {:.0} mm", 1e3 * SHORT_REACH_M),
        }
    }
}

/// Numbers of a method on a mesh.
pub(super) struct Case {
    /// Force and field, contact moves between the calls.
    pub(super) moved: Times,
    /// Force and field, the depth alone changes.
    pub(super) stayed: Times,
    /// Force alone, contact moves; the model can, a peer has no such call.
    pub(super) force: Option<Times>,
    /// At the held-out sites.
    pub(super) score: Score,
    /// From mesh and parameters to the first query, s.
    pub(super) setup_s: f64,
    /// What it keeps, bytes.
    pub(super) bytes: u64,
}

/// The model's name in tables.
pub(super) const MODEL: &str = "rhombus chains";
/// How deep sites are pressed when methods are timed, m; a share of it more and less.
const DEPTH_M: f64 = 0.005;
/// How deep sites are pressed when methods are judged, m: within the small strains that the references mean, and where the
/// peers with a nonlinear force are matched.
const JUDGED_DEPTH_M: f64 = 0.001;
/// Way of the contact between two queries, m.
const STRIDE_M: f64 = 0.003;
/// Queries of the model up to 5000 vertices; on larger meshes in proportion fewer, and peers get the fewest that make a median.
const MODEL_REPEATS: usize = 300;
/// A peer's whole case may be expected to take this long, s; in full mode that holds beyond the body's own size.
const QUICK_S: f64 = 5.0;
const FULL_S: f64 = 300.0;

/// A mesh with everything that is asked on it.
struct Stage {
    body: Body,
    fixed: Vec<bool>,
    sites: Vec<TruthSite>,
    walk: Vec<Place>,
}

pub(super) fn measure(context: &Context, model_sizes: &[usize], peer_sizes: &[usize]) -> Result<Vec<Entry>> {
    let fits = |short: bool| {
        (1..=MOST_CHAINS)
            .map(|chains| context.lab.calibrated_within(REFERENCE, chains, short, context.progress))
            .collect::<Result<Vec<_>>>()
    };
    let (calibrated, short) = (fits(false)?, fits(true)?);
    let near = |index: &usize| calibrated[*index].used_near;
    let chosen = (0..MOST_CHAINS).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
    let mut sizes: Vec<usize> = model_sizes.iter().chain(peer_sizes).copied().collect();
    sizes.sort_unstable();
    sizes.dedup();
    let mut entries = Vec::new();
    let mut spent = Spent::default();
    for vertices in sizes {
        context.progress.step(&format!("liver of {vertices} vertices"));
        let stage = Stage::new(context, &calibrated[0].constant, vertices)?;
        if model_sizes.contains(&vertices) {
            for index in 0..MOST_CHAINS {
                for variety in Variety::ALL {
                    let fit = if variety == Variety::Short { &short[index] } else { &calibrated[index] };
                    entries.push(Entry {
                        method: MODEL,
                        citation: "",
                        chains: Some((index + 1, variety)),
                        chosen: index == chosen,
                        vertices,
                        outcome: Ok(model(&stage, fit, variety != Variety::Constant)?),
                    });
                }
            }
        }
        if peer_sizes.contains(&vertices) {
            let volume =
                context.lab.tetrahedra(vertices).ok().map(|path| TetMesh::read(&path)).transpose()?;
            for kind in rhombus_peers::all() {
                let outcome = match spent.allows(context.mode, kind.name, vertices) {
                    Err(why) => Err(refused_at_once(&stage, kind, volume.as_ref()).unwrap_or(why)),
                    Ok(()) => {
                        context.progress.step(&format!("{vertices} vertices: {}", kind.name));
                        let start = Instant::now();
                        let outcome = peer(&stage, kind, volume.as_ref());
                        spent.note(kind.name, vertices, start.elapsed().as_secs_f64());
                        outcome
                    }
                };
                entries.push(Entry {
                    method: kind.name,
                    citation: kind.citation,
                    chains: None,
                    chosen: false,
                    vertices,
                    outcome,
                });
            }
        }
    }
    Ok(entries)
}

/// How long each peer's case took on the mesh before, so that a run ends in its time.
#[derive(Default)]
struct Spent(BTreeMap<&'static str, (usize, f64)>);

impl Spent {
    fn note(&mut self, name: &'static str, vertices: usize, seconds: f64) {
        self.0.insert(name, (vertices, seconds));
    }

    /// Whether the case may be measured. Dense systems grow with the square of the vertices or faster.
    fn allows(&self, mode: Mode, name: &str, vertices: usize) -> Result<(), String> {
        let limit_s = match mode {
            Mode::Quick => QUICK_S,
            Mode::Full if vertices <= VERTICES => return Ok(()),
            Mode::Full => FULL_S,
        };
        let Some((before, seconds)) = self.0.get(name) else { return Ok(()) };
        let expected_s = seconds * (vertices as f64 / *before as f64).powi(2);
        if expected_s <= limit_s {
            return Ok(());
        }
        Err(match mode {
            Mode::Quick => format!("only in --full: about {expected_s:.0} s or more"),
            Mode::Full => format!("not measured: about {:.0} min or more", expected_s / 60.0),
        })
    }
}

impl Stage {
    fn new(context: &Context, surface: &Body, vertices: usize) -> Result<Self> {
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

    fn job<'a>(&'a self, volume: Option<&'a TetMesh>, memory_limit_bytes: u64) -> Job<'a> {
        Job {
            surface: self.body.mesh(),
            volume,
            fixed: volume.map_or(&self.fixed, |volume| &volume.fixed),
            material: Material { young_pa: 10e3, poisson: 0.45 },
            contact_radius_m: DEPTH_M,
            memory_limit_bytes,
        }
    }

    /// Times and judges a subject that is set up.
    fn case(&self, subject: &mut dyn Subject, repeats: usize, setup_s: f64) -> Case {
        let place = |repeat: usize| &self.walk[repeat % self.walk.len()];
        let depth = |repeat: usize| DEPTH_M * (1.0 - 0.01 * (repeat % 10) as f64);
        let moved = times(repeats, |repeat| subject.moved(place(repeat), depth(repeat)));
        let last = place(repeats.saturating_sub(1));
        let stayed = times(repeats, |repeat| subject.stayed(last, depth(repeat)));
        let mut field = vec![DVec3::ZERO; self.body.mesh().vertices().len()];
        let distances = self.sites.iter().map(|site| {
            let place = Place { point: site.point, normal: site.normal, vertex: site.vertex };
            let force_n = subject.settled(&place, JUDGED_DEPTH_M, &mut field);
            (site.site, site.distance(JUDGED_DEPTH_M, force_n, &field))
        });
        let score = Score(distances.collect());
        Case { moved, stayed, force: None, score, setup_s, bytes: subject.bytes() }
    }
}

/// The chains on a mesh that they may not have been calibrated on: the map is carried over by closest points.
fn model(stage: &Stage, calibrated: &Calibrated, mapped: bool) -> Result<Case> {
    let start = Instant::now();
    let mut body = Body::new(stage.body.mesh().clone());
    if let (true, Some(map)) = (mapped, calibrated.mapped.stiffness()) {
        let source = &calibrated.mapped;
        let factor = |&vertex: &DVec3| {
            source.index().closest(source.mesh(), vertex, f64::INFINITY).map_or(1.0, |(at, _)| map.at(&at))
        };
        let factors = body.mesh().vertices().iter().map(factor).collect();
        let map = StiffnessMap::new(factors, body.mesh())?;
        body = body.with_stiffness(map)?;
    }
    let mut model = Model::new(&body, &calibrated.tissue);
    let setup_s = start.elapsed().as_secs_f64();
    let repeats = (MODEL_REPEATS * 5000 / body.mesh().vertices().len()).clamp(FEWEST, MODEL_REPEATS);
    let mut case = stage.case(&mut model, repeats, setup_s);
    case.force = Some(times(repeats, |repeat| model.force(&stage.walk[repeat % stage.walk.len()], DEPTH_M)));
    Ok(case)
}

fn peer(stage: &Stage, kind: &PeerKind, volume: Option<&TetMesh>) -> Result<Case, String> {
    let start = Instant::now();
    let limit_bytes = memory_limit_bytes();
    let peer = (kind.setup)(&stage.job(volume, limit_bytes)).map_err(|error| refusal(error, limit_bytes))?;
    let setup_s = start.elapsed().as_secs_f64();
    let mut other = Other::new(peer, stage.body.mesh().vertices().len());
    Ok(stage.case(&mut other, FEWEST, setup_s))
}

/// Why a peer that would take too long to measure could not be set up anyway. It is given no memory at all, so that whoever
/// asks for memory is refused before anything is computed.
fn refused_at_once(stage: &Stage, kind: &PeerKind, volume: Option<&TetMesh>) -> Option<String> {
    let limit_bytes = memory_limit_bytes();
    match (kind.setup)(&stage.job(volume, 0)).err()? {
        SetupError::DoesNotFit { needed_bytes, .. } if needed_bytes <= limit_bytes => None,
        other => Some(refusal(other, limit_bytes)),
    }
}

fn refusal(error: SetupError, limit_bytes: u64) -> String {
    match error {
        SetupError::DoesNotFit { needed_bytes, .. } => {
            let [needed, limit] = [needed_bytes, limit_bytes].map(|bytes| bytes as f64 / 1e9);
            format!("does not fit: {needed:.1} GB (free: {limit:.1} GB)")
        }
        SetupError::NoVolume => "needs tetrahedra; tests/reference/tets has none of this size".to_owned(),
        other => other.to_string(),
    }
}

/// Nine tenths of the memory that is free now.
fn memory_limit_bytes() -> u64 {
    let text = std::fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"));
    let kilobytes = line.and_then(|line| line.trim().split(' ').next()?.parse::<u64>().ok());
    kilobytes.map_or(4 << 30, |kilobytes| kilobytes * 1024 / 10 * 9)
}
