//! The command line of `rhombus calibrate`.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::{Args, ValueHint};
use rhombus_chain::Formulation;
use scene::{Parameters, Reader, Scene, Value};
use serde::Serialize;

use super::body::{self, Asked, BodyOptions};
use super::errors::median;
use super::fitted::{Fitted, MOST_CHAINS};
use super::half_space::{self, Contact, HalfSpace};
use super::measured::Measured;
use super::recording;
use super::sites;
use super::table::Table;
use super::write::{BodyLines, Output, check_free, percent};
use crate::output;
use crate::reference::Reference;

/// Fit chains to a body by finite elements, to a half-space, to measurements or to reference solutions; writes a scene
///
/// The error that was reached stands at the top of the file, with what the data could not tell. Every law that is written is
/// accepted by the model. Lengths in m, forces in N, pressures in Pa; a table says its units in its header.
///
/// With --body a closed surface, a material and where it is held become a body that answers in every direction and at every
/// place as elasticity says:
///
/// rhombus calibrate --body organ.obj --young 10000 --poisson 0.45 --fixed facing:0,0,-1,0.7 -o organ.body
///
/// Finite elements (second order) press it at --sites places and directional chains are fitted to them; how many, with how many
/// harmonics and body modes, is decided by the error at sites that a fit did not use. Beside the body's file stand organ.yaml, a
/// scene that uses it, and organ.svg, the error over the surface. An interrupted run goes on with the same command, in
/// organ.body.work.
///
/// It takes minutes, and a Python (--python) with the packages of tests/reference/requirements.txt:
///
/// python3 -m venv venv && venv/bin/pip install -r tests/reference/requirements.txt
#[derive(Args)]
#[command(allow_negative_numbers = true)]
pub struct Calibrate {
    #[command(flatten)]
    target: Target,
    #[command(flatten)]
    body_options: BodyOptions,
    /// Parameter file to write, a regional stiffness map goes beside it; of --body its own file, the parameter file beside it
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: PathBuf,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// Parallel chains; 3 by default, of --body the best of 3 to 6
    #[arg(long, value_name = "P", value_parser = chains)]
    chains: Option<usize>,
    /// energy or published; energy unless --contact sphere, whose force only the published law can follow
    #[arg(long, value_name = "LAW", conflicts_with_all = ["reference", "body"])]
    formulation: Option<Formulation>,
    /// Poisson's ratio of the half-space (greater than -1, up to 0.5) or of --body (0 up to, but not including, 0.5)
    #[arg(long, value_name = "NU", requires = "young", allow_hyphen_values = true)]
    poisson: Option<f64>,
    /// What presses the half-space, and so which force is fitted: F = 2 E* R d or Hertz
    #[arg(long, requires = "young", conflicts_with = "body", default_value = "flat")]
    contact: Contact,
    /// Largest depth of the half-space's force, m; the probe's radius by default
    #[arg(long, value_name = "M", requires = "young", conflicts_with = "body")]
    depth: Option<f64>,
    /// Radius of the probe, m; of --table 0.005 by default
    #[arg(long, value_name = "M", conflicts_with_all = ["recording", "reference", "body"])]
    probe_radius: Option<f64>,
    /// Radius of the contact, m: of --table the probe's by default, of --body 0.005
    #[arg(long, value_name = "M", conflicts_with_all = ["recording", "reference"])]
    contact_radius: Option<f64>,
    /// Depth at which the surface of --table was measured, m; the displacement of its first point by default
    #[arg(long, value_name = "M", requires = "table")]
    profile_depth: Option<f64>,
    /// Scene with the body: of the recorded session, or of the references
    #[arg(long, value_name = "PARAMS.yaml", conflicts_with_all = ["young", "table", "body"], value_hint = ValueHint::FilePath)]
    scene: Option<PathBuf>,
    /// Sub-namespace of the recorded device, where there are several
    #[arg(long, value_name = "NAME", requires = "recording")]
    device: Option<String>,
    /// Mesh of the references: an OBJ file in metres or a generated body
    #[arg(
        long,
        value_name = "FILE",
        requires = "reference",
        conflicts_with = "scene",
        default_value = "liver"
    )]
    mesh: String,
    /// Regional stiffness map: on with 8 sites or more by default
    #[arg(long, value_name = "on|off", requires = "reference", value_parser = on_or_off)]
    map: Option<bool>,
    /// Where the surface of --reference ends, m from the edge of the contact: less of it moves, at less cost
    #[arg(long, value_name = "M", requires = "reference", default_value_t = f64::INFINITY, hide_default_value = true)]
    reach: f64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// One of them; `--young` is the material of `--body`, and without it a half-space.
#[derive(Args)]
#[group(required = true, multiple = true)]
struct Target {
    /// Body: an OBJ file or a generated one (liver, block, sphere); with --young, --poisson and --fixed
    #[arg(long, value_name = "MESH", requires = "young", requires = "poisson")]
    body: Option<String>,
    /// Young's modulus, Pa: of --body, or of an elastic half-space with --poisson and --probe-radius
    #[arg(long, value_name = "E", requires = "poisson", allow_hyphen_values = true)]
    young: Option<f64>,
    /// Measured depths and forces, or distances and displacements of the surface, or both: CSV, units in the header
    #[arg(long, value_name = "DATA.csv", conflicts_with_all = ["body", "young"], value_hint = ValueHint::FilePath)]
    table: Option<PathBuf>,
    /// Recorded poses and measured forces; with --scene
    #[arg(long, value_name = "BAG", requires = "scene", conflicts_with_all = ["body", "young", "table"],
          value_hint = ValueHint::AnyPath)]
    recording: Option<PathBuf>,
    /// Reference solutions at many sites of a body
    #[arg(long, value_name = "FILE.npz", conflicts_with_all = ["body", "young", "table", "recording"],
          value_hint = ValueHint::FilePath)]
    reference: Option<PathBuf>,
}

/// Parallel chains where none are asked for.
const CHAINS: usize = 3;

fn chains(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|chains| (1..=MOST_CHAINS).contains(chains));
    number.ok_or_else(|| format!("accepted: 1 to {MOST_CHAINS}"))
}

fn on_or_off(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("accepted: on or off".to_owned()),
    }
}

/// Field names and their order are the JSON.
#[derive(Serialize)]
struct Summary {
    written: Vec<PathBuf>,
    chains: usize,
    reached: Vec<Line>,
    not_told: Vec<String>,
}

#[derive(Serialize)]
struct Line {
    relative: f64,
    what: String,
}

/// What was fitted, before it is written.
struct Found {
    fitted: Fitted,
    source: String,
    body: Option<BodyLines>,
    map: Option<Vec<f64>>,
}

impl Calibrate {
    /// Runs the command.
    ///
    /// # Errors
    /// What is not accepted of the command line or the data, or why the files cannot be written.
    pub fn run(self) -> anyhow::Result<()> {
        if let Some(mesh) = &self.target.body {
            return self.body(mesh);
        }
        check_free(&self.output, false, self.force)?;
        let found = match &self.target {
            Target { young: Some(young_pa), .. } => self.half_space(*young_pa)?,
            Target { table: Some(path), .. } => self.table(path)?,
            Target { recording: Some(path), .. } => self.recording(path)?,
            Target { reference: Some(path), .. } => self.reference(path)?,
            _ => bail!("accepted: one of --body, --young, --table, --recording, --reference"),
        };
        let Found { fitted, source, body, map } = &found;
        // What the model would refuse is not written.
        fitted.tissue()?;
        let output = Output { fitted, source, body: body.clone(), map: map.as_deref(), beside: Vec::new() };
        let written = output.write(&self.output, self.force)?;
        self.print(written, fitted)
    }

    fn body(&self, mesh: &str) -> anyhow::Result<()> {
        let asked = Asked {
            mesh,
            lines: BodyLines { mesh: self.mesh_seen_from_output(mesh)?, scale: 1.0, response: None },
            young_pa: self.target.young,
            poisson: self.poisson,
            contact_radius_m: self.contact_radius,
            chains: self.chains,
            output: &self.output,
            force: self.force,
        };
        let calibrated = body::calibrate(&self.body_options, asked)?;
        match self.json {
            true => output::json(&calibrated),
            false => output::text(&calibrated.to_string()),
        }
    }

    fn chains(&self) -> usize {
        self.chains.unwrap_or(CHAINS)
    }

    fn half_space(&self, young_pa: f64) -> anyhow::Result<Found> {
        let (Some(poisson), Some(radius_m), None) = (self.poisson, self.probe_radius, self.contact_radius)
        else {
            bail!("--young without --body needs --poisson and --probe-radius, and no --contact-radius");
        };
        let depth_m = self.depth.unwrap_or(radius_m);
        let target = HalfSpace { young_pa, poisson, radius_m, contact: self.contact, depth_m };
        let (formulation, probe) = match self.contact {
            Contact::Flat => (Formulation::Energy, "flat punch"),
            Contact::Sphere => (Formulation::Published, "sphere"),
        };
        let fitted = half_space::fit(&target, self.formulation.unwrap_or(formulation), self.chains())?;
        let source = format!(
            "an elastic half-space of E = {young_pa:?} Pa, nu = {poisson:?}, pressed by a {probe} of radius {radius_m:?} m"
        );
        Ok(Found { fitted, source, body: None, map: None })
    }

    fn table(&self, path: &Path) -> anyhow::Result<Found> {
        const PROBE_RADIUS_M: f64 = 0.005;
        let Table { force, profile } = Table::read(path)?;
        let probe_radius_m = self.probe_radius.unwrap_or(PROBE_RADIUS_M);
        let contact_radius_m = self.contact_radius.unwrap_or(probe_radius_m);
        let measured = Measured {
            force,
            profile,
            profile_depth_m: self.profile_depth,
            probe_radius_m,
            contact_radius_m,
        };
        let fitted = measured.fit(self.formulation.unwrap_or_default(), self.chains());
        let fitted = fitted.with_context(|| path.display().to_string())?;
        let source = format!("the measurements of {}", file_name(path));
        Ok(Found { fitted, source, body: None, map: None })
    }

    fn recording(&self, path: &Path) -> anyhow::Result<Found> {
        let (scene, body_lines) = self.scene()?;
        let body = scene.load_body()?.body;
        let tissue = scene.tissue()?;
        let recorded = recording::read(path, &scene, &body, &tissue, self.device.as_deref())?;
        let contact_radius_m = Some(scene.probe.contact_radius_m)
            .filter(|radius_m| *radius_m > 0.0)
            .unwrap_or(scene.probe.radius_m);
        let source = format!(
            "{} measured forces of {}, recorded on the body of {}; {} forces without contact were not used",
            recorded.force.len(),
            file_name(path),
            self.scene.as_deref().map(file_name).unwrap_or_default(),
            recorded.unused
        );
        let measured = Measured {
            force: recorded.force,
            profile: Vec::new(),
            profile_depth_m: None,
            probe_radius_m: scene.probe.radius_m,
            contact_radius_m,
        };
        let fitted = measured.fit(self.formulation.unwrap_or_default(), self.chains());
        let fitted = fitted.with_context(|| path.display().to_string())?;
        Ok(Found { fitted, source, body: Some(body_lines), map: None })
    }

    fn reference(&self, path: &Path) -> anyhow::Result<Found> {
        let reference = Reference::read(path)?;
        let (scene, body_lines) = self.scene()?;
        let body = scene.load_body()?.body;
        reference.check_mesh(body.mesh())?;
        let with_map = self.map.unwrap_or(reference.used().len() >= sites::FEWEST_FOR_MAP);
        check_free(&self.output, with_map, self.force)?;
        let found = sites::fit_within(&reference, self.chains(), with_map, self.reach)?;
        let mut source = format!(
            "{} reference solutions of {}; {} more were held out to judge",
            found.used.len(),
            file_name(path),
            found.held_out.len()
        );
        if with_map && !found.held_out.is_empty() {
            let constant_n_per_m = found.fitted.law()?.rest_stiffness_n_per_m();
            let constant = reference.held_out().into_iter().flat_map(|site| {
                let contacts = reference.sites[site].contacts.iter();
                contacts.map(|contact| (constant_n_per_m / contact.stiffness_n_per_m - 1.0).abs())
            });
            let mapped = found.held_out.iter().map(|error| error.force_rel);
            source += &format!(
                "; one stiffness for the whole body leaves {} of their force (median), the map {}",
                percent(median(constant.collect())),
                percent(median(mapped.collect()))
            );
        }
        Ok(Found { fitted: found.fitted, source, body: Some(body_lines), map: found.map })
    }

    /// The scene with the body, and how the written file names that body.
    fn scene(&self) -> anyhow::Result<(Scene, BodyLines)> {
        let parameters = match &self.scene {
            Some(file) => Parameters::from_file(file, Reader::Everything)?,
            None => {
                let mesh = ("body.mesh".to_owned(), Value::String(self.mesh.clone()));
                Parameters::from_values([mesh], scene::Origin::named("--mesh"))?
            }
        };
        let scene = Scene::from_parameters(parameters)?;
        let mesh = match &scene.body.mesh {
            scene::MeshSource::BuiltIn(kind) => kind.name().to_owned(),
            scene::MeshSource::File(file) => self.seen_from_output(file)?,
        };
        let scale = scene.body.scale;
        Ok((scene, BodyLines { mesh, scale, response: None }))
    }

    /// What `body.mesh` of the written file says for `--body`.
    fn mesh_seen_from_output(&self, mesh: &str) -> anyhow::Result<String> {
        match mesh.parse::<scene::BodyKind>() {
            Ok(kind) => Ok(kind.name().to_owned()),
            Err(_) => self.seen_from_output(Path::new(mesh)),
        }
    }

    /// The name of a file as the written file has to say it: bare when both are in one folder, absolute otherwise.
    fn seen_from_output(&self, file: &Path) -> anyhow::Result<String> {
        let file = file.canonicalize().with_context(|| format!("{}: cannot be read", file.display()))?;
        let folder = self.output.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok();
        let beside = folder.is_some_and(|folder| file.parent() == Some(&folder));
        Ok(if beside { file_name(&file) } else { file.display().to_string() })
    }

    fn print(&self, written: Vec<PathBuf>, fitted: &Fitted) -> anyhow::Result<()> {
        if self.json {
            let reached = fitted.reached.iter().map(|r| Line { relative: r.relative, what: r.what.clone() });
            return output::json(&Summary {
                written,
                chains: fitted.chains.len(),
                reached: reached.collect(),
                not_told: fitted.notes.clone(),
            });
        }
        let mut text: String = written.iter().map(|path| format!("{} written\n", path.display())).collect();
        text += "error reached\n";
        for reached in &fitted.reached {
            text += &format!("  {:>9}  {}\n", percent(reached.relative), reached.what);
        }
        text += "not told by the data\n";
        for note in &fitted.notes {
            text += &format!("  {note}\n");
        }
        output::text(&text)
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
