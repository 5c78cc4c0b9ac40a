//! The server: one thread, HTTP/1.1, the page's files and its WebSocket. Bounded in every direction.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs, UdpSocket};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use axum::Router;
use axum::extract::{Request as HttpRequest, State, WebSocketUpgrade};
use axum::http::header::{CONTENT_SECURITY_POLICY, HOST};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use thiserror::Error;
use tokio::net::{TcpListener, TcpSocket, TcpStream};
use tokio::sync::{Semaphore, oneshot};
use tokio::time::timeout;

use super::assets::ASSETS;
use super::link::{Counts, ServerEnd};
use super::origin::Served;
use super::page;
use super::protocol::MAX_FRAME;
use super::refusal::refuse;

/// Connections that are not pages: browsers open a handful each.
const CONNECTIONS: usize = 64;
/// Connections that are being told that there are too many.
const REFUSALS: usize = 128;
/// Connections that the kernel keeps until they are accepted.
const BACKLOG: u32 = 1024;
/// A request that is not complete after this time, or not begun, ends its connection.
const HEADER_TIMEOUT: Duration = Duration::from_secs(10);
/// No connection that is not a page lasts longer: one that does not read its files would stay for ever.
const CONNECTION_TIMEOUT: Duration = Duration::from_secs(120);
/// Bytes that the kernel keeps for a page that reads slowly; more would only be older.
const SEND_BUFFER: u32 = 256 * 1024;
/// A request's head is not longer than this, bytes.
const MAX_HEAD: usize = 16 * 1024;

/// What a browser may do with an answer, besides the content security policy.
const HEADERS: [(&str, &str); 3] = [
    ("x-content-type-options", "nosniff"),
    ("referrer-policy", "no-referrer"),
    ("cross-origin-resource-policy", "same-origin"),
];

/// Why no page is served. The system's reason stands in the sentence, and is no `source` that would repeat it.
#[derive(Debug, Error)]
pub(crate) enum ServerError {
    #[error(
        "viewer.address: {address:?} is no address of this machine: {cause}; accepted: one that it has, or its name"
    )]
    Address { address: String, cause: io::Error },
    #[error(
        "viewer.port: {port} at {address} is taken by another program; {free} is free; 0 takes any that is, and \
         viewer.enabled: false serves no page"
    )]
    Taken { address: String, port: u16, free: String },
    #[error("the viewer cannot serve {address}: {cause}")]
    Listen { address: SocketAddr, cause: io::Error },
    #[error("the viewer's thread cannot start: {0}")]
    Thread(io::Error),
}

/// Serves until it is dropped.
pub(crate) struct Server {
    address: SocketAddr,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// Listen and serve, in a thread of its own.
    pub(crate) fn start(
        name: &str,
        port: u16,
        max_pages: usize,
        link: ServerEnd,
    ) -> Result<Server, ServerError> {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .map_err(ServerError::Thread)?;
        let listener = runtime.block_on(async { listen(name, port) })?;
        let address = listener.local_addr().map_err(ServerError::Thread)?;
        let served = Arc::new(Served { name: name.to_owned(), address });
        let router = router(served, page::Hall::new(link.clone(), max_pages));
        let (stop, stopped) = oneshot::channel();
        let serve = move || {
            runtime.block_on(async {
                tokio::select! {
                    () = accept(listener, router, link.counts) => {}
                    _ = stopped => {}
                }
            });
        };
        let thread = std::thread::Builder::new()
            .name("viewer".to_owned())
            .spawn(serve)
            .map_err(ServerError::Thread)?;
        Ok(Server { address, stop: Some(stop), thread: Some(thread) })
    }

    /// Where a browser on this machine finds the page.
    pub(crate) fn url(&self) -> String {
        url(here(self.address))
    }

    /// Where browsers on other machines find it, in words; none at one address, which says it itself.
    pub(crate) fn for_other_machines(&self) -> Option<String> {
        self.address.ip().is_unspecified().then(|| match address_to_others(self.address) {
            Some(ip) => format!("from other machines {}", url(SocketAddr::new(ip, self.address.port()))),
            None => {
                format!("from other machines at an IP address of this machine, port {}", self.address.port())
            }
        })
    }
}

fn url(address: SocketAddr) -> String {
    format!("http://{address}/")
}

/// Every address of the machine is none that a browser could open; its own is one of them.
fn here(address: SocketAddr) -> SocketAddr {
    let loopback: IpAddr =
        if address.is_ipv4() { Ipv4Addr::LOCALHOST.into() } else { Ipv6Addr::LOCALHOST.into() };
    if address.ip().is_unspecified() { SocketAddr::new(loopback, address.port()) } else { address }
}

/// The address with which this machine speaks to other networks; none where it has no way to one.
fn address_to_others(address: SocketAddr) -> Option<IpAddr> {
    // Addresses of documentation: nothing is sent, the kernel only looks up the way.
    let far: IpAddr = if address.is_ipv4() {
        Ipv4Addr::new(192, 0, 2, 1).into()
    } else {
        Ipv6Addr::new(0x2001, 0xdb8, 0, 0, 0, 0, 0, 1).into()
    };
    let socket = UdpSocket::bind((address.ip(), 0)).ok()?;
    socket.connect((far, 9)).ok()?;
    let ip = socket.local_addr().ok()?.ip();
    (!ip.is_unspecified() && !ip.is_loopback()).then_some(ip)
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            // It has no more to say: its pages see the connection end.
            let _ = thread.join();
        }
    }
}

fn listen(name: &str, port: u16) -> Result<TcpListener, ServerError> {
    let no_address = |cause| ServerError::Address { address: name.to_owned(), cause };
    let mut addresses = (name, port).to_socket_addrs().map_err(no_address)?;
    let address = addresses.next().ok_or_else(|| no_address(io::ErrorKind::AddrNotAvailable.into()))?;
    match bind(address) {
        Ok(listener) => Ok(listener),
        Err(error) if error.kind() == io::ErrorKind::AddrInUse => {
            let free = (port.saturating_add(1)..=port.saturating_add(100))
                .chain([0])
                .filter_map(|port| bind(SocketAddr::new(address.ip(), port)).ok()?.local_addr().ok())
                .map(|free| free.port().to_string());
            let free = { free }.next().unwrap_or_else(|| "none near it".to_owned());
            Err(ServerError::Taken { address: name.to_owned(), port, free })
        }
        Err(error) if error.kind() == io::ErrorKind::AddrNotAvailable => Err(no_address(error)),
        Err(cause) => Err(ServerError::Listen { address, cause }),
    }
}

fn bind(address: SocketAddr) -> io::Result<TcpListener> {
    let socket = if address.is_ipv4() { TcpSocket::new_v4() } else { TcpSocket::new_v6() }?;
    // A node that starts again need not wait for the connections of the one before to be forgotten.
    socket.set_reuseaddr(true)?;
    socket.set_send_buffer_size(SEND_BUFFER)?;
    socket.bind(address)?;
    socket.listen(BACKLOG)
}

async fn accept(listener: TcpListener, router: Router, counts: Arc<Counts>) {
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    let refusals = Arc::new(Semaphore::new(REFUSALS));
    loop {
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            Err(_) => {
                // Out of file descriptors, most likely: some will be closed.
                tokio::time::sleep(Duration::from_millis(50)).await;
                continue;
            }
        };
        // Small messages at once; a kernel that cannot is merely slower.
        let _ = stream.set_nodelay(true);
        if let Ok(place) = places.clone().try_acquire_owned() {
            let router = router.clone();
            tokio::spawn(async move {
                serve(stream, router).await;
                drop(place);
            });
        } else if let Ok(place) = refusals.clone().acquire_owned().await {
            Counts::one_more(&counts.refused);
            tokio::spawn(async move {
                refuse(stream, &format!("more than {CONNECTIONS} connections at once; try again later"))
                    .await;
                drop(place);
            });
        }
    }
}

/// One connection until it ends or becomes a page.
async fn serve(stream: TcpStream, router: Router) {
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEADER_TIMEOUT)
        .max_buf_size(MAX_HEAD)
        .serve_connection(TokioIo::new(stream), TowerToHyperService::new(router))
        .with_upgrades();
    // However it ends, the other side knows.
    let _ = timeout(CONNECTION_TIMEOUT, connection).await;
}

fn router(served: Arc<Served>, hall: page::Hall) -> Router {
    let files = ASSETS.iter().flat_map(|asset| asset.paths.iter().map(move |path| (*path, asset)));
    let files = files.fold(Router::new(), |router, (path, asset)| {
        router.route(path, get(move |headers: HeaderMap| async move { asset.answer(&headers) }))
    });
    let guard = (served, hall.counts());
    files.route("/ws", get(open)).with_state(hall).layer(from_fn_with_state(guard, admit))
}

/// Lets in who may come in, and says with every answer what a browser may do with it.
async fn admit(
    State((served, counts)): State<(Arc<Served>, Arc<Counts>)>,
    request: HttpRequest,
    next: Next,
) -> Response {
    let host = request.headers().get(HOST).cloned();
    let mut response = match served.admits(request.headers()) {
        Ok(()) => next.run(request).await,
        Err(reason) => {
            Counts::one_more(&counts.refused);
            (StatusCode::FORBIDDEN, format!("{reason}\n")).into_response()
        }
    };
    let is_admitted = response.status() != StatusCode::FORBIDDEN;
    let headers = response.headers_mut();
    for (name, value) in HEADERS {
        headers.insert(HeaderName::from_static(name), HeaderValue::from_static(value));
    }
    let host = host.filter(|_| is_admitted);
    headers.insert(CONTENT_SECURITY_POLICY, policy(host.as_ref().and_then(|host| host.to_str().ok())));
    response
}

/// The page needs its own script, style and icon, and its WebSocket, which not every browser counts as its own.
fn policy(host: Option<&str>) -> HeaderValue {
    const NOTHING: &str = "default-src 'none'";
    let policy = host.map(|host| {
        format!(
            "{NOTHING}; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self' ws://{host}; \
             base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
    });
    policy.and_then(|policy| policy.try_into().ok()).unwrap_or(HeaderValue::from_static(NOTHING))
}

/// A page opens its WebSocket.
async fn open(State(hall): State<page::Hall>, upgrade: WebSocketUpgrade) -> Response {
    upgrade
        .max_message_size(MAX_FRAME)
        .max_frame_size(MAX_FRAME)
        .on_upgrade(move |socket| async move { hall.receive(socket).await })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn served_everywhere_a_browser_is_sent_to_this_machine_and_served_at_an_address_to_that() {
        for (address, browser) in [
            ("0.0.0.0:8080", "http://127.0.0.1:8080/"),
            ("[::]:8080", "http://[::1]:8080/"),
            ("192.168.1.5:80", "http://192.168.1.5:80/"),
        ] {
            assert_eq!(url(here(address.parse().unwrap())), browser);
        }
    }
}
