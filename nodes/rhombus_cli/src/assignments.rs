//! `--set KEY=VALUE`: what a command line changes of a parameter file.

use std::path::Path;

use clap::Args;
use scene::{Parameters, Reader, Scene, SceneError};

/// The repeated option.
#[derive(Args)]
pub struct Assignments {
    /// A parameter in place of the file's, with a value as it would stand in the file; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    assignments: Vec<String>,
}

impl Assignments {
    /// The scene of `file`, as changed.
    ///
    /// # Errors
    /// As for a parameter file that says the same.
    pub fn scene(&self, file: &Path) -> Result<Scene, SceneError> {
        let parameters = Parameters::from_file(file, Reader::Everything)?;
        Scene::from_parameters(parameters.with_assignments(&self.assignments)?)
    }

    /// What the drivers read that have a section of their own in `file`, as changed: full names and scenes.
    ///
    /// # Errors
    /// As for a parameter file that says the same.
    pub fn drivers(&self, file: &Path) -> Result<Vec<(String, Scene)>, SceneError> {
        let read = |name: String| {
            let parameters = Parameters::from_file(file, Reader::Node(&name))?;
            Ok((name, Scene::from_parameters(parameters.with_assignments(&self.assignments)?)?))
        };
        Parameters::drivers_in_file(file)?.into_iter().map(read).collect()
    }
}
