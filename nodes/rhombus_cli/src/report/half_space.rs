//! Flat punch on an elastic half-space: the exact profile beside 1 to 5 parallel chains (MODEL section 3).

use rhombus_chain::{ContactShape, Formulation};
use rhombus_cli::calibrate::half_space::{self, HalfSpace};

use super::figure::{Axis, Figure, Marker, Series};
use super::section::{Ask, Context, Exhibit, Section, SectionOutput, Verdict};
use super::table::{Cell, Table};

pub(crate) const SECTION: Section = Section {
    name: "half_space",
    title: "Half-space: the flat punch",
    asks: &[
        Ask { what: "flat punch, 1 chain: surface profile", asked: "at most 27 %" },
        Ask { what: "flat punch, 2 chains: surface profile", asked: "at most 7 %" },
        Ask { what: "flat punch, 3 chains: surface profile", asked: "at most 2 %" },
        Ask { what: "flat punch, 4 chains: surface profile", asked: "at most 1 %" },
    ],
    run,
};

/// What is asked of 1, 2, 3 and 4 chains, %.
const ASKED_PERCENT: [f64; 4] = [27.0, 7.0, 2.0, 1.0];
const MOST_CHAINS: usize = 5;
/// Profiles are compared at this many points ...
const POINTS: usize = 400;
/// ... over this many punch radii, with equal weights.
const RADII: f64 = 20.0;

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let punch = HalfSpace::flat(10e3, 0.45, 0.005);
    let distances: Vec<f64> = (0..POINTS).map(|i| RADII * i as f64 / (POINTS - 1) as f64).collect();
    let exact: Vec<f64> = distances.iter().map(|&r| exact_share(r)).collect();
    let mut fits = Vec::new();
    for chains in 1..=MOST_CHAINS {
        context.progress.step(&format!("{} on a half-space", name(chains)));
        fits.push(Fit::new(&punch, chains, &distances, &exact)?);
    }
    let verdict = |((ask, asked), fit): ((&Ask, f64), &Fit)| {
        Verdict::new(ask.what, format!("{:.2} %", fit.percent), fit.percent <= asked)
    };
    Ok(SectionOutput {
        text: vec![format!(
            "A rigid flat punch of radius R on an elastic half-space has a closed form: force 2 E* R d, surface \
             u = (2/pi) d asin(R/r) outside the contact. The chains are fitted in this run, as rhombus calibrate does it; profiles \
             are compared at {POINTS} equidistant points over 0 to {RADII} R, with equal weights and without boundary. The force does not \
             depend on the number of chains: more of them serve the surface alone."
        )],
        verdicts: SECTION.asks.iter().zip(ASKED_PERCENT).zip(&fits).map(verdict).collect(),
        exhibits: vec![errors(&fits), profiles(&fits, &distances, &exact)],
    })
}

/// So many chains, fitted and compared.
struct Fit {
    chains: usize,
    /// The profile, in depths.
    profile: Vec<f64>,
    /// Relative L2 error of the profile, %.
    percent: f64,
    /// Largest difference of the profile, % of the depth.
    largest_percent: f64,
    /// Largest relative difference of the force from 2 E* R d up to the depth, %.
    force_percent: f64,
}

impl Fit {
    fn new(punch: &HalfSpace, chains: usize, distances: &[f64], exact: &[f64]) -> anyhow::Result<Self> {
        let fitted = half_space::fit(punch, Formulation::Energy, chains)?;
        let law = fitted.law()?;
        let mut shape = ContactShape::new(&law, &fitted.surface)?;
        shape.set_depth(&law, punch.depth_m)?;
        let profile: Vec<f64> =
            distances.iter().map(|r| shape.share(shape.s_m(r * punch.radius_m))).collect();
        let squares = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
        let differences = || profile.iter().zip(exact).map(|(model, exact)| model - exact);
        let relative = (squares(&mut differences()) / squares(&mut exact.iter().copied())).sqrt();
        let largest = differences().map(f64::abs).fold(0.0, f64::max);
        let mut force = 0.0_f64;
        for step in 1..=100 {
            let depth_m = punch.depth_m * f64::from(step) / 100.0;
            let exact_n = 2.0 * punch.plane_modulus_pa() * punch.radius_m * depth_m;
            force = force.max((law.at_depth(depth_m)?.force_n / exact_n - 1.0).abs());
        }
        let [percent, largest_percent, force_percent] = [relative, largest, force].map(|share| 100.0 * share);
        Ok(Self { chains, profile, percent, largest_percent, force_percent })
    }
}

fn errors(fits: &[Fit]) -> Exhibit {
    let mut table = Table::new([
        ("chains", ""),
        ("profile, relative L2", "%"),
        ("asked", "%"),
        ("largest difference", "% of depth"),
        ("force, largest difference", "%"),
    ]);
    for (index, fit) in fits.iter().enumerate() {
        let asked = Cell::maybe(ASKED_PERCENT.get(index).copied());
        let measured = [fit.largest_percent.into(), fit.force_percent.into()];
        table.push([fit.chains.into(), fit.percent.into(), asked].into_iter().chain(measured));
    }
    let asked = (1..).zip(ASKED_PERCENT).map(|(chains, percent)| (f64::from(chains), percent));
    let reached = fits.iter().map(|fit| (fit.chains as f64, fit.percent));
    Exhibit {
        name: "half_space_error",
        title: "Profile error against the number of chains".to_owned(),
        caption: "Relative L2 error of the surface profile beside what is asked.".to_owned(),
        figure: Some(Figure {
            x: Axis::linear("parallel chains").within(0.5, MOST_CHAINS as f64 + 0.5),
            y: Axis::log("relative L2 error of the profile [%]"),
            series: vec![
                Series::line("asked, at most", 7, asked).marked(Marker::Ring).dashed(),
                Series::line("model", 0, reached).marked(Marker::Circle),
            ],
        }),
        table,
        raw: None,
    }
}

fn profiles(fits: &[Fit], distances: &[f64], exact: &[f64]) -> Exhibit {
    let names: Vec<String> = fits.iter().map(|fit| name(fit.chains)).collect();
    let models = names.iter().map(|name| (name.as_str(), "depths"));
    let mut table = Table::new([("r", "radii"), ("exact", "depths")].into_iter().chain(models));
    for (place, (&r, &exact)) in distances.iter().zip(exact).enumerate() {
        let models = fits.iter().map(|fit| fit.profile[place].into());
        table.push([r.into(), exact.into()].into_iter().chain(models));
    }
    let curve = |values: &[f64]| distances.iter().copied().zip(values.iter().copied()).collect::<Vec<_>>();
    let models =
        fits.iter().zip(&names).map(|(fit, name)| Series::line(name, fit.chains - 1, curve(&fit.profile)));
    Exhibit {
        name: "half_space_profile",
        title: "Profile beside the exact one".to_owned(),
        caption: "Share of the punch's depth that arrives at a distance from its axis.".to_owned(),
        figure: Some(Figure {
            x: Axis::linear("distance from the axis [punch radii]").within(0.0, RADII),
            y: Axis::log("displacement [depths]").within(0.005, 1.2),
            series: models.chain([Series::line("exact", 7, curve(exact)).dashed()]).collect(),
        }),
        table,
        raw: None,
    }
}

/// `1 chain`, `2 chains`.
pub(crate) fn name(chains: usize) -> String {
    format!("{chains} chain{}", if chains == 1 { "" } else { "s" })
}

/// The exact profile at `r` punch radii, per depth.
fn exact_share(r: f64) -> f64 {
    if r <= 1.0 { 1.0 } else { std::f64::consts::FRAC_2_PI * libm::asin(1.0 / r) }
}
