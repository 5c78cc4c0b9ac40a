//! Chains and a regional stiffness map from reference solutions at many sites. Held-out sites are never looked at.
//!
//! **Surface.** One set of chains for the whole body, fitted to the averages of all sites over rings of arc length, where the
//! neighbourhood of the contact counts most (`rings.rs`). No number of chains leaves less than those averages do.
//!
//! **Force.** The references are linear: so are the chains (no tangential springs). Their stiffness is the geometric mean of
//! the sites'; the map's factors are the sites' stiffnesses over it, interpolated over the surface.

use rhombus_chain::{Body, ChainParameters, Formulation, StiffnessMap, SurfaceMesh, SurfaceParameters};

use super::errors::{self, NEAR_M, SiteError, Which, median, one_contact};
use super::fitted::{self, FitError, Fitted, Reached, Spring};
use super::regional::{FEWEST_SITES, RegionalFactors, geometric_mean};
use super::rings::Rings;
use super::shape::ShapeTask;
use crate::reference::{Reference, ReferenceContact};

/// A calibrated body.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedBody {
    /// One or more chains.
    pub chains: Vec<ChainParameters>,
    /// Force law of all chains.
    pub formulation: Formulation,
    /// The surface around a contact.
    pub surface: SurfaceParameters,
    /// Factor on the force for each vertex.
    pub map: Option<Vec<f64>>,
    /// Errors at the sites that were used.
    pub used: Vec<SiteError>,
    /// Errors at the sites that were held out.
    pub held_out: Vec<SiteError>,
    /// The least root of the mean squared `near_rel_l2` over the used sites that one shape for all of them can leave, however
    /// many chains make it.
    pub least_near: f64,
    /// The same as a calibration of any other kind.
    pub fitted: Fitted,
}

/// [`NEAR_M`] for people.
const NEAR_MM: f64 = 1e3 * NEAR_M;

/// Fewest sites that say something about the places between them.
pub const FEWEST_FOR_MAP: usize = FEWEST_SITES;

/// Fits `chains` parallel chains to the sites that are not held out, and with `with_map` the regional stiffness.
///
/// # Errors
/// No site, sites of several contact radii or with several contacts at once, too few sites for a map.
pub fn fit(reference: &Reference, chains: usize, with_map: bool) -> Result<FittedBody, FitError> {
    fit_within(reference, chains, with_map, f64::INFINITY)
}

/// [`fit`] with a surface that ends `reach_m` from the edge of the contact: what moves less far away is left out, and
/// costs nothing.
///
/// # Errors
/// Those of [`fit`]; a reach that is not positive.
pub fn fit_within(
    reference: &Reference,
    chains: usize,
    with_map: bool,
    reach_m: f64,
) -> Result<FittedBody, FitError> {
    if reach_m.is_nan() || reach_m <= 0.0 {
        return Err(FitError::Input { name: "reach", value: reach_m, accepted: "greater than 0, m" });
    }
    let mesh = SurfaceMesh::new(reference.vertices.clone(), reference.faces.clone())
        .map_err(|error| FitError::Data(format!("{}: {error}", reference.file)))?;
    let sites = reference.used();
    let contacts = sites.iter().map(|site| one_contact(reference, *site)).collect::<Result<Vec<_>, _>>()?;
    let radius_m = contact_radius(reference, &sites)?;
    let [low, high] = mesh.extents();
    let task = ShapeTask {
        chains,
        contact_radius_m: radius_m,
        depth_m: radius_m,
        range_m: 0.5 * (high - low).min_element(),
        ends: true,
        reach_m,
        exact: true,
    };
    let rings = Rings::new(reference, &mesh, &sites, &contacts, radius_m);
    let shape = task.fit(&rings.points)?;
    let stiffnesses: Vec<f64> = contacts.iter().map(|contact| contact.stiffness_n_per_m).collect();
    let spring = Spring {
        formulation: Formulation::Energy,
        rest_n_per_m: geometric_mean(&stiffnesses),
        tangential: 0.0,
        range_m: task.range_m,
    };
    let mut fitted = Fitted {
        formulation: spring.formulation,
        chains: fitted::chains(&spring, &shape.members),
        surface: task.surface(),
        probe_radius_m: radius_m,
        reached: Vec::new(),
        notes: vec![
            "chains.tangential_stiffness: 0, because the references are linear".to_owned(),
            "chains.tangential_growth: without tangential springs it has no effect; the default".to_owned(),
        ],
    };
    fitted.notes.extend(shape.notes);
    let map = match with_map {
        true => {
            let regional = regional(reference, &mesh, radius_m, &contacts, &stiffnesses)?;
            fitted.reached.push(Reached {
                what: format!("force at each of {} sites, predicted from the others (rms)", sites.len()),
                relative: regional.interpolation.leave_one_out,
            });
            Some(regional.factors)
        }
        false => None,
    };
    let mut body = Body::new(mesh);
    if let Some(map) = &map {
        let data = |error: rhombus_chain::StiffnessMapError| FitError::Data(error.to_string());
        let map = StiffnessMap::new(map.clone(), body.mesh()).map_err(data)?;
        body = body.with_stiffness(map).map_err(data)?;
    }
    let tissue = fitted.tissue()?;
    let used = errors::at_sites(&body, &tissue, reference, Which::Used)?;
    let held_out = errors::at_sites(&body, &tissue, reference, Which::HeldOut)?;
    for (name, errors) in [("used", &used), ("held out", &held_out)] {
        fitted.reached.extend(summary(name, errors));
    }
    let near =
        used.iter().map(|error| error.near_rel_l2 * error.near_rel_l2).sum::<f64>() / used.len() as f64;
    fitted.reached.extend([
        Reached {
            what: format!("{} sites used: surface within {NEAR_MM} mm, rms", used.len()),
            relative: near.sqrt(),
        },
        Reached {
            what: "  the least any number of chains can leave there: one shape, every site, every direction"
                .to_owned(),
            relative: rings.least_near,
        },
    ]);
    Ok(FittedBody {
        chains: fitted.chains.clone(),
        formulation: fitted.formulation,
        surface: fitted.surface,
        map,
        used,
        held_out,
        least_near: rings.least_near,
        fitted,
    })
}

/// Medians and worst of the errors, in words.
fn summary(name: &str, errors: &[SiteError]) -> Vec<Reached> {
    if errors.is_empty() {
        return Vec::new();
    }
    let all = |part: fn(&SiteError) -> f64| errors.iter().map(part).collect::<Vec<_>>();
    let force = all(|error| error.force_rel);
    let worst = force.iter().copied().fold(0.0, f64::max);
    let sites = format!("{} sites {name}", errors.len());
    [
        ("force, median".to_owned(), median(force)),
        ("force, worst".to_owned(), worst),
        (format!("surface within {NEAR_MM} mm, median"), median(all(|error| error.near_rel_l2))),
        ("whole surface, median".to_owned(), median(all(|error| error.full_rel_l2))),
    ]
    .into_iter()
    .map(|(what, relative)| Reached { what: format!("{sites}: {what}"), relative })
    .collect()
}

fn contact_radius(reference: &Reference, sites: &[usize]) -> Result<f64, FitError> {
    let Some(first) = sites.first() else {
        let problem = "no site that is not held out; accepted: one or more";
        return Err(FitError::Data(format!("{}: held_out: {problem}", reference.file)));
    };
    let of = |site: &usize| {
        let site = &reference.sites[*site];
        [site.contact_radius_m, site.young_pa, site.poisson]
    };
    match sites.iter().find(|site| of(site) != of(first)) {
        None => Ok(of(first)[0]),
        Some(other) => Err(FitError::Data(format!(
            "{}: site {first} has contact radius, young and poisson {:?}, site {other} {:?}; accepted: one contact and \
             one material for all sites that are not held out",
            reference.file,
            of(first),
            of(other)
        ))),
    }
}

/// Factors for all vertices.
fn regional(
    reference: &Reference,
    mesh: &SurfaceMesh,
    radius_m: f64,
    contacts: &[ReferenceContact],
    stiffnesses: &[f64],
) -> Result<RegionalFactors, FitError> {
    if contacts.len() < FEWEST_SITES {
        let found = contacts.len();
        return Err(FitError::Data(format!(
            "{}: {found} sites are too few for a map; accepted: {FEWEST_SITES} or more",
            reference.file
        )));
    }
    let vertices: Vec<usize> = contacts.iter().map(|contact| contact.vertex as usize).collect();
    RegionalFactors::new(mesh, &reference.fixed, radius_m, &vertices, stiffnesses)
        .ok_or(FitError::NoSolution("regional stiffness"))
}
