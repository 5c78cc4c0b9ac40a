//! Errors of calibrated bodies: three shapes, three Poisson's ratios, two contact radii.

use std::rc::Rc;

use anyhow::Result;
use rhombus_chain::{SurfaceParameters, Tissue};

use super::{FORCE, FULL, LIVER, NEAR, OTHERS, from_zero};
use crate::report::bodies::{CalibratedBody, Kept};
use crate::report::depth::stiffer;
use crate::report::figure::{Axis, Figure, Marker, Series};
use crate::report::section::{Context, Exhibit};
use crate::report::subject::{self, Model};
use crate::report::table::{Cell, Table};
use crate::report::truth::{Distance, Part, Score, TruthSite};

/// Bodies of other ratios than the liver's.
pub(super) const POISSON: [(&str, f64); 2] = [("liver_nu30", 0.30), ("liver_nu49", 0.49)];
/// The liver's own.
const LIVER_POISSON: f64 = 0.45;
/// Radius that the liver is calibrated with, m, and the other that it is judged with.
const RADII_M: [f64; 2] = [0.005, 0.002];

/// A body at its sites.
#[derive(Clone)]
pub(super) struct Judged {
    pub(super) name: &'static str,
    pub(super) body: Rc<CalibratedBody>,
    pub(super) sites: Vec<TruthSite>,
    pub(super) score: Score,
}

/// Block and wedge with the disc that they were calibrated with.
pub(super) fn others(context: &Context) -> Result<Vec<Judged>> {
    let [block, wedge] = OTHERS.map(|(name, _)| name);
    let references = [(block, "block_r5"), (wedge, "wedge_r5")];
    references.into_iter().map(|(name, reference)| at_held_out(context, name, reference, None)).collect()
}

/// The liver likewise; `model` is set up for it.
pub(super) fn liver(context: &Context, body: Rc<CalibratedBody>, model: &mut Model) -> Result<Judged> {
    let reference = context.lab.reference("liver_r5")?;
    let sites = body.sites(&reference, &reference.held_out())?;
    let score = subject::judge(model, &sites, RADII_M[0]);
    Ok(Judged { name: "liver", body, sites, score })
}

/// A body at the held-out sites of a reference, or at those of one Poisson's ratio.
fn at_held_out(
    context: &Context,
    name: &'static str,
    reference: &'static str,
    poisson: Option<f64>,
) -> Result<Judged> {
    context.progress.step(&format!("calibrated body {name}"));
    let body = context.lab.body(name)?;
    let reference = context.lab.reference(reference)?;
    let mut wanted = reference.held_out();
    wanted.retain(|site| poisson.is_none_or(|ratio| (reference.sites[*site].poisson - ratio).abs() < 1e-9));
    let sites = body.sites(&reference, &wanted)?;
    let score = judge(&body, &body.tissue, &sites, RADII_M[0])?;
    Ok(Judged { name, body, sites, score })
}

fn judge(body: &CalibratedBody, tissue: &Tissue, sites: &[TruthSite], depth_m: f64) -> Result<Score> {
    let whole = body.body(Kept::All)?;
    Ok(subject::judge(&mut Model::new(&whole, tissue), sites, depth_m))
}

/// Median and worst of everything, in the order of [`ERRORS`].
fn errors(score: &Score) -> impl Iterator<Item = Cell> {
    let worst_vertex: Part = |distance| distance.worst;
    let pairs = [FULL, NEAR, FORCE].into_iter().flat_map(|part| [score.median(part), score.worst(part)]);
    pairs
        .chain([score.median(worst_vertex)])
        .map(|share| (100.0 * share).into())
        .collect::<Vec<_>>()
        .into_iter()
}

const ERRORS: [(&str, &str); 7] = [
    ("whole surface, median", "%"),
    ("whole surface, worst", "%"),
    ("within 30 mm, median", "%"),
    ("within 30 mm, worst", "%"),
    ("force, median", "%"),
    ("force, worst", "%"),
    ("worst vertex, median", "% of depth"),
];

/// Share of the sites with at most some error, for each body.
pub(super) fn bodies_exhibit(judged: &[Judged]) -> Exhibit {
    let mut table = Table::new([("body", ""), ("vertices", ""), ("sites", "")].into_iter().chain(ERRORS));
    let mut raw = Table::new([
        ("body", ""),
        ("site", ""),
        ("whole surface", "%"),
        ("within 30 mm", "%"),
        ("force", "%"),
        ("worst vertex", "% of depth"),
    ]);
    let mut series = Vec::new();
    for (colour, own) in judged.iter().enumerate() {
        let Score(sites) = &own.score;
        let head = [own.name.into(), own.body.mesh().vertices().len().into(), sites.len().into()];
        table.push(head.into_iter().chain(errors(&own.score)));
        for (site, Distance { force, full, near, worst }) in sites {
            let numbers = [full, near, force, worst].map(|share| (100.0 * share).into());
            raw.push([own.name.into(), (*site).into()].into_iter().chain(numbers));
        }
        let rising = |part: Part| {
            let mut errors: Vec<f64> = sites.iter().map(|(_, distance)| 100.0 * part(distance)).collect();
            errors.sort_by(f64::total_cmp);
            let share = |place: usize| 100.0 * (place + 1) as f64 / sites.len() as f64;
            errors.into_iter().enumerate().map(move |(place, error)| (error, share(place)))
        };
        let whole = Series::line(&format!("{}, whole surface", own.name), colour, rising(FULL));
        let near = Series::line(&format!("{}, within 30 mm", own.name), colour, rising(NEAR));
        series.extend([whole.marked(Marker::Circle), near.dashed().marked(Marker::Ring)]);
    }
    Exhibit {
        name: "calibrated_bodies",
        title: "Three bodies: error at sites never used".to_owned(),
        caption: format!(
            "How many of a body's sites have at most so much relative L2 error of the displacement vectors. Asked of the liver: a median \
             of {:.0} %, {:.0} % within 30 mm, {:.0} % at the worst site. Each body is pressed with the disc of 5 mm that it was calibrated with, 5 mm deep.",
            100.0 * LIVER[0].most,
            100.0 * LIVER[2].most,
            100.0 * LIVER[1].most
        ),
        figure: Some(Figure {
            x: Axis::linear("relative L2 error [%]"),
            y: Axis::linear("sites with at most that error [%]").within(0.0, 104.0),
            series,
        }),
        table,
        raw: Some(raw),
    }
}

/// One body calibrated for each ratio.
pub(super) fn poisson(context: &Context, liver: &Judged) -> Result<Exhibit> {
    let mut rows = Vec::new();
    for (name, ratio) in POISSON {
        rows.push((name, ratio, at_held_out(context, name, "liver_nu", Some(ratio))?.score));
    }
    rows.push((liver.name, LIVER_POISSON, liver.score.clone()));
    rows.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut table =
        Table::new([("Poisson's ratio", ""), ("body", ""), ("sites", "")].into_iter().chain(ERRORS));
    for (name, ratio, score) in &rows {
        let head = [(*ratio).into(), (*name).into(), score.0.len().into()];
        table.push(head.into_iter().chain(errors(score)));
    }
    let parts = [("whole surface", FULL), ("within 30 mm", NEAR), ("force", FORCE)];
    let curves = parts.into_iter().enumerate().map(|(colour, (words, part))| {
        let curve = rows.iter().map(|(_, ratio, score)| (*ratio, 100.0 * score.median(part)));
        Series::line(&format!("{words}, median"), colour, curve).marked(Marker::Circle)
    });
    let series: Vec<Series> = curves.collect();
    Ok(Exhibit {
        name: "calibrated_poisson",
        title: "Calibrated for three Poisson's ratios".to_owned(),
        caption: "The liver calibrated for each ratio by itself and judged with it, at the same sites."
            .to_owned(),
        figure: Some(Figure {
            x: Axis::linear("Poisson's ratio"),
            y: from_zero("relative error [%]", &series),
            series,
        }),
        table,
        raw: None,
    })
}

/// Calibrated with one disc, judged with another.
pub(super) fn radius(context: &Context, liver: &Judged) -> Result<Exhibit> {
    let [own_m, other_m] = RADII_M;
    let reference = context.lab.reference("liver_r2")?;
    let body = &liver.body;
    let sites = body.sites(&reference, &reference.held_out())?;
    context.progress.step("calibrated body liver, disc of 2 mm");
    let surface = SurfaceParameters { contact_radius_m: other_m, ..*body.tissue.surface() };
    let tissue = |scale: f64| -> Result<Tissue> {
        let law = stiffer(body.tissue.law(), scale)?;
        Ok(Tissue::new(law, surface, body.tissue.probe_radius_m(), body.tissue.grasp_lateral())?)
    };
    let kept = judge(body, &tissue(1.0)?, &sites, other_m)?;
    // The force does not depend on the response, which takes its time to set up.
    let bare = body.body(Kept::MapAlone)?;
    let scaled = tissue(other_m / own_m)?;
    let scaled = subject::judge(&mut Model::new(&bare, &scaled), &sites, other_m);
    let columns = [("disc", "mm"), ("sites", "")].into_iter().chain(ERRORS);
    let more =
        [("force, stiffness in proportion, median", "%"), ("force, stiffness in proportion, worst", "%")];
    let mut table = Table::new(columns.chain(more));
    for (radius_m, score, scaled) in [(own_m, &liver.score, &liver.score), (other_m, &kept, &scaled)] {
        let head: [Cell; 2] = [(1e3 * radius_m).into(), score.0.len().into()];
        let forces = [scaled.median(FORCE), scaled.worst(FORCE)].map(|share| (100.0 * share).into());
        table.push(head.into_iter().chain(errors(score)).chain(forces));
    }
    Ok(Exhibit {
        name: "calibrated_radius",
        title: "Calibrated with a disc of 5 mm, judged with one of 2 mm".to_owned(),
        caption: "The file is the same; the scene says probe.contact_radius: 0.002. The force is shown with the scene's own stiffness, which is \
                  that of the disc of 5 mm, and with one in proportion to the radius, as a flat punch on a half-space has it. \
                  Far away the field goes with the force, and that of a narrower disc is less: the response does not know. \
                  Each disc is pressed as deep as it is wide."
            .to_owned(),
        figure: None,
        table,
        raw: None,
    })
}
