//! The outcome of a comparison for people at a terminal, and the phrases that every report uses.

#[cfg(test)]
pub(super) mod sample;

use std::fmt::Write;

use recording::{
    Change, Counts, Divergence, FieldOutcome, Outcome, Presence, TopicOutcome, Unpaired, Verdict, Worst,
};

/// Runs of messages without a counterpart that are listed.
const MOST_RUNS: usize = 8;

/// The outcome: a line for each topic that is the same, a paragraph for each that is not, the verdict at the end.
pub fn text(outcome: &Outcome) -> String {
    let mut text = String::new();
    for topic in &outcome.topics {
        let _ = writeln!(text, "{}", summary(topic));
        for line in details(topic) {
            let _ = writeln!(text, "  {line}");
        }
    }
    let _ = writeln!(text, "{}", verdict(outcome));
    text
}

/// The judgement of the whole in one sentence.
pub(super) fn verdict(outcome: &Outcome) -> String {
    let golden = outcome.golden.display();
    match &outcome.verdict {
        Verdict::NotCompared(reason) => format!("not compared with {golden}: {reason}"),
        Verdict::Same if outcome.topics.iter().any(|topic| !topic.fields.is_empty()) => {
            format!("same as {golden} within the tolerances")
        }
        Verdict::Same => format!("same as {golden} in every bit"),
        Verdict::Different => match outcome.first() {
            Some((topic, first)) => {
                format!(
                    "different from {golden}, first at stamp {} s on {}",
                    stamp(first.stamp_ns),
                    topic.name
                )
            }
            None => format!("different from {golden}"),
        },
    }
}

/// A topic in one line.
pub(super) fn summary(topic: &TopicOutcome) -> String {
    let TopicOutcome { name, counts, .. } = topic;
    let messages = |count| plural(count, "message");
    match (&topic.verdict, topic.presence) {
        (Verdict::NotCompared(reason), _) => format!("{name}: NOT COMPARED: {reason}"),
        (Verdict::Same, _) if topic.fields.is_empty() => format!("{name}: same, {}", messages(counts.paired)),
        (Verdict::Same, _) => format!("{name}: same within the tolerance, {}", messages(counts.paired)),
        (Verdict::Different, Presence::GoldenOnly) => {
            format!(
                "{name}: DIFFERENT: {} in the golden recording, and it is not computed",
                messages(counts.golden)
            )
        }
        (Verdict::Different, Presence::ComputedOnly) => {
            format!(
                "{name}: DIFFERENT: {} computed, and the golden recording has no such topic",
                messages(counts.computed)
            )
        }
        (Verdict::Different, Presence::Both) => format!("{name}: DIFFERENT: {}", numbers(counts)),
    }
}

/// Where and by how much, a line each.
pub(super) fn details(topic: &TopicOutcome) -> Vec<String> {
    if topic.presence != Presence::Both {
        return Vec::new();
    }
    let mut lines = Vec::new();
    lines.extend(topic.first.as_ref().map(|first| format!("first: {}", divergence(first))));
    lines.extend(topic.fields.iter().map(field));
    for (what, listed, count) in
        [("missing", &topic.missing, topic.counts.missing), ("extra", &topic.extra, topic.counts.extra)]
    {
        if count > 0 {
            lines.push(format!("{what}: {}", runs(listed, count)));
        }
    }
    lines
}

/// How many messages there are and how they belong together.
fn numbers(counts: &Counts) -> String {
    let Counts { golden, computed, paired, differing, missing, extra, reordered } = counts;
    let mut text =
        format!("{golden} golden, {computed} computed, {differing} of {} different", plural(*paired, "pair"));
    for (count, what) in [(missing, "missing"), (extra, "too many"), (reordered, "at another place")] {
        if *count > 0 {
            let _ = write!(text, ", {count} {what}");
        }
    }
    text
}

/// A place where both differ, as a sentence without its full stop.
pub(super) fn divergence(divergence: &Divergence) -> String {
    let Divergence { golden_index, computed_index, stamp_ns, change } = divergence;
    let number = |index: &Option<u64>| index.map_or_else(String::new, |index| format!("#{index}"));
    let (golden, computed) = (number(golden_index), number(computed_index));
    let stamp = stamp(*stamp_ns);
    match change {
        Change::Missing => format!("message {golden} (stamp {stamp} s) is missing"),
        Change::Extra => {
            format!("computed message {computed} (stamp {stamp} s) is not in the golden recording")
        }
        Change::Reordered => format!(
            "message {golden} (stamp {stamp} s) comes as computed message {computed}, in another order"
        ),
        Change::Value(value) => {
            let unit = spaced(value.unit);
            let also =
                if golden == computed { String::new() } else { format!(", computed message {computed}") };
            let by = value.difference.filter(|difference| difference.is_finite());
            let by = by.map_or_else(String::new, |by| format!(" (difference {by:+.3e}{unit})"));
            format!(
                "message {golden} (stamp {stamp} s{also}): {} is {}{unit} instead of {}{unit}{by}",
                value.field, value.computed, value.golden
            )
        }
    }
}

/// A field's differences.
fn field(field: &FieldOutcome) -> String {
    let mut text = match field.differing {
        0 => format!("{}: tolerated", field.name),
        1 => format!("{}: 1 message differs", field.name),
        count => format!("{}: {count} messages differ", field.name),
    };
    if let Some(worst) = &field.worst_absolute {
        let place = format!("at #{} (stamp {} s)", worst.golden_index, stamp(worst.stamp_ns));
        let _ = write!(text, ", worst {} {place}", measured(worst.value, field.unit));
    }
    if let Some(Worst { value, .. }) = &field.worst_relative {
        let _ = write!(text, ", relative {}", measured(*value, ""));
    }
    if let Some(rms) = field.rms {
        let _ = write!(text, ", RMS {}", measured(rms, field.unit));
    }
    text
}

/// A size of a difference with its unit.
pub(super) fn measured(value: f64, unit: &str) -> String {
    if value.is_infinite() {
        return "infinite".to_owned();
    }
    let number = if value > 0.0 { format!("{value:.3e}") } else { "0".to_owned() };
    number + &spaced(unit)
}

/// A stamp in seconds with all its digits.
pub(super) fn stamp(stamp_ns: i64) -> String {
    let sign = if stamp_ns < 0 { "-" } else { "" };
    let ns = stamp_ns.unsigned_abs();
    format!("{sign}{}.{:09}", ns / 1_000_000_000, ns % 1_000_000_000)
}

/// Messages by their numbers, neighbours together.
fn runs(listed: &[Unpaired], count: u64) -> String {
    let mut text = String::new();
    let mut said = 0;
    let neighbours = |one: &Unpaired, next: &Unpaired| one.index + 1 == next.index;
    for run in listed.chunk_by(neighbours).take(MOST_RUNS) {
        let (Some(first), Some(last)) = (run.first(), run.last()) else { continue };
        let separator = if said == 0 { "" } else { ", " };
        let _ = match run.len() {
            1 => write!(text, "{separator}#{} (stamp {} s)", first.index, stamp(first.stamp_ns)),
            _ => write!(
                text,
                "{separator}#{} to #{} (from stamp {} s)",
                first.index,
                last.index,
                stamp(first.stamp_ns)
            ),
        };
        said += run.len() as u64;
    }
    if said < count {
        let _ = write!(text, " and {} more", count - said);
    }
    text
}

/// With its noun in the right number.
pub(super) fn plural(count: u64, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

fn spaced(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

#[cfg(test)]
mod tests {
    use super::{runs, sample, text};
    use recording::{Unpaired, Verdict};

    #[test]
    fn what_is_the_same_takes_one_line_and_what_is_not_says_where_and_by_how_much() {
        assert_eq!(
            text(&sample::outcome()),
            "/servo_cf: DIFFERENT: 1000 golden, 998 computed, 1 of 998 pairs different, 2 missing\n  \
               first: message #20 (stamp 10.020000000 s): wrench.force.z is -1.5 N instead of -1.25 N (difference -2.500e-1 N)\n  \
               wrench.force.z: 1 message differs, worst 2.500e-1 N at #20 (stamp 10.020000000 s), relative 2.000e-1, RMS 7.914e-3 N\n  \
               missing: #30 to #31 (from stamp 10.030000000 s)\n\
             /contact_state: same, 1000 messages\n\
             /left/servo_cf: DIFFERENT: 5 messages computed, and the golden recording has no such topic\n\
             different from tests/golden, first at stamp 10.020000000 s on /servo_cf\n"
        );
    }

    #[test]
    fn the_reason_is_said_where_nothing_was_judged() {
        let mut outcome = sample::outcome();
        outcome.topics.truncate(1);
        outcome.topics[0].verdict = Verdict::NotCompared("no such thing".to_owned());
        outcome.verdict = Verdict::NotCompared("/servo_cf: no such thing".to_owned());
        let text = text(&outcome);
        assert!(text.starts_with("/servo_cf: NOT COMPARED: no such thing\n  first: "), "{text}");
        assert!(text.ends_with("not compared with tests/golden: /servo_cf: no such thing\n"), "{text}");
    }

    #[test]
    fn a_long_list_is_cut_and_says_how_much_is_not_in_it() {
        let listed: Vec<Unpaired> =
            (0..100).map(|index| Unpaired { index: 2 * index, stamp_ns: -5 }).collect();
        let text = runs(&listed, 3500);
        assert!(
            text.starts_with("#0 (stamp -0.000000005 s), #2 ") && text.ends_with(" and 3492 more"),
            "{text}"
        );
    }
}
