//! `rhombus calibrate --body`: from a surface, its material and where it is held to a body that answers as elasticity says.
//!
//! ```text
//! options, region, surface, crossing   what is accepted
//! sites, chains                        where it is pressed, what is fitted
//! work, python, progress               the finite elements and the fit: Python programs in a folder
//! fit                                  what they found
//! errors, picture                      how good that is
//! ```

mod chains;
mod crossing;
mod errors;
mod fit;
mod options;
mod picture;
mod progress;
mod python;
mod region;
mod result;
mod sites;
mod surface;
mod work;

use std::fmt;
use std::path::{Path, PathBuf};

use anyhow::{bail, ensure};
use rhombus_chain::Body;
use scene::RegionError;
use serde::Serialize;

use super::write::{BodyLines, check_free_all};
use crate::reference::Reference;
use chains::{Candidate, Wanted};
pub(super) use options::BodyOptions;
use options::Material;
use progress::Progress;
use python::Python;
use region::Region;
use result::Made;
use sites::Sites;
use work::{Job, Work};

/// Radius of the contact where none is said, m.
const CONTACT_RADIUS_M: f64 = 0.005;

/// What the command line says besides [`BodyOptions`].
pub(super) struct Asked<'a> {
    pub(super) mesh: &'a str,
    /// `body.mesh` of the scene that is written.
    pub(super) lines: BodyLines,
    pub(super) young_pa: Option<f64>,
    pub(super) poisson: Option<f64>,
    pub(super) contact_radius_m: Option<f64>,
    pub(super) chains: Option<usize>,
    pub(super) output: &'a Path,
    pub(super) force: bool,
}

/// What was found and written. Field names and their order are the JSON.
#[derive(Serialize)]
pub(super) struct Calibrated {
    pub(super) written: Vec<PathBuf>,
    pub(super) chains: usize,
    pub(super) harmonics: usize,
    pub(super) modes: usize,
    pub(super) sites: usize,
    pub(super) errors: Vec<RegionError>,
}

impl fmt::Display for Calibrated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for path in &self.written {
            writeln!(f, "{} written", path.display())?;
        }
        let Self { chains, harmonics, modes, sites, .. } = self;
        writeln!(f, "{chains} chains, {harmonics} harmonics, {modes} body modes from {sites} sites")?;
        writeln!(f, "error at sites that were not used, median and worst")?;
        writeln!(f, "  whole surface    within 30 mm     force            sites")?;
        for region in &self.errors {
            for [median, worst] in [region.field, region.near_field, region.force] {
                write!(f, "  {:>6} {:>7} ", share(median), share(worst))?;
            }
            writeln!(f, " {:>4}  {}", region.sites, region.region)?;
        }
        Ok(())
    }
}

/// A share in percent, one decimal.
fn share(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// A calibration whose input is accepted.
struct Calibration<'a> {
    asked: Asked<'a>,
    body: Body,
    material: Material,
    fixed: &'a [Region],
    held: Vec<bool>,
    contact_radius_m: f64,
    reference: Option<Reference>,
    wanted: Wanted,
    sites: Sites,
    candidates: Vec<Candidate>,
    modes: Vec<usize>,
}

/// Calibrates a body.
///
/// # Errors
/// What is not accepted, said before anything is run or written; what the Python programs say; an interruption, after which
/// the same command goes on; what cannot be written.
pub(super) fn calibrate(options: &BodyOptions, mut asked: Asked<'_>) -> anyhow::Result<Calibrated> {
    asked.lines.scale = options.scale;
    let outputs = result::outputs(asked.output)?;
    check_free_all(outputs.all(), asked.force)?;
    let calibration = Calibration::new(options, asked)?;
    let python = Python::find(&options.python)?;
    let work = Work::open(&outputs.work, &calibration.job())?;
    let mut presses = Progress::new("presses, batch");
    python.run("press.py", &work, &mut presses)?;
    drop(presses);
    if !work.fit().exists() {
        let mut fits = Progress::new("fits");
        python.run("fit.py", &work, &mut fits)?;
    }
    let made = Made::new(&calibration, &work)?;
    python.check_stopped(&work)?;
    let calibrated = made.write(&calibration, &outputs)?;
    if !options.keep_work {
        work.remove()?;
    }
    Ok(calibrated)
}

impl<'a> Calibration<'a> {
    fn new(options: &'a BodyOptions, asked: Asked<'a>) -> anyhow::Result<Self> {
        let material = options.material(asked.young_pa, asked.poisson)?;
        let fixed = options.fixed()?;
        let wanted: Wanted = options.wanted(asked.chains)?;
        let surface::Surface { body, colours } = surface::read(asked.mesh, options.scale)?;
        let mesh = body.mesh();
        let [low, high] = mesh.extents();
        let contact_radius_m = asked.contact_radius_m.unwrap_or(CONTACT_RADIUS_M);
        options::check_contact_radius(contact_radius_m, high - low)?;
        let mut held = vec![false; mesh.vertices().len()];
        for region in fixed {
            for (held, inside) in held.iter_mut().zip(region.vertices(mesh, &colours)?) {
                *held |= inside;
            }
        }
        let words: Vec<&str> = fixed.iter().map(Region::text).collect();
        let words = words.join(", ");
        ensure!(
            held.contains(&true),
            "--fixed {words}: no vertex lies there, so nothing is held; accepted: a region with some of the {} vertices",
            held.len()
        );
        ensure!(
            held.contains(&false),
            "--fixed {words}: every vertex lies there, so nothing moves; accepted: a region with some of the {} vertices",
            held.len()
        );
        if let Some((_, region)) = &material.second {
            region.check_meets(&body)?;
        }
        let reference = match &options.held_out {
            Some(path) => Some(judge(path, &body, &material, &held, contact_radius_m)?),
            None => None,
        };
        let taken: Vec<usize> = reference.iter().flat_map(judging_vertices).collect();
        let sites = sites::choose(body.mesh(), &held, &taken, options.sites, contact_radius_m)?;
        let candidates = chains::candidates(&wanted, options.sites, contact_radius_m, high - low);
        let modes = chains::modes(&wanted, options.sites);
        Ok(Self {
            asked,
            body,
            material,
            fixed,
            held,
            contact_radius_m,
            reference,
            wanted,
            sites,
            candidates,
            modes,
        })
    }

    fn job(&self) -> Job<'_> {
        let second = self.material.second.as_ref();
        Job {
            mesh: self.body.mesh(),
            held: &self.held,
            sites: &self.sites,
            young_pa: self.material.young_pa,
            poisson: self.material.poisson,
            second: second.and_then(|(young_pa, region)| Some((*young_pa, region.solid()?))),
            contact_radius_m: self.contact_radius_m,
            pitch_m: chains::pitch_m(self.contact_radius_m),
            candidates: &self.candidates,
            modes: &self.modes,
        }
    }
}

/// The reference that judges: of this very body, held and pressed in the same way.
fn judge(
    path: &Path,
    body: &Body,
    material: &Material,
    held: &[bool],
    contact_radius_m: f64,
) -> anyhow::Result<Reference> {
    let reference = Reference::read(path)?;
    reference.check_mesh(body.mesh())?;
    let name = path.display();
    let sites = reference.held_out();
    ensure!(!sites.is_empty(), "{name}: held_out: no site is held out; accepted: one or more, which judge");
    if let Some(vertex) = (0..held.len()).find(|vertex| held[*vertex] != reference.fixed[*vertex]) {
        bail!(
            "{name}: fixed: vertex {vertex} (from 0) is {}held there, and by --fixed it is {}; accepted: the same vertices",
            if reference.fixed[vertex] { "" } else { "not " },
            if held[vertex] { "held" } else { "not" }
        );
    }
    for site in sites {
        let found = &reference.sites[site];
        let pairs = [
            ("contact_radius", found.contact_radius_m, contact_radius_m),
            ("young", found.young_pa, material.young_pa),
            ("poisson", found.poisson, material.poisson),
        ];
        for (array, found, wanted) in pairs {
            ensure!(
                (found / wanted - 1.0).abs() < 1e-9 || found == wanted,
                "{name}: {array}: {found} at site {site} (from 0); accepted: {wanted}, as this calibration has"
            );
        }
    }
    Ok(reference)
}

/// Vertices of the sites that judge.
fn judging_vertices(reference: &Reference) -> Vec<usize> {
    let sites = reference.held_out().into_iter();
    sites
        .flat_map(|site| reference.sites[site].contacts.iter().map(|contact| contact.vertex as usize))
        .collect()
}
