//! The outcome of a comparison as Markdown, such as the summary of a CI job.

use std::fmt::Write;

use recording::{FieldOutcome, Outcome, TopicOutcome, Verdict};

use super::text::{self, measured};
use crate::markup::markdown as escaped;

/// The outcome; `plot` is the name of the file with the plot, where there is one.
pub fn markdown(outcome: &Outcome, plot: Option<&str>) -> String {
    let mut text =
        format!("## Replay: {}\n\n{}.\n\n", outcome.verdict.word(), escaped(&text::verdict(outcome)));
    if outcome.topics.is_empty() {
        return text;
    }
    text.push_str(
        "| topic | verdict | golden | computed | pairs | differing | missing | extra | reordered |\n\
         |---|---|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    for topic in &outcome.topics {
        let counts = &topic.counts;
        let numbers = [
            counts.golden,
            counts.computed,
            counts.paired,
            counts.differing,
            counts.missing,
            counts.extra,
            counts.reordered,
        ];
        let numbers = numbers.map(|number| number.to_string()).join(" | ");
        let verdict = match topic.verdict {
            Verdict::Same => "same".to_owned(),
            Verdict::Different | Verdict::NotCompared(_) => format!("**{}**", topic.verdict.word()),
        };
        let _ = writeln!(text, "| {} | {verdict} | {numbers} |", escaped(&topic.name));
    }
    for topic in &outcome.topics {
        text.push_str(&details(topic));
    }
    if let Some(plot) = plot {
        let _ = write!(text, "\nBoth signals and their difference: {}\n", escaped(plot));
    }
    text
}

/// What a topic differs in; nothing for one that does not.
fn details(topic: &TopicOutcome) -> String {
    let is_whole = topic.fields.is_empty() && topic.first.is_none();
    if is_whole && topic.verdict == Verdict::Same {
        return String::new();
    }
    let mut text = format!("\n### {}\n\n{}\n", escaped(&topic.name), escaped(&text::summary(topic)));
    for line in text::details(topic)
        .iter()
        .filter(|line| !topic.fields.iter().any(|field| line.starts_with(field.name)))
    {
        let _ = write!(text, "\n- {}", escaped(line));
    }
    if topic.fields.is_empty() {
        text.push('\n');
        return text;
    }
    text.push_str(
        "\n\n| field | differing | worst | at message | stamp | worst relative | RMS |\n|---|--:|--:|--:|--:|--:|--:|\n",
    );
    for field in &topic.fields {
        text.push_str(&row(field));
    }
    text
}

fn row(field: &FieldOutcome) -> String {
    let worst = field.worst_absolute.as_ref();
    let cells = [
        escaped(field.name),
        field.differing.to_string(),
        worst.map_or_else(String::new, |worst| measured(worst.value, field.unit)),
        worst.map_or_else(String::new, |worst| format!("#{}", worst.golden_index)),
        worst.map_or_else(String::new, |worst| format!("{} s", text::stamp(worst.stamp_ns))),
        field.worst_relative.as_ref().map_or_else(String::new, |worst| measured(worst.value, "")),
        field.rms.map_or_else(String::new, |rms| measured(rms, field.unit)),
    ];
    format!("| {} |\n", cells.join(" | "))
}

#[cfg(test)]
mod tests {
    use super::super::text::sample;
    use super::markdown;

    #[test]
    fn a_summary_has_the_verdict_a_row_for_each_topic_and_the_plot() {
        let text = markdown(&sample::outcome(), Some("replay.svg"));
        for line in [
            "## Replay: different",
            "different from tests/golden, first at stamp 10.020000000 s on /servo\\_cf.",
            "| /servo\\_cf | **different** | 1000 | 998 | 998 | 1 | 2 | 0 | 0 |",
            "| /contact\\_state | same | 1000 | 1000 | 1000 | 0 | 0 | 0 | 0 |",
            "- missing: #30 to #31 (from stamp 10.030000000 s)",
            "| wrench.force.z | 1 | 2.500e-1 N | #20 | 10.020000000 s | 2.000e-1 | 7.914e-3 N |",
            "Both signals and their difference: replay.svg",
        ] {
            assert!(text.lines().any(|own| own == line), "{line:?} is not in\n{text}");
        }
        assert!(!text.contains("### /contact"), "what is the same has no chapter");
    }

    #[test]
    fn every_row_of_a_table_has_the_columns_of_its_head() {
        let mut outcome = sample::outcome();
        outcome.topics[0].name = "/a|b".to_owned();
        let text = markdown(&outcome, None);
        let columns = |line: &str| line.replace("\\|", "").matches('|').count();
        let tables: Vec<_> = text.lines().filter(|line| line.starts_with('|')).map(columns).collect();
        assert_eq!(tables, [10, 10, 10, 10, 10, 8, 8, 8]);
    }
}
