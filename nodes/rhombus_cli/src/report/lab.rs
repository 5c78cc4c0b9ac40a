//! Reference solutions, what is calibrated on them and what was calibrated before, each read or fitted once for a whole report.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;
use std::time::Instant;

use anyhow::{Context as _, Result, ensure};
use rhombus_chain::{Body, StiffnessMap, SurfaceMesh, Tissue};
use rhombus_cli::calibrate::sites;
use rhombus_cli::reference::Reference;

use super::bodies::CalibratedBody;
use super::half_space;
use super::progress::Progress;

/// Parallel chains that are calibrated: 1 to this many.
pub(crate) const MOST_CHAINS: usize = 5;

/// Where the surface of a calibration with a short reach ends, m from the edge of the contact: twice the near field.
pub(crate) const SHORT_REACH_M: f64 = 0.060;

/// Reference, number of chains, whether the reach is short.
type FitKey = (&'static str, usize, bool);

/// References and calibrations.
pub(crate) struct Lab {
    folder: PathBuf,
    references: RefCell<BTreeMap<&'static str, Rc<Reference>>>,
    fits: RefCell<BTreeMap<FitKey, Rc<Calibrated>>>,
    bodies: RefCell<BTreeMap<&'static str, Rc<CalibratedBody>>>,
}

/// Chains, and the regional stiffness map that goes with them, from the sites of a reference that are not held out.
pub(crate) struct Calibrated {
    /// Law, shape and probe.
    pub(crate) tissue: Tissue,
    /// The mesh of the reference with constant stiffness ...
    pub(crate) constant: Body,
    /// ... and with the map.
    pub(crate) mapped: Body,
    /// How long the calibration took, s.
    pub(crate) seconds: f64,
    /// Median near-field error at the sites that were used, as a share: by it the number of chains may be chosen.
    pub(crate) used_near: f64,
}

impl Lab {
    /// For a folder with `results/*.npz`, `tets/*.npz` and `bodies/*`.
    pub(crate) fn new(folder: PathBuf) -> Self {
        Self { folder, references: RefCell::default(), fits: RefCell::default(), bodies: RefCell::default() }
    }

    /// A reference by the stem of its file.
    ///
    /// # Errors
    /// There is no such file, with the command that makes it, or it is not accepted.
    pub(crate) fn reference(&self, name: &'static str) -> Result<Rc<Reference>> {
        if let Some(known) = self.references.borrow().get(name) {
            return Ok(Rc::clone(known));
        }
        let path = self.folder.join("results").join(format!("{name}.npz"));
        ensure!(
            path.is_file(),
            "{} is missing; make it with: python tests/reference/{}",
            path.display(),
            command_for(name)
        );
        let reference = Rc::new(Reference::read(&path)?);
        self.references.borrow_mut().insert(name, Rc::clone(&reference));
        Ok(reference)
    }

    /// A calibrated body by the stem of its files.
    ///
    /// # Errors
    /// Those of [`CalibratedBody::read`].
    pub(crate) fn body(&self, name: &'static str) -> Result<Rc<CalibratedBody>> {
        if let Some(known) = self.bodies.borrow().get(name) {
            return Ok(Rc::clone(known));
        }
        let body = Rc::new(CalibratedBody::read(&self.folder.join("bodies"), name)?);
        self.bodies.borrow_mut().insert(name, Rc::clone(&body));
        Ok(body)
    }

    /// The file of tetrahedra inside the liver of so many vertices.
    ///
    /// # Errors
    /// There is no such file, with the command that makes it.
    pub(crate) fn tetrahedra(&self, vertices: usize) -> Result<PathBuf> {
        let path = self.folder.join("tets").join(format!("liver_{vertices}.npz"));
        ensure!(
            path.is_file(),
            "{} is missing; make it with: python tests/reference/liver.py tets",
            path.display()
        );
        Ok(path)
    }

    /// So many chains, calibrated on a reference.
    ///
    /// # Errors
    /// The reference is missing or cannot be fitted.
    pub(crate) fn calibrated(
        &self,
        name: &'static str,
        chains: usize,
        progress: &Progress,
    ) -> Result<Rc<Calibrated>> {
        self.calibrated_within(name, chains, false, progress)
    }

    /// The same with a surface that ends [`SHORT_REACH_M`] from the contact, if `short`.
    ///
    /// # Errors
    /// Those of [`calibrated`](Self::calibrated).
    pub(crate) fn calibrated_within(
        &self,
        name: &'static str,
        chains: usize,
        short: bool,
        progress: &Progress,
    ) -> Result<Rc<Calibrated>> {
        let key = (name, chains, short);
        if let Some(known) = self.fits.borrow().get(&key) {
            return Ok(Rc::clone(known));
        }
        let reference = self.reference(name)?;
        progress.step(&format!("calibrating {} on {name}", half_space::name(chains)));
        let start = Instant::now();
        let reach_m = if short { SHORT_REACH_M } else { f64::INFINITY };
        let fitted = sites::fit_within(&reference, chains, true, reach_m)
            .with_context(|| format!("{name}: {} cannot be calibrated", half_space::name(chains)))?;
        let seconds = start.elapsed().as_secs_f64();
        let mesh = SurfaceMesh::new(reference.vertices.clone(), reference.faces.clone())?;
        let factors = fitted.map.context("the calibration has no map")?;
        let map = StiffnessMap::new(factors, &mesh)?;
        let near = fitted.used.iter().map(|site| site.near_rel_l2).collect();
        let calibrated = Rc::new(Calibrated {
            tissue: fitted.fitted.tissue()?,
            constant: Body::new(mesh.clone()),
            mapped: Body::new(mesh).with_stiffness(map)?,
            seconds,
            used_near: rhombus_cli::calibrate::errors::median(near),
        });
        self.fits.borrow_mut().insert(key, Rc::clone(&calibrated));
        Ok(calibrated)
    }
}

impl Calibrated {
    /// The body with the map or without.
    pub(crate) fn body(&self, mapped: bool) -> &Body {
        if mapped { &self.mapped } else { &self.constant }
    }
}

/// The program of tests/reference that makes a file.
fn command_for(name: &str) -> &str {
    match name {
        "liver_nu" => "liver.py nu",
        "liver_inclusion" => "liver.py inclusion",
        "liver_two" => "liver.py two",
        "liver_nonlinear" => "nonlinear.py",
        "block_r5" => "bodies.py block",
        "wedge_r5" => "bodies.py wedge",
        _ => "liver.py sites",
    }
}
