//! The node's parameters: read from rcl, checked by the scene's schema, served to the graph; those of other nodes.

mod client;
mod services;
mod store;
mod values;

use scene::{Node, Origin, Parameters, Reader, Value};

use crate::StartError;
use crate::arguments::RosArguments;

pub use client::{ParameterClient, ParameterListener, ParameterNews, Pending, RemoteError, RemoteParameter};
pub(crate) use services::ParameterServices;
pub(crate) use store::Store;
pub use store::{Change, TogetherCheck};

/// Check every parameter file before rcl reads it: rcl's own message for a bad file names no key, and r2r panics
/// with it.
pub(crate) fn check_files(arguments: &RosArguments, node: Node) -> Result<(), StartError> {
    let name = arguments.full_name(node.name());
    for file in &arguments.parameter_files {
        Parameters::from_file(file, Reader::Node(&name))?;
    }
    Ok(())
}

/// What rcl made of files and command line for this node, checked.
pub(crate) fn read(node: &r2r::Node, arguments: &RosArguments) -> Result<Parameters, StartError> {
    let source_name = arguments.source();
    let overrides = node.params.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let values: Result<Vec<(String, Value)>, StartError> = overrides
        .iter()
        .map(|(name, parameter)| match values::from_override(&parameter.value) {
            Ok(value) => Ok((name.clone(), value)),
            Err(found) => Err(StartError::UnusableValue {
                source_name: source_name.clone(),
                parameter: name.clone(),
                found,
            }),
        })
        .collect();
    Ok(Parameters::from_values(values?, Origin::node(source_name, std::env::args()))?)
}
