//! `KEY=VALUE` on a command line, in place of what the parameter file says.

use crate::{Origin, Parameters, Problem, Reader, SceneError};

impl Parameters {
    /// These values with `assignments` in place of the file's, each `KEY=VALUE` with a value as it would stand in the
    /// file. Relative mesh paths stay relative to the file.
    ///
    /// # Errors
    /// An assignment without `=`, or one that the file could not say either.
    pub fn with_assignments(mut self, assignments: &[String]) -> Result<Parameters, SceneError> {
        for assignment in assignments {
            let origin = || Origin::named(format!("--set {assignment}"));
            let Some((key, value)) = assignment.split_once('=') else {
                let message = "accepted: KEY=VALUE, like body.mesh=block".to_owned();
                return Err(origin().error(None, None, Problem::Syntax(message)));
            };
            let text = format!("/**:\n  ros__parameters:\n    {key}: {value}\n");
            let given = Parameters::from_text(&text, origin(), Reader::Everything)?;
            self.take_given(given);
        }
        Ok(self)
    }
}
