//! Findings as text and as JSON.

use std::collections::BTreeMap;
use std::fmt::Write;

use devices::Description;
use devices::check::{Finding, Verdict};
use serde::Serialize;

/// Of one device. Field names and their order are the JSON.
#[derive(Serialize)]
pub(super) struct Report {
    /// None: it was not opened.
    pub(super) device: Option<Identity>,
    pub(super) rate_hz: f64,
    pub(super) seconds: f64,
    pub(super) forces: bool,
    pub(super) findings: Vec<Line>,
    /// No finding is a failure.
    pub(super) ok: bool,
}

#[derive(Serialize)]
pub(super) struct Identity {
    backend: &'static str,
    model: String,
    serial: String,
    firmware: String,
}

impl Identity {
    pub(super) fn of(description: &Description) -> Identity {
        let Description { backend, model, serial, firmware, .. } = description.clone();
        Identity { backend, model, serial, firmware }
    }
}

#[derive(Serialize)]
pub(super) struct Line {
    name: &'static str,
    /// `ok`, `warning` or `failure`.
    verdict: &'static str,
    found: String,
    limit: String,
    remedy: String,
    numbers: BTreeMap<&'static str, f64>,
}

impl Line {
    pub(super) fn of(finding: Finding) -> Line {
        let Finding { name, verdict, found, limit, remedy, numbers } = finding;
        Line { name, verdict: verdict.word(), found, limit, remedy, numbers: numbers.into_iter().collect() }
    }

    pub(super) fn is_failure(&self) -> bool {
        self.verdict == Verdict::Failure.word()
    }
}

impl std::fmt::Display for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = String::new();
        for Line { name, verdict, found, limit, remedy, .. } in &self.findings {
            let name = name.replace('_', " ");
            write!(text, "{verdict:<9}{name:<16}{found}")?;
            if !limit.is_empty() {
                write!(text, " [wanted: {limit}]")?;
            }
            writeln!(text)?;
            if !remedy.is_empty() {
                writeln!(text, "{:25}-> {remedy}", "")?;
            }
        }
        let count =
            |verdict: Verdict| self.findings.iter().filter(|line| line.verdict == verdict.word()).count();
        let [ok, warnings, failures] = [Verdict::Ok, Verdict::Warning, Verdict::Failure].map(count);
        writeln!(text, "{ok} ok, warnings: {warnings}, failures: {failures}")?;
        f.write_str(&text)
    }
}
