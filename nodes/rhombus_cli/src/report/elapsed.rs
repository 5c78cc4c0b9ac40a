//! Error against elapsed time: what a long session adds to the answers of the model.

mod peers;
mod session;

use super::figure::{Axis, Figure, Marker, Series};
use super::section::{Ask, Context, Exhibit, Mode, Section, SectionOutput, Verdict};
use super::table::{Cell, Table};
use session::{Checkpoint, Drift, Session};

pub(crate) const SECTION: Section = Section {
    name: "elapsed",
    title: "Error against elapsed time",
    asks: &[Ask {
        what: "drift over the session, equal contact memory: force, field, energy",
        asked: "exactly zero",
    }],
    run,
};

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let steps: &[u64] = match context.mode {
        Mode::Quick => &[1_000, 3_000, 10_000, 30_000, 100_000],
        Mode::Full => &[1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000],
    };
    let mut session = Session::new()?;
    let mut checkpoints = Vec::new();
    for &steps in steps {
        context.progress.step(&format!("session of {steps} steps"));
        checkpoints.push(session.run(steps)?);
    }
    let visits = if context.mode == Mode::Full { 400 } else { 30 };
    let peers = peers::drift(context.reference, visits, |name| context.progress.step(name))?;
    let last = checkpoints.last().copied();
    let verdict = match last {
        Some(Checkpoint { steps, same_memory: Drift { compared, force_n, field_m, energy_j }, .. }) => {
            Verdict::new(
                SECTION.asks[0].what,
                format!(
                    "{force_n:e} N, {field_m:e} m, {energy_j:e} J in {compared} returns over {steps} steps of 1 ms"
                ),
                compared > 0 && force_n == 0.0 && field_m == 0.0 && energy_j == 0.0,
            )
        }
        None => Verdict::not_judged(SECTION.asks[0].what, "no session"),
    };
    Ok(SectionOutput {
        text: vec![
            "A probe wanders over the generated liver: to one of twelve places from above or sliding from aside, pressed 4 mm, \
             in every other visit grasped, pulled 6 mm and let go. Interaction and surface field live through the whole session. \
             Whenever the probe is back in exactly the same position, force, surface displacement of every vertex and stored energy \
             are compared with the first answer given there."
                .to_owned(),
            "The only state is the contact memory: the point of the surface that the probe follows. Where it is equal to the last \
             bit, so must be the answers, however long the session. A probe that slid there from another side may follow a point \
             that differs by rounding; that difference does not grow with time either."
                .to_owned(),
        ],
        verdicts: vec![verdict],
        exhibits: vec![drift(&checkpoints), peers],
    })
}

fn drift(checkpoints: &[Checkpoint]) -> Exhibit {
    let mut table = Table::new([
        ("elapsed", "steps of 1 ms"),
        ("returns, equal memory", ""),
        ("force", "N"),
        ("field", "m"),
        ("energy", "J"),
        ("returns, other memory", ""),
        ("force, other memory", "N"),
        ("field, other memory", "m"),
        ("energy, other memory", "J"),
        ("largest force", "N"),
    ]);
    let cells = |drift: &Drift| {
        [Cell::Count(drift.compared), drift.force_n.into(), drift.field_m.into(), drift.energy_j.into()]
    };
    for checkpoint in checkpoints {
        let row = [Cell::Count(checkpoint.steps)].into_iter().chain(cells(&checkpoint.same_memory));
        table.push(row.chain(cells(&checkpoint.other_memory)).chain([checkpoint.peak_force_n.into()]));
    }
    let series = |name, colour, of: fn(&Checkpoint) -> f64| {
        let points = checkpoints.iter().map(move |checkpoint| (checkpoint.steps as f64, of(checkpoint)));
        Series::line(name, colour, points).marked(Marker::Circle)
    };
    let most = checkpoints.iter().map(|checkpoint| checkpoint.other_memory.force_n).fold(1e-15, f64::max);
    Exhibit {
        name: "elapsed_drift",
        title: "Drift of the answers".to_owned(),
        caption: "Largest difference so far from the first answer in the same position.".to_owned(),
        figure: Some(Figure {
            x: Axis::log("elapsed [steps of 1 ms]"),
            y: Axis::linear("difference of force [N]").within(-0.1 * most, 1.1 * most),
            series: vec![
                series("equal contact memory", 0, |checkpoint| checkpoint.same_memory.force_n),
                series("contact memory that differs", 1, |checkpoint| checkpoint.other_memory.force_n),
            ],
        }),
        table,
        raw: None,
    }
}
