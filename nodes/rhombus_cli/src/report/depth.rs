//! Error against depth, size of the contact and Poisson's ratio.

use rhombus_chain::{ContactLaw, Tissue};

use super::figure::{Axis, Figure, Marker, Series};
use super::lab::{Calibrated, MOST_CHAINS};
use super::liver::judge;
use super::section::{Context, Exhibit, Section, SectionOutput};
use super::table::Table;
use super::truth::{self, Part};

pub(crate) const SECTION: Section =
    Section { name: "depth", title: "Error against depth, contact size and Poisson's ratio", asks: &[], run };

/// Depths that are judged, mm.
const DEPTHS_MM: [f64; 8] = [0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0];
/// Poisson's ratio of the calibrations.
const CALIBRATED_POISSON: f64 = 0.45;
/// Force and surface, and how they are called.
const PARTS: [(&str, Part); 3] =
    [("force", |d| d.force), ("within 30 mm", |d| d.near), ("whole surface", |d| d.full)];

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    Ok(SectionOutput {
        text: vec![
            "Linear elasticity answers in proportion to the depth; the chains' surface does not quite (the end of a turning rod moves on an \
             arc), nor does a law past its guard. What is shown is the distance from the linear solution at every depth, not from a body \
             of large strains."
                .to_owned(),
        ],
        exhibits: vec![against_depth(context)?, against_poisson(context)?],
        verdicts: Vec::new(),
    })
}

/// The calibration with the least near-field error at the sites used, and its number of chains.
pub(crate) fn chosen(
    context: &Context,
    name: &'static str,
) -> anyhow::Result<(usize, std::rc::Rc<Calibrated>)> {
    let mut best = (1, context.lab.calibrated(name, 1, context.progress)?);
    for chains in 2..=MOST_CHAINS {
        let next = context.lab.calibrated(name, chains, context.progress)?;
        if next.used_near < best.1.used_near {
            best = (chains, next);
        }
    }
    Ok(best)
}

fn against_depth(context: &Context) -> anyhow::Result<Exhibit> {
    let columns = [("disc", ""), ("chains", ""), ("depth", "mm")];
    let errors = PARTS.map(|(name, _)| (name, "%"));
    let mut table = Table::new(columns.into_iter().chain(errors));
    let mut series = Vec::new();
    for (name, radius) in [("liver_r5", "5 mm"), ("liver_r2", "2 mm")] {
        let reference = context.lab.reference(name)?;
        let (chains, calibrated) = chosen(context, name)?;
        let sites =
            truth::on(calibrated.mapped.mesh(), &reference, &calibrated.mapped, &reference.held_out());
        let mut curves = PARTS.map(|_| Vec::new());
        for depth_mm in DEPTHS_MM {
            let score = judge(&calibrated, true, &sites, 1e-3 * depth_mm);
            let errors = PARTS.map(|(_, part)| 100.0 * score.median(part));
            for (curve, error) in curves.iter_mut().zip(errors) {
                curve.push((depth_mm, error));
            }
            table.push(
                [radius.into(), chains.into(), depth_mm.into()].into_iter().chain(errors.map(Into::into)),
            );
        }
        for ((what, _), curve) in PARTS.iter().zip(curves) {
            let own = Series::line(&format!("{radius} disc, {what}"), series.len(), curve);
            series.push(own.marked(if radius == "5 mm" { Marker::Circle } else { Marker::Square }));
        }
    }
    Ok(Exhibit {
        name: "depth",
        title: "Error against depth, for both contact sizes".to_owned(),
        caption: "Medians over the held-out sites, chains calibrated for each disc with its map.".to_owned(),
        figure: Some(Figure { x: Axis::log("depth [mm]"), y: Axis::log("relative error [%]"), series }),
        table,
        raw: None,
    })
}

/// The shape as calibrated at one ratio; the force as it is, and scaled like a half-space's, by `1 / (1 - nu^2)`.
fn against_poisson(context: &Context) -> anyhow::Result<Exhibit> {
    let (chains, calibrated) = chosen(context, "liver_r5")?;
    let own = context.lab.reference("liver_r5")?;
    let others = context.lab.reference("liver_nu")?;
    let mut table = Table::new([
        ("Poisson's ratio", ""),
        ("sites", ""),
        ("force, not rescaled, median", "%"),
        ("force, rescaled by 1/(1 - nu^2), median", "%"),
        ("within 30 mm, median", "%"),
        ("whole surface, median", "%"),
    ]);
    let mut ratios: Vec<f64> = others.sites.iter().map(|site| site.poisson).collect();
    ratios.push(CALIBRATED_POISSON);
    ratios.sort_by(f64::total_cmp);
    ratios.dedup();
    let mut curves: [Vec<(f64, f64)>; 4] = std::array::from_fn(|_| Vec::new());
    for ratio in ratios {
        let reference = if (ratio - CALIBRATED_POISSON).abs() < 1e-9 { &own } else { &others };
        let wanted: Vec<usize> =
            reference.held_out().into_iter().filter(|&s| reference.sites[s].poisson == ratio).collect();
        let sites = truth::on(calibrated.mapped.mesh(), reference, &calibrated.mapped, &wanted);
        let depth_m = 0.005;
        let plain = judge(&calibrated, true, &sites, depth_m);
        let scale = (1.0 - CALIBRATED_POISSON * CALIBRATED_POISSON) / (1.0 - ratio * ratio);
        let rescaled = judge(&rescaled(&calibrated, scale)?, true, &sites, depth_m);
        let errors = [
            plain.median(|d| d.force),
            rescaled.median(|d| d.force),
            plain.median(|d| d.near),
            plain.median(|d| d.full),
        ];
        for (curve, error) in curves.iter_mut().zip(errors) {
            curve.push((ratio, 100.0 * error));
        }
        table.push(
            [ratio.into(), sites.len().into()].into_iter().chain(errors.map(|share| (100.0 * share).into())),
        );
    }
    let names = ["force, not rescaled", "force, rescaled", "within 30 mm", "whole surface"];
    let series = names.into_iter().zip(curves).enumerate();
    let series = series
        .map(|(colour, (name, curve))| Series::line(name, colour, curve).marked(Marker::Circle))
        .collect();
    Ok(Exhibit {
        name: "poisson",
        title: "Error against Poisson's ratio".to_owned(),
        caption: format!(
            "{chains} chains calibrated at nu = {CALIBRATED_POISSON}, judged at the held-out sites of bodies of other ratios and the same \
             Young's modulus. The shape is kept; the force is kept, or rescaled as a half-space's would be."
        ),
        figure: Some(Figure {
            x: Axis::linear("Poisson's ratio"),
            y: Axis::linear("relative error [%]"),
            series,
        }),
        table,
        raw: None,
    })
}

/// The same chains with all springs that much stiffer.
fn rescaled(calibrated: &Calibrated, scale: f64) -> anyhow::Result<Calibrated> {
    let tissue = &calibrated.tissue;
    let law = stiffer(tissue.law(), scale)?;
    Ok(Calibrated {
        tissue: Tissue::new(law, *tissue.surface(), tissue.probe_radius_m(), tissue.grasp_lateral())?,
        constant: calibrated.constant.clone(),
        mapped: calibrated.mapped.clone(),
        ..*calibrated
    })
}

/// The same law with all springs that much stiffer.
pub(crate) fn stiffer(law: &ContactLaw, scale: f64) -> anyhow::Result<ContactLaw> {
    let mut chains: Vec<_> = law.chains().iter().map(|chain| *chain.parameters()).collect();
    for chain in &mut chains {
        chain.normal_stiffness_n_per_m *= scale;
        chain.tangential_stiffness_n_per_m *= scale;
    }
    Ok(ContactLaw::new(law.formulation(), &chains)?)
}
