//! Error against run time: the model and every peer on the same job, in the same run.

mod beside;
mod cases;
mod exhibits;
pub(super) mod stage;

use super::half_space::name;
use super::lab::MOST_CHAINS;
use super::section::{Ask, Context, Mode, Section, SectionOutput, Verdict};
use cases::{Entry, Variety};
use stage::Case;

pub(crate) const SECTION: Section = Section {
    name: "run_time",
    title: "Error against run time",
    asks: &[
        Ask { what: FASTER[0].0, asked: "at least 50 x faster" },
        Ask { what: FASTER[1].0, asked: "at least 50 x faster" },
        Ask { what: FASTER[2].0, asked: "at least 50 x faster" },
        Ask { what: "less force error than condensed FEM of 1st order, same mesh (3116)", asked: "less" },
        Ask {
            what: "less near-field error than condensed FEM of 1st order, same mesh (3116)",
            asked: "less",
        },
        Ask { what: DOMINATED, asked: "none, at a contact that moves" },
    ],
    run,
};

/// Demand, the peer it names, and the chains that are put beside it.
const FASTER: [(&str, &str, Variety); 3] = [
    (
        "force and surface beside condensed FEM, 1st order, full product (3116)",
        "condensed FEM, 1st order, full product",
        Variety::Map,
    ),
    (
        "force and surface beside condensed FEM, 2nd order, full product (3116)",
        "condensed FEM, 2nd order, full product",
        Variety::Map,
    ),
    (
        "the same beside 1st order, chains calibrated with a reach of 60 mm (3116)",
        "condensed FEM, 1st order, full product",
        Variety::Short,
    ),
];
/// On each error's page.
const DOMINATED: &str = "peers both faster and closer than the calibrated body (3116), on any mesh";
/// The body's own size.
pub(super) const VERTICES: usize = 3116;
const REFERENCE: &str = "liver_r5";

fn run(context: &Context) -> anyhow::Result<SectionOutput> {
    let (model_sizes, peer_sizes): (&[usize], &[usize]) = match context.mode {
        Mode::Quick => (&[500, 1000, VERTICES, 20_000], &[500, 1000]),
        Mode::Full => {
            (&[500, 1000, VERTICES, 10_000, 50_000, 200_000], &[500, 1000, VERTICES, 10_000, 200_000])
        }
    };
    let entries = cases::measure(context, model_sizes, peer_sizes)?;
    let mut text = vec![
        "One query is what a session does in one period of a moving contact: the force on the hand and the displacement of every \
         surface vertex, where the contact has moved by 3 mm since the query before (0.2 m/s at 60 Hz). For the chains that is the step \
         of the interaction and the update of the surface field; for a peer, the change of contact and the product. The row \"contact \
         stays\" changes the depth alone, which is where precomputed systems are at their best. Times are medians of single calls \
         after warm-up, with quartiles; all methods of one size are measured one after the other in this run."
            .to_owned(),
        "Errors are those at the held-out sites of the 5 mm disc pressed 1 mm deep, against quadratic finite elements on meshes refined towards the disc. On \
         other meshes than the reference's, the reference is interpolated at the closest point of its surface; peers touch the \
         vertex nearest to the site, so part of their error on coarse meshes is the mesh's. A peer that steps through time is \
         timed for one step and judged at rest."
            .to_owned(),
    ];
    text.extend(times_as_fast(&entries));
    text.extend(beside::second_order(&entries));
    Ok(SectionOutput { text, verdicts: verdicts(context.mode, &entries), exhibits: exhibits::all(&entries) })
}

fn verdicts(mode: Mode, entries: &[Entry]) -> Vec<Verdict> {
    if mode == Mode::Quick {
        return SECTION.asks.iter().map(|ask| Verdict::not_judged(ask.what, "only in --full")).collect();
    }
    let cases = || entries.iter().filter_map(|entry| entry.outcome.as_ref().ok().map(|case| (entry, case)));
    let of_size = |vertices: usize| cases().filter(move |(entry, _)| entry.vertices == vertices);
    let peer = |name: &str| of_size(VERTICES).find(|(entry, _)| entry.method == name).map(|(_, case)| case);
    // The number of chains with the least near-field error at the sites used.
    let model = |wanted: Variety| {
        let is_it =
            |entry: &Entry| entry.chosen && entry.chains.is_some_and(|(_, variety)| variety == wanted);
        of_size(VERTICES).find(|(entry, _)| is_it(entry)).map(|(_, case)| case)
    };
    let missing = |what| Verdict::not_judged(what, "a method could not be measured, see the table");
    let mut verdicts: Vec<Verdict> = FASTER
        .iter()
        .map(|(what, name, variety)| match (model(*variety), peer(name)) {
            (Some(model), Some(peer)) => faster(what, model, peer),
            _ => missing(what),
        })
        .collect();
    let parts: [fn(&Case) -> f64; 2] =
        [|case| case.score.median(|d| d.force), |case| case.score.median(|d| d.near)];
    for (ask, part) in SECTION.asks[FASTER.len()..].iter().zip(parts) {
        verdicts.push(match (model(Variety::Map), peer(FASTER[0].1)) {
            (Some(model), Some(peer)) => {
                let (own, other) = (part(model), part(peer));
                let measured = format!("{:.2} % beside {:.2} % (medians)", 100.0 * own, 100.0 * other);
                Verdict::new(ask.what, measured, own < other)
            }
            _ => missing(ask.what),
        });
    }
    verdicts.push(beside::verdict(DOMINATED, entries));
    verdicts
}

/// How many times as fast as each full product the chains are, for every number of chains; nothing without the products.
fn times_as_fast(entries: &[Entry]) -> Option<String> {
    let case = |wanted: &dyn Fn(&Entry) -> bool| {
        let entry = entries.iter().find(|entry| entry.vertices == VERTICES && wanted(entry))?;
        entry.outcome.as_ref().ok()
    };
    let [first, second] = [FASTER[0].1, FASTER[1].1].map(|name| case(&|entry| entry.method == name));
    let (first, second) = (first?.stayed.median_us(), second?.stayed.median_us());
    let ratios = (1..=MOST_CHAINS).filter_map(|chains| {
        let own = case(&|entry| entry.chains == Some((chains, Variety::Map)))?.moved.median_us();
        Some(format!("{} {:.0} and {:.0} x", name(chains), first / own, second / own))
    });
    Some(format!(
        "Force and surface with a moving contact on {VERTICES} vertices, beside the product alone of condensed FEM of 1st and 2nd order: {}.",
        ratios.collect::<Vec<_>>().join("; ")
    ))
}

/// The model with a moving contact beside the peer's product alone, which leaves the change of contact out of the peer's time.
fn faster(what: &'static str, model: &Case, peer: &Case) -> Verdict {
    let (own, moved, stayed) = (model.moved.median_us(), peer.moved.median_us(), peer.stayed.median_us());
    let measured = format!(
        "{:.0} x: {own:.1} us beside {stayed:.0} us for the product alone; {:.0} x with the change of contact; near field {:.1} %, whole surface {:.1} %",
        stayed / own,
        moved / own,
        100.0 * model.score.median(|d| d.near),
        100.0 * model.score.median(|d| d.full),
    );
    Verdict::new(what, measured, stayed >= 50.0 * own)
}
