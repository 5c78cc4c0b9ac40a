//! `rhombus device check`: opens one device and measures whether it is fit for a hand.

use std::io::{BufRead, Write};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use anyhow::{Context, bail};
use clap::Args;
use devices::check::{self, Finding, LARGEST_FORCE_N, Settings};
use devices::{Device, DeviceError, Listed, Scheduling};

use super::backends::{Places, REAL, rate, seconds, told};
use super::report::{Identity, Line, Report};
use crate::output;

/// Real-time priority that is asked for: the motor loop's.
const PRIORITY: i32 = 50;
/// What has to be typed before motors are switched on.
const WORD: &str = "push";

/// Open one device and measure it: identity, rate, times, noise, limits, force path
///
/// Motors stay off, and small commands to them must not move the handle, unless --forces is given. Each line is ok, a
/// warning or a failure, with the number, the limit and the remedy. Exit code 0 when nothing failed, 1 when something
/// did, 2 when the command line is not accepted.
#[derive(Args)]
pub(crate) struct Check {
    /// Backend, or backend:serial, as `rhombus device list` shows it; by default the only device that is connected
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Serial number; the same as in NAME
    #[arg(long, value_name = "SERIAL")]
    serial: Option<String>,
    #[command(flatten)]
    places: Places,
    /// Readings in a second
    #[arg(long, value_name = "HZ", default_value = "1000", allow_hyphen_values = true, value_parser = rate)]
    rate: f64,
    /// How long the handle is watched at rest, s
    #[arg(long, value_name = "S", default_value = "2", allow_hyphen_values = true, value_parser = seconds)]
    seconds: Duration,
    /// Switch the motors on and push the handle to and fro along each axis, by at most 0.5 N
    #[arg(long)]
    forces: bool,
    /// Do not ask before motors are switched on
    #[arg(long, requires = "forces")]
    yes: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Check {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        let settings = Settings::new(self.rate, self.seconds, self.forces)?;
        if self.forces && !self.yes {
            confirm()?;
        }
        let (identity, findings) = match self.choose()? {
            Chosen::Device(backend, serial) => self.check(&backend, &serial, &settings)?,
            Chosen::Nothing(findings) => (None, findings),
        };
        let findings: Vec<Line> = findings.into_iter().map(Line::of).collect();
        let ok = !findings.iter().any(Line::is_failure);
        let report = Report {
            device: identity,
            rate_hz: self.rate,
            seconds: self.seconds.as_secs_f64(),
            forces: self.forces,
            findings,
            ok,
        };
        match self.json {
            true => output::json(&report)?,
            false => output::text(&report.to_string())?,
        }
        Ok(if ok { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }

    /// Which device is meant.
    fn choose(&self) -> anyhow::Result<Chosen> {
        let Some(name) = &self.name else { return self.only_one() };
        let (backend, in_name) = name.split_once(':').unwrap_or((name, ""));
        let serial = match (&self.serial, in_name) {
            (Some(serial), "") => serial,
            (Some(serial), in_name) if serial != in_name => {
                bail!("{name} and --serial {serial} are two serial numbers; give one");
            }
            (_, in_name) => in_name,
        };
        Ok(Chosen::Device(backend.to_owned(), serial.to_owned()))
    }

    /// The only device that is connected, with the serial number that was asked for.
    fn only_one(&self) -> anyhow::Result<Chosen> {
        let (mut names, mut problems) = (Vec::new(), Vec::new());
        for backend in REAL {
            let Listed { found, problems: barred } = self.places.list(backend);
            for error in &barred {
                let (found, remedy) = told(error, backend);
                problems.push(Finding::failure("connected", format!("{backend}: {found}"), remedy));
            }
            let meant = |serial: &str| self.serial.as_deref().is_none_or(|wanted| wanted == serial);
            let found: Vec<_> = found.into_iter().filter(|found| meant(&found.serial)).collect();
            if found.is_empty() && barred.is_empty() {
                let looked = format!("{backend}: {}", self.places.looked(backend));
                problems.push(Finding::failure("connected", looked, "connect a device and switch it on"));
            }
            names.extend(found.into_iter().map(|found| (backend.to_owned(), found.serial)));
        }
        match names.as_slice() {
            [] => Ok(Chosen::Nothing(problems)),
            [(backend, serial)] => Ok(Chosen::Device(backend.clone(), serial.clone())),
            several => {
                let names: Vec<String> =
                    several.iter().map(|(backend, serial)| format!("{backend}:{serial}")).collect();
                bail!("{} devices are connected; name one: {}", names.len(), names.join(", "));
            }
        }
    }

    fn check(
        &self,
        backend: &str,
        serial: &str,
        settings: &Settings,
    ) -> anyhow::Result<(Option<Identity>, Vec<Finding>)> {
        let device = match self.places.backend(backend, serial, self.rate)?.open() {
            Ok(device) => device,
            // The command line is wrong, not the device.
            Err(error @ DeviceError::Setting { .. }) => return Err(error.into()),
            Err(error) => {
                let (found, remedy) = told(&error, backend);
                return Ok((None, vec![Finding::failure("open", found, remedy)]));
            }
        };
        let stop = stopped_by_signals()?;
        let identity = Identity::of(device.description());
        let thread = std::thread::Builder::new().name("device check".to_owned());
        let findings = std::thread::scope(|scope| {
            let measuring = thread.spawn_scoped(scope, || measure(device, settings, &stop))?;
            measuring
                .join()
                .map_err(|_| anyhow::anyhow!("the check broke off; the device is closed, its motors off"))
        })?;
        Ok((Some(identity), findings))
    }
}

enum Chosen {
    /// Backend and serial number.
    Device(String, String),
    /// And why.
    Nothing(Vec<Finding>),
}

/// Takes the device, so that its motors are off and it is closed when this ends, however it ends.
fn measure(mut device: Box<dyn Device>, settings: &Settings, stop: &AtomicBool) -> Vec<Finding> {
    let scheduling = Scheduling::request(PRIORITY, None);
    let mut findings = check::identity(device.description());
    let mut granted = check::scheduling(&scheduling);
    if let Some(limits) = limits() {
        granted.found += &format!("; {limits}");
    }
    findings.push(granted);
    findings.extend(check::run(&mut *device, settings, stop));
    findings
}

/// What this user may ask for.
fn limits() -> Option<String> {
    let text = std::fs::read_to_string("/proc/self/limits").ok()?;
    let limit = |name: &str| text.lines().find_map(|line| line.strip_prefix(name)?.split_whitespace().next());
    let (priority, memory) = (limit("Max realtime priority")?, limit("Max locked memory")?);
    let unit = if memory == "unlimited" { "" } else { " bytes" };
    Some(format!("this user's limits: rtprio {priority}, memlock {memory}{unit}"))
}

/// Asks at the terminal, or whatever stands for it.
fn confirm() -> anyhow::Result<()> {
    let mut stderr = std::io::stderr();
    write!(
        stderr,
        "The motors will be switched on and push by up to {LARGEST_FORCE_N} N for seven seconds. Hold the handle loosely in \
         one hand, away from its stops. Type {WORD} to go on: "
    )
    .and_then(|()| stderr.flush())
    .context("cannot ask before the motors are switched on; give --yes")?;
    let mut line = String::new();
    std::io::stdin().lock().read_line(&mut line).context("cannot read the confirmation; give --yes")?;
    if line.trim() != WORD {
        bail!("not confirmed, so nothing was opened; type {WORD}, or give --yes");
    }
    Ok(())
}

/// True once this process is to end: the check then stops with motors off.
fn stopped_by_signals() -> anyhow::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM, signal_hook::consts::SIGHUP] {
        signal_hook::flag::register(signal, stop.clone()).context("cannot listen for signals")?;
    }
    Ok(stop)
}
