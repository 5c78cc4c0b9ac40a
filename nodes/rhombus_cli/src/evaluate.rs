//! `rhombus evaluate`: the contact law and the surface around one contact, for one depth or one force.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, ValueHint};
use rhombus_chain::{ContactLaw, ContactShape, SurfaceParameters};
use serde::Serialize;

use crate::assignments::Assignments;
use crate::output;

/// Force, stiffness and surface shape of a contact law at one depth, or at the depth that one force needs.
///
/// Only the chains.* parameters are needed; no mesh and no stiffness map is loaded. Depth is positive into the body, every force is on the
/// hand and positive pushes out; dl_1, d_theta and dw_1 have the model's signs (negative dl_1 is pressed).
#[derive(Args)]
pub(crate) struct Evaluate {
    /// ROS 2 parameter file with chains.*
    #[arg(value_name = "PARAMS.yaml", value_hint = ValueHint::FilePath)]
    parameters: PathBuf,
    #[command(flatten)]
    assignments: Assignments,
    #[command(flatten)]
    at: At,
    /// Displacement of the surface at these distances: arc length from the contact less probe.contact_radius, m
    #[arg(long, value_name = "S1,S2,..", value_delimiter = ',', allow_hyphen_values = true, value_parser = distance)]
    profile: Vec<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct At {
    /// Depth, positive into the body, m
    #[arg(long, value_name = "M", allow_hyphen_values = true, value_parser = finite)]
    depth: Option<f64>,
    /// Force on the hand, positive pushes out, N
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = finite)]
    force: Option<f64>,
}

fn finite(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| "accepted: a finite number".to_owned())
}

fn distance(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|s| *s >= 0.0).ok_or_else(|| "accepted: a finite number >= 0, in m".to_owned())
}

/// The answer; field names and their order are the JSON.
#[derive(Serialize)]
struct Evaluation {
    depth_m: f64,
    force_n: f64,
    stiffness_n_per_m: f64,
    saturated: bool,
    formulation: String,
    chains: Vec<ChainEvaluation>,
    profile: Vec<ProfilePoint>,
    /// Every force and stiffness above is multiplied by its factor at the contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness_map: Option<PathBuf>,
}

#[derive(Serialize)]
struct ChainEvaluation {
    force_n: f64,
    dl_1_m: f64,
    d_theta_rad: f64,
    dw_1_m: f64,
    /// Units up to the boundary, `m` of the model.
    boundary_units: f64,
}

#[derive(Serialize)]
struct ProfilePoint {
    s_m: f64,
    normal_m: f64,
    tangential_m: f64,
}

impl Evaluate {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        let scene = self.assignments.scene(&self.parameters)?;
        let law = scene.law()?;
        let depth_m = match self.at {
            At { force: Some(force_n), .. } => {
                law.depth_for_force(force_n).with_context(|| format!("--force {force_n:?}"))?
            }
            At { depth, .. } => depth.unwrap_or(0.0),
        };
        let mut evaluation = evaluate(&law, &scene.surface_parameters(), depth_m, &self.profile)?;
        evaluation.stiffness_map = scene.body.stiffness_file().map(Path::to_owned);
        match self.json {
            true => output::json(&evaluation),
            false => output::text(&evaluation.to_string()),
        }
    }
}

fn evaluate(
    law: &ContactLaw,
    surface: &SurfaceParameters,
    depth_m: f64,
    distances_m: &[f64],
) -> anyhow::Result<Evaluation> {
    let response = law.at_depth(depth_m)?;
    let mut shape = ContactShape::new(law, surface)?;
    shape.set_depth(law, depth_m)?;
    let chains = law.chains().iter().enumerate().map(|(index, chain)| {
        let chain = chain.response(-depth_m);
        ChainEvaluation {
            force_n: unsigned_zero(-chain.force_n),
            dl_1_m: unsigned_zero(chain.dl_1_m),
            d_theta_rad: unsigned_zero(chain.d_theta_rad),
            dw_1_m: unsigned_zero(chain.dw_1_m),
            boundary_units: shape.boundary_units(index),
        }
    });
    let profile = distances_m.iter().map(|s_m| {
        let moved = shape.displacement(*s_m, s_m + surface.contact_radius_m);
        ProfilePoint {
            s_m: *s_m,
            normal_m: unsigned_zero(moved.normal_m),
            tangential_m: unsigned_zero(moved.tangential_m),
        }
    });
    Ok(Evaluation {
        depth_m: unsigned_zero(depth_m),
        force_n: unsigned_zero(response.force_n),
        stiffness_n_per_m: response.stiffness_n_per_m,
        saturated: response.saturated,
        formulation: law.formulation().to_string(),
        chains: chains.collect(),
        profile: profile.collect(),
        stiffness_map: None,
    })
}

/// Nobody expects to read "-0.0".
fn unsigned_zero(x: f64) -> f64 {
    x + 0.0
}

impl std::fmt::Display for Evaluation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = String::new();
        writeln!(text, "depth      {:>12.6} mm", self.depth_m * 1e3)?;
        writeln!(text, "force      {:>12.6} N on the hand, {} law", self.force_n, self.formulation)?;
        let remark = if self.saturated { ", past a guard: the law goes on straight" } else { "" };
        writeln!(text, "stiffness  {:>12.4} N/m{remark}", self.stiffness_n_per_m)?;
        writeln!(text, "chain       force N      dl_1 mm    d_theta rad      dw_1 mm  boundary units")?;
        for (i, c) in self.chains.iter().enumerate() {
            let (dl, dw) = (c.dl_1_m * 1e3, c.dw_1_m * 1e3);
            writeln!(
                text,
                "{i:>5} {:>13.6} {dl:>12.6} {:>14.6} {dw:>12.6} {:>15.3}",
                c.force_n, c.d_theta_rad, c.boundary_units
            )?;
        }
        if !self.profile.is_empty() {
            writeln!(text, "    s mm    normal mm  tangential mm")?;
        }
        for p in &self.profile {
            writeln!(text, "{:>8.3} {:>12.6} {:>14.6}", p.s_m * 1e3, p.normal_m * 1e3, p.tangential_m * 1e3)?;
        }
        if let Some(map) = &self.stiffness_map {
            writeln!(
                text,
                "all for factor 1 of {}: on the body force and stiffness are multiplied by it",
                map.display()
            )?;
        }
        f.write_str(&text)
    }
}
