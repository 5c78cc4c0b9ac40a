//! `main` of every node: start, run, exit code.

use std::process::ExitCode;

use scene::Node;

use crate::NodeKit;

/// Start the node and run it until it ends; 0 when it was asked to (SIGINT, SIGTERM), 1 when it could not start or go
/// on, with one line on stderr that says why.
///
/// ```no_run
/// fn main() -> std::process::ExitCode {
///     node_kit::run(node_kit::Node::Deformation, |kit| {
///         kit.ready("nothing to do");
///         while kit.is_running() {
///             kit.spin_once(std::time::Duration::from_millis(50));
///         }
///         Ok(())
///     })
/// }
/// ```
pub fn run(kind: Node, node: impl FnOnce(&mut NodeKit) -> anyhow::Result<()>) -> ExitCode {
    let mut kit = match NodeKit::start(kind) {
        Ok(kit) => kit,
        Err(error) => {
            eprintln!("[ERROR] [{}]: {error}", kind.name());
            return ExitCode::FAILURE;
        }
    };
    match node(&mut kit) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            kit.log().error(&format!("{error:#}"));
            ExitCode::FAILURE
        }
    }
}
