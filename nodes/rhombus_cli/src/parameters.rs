//! `rhombus parameters`: the schema table for people.

use clap::Args;
use scene::{DefaultValue, ParameterSpec, schema};
use serde::Serialize;

use crate::output;

/// Every parameter of every node: type, unit, default, range, meaning
#[derive(Args)]
pub(crate) struct Parameters {
    /// As the Markdown table of the README
    #[arg(long)]
    markdown: bool,
    /// Print JSON
    #[arg(long, conflicts_with = "markdown")]
    json: bool,
}

/// One row; field names and their order are the JSON.
#[derive(Serialize)]
struct Row {
    name: &'static str,
    kind: &'static str,
    unit: &'static str,
    default: String,
    accepted: String,
    live: bool,
    nodes: Vec<&'static str>,
    help: &'static str,
}

impl Parameters {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        if self.json {
            return output::json(&schema().map(row).collect::<Vec<_>>());
        }
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

fn row(spec: &ParameterSpec) -> Row {
    Row {
        name: spec.name,
        kind: spec.kind.in_words(),
        unit: spec.unit,
        default: default_in_words(spec),
        accepted: spec.range(),
        live: spec.live,
        nodes: spec.owners.iter().map(|node| node.name()).collect(),
        help: spec.help,
    }
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
