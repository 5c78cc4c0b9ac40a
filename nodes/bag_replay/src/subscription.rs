//! One recorded topic: its subscription, which adapts to the publishers that appear, and its place in the recording.

use node_kit::{Inbox, NodeKit};
use r2r::QosProfile;

use crate::graph::{self, Request};
use crate::storage::Storage;

/// A topic to be recorded.
pub(crate) struct Subscription {
    name: String,
    /// Not known until a publisher appears, for topics that are none of the session's.
    type_name: Option<String>,
    request: Request,
    inbox: Option<Inbox<Vec<u8>>>,
    /// Number in the recording.
    stored_as: Option<usize>,
    has_publishers: bool,
    /// Said once, then left alone.
    given_up: bool,
}

impl Subscription {
    /// A topic whose type and QoS are known: it is subscribed at once, so that the first message is not missed.
    pub(crate) fn to_session_topic(
        kit: &mut NodeKit,
        name: &str,
        type_name: &str,
        qos: &QosProfile,
    ) -> anyhow::Result<Self> {
        let mut subscription = Self::to_any_topic(name);
        subscription.type_name = Some(type_name.to_owned());
        subscription.request = Request::matching([qos]);
        subscription.inbox = Some(kit.subscribe_raw(name, type_name, subscription.request.profile())?);
        Ok(subscription)
    }

    /// A topic of which only the name is known: it is subscribed when a publisher appears.
    pub(crate) fn to_any_topic(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            type_name: None,
            request: Request { reliable: true, transient_local: true },
            inbox: None,
            stored_as: None,
            has_publishers: false,
            given_up: false,
        }
    }

    /// Whether nobody has published the topic so far.
    pub(crate) fn is_waiting(&self) -> bool {
        !self.has_publishers && !self.given_up
    }

    /// Looks who publishes the topic now: subscribes, or asks for less when a publisher offers less.
    pub(crate) fn look(&mut self, kit: &mut NodeKit, storage: &mut Storage) -> anyhow::Result<()> {
        if self.given_up {
            return Ok(());
        }
        let publishers = kit.node().get_publishers_info_by_topic(&self.name, false)?;
        let Some(first) = publishers.first() else { return Ok(()) };
        self.has_publishers = true;
        let type_name = self.type_name.get_or_insert_with(|| first.topic_type.clone()).clone();
        let (same, other): (Vec<_>, Vec<_>) =
            publishers.iter().partition(|publisher| publisher.topic_type == type_name);
        if let (Some(other), None) = (other.first(), self.stored_as) {
            let (name, node, found) = (&self.name, &other.node_name, &other.topic_type);
            kit.log().warn(&format!(
                "{name}: what {node} publishes is {found} and not recorded; recorded is {type_name}"
            ));
        }
        let offers: Vec<QosProfile> =
            same.into_iter().map(|publisher| publisher.qos_profile.clone()).collect();
        if offers.is_empty() {
            return Ok(());
        }
        let request = Request::matching(&offers);
        let request = if self.inbox.is_some() { self.request.and(request) } else { request };
        if self.inbox.is_none() || request != self.request {
            self.request = request;
            match kit.subscribe_raw(&self.name, &type_name, request.profile()) {
                Ok(inbox) => self.inbox = Some(inbox),
                Err(error) => {
                    self.given_up = true;
                    kit.log().error(&format!("{} is not recorded: {error}", self.name));
                    return Ok(());
                }
            }
        }
        self.announce(storage, &offers);
        Ok(())
    }

    /// Hands every message that waits to `storage`. `now_ns` is the time of receipt, ns since 1970.
    pub(crate) fn drain(&mut self, kit: &mut NodeKit, storage: &mut Storage, now_ns: u64) -> bool {
        let mut any = false;
        while let Some(data) = self.inbox.as_mut().and_then(Inbox::take) {
            any = true;
            let stored_as = match self.stored_as {
                Some(number) => number,
                // The message was faster than the next look at the graph.
                None => {
                    let publishers = kit.node().get_publishers_info_by_topic(&self.name, false);
                    let offers: Vec<_> = publishers
                        .unwrap_or_default()
                        .into_iter()
                        .map(|publisher| publisher.qos_profile)
                        .collect();
                    self.announce(storage, &offers)
                }
            };
            storage.store(stored_as, now_ns, data);
        }
        any
    }

    /// Adds the topic to the recording with what its publishers offer.
    fn announce(&mut self, storage: &mut Storage, offers: &[QosProfile]) -> usize {
        *self.stored_as.get_or_insert_with(|| {
            let offered_qos = offers.iter().map(graph::recorded).collect();
            storage.add_topic(&self.name, self.type_name.as_deref().unwrap_or_default(), offered_qos)
        })
    }
}
