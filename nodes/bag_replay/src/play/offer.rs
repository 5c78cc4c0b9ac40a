//! Quality of service that a replay offers in place of the recorded one.

use anyhow::bail;
use r2r::QosProfile;

use crate::names;

/// What shall be different on one topic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct QosRule {
    /// Absolute name as it is played.
    pub(crate) topic: String,
    reliable: Option<bool>,
    transient_local: Option<bool>,
    depth: Option<usize>,
}

impl QosRule {
    /// Reads `TOPIC=WORD,WORD`; a relative name stands in `namespace`.
    pub(crate) fn parse(text: &str, namespace: &str) -> anyhow::Result<Self> {
        const ACCEPTED: &str = "accepted: TOPIC=WORDS with any of reliable or best_effort, transient_local or \
                                volatile, depth=N (1 or more), joined by commas";
        let Some((topic, words)) = text.split_once('=') else {
            bail!("replay.qos: {text:?} has no \"=\"; {ACCEPTED}");
        };
        let topic = names::topic(namespace, topic.trim(), "replay.qos")?;
        let mut rule = Self { topic, reliable: None, transient_local: None, depth: None };
        for word in words.split(',').map(str::trim) {
            let known = match word {
                "reliable" => rule.reliable.replace(true).is_none(),
                "best_effort" => rule.reliable.replace(false).is_none(),
                "transient_local" => rule.transient_local.replace(true).is_none(),
                "volatile" => rule.transient_local.replace(false).is_none(),
                _ => match word.strip_prefix("depth=").map(str::parse) {
                    Some(Ok(depth)) if depth > 0 => rule.depth.replace(depth).is_none(),
                    _ => false,
                },
            };
            if !known {
                bail!("replay.qos: {text:?}: {word:?} is no such word, or contradicts another; {ACCEPTED}");
            }
        }
        Ok(rule)
    }

    /// The profile with what this rule says in it.
    pub(crate) fn apply(&self, profile: QosProfile) -> QosProfile {
        let profile = match self.reliable {
            Some(true) => profile.reliable(),
            Some(false) => profile.best_effort(),
            None => profile,
        };
        let profile = match self.transient_local {
            Some(true) => profile.transient_local(),
            Some(false) => profile.volatile(),
            None => profile,
        };
        match self.depth {
            Some(depth) => profile.keep_last(depth),
            None => profile,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use r2r::qos::{DurabilityPolicy, ReliabilityPolicy};

    #[test]
    fn only_what_a_rule_names_is_changed() {
        let rule = QosRule::parse("clutch=best_effort, depth=7", "/or").unwrap();
        assert_eq!(rule.topic, "/or/clutch");
        let profile = rule.apply(QosProfile::default().keep_last(1000).reliable().transient_local());
        assert_eq!(profile.reliability, ReliabilityPolicy::BestEffort);
        assert_eq!(profile.durability, DurabilityPolicy::TransientLocal);
        assert_eq!(profile.depth, 7);
    }

    #[test]
    fn what_is_no_rule_is_an_error_that_names_the_word() {
        for (text, word) in [
            ("clutch", "has no"),
            ("clutch=", "\"\""),
            ("clutch=reliably", "reliably"),
            ("clutch=reliable,best_effort", "best_effort"),
            ("clutch=depth=0", "depth=0"),
            ("clutch=depth=-1", "depth=-1"),
            ("a b=reliable", "a b"),
        ] {
            let error = QosRule::parse(text, "/").unwrap_err().to_string();
            assert!(error.contains(word) && error.contains("replay.qos"), "{error}");
        }
    }
}
