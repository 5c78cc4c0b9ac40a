//! The motor loop beside a bare loop that only sleeps until absolute deadlines, in alternating pairs of the same run.
//!
//! Both threads ask for the same priority, and the file says whether they got it. What is compared is lateness: how long
//! after its deadline a period began; both leave out by the same rule what they are too late for.
//! The motor loop works as in a session: a simulated hand presses into a floor, a contact law of three chains arrives
//! every 10 ms, samples leave for a second thread. Its own work is reading, choosing, making safe and commanding,
//! the simulated mechanics included.

#![expect(clippy::print_stdout, reason = "the benchmark's table")]

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow, ensure};
use clap::Parser;
use devices::simulated::{Flaws, HandSettings, Motion, Settings, Site, press_slide_grasp_pull};
use devices::{
    Backend, ForceOrigin, ForceSource, LawCommand, MotorLoop, MotorSettings, SafetySettings, Sample,
    Scheduling, monotonic_ns, next_deadline, samples, sleep_until,
};
use glam::DVec3;
use rhombus_benches::{Spread, machine_name};
use rhombus_chain::{ContactLaw, LocalLaw, Mode};
use scene::{Reader, Scene};

const PRIORITY: i32 = 50;
/// Between two contact laws, as a model that answers every tenth pose would send them.
const LAW_PERIOD: Duration = Duration::from_millis(10);

#[derive(Parser)]
#[command(about = "The motor loop beside a bare absolute-sleep loop")]
struct Options {
    /// Seconds of each loop in each pair.
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// Alternating pairs at each rate.
    #[arg(long, default_value_t = 5)]
    pairs: usize,
    /// Rates, Hz.
    #[arg(long, value_delimiter = ',', default_value = "1000,4000")]
    rates: Vec<f64>,
    /// CPU that both loops stay on; none: any.
    #[arg(long)]
    cpu: Option<usize>,
    /// Scene whose contact law is evaluated.
    #[arg(long, default_value = "config/liver.yaml")]
    scene: PathBuf,
    /// File for the raw results.
    #[arg(long)]
    csv: PathBuf,
}

/// What one loop did.
struct Round {
    lateness_us: Vec<f64>,
    work_us: Vec<f64>,
    largest_step_n: f64,
    in_contact: usize,
    skipped: u64,
    /// Whether the loop's thread got `SCHED_FIFO`.
    fifo: bool,
}

fn main() -> Result<()> {
    let options = Options::parse();
    let law = Arc::new(Scene::from_file(&options.scene, Reader::Everything)?.law()?);
    let mut csv =
        File::create(&options.csv).with_context(|| format!("creating {}", options.csv.display()))?;
    writeln!(csv, "# {}", machine_name())?;
    writeln!(
        csv,
        "# {} pairs of {} s at each rate; lateness and work in microseconds",
        options.pairs, options.seconds
    )?;
    writeln!(
        csv,
        "rate_hz,pair,loop,fifo,what,p999,periods,skipped,largest_step_n,in_contact,{}",
        Spread::CSV_HEADER
    )?;
    for &rate_hz in &options.rates {
        let mut p999 = [Vec::new(), Vec::new()];
        let mut ratios = Vec::new();
        let mut work = Vec::new();
        for pair in 0..options.pairs {
            // Whoever comes first meets the machine's mood first: in turns.
            let order = if pair % 2 == 0 { [0, 1] } else { [1, 0] };
            let mut of_pair = [0.0; 2];
            for kind in order {
                let round =
                    if kind == 0 { bare(rate_hz, &options)? } else { motor(rate_hz, &options, &law)? };
                let name = ["bare", "motor_loop"][kind];
                of_pair[kind] = quantile(&round.lateness_us, 0.999);
                p999[kind].push(of_pair[kind]);
                for (what, samples) in [("lateness", &round.lateness_us), ("work", &round.work_us)] {
                    let Some(spread) = Spread::of(&mut samples.clone()) else { continue };
                    writeln!(
                        csv,
                        "{rate_hz},{pair},{name},{},{what},{:.2},{},{},{:.6},{},{}",
                        u8::from(round.fifo),
                        quantile(samples, 0.999),
                        samples.len(),
                        round.skipped,
                        round.largest_step_n,
                        round.in_contact,
                        spread.csv()
                    )?;
                }
                csv.flush()?;
                work.extend_from_slice(&round.work_us);
                println!(
                    "{rate_hz:>5} Hz  pair {pair}  {name:<10}  late median {:7.1}  p99 {:8.1}  p99.9 {:9.1} us   skipped {:>4}   \
                     largest step {:.4} N",
                    quantile(&round.lateness_us, 0.5),
                    quantile(&round.lateness_us, 0.99),
                    of_pair[kind],
                    round.skipped,
                    round.largest_step_n,
                );
            }
            ratios.push(of_pair[1] / of_pair[0]);
        }
        println!(
            "{rate_hz} Hz: lateness p99.9, median of the pairs: bare {:.1} us, motor loop {:.1} us; ratio of the medians {:.2}, \
             ratios {:?}; own work median {:.2} us",
            quantile(&p999[0], 0.5),
            quantile(&p999[1], 0.5),
            quantile(&p999[1], 0.5) / quantile(&p999[0], 0.5),
            ratios.iter().map(|ratio| (ratio * 100.0).round() / 100.0).collect::<Vec<_>>(),
            quantile(&work, 0.5),
        );
    }
    Ok(())
}

/// A loop that does nothing.
fn bare(rate_hz: f64, options: &Options) -> Result<Round> {
    let (period_ns, periods) = grid(rate_hz, options);
    let cpu = options.cpu;
    let thread = std::thread::Builder::new().name("bare_loop".to_owned()).spawn(move || {
        let fifo = Scheduling::request(PRIORITY, cpu).is_fifo();
        let mut lateness_us = touched(periods);
        let mut skipped = 0;
        let mut deadline_ns = monotonic_ns() + period_ns;
        while lateness_us.len() < periods {
            sleep_until(deadline_ns);
            let late_ns = monotonic_ns().saturating_sub(deadline_ns);
            lateness_us.push(us(late_ns));
            let (next_ns, left_out) = next_deadline(deadline_ns, period_ns, monotonic_ns());
            skipped += left_out;
            deadline_ns = next_ns;
        }
        (lateness_us, skipped, fifo)
    })?;
    let (lateness_us, skipped, fifo) = thread.join().map_err(|_| anyhow!("the bare loop panicked"))?;
    Ok(Round { lateness_us, work_us: Vec::new(), largest_step_n: 0.0, in_contact: 0, skipped, fifo })
}

/// The motor loop in a session.
fn motor(rate_hz: f64, options: &Options, law: &Arc<ContactLaw>) -> Result<Round> {
    let (_, periods) = grid(rate_hz, options);
    let (sender, mut receiver) = samples(65_536);
    let backend = Backend::Simulated(hand(1.0 / rate_hz)?);
    let settings = MotorSettings {
        rate_hz,
        fifo_priority: PRIORITY,
        cpu: options.cpu,
        source: ForceSource::ContactLaw,
        safety: SafetySettings::default().checked(rate_hz, &[])?,
        enable_at_start: true,
        gravity_compensation: false,
    };
    let mut motor = MotorLoop::start(backend.opener(), settings, sender)?;
    let (mut lateness_us, mut work_us) = (touched(periods), touched(periods));
    let (mut largest_step_n, mut in_contact, mut before) = (0.0f64, 0, None::<Sample>);
    let mut next_law = Instant::now();
    while lateness_us.len() < periods && motor.is_running() {
        motor.beat();
        let Some(sample) = receiver.recv_timeout(Duration::from_millis(5)) else { continue };
        lateness_us.push(us(sample.late_ns));
        if let Some(before) = before {
            // The first has none before it.
            work_us.push(us(sample.work_ns));
            largest_step_n = largest_step_n.max((sample.wrench.force_n - before.wrench.force_n).length());
        }
        let is_pressed = sample.origin == ForceOrigin::ContactLaw && sample.wrench.force_n.z > 0.0;
        in_contact += usize::from(is_pressed);
        before = Some(sample);
        if Instant::now() >= next_law {
            next_law = Instant::now() + LAW_PERIOD;
            motor.send_law(floor(sample.stamp_ns, law));
        }
    }
    let (counts, fifo) = (motor.counts(), motor.scheduling().is_fifo());
    motor.stop()?;
    ensure!(counts.lost_samples == 0, "{} samples were lost", counts.lost_samples);
    let slew_n = SafetySettings::default().slew_n_per_s / rate_hz;
    ensure!(
        largest_step_n <= slew_n * (1.0 + 1e-9),
        "a step of {largest_step_n} N, the slew limit is {slew_n} N"
    );
    Ok(Round { lateness_us, work_us, largest_step_n, in_contact, skipped: counts.skipped_ticks, fifo })
}

fn us(ns: u64) -> f64 {
    ns as f64 / 1000.0
}

/// Room that the operating system has already found pages for: finding them holds up every other thread of a CPU.
fn touched(count: usize) -> Vec<f64> {
    let mut room = vec![1.0; count + 1000];
    room.clear();
    room
}

fn grid(rate_hz: f64, options: &Options) -> (u64, usize) {
    ((1e9 / rate_hz).round() as u64, (rate_hz * options.seconds) as usize)
}

/// A hand that presses and slides on the floor z < 0.
fn hand(period_s: f64) -> Result<Settings> {
    let site = |x: f64| Site {
        point: DVec3::new(x, 0.0, 0.0),
        normal: DVec3::Z,
        slide: vec![(DVec3::new(x + 0.01, 0.0, 0.0), DVec3::Z)],
    };
    let script = press_slide_grasp_pull(&[site(-0.02), site(0.02)], &Motion::default())?;
    let hand = HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 };
    Ok(Settings { hand, script, period_s, flaws: Flaws::default() })
}

fn floor(stamp_ns: i64, chains: &Arc<ContactLaw>) -> LawCommand {
    let local = LocalLaw {
        mode: Mode::Contact,
        anchor: DVec3::ZERO,
        normal: DVec3::Z,
        probe_radius_m: Motion::default().probe_radius_m,
        depth_offset_m: 0.0,
        stiffness_factor: 1.0,
        ..LocalLaw::default()
    };
    LawCommand { stamp_ns, validity_ns: 100_000_000, local, chains: chains.clone() }
}

fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = ((sorted.len() as f64 - 1.0) * share).round().max(0.0) as usize;
    sorted.get(place).copied().unwrap_or(f64::NAN)
}
