//! rcl's context. r2r panics when rcl does not accept the command line; here that is an error like any other.

use std::panic;

use crate::StartError;

/// Start rcl with the command line of this process.
pub(crate) fn create() -> Result<r2r::Context, StartError> {
    let report = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let created = panic::catch_unwind(r2r::Context::create);
    panic::set_hook(report);
    match created {
        Ok(Ok(context)) => Ok(context),
        Ok(Err(error)) => Err(StartError::Context(error.to_string())),
        Err(reason) => {
            let text = reason.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| reason.downcast_ref::<&str>().copied());
            Err(StartError::Context(text.unwrap_or("r2r panicked").to_owned()))
        }
    }
}
