//! The line to the service: a WebSocket on which nothing waits beyond a deadline and no message is larger than
//! [`LONGEST_MESSAGE`], whatever the other end does.

use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};

use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, HandshakeError, Message, Utf8Bytes, WebSocket};

use super::BACKEND;
use crate::DeviceError;

/// The largest message taken, bytes. A device's whole inventory is about 2 kB.
pub(super) const LONGEST_MESSAGE: usize = 256 * 1024;
/// How long connecting, and each answer while opening, may take.
pub(super) const OPENING: Duration = Duration::from_secs(2);

/// A `ws://` address, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Address {
    url: String,
    /// `host:port`.
    authority: String,
}

impl Address {
    /// Reads `haply.url`.
    pub(super) fn parse(url: &str) -> Result<Address, DeviceError> {
        let refused = || DeviceError::Setting {
            name: "haply.url",
            value: format!("{url:?}"),
            accepted: "ws://HOST:PORT; the service's own is ws://localhost:10001".to_owned(),
        };
        let uri: tungstenite::http::Uri = url.parse().map_err(|_| refused())?;
        let (Some("ws"), Some(host), Some(port)) = (uri.scheme_str(), uri.host(), uri.port_u16()) else {
            return Err(refused());
        };
        Ok(Address { url: url.to_owned(), authority: format!("{host}:{port}") })
    }

    /// What to call it in a message.
    pub(super) fn url(&self) -> &str {
        &self.url
    }
}

/// Why the line gave no message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// It was closed.
    Closed,
    /// Nothing whole came before the deadline.
    Silent,
    /// A message was longer than [`LONGEST_MESSAGE`].
    TooLong,
    /// What came is no WebSocket text.
    Garbage,
}

impl Fault {
    /// In words.
    pub(super) fn reason(self) -> &'static str {
        match self {
            Fault::Closed => "its service closed the connection",
            Fault::Silent => "its service does not answer",
            Fault::TooLong => "its service sends a message without an end",
            Fault::Garbage => "its service sends what is no WebSocket text",
        }
    }
}

/// An open connection.
#[derive(Debug)]
pub(super) struct Line {
    socket: WebSocket<Bounded>,
}

impl Line {
    /// Connects.
    pub(super) fn open(address: &Address) -> Result<Line, DeviceError> {
        let stream = connect(address)?;
        let deadline = Instant::now() + OPENING;
        let config = WebSocketConfig::default()
            .read_buffer_size(16 * 1024)
            .write_buffer_size(0)
            .max_write_buffer_size(LONGEST_MESSAGE)
            .max_message_size(Some(LONGEST_MESSAGE))
            .max_frame_size(Some(LONGEST_MESSAGE));
        let opened = tungstenite::client::client_with_config(
            address.url(),
            Bounded { stream, deadline },
            Some(config),
        );
        match opened {
            Ok((socket, _)) => Ok(Line { socket }),
            Err(error) => {
                let why = match error {
                    HandshakeError::Failure(Error::Io(error)) if error.kind() == io::ErrorKind::TimedOut => {
                        "it says nothing".to_owned()
                    }
                    HandshakeError::Failure(error) => error.to_string(),
                    HandshakeError::Interrupted(_) => "it says nothing".to_owned(),
                };
                Err(DeviceError::Protocol {
                    device: BACKEND,
                    what: format!("what listens at {} is no WebSocket service ({why})", address.url()),
                    remedy: super::WHICH_PORT.to_owned(),
                })
            }
        }
    }

    /// Where the service is.
    pub(super) fn place(&self) -> Result<SocketAddr, DeviceError> {
        self.socket
            .get_ref()
            .stream
            .peer_addr()
            .map_err(|_| DeviceError::Lost { device: BACKEND, reason: Fault::Closed.reason() })
    }

    /// Sends one text.
    pub(super) fn send(&mut self, text: &str, deadline: Instant) -> Result<(), Fault> {
        self.socket.get_mut().deadline = deadline;
        self.socket.send(Message::text(text)).map_err(|error| fault(&error))
    }

    /// The next text.
    pub(super) fn receive(&mut self, deadline: Instant) -> Result<Utf8Bytes, Fault> {
        self.socket.get_mut().deadline = deadline;
        loop {
            match self.socket.read().map_err(|error| fault(&error))? {
                Message::Text(text) => return Ok(text),
                Message::Binary(bytes) => return Utf8Bytes::try_from(bytes).map_err(|_| Fault::Garbage),
                Message::Close(_) => return Err(Fault::Closed),
                // tungstenite answers a ping itself. Pings alone do not keep this waiting past the deadline.
                _ if Instant::now() >= deadline => return Err(Fault::Silent),
                _ => {}
            }
        }
    }

    /// Says goodbye. The other end may be gone.
    pub(super) fn close(mut self, deadline: Instant) {
        self.socket.get_mut().deadline = deadline;
        let _ = self.socket.close(None);
    }
}

fn connect(address: &Address) -> Result<TcpStream, DeviceError> {
    let not_found = |looked: String| DeviceError::NotFound {
        device: BACKEND,
        looked,
        remedy: super::START_SERVICE.to_owned(),
    };
    let places = address
        .authority
        .to_socket_addrs()
        .map_err(|error| not_found(format!("the host of {} is not known ({error})", address.url())))?;
    let mut why = "no address".to_owned();
    for place in places {
        match TcpStream::connect_timeout(&place, OPENING) {
            Ok(stream) => {
                // One small request, one small answer: waiting for more to send costs a delay each time.
                stream.set_nodelay(true).map_err(|error| not_found(error.to_string()))?;
                return Ok(stream);
            }
            Err(error) => why = error.to_string(),
        }
    }
    Err(not_found(format!("no service listens at {} ({why})", address.url())))
}

fn fault(error: &Error) -> Fault {
    match error {
        Error::Io(error) if error.kind() == io::ErrorKind::TimedOut => Fault::Silent,
        Error::Io(_) | Error::ConnectionClosed | Error::AlreadyClosed => Fault::Closed,
        Error::Protocol(tungstenite::error::ProtocolError::ResetWithoutClosingHandshake) => Fault::Closed,
        Error::Capacity(_) => Fault::TooLong,
        _ => Fault::Garbage,
    }
}

/// A stream on which no call waits beyond the deadline. A time limit for one call would not do: a peer that sends a byte
/// now and then would keep a message going for ever.
#[derive(Debug)]
struct Bounded {
    stream: TcpStream,
    deadline: Instant,
}

impl Bounded {
    fn left(&self) -> io::Result<Duration> {
        let left = self.deadline.saturating_duration_since(Instant::now());
        if left.is_zero() { Err(io::ErrorKind::TimedOut.into()) } else { Ok(left) }
    }
}

impl Read for Bounded {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            self.stream.set_read_timeout(Some(self.left()?))?;
            match self.stream.read(buffer) {
                // What a socket's time limit says; the deadline is looked at again above.
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                done => return done,
            }
        }
    }
}

impl Write for Bounded {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        loop {
            self.stream.set_write_timeout(Some(self.left()?))?;
            match self.stream.write(buffer) {
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                done => return done,
            }
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_websocket_address_with_a_port_is_accepted() {
        assert_eq!(Address::parse("ws://localhost:10001").unwrap().authority, "localhost:10001");
        assert_eq!(Address::parse("ws://[::1]:10001/x").unwrap().authority, "[::1]:10001");
        for url in [
            "",
            "localhost:10001",
            "http://localhost:10001",
            "wss://localhost:1",
            "ws://localhost",
            "ws://h:0x",
        ] {
            let text = Address::parse(url).unwrap_err().to_string();
            assert!(text.contains("haply.url") && text.contains("ws://HOST:PORT"), "{text}");
        }
    }
}
