//! The last line: whatever a decoder does with a broken file, the exit codes of `rhombus bag` stay what they are.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use recording::check::{Report, check};

/// The report on a recording; a panic of a library is one that nothing can be read, with its reason.
pub(super) fn checked(path: &Path) -> Report {
    // Nothing of a check outlives its panic.
    catch_unwind(AssertUnwindSafe(|| check(path)))
        .unwrap_or_else(|panic| Report::unreadable(path, &reason(panic.as_ref())))
}

/// What a panic said.
pub(super) fn reason(panic: &(dyn std::any::Any + Send)) -> String {
    let said = panic.downcast_ref::<String>().map(String::as_str);
    let said = said.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a word");
    format!("reading it stopped: {said}; please report this with the file")
}
