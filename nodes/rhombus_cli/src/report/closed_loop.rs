//! Closed loop: the largest stiffness a simulated device renders, found by simulation, beside the bound of MODEL section 7.

mod simulation;

use rhombus_chain::stability::{Demand, HapticLoop, Reach};
use rhombus_chain::{ChainParameters, ContactLaw, Formulation};

use super::figure::{Axis, Figure, Marker, Series};
use super::section::{Ask, Context, Exhibit, Mode, Section, SectionOutput, Verdict};
use super::table::{Cell, Table};
use simulation::{Handle, Loop, Route};

pub(crate) const SECTION: Section = Section {
    name: "closed_loop",
    title: "Closed loop: what a device can render",
    asks: &[
        Ask { what: "closed loop: bound of the model beside the simulated limit", asked: "never above it" },
        Ask { what: "closed loop: a delay of the contact law along its normal", asked: "changes nothing" },
    ],
    run,
};

/// The bisection ends within half a percent, on both sides.
const BISECTION: f64 = 0.01;

/// Bodies: name, law, the depth at which it is stiffest, m.
type Bodies = Vec<(&'static str, ContactLaw, f64)>;

/// One loop and body, and what was found.
struct Case {
    body: &'static str,
    around: Loop,
    /// Found by simulation, N/m.
    limit_n_per_m: f64,
    /// MODEL section 7, N/m.
    bound_n_per_m: f64,
}

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let bodies = bodies()?;
    let handles: &[(f64, f64)] = match context.mode {
        Mode::Quick => &[(0.1, 0.5), (0.3, 5.0)],
        Mode::Full => &[(0.05, 0.05), (0.1, 0.5), (0.1, 5.0), (0.3, 0.5), (0.3, 5.0), (0.3, 20.0)],
    };
    let mut cases = Vec::new();
    for &(mass_kg, damping_n_s_per_m) in handles {
        context.progress.step(&format!("handle of {mass_kg} kg, {damping_n_s_per_m} N s/m"));
        let handle = Handle { mass_kg, damping_n_s_per_m };
        for (body, law, depth_m) in &bodies {
            for around in loops(handle) {
                let bound_n_per_m = bound(&around);
                let found = simulation::largest_stable_stiffness(&around, law, *depth_m, bound_n_per_m);
                let limit_n_per_m =
                    found.ok_or_else(|| anyhow::anyhow!("no limit found for {body} with {around:?}"))?;
                cases.push(Case { body, around, limit_n_per_m, bound_n_per_m });
            }
        }
    }
    let above =
        cases.iter().filter(|case| case.bound_n_per_m > case.limit_n_per_m * (1.0 + BISECTION)).count();
    let closest =
        cases.iter().map(|case| case.limit_n_per_m / case.bound_n_per_m).fold(f64::INFINITY, f64::min);
    let farthest = cases.iter().map(|case| case.limit_n_per_m / case.bound_n_per_m).fold(0.0, f64::max);
    let spread = spread_over_delay(&cases);
    Ok(SectionOutput {
        text: vec![
            "A handle of one mass and one damper to ground, which nobody holds on to, meets a flat body at the depth where the \
             body's law is stiffest; a constant force keeps the balance there. Positions are sampled and forces held (zero-order \
             hold), the motion in between is exact. The stiffness of the body is raised by bisection, to half a percent, until a \
             small push no longer dies away."
                .to_owned(),
            "Through topics a force comes into effect a delay after its position was sampled. Through the local contact law only \
             anchor and normal are that old: the motor loop evaluates the law at its own rate for the present position, so \
             that along the normal there is no delay. The bound is K = b / (T/2 + delay), with a delay of 0 for the local law."
                .to_owned(),
        ],
        verdicts: vec![
            Verdict::new(
                SECTION.asks[0].what,
                format!(
                    "above it in {above} of {} cases; the limit is {closest:.3} to {farthest:.3} times the bound",
                    cases.len()
                ),
                above == 0,
            ),
            Verdict::new(
                SECTION.asks[1].what,
                format!("limits between 0 and 20 ms differ by {:.2} % at most", 100.0 * spread),
                spread <= BISECTION,
            ),
        ],
        exhibits: vec![limits(&cases)],
    })
}

/// A spring, and both laws with what stiffens them: each at its stiffest depth.
fn bodies() -> anyhow::Result<Bodies> {
    let chain = |tangential_stiffness_n_per_m| ChainParameters {
        rod_length_m: 0.01,
        angle_rad: 0.6,
        ratio: 0.8,
        units: 12,
        normal_stiffness_n_per_m: 500.0,
        tangential_stiffness_n_per_m,
        tangential_growth: 10.0,
        weight: 1.0,
        pitch_m: 0.016,
    };
    [
        ("linear spring", Formulation::Energy, 0.0),
        ("energy law, pulled to its guard", Formulation::Energy, 40.0),
        ("published law, pressed to its guard", Formulation::Published, 100.0),
    ]
    .into_iter()
    .map(|(name, formulation, tangential)| {
        let law = ContactLaw::new(formulation, &[chain(tangential)])?;
        let stiffest_m = Demand::of_law(&law, Reach::ENDLESS).depth_m;
        // A straight law is as stiff everywhere; it is held, not pressed, so that it acts both ways.
        Ok((name, law, if tangential == 0.0 { -0.005 } else { stiffest_m }))
    })
    .collect()
}

fn loops(handle: Handle) -> impl Iterator<Item = Loop> {
    let rates = [500.0, 1000.0, 2000.0, 4000.0];
    let delays_ms = [0.0, 0.3, 1.0, 2.0, 5.0, 10.0, 20.0];
    rates.into_iter().flat_map(move |rate_hz| {
        let around = move |delay_ms: f64, route| Loop { handle, rate_hz, delay_s: 1e-3 * delay_ms, route };
        let topics = delays_ms.into_iter().map(move |delay_ms| around(delay_ms, Route::Topics));
        topics.chain([0.0, 5.0, 20.0].into_iter().map(move |delay_ms| around(delay_ms, Route::LocalLaw)))
    })
}

fn bound(around: &Loop) -> f64 {
    let delay_s = match around.route {
        Route::Topics => around.delay_s,
        Route::LocalLaw => 0.0,
    };
    let damping = around.handle.damping_n_s_per_m;
    HapticLoop {
        rate_hz: around.rate_hz,
        delay_s,
        damping_n_s_per_m: Some(damping),
        rendered_damping_n_s_per_m: 0.0,
    }
    .largest_passive_stiffness_n_per_m(damping)
}

/// Largest relative difference between the limits of one loop through the local law at different delays.
fn spread_over_delay(cases: &[Case]) -> f64 {
    let same = |a: &Case, b: &Case| {
        let of = |case: &Case| {
            (case.around.handle.mass_kg, case.around.handle.damping_n_s_per_m, case.around.rate_hz)
        };
        a.body == b.body && of(a) == of(b)
    };
    let local = || cases.iter().filter(|case| case.around.route == Route::LocalLaw);
    let difference = |a: &Case, b: &Case| (a.limit_n_per_m / b.limit_n_per_m - 1.0).abs();
    let pairs = local().flat_map(|a| local().filter(move |b| same(a, b)).map(move |b| difference(a, b)));
    pairs.fold(0.0, f64::max)
}

fn limits(cases: &[Case]) -> Exhibit {
    let mut table = Table::new([
        ("body", ""),
        ("route of the force", ""),
        ("mass", "kg"),
        ("damping", "N s/m"),
        ("rate", "Hz"),
        ("delay", "ms"),
        ("largest stable stiffness", "N/m"),
        ("bound of the model", "N/m"),
        ("limit over bound", ""),
    ]);
    for case in cases {
        let Loop { handle, rate_hz, delay_s, route } = case.around;
        let route = match route {
            Route::Topics => "topics",
            Route::LocalLaw => "local contact law",
        };
        let loop_cells: [Cell; 4] =
            [handle.mass_kg, handle.damping_n_s_per_m, rate_hz, 1e3 * delay_s].map(Cell::Number);
        let found = [case.limit_n_per_m, case.bound_n_per_m, case.limit_n_per_m / case.bound_n_per_m];
        table.push(
            [case.body.into(), route.into()].into_iter().chain(loop_cells).chain(found.map(Cell::Number)),
        );
    }
    // The first handle; every other one is in the table.
    let first = cases.first().map(|case| case.around.handle.mass_kg);
    let damping = cases.first().map(|case| case.around.handle.damping_n_s_per_m);
    let of = |body: &str, route: Route, rate_hz: f64| {
        let wanted = move |case: &&Case| {
            let Loop { handle, rate_hz: rate, route: way, .. } = case.around;
            way == route
                && rate == rate_hz
                && Some(handle.mass_kg) == first
                && Some(handle.damping_n_s_per_m) == damping
        };
        let body = body.to_owned();
        cases.iter().filter(wanted).filter(move |case| case.body == body)
    };
    let delay_ms = |case: &Case| 1e3 * case.around.delay_s;
    let mut series = Vec::new();
    for (colour, rate_hz) in [(0, 500.0), (1, 1000.0), (2, 4000.0)] {
        let spring = || of("linear spring", Route::Topics, rate_hz);
        let energy = of("energy law, pulled to its guard", Route::Topics, rate_hz);
        let local = of("energy law, pulled to its guard", Route::LocalLaw, rate_hz);
        let limit = |case: &Case| (delay_ms(case), case.limit_n_per_m);
        series.push(
            Series::line(
                &format!("bound, topics, {rate_hz} Hz"),
                colour,
                spring().map(|case| (delay_ms(case), case.bound_n_per_m)),
            )
            .dashed(),
        );
        series.push(
            Series::line(&format!("spring, topics, {rate_hz} Hz"), colour, spring().map(limit))
                .scattered(Marker::Circle),
        );
        series.push(
            Series::line(&format!("energy law, topics, {rate_hz} Hz"), colour, energy.map(limit))
                .scattered(Marker::Cross),
        );
        series.push(
            Series::line(&format!("energy law, local law, {rate_hz} Hz"), colour, local.map(limit))
                .marked(Marker::Square),
        );
    }
    Exhibit {
        name: "closed_loop",
        title: "Largest stable stiffness against delay".to_owned(),
        caption: format!(
            "Simulated limit beside the bound, for a handle of {} kg and {} N s/m; the table has all handles, rates and bodies.",
            first.unwrap_or_default(),
            damping.unwrap_or_default()
        ),
        figure: Some(Figure {
            x: Axis::linear("delay [ms]").within(0.0, 20.0),
            y: Axis::log("stiffness [N/m]"),
            series,
        }),
        table,
        raw: None,
    }
}
