//! Figures and tables of error against run time.

use super::VERTICES;
use super::cases::{CALIBRATED, Entry, Variety};
use super::stage::Case;
use crate::report::figure::{Axis, Figure, Line, Marker, Point, Series};
use crate::report::half_space::name;
use crate::report::lab::{MOST_CHAINS, SHORT_REACH_M};
use crate::report::section::Exhibit;
use crate::report::table::{Cell, Table};
use crate::report::truth::Part;

/// An error and how it is called.
pub(super) struct Quantity {
    name: &'static str,
    pub(super) title: &'static str,
    axis: &'static str,
    pub(super) part: Part,
}

pub(super) const QUANTITIES: [Quantity; 4] = [
    Quantity {
        name: "run_time_near",
        title: "Surface within 30 mm of the contact",
        axis: "relative L2 error within 30 mm [%]",
        part: |distance| distance.near,
    },
    Quantity {
        name: "run_time_full",
        title: "Whole surface",
        axis: "relative L2 error of the whole surface [%]",
        part: |distance| distance.full,
    },
    Quantity {
        name: "run_time_worst",
        title: "Worst vertex",
        axis: "error of the worst vertex [% of depth]",
        part: |distance| distance.worst,
    },
    Quantity {
        name: "run_time_force",
        title: "Force",
        axis: "relative error of the force [%]",
        part: |distance| distance.force,
    },
];

/// All of them, the table of everything last.
pub(super) fn all(entries: &[Entry]) -> Vec<Exhibit> {
    let errors = QUANTITIES.iter().map(|quantity| error_against_time(quantity, entries));
    errors.chain([time_against_size(entries), citations(entries)]).collect()
}

fn measured(entries: &[Entry]) -> impl Iterator<Item = (&Entry, &Case)> {
    entries.iter().filter_map(|entry| entry.outcome.as_ref().ok().map(|case| (entry, case)))
}

fn head(entry: &Entry) -> [Cell; 4] {
    let (chains, kind) = match entry.chains {
        Some((chains, variety)) => (chains.into(), variety.name().into()),
        None => (Cell::Empty, Cell::Empty),
    };
    [entry.method.into(), entry.vertices.into(), chains, kind]
}

const HEAD: [(&str, &str); 4] = [("method", ""), ("vertices", ""), ("chains", ""), ("stiffness", "")];

fn error_against_time(quantity: &Quantity, entries: &[Entry]) -> Exhibit {
    let tail = [
        ("time", "us"),
        ("lower quartile", "us"),
        ("upper quartile", "us"),
        ("error, median", "%"),
        ("error, worst site", "%"),
    ];
    let mut table = Table::new(HEAD.into_iter().chain(tail));
    let mut raw = Table::new(HEAD.into_iter().chain([("site", ""), ("error", "%")]));
    for (entry, case) in measured(entries) {
        let (median, worst) = (case.score.median(quantity.part), case.score.worst(quantity.part));
        let time = case
            .moved
            .spread()
            .map_or([Cell::Empty, Cell::Empty, Cell::Empty], |s| [s.median, s.q1, s.q3].map(Cell::from));
        table.push(
            head(entry).into_iter().chain(time).chain([median, worst].map(|share| (100.0 * share).into())),
        );
        for (site, distance) in &case.score.0 {
            let error = 100.0 * (quantity.part)(distance);
            raw.push(head(entry).into_iter().chain([(*site).into(), error.into()]));
        }
    }
    let point = |case: &Case| {
        let spread = case.moved.spread();
        Point {
            x_spread: spread.map(|spread| (spread.q1, spread.q3)),
            ..Point::new(case.moved.median_us(), 100.0 * case.score.median(quantity.part))
        }
    };
    Exhibit {
        name: quantity.name,
        title: format!("{}: error against the time of one query", quantity.title),
        caption: format!(
            "Medians over the held-out sites, and over the repeats with bars from quartile to quartile; down and to the left is better. A \
             curve of the chains runs from 1 to {MOST_CHAINS} chains on one mesh, full line with the stiffness map (crosses: surface ends {:.0} mm from the contact), dashed with constant \
             stiffness; a curve of a peer runs over its meshes, coarse to fine. The calibrated body is one mesh, with its body modes and without. Contact moves between queries.",
            1e3 * SHORT_REACH_M
        ),
        figure: Some(Figure {
            x: Axis::log("time of one query, force and surface, contact moves [us]"),
            y: Axis::log(quantity.axis),
            series: series(entries, point),
        }),
        table,
        raw: Some(raw),
    }
}

/// Of the variants of a peer.
const MARKERS: [Marker; 3] = [Marker::Square, Marker::Triangle, Marker::Cross];

/// One series for the chains on each mesh, with and without map; one for each peer. Equal meshes of the chains have equal
/// colours, and so have the variants of a peer.
fn series(entries: &[Entry], point: impl Fn(&Case) -> Point) -> Vec<Series> {
    let mut families: Vec<String> = Vec::new();
    let mut all: Vec<Series> = Vec::new();
    for (entry, case) in measured(entries) {
        let (family, name) = match entry.chains {
            Some((_, Variety::Directional)) => (CALIBRATED.to_owned(), entry.method.to_owned()),
            Some((_, variety)) => {
                let family = format!("chains, {} vertices", entry.vertices);
                let name = format!("{family}, {}", variety.name());
                (family, name)
            }
            None => (family(entry.method).to_owned(), entry.method.to_owned()),
        };
        if let Some(known) = all.iter_mut().find(|series| series.name == name) {
            known.points.push(point(case));
            continue;
        }
        let colour = families.iter().position(|known| *known == family).unwrap_or_else(|| {
            families.push(family);
            families.len() - 1
        });
        let variant = all.iter().filter(|series| series.colour == colour).count();
        let (line, marker) = match entry.chains {
            Some((_, Variety::Map)) => (Line::Solid, Marker::Circle),
            Some((_, Variety::Short)) => (Line::Solid, Marker::Cross),
            Some((_, Variety::Constant)) => (Line::Dashed, Marker::Ring),
            Some((_, Variety::Directional)) => {
                (Line::None, if variant == 0 { Marker::Triangle } else { Marker::Ring })
            }
            None => (Line::Dashed, MARKERS[variant % MARKERS.len()]),
        };
        all.push(Series { name, points: vec![point(case)], line, marker, colour });
    }
    // In the legend ours come first.
    let ours = |name: &str| name.starts_with(CALIBRATED) || name.starts_with("chains, ");
    all.sort_by_key(|series| (!ours(&series.name), !series.name.starts_with(CALIBRATED)));
    all
}

/// `FEM, 1st order` of `condensed FEM, 1st order, full product`.
fn family(method: &str) -> &str {
    let name = method.trim_start_matches("condensed ");
    name.rsplit_once(',').map_or(name, |(family, _)| family)
}

fn time_against_size(entries: &[Entry]) -> Exhibit {
    let tail = [
        ("contact moves", "us"),
        ("contact stays", "us"),
        ("force alone", "us"),
        ("repeats", ""),
        ("setup", "s"),
        ("memory", "MB"),
        ("remark", ""),
    ];
    let mut table = Table::new(HEAD.into_iter().chain(tail));
    let mut raw = Table::new(HEAD.into_iter().chain([("what", ""), ("repeat", ""), ("time", "us")]));
    for entry in entries {
        let own = match &entry.outcome {
            Ok(case) => [
                case.moved.median_us().into(),
                case.stayed.median_us().into(),
                Cell::maybe(case.force.as_ref().map(|times| times.median_us())),
                case.moved.0.len().into(),
                case.setup_s.into(),
                (case.bytes as f64 / 1e6).into(),
                Cell::Empty,
            ],
            Err(why) => {
                let empty = std::array::from_fn::<_, 6, _>(|_| Cell::Empty);
                let [a, b, c, d, e, f] = empty;
                [a, b, c, d, e, f, why.as_str().into()]
            }
        };
        table.push(head(entry).into_iter().chain(own));
    }
    for (entry, case) in measured(entries) {
        let kinds = [
            ("contact moves", Some(&case.moved)),
            ("contact stays", Some(&case.stayed)),
            ("force alone", case.force.as_ref()),
        ];
        for (what, times) in kinds {
            for (repeat, time) in times.iter().flat_map(|times| &times.0).enumerate() {
                raw.push(head(entry).into_iter().chain([what.into(), repeat.into(), (*time).into()]));
            }
        }
    }
    Exhibit {
        name: "run_time_size",
        title: "Time, setup and memory against the size of the mesh".to_owned(),
        caption: format!(
            "Median time of one query, contact moves. Setup is from mesh and parameters to the first query; the chains' leaves their calibration \
             out, which the section on the liver has, and so does a calibrated body's. A method that needs more memory than nine tenths of what is free is in the \
             table with what it needs. The body of the verdicts has {VERTICES} vertices."
        ),
        figure: Some(Figure {
            x: Axis::log("vertices of the surface"),
            y: Axis::log("time of one query, force and surface [us]"),
            series: series_over_size(entries),
        }),
        table,
        raw: Some(raw),
    }
}

/// One series for some numbers of chains, one for each peer.
fn series_over_size(entries: &[Entry]) -> Vec<Series> {
    const SHOWN: [usize; 3] = [1, 3, 5];
    let mut families: Vec<String> = SHOWN.iter().map(|&chains| format!("{}, map", name(chains))).collect();
    let mut all: Vec<Series> = Vec::new();
    for (entry, case) in measured(entries) {
        let (name, family, marker) = match entry.chains {
            Some((chains, Variety::Map)) if SHOWN.contains(&chains) => {
                let name = format!("{}, map", name(chains));
                (name.clone(), name, Marker::Circle)
            }
            Some((_, Variety::Directional)) if entry.method == CALIBRATED => {
                (CALIBRATED.to_owned(), CALIBRATED.to_owned(), Marker::Triangle)
            }
            Some(_) => continue,
            None => (entry.method.to_owned(), family(entry.method).to_owned(), Marker::Square),
        };
        let at = Point::new(entry.vertices as f64, case.moved.median_us());
        if let Some(known) = all.iter_mut().find(|series| series.name == name) {
            known.points.push(at);
            continue;
        }
        let colour = families.iter().position(|known| *known == family).unwrap_or_else(|| {
            families.push(family);
            families.len() - 1
        });
        let variant = all.iter().filter(|series| series.colour == colour).count();
        let marker = if marker == Marker::Square { MARKERS[variant % MARKERS.len()] } else { marker };
        all.push(Series { name, points: vec![at], line: Line::Solid, marker, colour });
    }
    all
}

fn citations(entries: &[Entry]) -> Exhibit {
    let mut table = Table::new([("method", ""), ("publication", "")]);
    let mut seen: Vec<&str> = Vec::new();
    for entry in entries.iter().filter(|entry| !entry.citation.is_empty()) {
        if !seen.contains(&entry.method) {
            seen.push(entry.method);
            table.push([entry.method.into(), entry.citation.into()]);
        }
    }
    Exhibit {
        name: "run_time_peers",
        title: "The peers".to_owned(),
        caption: "What each peer follows; all are implemented in tests/peers, each with a test on a case of known answer.".to_owned(),
        figure: None,
        table,
        raw: None,
    }
}
