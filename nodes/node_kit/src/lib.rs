//! What every node shares and nothing else: start and shutdown, parameters, log, diagnostics, topics, frames.
//!
//! The only library that touches r2r, so that its traps are known in one place:
//! queues of ten that keep the oldest ([`Inbox`]), no parameter arrays or ranges (`parameters`), no `/rosout`
//! ([`Log`]), no signal handling ([`Shutdown`]), a panic for a bad command line (`context`), fixed-size arrays that
//! panic when published ([`convert`]), a time source that may be missing (`clock`).

mod arguments;
mod clock;
mod context;
pub mod convert;
mod diagnostics;
mod error;
mod graph;
mod histogram;
mod kit;
mod log;
mod parameters;
mod run;
mod security;
pub mod services;
mod shutdown;
mod tf;
pub mod topics;
pub mod transport;
mod wire;

pub use diagnostics::{Level, Status};
pub use error::{PublishError, StartError};
pub use graph::RemotePublisher;
pub use histogram::Histogram;
pub use kit::NodeKit;
pub use log::{Log, Throttle};
pub use parameters::{
    Change, ParameterClient, ParameterListener, ParameterNews, Pending, RemoteError, RemoteParameter,
    TogetherCheck,
};
pub use run::run;
pub use scene::Node;
pub use security::SecurityValueError;
pub use shutdown::{ForcedExit, Shutdown, before_forced_exit};
pub use tf::{TransformListener, transform_stamped};
pub use wire::{Call, Inbox, Publisher, Service};
