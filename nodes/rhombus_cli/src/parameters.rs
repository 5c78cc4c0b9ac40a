//! `rhombus parameters`: the schema table for people.

use clap::Args;
use scene::{DefaultValue, ParameterSpec, schema};

use crate::output;

/// Every parameter of every node: type, unit, default, range, meaning
#[derive(Args)]
pub(crate) struct Parameters {
    /// As the Markdown table of the README
    #[arg(long)]
    markdown: bool,
}

impl Parameters {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        let text = if self.markdown { markdown() } else { plain() };
        output::text(&text)
    }
}

fn default_in_words(spec: &ParameterSpec) -> String {
    match spec.default {
        DefaultValue::Required => "required".to_owned(),
        DefaultValue::Computed(how) => how.to_owned(),
        _ => spec.default.value().map(|value| value.to_string()).unwrap_or_default(),
    }
}

fn nodes(spec: &ParameterSpec) -> String {
    spec.owners.iter().map(|node| node.name()).collect::<Vec<_>>().join(", ")
}

fn markdown() -> String {
    let mut text = "| parameter | type | unit | default | accepted | set live | nodes | meaning |\n\
                    |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for spec in schema() {
        let cells = [
            format!("`{}`", spec.name),
            spec.kind.in_words().to_owned(),
            spec.unit.to_owned(),
            default_in_words(spec),
            spec.range(),
            (if spec.live { "yes" } else { "" }).to_owned(),
            nodes(spec),
            spec.help.to_owned(),
        ];
        // A bar would end the cell.
        let cells = cells.map(|cell| cell.replace('|', "\\|"));
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    text
}

fn plain() -> String {
    let mut text = String::new();
    for spec in schema() {
        text.push_str(&format!(
            "{}\n    {}\n    accepted: {}; default: {}; nodes: {}{}\n",
            spec.name,
            spec.help,
            spec.accepted(),
            default_in_words(spec),
            nodes(spec),
            if spec.live { "; may be set live" } else { "" }
        ));
    }
    text
}
