//! The liver at the sites that no calibration has seen: force and surface, for 1 to 5 chains, constant and with the map.

use super::figure::{Axis, Figure, Marker, Series};
use super::lab::{Calibrated, MOST_CHAINS};
use super::section::{Ask, Context, Exhibit, Section, SectionOutput, Verdict};
use super::subject::{self, Model};
use super::table::Table;
use super::truth::{self, Distance, Part, Score, TruthSite};

pub(crate) const SECTION: Section = Section {
    name: "liver",
    title: "The liver at held-out sites",
    asks: &[
        Ask { what: "liver, 5 mm disc, force with the map: median", asked: "at most 2.5 %" },
        Ask { what: "liver, 5 mm disc, force with the map: worst", asked: "at most 13 %" },
        Ask {
            what: "liver, 5 mm disc, force: map beside constant, median",
            asked: "better than the constant",
        },
        Ask { what: "liver, 5 mm disc, surface within 30 mm: median", asked: "at most 30 %" },
        Ask { what: "liver, 5 mm disc, whole surface: median", asked: "shown, whatever it is" },
    ],
    run,
};

const REFERENCES: [(&str, &str); 2] = [("liver_r5", "5 mm"), ("liver_r2", "2 mm")];

/// One calibration, judged.
struct Row {
    radius: &'static str,
    chains: usize,
    mapped: bool,
    seconds: f64,
    used_near: f64,
    score: Score,
}

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let mut rows = Vec::new();
    let mut counts = Vec::new();
    for (name, radius) in REFERENCES {
        let reference = context.lab.reference(name)?;
        let held_out = reference.held_out();
        counts.push(format!("{radius} disc: {} used, {} held out", reference.used().len(), held_out.len()));
        for chains in 1..=MOST_CHAINS {
            let calibrated = context.lab.calibrated(name, chains, context.progress)?;
            let sites = truth::on(calibrated.constant.mesh(), &reference, &calibrated.constant, &held_out);
            for mapped in [false, true] {
                let score = judge(&calibrated, mapped, &sites, reference.sites[0].contact_radius_m);
                let Calibrated { seconds, used_near, .. } = *calibrated;
                rows.push(Row { radius, chains, mapped, seconds, used_near, score });
            }
        }
    }
    let best = best_chains(&rows, "5 mm");
    let text = vec![
        format!(
            "Quadratic finite elements say what force and what displacement of every vertex a rigid disc gives at each site; chains and \
             stiffness map are calibrated in this run at the used sites alone and judged at the others ({}). Each site is pressed as deep \
             as the disc is wide.",
            counts.join("; ")
        ),
        format!(
            "The verdicts are for {best} chains, the number with the least near-field error at the sites used. {}",
            where_more_do_not_help(&rows)
        ),
    ];
    Ok(SectionOutput { text, verdicts: verdicts(&rows, best), exhibits: vec![exhibit(&rows)] })
}

/// The model at every site, by a session's own calls.
pub(crate) fn judge(calibrated: &Calibrated, mapped: bool, sites: &[TruthSite], depth_m: f64) -> Score {
    subject::judge(&mut Model::new(calibrated.body(mapped), &calibrated.tissue), sites, depth_m)
}

fn best_chains(rows: &[Row], radius: &str) -> usize {
    let own = rows.iter().filter(|row| row.radius == radius && row.mapped);
    own.min_by(|a, b| a.used_near.total_cmp(&b.used_near)).map_or(1, |row| row.chains)
}

/// Adding chains is said not to help where the near field at held-out sites gains less than a twentieth.
fn where_more_do_not_help(rows: &[Row]) -> String {
    let mut said = Vec::new();
    for (_, radius) in REFERENCES {
        let errors: Vec<(usize, f64)> = rows
            .iter()
            .filter(|row| row.radius == radius && row.mapped)
            .map(|row| (row.chains, row.score.median(|d| d.near)))
            .collect();
        let idle: Vec<String> = errors
            .windows(2)
            .filter(|pair| pair[1].1 > 0.95 * pair[0].1)
            .map(|pair| {
                format!(
                    "{} to {} ({:.1} to {:.1} %)",
                    pair[0].0,
                    pair[1].0,
                    100.0 * pair[0].1,
                    100.0 * pair[1].1
                )
            })
            .collect();
        if !idle.is_empty() {
            said.push(format!("{radius} disc: {}", idle.join(", ")));
        }
    }
    if said.is_empty() {
        return "Every further chain lowers the near-field error at the held-out sites by at least a twentieth.".to_owned();
    }
    format!(
        "More chains do not help (the near field at held-out sites gains less than a twentieth) from {}. The force does not depend on the \
         number of chains: all share one linear stiffness, and the map multiplies it.",
        said.join("; ")
    )
}

fn verdicts(rows: &[Row], best: usize) -> Vec<Verdict> {
    let of = |mapped: bool| {
        rows.iter()
            .find(|row| row.radius == "5 mm" && row.chains == best && row.mapped == mapped)
            .map(|row| &row.score)
    };
    let (Some(constant), Some(map)) = (of(false), of(true)) else { return Vec::new() };
    let percent = |share: f64| format!("{:.2} %", 100.0 * share);
    let force = |score: &Score| score.median(|d| d.force);
    let (median, worst, flat) = (force(map), map.worst(|d| d.force), force(constant));
    let (near, full) = (map.median(|d| d.near), map.median(|d| d.full));
    let sites = map.0.len();
    let [a, b, c, d, e] = SECTION.asks else { return Vec::new() };
    vec![
        Verdict::new(a.what, format!("{} ({sites} sites)", percent(median)), median <= 0.025),
        Verdict::new(b.what, format!("{} ({sites} sites)", percent(worst)), worst <= 0.13),
        Verdict::new(c.what, format!("map {}, constant {}", percent(median), percent(flat)), median < flat),
        Verdict::new(d.what, format!("{} with {best} chains", percent(near)), near <= 0.30),
        Verdict::new(e.what, format!("{} with {best} chains", percent(full)), true),
    ]
}

fn exhibit(rows: &[Row]) -> Exhibit {
    let mut table = Table::new([
        ("disc", ""),
        ("chains", ""),
        ("stiffness", ""),
        ("force, median", "%"),
        ("force, worst", "%"),
        ("within 30 mm, median", "%"),
        ("within 30 mm, worst", "%"),
        ("whole surface, median", "%"),
        ("worst vertex, median", "% of depth"),
        ("calibration", "s"),
    ]);
    let mut raw = Table::new([
        ("disc", ""),
        ("chains", ""),
        ("stiffness", ""),
        ("site", ""),
        ("force", "%"),
        ("within 30 mm", "%"),
        ("whole surface", "%"),
        ("worst vertex", "% of depth"),
    ]);
    for row in rows {
        let head = [row.radius.into(), row.chains.into(), stiffness(row.mapped).into()];
        let Score(sites) = &row.score;
        for (site, distance) in sites {
            let Distance { force, near, full, worst } = *distance;
            let errors = [force, near, full, worst].map(|share| (100.0 * share).into());
            raw.push(head.clone().into_iter().chain([(*site).into()]).chain(errors));
        }
        let score = &row.score;
        let errors = [
            score.median(|d| d.force),
            score.worst(|d| d.force),
            score.median(|d| d.near),
            score.worst(|d| d.near),
            score.median(|d| d.full),
            score.median(|d| d.worst),
        ];
        let errors = errors.map(|share| (100.0 * share).into());
        table.push(head.into_iter().chain(errors).chain([row.seconds.into()]));
    }
    let mut series = Vec::new();
    for (colour, (_, radius)) in REFERENCES.into_iter().enumerate() {
        let curve = |part: Part| -> Vec<(f64, f64)> {
            let own = rows.iter().filter(|row| row.radius == radius && row.mapped);
            own.map(|row| (row.chains as f64, 100.0 * row.score.median(part))).collect()
        };
        let near = Series::line(&format!("{radius} disc, within 30 mm"), 2 * colour, curve(|d| d.near));
        let full = Series::line(&format!("{radius} disc, whole surface"), 2 * colour + 1, curve(|d| d.full));
        series.extend([near.marked(Marker::Circle), full.marked(Marker::Square).dashed()]);
    }
    Exhibit {
        name: "liver",
        title: "Error at the held-out sites against the number of chains".to_owned(),
        caption: "Median over the held-out sites of the relative L2 error of the displacement vectors. The table has the force too, \
                  with constant stiffness and with the map."
            .to_owned(),
        figure: Some(Figure {
            x: Axis::linear("parallel chains").within(0.5, MOST_CHAINS as f64 + 0.5),
            y: Axis::linear("relative L2 error of the surface [%]"),
            series,
        }),
        table,
        raw: Some(raw),
    }
}

/// How a stiffness that is or is not mapped is called.
pub(crate) fn stiffness(mapped: bool) -> &'static str {
    if mapped { "map" } else { "constant" }
}
