//! Where parameter values come from: for messages, and for paths that are relative to a file.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::{Problem, SceneError, yaml};

/// The source of a set of parameter values.
#[derive(Clone, Debug)]
pub struct Origin {
    name: String,
    text: Option<Arc<str>>,
    directories: Vec<PathBuf>,
}

impl Origin {
    /// Values without a file; `name` stands where a message would say the file ("parameters of /left/deformation").
    /// Relative paths are then relative to the working directory.
    pub fn named(name: impl Into<String>) -> Origin {
        Origin { name: name.into(), text: None, directories: Vec::new() }
    }

    /// The values a node got from rcl: relative mesh paths are looked for beside the `--params-file` files among
    /// the process arguments, last first, as the last one wins in rcl too.
    pub fn node(name: impl Into<String>, arguments: impl IntoIterator<Item = String>) -> Origin {
        let mut directories = Vec::new();
        let mut arguments = arguments.into_iter();
        while let Some(argument) = arguments.next() {
            if argument == "--params-file"
                && let Some(file) = arguments.next()
            {
                directories.insert(0, directory_of(Path::new(&file)));
            }
        }
        Origin { name: name.into(), text: None, directories }
    }

    pub(crate) fn file(path: &Path, text: &str) -> Origin {
        Origin {
            name: path.display().to_string(),
            text: Some(Arc::from(text)),
            directories: vec![directory_of(path)],
        }
    }

    /// What messages call this source.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Folders that a relative path may be relative to, first match wins; empty means the working directory.
    pub(crate) fn directories(&self) -> &[PathBuf] {
        &self.directories
    }

    /// Line of the `node`-th YAML node of the file.
    pub(crate) fn line(&self, node: Option<usize>) -> Option<usize> {
        yaml::line_of_node(self.text.as_deref()?, node?)
    }

    /// Whether the `node`-th YAML node is a text in quotes; true where there is no text to look at.
    pub(crate) fn is_quoted(&self, node: usize) -> bool {
        self.text.as_deref().is_none_or(|text| yaml::is_quoted(text, node))
    }

    pub(crate) fn error(&self, key: Option<&str>, node: Option<usize>, problem: Problem) -> SceneError {
        SceneError {
            file: self.name.clone(),
            line: self.line(node),
            key: key.map(str::to_owned),
            problem: Box::new(problem),
        }
    }
}

/// Empty for a file in the working directory, so that paths in messages stay as they were written.
fn directory_of(file: &Path) -> PathBuf {
    file.parent().map(Path::to_owned).unwrap_or_default()
}
