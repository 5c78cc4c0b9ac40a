//! `rhombus device list`: every backend asked, and what stands between a device and this user.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use devices::Listed;
use serde::Serialize;

use super::access::{self, DeviceFile, RULES_REMEDY};
use super::backends::{POINTER, Places, REAL, SIMULATED, told};
use crate::output;

/// What is connected, and what could not be asked
///
/// Asks every backend; each free Force Dimension device is opened for a moment, every USB serial port is greeted, motors
/// stay off. Exit code 0 when a device was found, 1 when none was.
#[derive(Args)]
pub(crate) struct List {
    #[command(flatten)]
    places: Places,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Field names and their order are the JSON.
#[derive(Serialize)]
struct Listing {
    backends: Vec<Answer>,
    device_files: Vec<DeviceFile>,
    udev_rules: Rules,
}

/// What a backend said.
#[derive(Serialize)]
struct Answer {
    backend: &'static str,
    devices: Vec<Connected>,
    /// What could not be asked; where it looked, when there is nothing else to say.
    problems: Vec<Problem>,
}

#[derive(Serialize)]
struct Problem {
    problem: String,
    remedy: Option<String>,
}

#[derive(Serialize)]
struct Connected {
    serial: String,
    what: String,
    /// How `rhombus device check` knows it.
    name: String,
}

#[derive(Serialize)]
struct Rules {
    installed: Option<PathBuf>,
    remedy: Option<String>,
}

impl List {
    pub(crate) fn run(self) -> anyhow::Result<ExitCode> {
        let listing = Listing::of(&self.places);
        match self.json {
            true => output::json(&listing)?,
            false => output::text(&listing.to_string())?,
        }
        let found = listing.backends.iter().any(|answer| !answer.devices.is_empty());
        Ok(if found { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }
}

impl Listing {
    fn of(places: &Places) -> Listing {
        let installed = access::rules();
        Listing {
            backends: REAL.into_iter().map(|backend| Answer::of(backend, places)).collect(),
            device_files: access::device_files(),
            udev_rules: Rules { remedy: installed.is_none().then(|| RULES_REMEDY.to_owned()), installed },
        }
    }
}

impl Answer {
    fn of(backend: &'static str, places: &Places) -> Answer {
        let Listed { found, problems } = places.list(backend);
        let connected = found.into_iter().map(|found| Connected {
            name: if found.serial.is_empty() {
                backend.to_owned()
            } else {
                format!("{backend}:{}", found.serial)
            },
            serial: found.serial,
            what: found.what,
        });
        let devices: Vec<_> = connected.collect();
        let mut problems: Vec<_> = problems
            .iter()
            .map(|error| {
                let (problem, remedy) = told(error, backend);
                Problem { problem, remedy: Some(remedy).filter(|remedy| !remedy.is_empty()) }
            })
            .collect();
        if devices.is_empty() && problems.is_empty() {
            problems.push(Problem { problem: places.looked(backend), remedy: None });
        }
        Answer { backend, devices, problems }
    }
}

impl std::fmt::Display for Listing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = String::new();
        for Answer { backend, devices, problems } in &self.backends {
            for connected in devices {
                writeln!(text, "{:<28}{}", connected.name, connected.what)?;
            }
            let how = if devices.is_empty() { "none" } else { "not usable" };
            for Problem { problem, remedy } in problems {
                writeln!(text, "{backend:<28}{how}: {problem}")?;
                if let Some(remedy) = remedy {
                    writeln!(text, "{:<28}-> {remedy}", "")?;
                }
            }
        }
        writeln!(text, "{SIMULATED:<28}built in, no hardware needed: a scripted hand")?;
        writeln!(
            text,
            "{POINTER:<28}built in, no hardware needed: the same hand, led in a session by the mouse on the viewer's page"
        )?;
        writeln!(text)?;
        match &self.udev_rules.installed {
            Some(path) => writeln!(text, "udev rules: {}", path.display())?,
            None => writeln!(
                text,
                "udev rules: not installed (looked in {})\n  -> {RULES_REMEDY}",
                access::rule_folders()
            )?,
        }
        for file in &self.device_files {
            let DeviceFile { path, what, mode, owner, group, accessible } = file;
            let may = if *accessible { "may be opened" } else { "may not be opened by this user" };
            writeln!(text, "{mode} {owner}:{group} {} ({what}): {may}", path.display())?;
            if !accessible {
                writeln!(text, "  -> {}", file.remedy())?;
            }
        }
        if self.device_files.is_empty() {
            writeln!(
                text,
                "device files: none of a Force Dimension device, a Falcon, a SpaceMouse or a USB serial port"
            )?;
        }
        f.write_str(&text)
    }
}
