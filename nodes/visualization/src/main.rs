//! `visualization`: what RViz and browsers show of a session.
//!
//! From the topics of device and model to markers and transforms. The drawing itself is plain data and knows nothing of
//! ROS: what is known ([`surface`], [`device_view`]), how it looks ([`drawing`], [`rhombi`], [`colour`]), what the
//! readers do not have yet ([`picture`], [`outbox`]). Around it stand the topics in ([`inputs`]), the messages out
//! ([`messages`], [`transforms`]), the pages for browsers ([`viewer`]) and the loop ([`node`]). Before all that, the way
//! by which it hears ([`node_kit::transport`]).

mod colour;
mod device_view;
mod drawing;
mod inputs;
mod markers;
mod messages;
mod node;
mod outbox;
mod picture;
mod rhombi;
mod surface;
mod transforms;
#[cfg_attr(not(feature = "viewer"), path = "viewer/absent.rs")]
mod viewer;

fn main() -> std::process::ExitCode {
    node_kit::transport::without_shared_memory("visualization");
    node_kit::run(node_kit::Node::Visualization, node::run)
}
