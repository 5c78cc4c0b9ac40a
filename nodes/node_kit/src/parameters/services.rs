//! The standard parameter services and `/parameter_events`, served by hand: r2r's own handler knows no arrays, no
//! ranges and no read-only parameters.

use r2r::rcl_interfaces::msg::{
    FloatingPointRange, IntegerRange, ListParametersResult, Parameter, ParameterDescriptor, ParameterEvent,
    SetParametersResult,
};
use r2r::rcl_interfaces::srv::{
    DescribeParameters, GetParameterTypes, GetParameters, ListParameters, SetParameters,
    SetParametersAtomically,
};
use r2r::{QosProfile, ServiceRequest, WrappedServiceTypeSupport};
use scene::{Kind, ParameterSpec, Value};

use super::store::{Change, Store};
use super::values::{from_message, to_message, type_number};
use crate::{Inbox, Publisher, StartError, topics};

/// The service ends of one node.
pub(crate) struct ParameterServices {
    list: Requests<ListParameters::Service>,
    get: Requests<GetParameters::Service>,
    types: Requests<GetParameterTypes::Service>,
    describe: Requests<DescribeParameters::Service>,
    set: Requests<SetParameters::Service>,
    set_together: Requests<SetParametersAtomically::Service>,
    events: Publisher<ParameterEvent>,
}

type Requests<S> = Inbox<ServiceRequest<S>>;

fn requests<S>(node: &mut r2r::Node, name: &str) -> Result<Requests<S>, StartError>
where
    S: WrappedServiceTypeSupport + 'static,
{
    let name = format!("~/{name}");
    match node.create_service::<S>(&name, QosProfile::parameters()) {
        Ok(requests) => Ok(Inbox::new(requests)),
        Err(source) => Err(StartError::Endpoint { what: "service", name, source }),
    }
}

/// Answer; a caller that has gone meanwhile needs none.
fn answer<S: WrappedServiceTypeSupport + 'static>(request: ServiceRequest<S>, response: S::Response) {
    let _ = request.respond(response);
}

impl ParameterServices {
    pub(crate) fn new(node: &mut r2r::Node) -> Result<ParameterServices, StartError> {
        Ok(ParameterServices {
            list: requests(node, "list_parameters")?,
            get: requests(node, "get_parameters")?,
            types: requests(node, "get_parameter_types")?,
            describe: requests(node, "describe_parameters")?,
            set: requests(node, "set_parameters")?,
            set_together: requests(node, "set_parameters_atomically")?,
            events: Publisher::new(node, &topics::PARAMETER_EVENTS, "")?,
        })
    }

    /// Tell the graph which parameters there are.
    pub(crate) fn announce(&self, stamp: r2r::builtin_interfaces::msg::Time, node: &str, store: &Store) {
        let new_parameters = store.declared().map(|(spec, value)| parameter(spec.name, value)).collect();
        let event =
            ParameterEvent { stamp, node: node.to_owned(), new_parameters, ..ParameterEvent::default() };
        // Listeners of events come and go; the services are the truth.
        let _ = self.events.publish(&event);
    }

    /// Tell the graph which parameters have changed.
    pub(crate) fn tell(&self, stamp: r2r::builtin_interfaces::msg::Time, node: &str, changes: &[Change]) {
        let changed_parameters = changes.iter().map(|change| parameter(change.name, &change.value)).collect();
        let event =
            ParameterEvent { stamp, node: node.to_owned(), changed_parameters, ..ParameterEvent::default() };
        let _ = self.events.publish(&event);
    }

    /// Answer what arrived since the last turn; what was changed by it.
    pub(crate) fn serve(&mut self, store: &mut Store) -> Vec<Change> {
        while let Some(request) = self.list.take() {
            let (names, prefixes) = store.list(&request.message.prefixes, request.message.depth);
            answer(request, ListParameters::Response { result: ListParametersResult { names, prefixes } });
        }
        while let Some(request) = self.get.take() {
            let values = request.message.names.iter().map(|name| to_message(store.get(name))).collect();
            answer(request, GetParameters::Response { values });
        }
        while let Some(request) = self.types.take() {
            let types = request.message.names.iter().map(|name| to_message(store.get(name)).type_).collect();
            answer(request, GetParameterTypes::Response { types });
        }
        while let Some(request) = self.describe.take() {
            let names = &request.message.names;
            let descriptors = names.iter().map(|name| descriptor(name, store.describe(name))).collect();
            answer(request, DescribeParameters::Response { descriptors });
        }
        let mut changes = Vec::new();
        while let Some(request) = self.set.take() {
            let results = request
                .message
                .parameters
                .iter()
                .map(|p| result(set(store, std::slice::from_ref(p)), &mut changes));
            let results = results.collect();
            answer(request, SetParameters::Response { results });
        }
        while let Some(request) = self.set_together.take() {
            let result = result(set(store, &request.message.parameters), &mut changes);
            answer(request, SetParametersAtomically::Response { result });
        }
        changes
    }
}

fn parameter(name: &str, value: &Value) -> Parameter {
    Parameter { name: name.to_owned(), value: to_message(Some(value)) }
}

fn set(store: &mut Store, parameters: &[Parameter]) -> Result<Vec<Change>, String> {
    let requested: Result<Vec<_>, String> = parameters
        .iter()
        .map(|parameter| match from_message(&parameter.value) {
            Ok(value) => Ok((parameter.name.clone(), value)),
            Err(found) => Err(format!("{}: {found}", parameter.name)),
        })
        .collect();
    store.set(requested?)
}

fn result(outcome: Result<Vec<Change>, String>, changes: &mut Vec<Change>) -> SetParametersResult {
    match outcome {
        Ok(new) => {
            changes.extend(new);
            SetParametersResult { successful: true, reason: String::new() }
        }
        Err(reason) => SetParametersResult { successful: false, reason },
    }
}

/// What `ros2 param describe` and rqt show; a name that the node does not have is described as "not set".
fn descriptor(name: &str, spec: Option<&ParameterSpec>) -> ParameterDescriptor {
    let Some(spec) = spec else {
        return ParameterDescriptor { name: name.to_owned(), ..ParameterDescriptor::default() };
    };
    let unit = if spec.unit.is_empty() { String::new() } else { format!(" [{}]", spec.unit) };
    let bounds = spec.check.bounds();
    let floating_point_range = match (spec.kind, bounds) {
        (Kind::Double | Kind::DoubleArray, Some((from_value, to_value))) => {
            vec![FloatingPointRange { from_value, to_value, step: 0.0 }]
        }
        _ => vec![],
    };
    let integer_range = match (spec.kind, bounds) {
        // The casts saturate: a bound beyond i64 is no bound.
        (Kind::Integer | Kind::IntegerArray, Some((from, to))) => {
            vec![IntegerRange { from_value: from.ceil() as i64, to_value: to.floor() as i64, step: 1 }]
        }
        _ => vec![],
    };
    ParameterDescriptor {
        name: spec.name.to_owned(),
        type_: type_number(spec.kind),
        description: format!("{}{unit}", spec.help),
        additional_constraints: spec.accepted(),
        read_only: !spec.live,
        dynamic_typing: false,
        floating_point_range,
        integer_range,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_descriptor_carries_unit_range_and_whether_it_may_change() {
        let rate = descriptor("surface.rate", scene::schema::spec("surface.rate"));
        assert!(rate.description.ends_with("[Hz]"), "{}", rate.description);
        assert_eq!(
            (rate.floating_point_range[0].from_value, rate.floating_point_range[0].to_value),
            (0.0, 1000.0)
        );
        assert!(!rate.read_only && rate.integer_range.is_empty());
        let units = descriptor("chains.units", scene::schema::spec("chains.units"));
        assert!(units.read_only && units.floating_point_range.is_empty());
        assert_eq!(units.integer_range[0].from_value, 1);
        assert_eq!(descriptor("nonsense", None).type_, 0);
    }
}
