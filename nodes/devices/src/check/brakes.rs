//! The force path with motors that are off: commands are taken, and nothing moves.

use super::noise::Noise;
use super::pulses::Pulses;
use super::sampling::Series;
use super::spread::Spread;
use super::{Finding, Verdict};

/// The handle may move by so many times its peak to peak at rest, or by this, m, whatever is larger.
const REST: f64 = 3.0;
const SMALLEST_M: f64 = 100e-6;
/// Along each axis at least this far with the force, m: that is no hand that moves the handle.
const FOLLOWED_M: f64 = 50e-6;

pub(super) fn finding(pulses: &Pulses, series: &Series, noise: Option<&Noise>) -> Finding {
    let times = Spread::of(series.ticks.iter().map(|tick| tick.command_ns));
    let start = series.ticks.first().map(|tick| tick.state.position);
    let moved_m = series
        .ticks
        .iter()
        .filter_map(|tick| Some((tick.state.position - start?).length()))
        .fold(0.0, f64::max);
    let still_m = noise.filter(|noise| noise.moved_m.is_none()).map(|noise| noise.peak_to_peak_m.length());
    let allowed_m = (REST * still_m.unwrap_or(0.0)).max(SMALLEST_M);
    let followed = pulses.response_m(series).is_some_and(|response| response.min_element() > FOLLOWED_M);
    let (verdict, remedy) = match (moved_m <= allowed_m, followed) {
        (true, _) => (Verdict::Ok, ""),
        (false, true) => (
            Verdict::Failure,
            "switch the device's power off and do not use it: its motors push although they are off",
        ),
        (false, false) => (Verdict::Warning, "let go of the handle, or lay it down, and run this again"),
    };
    let count = series.ticks.len();
    Finding::new(
        "brakes",
        verdict,
        format!(
            "{count} small commands to motors that are off take {times} each; the handle moved by {:.3} mm{}",
            moved_m * 1e3,
            if followed && verdict == Verdict::Failure { ", with the force" } else { "" }
        ),
        remedy,
    )
    .held_against(format!("at most {:.3} mm", allowed_m * 1e3))
    .with("commands", count as f64)
    .with("median_us", times.median_us)
    .with("p99_us", times.p99_us)
    .with("max_us", times.max_us)
    .with("moved_m", moved_m)
}
