//! Rates and times: of the loop that asks, of the calls, and of the device that answers.

use super::sampling::Series;
use super::spread::Spread;
use super::{Finding, Verdict};
use crate::Scheduling;

/// Shares of a period.
const LATE: f64 = 0.2;
const HALF: f64 = 0.5;

/// New readings in a second below which a device is no haptic device, and below which more of them would be felt.
const SLOWEST_HZ: f64 = 50.0;
const GOOD_HZ: f64 = 900.0;

/// A reading that is older than this is no ground for a force, s (`safety.servo_validity`).
const OLDEST_S: f64 = 0.02;

pub(super) fn scheduling(scheduling: &Scheduling) -> Finding {
    let verdict = if scheduling.is_granted() { Verdict::Ok } else { Verdict::Warning };
    Finding::new(
        "scheduling",
        verdict,
        scheduling.to_string(),
        "write `@realtime - rtprio 98` and `@realtime - memlock unlimited` into /etc/security/limits.d/rhombus.conf, \
         add this user to the group realtime, and log in again (in a container: --ulimit rtprio=98 --ulimit memlock=-1 \
         --cap-add SYS_NICE)",
    )
    .held_against("SCHED_FIFO and locked memory")
}

pub(super) fn findings(series: &Series) -> Vec<Finding> {
    if series.ticks.is_empty() {
        return Vec::new();
    }
    let mut findings = vec![loop_rate(series), lateness(series)];
    let ticks = &series.ticks;
    for (name, what, times) in [
        ("read_time", "reading", Spread::of(ticks.iter().map(|tick| tick.read_ns))),
        ("command_time", "commanding", Spread::of(ticks.iter().map(|tick| tick.command_ns))),
    ] {
        findings.push(call_time(name, what, times, series.period_ns));
    }
    findings.extend([device_rate(series), gaps(series)]);
    findings.extend(device_clock(series));
    findings
}

fn loop_rate(series: &Series) -> Finding {
    let count = series.ticks.len() as f64;
    let rate_hz = count / series.seconds();
    let share = rate_hz * series.period_ns as f64 * 1e-9;
    let missed = series.missed;
    Finding::new(
        "loop_rate",
        verdict(share >= 0.999, share >= 0.9),
        format!("{rate_hz:.1} Hz, {missed} of {} periods missed", series.ticks.len() as u64 + missed),
        "see to the scheduling, end other programs, or take a smaller rate",
    )
    .held_against(format!("{:.1} Hz; below 90 % of it is a failure", 1e9 / series.period_ns as f64))
    .with("rate_hz", rate_hz)
    .with("missed", missed as f64)
}

fn lateness(series: &Series) -> Finding {
    let late = Spread::of(series.ticks.iter().map(|tick| tick.late_ns));
    let limit_us = LATE * series.period_ns as f64 * 1e-3;
    with_spread(
        Finding::new(
            "lateness",
            verdict(late.p99_us <= limit_us, true),
            late.to_string(),
            "see to the scheduling, and set the CPUs' governor to performance",
        )
        .held_against(format!("p99 at most {limit_us:.0} us, a fifth of a period")),
        &late,
    )
}

fn call_time(name: &'static str, what: &str, times: Spread, period_ns: u64) -> Finding {
    let period_us = period_ns as f64 * 1e-3;
    let limit_us = HALF * period_us;
    with_spread(
        Finding::new(
            name,
            verdict(times.p99_us <= limit_us, times.p99_us <= period_us),
            format!("{what} takes {times}"),
            "take a smaller rate (device.rate), or another USB port without a hub",
        )
        .held_against(format!("p99 at most {limit_us:.0} us, half a period; a whole one is a failure")),
        &times,
    )
}

fn with_spread(finding: Finding, spread: &Spread) -> Finding {
    finding.with("median_us", spread.median_us).with("p99_us", spread.p99_us).with("max_us", spread.max_us)
}

/// How often the device itself has something new to say.
fn device_rate(series: &Series) -> Finding {
    let distinct: Vec<_> = series.distinct().collect();
    let (count, seconds) = match distinct[..] {
        [first, .., last] => (distinct.len() - 1, (last.due_ns - first.due_ns) as f64 * 1e-9),
        _ => (0, series.seconds()),
    };
    let rate_hz = count as f64 / seconds;
    let asked_hz = 1e9 / series.period_ns as f64;
    let enough_hz = GOOD_HZ.min(0.9 * asked_hz);
    Finding::new(
        "device_rate",
        verdict(rate_hz >= enough_hz, rate_hz >= SLOWEST_HZ.min(0.5 * asked_hz)),
        format!("{rate_hz:.1} new readings a second"),
        if count == 0 {
            "switch the device off and on again: it repeats one reading"
        } else {
            "set device.rate to what the device gives; a faster loop feels nothing more"
        },
    )
    .held_against(format!("{enough_hz:.0} a second; fewer than {SLOWEST_HZ} is a failure"))
    .with("readings_per_s", rate_hz)
}

/// The longest time for which asking gave nothing new. Counted in periods in which the device was asked, so that a loop
/// that was late does not look like a device that was silent.
fn gaps(series: &Series) -> Finding {
    let mut runs = Vec::new();
    let mut run = 1;
    for pair in series.ticks.windows(2) {
        if pair[0].state.device_time_ns == pair[1].state.device_time_ns {
            run += 1;
        } else {
            runs.push(run);
            run = 1;
        }
    }
    runs.push(run);
    let longest = runs.iter().copied().max().unwrap_or(1);
    runs.sort_unstable();
    let usual = runs[runs.len() / 2];
    let count = runs.iter().filter(|&&run| run > 3 * usual).count();
    let longest_s = longest as f64 * series.period_ns as f64 * 1e-9;
    let is_short = longest_s <= OLDEST_S || longest <= 3 * usual;
    Finding::new(
        "gaps",
        verdict(count == 0 && is_short, longest_s <= 0.1),
        format!("the longest time without a new reading is {:.1} ms, {count} gaps", longest_s * 1e3),
        "check the cable, other traffic on the bus, and the load of this machine",
    )
    .held_against("no gap, a wait of three times the usual; more than 100 ms is a failure")
    .with("longest_s", longest_s)
    .with("gaps", count as f64)
}

/// Only when something is wrong with it.
fn device_clock(series: &Series) -> Option<Finding> {
    let back = series
        .ticks
        .windows(2)
        .filter(|pair| pair[1].state.device_time_ns < pair[0].state.device_time_ns)
        .count();
    (back > 0).then(|| {
        Finding::failure(
            "device_clock",
            format!("the time of the device's readings went back {back} times"),
            "correct the firmware, or switch the device off and on again",
        )
        .with("times", back as f64)
    })
}

pub(super) fn verdict(is_good: bool, is_usable: bool) -> Verdict {
    match (is_good, is_usable) {
        (true, true) => Verdict::Ok,
        (_, false) => Verdict::Failure,
        (false, true) => Verdict::Warning,
    }
}
