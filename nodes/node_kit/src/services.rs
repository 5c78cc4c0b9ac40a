//! Names and types of the services that nodes offer: the one place where they are written down.

use std::marker::PhantomData;

use r2r::QosProfile;
use r2r::crtk_msgs::srv::TriggerOperatingState;
use r2r::lifecycle_msgs::srv::{ChangeState, GetAvailableStates, GetAvailableTransitions, GetState};
use r2r::std_srvs::srv::Trigger;

/// A service: name, type and quality of service.
pub struct ServiceName<S> {
    name: &'static str,
    qos: QosProfile,
    service: PhantomData<fn() -> S>,
}

impl<S> ServiceName<S> {
    const fn new(name: &'static str) -> ServiceName<S> {
        ServiceName { name, qos: QosProfile::services_default(), service: PhantomData }
    }

    /// The services of parameters have a quality of service of their own.
    pub(crate) const fn of_parameters(name: &'static str) -> ServiceName<S> {
        ServiceName { name, qos: QosProfile::parameters(), service: PhantomData }
    }

    /// The name as nodes know it before namespaces and remappings.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    pub(crate) fn qos(&self) -> QosProfile {
        self.qos.clone()
    }
}

/// The operating state as it is now.
pub const OPERATING_STATE: ServiceName<TriggerOperatingState::Service> = ServiceName::new("operating_state");
/// The version of the CRTK interface.
pub const CRTK_VERSION: ServiceName<Trigger::Service> = ServiceName::new("crtk_version");
/// Lifecycle: take a transition.
pub const CHANGE_STATE: ServiceName<ChangeState::Service> = ServiceName::new("~/change_state");
/// Lifecycle: the state as it is now.
pub const GET_STATE: ServiceName<GetState::Service> = ServiceName::new("~/get_state");
/// Lifecycle: every state there is.
pub const GET_AVAILABLE_STATES: ServiceName<GetAvailableStates::Service> =
    ServiceName::new("~/get_available_states");
/// Lifecycle: the transitions that the state as it is now has.
pub const GET_AVAILABLE_TRANSITIONS: ServiceName<GetAvailableTransitions::Service> =
    ServiceName::new("~/get_available_transitions");
/// Lifecycle: every transition there is.
pub const GET_TRANSITION_GRAPH: ServiceName<GetAvailableTransitions::Service> =
    ServiceName::new("~/get_transition_graph");
/// Replay: send nothing until `resume` or `step`.
pub const PAUSE: ServiceName<Trigger::Service> = ServiceName::new("~/pause");
/// Replay: go on.
pub const RESUME: ServiceName<Trigger::Service> = ServiceName::new("~/resume");
/// Replay, while it pauses: send what comes next, up to and including the next pose.
pub const STEP: ServiceName<Trigger::Service> = ServiceName::new("~/step");
