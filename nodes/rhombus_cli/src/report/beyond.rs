//! What the model leaves: a stiff nodule inside, and two contacts at once.

use glam::DVec3;
use rhombus_chain::{Body, Interaction, StiffnessMap, SurfaceField, SurfaceMesh};
use rhombus_cli::calibrate::errors::{NEAR_M, median};
use rhombus_cli::calibrate::sites;
use rhombus_cli::reference::Reference;

use super::depth::chosen;
use super::figure::{Axis, Figure, Marker, Series};
use super::lab::Calibrated;
use super::liver::judge;
use super::section::{Context, Exhibit, Section, SectionOutput};
use super::table::{Cell, Table};
use super::truth::{self, Score};

pub(crate) const SECTION: Section =
    Section { name: "beyond", title: "A stiff nodule, and two contacts at once", asks: &[], run };

const DEPTH_M: f64 = 0.005;
/// Sites of the body without the nodule tell nothing new where those with it are nearer than this, m.
const AROUND_M: f64 = 0.04;

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    Ok(SectionOutput {
        text: vec![
            "A ball of ten times the stiffness, 8 mm in radius, lies 12 mm under the surface. A map calibrated on the body without it \
             cannot know; one that has pressed around it feels it. The shape of the surface is the same for both: what the nodule \
             does to it is left."
                .to_owned(),
            "With two discs pressed at once the body couples them: what one pushes in pulls the other's surface along, and each force is \
             less or more than alone. The model answers each contact by itself and adds the displacements; this is what that leaves."
                .to_owned(),
        ],
        exhibits: vec![nodule(context)?, two(context)?],
        verdicts: Vec::new(),
    })
}

fn nodule(context: &Context) -> anyhow::Result<Exhibit> {
    let with = context.lab.reference("liver_inclusion")?;
    let without = context.lab.reference("liver_r5")?;
    let (chains, ignorant) = chosen(context, "liver_r5")?;
    context.progress.step("calibrating with the nodule");
    let knowing = knowing(&without, &with, chains)?;
    let all: Vec<usize> = (0..with.sites.len()).collect();
    let sites = truth::on(ignorant.mapped.mesh(), &with, &ignorant.mapped, &all);
    let scores = [judge(&ignorant, true, &sites, DEPTH_M), judge(&knowing, true, &sites, DEPTH_M)];
    let centre = with
        .sites
        .first()
        .and_then(|site| site.contacts.first())
        .map_or(DVec3::ZERO, |contact| contact.point);
    let mut table = Table::new([
        ("site", ""),
        ("from the nodule", "mm"),
        ("held out", ""),
        ("reference", "N/m"),
        ("force, map without it", "%"),
        ("force, map with it", "%"),
        ("within 30 mm, without", "%"),
        ("within 30 mm, with", "%"),
    ]);
    let mut curves = [Vec::new(), Vec::new()];
    for (index, site) in sites.iter().enumerate() {
        let far_mm = 1e3 * site.point.distance(centre);
        let held_out = if with.sites[site.site].held_out { "yes" } else { "no" };
        let of = |score: &Score| score.0[index].1;
        let [a, b] = [of(&scores[0]), of(&scores[1])];
        for (curve, distance) in curves.iter_mut().zip([a, b]) {
            curve.push((far_mm, 100.0 * distance.force));
        }
        let errors = [a.force, b.force, a.near, b.near].map(|share| (100.0 * share).into());
        let own: [Cell; 4] =
            [site.site.into(), far_mm.into(), held_out.into(), site.stiffness_n_per_m.into()];
        table.push(own.into_iter().chain(errors));
    }
    let names = ["map calibrated without the nodule", "map calibrated with it"];
    let series = names.into_iter().zip(curves).enumerate();
    Ok(Exhibit {
        name: "nodule",
        title: "A nodule that is felt".to_owned(),
        caption: format!(
            "{chains} chains. Error of the force at every site around the nodule; the map of the second series has seen those that are not \
             held out. Distances are from the site right above it."
        ),
        figure: Some(Figure {
            x: Axis::linear("distance from the site above the nodule [mm]"),
            y: Axis::linear("relative error of the force [%]"),
            series: series
                .map(|(colour, (name, curve))| {
                    let marker = if colour == 0 { Marker::Ring } else { Marker::Circle };
                    Series::line(name, colour, curve).scattered(marker)
                })
                .collect(),
        }),
        table,
        raw: None,
    })
}

/// A calibration on the sites around the nodule and, farther away, on those of the body without it.
fn knowing(without: &Reference, with: &Reference, chains: usize) -> anyhow::Result<Calibrated> {
    let far = |point: DVec3| {
        with.sites.iter().flat_map(|s| &s.contacts).all(|near| near.point.distance(point) > AROUND_M)
    };
    let mut merged = with.clone();
    let others = without.sites.iter().filter(|site| site.contacts.iter().all(|contact| far(contact.point)));
    merged.sites.extend(others.cloned());
    let fitted = sites::fit(&merged, chains, true)?;
    let mesh = SurfaceMesh::new(merged.vertices.clone(), merged.faces.clone())?;
    let map = StiffnessMap::new(fitted.map.clone().unwrap_or_default(), &mesh)?;
    Ok(Calibrated {
        tissue: fitted.fitted.tissue()?,
        constant: Body::new(mesh.clone()),
        mapped: Body::new(mesh).with_stiffness(map)?,
        seconds: 0.0,
        used_near: median(fitted.used.iter().map(|site| site.near_rel_l2).collect()),
    })
}

fn two(context: &Context) -> anyhow::Result<Exhibit> {
    let reference = context.lab.reference("liver_two")?;
    let (chains, calibrated) = chosen(context, "liver_r5")?;
    let body = &calibrated.mapped;
    reference.check_mesh(body.mesh())?;
    let mut table = Table::new([
        ("site", ""),
        ("apart", "mm"),
        ("force 1", "%"),
        ("force 2", "%"),
        ("within 30 mm of either", "%"),
        ("whole surface", "%"),
    ]);
    let (mut forces, mut near_curve) = (Vec::new(), Vec::new());
    let mut field = SurfaceField::new(body, &calibrated.tissue);
    for (number, site) in reference.sites.iter().enumerate() {
        let mut hands: Vec<Interaction> = site.contacts.iter().map(|_| Interaction::new()).collect();
        let mut errors = Vec::new();
        for (hand, contact) in hands.iter_mut().zip(&site.contacts) {
            let probe = contact.point + contact.normal * (calibrated.tissue.probe_radius_m() - DEPTH_M);
            let force_n = hand.step(body, &calibrated.tissue, 0, probe, false)?.force_n.dot(contact.normal);
            let exact_n = contact.stiffness_n_per_m * DEPTH_M;
            errors.push(100.0 * (force_n - exact_n) / exact_n);
        }
        field.update(body, &calibrated.tissue, hands.iter().flat_map(Interaction::impressions));
        let mut moved = vec![DVec3::ZERO; body.mesh().vertices().len()];
        for (vertex, displacement) in field.vertices().iter().zip(field.displacements()) {
            moved[*vertex as usize] = *displacement / DEPTH_M;
        }
        let relative = |near: bool| {
            let (mut error, mut all) = (0.0, 0.0);
            for ((at, found), truth) in body.mesh().vertices().iter().zip(&moved).zip(&site.displacement) {
                if !near || site.contacts.iter().any(|contact| contact.point.distance(*at) <= NEAR_M) {
                    error += (*found - *truth).length_squared();
                    all += truth.length_squared();
                }
            }
            100.0 * (error / all).sqrt()
        };
        let points: Vec<DVec3> = site.contacts.iter().map(|contact| contact.point).collect();
        let apart_mm = points.windows(2).map(|pair| 1e3 * pair[0].distance(pair[1])).fold(0.0, f64::max);
        let (near, full) = (relative(true), relative(false));
        forces.extend(errors.iter().map(|error| (apart_mm, error.abs())));
        near_curve.push((apart_mm, near));
        let at = |index: usize| Cell::maybe(errors.get(index).copied());
        table.push([number.into(), apart_mm.into(), at(0), at(1), near.into(), full.into()]);
    }
    Ok(Exhibit {
        name: "two_contacts",
        title: "Two discs of 5 mm pressed at once".to_owned(),
        caption: format!(
            "{chains} chains with the map; both discs at the same depth. Force errors are signed in the table: positive is too stiff."
        ),
        figure: Some(Figure {
            x: Axis::linear("distance between the discs [mm]"),
            y: Axis::linear("relative error [%]"),
            series: vec![
                Series::line("force", 0, forces).scattered(Marker::Circle),
                Series::line("surface within 30 mm of either", 1, near_curve).scattered(Marker::Square),
            ],
        }),
        table,
        raw: None,
    })
}
