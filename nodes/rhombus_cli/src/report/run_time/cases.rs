//! Every method on every mesh: set up, timed, judged.

use std::collections::BTreeMap;
use std::time::Instant;

use anyhow::Result;
use glam::DVec3;
use rhombus_chain::{Body, StiffnessMap};
use rhombus_peers::{PeerKind, SetupError, TetMesh};

use super::stage::{Case, Stage};
use super::{REFERENCE, VERTICES};
use crate::report::bodies::{CalibratedBody, Kept};
use crate::report::lab::{Calibrated, MOST_CHAINS, SHORT_REACH_M};
use crate::report::section::{Context, Mode};
use crate::report::subject::{Model, Other};

/// A method on a mesh, and what became of it.
pub(super) struct Entry {
    /// The peer's name, `rhombus chains`, or `calibrated body` with what was taken away.
    pub(super) method: &'static str,
    /// The publication a peer follows.
    pub(super) citation: &'static str,
    /// Parallel chains and how they were calibrated; `None` for a peer and for what could not be read.
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
    /// By directions, for each vertex.
    Directional,
}

impl Variety {
    /// What is calibrated in this run.
    const ALL: [Variety; 3] = [Variety::Constant, Variety::Map, Variety::Short];

    /// In tables and legends.
    pub(super) fn name(self) -> String {
        match self {
            Variety::Constant => "constant".to_owned(),
            Variety::Map => "map".to_owned(),
            Variety::Short => format!("map, reach {:.0} mm", 1e3 * SHORT_REACH_M),
            Variety::Directional => "map of the calibrated body".to_owned(),
        }
    }
}

/// The model's name in tables.
pub(super) const MODEL: &str = "rhombus chains";
/// A calibrated body's.
pub(super) const CALIBRATED: &str = "calibrated body";
/// The same without its body modes.
pub(super) const WITHOUT_MODES: &str = "calibrated body without modes";
/// Its file.
const BODY: &str = "liver";
/// A peer's whole case may be expected to take this long, s; in full mode that holds beyond the body's own size.
const QUICK_S: f64 = 5.0;
const FULL_S: f64 = 300.0;

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
        if vertices == VERTICES {
            context.progress.step("calibrated body");
            entries.extend(directional(context, &stage));
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
    Ok(stage.model(&mut model, setup_s))
}

/// The calibrated body, whole and without its modes.
fn directional(context: &Context, stage: &Stage) -> [Entry; 2] {
    let read = context.lab.body(BODY).and_then(|body| {
        let reference = context.lab.reference(REFERENCE)?;
        body.sites(&reference, &reference.held_out())?;
        Ok(body)
    });
    let entry = |method, kept| {
        let case = |calibrated: &CalibratedBody| -> Result<Case> {
            let start = Instant::now();
            let body = calibrated.body(kept)?;
            let mut model = Model::new(&body, &calibrated.tissue);
            let setup_s = start.elapsed().as_secs_f64();
            Ok(stage.model(&mut model, setup_s))
        };
        let outcome = match &read {
            Ok(calibrated) => case(calibrated).map_err(|error| format!("{error:#}")),
            Err(error) => Err(format!("{error:#}")),
        };
        let chains = read.as_ref().map(|body| (body.header.chains.len(), Variety::Directional)).ok();
        Entry { method, citation: "", chains, chosen: false, vertices: VERTICES, outcome }
    };
    [entry(CALIBRATED, Kept::All), entry(WITHOUT_MODES, Kept::WithoutModes)]
}

fn peer(stage: &Stage, kind: &PeerKind, volume: Option<&TetMesh>) -> Result<Case, String> {
    let start = Instant::now();
    let limit_bytes = memory_limit_bytes();
    let peer = (kind.setup)(&stage.job(volume, limit_bytes)).map_err(|error| refusal(error, limit_bytes))?;
    let setup_s = start.elapsed().as_secs_f64();
    let mut other = Other::new(peer, stage.body.mesh().vertices().len());
    Ok(stage.peer(&mut other, setup_s))
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
