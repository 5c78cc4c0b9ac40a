//! How long a calibrated body takes, beside the same body with parts taken away.

use std::time::Instant;

use anyhow::Result;

use crate::report::bodies::Kept;
use crate::report::clockwork::Times;
use crate::report::run_time::VERTICES;
use crate::report::run_time::stage::{Case, Stage};
use crate::report::section::{Context, Exhibit};
use crate::report::subject::Model;
use crate::report::table::{Cell, Table};

/// The force is asked so often in a round, and so many rounds in turn, so that what slows the machine slows both.
const QUERIES: usize = 1000;
const ROUNDS: usize = 8;

/// Times on the liver.
pub(super) struct Timing {
    pub(super) whole: Case,
    pub(super) without_modes: Case,
    map_alone: Case,
    /// Force alone: the calibrated body ...
    pub(super) force: Times,
    /// ... and the same without its response.
    pub(super) force_of_map_alone: Times,
}

/// By the calls and over the walk of the section on run time.
pub(super) fn measure(context: &Context) -> Result<Timing> {
    context.progress.step("calibrated body liver, times");
    let calibrated = context.lab.body("liver")?;
    let stage = Stage::new(context, &calibrated.body(Kept::MapAlone)?, VERTICES)?;
    let kinds = [Kept::All, Kept::WithoutModes, Kept::MapAlone];
    let bodies = kinds.into_iter().map(|kept| {
        let start = Instant::now();
        let body = calibrated.body(kept)?;
        Ok((body, start.elapsed().as_secs_f64()))
    });
    let bodies = bodies.collect::<Result<Vec<_>>>()?;
    let models = bodies.iter().map(|(body, body_s)| {
        let start = Instant::now();
        let model = Model::new(body, &calibrated.tissue);
        (model, body_s + start.elapsed().as_secs_f64())
    });
    let mut models: Vec<_> = models.collect();
    let mut forces = [Times(Vec::new()), Times(Vec::new())];
    for _ in 0..ROUNDS {
        for (Times(all), which) in forces.iter_mut().zip([0, 2]) {
            all.extend(stage.force(&mut models[which].0, QUERIES).0);
        }
    }
    let [force, force_of_map_alone] = forces;
    let mut case = |which: usize| {
        let (model, setup_s) = &mut models[which];
        stage.model(model, *setup_s)
    };
    let (whole, without_modes, map_alone) = (case(0), case(1), case(2));
    Ok(Timing { whole, without_modes, map_alone, force, force_of_map_alone })
}

pub(super) fn exhibit(timing: &Timing) -> Exhibit {
    let mut table = Table::new([
        ("body", ""),
        ("contact moves", "us"),
        ("lower quartile", "us"),
        ("upper quartile", "us"),
        ("contact stays", "us"),
        ("force alone", "us"),
        ("setup", "s"),
        ("memory", "MB"),
    ]);
    let rows = [
        ("calibrated", &timing.whole, Some(&timing.force)),
        ("without its body modes", &timing.without_modes, None),
        ("without its response: the chains alone", &timing.map_alone, Some(&timing.force_of_map_alone)),
    ];
    for (name, case, force) in rows {
        let spread = case.moved.spread();
        let quartiles = spread.map_or([Cell::Empty, Cell::Empty], |s| [s.q1, s.q3].map(Cell::from));
        let head: [Cell; 2] = [name.into(), case.moved.median_us().into()];
        table.push(head.into_iter().chain(quartiles).chain([
            case.stayed.median_us().into(),
            Cell::maybe(force.map(Times::median_us)),
            case.setup_s.into(),
            (case.bytes as f64 / 1e6).into(),
        ]));
    }
    Exhibit {
        name: "calibrated_time",
        title: format!("Time of one query on {VERTICES} vertices"),
        caption: "Force and surface of a 5 mm press, medians; the contact moves by 3 mm between two queries, or stays. The force alone is \
                  asked of two of the bodies in turns. What a scene without body.response takes is in the last row, with the same chains."
            .to_owned(),
        figure: None,
        table,
        raw: None,
    }
}
