//! Beyond the linear range: the calibrated liver, and linear elasticity itself, beside a body of large strains.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result};
use glam::DVec3;

use super::{FORCE, FULL, NEAR, from_zero};
use crate::report::figure::{Axis, Figure, Marker, Series};
use crate::report::section::{Context, Exhibit};
use crate::report::subject::{Model, Place, Subject};
use crate::report::table::{Cell, Table};
use crate::report::truth::{Distance, Part, Score, TruthSite};

const LINEAR: &str = "liver_r5";
const NONLINEAR: &str = "liver_nonlinear";
const PARTS: [(&str, Part); 3] = [("force", FORCE), ("whole surface", FULL), ("within 30 mm", NEAR)];

/// Scores at one depth: of the calibrated body, and of linear elasticity.
type Pair = [Score; 2];

/// Error of force and field over the depth. `model` is set up for the liver.
pub(super) fn against_depth(context: &Context, model: &mut Model) -> Result<Exhibit> {
    context.progress.step("calibrated body liver, large strains");
    let calibrated = context.lab.body("liver")?;
    let [linear, nonlinear] = [context.lab.reference(LINEAR)?, context.lab.reference(NONLINEAR)?];
    let exact_linear = calibrated.sites(&linear, &linear.held_out())?;
    let sites = calibrated.sites(&nonlinear, &nonlinear.held_out())?;
    let mut field = vec![DVec3::ZERO; calibrated.mesh().vertices().len()];
    // Depths of different sites are the same numbers.
    let mut depths: BTreeMap<u64, (f64, Pair)> = BTreeMap::new();
    for site in &sites {
        let depth_m = nonlinear.sites[site.site]
            .depth_m
            .with_context(|| format!("{}: depth: missing; accepted: one for each site, m", nonlinear.file))?;
        let small = exact_linear.iter().find(|small| small.vertex == site.vertex).with_context(|| {
            format!(
                "{}: no held-out site at vertex {}, which {} has",
                linear.file, site.vertex, nonlinear.file
            )
        })?;
        let force_n = model.settled(&Place::from(site), depth_m, &mut field);
        let own = site.distance(depth_m, force_n, &field);
        let (_, [scores, linear_scores]) = depths
            .entry((1e9 * depth_m).round() as u64)
            .or_insert_with(|| (depth_m, [Score(Vec::new()), Score(Vec::new())]));
        scores.0.push((site.site, own));
        linear_scores.0.push((site.site, linear_answer(small, site, depth_m)));
    }
    Ok(exhibit(&depths.into_values().collect::<Vec<_>>()))
}

/// How far the solution for small strains is from that for large ones.
fn linear_answer(small: &TruthSite, site: &TruthSite, depth_m: f64) -> Distance {
    let field: Vec<DVec3> = small.displacement.iter().map(|share| *share * depth_m).collect();
    site.distance(depth_m, small.stiffness_n_per_m * depth_m, &field)
}

fn exhibit(depths: &[(f64, Pair)]) -> Exhibit {
    const WHO: [&str; 2] = ["calibrated", "linear elasticity"];
    let errors =
        PARTS.iter().flat_map(|(part, _)| ["median", "worst"].map(|which| (format!("{part}, {which}"), "%")));
    let errors: Vec<(String, &str)> = errors.collect();
    let columns = [("depth", "mm"), ("who", ""), ("sites", "")];
    let mut table =
        Table::new(columns.into_iter().chain(errors.iter().map(|(name, unit)| (name.as_str(), *unit))));
    for (depth_m, scores) in depths {
        for (who, score) in WHO.into_iter().zip(scores) {
            let head: [Cell; 3] = [(1e3 * depth_m).into(), who.into(), score.0.len().into()];
            let own = PARTS.iter().flat_map(|(_, part)| [score.median(*part), score.worst(*part)]);
            table.push(head.into_iter().chain(own.map(|share| (100.0 * share).into())));
        }
    }
    let mut series = Vec::new();
    for (which, who) in WHO.into_iter().enumerate() {
        for (colour, (words, part)) in PARTS.into_iter().enumerate() {
            let curve =
                depths.iter().map(|(depth_m, scores)| (1e3 * depth_m, 100.0 * scores[which].median(part)));
            let line = Series::line(&format!("{who}, {words}"), colour, curve);
            series.push(if which == 0 { line.marked(Marker::Circle) } else { line.dashed() });
        }
    }
    Exhibit {
        name: "calibrated_depth",
        title: "Deeper than linear elasticity means".to_owned(),
        caption: "Against a neo-Hookean body of large strains (same Young's modulus and Poisson's ratio at small strain), medians over its sites. Dashed is what \
                  the linear solution, which the body is calibrated on, is off by: no calibration on it can be closer for long."
            .to_owned(),
        figure: Some(Figure {
            x: Axis::linear("depth [mm]"),
            y: from_zero("relative error [%]", &series),
            series,
        }),
        table,
        raw: None,
    }
}
