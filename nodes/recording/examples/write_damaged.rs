//! Writes the broken recordings of `tests/bags/damaged` for other tools: `write_damaged DIRECTORY`.
#![expect(clippy::print_stdout, reason = "printing is what it is for")]

#[path = "../../../tests/bags/damaged/mod.rs"]
mod damaged;

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let directory = std::env::args_os().nth(1).ok_or("usage: write_damaged DIRECTORY")?;
    for case in damaged::all() {
        println!("{}: {:?}", case.write(Path::new(&directory)).display(), case.expected);
    }
    Ok(())
}
