//! The standard parameter services and `/parameter_events`, served by hand: r2r's own handler knows no arrays, no
//! ranges and no read-only parameters.

use r2r::WrappedServiceTypeSupport;
use r2r::rcl_interfaces::msg::{
    FloatingPointRange, IntegerRange, ListParametersResult, Parameter, ParameterDescriptor, ParameterEvent,
    SetParametersResult,
};
use r2r::rcl_interfaces::srv::{
    DescribeParameters, GetParameterTypes, GetParameters, ListParameters, SetParameters,
    SetParametersAtomically,
};
use scene::{Kind, ParameterSpec, Value};

use super::store::{Change, Store};
use super::values::{from_message, to_message, type_number};
use crate::services::ServiceName;
use crate::{Publisher, Service, StartError, topics};

/// The service ends of one node.
pub(crate) struct ParameterServices {
    list: Service<ListParameters::Service>,
    get: Service<GetParameters::Service>,
    types: Service<GetParameterTypes::Service>,
    describe: Service<DescribeParameters::Service>,
    set: Service<SetParameters::Service>,
    set_together: Service<SetParametersAtomically::Service>,
    events: Publisher<ParameterEvent>,
}

fn service<S>(node: &mut r2r::Node, name: &'static str) -> Result<Service<S>, StartError>
where
    S: WrappedServiceTypeSupport + 'static,
{
    Service::new(node, &ServiceName::of_parameters(name))
}

impl ParameterServices {
    pub(crate) fn new(node: &mut r2r::Node) -> Result<ParameterServices, StartError> {
        Ok(ParameterServices {
            list: service(node, "~/list_parameters")?,
            get: service(node, "~/get_parameters")?,
            types: service(node, "~/get_parameter_types")?,
            describe: service(node, "~/describe_parameters")?,
            set: service(node, "~/set_parameters")?,
            set_together: service(node, "~/set_parameters_atomically")?,
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
        while let Some(call) = self.list.take() {
            let (names, prefixes) = store.list(&call.request().prefixes, call.request().depth);
            call.answer(ListParameters::Response { result: ListParametersResult { names, prefixes } });
        }
        while let Some(call) = self.get.take() {
            let values = call.request().names.iter().map(|name| to_message(store.get(name))).collect();
            call.answer(GetParameters::Response { values });
        }
        while let Some(call) = self.types.take() {
            let types = call.request().names.iter().map(|name| to_message(store.get(name)).type_).collect();
            call.answer(GetParameterTypes::Response { types });
        }
        while let Some(call) = self.describe.take() {
            let names = &call.request().names;
            let descriptors = names.iter().map(|name| descriptor(name, store.describe(name))).collect();
            call.answer(DescribeParameters::Response { descriptors });
        }
        let mut changes = Vec::new();
        while let Some(call) = self.set.take() {
            let results = call
                .request()
                .parameters
                .iter()
                .map(|p| result(set(store, std::slice::from_ref(p)), &mut changes));
            let results = results.collect();
            call.answer(SetParameters::Response { results });
        }
        while let Some(call) = self.set_together.take() {
            let result = result(set(store, &call.request().parameters), &mut changes);
            call.answer(SetParametersAtomically::Response { result });
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
