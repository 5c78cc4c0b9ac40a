//! How far a calibration is, and how long the present step will take: a bar on a terminal, otherwise lines.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use crate::progress_bar;

/// One step of a calibration, said on stderr.
pub(super) struct Progress {
    name: &'static str,
    bar: Option<ProgressBar>,
    started: Instant,
    /// What was there when it began.
    before: Option<usize>,
}

impl Progress {
    /// A step begins.
    pub(super) fn new(name: &'static str) -> Self {
        let bar = progress_bar::on_terminal(None);
        if let Some(bar) = &bar {
            bar.set_prefix(name);
        }
        Self { name, bar, started: Instant::now(), before: None }
    }

    /// So many parts of a step are done.
    pub(super) fn reached(&mut self, done: usize, of: usize) {
        let before = *self.before.get_or_insert(done);
        let left = left(self.started.elapsed(), done.saturating_sub(before), of.saturating_sub(done));
        let left = left.map_or_else(String::new, |left| format!("{} left", humantime::format_duration(left)));
        match &self.bar {
            Some(bar) => {
                bar.set_length(of as u64);
                bar.set_position(done as u64);
                bar.set_message(left);
            }
            None if left.is_empty() => eprintln!("rhombus calibrate: {} {done}/{of}", self.name),
            None => eprintln!("rhombus calibrate: {} {done}/{of}, {left}", self.name),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Time for the parts that are left, in whole seconds, when some are done.
fn left(elapsed: Duration, done: usize, left: usize) -> Option<Duration> {
    let each = elapsed.checked_div(u32::try_from(done).ok()?)?;
    let all = each.saturating_mul(u32::try_from(left).ok()?);
    (left > 0).then(|| Duration::from_secs(all.as_secs()))
}
