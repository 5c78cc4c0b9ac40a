//! The calibrated body beside every peer: who is both faster and closer.

use super::VERTICES;
use super::cases::{CALIBRATED, Entry};
use super::exhibits::QUANTITIES;
use super::stage::Case;
use crate::report::section::Verdict;

/// Peers that the verdict cannot do without.
const SECOND_ORDER: [&str; 2] =
    ["condensed FEM, 2nd order, full product", "condensed FEM, 2nd order, patch columns"];

/// Median time of one query, us.
type Time = fn(&Case) -> f64;
const MOVED: Time = |case| case.moved.median_us();
const STAYED: Time = |case| case.stayed.median_us();

fn of_size(entries: &[Entry]) -> impl Iterator<Item = &Entry> {
    entries.iter().filter(|entry| entry.vertices == VERTICES)
}

fn case<'a>(entries: &'a [Entry], method: &str) -> Option<&'a Case> {
    of_size(entries).find(|entry| entry.method == method)?.outcome.as_ref().ok()
}

/// Reached when no peer, on its own mesh or on a coarser or finer one, is both faster and closer, by any of the errors, at a
/// contact that moves.
pub(super) fn verdict(what: &'static str, entries: &[Entry]) -> Verdict {
    let own = match of_size(entries).find(|entry| entry.method == CALIBRATED).map(|entry| &entry.outcome) {
        Some(Ok(own)) => own,
        Some(Err(why)) => return Verdict::not_judged(what, why),
        None => return Verdict::not_judged(what, "the calibrated body was not measured"),
    };
    if let Some(missing) = SECOND_ORDER.into_iter().find(|name| case(entries, name).is_none()) {
        return Verdict::not_judged(what, format!("{missing} could not be measured, see the table"));
    }
    let peers: Vec<(&Entry, &Case)> = entries
        .iter()
        .filter(|entry| !entry.citation.is_empty())
        .filter_map(|entry| entry.outcome.as_ref().ok().map(|case| (entry, case)))
        .collect();
    let [moved, stayed] = [MOVED, STAYED].map(|time| better(own, &peers, time));
    let said = |better: &[String]| {
        if better.is_empty() { "none".to_owned() } else { better.join("; ") }
    };
    let measured = format!(
        "of {} peers and meshes {} ({:.1} us); at a contact that stays, where precomputed systems are at their best ({:.1} us): {}",
        peers.len(),
        said(&moved),
        MOVED(own),
        STAYED(own),
        said(&stayed)
    );
    Verdict::new(what, measured, moved.is_empty())
}

/// Peers that are faster and closer, with their time and the errors by which they are.
fn better(own: &Case, peers: &[(&Entry, &Case)], time: Time) -> Vec<String> {
    let mut found = Vec::new();
    for (entry, peer) in peers.iter().filter(|(_, peer)| time(peer) <= time(own)) {
        let closer: Vec<String> = QUANTITIES
            .iter()
            .filter(|quantity| peer.score.median(quantity.part) <= own.score.median(quantity.part))
            .map(|quantity| {
                let [theirs, ours] = [peer, own].map(|case: &Case| 100.0 * case.score.median(quantity.part));
                format!("{} {theirs:.1} beside {ours:.1} %", quantity.title.to_lowercase())
            })
            .collect();
        if !closer.is_empty() {
            let (name, vertices) = (entry.method, entry.vertices);
            found.push(format!("{name}, {vertices} vertices ({:.1} us; {})", time(peer), closer.join(", ")));
        }
    }
    found
}

/// Errors and times beside condensed finite elements of second order; nothing where one of the two was not measured.
pub(super) fn second_order(entries: &[Entry]) -> Option<String> {
    let own = case(entries, CALIBRATED)?;
    let [full, patch] = SECOND_ORDER.map(|name| case(entries, name));
    let (full, patch) = (full?, patch?);
    let errors: Vec<String> = QUANTITIES
        .iter()
        .map(|quantity| {
            let [ours, theirs] = [own, full].map(|case| 100.0 * case.score.median(quantity.part));
            format!("{} {ours:.1} and {theirs:.1} %", quantity.title.to_lowercase())
        })
        .collect();
    let times =
        |time: Time| format!("{:.1} us beside {:.0} and {:.0} us", time(own), time(full), time(patch));
    Some(format!(
        "The calibrated body beside condensed FEM of 2nd order on the same {VERTICES} vertices, medians: {}. One query, beside the full \
         product and the columns of the patch alone: {} at a contact that moves, {} at one that stays. It keeps {:.1} MB beside {:.0} MB.",
        errors.join(", "),
        times(MOVED),
        times(STAYED),
        own.bytes as f64 / 1e6,
        full.bytes as f64 / 1e6
    ))
}

#[cfg(test)]
mod tests {
    use super::super::cases::CALIBRATED;
    use super::{Case, Entry, SECOND_ORDER, VERTICES, verdict};
    use crate::report::clockwork::Times;
    use crate::report::section::Outcome;
    use crate::report::truth::{Distance, Score};

    /// Times at a contact that moves and at one that stays, us; errors of the near field and of all else.
    fn entry(method: &'static str, [moved, stayed]: [f64; 2], [near, other]: [f64; 2]) -> Entry {
        let distance = Distance { force: other, full: other, near, worst: other };
        Entry {
            method,
            citation: if method == CALIBRATED { "" } else { "somebody" },
            chains: None,
            chosen: false,
            vertices: VERTICES,
            outcome: Ok(Case {
                moved: Times(vec![moved]),
                stayed: Times(vec![stayed]),
                force: None,
                score: Score(vec![(0, distance)]),
                setup_s: 0.0,
                bytes: 0,
            }),
        }
    }

    fn judged(others: impl IntoIterator<Item = Entry>) -> (Outcome, String) {
        let own = entry(CALIBRATED, [80.0, 30.0], [0.07, 0.09]);
        let full = entry(SECOND_ORDER[0], [39e3, 38e3], [0.06, 0.06]);
        let entries: Vec<Entry> = [own, full].into_iter().chain(others).collect();
        let verdict = verdict("", &entries);
        (verdict.outcome, verdict.measured)
    }

    #[test]
    fn a_peer_wins_when_it_is_faster_and_by_any_error_closer() {
        let patch = |times, errors| entry(SECOND_ORDER[1], times, errors);
        // Closer but slower; it is faster where the contact stays, and that is said.
        let (outcome, words) = judged([patch([494.0, 20.0], [0.06, 0.06])]);
        assert_eq!(outcome, Outcome::Reached, "{words}");
        assert!(words.starts_with("of 2 peers and meshes none"), "{words}");
        assert!(words.contains("patch columns, 3116 vertices (20.0 us"), "{words}");
        // Faster but farther.
        let far = entry("fast and far", [1.0, 1.0], [0.5, 0.5]);
        let (outcome, words) = judged([patch([494.0, 48.0], [0.06, 0.06]), far]);
        assert_eq!(outcome, Outcome::Reached, "{words}");
        assert!(words.ends_with("(30.0 us): none"), "{words}");
        // Faster and closer within 30 mm alone.
        let (outcome, words) = judged([patch([79.0, 48.0], [0.06, 0.5])]);
        assert_eq!(outcome, Outcome::Missed, "{words}");
        assert!(words.contains("surface within 30 mm") && !words.contains("whole surface"), "{words}");
        // On a coarser mesh.
        let coarse = Entry { vertices: 500, ..entry("coarse", [29.0, 29.0], [0.2, 0.08]) };
        let (outcome, words) = judged([patch([494.0, 48.0], [0.06, 0.06]), coarse]);
        assert_eq!(outcome, Outcome::Missed, "{words}");
        assert!(words.contains("coarse, 500 vertices (29.0 us"), "{words}");
    }

    #[test]
    fn without_the_strongest_peer_nothing_is_judged() {
        let mut refused = entry(SECOND_ORDER[1], [1.0, 1.0], [0.1, 0.1]);
        refused.outcome = Err("does not fit".to_owned());
        assert_eq!(judged([refused]).0, Outcome::NotJudged);
        assert_eq!(judged([]).0, Outcome::NotJudged);
    }
}
