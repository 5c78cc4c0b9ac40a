//! By which way those hear who only listen, a viewer or a recorder: by network sockets, not by shared memory.
//!
//! A reader that is stopped or dead keeps its queue in Fast DDS's shared memory, and once that is full every message to
//! it costs its writer three times the processor time (0.13 ms, then 0.38 ms, on two cores). Of a model that answers a
//! thousand poses a second that is more than it has: answers fall behind, and a hand loses its force because nobody
//! looks. A socket whose reader does not read costs its writer nothing.

use std::env;
use std::os::unix::process::CommandExt;
use std::process::Command;

/// The choice of transports that Fast DDS reads when it starts; other middleware does not know it.
const TRANSPORTS: &str = "FASTDDS_BUILTIN_TRANSPORTS";
/// With one of these somebody has chosen already.
const CHOSEN: [&str; 3] = [TRANSPORTS, "FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"];

/// Starts this program anew, in the same process, with that choice made, because it is one of the environment's; returns
/// when it is made, or cannot be. To be called before anything else.
pub fn without_shared_memory(node: &str) {
    if CHOSEN.iter().any(|name| env::var_os(name).is_some()) {
        return;
    }
    let Ok(program) = env::current_exe() else { return };
    let mut arguments = env::args_os();
    let mut command = Command::new(program);
    if let Some(name) = arguments.next() {
        command.arg0(name);
    }
    let error = command.args(arguments).env(TRANSPORTS, "UDPv4").exec();
    eprintln!("[WARN] [{node}]: hears through shared memory, because it cannot start anew ({error})");
}
