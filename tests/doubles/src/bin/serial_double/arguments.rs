//! The command line.

use std::path::PathBuf;

use rhombus_doubles::HandArguments;

use crate::fault::Fault;

/// What the double is asked to be.
pub(crate) struct Arguments {
    /// A symbolic link to the pseudo-terminal.
    pub link: Option<PathBuf>,
    pub record: Option<PathBuf>,
    pub fault: Fault,
    pub serial: String,
    pub rate_hz: u16,
    /// The rate at which it listens; whoever speaks at another is not understood.
    pub baud: u32,
    pub joints: u8,
    /// It needs homing, which takes this long, s.
    pub homing_s: Option<f64>,
    /// Above this speed it switches its motors off, m/s.
    pub max_speed: f64,
    /// It ends with its standard input.
    pub attached: bool,
    pub hand: HandArguments,
}

impl Arguments {
    pub(crate) fn parse(mut words: impl Iterator<Item = String>) -> Result<Arguments, String> {
        let mut arguments = Arguments {
            link: None,
            record: None,
            fault: Fault::None,
            serial: "D1".to_owned(),
            rate_hz: 1000,
            baud: 921_600,
            joints: 3,
            homing_s: None,
            max_speed: f64::INFINITY,
            attached: false,
            hand: HandArguments::default(),
        };
        while let Some(option) = words.next() {
            let value = words.next().ok_or_else(|| format!("{option} wants a value"))?;
            let wrong = |accepted| format!("{option} {value:?}: accepted is {accepted}");
            match option.as_str() {
                "--link" => arguments.link = Some(PathBuf::from(value)),
                "--record" => arguments.record = Some(PathBuf::from(value)),
                "--fault" => arguments.fault = Fault::named(&value).ok_or_else(|| wrong(Fault::NAMES))?,
                "--serial" => arguments.serial = value,
                "--rate" => arguments.rate_hz = value.parse().map_err(|_| wrong("Hz"))?,
                "--baud" => arguments.baud = value.parse().map_err(|_| wrong("bit/s"))?,
                "--joints" => arguments.joints = value.parse().map_err(|_| wrong("a number"))?,
                "--homing" => arguments.homing_s = Some(value.parse().map_err(|_| wrong("s"))?),
                "--max-speed" => arguments.max_speed = value.parse().map_err(|_| wrong("m/s"))?,
                "--attached" => arguments.attached = value == "yes",
                _ if arguments.hand.take(&option, &value)? => {}
                _ => return Err(format!("{option} is no option")),
            }
        }
        Ok(arguments)
    }
}
