//! Where a report comes from: machine, commit, compiler, date.

use std::time::SystemTime;

use serde::Serialize;

use super::section::Mode;

/// What a report names at its top. Field names and their order are the JSON.
#[derive(Serialize)]
pub(crate) struct Origin {
    /// `quick` or `full`.
    pub(crate) mode: &'static str,
    /// RFC 3339, UTC.
    pub(crate) date: String,
    /// Commit the executable was built from, and whether its tree was clean.
    pub(crate) commit: &'static str,
    /// Compiler that built it.
    pub(crate) rustc: &'static str,
    /// `release` or `debug`.
    pub(crate) profile: &'static str,
    /// As the kernel calls it.
    pub(crate) cpu: String,
    /// Cores this process may use.
    pub(crate) cores: usize,
    /// Of the machine.
    pub(crate) memory_bytes: u64,
    /// `GLIBC_TUNABLES`, by which memory comes in large pages.
    pub(crate) tunables: Option<String>,
    /// Processes ready to run when the report began: above 0.5 or so, times are too long.
    pub(crate) load: f64,
}

impl Origin {
    /// Looks around.
    pub(crate) fn new(mode: Mode) -> Self {
        let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
        let (cpu_info, memory, load) = (read("/proc/cpuinfo"), read("/proc/meminfo"), read("/proc/loadavg"));
        let value = |text: &str, key: &str| {
            let line = text.lines().find(|line| line.starts_with(key))?;
            Some(line.split_once(':')?.1.trim().to_owned())
        };
        let kilobytes =
            value(&memory, "MemTotal").and_then(|text| text.split(' ').next()?.parse::<u64>().ok());
        Self {
            mode: mode.name(),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            commit: option_env!("RHOMBUS_COMMIT").unwrap_or("unknown"),
            rustc: option_env!("RHOMBUS_RUSTC").unwrap_or("unknown"),
            profile: if cfg!(debug_assertions) { "debug" } else { "release" },
            cpu: value(&cpu_info, "model name").unwrap_or_else(|| "unknown CPU".to_owned()),
            cores: std::thread::available_parallelism().map_or(0, std::num::NonZero::get),
            memory_bytes: kilobytes.unwrap_or(0) * 1024,
            tunables: std::env::var("GLIBC_TUNABLES").ok(),
            load: load.split(' ').next().and_then(|text| text.parse().ok()).unwrap_or(f64::NAN),
        }
    }

    /// Names and values for people.
    pub(crate) fn lines(&self) -> Vec<(&'static str, String)> {
        let gigabytes = self.memory_bytes as f64 / 1e9;
        vec![
            ("mode", self.mode.to_owned()),
            ("date", self.date.clone()),
            ("commit", self.commit.to_owned()),
            ("compiler", format!("{}, {}", self.rustc, self.profile)),
            ("machine", format!("{}, {} cores, {gigabytes:.1} GB", self.cpu, self.cores)),
            ("GLIBC_TUNABLES", self.tunables.clone().unwrap_or_else(|| "not set".to_owned())),
            ("load at the start", format!("{:.2}", self.load)),
        ]
    }
}
