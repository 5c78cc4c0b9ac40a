//! One connection, and what no WebSocket library does by itself.

use std::io::{self, Write};
use std::net::TcpStream;
use std::time::Duration;

use serde_json::Value;
use tungstenite::{Message, WebSocket};

use crate::service::Service;

/// Serves one connection until it ends.
pub(crate) fn serve(service: &Service, stream: TcpStream) -> Result<(), Box<dyn std::error::Error>> {
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
    let mut commands = false;
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
        service.obey(&request, &mut commands)?;
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
