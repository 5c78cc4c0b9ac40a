//! A report on a recording as people read it.

use std::collections::BTreeSet;
use std::fmt::{Error, Write};
use std::time::{Duration, SystemTime};

use recording::Qos;
use recording::check::{DefinitionState, Report, TopicReport, Verdict};
use serde::Serialize;

use crate::output::bytes;

/// One line: how much of the recording can be used.
pub(super) fn verdict(report: &Report) -> String {
    let path = report.path.display();
    let topics = report.topics.iter().filter(|topic| topic.messages > 0).count();
    let readable = format!(
        "{} on {}, {} s",
        counted(report.message_count, "message"),
        counted(topics as u64, "topic"),
        seconds(report.duration_ns)
    );
    let problems = counted(report.problems.len() as u64 + report.more_problems, "problem");
    match report.verdict {
        Verdict::Whole => format!("{path}: whole: {readable}"),
        Verdict::Damaged => format!("{path}: damaged but readable: {problems}; {readable} can be read"),
        Verdict::Unreadable => format!("{path}: nothing can be read: {problems}"),
    }
}

/// Everything `rhombus bag info` says.
pub(super) fn overview(report: &Report) -> Result<String, Error> {
    let mut text = String::new();
    for file in &report.files {
        writeln!(
            text,
            "file      {}, {}, {}",
            file.path.display(),
            file.storage,
            bytes(file.bytes as usize)
        )?;
    }
    let size: u64 = report.files.iter().map(|file| file.bytes).sum();
    writeln!(text, "size      {}", bytes(size as usize))?;
    let distro = match report.ros_distro.as_str() {
        "" => "not recorded",
        distro => distro,
    };
    writeln!(text, "distro    {distro}")?;
    match report.metadata_version {
        Some(version) => writeln!(text, "metadata  version {version}")?,
        None => writeln!(text, "metadata  none")?,
    }
    if let Some(start_ns) = report.start_ns {
        let start = SystemTime::UNIX_EPOCH + Duration::from_nanos(start_ns);
        writeln!(text, "start     {}", humantime::format_rfc3339_nanos(start))?;
    }
    writeln!(text, "duration  {} s", seconds(report.duration_ns))?;
    writeln!(text, "messages  {}", report.message_count)?;
    for topic in &report.topics {
        describe(&mut text, topic, report.start_ns.unwrap_or(0))?;
    }
    text.push('\n');
    for problem in &report.problems {
        writeln!(text, "problem: {problem}")?;
    }
    if report.more_problems > 0 {
        writeln!(text, "and {} more problems", report.more_problems)?;
    }
    for remark in &report.remarks {
        writeln!(text, "remark: {remark}")?;
    }
    writeln!(text, "{}", verdict(report))?;
    Ok(text)
}

fn describe(text: &mut String, topic: &TopicReport, start_ns: u64) -> Result<(), Error> {
    let TopicReport { name, type_name, periods, .. } = topic;
    writeln!(text, "\n{name}  {type_name}")?;
    write!(text, "  messages   {}", topic.messages)?;
    if topic.recorded > topic.messages {
        write!(text, " of {}", topic.recorded)?;
    }
    if let Some(rate) = periods.mean_rate_hz {
        write!(text, ", {rate:.3} Hz")?;
    }
    writeln!(text, ", {}", bytes(topic.bytes as usize))?;
    if let (Some(largest), Some(median)) = (periods.largest_gap, periods.median_ns) {
        writeln!(
            text,
            "  gaps       {} longer than three periods of {} s; the largest, {} s, at {} s",
            periods.gaps,
            seconds(median),
            seconds(largest.length_ns),
            seconds(largest.after_ns.saturating_sub(start_ns))
        )?;
    }
    match periods.log_times_back {
        0 => writeln!(text, "  log times  in order")?,
        back => writeln!(text, "  log times  {back} behind later ones")?,
    }
    if let Some(stamps) = &topic.stamps {
        let order = stamps.oddities().unwrap_or_else(|| "each later than the one before".to_owned());
        writeln!(text, "  stamps     {order}")?;
    }
    writeln!(text, "  QoS        {}", qos(&topic.offered_qos))?;
    let definition = match &topic.definition {
        DefinitionState::Agrees => "agrees with this version".to_owned(),
        DefinitionState::NotKnown => "recorded; not known to this version".to_owned(),
        DefinitionState::Missing => "not recorded".to_owned(),
        DefinitionState::Differs(reason) => format!("another one: {reason}"),
    };
    writeln!(text, "  definition {definition}")?;
    if !topic.type_hash.is_empty() {
        writeln!(text, "  type hash  {}", topic.type_hash)?;
    }
    if let Some(failures) = &topic.undecodable {
        writeln!(text, "  not decodable {} (the first is message {})", failures.messages, failures.first_at)?;
    }
    Ok(())
}

/// What the publishers offered, each offer once.
fn qos(offered: &[Qos]) -> String {
    let offers: BTreeSet<String> =
        offered.iter().map(|qos| format!("{}, {}", word(&qos.reliability), word(&qos.durability))).collect();
    match offers.is_empty() {
        true => "not recorded".to_owned(),
        false => offers.into_iter().collect::<Vec<_>>().join("; "),
    }
}

/// The word `metadata.yaml` has for a policy.
fn word(policy: &impl Serialize) -> String {
    match serde_json::to_value(policy) {
        Ok(serde_json::Value::String(word)) => word,
        _ => "unknown".to_owned(),
    }
}

/// With its noun in the right number.
pub(super) fn counted(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// To the nanosecond, without trailing zeros beyond the millisecond.
fn seconds(ns: u64) -> String {
    let text = format!("{}.{:09}", ns / 1_000_000_000, ns % 1_000_000_000);
    let cut = text.trim_end_matches('0').len().max(text.len() - 6);
    text.get(..cut).unwrap_or(&text).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_have_what_a_nanosecond_needs_and_three_digits_at_least() {
        assert_eq!(seconds(0), "0.000");
        assert_eq!(seconds(1_500_000_000), "1.500");
        assert_eq!(seconds(1), "0.000000001");
        assert_eq!(seconds(u64::MAX), "18446744073.709551615");
    }
}
