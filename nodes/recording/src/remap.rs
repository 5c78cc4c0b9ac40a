//! Other names for recorded topics, for whoever plays or replays them.

use std::collections::BTreeMap;

/// Names that cannot be meant.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RemapError {
    /// A rule for what is not there.
    #[error("{name} is not among the topics {topics}")]
    NotRecorded {
        /// What the rule names.
        name: String,
        /// What is there, in words.
        topics: String,
    },
    /// Two rules for one topic.
    #[error("{name} is given two names, {one} and {other}")]
    TwoNames {
        /// In the recording.
        name: String,
        /// By the first rule.
        one: String,
        /// By the second rule.
        other: String,
    },
    /// Messages of two topics would be taken as those of one.
    #[error("{one} and {other} would both be {target}; one of them needs another name")]
    OneName {
        /// In the recording.
        one: String,
        /// In the recording.
        other: String,
        /// The name that both would have.
        target: String,
    },
}

/// The name of each of the `recorded` topics under the `rules`: names in the recording, and the names they get. One that
/// is recorded several times, such as with two types, has one name.
///
/// # Errors
/// A rule names a topic that is not recorded, two rules give one topic two names, or two topics get the same name.
pub fn remapped(recorded: &[&str], rules: &[(String, String)]) -> Result<Vec<String>, RemapError> {
    for (number, (from, to)) in rules.iter().enumerate() {
        if !recorded.contains(&from.as_str()) {
            let topics = if recorded.is_empty() { "none".to_owned() } else { recorded.join(" ") };
            return Err(RemapError::NotRecorded { name: from.clone(), topics });
        }
        let before = rules.iter().take(number).find(|(name, _)| name == from);
        if let Some((_, one)) = before.filter(|(_, one)| one != to) {
            let (one, other) = (one.clone(), to.clone());
            return Err(RemapError::TwoNames { name: from.clone(), one, other });
        }
    }
    let target = |name: &str| {
        let rule = rules.iter().find(|(from, _)| from == name);
        rule.map_or(name, |(_, to)| to.as_str()).to_owned()
    };
    let mut taken: BTreeMap<String, &str> = BTreeMap::new();
    let mut targets = Vec::new();
    for name in recorded {
        let target = target(name);
        let one = *taken.entry(target.clone()).or_insert(name);
        if one != *name {
            return Err(RemapError::OneName { one: one.to_owned(), other: (*name).to_owned(), target });
        }
        targets.push(target);
    }
    Ok(targets)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(recorded: &[&str], rules: &[(&str, &str)]) -> Result<Vec<String>, String> {
        let rules: Vec<_> = rules.iter().map(|(from, to)| ((*from).to_owned(), (*to).to_owned())).collect();
        remapped(recorded, &rules).map_err(|error| error.to_string())
    }

    #[test]
    fn topics_without_a_rule_keep_their_names_and_two_may_change_theirs() {
        assert_eq!(names(&["/a", "/b", "/c"], &[("/a", "/b"), ("/b", "/a")]).unwrap(), ["/b", "/a", "/c"]);
        assert_eq!(names(&["/a", "/a"], &[("/a", "/b")]).unwrap(), ["/b", "/b"], "recorded with two types");
        assert_eq!(names(&["/a"], &[("/a", "/b"), ("/a", "/b")]).unwrap(), ["/b"], "said twice");
    }

    #[test]
    fn what_cannot_be_meant_is_an_error_that_names_the_topics() {
        let error = |recorded: &[&str], rules: &[(&str, &str)]| names(recorded, rules).unwrap_err();
        let one_name = error(&["/a", "/b"], &[("/a", "/b")]);
        assert_eq!(one_name, "/a and /b would both be /b; one of them needs another name");
        assert!(error(&["/a", "/b"], &[("/a", "/c"), ("/b", "/c")]).contains("both be /c"));
        assert_eq!(error(&["/a"], &[("/a", "/b"), ("/a", "/c")]), "/a is given two names, /b and /c");
        assert_eq!(error(&["/a"], &[("/c", "/d")]), "/c is not among the topics /a");
    }
}
