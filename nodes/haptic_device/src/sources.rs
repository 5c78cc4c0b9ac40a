//! Who commands a force. Two publishers of one command would take turns at the motors, so neither is followed.

use std::fmt::Write;

use node_kit::RemotePublisher;

/// A topic that moves the motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CommandTopic {
    /// `servo_cf`
    Servo,
    /// `spatial/servo_cf`
    SpatialServo,
    /// `body/servo_cf`
    BodyServo,
    /// `gripper/servo_jf`
    GripperServo,
    /// `contact_law`
    Law,
}

impl CommandTopic {
    /// Every one.
    pub(crate) const ALL: [CommandTopic; 5] = [
        CommandTopic::Servo,
        CommandTopic::SpatialServo,
        CommandTopic::BodyServo,
        CommandTopic::GripperServo,
        CommandTopic::Law,
    ];
    /// Those that command the same thing, the wrench on the hand: the newest message of any of them counts.
    const WRENCH: [CommandTopic; 3] =
        [CommandTopic::Servo, CommandTopic::SpatialServo, CommandTopic::BodyServo];

    pub(crate) fn name(self) -> &'static str {
        match self {
            CommandTopic::Servo => "servo_cf",
            CommandTopic::SpatialServo => "spatial/servo_cf",
            CommandTopic::BodyServo => "body/servo_cf",
            CommandTopic::GripperServo => "gripper/servo_jf",
            CommandTopic::Law => "contact_law",
        }
    }
}

/// Two publishers of one topic, or one that this node's reliable subscription does not match, in words that name their
/// nodes and what does not come of it; none for one that is heard, or nobody.
pub(crate) fn trouble(topic: &str, publishers: &[RemotePublisher], what: &str) -> Option<String> {
    match publishers {
        [only] if !only.is_reliable => Some(format!(
            "{topic}: what {} publishes is best effort and does not arrive: no {what} from it until it is reliable",
            only.node
        )),
        [] | [_] => None,
        several => Some(format!(
            "{topic} has {} publishers ({}): no {what} from it until there is one",
            several.len(),
            names(several)
        )),
    }
}

/// The nodes of publishers, in words.
pub(crate) fn names(publishers: &[RemotePublisher]) -> String {
    publishers.iter().map(|publisher| publisher.node.as_str()).collect::<Vec<_>>().join(", ")
}

/// The publishers of every command topic, as last seen.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sources {
    /// By the order of [`CommandTopic::ALL`].
    publishers: [Vec<RemotePublisher>; CommandTopic::ALL.len()],
}

impl Sources {
    /// Who publishes a topic.
    pub(crate) fn see(&mut self, topic: CommandTopic, publishers: Vec<RemotePublisher>) {
        self.publishers[topic as usize] = publishers;
    }

    /// Whether a topic's publisher has been seen at all.
    pub(crate) fn knows(&self, topic: CommandTopic) -> bool {
        !self.of(topic).is_empty()
    }

    /// Why a topic is not followed: not known yet, or not the only one. None: it is followed.
    pub(crate) fn refusal(&self, topic: CommandTopic) -> Option<String> {
        if !self.knows(topic) {
            return Some("its publisher is not known yet".to_owned());
        }
        self.conflict(topic)
    }

    /// Every conflict there is, in words that name the nodes.
    pub(crate) fn conflicts(&self) -> Vec<String> {
        let mut conflicts = Vec::new();
        for conflict in CommandTopic::ALL.into_iter().filter_map(|topic| self.conflict(topic)) {
            if !conflicts.contains(&conflict) {
                conflicts.push(conflict);
            }
        }
        conflicts
    }

    fn of(&self, topic: CommandTopic) -> &[RemotePublisher] {
        &self.publishers[topic as usize]
    }

    fn conflict(&self, topic: CommandTopic) -> Option<String> {
        let own = self.of(topic);
        if let Some(trouble) = trouble(topic.name(), own, "force") {
            return Some(trouble);
        }
        let is_wrench = CommandTopic::WRENCH.contains(&topic) && !own.is_empty();
        // One node may have all of them; two nodes of one name in two processes are two.
        let client = |(_, publisher): (_, &'_ RemotePublisher)| (publisher.node.clone(), publisher.process);
        let mut clients = self.wrench_publishers().map(client);
        let first = clients.next();
        if !is_wrench || clients.all(|other| Some(other) == first) {
            return None;
        }
        let mut text = "several nodes command the wrench (".to_owned();
        for (i, (topic, publisher)) in self.wrench_publishers().enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            // Writing to a string does not fail.
            let _ = write!(text, "{comma}{} by {}", publisher.node, topic.name());
        }
        Some(text + "): no force from them until there is one")
    }

    fn wrench_publishers(&self) -> impl Iterator<Item = (CommandTopic, &RemotePublisher)> {
        CommandTopic::WRENCH
            .into_iter()
            .flat_map(|topic| self.of(topic).iter().map(move |publisher| (topic, publisher)))
    }
}

#[cfg(test)]
mod tests {
    use super::CommandTopic::{BodyServo, GripperServo, Law, Servo, SpatialServo};
    use super::*;

    fn publisher(node: &str) -> RemotePublisher {
        RemotePublisher { node: node.to_owned(), process: [0; 12], is_reliable: true, keeps: false }
    }

    fn sources(seen: &[(CommandTopic, &[&str])]) -> Sources {
        let mut sources = Sources::default();
        for (topic, nodes) in seen {
            sources.see(*topic, nodes.iter().map(|&node| publisher(node)).collect());
        }
        sources
    }

    #[test]
    fn one_publisher_is_followed_and_an_unknown_one_not_yet() {
        let sources = sources(&[(Servo, &["/deformation"]), (Law, &["/deformation"])]);
        assert_eq!(sources.refusal(Servo), None);
        assert_eq!(sources.refusal(Law), None);
        assert!(sources.refusal(BodyServo).unwrap().contains("not known yet"));
        assert!(sources.conflicts().is_empty());
    }

    #[test]
    fn a_second_publisher_of_a_topic_silences_both_and_leaves_other_topics_alone() {
        let sources = sources(&[(Servo, &["/console"]), (Law, &["/deformation", "/other"])]);
        let refusal = sources.refusal(Law).unwrap();
        assert!(refusal.contains("contact_law has 2 publishers (/deformation, /other)"), "{refusal}");
        assert_eq!(sources.refusal(Servo), None);
        assert_eq!(sources.conflicts(), [refusal]);
    }

    #[test]
    fn the_second_publisher_may_be_of_the_same_node() {
        assert!(sources(&[(Law, &["/a", "/a"])]).refusal(Law).is_some());
    }

    #[test]
    fn two_nodes_that_command_the_wrench_by_different_topics_are_refused_too() {
        let sources =
            sources(&[(Servo, &["/deformation"]), (BodyServo, &["/console"]), (GripperServo, &["/x"])]);
        let refusal = sources.refusal(BodyServo).unwrap();
        assert!(refusal.contains("/deformation by servo_cf, /console by body/servo_cf"), "{refusal}");
        assert_eq!(sources.refusal(Servo).unwrap(), refusal);
        assert_eq!(sources.refusal(GripperServo), None);
        assert_eq!(sources.conflicts(), [refusal], "said once");
    }

    #[test]
    fn two_processes_whose_nodes_have_one_name_are_two_clients() {
        let mut sources = sources(&[(Servo, &["/client"])]);
        sources.see(BodyServo, vec![RemotePublisher { process: [7; 12], ..publisher("/client") }]);
        let refusal = sources.refusal(BodyServo).unwrap();
        assert!(refusal.contains("/client by servo_cf, /client by body/servo_cf"), "{refusal}");
        assert_eq!(sources.refusal(Servo).unwrap(), refusal);
    }

    #[test]
    fn a_publisher_that_cannot_be_heard_is_named() {
        let mut sources = Sources::default();
        sources.see(Law, vec![RemotePublisher { is_reliable: false, ..publisher("/model") }]);
        let [text] = &sources.conflicts()[..] else { panic!("{:?}", sources.conflicts()) };
        assert!(text.starts_with("contact_law: what /model publishes is best effort"), "{text}");
    }

    #[test]
    fn one_client_may_have_all_of_the_wrench_topics() {
        let sources = sources(&[(SpatialServo, &["/arm"]), (BodyServo, &["/arm"])]);
        assert_eq!([SpatialServo, BodyServo].map(|topic| sources.refusal(topic)), [None, None]);
    }

    #[test]
    fn the_order_is_that_of_the_table() {
        for (i, topic) in CommandTopic::ALL.into_iter().enumerate() {
            assert_eq!(topic as usize, i);
        }
    }
}
