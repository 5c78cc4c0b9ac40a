//! A Haply service that is not there: WebSocket, JSON, one answer for each message, hands on the handles.
//!
//! Everything is in the service's frame, the record and the hand's places too. A force holds for one tick, `--tick-ms`; then,
//! or at a message without a force for the device, it idles. That a connection was closed does not take the force away: only
//! the tick does, as the worse of the two cases.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use devices::{Workspace, Wrench};
use glam::{DQuat, DVec3};
use rhombus_doubles::{Event, HandArguments, Motors, PressingHand, Record, Signals, monotonic_ns};
use serde_json::{Value, json};
use tungstenite::{Message, WebSocket};

const USAGE: &str = "haply_double [--port N] [--devices ID,ID] [--grips ID,ID] [--service 3.5|3.4] [--tick-ms N] \
                     [--record FILE] [--unplug device|service] [--fault NAME [--fault-after MESSAGES]] [--attached yes|no] [hand options]; \
                     SIGUSR1 unplugs, SIGUSR2 plugs in again; attached, it ends with its standard input; only the first device has a hand and is recorded";
const STEP_NS: u64 = 500_000;
const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.4, height_m: 0.8 };

/// The grip turns about the service's y (forward) with this speed, rad/s, and has its buttons a and c pressed.
const GRIP_TURNS_RAD_PER_S: f64 = 0.5;

#[derive(Clone, Debug)]
struct Options {
    port: u16,
    devices: Vec<String>,
    grips: Vec<String>,
    /// 3.5 understands `vector` and tells the force; before it is `values`.
    is_3_5: bool,
    tick: Duration,
    record: Option<PathBuf>,
    unplugs_service: bool,
    fault: String,
    fault_after: usize,
    attached: bool,
    hand: HandArguments,
}

impl Options {
    fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Options, String> {
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

/// The recorded device.
struct Handle {
    hand: PressingHand,
    motors: Motors,
}

/// The service with all that is connected to it.
struct Service {
    options: Options,
    signals: Signals,
    handle: Mutex<Handle>,
    begin_ns: u64,
}

impl Service {
    fn handle(&self) -> std::sync::MutexGuard<'_, Handle> {
        self.handle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn fault(&self, sent: usize) -> &str {
        if sent >= self.options.fault_after { &self.options.fault } else { "" }
    }

    /// The force that a message has for the recorded device; none: the device is to idle.
    fn force(&self, request: &Value) -> Option<DVec3> {
        let id = self.options.devices.first()?;
        let arm = request["inverse3"].as_array()?.iter().find(|arm| arm["device_id"] == id.as_str())?;
        let key = if self.options.is_3_5 { "vector" } else { "values" };
        let force = &arm["commands"]["set_cursor_force"][key];
        Some(DVec3::new(force["x"].as_f64()?, force["y"].as_f64()?, force["z"].as_f64()?))
    }

    fn obey(&self, request: &Value) -> io::Result<()> {
        let now_ns = monotonic_ns();
        let mut handle = self.handle();
        match self.force(request) {
            Some(force_n) if !self.signals.unplugged() => {
                if !handle.motors.are_on() {
                    handle.motors.enable(now_ns)?;
                }
                handle.motors.command(now_ns, Wrench::of_force(force_n))
            }
            _ if handle.motors.are_on() => handle.motors.off(now_ns, Event::Off),
            _ => Ok(()),
        }
    }

    fn inventory(&self, with_config: bool, sent: usize) -> String {
        let arms: Vec<Value> = self
            .options
            .devices
            .iter()
            .filter(|_| !self.signals.unplugged() && self.fault(sent) != "no-device")
            .map(|id| self.arm(id, with_config, sent))
            .collect();
        let since_s = (monotonic_ns() - self.begin_ns) as f64 * 1e-9;
        let q = DQuat::from_rotation_y(GRIP_TURNS_RAD_PER_S * since_s);
        let grips: Vec<Value> = self
            .options
            .grips
            .iter()
            .map(|id| {
                json!({"device_id": id, "status": {"ready": true, "connected": true, "awake": true}, "state": {
                    "battery_level": 0.5, "hall": 16,
                    "orientation": {"x": q.x, "y": q.y, "z": q.z, "w": q.w},
                    "buttons": {"a": true, "b": false, "c": true}}})
            })
            .collect();
        let text = json!({"session_id": 7, "inverse3": arms, "verse_grip": [], "wireless_verse_grip": grips,
            "custom_verse_grip": grips})
        .to_string();
        match self.fault(sent) {
            "not-json" => "<html>".to_owned(),
            "other-json" => r#"{"name":"device-connected","category":"device"}"#.to_owned(),
            "legacy" => r#"{"inverse3":{"049D":{"state":{}}}}"#.to_owned(),
            "half" => text[..text.len() / 2].to_owned(),
            "no-number" => {
                text.replace("\"cursor_position\":{\"x\":", "\"cursor_position\":{\"x\":\"NaN\",\"w\":")
            }
            "too-large" => {
                text.replace("\"cursor_position\":{\"x\":", "\"cursor_position\":{\"x\":1e999,\"w\":")
            }
            _ => text,
        }
    }

    fn arm(&self, id: &str, with_config: bool, sent: usize) -> Value {
        let mut handle = self.handle();
        let is_recorded = self.options.devices.first().is_some_and(|first| first == id);
        let force_n =
            if is_recorded { handle.motors.wrench(monotonic_ns()).unwrap_or_default() } else { Wrench::ZERO };
        let is_on = is_recorded && handle.motors.are_on() && self.fault(sent) != "idle";
        let vector = |v: DVec3| json!({"x": v.x, "y": v.y, "z": v.z});
        let mut arm = json!({
            "device_id": id,
            "state": {
                "cursor_position": vector(handle.hand.position()),
                "cursor_velocity": vector(handle.hand.velocity()),
                "angular_position": {"a0": 0.0, "a1": 0.0, "a2": 0.0},
                "body_orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
                "control_domain": if is_on { "cartesian" } else { "undefined" },
                "control_mode": if is_on { "force" } else { "idle" },
            },
            "status": {"calibrated": self.fault(sent) != "uncalibrated", "in_use": is_on,
                "power_supply": self.fault(sent) != "no-power", "ready": true, "started": true},
        });
        if self.options.is_3_5 {
            arm["state"]["current_cursor_force"] = vector(force_n.force_n);
        }
        if with_config {
            let axes = if self.fault(sent) == "basis" { "XZY" } else { "XYZ" };
            arm["config"] = json!({"type": "inverse3", "port": "/dev/ttyACM0", "handedness": "right",
                "device_info": {"major_version": 7, "minor_version": 4, "id": id, "device_type": 4,
                    "uuid": format!("9AB19C4B5E655E32B4F00F8A59FD{id}")},
                "extended_firmware_version": "8C20FDC8", "basis": {"permutation": axes}});
            if self.options.is_3_5 {
                arm["config"]["preset"] = json!("defaults");
            }
        }
        arm
    }
}

/// Serves one connection until it ends.
fn serve(service: &Service, stream: TcpStream) -> Result<(), Box<dyn std::error::Error>> {
    stream.set_nodelay(true)?;
    if service.options.fault == "not-websocket" {
        (&stream).write_all(b"SSH-2.0-OpenSSH_9.6\r\n\r\n")?;
        return Ok(());
    }
    if service.options.fault == "mute" {
        std::thread::sleep(Duration::from_secs(3600));
    }
    let mut socket = tungstenite::accept(stream).map_err(|error| error.to_string())?;
    let mut sent = 0;
    let mut full = true;
    loop {
        // Some faults never come back.
        misbehave(&mut socket, service.fault(sent))?;
        socket.send(Message::text(service.inventory(full, sent)))?;
        sent += 1;
        let request = loop {
            match socket.read()? {
                Message::Text(text) => break serde_json::from_str::<Value>(&text)?,
                Message::Close(_) => return Ok(()),
                _ => {}
            }
        };
        if service.signals.unplugged() && service.options.unplugs_service {
            return Ok(());
        }
        full = request["session"]["force_render_full_state"].is_object();
        service.obey(&request)?;
    }
}

/// What no WebSocket library does by itself.
fn misbehave(socket: &mut WebSocket<TcpStream>, fault: &str) -> io::Result<()> {
    let stream = socket.get_mut();
    match fault {
        // One frame that says it has 2^40 bytes, and goes on.
        "endless" => {
            stream.write_all(&[0x81, 0x7f, 0, 0, 1, 0, 0, 0, 0, 0])?;
            loop {
                stream.write_all(&[b' '; 4096])?;
            }
        }
        // One message in ever more frames.
        "fragments" => {
            stream.write_all(&[0x01, 1, b' '])?;
            loop {
                let mut frame = [b' '; 128];
                [frame[0], frame[1]] = [0x00, 126 - 1];
                stream.write_all(&frame[..2 + 125])?;
            }
        }
        // A message of which a byte comes now and then.
        "drip" => {
            stream.write_all(&[0x81, 0x7e, 0xff, 0xff])?;
            loop {
                stream.write_all(b" ")?;
                std::thread::sleep(Duration::from_millis(5));
            }
        }
        "pings" => loop {
            stream.write_all(&[0x89, 0])?;
            std::thread::sleep(Duration::from_millis(1));
        },
        "silent" => loop {
            std::thread::sleep(Duration::from_secs(1));
        },
        "binary" => stream.write_all(&[0x82, 4, 0xff, 0xfe, 0xfd, 0xfc]),
        "close" => stream.shutdown(std::net::Shutdown::Both),
        _ => Ok(()),
    }
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options::parse(std::env::args().skip(1))?;
    let signals = Signals::install();
    let listener = TcpListener::bind(("127.0.0.1", options.port))?;
    let motors = Motors::new(Some(options.tick), Record::create(options.record.as_deref())?);
    let hand = PressingHand::new(options.hand, WORKSPACE, STEP_NS as f64 * 1e-9)?;
    let begin_ns = monotonic_ns();
    let mut ready = String::new();
    write!(ready, "ready: ws://127.0.0.1:{}", listener.local_addr()?.port())?;
    let attached = options.attached;
    let service =
        Arc::new(Service { options, signals, handle: Mutex::new(Handle { hand, motors }), begin_ns });
    let theirs = service.clone();
    std::thread::Builder::new().name("accept".to_owned()).spawn(move || {
        for stream in listener.incoming().flatten() {
            if theirs.signals.unplugged() && theirs.options.unplugs_service {
                continue;
            }
            let service = theirs.clone();
            // A connection that ends in an error ends; the service goes on.
            let served = move || drop(serve(&service, stream));
            let _ = std::thread::Builder::new().name("session".to_owned()).spawn(served);
        }
    })?;
    let left_alone = Arc::new(AtomicBool::new(false));
    if attached {
        let left_alone = left_alone.clone();
        std::thread::Builder::new().name("attached".to_owned()).spawn(move || {
            // An error is an end too.
            let _ = io::copy(&mut io::stdin(), &mut io::sink());
            left_alone.store(true, SeqCst);
        })?;
    }
    let mut out = io::stdout();
    writeln!(out, "{ready}")?;
    out.flush()?;
    let mut next_ns = begin_ns;
    while !signals.ended() && !left_alone.load(SeqCst) {
        next_ns += STEP_NS;
        {
            let mut handle = service.handle();
            if signals.unplugged() && handle.motors.are_on() {
                handle.motors.off(monotonic_ns(), Event::Gone)?;
            }
            let wrench = handle.motors.wrench(monotonic_ns())?;
            handle.hand.advance(wrench.force_n);
        }
        std::thread::sleep(Duration::from_nanos(next_ns.saturating_sub(monotonic_ns())));
    }
    Ok(())
}

fn main() {
    if let Err(error) = run() {
        eprintln!("haply_double: {error}");
        std::process::exit(2);
    }
    // Sessions may wait for a peer that says nothing.
    std::process::exit(0);
}
