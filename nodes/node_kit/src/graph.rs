//! Other nodes' publishers, as the middleware knows them.

use r2r::QosProfile;
use r2r::qos::{DurabilityPolicy, ReliabilityPolicy};

/// Bytes of a DDS GUID that name the participant, which is a process; the rest names the publisher in it.
const PARTICIPANT: usize = 12;

/// A publisher of a topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RemotePublisher {
    /// The full name of its node; "a node not yet known" when only the publisher has been discovered so far.
    pub node: String,
    /// Tells processes apart whose nodes have one name; all zero where the middleware does not say.
    pub process: [u8; PARTICIPANT],
    /// Whether a reliable subscription gets its messages.
    pub is_reliable: bool,
    /// Whether it keeps messages for those who come later.
    pub keeps: bool,
}

impl RemotePublisher {
    /// From what rcl says of an endpoint: name and namespace of its node, its identifier and its quality of service.
    pub(crate) fn new(name: &str, namespace: &str, gid: &[u8], qos: &QosProfile) -> RemotePublisher {
        // A middleware that is no DDS makes identifiers by other rules.
        let is_dds =
            !std::env::var("RMW_IMPLEMENTATION").is_ok_and(|middleware| middleware.contains("zenoh"));
        RemotePublisher {
            node: match name {
                "" | "_NODE_NAME_UNKNOWN_" => "a node not yet known".to_owned(),
                name => format!("{}/{name}", namespace.trim_end_matches('/')),
            },
            process: gid.first_chunk().filter(|_| is_dds).copied().unwrap_or_default(),
            is_reliable: !matches!(qos.reliability, ReliabilityPolicy::BestEffort),
            keeps: matches!(qos.durability, DurabilityPolicy::TransientLocal),
        }
    }
}
