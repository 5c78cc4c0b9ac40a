//! How far a report is: a bar where stderr is a terminal, otherwise one line for each step.

use indicatif::ProgressBar;
use rhombus_cli::progress_bar;

/// Says on stderr what is being computed.
pub(crate) struct Progress {
    bar: Option<ProgressBar>,
}

impl Progress {
    /// A bar over `sections` on a terminal, lines elsewhere.
    pub(crate) fn new(sections: usize) -> Self {
        Self { bar: progress_bar::on_terminal(Some(sections as u64)) }
    }

    /// A section begins.
    pub(crate) fn section(&self, name: &str) {
        match &self.bar {
            Some(bar) => {
                bar.set_prefix(name.to_owned());
                bar.set_message("");
            }
            None => eprintln!("rhombus report: {name}"),
        }
    }

    /// A step of the section begins: a few words.
    pub(crate) fn step(&self, what: &str) {
        match &self.bar {
            Some(bar) => bar.set_message(what.to_owned()),
            None => eprintln!("rhombus report:   {what}"),
        }
    }

    /// A section is done.
    pub(crate) fn done(&self) {
        if let Some(bar) = &self.bar {
            bar.inc(1);
        }
    }

    /// A line that stays, above the bar.
    pub(crate) fn say(&self, line: &str) {
        match &self.bar {
            Some(bar) => bar.println(format!("rhombus report: {line}")),
            None => eprintln!("rhombus report: {line}"),
        }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
