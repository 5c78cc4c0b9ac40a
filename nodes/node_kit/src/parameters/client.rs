//! The parameters of another node, as the standard services show them: described, read, set.
//!
//! Nothing here waits. A question gives a [`Pending`] that is looked at once a turn; the answer comes in with a spin.

use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};
use std::time::{Duration, Instant};

use r2r::rcl_interfaces::msg::{Parameter, ParameterDescriptor, ParameterEvent};
use r2r::rcl_interfaces::srv::{DescribeParameters, GetParameters, ListParameters, SetParametersAtomically};
use r2r::{QosProfile, WrappedServiceTypeSupport};
use scene::Value;
use thiserror::Error;

use super::values::{from_message, to_message};
use crate::{Inbox, NodeKit, StartError, topics};

/// A node that has not answered within this time is taken for gone.
const PATIENCE: Duration = Duration::from_secs(2);

/// A parameter of another node: its descriptor and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct RemoteParameter {
    /// Full dotted name.
    pub name: String,
    /// The present value.
    pub value: Value,
    /// May not be set while the node runs.
    pub read_only: bool,
    /// What it means.
    pub description: String,
    /// What else is accepted, in words.
    pub constraints: String,
    /// Least and largest number, both accepted; none when the node gives no range.
    pub range: Option<(f64, f64)>,
}

/// Why another node's parameters could not be read or set.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RemoteError {
    /// It is gone, or hangs.
    #[error("{node} has not answered within {} s", PATIENCE.as_secs())]
    Silent {
        /// Full name of the node.
        node: String,
    },
    /// It does not accept the value; its own reason.
    #[error("{0}")]
    Refused(String),
    /// rcl does not send the question.
    #[error("{node} cannot be asked: {reason}")]
    NotSent {
        /// Full name of the node.
        node: String,
        /// What rcl says.
        reason: String,
    },
}

/// An answer that is under way.
pub struct Pending<T> {
    answer: Pin<Box<dyn Future<Output = Result<T, RemoteError>>>>,
    node: String,
    since: Instant,
}

impl<T> Pending<T> {
    fn new(node: &str, answer: impl Future<Output = Result<T, RemoteError>> + 'static) -> Pending<T> {
        Pending { answer: Box::pin(answer), node: node.to_owned(), since: Instant::now() }
    }

    /// The answer, once it is there or its time is over; not to be called again after that.
    pub fn poll(&mut self) -> Option<Result<T, RemoteError>> {
        // Looked at once a turn, so nobody needs to be woken.
        match self.answer.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(answer) => Some(answer),
            Poll::Pending if self.since.elapsed() < PATIENCE => None,
            Poll::Pending => Some(Err(RemoteError::Silent { node: self.node.clone() })),
        }
    }
}

struct Clients {
    node: String,
    list: r2r::Client<ListParameters::Service>,
    describe: r2r::Client<DescribeParameters::Service>,
    get: r2r::Client<GetParameters::Service>,
    set: r2r::Client<SetParametersAtomically::Service>,
}

/// Asks one other node about its parameters. r2r cannot take a client back, so make one for each name and keep it.
pub struct ParameterClient {
    clients: Rc<Clients>,
}

impl ParameterClient {
    /// For the node with this full name, whether or not it is there.
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn new(kit: &mut NodeKit, node: &str) -> Result<ParameterClient, StartError> {
        let clients = Clients {
            list: client(kit, node, "list_parameters")?,
            describe: client(kit, node, "describe_parameters")?,
            get: client(kit, node, "get_parameters")?,
            set: client(kit, node, "set_parameters_atomically")?,
            node: node.to_owned(),
        };
        Ok(ParameterClient { clients: Rc::new(clients) })
    }

    /// Every parameter that the node has declared, once its services are there.
    pub fn read(&self) -> Pending<Vec<RemoteParameter>> {
        let clients = self.clients.clone();
        Pending::new(&self.clients.node, async move { clients.read().await })
    }

    /// Set one parameter.
    pub fn set(&self, name: &str, value: &Value) -> Pending<()> {
        let clients = self.clients.clone();
        let parameter = Parameter { name: name.to_owned(), value: to_message(Some(value)) };
        Pending::new(&self.clients.node, async move { clients.set(parameter).await })
    }
}

fn client<S>(kit: &mut NodeKit, node: &str, service: &str) -> Result<r2r::Client<S>, StartError>
where
    S: WrappedServiceTypeSupport + 'static,
{
    let name = format!("{node}/{service}");
    let made = kit.node().create_client::<S>(&name, QosProfile::parameters());
    made.map_err(|source| StartError::Endpoint { what: "client", name, source })
}

impl Clients {
    async fn read(&self) -> Result<Vec<RemoteParameter>, RemoteError> {
        self.available(&self.list).await?;
        self.available(&self.describe).await?;
        self.available(&self.get).await?;
        // One that is set up meanwhile is there before anybody wants to set something.
        let names = self.ask(&self.list, &ListParameters::Request::default()).await?.result.names;
        let question = DescribeParameters::Request { names: names.clone() };
        let descriptors = self.ask(&self.describe, &question).await?.descriptors;
        let values = self.ask(&self.get, &GetParameters::Request { names }).await?.values;
        // A node that answers with fewer entries than asked for has those only; a type of its own is not shown.
        let values = values.iter().map(from_message);
        Ok(descriptors.into_iter().zip(values).filter_map(|(d, value)| remote(d, value.ok()?)).collect())
    }

    async fn set(&self, parameter: Parameter) -> Result<(), RemoteError> {
        self.available(&self.set).await?;
        let question = SetParametersAtomically::Request { parameters: vec![parameter] };
        let result = self.ask(&self.set, &question).await?.result;
        if result.successful { Ok(()) } else { Err(RemoteError::Refused(result.reason)) }
    }

    async fn available<S>(&self, client: &r2r::Client<S>) -> Result<(), RemoteError>
    where
        S: WrappedServiceTypeSupport + 'static,
    {
        let available = r2r::Node::is_available(client).map_err(|error| self.not_sent(&error))?;
        available.await.map_err(|error| self.not_sent(&error))
    }

    async fn ask<S>(&self, client: &r2r::Client<S>, question: &S::Request) -> Result<S::Response, RemoteError>
    where
        S: WrappedServiceTypeSupport + 'static,
    {
        let answer = client.request(question).map_err(|error| self.not_sent(&error))?;
        answer.await.map_err(|error| self.not_sent(&error))
    }

    fn not_sent(&self, error: &r2r::Error) -> RemoteError {
        RemoteError::NotSent { node: self.node.clone(), reason: error.to_string() }
    }
}

/// None for a name that the node does not know any more.
fn remote(descriptor: ParameterDescriptor, value: Value) -> Option<RemoteParameter> {
    let range = match (descriptor.floating_point_range.first(), descriptor.integer_range.first()) {
        (Some(range), _) => Some((range.from_value, range.to_value)),
        (None, Some(range)) => Some((range.from_value as f64, range.to_value as f64)),
        (None, None) => None,
    };
    (!descriptor.name.is_empty()).then_some(RemoteParameter {
        name: descriptor.name,
        value,
        read_only: descriptor.read_only,
        description: descriptor.description,
        constraints: descriptor.additional_constraints,
        range,
    })
}

/// What a node says of its parameters on `/parameter_events`.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterNews {
    /// Full name of the node.
    pub node: String,
    /// It has declared parameters: it has just started.
    pub declared: bool,
    /// Parameters that have new values.
    pub changed: Vec<(String, Value)>,
}

/// Hears when any node's parameters change.
pub struct ParameterListener {
    events: Inbox<ParameterEvent>,
}

impl ParameterListener {
    /// Subscribe.
    ///
    /// # Errors
    /// rcl refuses.
    pub fn new(kit: &mut NodeKit) -> Result<ParameterListener, StartError> {
        Ok(ParameterListener { events: kit.subscribe(&topics::PARAMETER_EVENTS, "")? })
    }

    /// The oldest news that wait, if any.
    pub fn take(&mut self) -> Option<ParameterNews> {
        let event = self.events.take()?;
        let changed = event
            .changed_parameters
            .iter()
            .filter_map(|parameter| Some((parameter.name.clone(), from_message(&parameter.value).ok()?)));
        Some(ParameterNews {
            changed: changed.collect(),
            declared: !event.new_parameters.is_empty(),
            node: event.node,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_is_given_once_it_is_there_and_a_silent_node_is_named() {
        let mut there = Pending::new("/model", async { Ok(3) });
        assert_eq!(there.poll(), Some(Ok(3)));
        let mut silent: Pending<()> = Pending::new("/model", std::future::pending());
        assert_eq!(silent.poll(), None);
        silent.since = Instant::now().checked_sub(PATIENCE).unwrap();
        let Some(Err(error)) = silent.poll() else { panic!("no error") };
        assert_eq!(error.to_string(), "/model has not answered within 2 s");
    }
}
