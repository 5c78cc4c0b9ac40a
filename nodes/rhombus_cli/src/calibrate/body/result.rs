//! What is written at the end: the body's file, a scene that uses it, a picture of its error.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow, bail};
use rhombus_chain::{ChainParameters, Formulation, Response, StiffnessMap, SurfaceParameters};
use scene::{ChainShape, RegionError, ResponseFile, ResponseHeader, mesh_checksum};

use super::errors::{self, Judged};
use super::fit::{self, Fit};
use super::region::Region;
use super::work::Work;
use super::{Calibrated, Calibration, picture};
use crate::calibrate::errors::{Which, at_sites};
use crate::calibrate::fitted::{Fitted, Reached};
use crate::calibrate::regional::RegionalFactors;
use crate::calibrate::write::{BodyLines, Output, percent};

/// Names of what is written, and of the folder beside it.
pub(super) struct Outputs {
    response: PathBuf,
    scene: PathBuf,
    picture: PathBuf,
    pub(super) work: PathBuf,
}

impl Outputs {
    /// The files.
    pub(super) fn all(&self) -> [PathBuf; 3] {
        [&self.response, &self.scene, &self.picture].map(Clone::clone)
    }
}

/// From the name of the body's file.
pub(super) fn outputs(output: &Path) -> anyhow::Result<Outputs> {
    let taken = output.extension().is_some_and(|end| end == "yaml" || end == "svg" || end == "work");
    let Some(name) = output.file_name().filter(|_| !taken) else {
        bail!(
            "--output {}; accepted: the name of a file, not ending in .yaml, .svg or .work, which are written beside it",
            output.display()
        );
    };
    let mut work = name.to_owned();
    work.push(".work");
    Ok(Outputs {
        response: output.to_owned(),
        scene: output.with_extension("yaml"),
        picture: output.with_extension("svg"),
        work: output.with_file_name(work),
    })
}

/// A calibrated body, complete and judged.
pub(super) struct Made {
    fit: Fit,
    parameters: Vec<ChainParameters>,
    factors: Vec<f64>,
    judged: Vec<Judged>,
    errors: Vec<RegionError>,
    fitted: Fitted,
}

impl Made {
    /// Puts together what the Python programs found.
    ///
    /// # Errors
    /// Their files are not of this job, or hold what the model does not accept.
    pub(super) fn new(calibration: &Calibration<'_>, work: &Work) -> anyhow::Result<Self> {
        let mesh = calibration.body.mesh();
        let vertices = &calibration.sites.vertices;
        let stiffnesses = fit::stiffnesses(work, &calibration.sites.batches)?;
        let fit = fit::read(work, mesh.vertices().len(), vertices.len(), &calibration.candidates)?;
        let radius_m = calibration.contact_radius_m;
        let regional = RegionalFactors::new(mesh, &calibration.held, radius_m, vertices, &stiffnesses)
            .context("the stiffness between the sites: they are too much alike to be told apart")?;
        // What the file holds in single precision is what is judged.
        let factors = regional.factors.iter().map(|factor| f64::from(*factor as f32)).collect();
        let force = regional.interpolation.errors.iter().map(|e| (libm::exp(-e) - 1.0).abs());
        let judged: Vec<Judged> = (vertices.iter().zip(&fit.site_errors).zip(force))
            .map(|((vertex, [field, near]), force)| Judged {
                vertex: *vertex,
                field: *field,
                near: *near,
                force,
            })
            .collect();
        let [low, high] = mesh.extents();
        let parameters = fit.candidate.parameters(regional.stiffness, 0.5 * (high - low).min_element());
        let surface = SurfaceParameters {
            cutoff: 0.0,
            contact_radius_m: calibration.contact_radius_m,
            ..SurfaceParameters::default()
        };
        let fitted = Fitted {
            formulation: Formulation::Energy,
            chains: parameters.clone(),
            surface,
            probe_radius_m: calibration.contact_radius_m,
            reached: Vec::new(),
            notes: Vec::new(),
        };
        let errors = errors::by_region(mesh, &calibration.held, calibration.contact_radius_m, &judged);
        let mut made = Self { fit, parameters, factors, judged, errors, fitted };
        made.judge(calibration)?;
        made.fitted.reached = reached(&made.errors);
        Ok(made)
    }

    /// Whether the model accepts it, and how far the product's own field and force are from the reference.
    fn judge(&mut self, calibration: &Calibration<'_>) -> anyhow::Result<()> {
        let refused = |reason: String| anyhow!("the model does not accept what was fitted: {reason}");
        let body = calibration.body.clone();
        let map = StiffnessMap::new(self.factors.clone(), body.mesh());
        let map = map.map_err(|error| refused(error.to_string()))?;
        let response = Response::new(self.fit.parts.clone(), body.mesh());
        let response = response.map_err(|error| refused(error.to_string()))?;
        let body = body.with_stiffness(map).map_err(|error| refused(error.to_string()))?;
        let body = body.with_response(response).map_err(|error| refused(error.to_string()))?;
        let tissue = self.fitted.tissue()?;
        if let Some(reference) = &calibration.reference {
            self.errors.extend(errors::at_reference(&at_sites(&body, &tissue, reference, Which::HeldOut)?));
        }
        Ok(())
    }

    /// Writes the files; the scene comes last.
    ///
    /// # Errors
    /// One of them cannot be written; none is left half-written.
    pub(super) fn write(
        self,
        calibration: &Calibration<'_>,
        outputs: &Outputs,
    ) -> anyhow::Result<Calibrated> {
        let mesh = calibration.body.mesh();
        let name = outputs.response.file_name().unwrap_or_default().to_string_lossy();
        let title = format!("{name}: error of the calibrated body {}", mesh_name(calibration));
        let picture = picture::draw(mesh, &self.judged, &title);
        let (chains, harmonics, modes) =
            (self.fit.parts.chains, self.fit.parts.harmonics, self.fit.parts.modes);
        let file = ResponseFile {
            header: ResponseHeader {
                vertices: mesh.vertices().len(),
                mesh_crc32: mesh_checksum(mesh),
                chains: self.parameters.iter().map(ChainShape::of).collect(),
                contact_radius_m: calibration.contact_radius_m,
                harmonics,
                modes,
                made: self.made(calibration),
                errors: self.errors.clone(),
            },
            parts: self.fit.parts,
            factors: self.factors.iter().map(|factor| *factor as f32).collect(),
        };
        let bytes = file.to_bytes().map_err(|reason| anyhow!("{}: {reason}", outputs.response.display()))?;
        let material = material(calibration);
        let source =
            format!("elasticity at {} sites of the body: {material}", calibration.sites.vertices.len());
        let body = BodyLines { response: Some(name.into_owned()), ..calibration.asked.lines.clone() };
        let output = Output {
            fitted: &self.fitted,
            source: &source,
            body: Some(body),
            map: None,
            beside: vec![(outputs.picture.clone(), picture.into_bytes()), (outputs.response.clone(), bytes)],
        };
        let mut written = output.write(&outputs.scene, calibration.asked.force)?;
        // The body's file first: it is what was asked for.
        written.sort_by_key(|path| *path != outputs.response);
        let sites = calibration.sites.vertices.len();
        Ok(Calibrated { written, chains, harmonics, modes, sites, errors: self.errors })
    }

    /// How the body was made: the same words for the same input.
    fn made(&self, calibration: &Calibration<'_>) -> Vec<String> {
        let sites: Vec<String> = calibration.sites.vertices.iter().map(ToString::to_string).collect();
        let held = calibration.held.iter().filter(|held| **held).count();
        let mut made = vec![
            format!("rhombus {}", env!("CARGO_PKG_VERSION")),
            command(calibration),
            format!("material: {}", material(calibration)),
            format!("held: {held} of {} vertices, {}", calibration.held.len(), words(calibration.fixed)),
            format!("sites ({}): {}", sites.len(), sites.join(" ")),
        ];
        made.extend(self.fit.choices.iter().enumerate().map(|(place, choice)| {
            format!(
                "{} P {} H {} J {}: whole field {} median, {} worst, near field {} median",
                if place == self.fit.chosen { "chosen" } else { "tried" },
                choice.chains,
                choice.harmonics,
                choice.modes,
                percent(choice.median),
                percent(choice.worst),
                percent(choice.near)
            )
        }));
        made
    }
}

fn words(regions: &[Region]) -> String {
    regions.iter().map(Region::words).collect::<Vec<_>>().join(", ")
}

fn material(calibration: &Calibration<'_>) -> String {
    let material = &calibration.material;
    let second = material.second.as_ref();
    let second = second.map(|(young_pa, region)| format!(", E = {young_pa:?} Pa in {}", region.text()));
    format!("E = {:?} Pa, nu = {:?}{}", material.young_pa, material.poisson, second.unwrap_or_default())
}

fn mesh_name(calibration: &Calibration<'_>) -> String {
    let mesh = Path::new(&calibration.asked.lines.mesh);
    mesh.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The command that makes the same body again, but for names of folders, programs and outputs.
fn command(calibration: &Calibration<'_>) -> String {
    let material = &calibration.material;
    let lines = &calibration.asked.lines;
    let mesh = mesh_name(calibration);
    let mut command = format!(
        "rhombus calibrate --body {mesh} --young {:?} --poisson {:?}",
        material.young_pa, material.poisson
    );
    if lines.scale != 1.0 {
        command += &format!(" --scale {:?}", lines.scale);
    }
    for region in calibration.fixed {
        command += &format!(" --fixed {}", region.words());
    }
    if let Some((young_pa, region)) = &material.second {
        command += &format!(" --second-young {young_pa:?} --second-region {}", region.text());
    }
    command += &format!(
        " --sites {} --contact-radius {:?}",
        calibration.sites.vertices.len(),
        calibration.contact_radius_m
    );
    if let Some(reference) = &calibration.reference {
        let name = Path::new(&reference.file).file_name().unwrap_or_default().to_string_lossy();
        command += &format!(" --held-out {name}");
    }
    let options = calibration.wanted;
    for (option, value) in
        [("chains", options.chains), ("harmonics", options.harmonics), ("modes", options.modes)]
    {
        if let Some(value) = value {
            command += &format!(" --{option} {value}");
        }
    }
    command
}

/// The errors as every calibration says them.
fn reached(errors: &[RegionError]) -> Vec<Reached> {
    let line = |region: &RegionError| {
        let parts = [
            ("whole surface", region.field),
            ("surface within 30 mm", region.near_field),
            ("force", region.force),
        ];
        let sites = if region.sites == 1 { "1 site".to_owned() } else { format!("{} sites", region.sites) };
        let words = format!("{}, {sites}", region.region);
        parts
            .into_iter()
            .flat_map(move |(part, [median, worst])| {
                [("median", median), ("worst", worst)]
                    .map(|(which, relative)| Reached { what: format!("{words}: {part}, {which}"), relative })
            })
            .collect::<Vec<_>>()
    };
    errors.iter().flat_map(line).collect()
}
