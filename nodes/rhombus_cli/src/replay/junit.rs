//! The outcome of a comparison as JUnit XML, which every CI shows as tests.

use std::fmt::Write;

use recording::{Outcome, TopicOutcome, Verdict};

use super::text;
use crate::markup::xml as escaped;

/// One test suite with one test case for each topic: a difference is a failure, a topic that cannot be judged an error. What
/// hinders the comparison as a whole is a test case of its own.
pub fn junit(outcome: &Outcome) -> String {
    let mut cases: Vec<String> = outcome.topics.iter().map(|topic| case(outcome, topic)).collect();
    let count = |is: fn(&Verdict) -> bool| outcome.topics.iter().filter(|topic| is(&topic.verdict)).count();
    let failures = count(|verdict| *verdict == Verdict::Different);
    let mut errors = count(|verdict| matches!(verdict, Verdict::NotCompared(_)));
    if let (Verdict::NotCompared(reason), 0) = (&outcome.verdict, errors) {
        cases.push(element(outcome, "recordings", Some(("error", reason, &text::verdict(outcome)))));
        errors += 1;
    }
    let numbers =
        format!("tests=\"{}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"0\"", cases.len());
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {numbers}>\n\
         <testsuite name=\"rhombus replay\" {numbers}>\n{}</testsuite>\n</testsuites>\n",
        cases.concat()
    )
}

fn case(outcome: &Outcome, topic: &TopicOutcome) -> String {
    let mut lines = vec![text::summary(topic)];
    lines.extend(text::details(topic));
    let long = lines.join("\n");
    let short = topic.first.as_ref().map_or_else(|| text::summary(topic), text::divergence);
    let problem = match &topic.verdict {
        Verdict::Same => None,
        Verdict::Different => Some(("failure", short.as_str(), long.as_str())),
        Verdict::NotCompared(reason) => Some(("error", reason.as_str(), long.as_str())),
    };
    element(outcome, &topic.name, problem)
}

/// `problem`: its tag, its message, its text.
fn element(outcome: &Outcome, name: &str, problem: Option<(&str, &str, &str)>) -> String {
    let golden = outcome.golden.display().to_string();
    let mut text = format!("<testcase classname=\"{}\" name=\"{}\"", escaped(&golden), escaped(name));
    match problem {
        None => text.push_str("/>\n"),
        Some((tag, message, long)) => {
            let (message, long) = (escaped(message), escaped(long));
            // A line break in an attribute would be read as a blank.
            let message = message.replace('\n', "&#10;");
            let _ =
                write!(text, ">\n<{tag} message=\"{message}\" type=\"{tag}\">{long}</{tag}>\n</testcase>\n");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::text::sample;
    use super::junit;
    use recording::Verdict;

    #[test]
    fn every_topic_is_a_test_case_and_a_difference_its_failure() {
        let xml = junit(&sample::outcome());
        let numbers = "tests=\"3\" failures=\"2\" errors=\"0\" skipped=\"0\"";
        assert!(xml.contains(&format!("<testsuite name=\"rhombus replay\" {numbers}>")), "{xml}");
        assert!(xml.contains("<testcase classname=\"tests/golden\" name=\"/contact_state\"/>"), "{xml}");
        assert!(
            xml.contains("<failure message=\"message #20 (stamp 10.020000000 s): wrench.force.z is -1.5 N"),
            "{xml}"
        );
        assert_eq!(xml.matches("</failure>").count(), 2);
    }

    #[test]
    fn names_and_reasons_are_escaped_and_a_refusal_of_the_whole_is_an_error() {
        let mut outcome = sample::outcome();
        outcome.golden = "a<b>&\"c\"".into();
        outcome.verdict = Verdict::NotCompared("<cut>\nat \u{7}byte 5".to_owned());
        let xml = junit(&outcome);
        assert!(xml.contains("classname=\"a&lt;b&gt;&amp;&quot;c&quot;\" name=\"recordings\""), "{xml}");
        assert!(
            xml.contains("<error message=\"&lt;cut&gt;&#10;at \u{fffd}byte 5\" type=\"error\">"),
            "{xml}"
        );
        assert!(xml.contains("tests=\"4\" failures=\"2\" errors=\"1\""), "{xml}");
    }
}
