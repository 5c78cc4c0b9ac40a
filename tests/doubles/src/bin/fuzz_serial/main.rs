//! Fuzzes the serial backend: mutated streams in random pieces into decoder and device, for a time or a number of runs.
//!
//! ```text
//! fuzz_serial [--seed N] [--seconds S | --runs N]
//! ```
//! Every run must hold: nothing panics; frames and faults are exactly those that an independent decoder finds; the valid
//! frame at the end is found whatever came before; every state is finite, turned by a rotation and not older than the
//! one before; every description has limits that are some; every byte sent belongs to a whole frame, in sequence, with
//! the wrench that was commanded, and with the motors on only when they were enabled; memory does not grow. A run that
//! does not hold ends the program with the seed that repeats it.

mod memory_line;
mod oracle;
mod run;
mod stream;

use std::io::Write;
use std::panic::catch_unwind;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use run::Tally;

/// Memory that a run may leave behind, bytes; allocators keep some.
const GROWTH: u64 = 16 << 20;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match fuzz(&words) {
        Ok(said) => {
            let _ = writeln!(std::io::stdout(), "{said}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "fuzz_serial: {error}");
            ExitCode::FAILURE
        }
    }
}

fn fuzz(words: &[String]) -> Result<String, String> {
    let (mut seed, mut seconds, mut most) = (1, 600, u64::MAX);
    for pair in words.chunks(2) {
        let [option, value] = pair else { return Err(format!("{} wants a number", pair[0])) };
        let number = value.parse().map_err(|_| format!("{option} {value}: accepted is a whole number"))?;
        match option.as_str() {
            "--seed" => seed = number,
            "--seconds" => seconds = number,
            "--runs" => most = number,
            _ => return Err(format!("{option} is no option")),
        }
    }
    let until = Instant::now() + Duration::from_secs(seconds);
    let mut tally = Tally::default();
    let mut settled = None;
    let mut runs = 0;
    while runs < most && (most < u64::MAX || Instant::now() < until) {
        // Each run has a seed of its own, so that one run repeats alone.
        let this = seed.wrapping_add(runs);
        let outcome = catch_unwind(|| run::run(this));
        tally += outcome
            .map_err(|_| format!("--seed {this} --runs 1 panics"))?
            .map_err(|what| format!("--seed {this} --runs 1: {what}"))?;
        runs += 1;
        if runs == 10_000 {
            settled = resident();
        }
    }
    if let (Some(settled), Some(now)) = (settled, resident())
        && now > settled + GROWTH
    {
        return Err(format!("memory grew from {settled} to {now} bytes in {runs} runs from seed {seed}"));
    }
    Ok(format!("{runs} runs from seed {seed}: {tally}"))
}

/// Memory of this process, bytes; none where the system does not say.
fn resident() -> Option<u64> {
    let pages = std::fs::read_to_string("/proc/self/statm").ok()?;
    Some(pages.split_whitespace().nth(1)?.parse::<u64>().ok()? * 4096)
}
