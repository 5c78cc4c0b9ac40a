//! What the command line says about a body that is to be calibrated, checked by itself.

use std::path::PathBuf;

use anyhow::{bail, ensure};
use clap::{Args, ValueHint};
use glam::DVec3;
use rhombus_chain::{MOST_HARMONICS, MOST_MODES};

use super::chains::Wanted;
use super::region::Region;
use super::sites::{self, DEFAULT_SITES, MOST_SITES};

/// Options of `--body` alone.
#[derive(Args)]
#[group(skip)]
pub(in crate::calibrate) struct BodyOptions {
    /// Where the body is held: plane:NX,NY,NZ,D (n.x <= D), box:X0,Y0,Z0,X1,Y1,Z1, ball:X,Y,Z,R, vertices:FILE (numbers from 0),
    /// colour:#RRGGBB or facing:NX,NY,NZ,COSINE (normal . n >= COSINE); several together with several --fixed
    #[arg(long, value_name = "REGION", requires = "body")]
    fixed: Vec<Region>,
    /// Young's modulus of a part of the body, Pa; with --second-region
    #[arg(long, value_name = "E", requires = "body", requires = "second_region")]
    second_young: Option<f64>,
    /// That part: plane, box or ball as --fixed
    #[arg(long, value_name = "REGION", requires = "second_young")]
    second_region: Option<Region>,
    /// Factor that makes the coordinates of --body metres
    #[arg(long, value_name = "FACTOR", requires = "body", default_value_t = 1.0, value_parser = scale)]
    pub(super) scale: f64,
    /// Sites that --body is pressed at: 12 + 8 H or more, two or more for each body mode
    #[arg(long, value_name = "N", requires = "body", default_value_t = DEFAULT_SITES)]
    pub(super) sites: usize,
    /// Harmonics of the directional chains of --body, 0 to 2; by default the best
    #[arg(long, value_name = "H", requires = "body", value_parser = harmonics)]
    harmonics: Option<usize>,
    /// Body modes of --body; by default the best of 0 to 32
    #[arg(long, value_name = "J", requires = "body", value_parser = modes)]
    modes: Option<usize>,
    /// Reference solutions of --body: their held-out sites are not used, and judge the result
    #[arg(long, value_name = "REF.npz", requires = "body", value_hint = ValueHint::FilePath)]
    pub(super) held_out: Option<PathBuf>,
    /// Python with the packages of tests/reference/requirements.txt
    #[arg(long, value_name = "PROGRAM", requires = "body", default_value = "python3", value_hint = ValueHint::CommandName)]
    pub(super) python: PathBuf,
    /// Keep the work folder beside the output: other chains, harmonics or modes then take no new presses
    #[arg(long, requires = "body")]
    pub(super) keep_work: bool,
}

/// Elastic constants, accepted.
#[derive(Clone, Debug)]
pub(super) struct Material {
    pub(super) young_pa: f64,
    pub(super) poisson: f64,
    pub(super) second: Option<(f64, Region)>,
}

fn scale(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
    number.ok_or_else(|| "accepted: a finite number > 0".to_owned())
}

fn harmonics(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|harmonics| *harmonics <= MOST_HARMONICS);
    number.ok_or_else(|| format!("accepted: 0 to {MOST_HARMONICS}"))
}

fn modes(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|modes| *modes <= MOST_MODES);
    number.ok_or_else(|| format!("accepted: 0 to {MOST_MODES}"))
}

impl BodyOptions {
    /// The material: `--young` and `--poisson` with the second one.
    pub(super) fn material(&self, young_pa: Option<f64>, poisson: Option<f64>) -> anyhow::Result<Material> {
        let (Some(young_pa), Some(poisson)) = (young_pa, poisson) else {
            bail!("--body needs --young and --poisson");
        };
        check_young("--young", young_pa)?;
        ensure!(
            (0.0..0.5).contains(&poisson),
            "--poisson {poisson}; accepted: 0 up to, but not including, 0.5 (0.49 is as good as incompressible)"
        );
        let second = match (self.second_young, &self.second_region) {
            (Some(young_pa), Some(region)) => {
                check_young("--second-young", young_pa)?;
                ensure!(
                    region.solid().is_some(),
                    "--second-region {}; accepted: plane:NX,NY,NZ,D, box:X0,Y0,Z0,X1,Y1,Z1 or ball:X,Y,Z,R",
                    region.text()
                );
                Some((young_pa, region.clone()))
            }
            _ => None,
        };
        Ok(Material { young_pa, poisson, second })
    }

    /// Where the body is held.
    pub(super) fn fixed(&self) -> anyhow::Result<&[Region]> {
        ensure!(
            !self.fixed.is_empty(),
            "--body needs --fixed REGION, where the body is held: plane, box, ball, vertices, colour or facing (see --help)"
        );
        Ok(&self.fixed)
    }

    /// What is asked for of chains, harmonics and modes, when there are sites enough for it.
    pub(super) fn wanted(&self, chains: Option<usize>) -> anyhow::Result<Wanted> {
        let (harmonics, modes) = (self.harmonics.unwrap_or(0), self.modes.unwrap_or(0));
        let fewest = sites::fewest(harmonics, modes);
        ensure!(
            self.sites >= fewest,
            "--sites {}: too few for {harmonics} harmonics and {modes} body modes; accepted: {fewest} or more (12 + 8 H, and two \
             for each mode)",
            self.sites
        );
        ensure!(self.sites <= MOST_SITES, "--sites {}; accepted: up to {MOST_SITES}", self.sites);
        Ok(Wanted { chains, harmonics: self.harmonics, modes: self.modes })
    }
}

/// A contact that is no speck and not as large as the body.
pub(super) fn check_contact_radius(contact_radius_m: f64, size: DVec3) -> anyhow::Result<()> {
    let (least, most) = (size.length() / 200.0, size.min_element() / 6.0);
    ensure!(
        (least..=most).contains(&contact_radius_m),
        "--contact-radius {contact_radius_m}: out of proportion to a body of {:.4} x {:.4} x {:.4} m; accepted: {least:.5} to \
         {most:.5} m (1/200 of its diagonal to 1/6 of its shortest side)",
        size.x,
        size.y,
        size.z
    );
    Ok(())
}

fn check_young(option: &str, young_pa: f64) -> anyhow::Result<()> {
    ensure!(
        young_pa > 0.0 && young_pa.is_finite(),
        "{option} {young_pa}; accepted: a finite number greater than 0, Pa"
    );
    Ok(())
}
