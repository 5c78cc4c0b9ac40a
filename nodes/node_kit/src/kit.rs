//! One ROS node with everything that all nodes share.

use std::time::Duration;

use r2r::builtin_interfaces::msg::Time;
use r2r::rosgraph_msgs::msg::Clock;
use r2r::{QosProfile, WrappedServiceTypeSupport, WrappedTypesupport};
use scene::{Node, Parameters, Value};

use crate::arguments::RosArguments;
use crate::clock::NodeClock;
use crate::diagnostics::{Diagnostics, Status};
use crate::graph::RemotePublisher;
use crate::log::Log;
use crate::parameters::{self, Change, ParameterServices, Store, TogetherCheck};
use crate::security::Transport;
use crate::services::ServiceName;
use crate::topics::Topic;
use crate::{Inbox, PublishError, Publisher, Service, Shutdown, StartError, context, shutdown, topics};

/// Longest wait of one turn. A spin cannot be interrupted, so this bounds how late a signal is seen.
const LONGEST_WAIT: Duration = Duration::from_millis(50);

/// A node that has started: named, its parameters checked and served, its log and diagnostics published.
///
/// One thread owns it and calls [`NodeKit::spin_once`] in a loop. r2r has no executor: a spin moves at most one message
/// of each subscription into that subscription's [`Inbox`], and an inbox holds ten messages and then drops the
/// *newest*. So: spin once, empty every inbox, answer, repeat.
pub struct NodeKit {
    // Before `node`: publishers must not outlive it in use.
    services: ParameterServices,
    diagnostics: Diagnostics,
    log: Log,
    store: Store,
    shutdown: Shutdown,
    clock: NodeClock,
    simulated_time: Option<Inbox<Clock>>,
    arguments: RosArguments,
    full_name: String,
    namespace: String,
    node: r2r::Node,
}

impl NodeKit {
    /// Start the node: check the parameters, join the graph, serve the parameters.
    ///
    /// # Errors
    /// The one reason why it cannot start, with file and key where a parameter is to blame. Nothing stays behind.
    pub fn start(kind: Node) -> Result<NodeKit, StartError> {
        let transport = Transport::from_environment()?;
        let arguments = RosArguments::from_process();
        parameters::check_files(&arguments, kind)?;
        let shutdown = Shutdown::install().map_err(StartError::Signals)?;
        let context = context::create()?;
        let mut node = r2r::Node::create(context, kind.name(), "")
            .map_err(|source| StartError::Node { name: kind.name(), source })?;
        shutdown::exit_on_panic();

        let values = parameters::read(&node, &arguments)?;
        let unnamed = |source| StartError::Node { name: kind.name(), source };
        let full_name = node.fully_qualified_name().map_err(unnamed)?;
        let namespace = node.namespace().map_err(unnamed)?;
        let least = arguments.severity_of(node.logger());
        let simulated = values.bool("use_sim_time")?;
        let clock = if simulated { NodeClock::simulated() } else { NodeClock::system() };
        let log = Log::new(&mut node, clock.clone(), least)?;
        let services = ParameterServices::new(&mut node)?;
        let diagnostics = Diagnostics::new(&mut node, clock.clone(), &full_name)?;
        let store = Store::new(kind, values);
        services.announce(clock.now(), &full_name, &store);
        log.info(&format!(
            "{full_name} starts with parameters from {}; {}",
            arguments.source(),
            transport.in_words()
        ));
        let mut kit = NodeKit {
            services,
            diagnostics,
            log,
            store,
            shutdown,
            clock,
            simulated_time: None,
            arguments,
            full_name,
            namespace,
            node,
        };
        if simulated {
            kit.simulated_time = Some(kit.subscribe(&topics::CLOCK, "")?);
        }
        Ok(kit)
    }

    /// "/left/deformation".
    pub fn full_name(&self) -> &str {
        &self.full_name
    }

    /// "/left"; "/" for none.
    pub fn namespace(&self) -> &str {
        &self.namespace
    }

    /// The frame a parameter names; see [`scene::frame_id`].
    pub fn frame_id(&self, parameter: &str) -> String {
        scene::frame_id(&self.namespace, parameter)
    }

    /// The same for a parameter of the device with this sub-namespace; see [`scene::frame_id_of_device`].
    pub fn frame_id_of_device(&self, device: &str, parameter: &str) -> String {
        scene::frame_id_of_device(&self.namespace, device, parameter)
    }

    /// The same for a parameter of the whole session, said by the driver of one of its `devices`, which stands in that
    /// device's sub-namespace: "/left", ["left", "right"] and "scene" give "scene", as the session's other nodes say it.
    pub fn frame_id_of_session(&self, devices: &[String], parameter: &str) -> String {
        scene::frame_id(scene::session_namespace(&self.namespace, devices), parameter)
    }

    /// The parameters' present values, checked.
    pub fn parameters(&self) -> &Parameters {
        self.store.values()
    }

    /// What else must hold for parameters that are set while the node runs, beyond each one's own range. The error is
    /// the reason that the caller of the service reads.
    pub fn check_changes(&mut self, check: TogetherCheck) {
        self.store.check_together(check);
    }

    /// Show the value that a parameter without a constant default got because nobody gave it.
    ///
    /// # Errors
    /// The schema does not accept the value.
    pub fn show_computed(&mut self, name: &str, value: Value) -> Result<(), StartError> {
        Ok(self.store.set_computed(name, value)?)
    }

    /// The node's log.
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// The time that stamps have: system time, or `/clock` with `use_sim_time`.
    pub fn now(&self) -> Time {
        self.clock.now()
    }

    /// Whether the process was asked to end; clones can be watched from other threads.
    pub fn shutdown(&self) -> &Shutdown {
        &self.shutdown
    }

    /// False from the first SIGINT or SIGTERM on.
    pub fn is_running(&self) -> bool {
        !self.shutdown.is_requested()
    }

    /// Make a publisher. `sub_namespace` is a device's name for topics of a device, else "".
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn publish<M>(&mut self, topic: &Topic<M>, sub_namespace: &str) -> Result<Publisher<M>, StartError>
    where
        M: WrappedTypesupport + 'static,
    {
        Publisher::new(&mut self.node, topic, sub_namespace)
    }

    /// Make a subscription. `sub_namespace` is a device's name for topics of a device, else "".
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn subscribe<M>(&mut self, topic: &Topic<M>, sub_namespace: &str) -> Result<Inbox<M>, StartError>
    where
        M: WrappedTypesupport + Send + 'static,
    {
        self.subscribe_with(topic, sub_namespace, topic.qos())
    }

    /// Make a subscription of which only the newest message counts: rcl keeps one, so a slow reader finds the newest
    /// and not the oldest of what waits. For viewers; never for what must all be answered.
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn subscribe_newest<M>(
        &mut self,
        topic: &Topic<M>,
        sub_namespace: &str,
    ) -> Result<Inbox<M>, StartError>
    where
        M: WrappedTypesupport + Send + 'static,
    {
        self.subscribe_with(topic, sub_namespace, topic.qos().keep_last(1))
    }

    /// [`subscribe_newest`](NodeKit::subscribe_newest) for what comes many times a second and is only looked at: best
    /// effort, so its writer owes a reader that is slow, or gone, nothing.
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn subscribe_passing<M>(
        &mut self,
        topic: &Topic<M>,
        sub_namespace: &str,
    ) -> Result<Inbox<M>, StartError>
    where
        M: WrappedTypesupport + Send + 'static,
    {
        self.subscribe_with(topic, sub_namespace, topic.qos().keep_last(1).best_effort())
    }

    /// [`subscribe`](NodeKit::subscribe) to what was said before, too, by those publishers that keep it; those that keep
    /// nothing are not heard at all.
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn subscribe_kept<M>(&mut self, topic: &Topic<M>, sub_namespace: &str) -> Result<Inbox<M>, StartError>
    where
        M: WrappedTypesupport + Send + 'static,
    {
        self.subscribe_with(topic, sub_namespace, topic.qos().transient_local())
    }

    fn subscribe_with<M>(
        &mut self,
        topic: &Topic<M>,
        sub_namespace: &str,
        qos: QosProfile,
    ) -> Result<Inbox<M>, StartError>
    where
        M: WrappedTypesupport + Send + 'static,
    {
        let name = topic.name_in(sub_namespace);
        match self.node.subscribe::<M>(&name, qos) {
            Ok(stream) => Ok(Inbox::new(stream)),
            Err(source) => Err(StartError::Endpoint { what: "subscription", name, source }),
        }
    }

    /// Offer a service.
    ///
    /// # Errors
    /// rcl refuses, for instance because the name is none.
    pub fn serve<S>(&mut self, service: &ServiceName<S>) -> Result<Service<S>, StartError>
    where
        S: WrappedServiceTypeSupport + 'static,
    {
        Service::new(&mut self.node, service)
    }

    /// Who publishes a topic, a node with two publishers twice. Asks the middleware's memory of the graph: fit for a few
    /// times a second.
    ///
    /// # Errors
    /// What rcl says.
    pub fn publishers_of<M>(
        &self,
        topic: &Topic<M>,
        sub_namespace: &str,
    ) -> Result<Vec<RemotePublisher>, r2r::Error> {
        let name = self.arguments.topic_in_graph(&topic.name_in(sub_namespace), &self.full_name);
        let publishers = self.node.get_publishers_info_by_topic(&name, false)?;
        let publishers = publishers.iter().map(|it| {
            RemotePublisher::new(&it.node_name, &it.node_namespace, &it.endpoint_gid, &it.qos_profile)
        });
        Ok(publishers.collect())
    }

    /// Whether the topic is known to the graph: some node publishes it or subscribes to it. As
    /// [`NodeKit::publishers_of`], fit for a few times a second.
    ///
    /// # Errors
    /// What rcl says.
    pub fn is_in_graph<M>(&self, topic: &Topic<M>, sub_namespace: &str) -> Result<bool, r2r::Error> {
        let name = self.arguments.topic_in_graph(&topic.name_in(sub_namespace), &self.full_name);
        Ok(self.node.get_topic_names_and_types()?.contains_key(&name))
    }

    /// Take a publisher out of the graph. Clones of it stop working.
    pub fn unpublish<M: WrappedTypesupport + 'static>(&mut self, publisher: Publisher<M>) {
        self.node.destroy_publisher(publisher.into_inner());
    }

    /// Subscribe to serialized messages (CDR) of a type given as "package/msg/Name", for recording.
    ///
    /// # Errors
    /// rcl refuses, or the type is not one of those built in.
    pub fn subscribe_raw(
        &mut self,
        name: &str,
        message_type: &str,
        qos: QosProfile,
    ) -> Result<Inbox<Vec<u8>>, StartError> {
        match self.node.subscribe_raw(name, message_type, qos) {
            Ok(stream) => Ok(Inbox::new(stream)),
            Err(source) => Err(StartError::Endpoint { what: "subscription", name: name.to_owned(), source }),
        }
    }

    /// Make a publisher for serialized messages (CDR) of a type given as "package/msg/Name", for replay.
    ///
    /// # Errors
    /// rcl refuses, or the type is not one of those built in.
    pub fn publish_raw(
        &mut self,
        name: &str,
        message_type: &str,
        qos: QosProfile,
    ) -> Result<r2r::PublisherUntyped, StartError> {
        let made = self.node.create_publisher_untyped(name, message_type, qos);
        made.map_err(|source| StartError::Endpoint { what: "publisher", name: name.to_owned(), source })
    }

    /// The r2r node, for what this type does not wrap (graph queries).
    pub fn node(&mut self) -> &mut r2r::Node {
        &mut self.node
    }

    /// One turn: wait for messages (at most `timeout`, at most 50 ms), move one of each subscription into its inbox,
    /// serve the parameters. What was set since the last turn.
    pub fn spin_once(&mut self, timeout: Duration) -> Vec<Change> {
        self.node.spin_once(timeout.min(LONGEST_WAIT));
        if let Some(time) = self.simulated_time.as_mut().and_then(Inbox::newest) {
            self.clock.set(&time.clock);
        }
        let changes = self.services.serve(&mut self.store);
        if !changes.is_empty() {
            self.services.tell(self.clock.now(), &self.full_name, &changes);
        }
        changes
    }

    /// True once a second: time for [`NodeKit::publish_diagnostics`].
    pub fn diagnostics_due(&mut self) -> bool {
        self.diagnostics.is_due()
    }

    /// Publish the node's health. Besides once a second, a node may do this whenever its state changes.
    ///
    /// # Errors
    /// The message was not sent.
    pub fn publish_diagnostics(&self, statuses: Vec<Status>) -> Result<(), PublishError> {
        self.diagnostics.publish(statuses)
    }

    /// Say that everything is set up: a line "ready: ..." that session scripts wait for, whatever the log level is.
    pub fn ready(&self, text: &str) {
        self.log.announce(&format!("ready: {text}"));
    }

    /// Say something that a person at the terminal needs, whatever the log level is.
    pub fn announce(&self, text: &str) {
        self.log.announce(text);
    }

    /// Say what the node has done: a line "closing report: {json}" that session scripts read, whatever the log level.
    pub fn closing_report(&self, report: &serde_json::Value) {
        self.log.announce(&format!("closing report: {report}"));
    }
}
