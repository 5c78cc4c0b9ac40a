//! Log lines: to stderr through rcl's logger and to `/rosout`.
//!
//! Since Humble rcl gives no node a `/rosout` publisher by itself and r2r makes none, so lines are published here.
//! A call allocates and takes a process-wide lock: never from a motor loop.

use std::time::{Duration, Instant};

use r2r::rcl_interfaces::msg::Log as LogMessage;

use crate::arguments::Severity;
use crate::clock::NodeClock;
use crate::{Publisher, StartError, topics};

/// The logger of one node. A clone may be moved to another thread.
#[derive(Clone)]
pub struct Log {
    logger: String,
    least: Severity,
    clock: NodeClock,
    publisher: Publisher<LogMessage>,
}

impl Log {
    pub(crate) fn new(node: &mut r2r::Node, clock: NodeClock, least: Severity) -> Result<Log, StartError> {
        Ok(Log {
            logger: node.logger().to_owned(),
            least,
            clock,
            publisher: Publisher::new(node, &topics::ROSOUT, "")?,
        })
    }

    /// For developers.
    pub fn debug(&self, text: &str) {
        r2r::log_debug!(&self.logger, "{text}");
        self.publish(Severity::Debug, text);
    }

    /// Progress.
    pub fn info(&self, text: &str) {
        r2r::log_info!(&self.logger, "{text}");
        self.publish(Severity::Info, text);
    }

    /// Something is off; the node copes.
    pub fn warn(&self, text: &str) {
        r2r::log_warn!(&self.logger, "{text}");
        self.publish(Severity::Warn, text);
    }

    /// Something does not work.
    pub fn error(&self, text: &str) {
        r2r::log_error!(&self.logger, "{text}");
        self.publish(Severity::Error, text);
    }

    /// A line that a session script waits for or reads: written to stderr whatever the log level is.
    pub(crate) fn announce(&self, text: &str) {
        eprintln!("[INFO] [{}]: {text}", self.logger);
        self.publish(Severity::Info, text);
    }

    fn publish(&self, severity: Severity, text: &str) {
        if severity < self.least {
            return;
        }
        let message = LogMessage {
            stamp: self.clock.now(),
            level: severity as u8,
            name: self.logger.clone(),
            msg: text.to_owned(),
            ..LogMessage::default()
        };
        // A line that cannot be published is on stderr; there is nobody else to tell.
        let _ = self.publisher.publish(&message);
    }
}

/// Lets one kind of line through at most once in a period and says how many were held back.
#[derive(Clone, Debug)]
pub struct Throttle {
    period: Duration,
    last: Option<Instant>,
    held_back: u64,
}

impl Throttle {
    /// At most one line in `period`.
    pub fn new(period: Duration) -> Throttle {
        Throttle { period, last: None, held_back: 0 }
    }

    /// [`Log::warn`], unless a line was written within the period.
    pub fn warn(&mut self, log: &Log, text: impl FnOnce() -> String) {
        if let Some(line) = self.line(Instant::now(), text) {
            log.warn(&line);
        }
    }

    /// [`Log::error`], unless a line was written within the period.
    pub fn error(&mut self, log: &Log, text: impl FnOnce() -> String) {
        if let Some(line) = self.line(Instant::now(), text) {
            log.error(&line);
        }
    }

    fn line(&mut self, now: Instant, text: impl FnOnce() -> String) -> Option<String> {
        if self.last.is_some_and(|last| now.duration_since(last) < self.period) {
            self.held_back += 1;
            return None;
        }
        self.last = Some(now);
        Some(match std::mem::take(&mut self.held_back) {
            0 => text(),
            n => format!("{} ({n} more like this were not logged)", text()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_throttle_passes_one_line_in_a_period_and_counts_the_rest() {
        let mut throttle = Throttle::new(Duration::from_secs(1));
        let start = Instant::now();
        let mut at = |ms, text: &str| throttle.line(start + Duration::from_millis(ms), || text.to_owned());
        assert_eq!(at(0, "first").as_deref(), Some("first"));
        assert_eq!(at(1, "held back"), None);
        assert_eq!(at(999, "held back"), None);
        assert_eq!(at(1000, "late").as_deref(), Some("late (2 more like this were not logged)"));
        assert_eq!(at(2000, "again").as_deref(), Some("again"));
    }
}
