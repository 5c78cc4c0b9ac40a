//! Health of the node on `/diagnostics`, once a second of the steady clock and at changes of state.

use std::fmt::Display;
use std::time::{Duration, Instant};

use r2r::diagnostic_msgs::msg::{DiagnosticArray, DiagnosticStatus, KeyValue};
use r2r::std_msgs::msg::Header;

use crate::clock::NodeClock;
use crate::{PublishError, Publisher, StartError, topics};

/// Time between two reports.
const PERIOD: Duration = Duration::from_secs(1);

/// How well something is, in the numbers of `diagnostic_msgs/DiagnosticStatus`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// As it should be.
    Ok = 0,
    /// Works, but somebody should look.
    Warn = 1,
    /// Does not work.
    Error = 2,
    /// Nothing was heard for too long.
    Stale = 3,
}

/// The state of one thing the node takes care of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Status {
    level: Level,
    subject: String,
    summary: String,
    values: Vec<(String, String)>,
}

impl Status {
    /// `subject` completes the name ("/deformation: left"), `summary` is one line for people.
    pub fn new(level: Level, subject: impl Into<String>, summary: impl Into<String>) -> Status {
        Status { level, subject: subject.into(), summary: summary.into(), values: Vec::new() }
    }

    /// Add a key and its value. Keys name their unit ("depth_mm").
    pub fn with(mut self, key: impl Into<String>, value: impl Display) -> Status {
        self.values.push((key.into(), value.to_string()));
        self
    }
}

/// Publishes the statuses of one node.
pub(crate) struct Diagnostics {
    node_name: String,
    clock: NodeClock,
    publisher: Publisher<DiagnosticArray>,
    due: Instant,
}

impl Diagnostics {
    pub(crate) fn new(
        node: &mut r2r::Node,
        clock: NodeClock,
        node_name: &str,
    ) -> Result<Diagnostics, StartError> {
        Ok(Diagnostics {
            node_name: node_name.to_owned(),
            clock,
            publisher: Publisher::new(node, &topics::DIAGNOSTICS, "")?,
            due: Instant::now(),
        })
    }

    /// True once in every period.
    pub(crate) fn is_due(&mut self) -> bool {
        let now = Instant::now();
        if now < self.due {
            return false;
        }
        // A node that was held up does not make up for the reports it missed.
        self.due = (self.due + PERIOD).max(now);
        true
    }

    pub(crate) fn publish(&self, statuses: Vec<Status>) -> Result<(), PublishError> {
        let status = statuses
            .into_iter()
            .map(|status| DiagnosticStatus {
                level: status.level as u8,
                name: format!("{}: {}", self.node_name, status.subject),
                message: status.summary,
                hardware_id: String::new(),
                values: status.values.into_iter().map(|(key, value)| KeyValue { key, value }).collect(),
            })
            .collect();
        let header = Header { stamp: self.clock.now(), frame_id: String::new() };
        self.publisher.publish(&DiagnosticArray { header, status })
    }
}
