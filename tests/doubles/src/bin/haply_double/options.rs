//! What the double is told on its command line.

use std::path::PathBuf;
use std::time::Duration;

use rhombus_doubles::HandArguments;

const USAGE: &str = "haply_double [--port N] [--devices ID,ID] [--grips ID,ID] [--service 3.5|3.4] [--tick-ms N] \
                     [--record FILE] [--unplug device|service] [--fault NAME [--fault-after MESSAGES]] [--attached yes|no] [hand options]; \
                     SIGUSR1 unplugs, SIGUSR2 plugs in again; attached, it ends with its standard input; only the first device has a hand and is recorded";

/// What the double does.
#[derive(Clone, Debug)]
pub(crate) struct Options {
    pub(crate) port: u16,
    pub(crate) devices: Vec<String>,
    pub(crate) grips: Vec<String>,
    /// 3.5 understands `vector` and tells the force; before it is `values`.
    pub(crate) is_3_5: bool,
    pub(crate) tick: Duration,
    pub(crate) record: Option<PathBuf>,
    pub(crate) unplugs_service: bool,
    pub(crate) fault: String,
    pub(crate) fault_after: usize,
    pub(crate) attached: bool,
    pub(crate) hand: HandArguments,
}

impl Options {
    /// Reads the arguments.
    pub(crate) fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Options, String> {
        let mut options = Options {
            port: 0,
            devices: vec!["049D".to_owned()],
            grips: Vec::new(),
            is_3_5: true,
            tick: Duration::from_millis(20),
            record: None,
            unplugs_service: false,
            fault: String::new(),
            fault_after: 0,
            attached: false,
            hand: HandArguments::default(),
        };
        while let Some(option) = arguments.next() {
            let value = arguments.next().ok_or_else(|| format!("{option} needs a value; {USAGE}"))?;
            let number = || value.parse::<u64>().map_err(|error| format!("{option} {value:?}: {error}"));
            let list = || value.split(',').filter(|id| !id.is_empty()).map(str::to_owned).collect();
            match option.as_str() {
                "--port" => options.port = u16::try_from(number()?).map_err(|error| error.to_string())?,
                "--devices" => options.devices = list(),
                "--grips" => options.grips = list(),
                "--service" => options.is_3_5 = value == "3.5",
                "--tick-ms" => options.tick = Duration::from_millis(number()?),
                "--record" => options.record = Some(PathBuf::from(&value)),
                "--unplug" => options.unplugs_service = value == "service",
                "--attached" => options.attached = value == "yes",
                "--fault" => options.fault.clone_from(&value),
                "--fault-after" => {
                    options.fault_after = usize::try_from(number()?).map_err(|error| error.to_string())?;
                }
                _ if options.hand.take(&option, &value)? => {}
                _ => return Err(format!("{option} is not known; {USAGE}")),
            }
        }
        Ok(options)
    }
}
