//! Profiles along the surface, model beside reference, at equal force (as in the paper's figure 8).

use glam::DVec3;
use rhombus_chain::{Body, ContactLaw, Formulation, SurfacePoint, Tissue};
use rhombus_cli::reference::Reference;

use super::depth::chosen;
use super::figure::{Axis, Figure, Series};
use super::section::{Context, Exhibit, Section, SectionOutput};
use super::subject::{Model, Place, Subject};
use super::table::{Cell, Table};

pub(crate) const SECTION: Section =
    Section { name: "profiles", title: "Profiles: model beside reference at equal force", asks: &[], run };

/// Force of every profile, N.
const FORCE_N: f64 = 0.5;
/// Length of a profile to each side, m, and the distance of its points.
const LENGTH_M: f64 = 0.05;
const STEP_M: f64 = 0.001;
/// Names of the exhibits, one for each held-out site that is shown.
const NAMES: [&str; 3] = ["profile_1", "profile_2", "profile_3"];

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let reference = context.lab.reference("liver_r5")?;
    let (chains, calibrated) = chosen(context, "liver_r5")?;
    let laws = laws(&calibrated.tissue)?;
    let sites = reference.held_out();
    let exhibits = sites
        .iter()
        .zip(NAMES)
        .map(|(&site, name)| profile(name, &reference, site, &calibrated.mapped, &laws));
    Ok(SectionOutput {
        text: vec![format!(
            "Displacement along the contact normal on a line along the surface through the site, {chains} chains with the stiffness map, at \
             held-out sites pressed by {FORCE_N} N. Each law gets the depth at which it answers with that force, so a law that is too soft \
             shows a profile that is too deep. The calibration is of the energy law. The published formula is shown with the very \
             same parameters, and with its springs scaled to the energy law's stiffness at rest: then the two differ by nothing, \
             because references that are linear call for no tangential springs."
        )],
        exhibits: exhibits.collect::<anyhow::Result<_>>()?,
        verdicts: Vec::new(),
    })
}

/// The laws that are compared, by name.
fn laws(energy: &Tissue) -> anyhow::Result<Vec<(&'static str, Tissue)>> {
    let with = |scale: f64| -> anyhow::Result<Tissue> {
        let mut chains: Vec<_> = energy.law().chains().iter().map(|chain| *chain.parameters()).collect();
        for chain in &mut chains {
            chain.normal_stiffness_n_per_m *= scale;
            chain.tangential_stiffness_n_per_m *= scale;
        }
        let law = ContactLaw::new(Formulation::Published, &chains)?;
        Ok(Tissue::new(law, *energy.surface(), energy.probe_radius_m(), energy.grasp_lateral())?)
    };
    let same = with(1.0)?;
    let matched = with(energy.law().rest_stiffness_n_per_m() / same.law().rest_stiffness_n_per_m())?;
    Ok(vec![
        ("energy law", energy.clone()),
        ("published law, same parameters", same),
        ("published law, same stiffness at rest", matched),
    ])
}

fn profile(
    name: &'static str,
    reference: &Reference,
    site: usize,
    body: &Body,
    laws: &[(&'static str, Tissue)],
) -> anyhow::Result<Exhibit> {
    let solution = &reference.sites[site];
    let contact = solution.contacts[0];
    let line = line(body, contact.point, contact.normal);
    let along = |field: &dyn Fn(u32) -> DVec3| -> Vec<(f64, f64)> {
        line.iter()
            .map(|&(arc_m, at)| {
                let [a, b, c] = body.mesh().triangles()[at.face as usize].map(field);
                let moved = a * at.barycentric.x + b * at.barycentric.y + c * at.barycentric.z;
                (1e3 * arc_m, 1e3 * moved.dot(contact.normal))
            })
            .collect()
    };
    let depth_m = FORCE_N / contact.stiffness_n_per_m;
    let mut curves =
        vec![("reference", depth_m, along(&|vertex| solution.displacement[vertex as usize] * depth_m))];
    let place = Place { point: contact.point, normal: contact.normal, vertex: contact.vertex };
    let factor = factor(body, contact.point);
    for (law, tissue) in laws {
        let depth_m = tissue.law().depth_for_force(FORCE_N / factor)?;
        let mut field = vec![DVec3::ZERO; body.mesh().vertices().len()];
        Model::new(body, tissue).settled(&place, depth_m, &mut field);
        curves.push((law, depth_m, along(&|vertex| field[vertex as usize])));
    }
    let mut table = Table::new([("law", ""), ("depth at the force", "mm"), ("profile, relative L2", "%")]);
    let mut raw =
        Table::new([("law", ""), ("along the surface", "mm"), ("displacement along the normal", "mm")]);
    let size = |curve: &[(f64, f64)]| curve.iter().map(|(_, u)| u * u).sum::<f64>().sqrt();
    let exact = curves[0].2.clone();
    for (law, depth_m, curve) in &curves {
        let difference: Vec<_> = curve.iter().zip(&exact).map(|(a, b)| (a.0, a.1 - b.1)).collect();
        let error =
            if *law == "reference" { Cell::Empty } else { (100.0 * size(&difference) / size(&exact)).into() };
        table.push([(*law).into(), (1e3 * depth_m).into(), error]);
        for (arc_mm, moved_mm) in curve {
            raw.push([(*law).into(), (*arc_mm).into(), (*moved_mm).into()]);
        }
    }
    let series = curves.into_iter().zip([7, 0, 1, 2]).map(|((law, _, curve), colour)| {
        let line = Series::line(law, colour, curve);
        if law == "reference" || law.ends_with("rest") { line.dashed() } else { line }
    });
    Ok(Exhibit {
        name,
        title: format!("Site {site} (vertex {}), {FORCE_N} N", contact.vertex),
        caption: "Displacement along the outward contact normal; negative is into the body.".to_owned(),
        figure: Some(Figure {
            x: Axis::linear("along the surface [mm]"),
            y: Axis::linear("displacement along the normal [mm]"),
            series: series.collect(),
        }),
        table,
        raw: Some(raw),
    })
}

/// The map's factor at a point of the surface.
fn factor(body: &Body, point: DVec3) -> f64 {
    let closest = body.index().closest(body.mesh(), point, f64::INFINITY);
    closest.and_then(|(at, _)| Some(body.stiffness()?.at(&at))).unwrap_or(1.0)
}

/// Points of the surface along a line through `start`, with their signed arc lengths, m.
fn line(body: &Body, start: DVec3, normal: DVec3) -> Vec<(f64, SurfacePoint)> {
    let heading = (DVec3::X - normal * normal.x).normalize_or(normal.any_orthonormal_vector());
    let mut points: Vec<_> =
        walk(body, start, -heading).into_iter().skip(1).map(|(arc_m, at)| (-arc_m, at)).collect();
    points.reverse();
    points.extend(walk(body, start, heading));
    points
}

fn walk(body: &Body, start: DVec3, mut heading: DVec3) -> Vec<(f64, SurfacePoint)> {
    let (mut point, mut arc_m, mut last) = (start, 0.0, start);
    let mut points = Vec::new();
    while arc_m <= LENGTH_M {
        let Some((at, _)) = body.index().closest(body.mesh(), point, f64::INFINITY) else { break };
        let (here, normal) = (body.mesh().position(at), body.mesh().normal(at));
        arc_m += here.distance(last);
        last = here;
        points.push((arc_m, at));
        heading = (heading - normal * heading.dot(normal)).normalize_or(normal.any_orthonormal_vector());
        point = here + heading * STEP_M;
    }
    points
}
