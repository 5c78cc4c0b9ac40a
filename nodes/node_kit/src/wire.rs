//! Publishers and subscriptions with the topic's name in every error, and without r2r's queue trap.
//!
//! The trap: between rcl and the reader r2r puts a queue of ten messages that, when full, drops the *newest* one,
//! whatever the depth of the subscription. One spin moves at most one message of each subscription into it, so a node
//! that spins once and then empties every [`Inbox`] never loses one: what waits, waits in rcl's own queue.

use futures::{FutureExt, Stream, StreamExt};
use r2r::{ServiceRequest, WrappedServiceTypeSupport, WrappedTypesupport};

use crate::services::ServiceName;
use crate::topics::Topic;
use crate::{PublishError, StartError};

/// The sending end of a topic. A clone may be moved to another thread; it stops working when the node is gone.
#[derive(Clone)]
pub struct Publisher<M: WrappedTypesupport + 'static> {
    topic: String,
    publisher: r2r::Publisher<M>,
}

impl<M: WrappedTypesupport + 'static> Publisher<M> {
    pub(crate) fn new(
        node: &mut r2r::Node,
        topic: &Topic<M>,
        sub_namespace: &str,
    ) -> Result<Publisher<M>, StartError> {
        let name = topic.name_in(sub_namespace);
        match node.create_publisher(&name, topic.qos()) {
            Ok(publisher) => Ok(Publisher { topic: name, publisher }),
            Err(source) => Err(StartError::Endpoint { what: "publisher", name, source }),
        }
    }

    /// Send one message. Allocates; not for a motor loop.
    pub fn publish(&self, message: &M) -> Result<(), PublishError> {
        self.publisher.publish(message).map_err(|source| PublishError { topic: self.topic.clone(), source })
    }

    pub(crate) fn into_inner(self) -> r2r::Publisher<M> {
        self.publisher
    }

    /// Number of subscriptions in other processes that this publisher has found.
    pub fn readers(&self) -> usize {
        self.publisher.get_inter_process_subscription_count().unwrap_or(0)
    }
}

/// The receiving end of a topic or service. Empty it after every spin.
pub struct Inbox<M> {
    stream: Box<dyn Stream<Item = M> + Send + Unpin>,
}

impl<M: 'static> Inbox<M> {
    pub(crate) fn new(stream: impl Stream<Item = M> + Send + Unpin + 'static) -> Inbox<M> {
        Inbox { stream: Box::new(stream) }
    }

    /// The oldest message that waits, if any. Never blocks.
    pub fn take(&mut self) -> Option<M> {
        self.stream.next().now_or_never().flatten()
    }

    /// The newest message that waits, if any; older ones are dropped. For what is only interesting while fresh.
    pub fn newest(&mut self) -> Option<M> {
        let mut newest = None;
        while let Some(message) = self.take() {
            newest = Some(message);
        }
        newest
    }
}

/// The answering end of a service. Empty it after every spin.
pub struct Service<S: WrappedServiceTypeSupport + 'static> {
    calls: Inbox<ServiceRequest<S>>,
}

impl<S: WrappedServiceTypeSupport + 'static> Service<S> {
    pub(crate) fn new(node: &mut r2r::Node, service: &ServiceName<S>) -> Result<Service<S>, StartError> {
        match node.create_service::<S>(service.name(), service.qos()) {
            Ok(calls) => Ok(Service { calls: Inbox::new(calls) }),
            Err(source) => {
                Err(StartError::Endpoint { what: "service", name: service.name().to_owned(), source })
            }
        }
    }

    /// The oldest call that waits, if any. Never blocks.
    pub fn take(&mut self) -> Option<Call<S>> {
        self.calls.take().map(|request| Call { request })
    }
}

/// One call of a service, to be answered once.
pub struct Call<S: WrappedServiceTypeSupport> {
    request: ServiceRequest<S>,
}

impl<S: WrappedServiceTypeSupport + 'static> Call<S> {
    /// What is asked for.
    pub fn request(&self) -> &S::Request {
        &self.request.message
    }

    /// Answer; a caller that has gone meanwhile needs none.
    pub fn answer(self, response: S::Response) {
        let _ = self.request.respond(response);
    }
}
