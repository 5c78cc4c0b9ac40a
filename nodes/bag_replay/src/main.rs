//! The node `bag_replay`: writes the session's topics into a recording, or plays one.

mod batch;
mod graph;
mod names;
mod play;
mod rcl;
mod record;
mod session;
mod settings;
mod storage;
mod subscription;

use std::process::ExitCode;

use settings::Settings;

fn main() -> ExitCode {
    // A recorder that is stopped must cost nobody anything.
    node_kit::transport::without_shared_memory("bag_replay");
    node_kit::run(node_kit::Node::BagReplay, |kit| match settings::read(kit)? {
        Settings::Record(settings) => record::run(kit, &settings),
        Settings::Play(settings) => play::run(kit, &settings),
    })
}
