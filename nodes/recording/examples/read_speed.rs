//! How fast a recording is read: `read_speed PATH [messages|stored|owned]`. Prints opening time, messages per second and the
//! most memory the process had.
#![expect(clippy::print_stdout, reason = "printing is what it is for")]

use std::time::Instant;

use recording::Recording;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("usage: read_speed PATH [messages|stored|owned]")?;
    let how = arguments.next().unwrap_or_default();
    let begin = Instant::now();
    let recording = Recording::open(path)?;
    let opened_s = begin.elapsed().as_secs_f64();
    let begin = Instant::now();
    let (mut count, mut bytes) = (0_u64, 0_u64);
    let mut take = |data: &[u8]| {
        count += 1;
        bytes += data.len() as u64;
    };
    match how.as_str() {
        "owned" => {
            for message in recording.messages() {
                take(&message?.data);
            }
        }
        "stored" => {
            let mut messages = recording.stored_messages();
            while let Some(message) = messages.next_ref() {
                take(message?.data);
            }
        }
        _ => {
            let mut messages = recording.messages();
            while let Some(message) = messages.next_ref() {
                take(message?.data);
            }
        }
    }
    let read_s = begin.elapsed().as_secs_f64();
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find(|line| line.starts_with("VmHWM")).unwrap_or("VmHWM: not known");
    println!(
        "opened in {opened_s:.3} s; {count} messages of {:.1} MB in {read_s:.3} s: {:.2} M messages/s, {:.0} MB/s; {peak}",
        bytes as f64 * 1e-6,
        count as f64 / read_s * 1e-6,
        bytes as f64 / read_s * 1e-6,
    );
    Ok(())
}
