//! Why a node does not start, and why a message was not sent.

use thiserror::Error;

use crate::security::SecurityValueError;

/// Why a node did not start. Nothing stays behind: no node in the graph, no thread.
#[derive(Debug, Error)]
pub enum StartError {
    /// A parameter file or value is not accepted.
    #[error("{0}")]
    Parameters(#[from] scene::SceneError),
    /// A parameter override has a type that no parameter of this project has.
    #[error("{source_name}: {parameter}: {found} is accepted by no parameter")]
    UnusableValue {
        /// Files, or the command line.
        source_name: String,
        /// Name of the parameter.
        parameter: String,
        /// What was found, in words.
        found: &'static str,
    },
    /// The environment asks for security in a way that would be taken for "no".
    #[error(transparent)]
    Security(#[from] SecurityValueError),
    /// rcl does not accept the command line or cannot start.
    #[error("ROS 2 does not start: {0}")]
    Context(String),
    /// rcl refuses the node.
    #[error("node {name} cannot be created: {source}")]
    Node {
        /// Default name of the node.
        name: &'static str,
        /// What rcl says.
        source: r2r::Error,
    },
    /// rcl refuses a publisher, subscription, service or client.
    #[error("{what} {name} cannot be created: {source}")]
    Endpoint {
        /// "publisher", "subscription", "service" or "client".
        what: &'static str,
        /// Name before remapping.
        name: String,
        /// What rcl says.
        source: r2r::Error,
    },
    /// Signal handlers cannot be installed.
    #[error("SIGINT and SIGTERM cannot be handled: {0}")]
    Signals(std::io::Error),
}

/// A message was not sent: the node is gone, or the middleware has no room.
#[derive(Debug, Error)]
#[error("{topic}: message not sent: {source}")]
pub struct PublishError {
    /// Name before remapping.
    pub topic: String,
    /// What rcl says.
    pub source: r2r::Error,
}
