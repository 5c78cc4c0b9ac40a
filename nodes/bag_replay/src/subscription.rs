//! One recorded topic: its subscription, which adapts to the publishers that appear, and its place in the recording.

use std::time::{Duration, Instant};

use node_kit::NodeKit;
use r2r::QosProfile;

use crate::batch::Batch;
use crate::graph::{self, Request};
use crate::rcl::{self, RawNode};
use crate::storage::Storage;

/// A topic that was silent for this long is asked less often.
const SILENT: Duration = Duration::from_secs(1);

/// A topic to be recorded.
pub(crate) struct Subscription {
    /// Before remapping.
    asked: String,
    /// In the graph, as far as it is known.
    name: String,
    /// Not known until a publisher appears, for topics that are none of the session's.
    type_name: Option<String>,
    request: Request,
    inner: Option<rcl::Subscription>,
    /// Number in the recording.
    stored_as: Option<usize>,
    /// Publishers when they were last looked at.
    publishers: usize,
    heard: Option<Instant>,
    /// Said once, then left alone.
    given_up: bool,
}

impl Subscription {
    /// A topic whose type and QoS are known: it is subscribed at once, so that the first message is not missed.
    pub(crate) fn to_known_topic(
        node: &RawNode,
        name: &str,
        type_name: &str,
        qos: &QosProfile,
    ) -> anyhow::Result<Self> {
        let mut subscription = Self::to_any_topic(name);
        subscription.type_name = Some(type_name.to_owned());
        subscription.request = Request::matching([qos]);
        subscription.subscribe(node, type_name)?;
        Ok(subscription)
    }

    /// A topic of which only the name is known: it is subscribed when a publisher appears.
    pub(crate) fn to_any_topic(name: &str) -> Self {
        Self {
            asked: name.to_owned(),
            name: name.to_owned(),
            type_name: None,
            request: Request { reliable: true, transient_local: true },
            inner: None,
            stored_as: None,
            publishers: 0,
            heard: None,
            given_up: false,
        }
    }

    /// Name in the graph.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Whether nobody publishes the topic.
    pub(crate) fn is_waiting(&self) -> bool {
        self.publishers == 0 && !self.given_up
    }

    /// Whether messages came in the last second.
    pub(crate) fn is_busy(&self, now: Instant) -> bool {
        self.heard.is_some_and(|heard| now.saturating_duration_since(heard) < SILENT)
    }

    /// Looks who publishes the topic when that has changed: subscribes, or asks for less when a publisher offers less.
    pub(crate) fn look(
        &mut self,
        kit: &mut NodeKit,
        node: &RawNode,
        storage: &mut Storage,
    ) -> anyhow::Result<()> {
        if self.given_up || node.publishers_of(&self.name) == self.publishers {
            return Ok(());
        }
        let publishers = kit.node().get_publishers_info_by_topic(&self.name, false)?;
        self.publishers = publishers.len();
        let Some(first) = publishers.first() else { return Ok(()) };
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
        let request = if self.inner.is_some() { self.request.and(request) } else { request };
        if self.inner.is_none() || request != self.request {
            // What waits in the old subscription would go with it.
            let mut batch = Batch::default();
            self.drain(kit, storage, &mut batch, usize::MAX)?;
            storage.store(batch);
            self.request = request;
            if let Err(error) = self.subscribe(node, &type_name) {
                self.given_up = true;
                kit.log().error(&format!("{} is not recorded: {error:#}", self.name));
                return Ok(());
            }
        }
        self.announce(storage, &offers);
        Ok(())
    }

    /// Hands the messages that wait to `batch`, until it has `most_bytes`.
    ///
    /// # Errors
    /// The middleware cannot hand out a message.
    pub(crate) fn drain(
        &mut self,
        kit: &mut NodeKit,
        storage: &mut Storage,
        batch: &mut Batch,
        most_bytes: usize,
    ) -> anyhow::Result<()> {
        if self.stored_as.is_none() && self.inner.is_some() {
            // What comes before the next look at the graph finds its topic in the recording.
            return self.drain_first(kit, storage, batch, most_bytes);
        }
        let (Some(inner), Some(stored_as)) = (&mut self.inner, self.stored_as) else { return Ok(()) };
        let before = batch.len();
        while batch.bytes() < most_bytes
            && let Some(message) = inner.take()?
        {
            batch.push(stored_as, message.received_ns, message.data);
        }
        if batch.len() > before {
            self.heard = Some(Instant::now());
        }
        Ok(())
    }

    fn drain_first(
        &mut self,
        kit: &mut NodeKit,
        storage: &mut Storage,
        batch: &mut Batch,
        most_bytes: usize,
    ) -> anyhow::Result<()> {
        let Some(inner) = &mut self.inner else { return Ok(()) };
        let Some(message) = inner.take()? else { return Ok(()) };
        let (data, received_ns) = (message.data.to_vec(), message.received_ns);
        let publishers = kit.node().get_publishers_info_by_topic(&self.name, false).unwrap_or_default();
        let mut offers: Vec<_> = publishers.into_iter().map(|publisher| publisher.qos_profile).collect();
        if offers.is_empty() {
            // A message may come before the graph tells of its publisher.
            offers.push(self.request.granted());
        }
        let stored_as = self.announce(storage, &offers);
        batch.push(stored_as, received_ns, &data);
        self.heard = Some(Instant::now());
        self.drain(kit, storage, batch, most_bytes)
    }

    fn subscribe(&mut self, node: &RawNode, type_name: &str) -> anyhow::Result<()> {
        let inner = node.subscribe(&self.asked, type_name, self.request.profile())?;
        self.name = inner.name().to_owned();
        self.inner = Some(inner);
        Ok(())
    }

    /// Adds the topic to the recording with what its publishers offer.
    fn announce(&mut self, storage: &mut Storage, offers: &[QosProfile]) -> usize {
        *self.stored_as.get_or_insert_with(|| {
            let offered_qos = offers.iter().map(graph::recorded).collect();
            storage.add_topic(&self.name, self.type_name.as_deref().unwrap_or_default(), offered_qos)
        })
    }
}
