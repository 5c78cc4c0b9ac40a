//! The folder in which the Python programs work: what they are given, and whether it is there from an interrupted run.
//!
//! `job.json` and raw arrays beside it (little-endian, C order, m), see `elasticity/work.py`. `job.json` is written last, so a
//! folder that has one has everything. What only the fit needs may change between runs; presses stay.

use std::fs::File;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail, ensure};
use rhombus_chain::SurfaceMesh;
use serde_json::{Value, json};

use super::chains::Candidate;
use super::sites::{self, Sites};
use crate::calibrate::errors::NEAR_M;
use crate::calibrate::write::{HIDDEN, put};

include!(concat!(env!("OUT_DIR"), "/elasticity.rs"));

const JOB: &str = "job.json";
const LOCK: &str = "lock";
const FIT: &str = "fit.npz";
/// Parts of the sites, each judged by a fit without it.
const FOLDS: usize = 5;
/// Parts of the job that change no press.
const FIT_ONLY: [&str; 4] = ["candidates", "modes", "folds", "ramp_m"];

/// What is asked of the Python programs.
pub(super) struct Job<'a> {
    pub(super) mesh: &'a SurfaceMesh,
    pub(super) held: &'a [bool],
    pub(super) sites: &'a Sites,
    pub(super) young_pa: f64,
    pub(super) poisson: f64,
    /// Young's modulus of a part of the body, and that part as the programs read it.
    pub(super) second: Option<(f64, Value)>,
    pub(super) contact_radius_m: f64,
    pub(super) pitch_m: f64,
    pub(super) candidates: &'a [Candidate],
    pub(super) modes: &'a [usize],
}

/// A folder with a job in it, held by this run alone.
#[derive(Debug)]
pub(super) struct Work {
    pub(super) folder: PathBuf,
    _lock: File,
}

impl Job<'_> {
    fn description(&self) -> Value {
        let candidates: Vec<Value> = self
            .candidates
            .iter()
            .map(|c| json!({"decays_m": c.decays_m, "reaches_m": c.reaches_m(), "harmonics": c.harmonics}))
            .collect();
        json!({
            "format": 1,
            // Presses of another version may be others.
            "rhombus": env!("CARGO_PKG_VERSION"),
            "vertices": self.mesh.vertices().len(),
            "faces": self.mesh.triangles().len(),
            "sites": self.sites.vertices,
            "batches": self.sites.batches,
            "young_pa": self.young_pa,
            "poisson": self.poisson,
            "second": self.second.as_ref().map(|(young_pa, region)| json!({"young_pa": young_pa, "region": region})),
            "contact_radius_m": self.contact_radius_m,
            "near_m": NEAR_M,
            "ramp_m": self.pitch_m.max(self.contact_radius_m),
            "folds": FOLDS,
            "candidates": candidates,
            "modes": self.modes,
        })
    }

    fn arrays(&self) -> [(&'static str, Vec<u8>); 5] {
        let numbers = |values: &[glam::DVec3]| {
            values.iter().flat_map(|v| v.to_array()).flat_map(f64::to_le_bytes).collect::<Vec<u8>>()
        };
        let faces = self.mesh.triangles().iter().flatten();
        let arcs = sites::arcs(self.mesh, &self.sites.vertices);
        [
            ("vertices.f64", numbers(self.mesh.vertices())),
            ("normals.f64", numbers(self.mesh.vertex_normals())),
            ("faces.i32", faces.flat_map(|corner| corner.to_le_bytes()).collect()),
            ("held.u8", self.held.iter().map(|held| u8::from(*held)).collect()),
            ("arcs.f32", arcs.into_iter().flat_map(f32::to_le_bytes).collect()),
        ]
    }
}

impl Work {
    /// Makes the folder, or goes on in one that an interrupted run of the same calibration left.
    ///
    /// # Errors
    /// The folder holds something else, or another run works in it; it cannot be written.
    pub(super) fn open(folder: &Path, job: &Job<'_>) -> anyhow::Result<Self> {
        let unwritable = || format!("{}: cannot be written", folder.display());
        let description = job.description();
        let arrays = job.arrays();
        let mut begun = false;
        if folder.symlink_metadata().is_ok() {
            begun = check_ours(folder, &description, &arrays)?;
        } else {
            std::fs::create_dir(folder).with_context(unwritable)?;
        }
        let lock = File::create(folder.join(LOCK)).with_context(unwritable)?;
        if lock.try_lock().is_err() {
            bail!(
                "{}: another run of this calibration works in it; accepted: one at a time",
                folder.display()
            );
        }
        let programs = folder.join("python");
        std::fs::create_dir_all(&programs).with_context(unwritable)?;
        for (name, text) in PROGRAMS {
            put(&programs.join(name), text.as_bytes(), true)?;
        }
        if !begun {
            for (name, bytes) in &arrays {
                put(&folder.join(name), bytes, true)?;
            }
        }
        if read_job(folder).as_ref() != Some(&description) {
            // A fit of other choices.
            match std::fs::remove_file(folder.join(FIT)) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(error).with_context(unwritable);
                }
                _ => {}
            }
            put(&folder.join(JOB), format!("{description:#}\n").as_bytes(), true)?;
        }
        Ok(Self { folder: folder.to_owned(), _lock: lock })
    }

    /// Where the fit is, when there is one.
    pub(super) fn fit(&self) -> PathBuf {
        self.folder.join(FIT)
    }

    /// Where the presses of a batch are.
    pub(super) fn press(&self, batch: usize) -> PathBuf {
        self.folder.join(format!("press_{batch}.npz"))
    }

    /// Takes it away with everything in it.
    ///
    /// # Errors
    /// It cannot be removed.
    pub(super) fn remove(self) -> anyhow::Result<()> {
        let folder = &self.folder;
        std::fs::remove_dir_all(folder).with_context(|| format!("{}: cannot be removed", folder.display()))
    }
}

fn read_job(folder: &Path) -> Option<Value> {
    serde_json::from_slice(&std::fs::read(folder.join(JOB)).ok()?).ok()
}

/// Whether a folder already has the whole job.
///
/// # Errors
/// It holds the work of another calibration, or what is none.
fn check_ours(folder: &Path, description: &Value, arrays: &[(&str, Vec<u8>)]) -> anyhow::Result<bool> {
    let name = folder.display();
    let accepted = "accepted: the work folder of this very calibration; remove it or choose another --output";
    let entries = std::fs::read_dir(folder).with_context(|| format!("{name}: cannot be read; {accepted}"))?;
    if !folder.join(JOB).exists() {
        // Cut off while it was made.
        for entry in entries {
            let entry = entry.with_context(|| format!("{name}: cannot be read"))?.file_name();
            let entry = entry.to_string_lossy();
            let known = arrays.iter().any(|(array, _)| *array == entry)
                || [LOCK, "python"].contains(&&*entry)
                || entry.starts_with(HIDDEN);
            ensure!(known, "{name}: holds {entry}, which is no part of a calibration; {accepted}");
        }
        return Ok(false);
    }
    let Some(found) = read_job(folder) else {
        bail!("{name}: its {JOB} cannot be read; {accepted}");
    };
    let keys = description.as_object().into_iter().flat_map(|job| job.keys());
    for key in keys.filter(|key| !FIT_ONLY.contains(&key.as_str())) {
        ensure!(
            found.get(key) == description.get(key),
            "{name}: holds the work of another calibration ({key} differs); {accepted}"
        );
    }
    for (array, bytes) in arrays {
        let same = std::fs::read(folder.join(array)).is_ok_and(|found| found == *bytes);
        ensure!(same, "{name}: holds the work of another calibration ({array} differs); {accepted}");
    }
    Ok(true)
}
