//! Calibrated bodies at sites that their calibration never used.

mod curves;
mod deep;
mod judged;
mod map;
mod timing;
mod took;

use super::bodies::Kept;
use super::figure::{Axis, Series};
use super::lab::Lab;
use super::section::{Ask, Context, Exhibit, Section, SectionOutput, Verdict};
use super::subject::Model;
use super::table::Table;
use super::truth::{Part, Score};
use judged::Judged;
use timing::Timing;
use took::Took;

pub(crate) const SECTION: Section = Section {
    name: "calibrated",
    title: "Calibrated bodies at sites never used",
    asks: &[
        Ask { what: LIVER[0].what, asked: "at most 10 %" },
        Ask { what: LIVER[1].what, asked: "at most 27 %" },
        Ask { what: LIVER[2].what, asked: "at most 8 %" },
        Ask { what: LIVER[3].what, asked: "at most 2.5 %" },
        Ask { what: LIVER[4].what, asked: "at most 10 %" },
        Ask { what: OTHERS[0].1, asked: "all five of them" },
        Ask { what: OTHERS[1].1, asked: "all five of them" },
        Ask { what: WITH_MODES, asked: "at most 80 us" },
        Ask { what: WITHOUT_MODES, asked: "at most 40 us" },
        Ask { what: FORCE_QUERY, asked: "unchanged: at most 1.1 x" },
        Ask { what: FILE, asked: "less than 8 MB" },
        Ask { what: CALIBRATION, asked: "at most 10 min, less than 12 GB" },
    ],
    run,
};

/// A demand on the error of a body.
struct Demand {
    what: &'static str,
    short: &'static str,
    of: fn(&Score) -> f64,
    most: f64,
}

const FULL: Part = |distance| distance.full;
const NEAR: Part = |distance| distance.near;
const FORCE: Part = |distance| distance.force;

const LIVER: [Demand; 5] = [
    Demand {
        what: "calibrated liver, whole surface: median",
        short: "whole surface, median",
        of: |score| score.median(FULL),
        most: 0.10,
    },
    Demand {
        what: "calibrated liver, whole surface: worst site",
        short: "worst site",
        of: |score| score.worst(FULL),
        most: 0.27,
    },
    Demand {
        what: "calibrated liver, within 30 mm: median",
        short: "within 30 mm, median",
        of: |score| score.median(NEAR),
        most: 0.08,
    },
    Demand {
        what: "calibrated liver, force: median",
        short: "force, median",
        of: |score| score.median(FORCE),
        most: 0.025,
    },
    Demand {
        what: "calibrated liver, force: worst site",
        short: "worst site",
        of: |score| score.worst(FORCE),
        most: 0.10,
    },
];
/// The other bodies.
const OTHERS: [(&str, &str); 2] =
    [("block", "the same of the calibrated block"), ("wedge", "the same of the calibrated wedge")];
const WITH_MODES: &str = "calibrated liver, force and surface, 5 mm press, body modes included (3116)";
const WITHOUT_MODES: &str = "the same without body modes";
const FORCE_QUERY: &str = "calibrated liver, force query beside the same body without its response";
const FILE: &str = "calibrated liver, size of its file";
const CALIBRATION: &str = "calibration of the liver: time, memory (2 cores)";

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    context.progress.step("calibrated body liver");
    let body = context.lab.body("liver")?;
    let (whole, tissue) = (body.body(Kept::All)?, body.tissue.clone());
    let mut model = Model::new(&whole, &tissue);
    let liver = judged::liver(context, body, &mut model)?;
    let maps = map::maps(&liver, &mut model);
    let deep = deep::against_depth(context, &mut model)?;
    let others = judged::others(context)?;
    let timing = timing::measure(context)?;
    let others_of_liver =
        [judged::poisson(context, &liver)?, judged::radius(context, &liver)?, deep, timing::exhibit(&timing)];
    let judged = [vec![liver], others].concat();
    let mut exhibits = vec![judged::bodies_exhibit(&judged)];
    exhibits.extend(maps);
    exhibits.extend(others_of_liver);
    exhibits.extend(curves::all(context.reference)?);
    exhibits.push(made(context.lab, &judged)?);
    let sizes: Vec<String> = judged.iter().map(|own| format!("{}: {}", own.name, own.body.size())).collect();
    Ok(SectionOutput {
        text: vec![
            format!(
                "Each body was calibrated once, by `rhombus calibrate --body`, before this run; its files are read here as a session reads \
                 them ({}). What is judged are sites that no calibration has used, each pressed as deep as its disc is wide, against \
                 quadratic finite elements on meshes refined towards the disc.",
                sizes.join("; ")
            ),
            "How P, H, J were chosen and what each file says of its own errors is in the last table. The section on run time puts the \
             calibrated liver beside the other methods."
                .to_owned(),
        ],
        verdicts: verdicts(context, &judged, &timing)?,
        exhibits,
    })
}

fn verdicts(context: &Context, judged: &[Judged], timing: &Timing) -> anyhow::Result<Vec<Verdict>> {
    let percent = |share: f64| format!("{:.2} %", 100.0 * share);
    let mut verdicts = Vec::new();
    let Some((liver, others)) = judged.split_first() else { return Ok(verdicts) };
    for Demand { what, of, most, .. } in LIVER {
        let found = of(&liver.score);
        let measured = format!("{} ({} sites)", percent(found), liver.score.0.len());
        verdicts.push(Verdict::new(what, measured, found <= most));
    }
    for (own, (_, what)) in others.iter().zip(OTHERS) {
        let found = LIVER.map(|demand| ((demand.of)(&own.score), demand));
        let words = found.iter().map(|(found, demand)| format!("{} {}", demand.short, percent(*found)));
        let reached = found.iter().all(|(found, demand)| *found <= demand.most);
        verdicts.push(Verdict::new(what, words.collect::<Vec<_>>().join(", "), reached));
    }
    for (what, case, most_us) in
        [(WITH_MODES, &timing.whole, 80.0), (WITHOUT_MODES, &timing.without_modes, 40.0)]
    {
        let (moved, stayed) = (case.moved.median_us(), case.stayed.median_us());
        let measured = format!("{moved:.1} us (contact moves; {stayed:.1} us where it stays)");
        verdicts.push(Verdict::new(what, measured, moved <= most_us));
    }
    let (own, other) = (timing.force.median_us(), timing.force_of_map_alone.median_us());
    let measured = format!("{:.2} x: {own:.3} us beside {other:.3} us", own / other);
    verdicts.push(Verdict::new(FORCE_QUERY, measured, own <= 1.1 * other));
    let megabytes = liver.body.file_bytes as f64 / 1e6;
    verdicts.push(Verdict::new(FILE, format!("{megabytes:.2} MB ({})", liver.body.size()), megabytes < 8.0));
    let took = Took::read(context.reference, liver.name)?;
    verdicts.push(Verdict::new(
        CALIBRATION,
        format!("{:.1} min, {:.2} GB, measured when it was made", took.seconds / 60.0, took.gigabytes),
        took.seconds <= 600.0 && took.gigabytes < 12.0,
    ));
    Ok(verdicts)
}

/// What the files say about themselves.
fn made(lab: &Lab, judged: &[Judged]) -> anyhow::Result<Exhibit> {
    let mut table = Table::new([("body", ""), ("what its file says", "")]);
    let names = judged.iter().map(|own| own.name).chain(judged::POISSON.map(|(name, _)| name));
    for name in names {
        let header = lab.body(name)?.header.clone();
        for line in header.made {
            table.push([name.into(), line.into()]);
        }
        for region in header.errors {
            let [field, near, force] = [region.field, region.near_field, region.force]
                .map(|[median, worst]| format!("{:.1} % ({:.1} %)", 100.0 * median, 100.0 * worst));
            let line = format!(
                "{}, {} sites: whole field {field}, within 30 mm {near}, force {force}; medians (worst)",
                region.region, region.sites
            );
            table.push([name.into(), line.into()]);
        }
    }
    Ok(Exhibit {
        name: "calibrated_made",
        title: "How the bodies were made".to_owned(),
        caption: "Command, material, sites, what was tried, and errors at sites left out in turn, as each file has them."
            .to_owned(),
        figure: None,
        table,
        raw: None,
    })
}

/// A linear axis of errors, which begins at none.
fn from_zero(label: &str, series: &[Series]) -> Axis {
    let highest = series.iter().flat_map(|series| &series.points).map(|point| point.y).fold(0.0, f64::max);
    Axis::linear(label).within(0.0, if highest > 0.0 { 1.05 * highest } else { 1.0 })
}
