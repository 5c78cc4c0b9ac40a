//! Quality of service as rosbag2 writes it: words since metadata version 9, the numbers of `rmw` before.

use serde::{Deserialize, Deserializer, Serialize};

use crate::yaml::{self, YamlError};

/// Defines a policy with its word and its `rmw` number; both are read, the word is written.
macro_rules! policy {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $word:literal | $number:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
        pub enum $name { $($(#[$variant_doc])* #[serde(rename = $word)] $variant),+ }

        impl $name {
            /// The number of `rmw`, as metadata before version 9 has it.
            fn number(self) -> i64 {
                match self { $(Self::$variant => $number),+ }
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Ok(match WordOrNumber::deserialize(deserializer)? {
                    $(WordOrNumber::Number($number) => Self::$variant,)+
                    WordOrNumber::Word(word) => match word.as_str() { $($word => Self::$variant,)+ _ => Self::Unknown },
                    WordOrNumber::Number(_) => Self::Unknown,
                })
            }
        }
    };
}

#[derive(Deserialize)]
#[serde(untagged)]
enum WordOrNumber {
    Number(i64),
    Word(String),
}

policy! {
    /// How many messages are kept.
    History {
        /// The middleware decides.
        SystemDefault = "system_default" | 0,
        /// The newest `depth`.
        KeepLast = "keep_last" | 1,
        /// All, as far as memory allows.
        KeepAll = "keep_all" | 2,
        /// Not told by the middleware (Fast DDS never tells).
        Unknown = "unknown" | 3,
    }
}
policy! {
    /// Whether a lost message is sent again.
    Reliability {
        /// The middleware decides.
        SystemDefault = "system_default" | 0,
        /// It is.
        Reliable = "reliable" | 1,
        /// It is not.
        BestEffort = "best_effort" | 2,
        /// Not told by the middleware.
        Unknown = "unknown" | 3,
        /// Whatever the other side offers.
        BestAvailable = "best_available" | 4,
    }
}
policy! {
    /// Whether late subscribers get what was sent before.
    Durability {
        /// The middleware decides.
        SystemDefault = "system_default" | 0,
        /// They do ("latched").
        TransientLocal = "transient_local" | 1,
        /// They do not.
        Volatile = "volatile" | 2,
        /// Not told by the middleware.
        Unknown = "unknown" | 3,
        /// Whatever the other side offers.
        BestAvailable = "best_available" | 4,
    }
}
policy! {
    /// How a publisher proves that it lives.
    Liveliness {
        /// The middleware decides.
        SystemDefault = "system_default" | 0,
        /// The middleware does it.
        Automatic = "automatic" | 1,
        /// Each node does it (no longer in ROS 2).
        ManualByNode = "manual_by_node" | 2,
        /// Each publisher does it.
        ManualByTopic = "manual_by_topic" | 3,
        /// Not told by the middleware.
        Unknown = "unknown" | 4,
        /// Whatever the other side offers.
        BestAvailable = "best_available" | 5,
    }
}

/// A duration of `rmw`: the default 0 means "not set", [`QosTime::INFINITE`] "never".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct QosTime {
    /// Whole seconds.
    pub sec: u64,
    /// Nanoseconds on top.
    pub nsec: u64,
}

impl QosTime {
    /// `RMW_DURATION_INFINITE`: 2^63 - 1 nanoseconds.
    pub const INFINITE: Self = Self { sec: 9_223_372_036, nsec: 854_775_807 };
}

/// What a publisher offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Qos {
    /// How many messages are kept.
    pub history: History,
    /// How many with [`History::KeepLast`].
    pub depth: u64,
    /// Whether a lost message is sent again.
    pub reliability: Reliability,
    /// Whether late subscribers get what was sent before.
    pub durability: Durability,
    /// Longest time between two messages.
    pub deadline: QosTime,
    /// How long a message is worth delivering.
    pub lifespan: QosTime,
    /// How the publisher proves that it lives.
    pub liveliness: Liveliness,
    /// How often it must.
    pub liveliness_lease_duration: QosTime,
    /// Topic names without the `rt/` in front on the wire.
    pub avoid_ros_namespace_conventions: bool,
}

impl Default for Qos {
    /// What ROS 2 uses when nothing is said: the newest 10, reliable, volatile.
    fn default() -> Self {
        Self {
            history: History::KeepLast,
            depth: 10,
            reliability: Reliability::Reliable,
            durability: Durability::Volatile,
            deadline: QosTime::INFINITE,
            lifespan: QosTime::INFINITE,
            liveliness: Liveliness::Automatic,
            liveliness_lease_duration: QosTime::INFINITE,
            avoid_ros_namespace_conventions: false,
        }
    }
}

/// The YAML text that rosbag2 puts into the metadata of an MCAP channel.
pub(crate) fn to_yaml(profiles: &[Qos]) -> Result<String, serde_yaml::Error> {
    serde_yaml::to_string(profiles).map(|text| text.trim_end().to_owned())
}

/// The same for metadata before version 9: numbers in place of the words.
pub(crate) fn to_yaml_of_numbers(profiles: &[Qos]) -> Result<String, serde_yaml::Error> {
    #[derive(Serialize)]
    struct Numbers {
        history: i64,
        depth: u64,
        reliability: i64,
        durability: i64,
        deadline: QosTime,
        lifespan: QosTime,
        liveliness: i64,
        liveliness_lease_duration: QosTime,
        avoid_ros_namespace_conventions: bool,
    }
    let numbers = profiles.iter().map(|qos| Numbers {
        history: qos.history.number(),
        depth: qos.depth,
        reliability: qos.reliability.number(),
        durability: qos.durability.number(),
        deadline: qos.deadline,
        lifespan: qos.lifespan,
        liveliness: qos.liveliness.number(),
        liveliness_lease_duration: qos.liveliness_lease_duration,
        avoid_ros_namespace_conventions: qos.avoid_ros_namespace_conventions,
    });
    serde_yaml::to_string(&numbers.collect::<Vec<_>>()).map(|text| text.trim_end().to_owned())
}

/// The inverse of [`to_yaml`] for every metadata version; an empty text is an empty list.
pub(crate) fn from_yaml(text: &str) -> Result<Vec<Qos>, YamlError> {
    if text.trim().is_empty() { Ok(Vec::new()) } else { yaml::from_str(text) }
}

/// For `offered_qos_profiles` in `metadata.yaml`: a list in version 9, a YAML text inside the YAML before, nothing in 1-3.
pub(crate) fn list_or_text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Qos>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum ListOrText {
        List(Vec<Qos>),
        Text(String),
        Nothing(()),
    }
    match ListOrText::deserialize(deserializer)? {
        ListOrText::List(list) => Ok(list),
        ListOrText::Text(text) => from_yaml(&text).map_err(serde::de::Error::custom),
        ListOrText::Nothing(()) => Ok(Vec::new()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Recorded by Foxy: numbers, and the durations Fast DDS gave then.
    const NUMBERS: &str = "- history: 3\n  depth: 0\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: 2147483647\n    \
        nsec: 4294967295\n  lifespan:\n    sec: 10\n    nsec: 0\n  liveliness: 1\n  liveliness_lease_duration:\n    sec: 0\n    \
        nsec: 0\n  avoid_ros_namespace_conventions: false";

    #[test]
    fn numbers_of_old_recordings_and_words_of_new_ones_say_the_same() {
        let old = from_yaml(NUMBERS).unwrap();
        assert_eq!(old.len(), 1);
        assert_eq!(old[0].reliability, Reliability::Reliable);
        assert_eq!(old[0].durability, Durability::TransientLocal);
        assert_eq!(old[0].history, History::Unknown);
        assert_eq!(from_yaml(&to_yaml(&old).unwrap()).unwrap(), old);
        assert!(to_yaml(&old).unwrap().contains("durability: transient_local"));
        let numbers = to_yaml_of_numbers(&old).unwrap();
        assert!(numbers.contains("durability: 1") && numbers.contains("history: 3"), "{numbers}");
        assert_eq!(from_yaml(&numbers).unwrap(), old);
    }

    #[test]
    fn a_policy_of_a_later_ros_is_unknown_and_not_an_error() {
        let text = NUMBERS.replace("reliability: 1", "reliability: telepathic");
        assert_eq!(from_yaml(&text).unwrap()[0].reliability, Reliability::Unknown);
    }
}
