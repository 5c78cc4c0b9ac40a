//! What the Python programs found: stiffness of each press, the directional chains and their errors.

use anyhow::{Context, ensure};
use rhombus_chain::ResponseParts;

use super::chains::Candidate;
use super::work::Work;
use crate::reference::ReferenceError;
use crate::reference::arrays::Arrays;

/// Directional chains and body modes, with what was tried.
pub(super) struct Fit {
    /// The chains that were chosen.
    pub(super) candidate: Candidate,
    pub(super) parts: ResponseParts,
    /// Relative L2 error at each site, of the whole field and near the contact, by a fit without the site.
    pub(super) site_errors: Vec<[f64; 2]>,
    /// All combinations.
    pub(super) choices: Vec<Choice>,
    /// The place of the best one there.
    pub(super) chosen: usize,
}

/// Chains, harmonics and modes that were tried, and the error at sites that were not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Choice {
    pub(super) chains: usize,
    pub(super) harmonics: usize,
    pub(super) modes: usize,
    /// Median and largest relative L2 error of the whole field, median near the contact.
    pub(super) median: f64,
    pub(super) worst: f64,
    pub(super) near: f64,
}

/// N/m of each site, for each metre of depth.
///
/// # Errors
/// A file is missing or does not hold the sites of its batch.
pub(super) fn stiffnesses(work: &Work, batches: &[Vec<usize>]) -> anyhow::Result<Vec<f64>> {
    let sites = batches.iter().map(Vec::len).sum();
    let mut stiffnesses = vec![f64::NAN; sites];
    for (place, batch) in batches.iter().enumerate() {
        let path = work.press(place);
        let mut arrays = Arrays::open(&path)?;
        let found = arrays.shaped("site", &[batch.len()])?;
        let values = arrays.shaped("stiffness", &[batch.len()])?;
        ensure!(
            found.iter().map(|site| *site as usize).eq(batch.iter().copied()),
            "{}: presses at sites {found:?}; accepted: {batch:?}",
            path.display()
        );
        for (site, stiffness_n_per_m) in batch.iter().zip(values) {
            ensure!(
                stiffness_n_per_m > 0.0,
                "{}: stiffness {stiffness_n_per_m} of site {site}; accepted: greater than 0 N/m",
                path.display()
            );
            stiffnesses[*site] = stiffness_n_per_m;
        }
    }
    Ok(stiffnesses)
}

/// Reads the fit for so many vertices and sites.
///
/// # Errors
/// The file is missing, or is not of this job.
pub(super) fn read(
    work: &Work,
    vertices: usize,
    sites: usize,
    candidates: &[Candidate],
) -> anyhow::Result<Fit> {
    let path = work.fit();
    let mut arrays = Arrays::open(&path)?;
    let decays_m = arrays.shaped("decays_m", &[0])?;
    let [harmonics] = arrays.read("harmonics")?.values[..] else {
        return Err(arrays.error("harmonics", "not one number").into());
    };
    let harmonics = harmonics as usize;
    let candidate = candidates
        .iter()
        .find(|c| c.harmonics == harmonics && same(&c.decays_m, &decays_m))
        .with_context(|| format!("{}: chains and harmonics that were not asked for", path.display()))?;
    let chains = decays_m.len();
    let per_chain = 2 + 6 * harmonics;
    let coefficients = arrays.shaped("coefficients", &[vertices, chains, per_chain])?;
    let mode_fields = arrays.shaped("modes", &[0, vertices, 3])?;
    let modes = mode_fields.len() / (3 * vertices);
    let amplitudes = arrays.shaped("amplitudes", &[vertices, modes])?;
    let site_errors = arrays.shaped("site_errors", &[sites, 2])?;
    let rows = arrays.shaped("choices", &[0, 7])?;
    let choices: Vec<Choice> = rows.chunks_exact(7).map(Choice::of).collect();
    let [chosen] = arrays.read("chosen")?.values[..] else {
        return Err(arrays.error("chosen", "not one number").into());
    };
    let chosen = chosen as usize;
    let is_chosen = |c: &Choice| (c.chains, c.harmonics, c.modes) == (chains, harmonics, modes);
    if !choices.get(chosen).is_some_and(is_chosen) {
        let error: ReferenceError = arrays.error("chosen", format!("row {chosen} of choices is another one"));
        return Err(error.into());
    }
    let single = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
    let parts = ResponseParts {
        chains,
        harmonics,
        modes,
        coefficients: single(coefficients),
        amplitudes: single(amplitudes),
        mode_fields: single(mode_fields),
    };
    let site_errors = site_errors.chunks_exact(2).map(|e| [e[0], e[1]]).collect();
    Ok(Fit { candidate: candidate.clone(), parts, site_errors, choices, chosen })
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-9)
}

impl Choice {
    /// `chains, harmonics, modes, median, near, worst, seconds`.
    fn of(row: &[f64]) -> Self {
        let at = |k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        Self {
            chains: at(0) as usize,
            harmonics: at(1) as usize,
            modes: at(2) as usize,
            median: at(3),
            near: at(4),
            worst: at(5),
        }
    }
}
