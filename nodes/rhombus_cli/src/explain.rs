//! `rhombus explain`
use std::path::PathBuf;

use clap::{Args, ValueHint};

/// What a scene builds and what it leaves out
#[derive(Args)]
pub(crate) struct Explain {
    /// ROS 2 parameter file
    #[arg(value_name = "PARAMS.yaml", value_hint = ValueHint::FilePath)]
    parameters: PathBuf,
}

impl Explain {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        let _ = self.parameters;
        Ok(())
    }
}
