//! Other names for recorded topics.

use anyhow::bail;

use crate::names;

/// A topic of the recording that is played under another name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Remapping {
    /// Absolute name in the recording.
    pub(crate) from: String,
    /// Absolute name in the graph.
    pub(crate) to: String,
}

impl Remapping {
    /// Reads `FROM:=TO`; relative names stand in `namespace`.
    pub(crate) fn parse(text: &str, namespace: &str) -> anyhow::Result<Self> {
        let Some((from, to)) = text.split_once(":=") else {
            bail!("replay.remap: {text:?} has no \":=\"; accepted: FROM:=TO, two names of topics");
        };
        let name = |name: &str| names::topic(namespace, name.trim(), "replay.remap");
        Ok(Self { from: name(from)?, to: name(to)? })
    }
}

/// The name under which each of the `recorded` topics is played.
///
/// # Errors
/// A rule names a topic that is not played, or one topic twice; or two topics get the same name.
pub(crate) fn targets(recorded: &[&str], rules: &[Remapping]) -> anyhow::Result<Vec<String>> {
    for (number, rule) in rules.iter().enumerate() {
        if !recorded.contains(&rule.from.as_str()) {
            bail!("replay.remap: {} is not among the played topics {recorded:?}", rule.from);
        }
        if let Some(other) = rules.iter().take(number).find(|other| other.from == rule.from) {
            bail!("replay.remap: {} is given two names, {} and {}", rule.from, other.to, rule.to);
        }
    }
    let mut targets: Vec<String> = Vec::new();
    for name in recorded {
        let rule = rules.iter().find(|rule| rule.from == *name);
        let target = rule.map_or(*name, |rule| &rule.to);
        if let Some((other, _)) = recorded.iter().zip(&targets).find(|(_, taken)| *taken == target) {
            bail!(
                "{other} and {name} would both be played as {target}; leave one out with replay.topics or give \
                 it another name with replay.remap"
            );
        }
        targets.push(target.to_owned());
    }
    Ok(targets)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(texts: &[&str]) -> Vec<Remapping> {
        texts.iter().map(|text| Remapping::parse(text, "/or").unwrap()).collect()
    }

    #[test]
    fn relative_names_stand_in_the_namespace_and_topics_without_a_rule_keep_theirs() {
        let targets = targets(&["/or/a", "/b", "/c"], &rules(&["a:=left/a", "/b:=x"])).unwrap();
        assert_eq!(targets, ["/or/left/a", "/or/x", "/c"]);
    }

    #[test]
    fn two_topics_may_change_their_names() {
        assert_eq!(targets(&["/a", "/b"], &rules(&["/a:=/b", "/b:=/a"])).unwrap(), ["/b", "/a"]);
    }

    #[test]
    fn what_cannot_be_meant_is_an_error_that_names_the_topics() {
        let error =
            |recorded: &[&str], texts: &[&str]| targets(recorded, &rules(texts)).unwrap_err().to_string();
        assert!(error(&["/a", "/b"], &["/a:=/b"]).starts_with("/a and /b would both be played as /b"));
        assert!(error(&["/a", "/a"], &[]).contains("/a and /a"));
        assert!(error(&["/a"], &["/c:=/d"]).contains("/c is not among the played topics [\"/a\"]"));
        assert!(error(&["/a"], &["/a:=/d", "/a:=/e"]).contains("/a is given two names, /d and /e"));
        for text in ["a", "a:b", "a:=", ":=b", "a:=b c", "a:=b:=c"] {
            assert!(Remapping::parse(text, "/").is_err(), "{text}");
        }
    }
}
