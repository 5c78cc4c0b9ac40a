//! The last line: whatever a decoder does with a broken file, the exit codes of `rhombus` stay what they are.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use anyhow::anyhow;

/// What `run` gives, which reads the file at `path`; a panic of a library is an error with its reason. Nothing that `run`
/// works on may be used after an error.
pub fn guarded<T>(path: &Path, run: impl FnOnce() -> anyhow::Result<T>) -> anyhow::Result<T> {
    catch_unwind(AssertUnwindSafe(run))
        .unwrap_or_else(|panic| Err(anyhow!("{}: {}", path.display(), reason(panic.as_ref()))))
}

/// What a panic said.
fn reason(panic: &(dyn std::any::Any + Send)) -> String {
    let said = panic.downcast_ref::<String>().map(String::as_str);
    let said = said.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a word");
    format!("reading it stopped: {said}; please report this with the file")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_that_names_the_file_and_the_reason() {
        let panics = || -> anyhow::Result<()> { panic!("index 7 of {}", 3) };
        let error = guarded(Path::new("a/b.mcap"), panics).unwrap_err().to_string();
        assert_eq!(error, "a/b.mcap: reading it stopped: index 7 of 3; please report this with the file");
        assert_eq!(guarded(Path::new("a"), || Ok(5)).unwrap(), 5);
    }
}
