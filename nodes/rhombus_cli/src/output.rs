//! Writing to stdout, where the reader may leave at any time.

use std::io::{ErrorKind, Write};

use anyhow::Context;
use serde::Serialize;

/// Prints text that ends with a newline. A reader that has closed the pipe (`rhombus ... | head`) is no error.
pub fn text(text: &str) -> anyhow::Result<()> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.context("cannot write to stdout"),
    }
}

/// Prints one JSON document; every number reads back to the same bits.
pub fn json(document: &impl Serialize) -> anyhow::Result<()> {
    let mut line = serde_json::to_string_pretty(document)?;
    line.push('\n');
    text(&line)
}

/// Bytes for people: 512 B, 1.5 kB, 20.3 MB.
pub fn bytes(count: usize) -> String {
    match count {
        0..1_000 => format!("{count} B"),
        1_000..1_000_000 => format!("{:.1} kB", count as f64 / 1e3),
        _ => format!("{:.1} MB", count as f64 / 1e6),
    }
}
