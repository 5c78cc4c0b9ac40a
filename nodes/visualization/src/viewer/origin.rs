//! Who may talk to the server: pages that it served itself, and programs that are no browser.
//!
//! A page of another site may open a WebSocket to any address a browser can reach; its `Origin` gives it away. A name
//! that another site has pointed at this machine (DNS rebinding) would make origins agree; its `Host` gives it away.

use std::net::{IpAddr, SocketAddr};

use axum::http::header::{HOST, ORIGIN};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, HeaderName};

const LOOPBACK: [&str; 3] = ["localhost", "127.0.0.1", "[::1]"];
/// The port that an address without one means.
const HTTP_PORT: u16 = 80;

/// Where the page is served.
#[derive(Clone, Debug)]
pub(crate) struct Served {
    /// As the parameters name it.
    pub(crate) name: String,
    /// Where the server listens.
    pub(crate) address: SocketAddr,
}

impl Served {
    /// Whether a request with these headers may be answered.
    ///
    /// # Errors
    /// Why not, in a sentence.
    pub(crate) fn admits(&self, headers: &HeaderMap) -> Result<(), String> {
        let host = only(headers, &HOST)?.ok_or("Host is missing; one is accepted")?;
        let authority: Authority = host
            .parse()
            .map_err(|_| format!("Host {host:?} is no address; accepted: {}", self.accepted()))?;
        if authority.port_u16().unwrap_or(HTTP_PORT) != self.address.port() || !self.is_ours(authority.host())
        {
            return Err(format!("Host {host:?} is not this viewer's; accepted: {}", self.accepted()));
        }
        let Some(origin) = only(headers, &ORIGIN)? else { return Ok(()) };
        let of_origin = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
        match of_origin {
            Some(of_origin) if of_origin.eq_ignore_ascii_case(host) => Ok(()),
            _ => Err(format!(
                "Origin {origin:?} is another site's; accepted: http://{host}, or none from what is no browser"
            )),
        }
    }

    fn is_ours(&self, host: &str) -> bool {
        let literal = host.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>().ok();
        LOOPBACK.iter().any(|name| name.eq_ignore_ascii_case(host))
            || self.name.eq_ignore_ascii_case(host)
            || literal.is_some_and(|ip| {
                // At every address of the machine no name can be asked for, and an address cannot be rebound.
                self.address.ip().is_unspecified() || ip == self.address.ip()
            })
    }

    fn accepted(&self) -> String {
        let name = if self.name.contains(':') { format!("[{}]", self.name) } else { self.name.clone() };
        format!("{name}:{0} or localhost:{0}", self.address.port())
    }
}

/// A header that may be there once, as text.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Result<Option<&'a str>, String> {
    let mut values = headers.get_all(name).iter();
    let Some(value) = values.next() else { return Ok(None) };
    match (value.to_str(), values.next()) {
        (Ok(text), None) => Ok(Some(text)),
        _ => Err(format!("{name} is there twice or is no text; one is accepted")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn served(name: &str, address: &str) -> Served {
        Served { name: name.to_owned(), address: address.parse().unwrap() }
    }

    fn headers(pairs: &[(HeaderName, &str)]) -> HeaderMap {
        let mut headers = HeaderMap::new();
        for (name, value) in pairs {
            headers.append(name, value.parse().unwrap());
        }
        headers
    }

    #[test]
    fn the_configured_address_and_loopback_names_are_ours_and_nothing_else() {
        let viewer = served("viewer.lan", "192.168.1.5:8080");
        let admits = |host: &str| viewer.admits(&headers(&[(HOST, host)])).is_ok();
        for host in ["viewer.lan:8080", "Viewer.LAN:8080", "192.168.1.5:8080", "localhost:8080", "[::1]:8080"]
        {
            assert!(admits(host), "{host}");
        }
        for host in
            ["evil.example:8080", "viewer.lan", "viewer.lan:80", "192.168.1.6:8080", "", "a b", ":8080"]
        {
            assert!(!admits(host), "{host}");
        }
        assert!(viewer.admits(&HeaderMap::new()).unwrap_err().contains("Host"));
        let twice = headers(&[(HOST, "localhost:8080"), (HOST, "localhost:8080")]);
        assert!(viewer.admits(&twice).is_err());
    }

    #[test]
    fn at_every_address_of_the_machine_addresses_are_accepted_and_names_are_not() {
        let viewer = served("0.0.0.0", "0.0.0.0:80");
        assert!(viewer.admits(&headers(&[(HOST, "10.0.0.7")])).is_ok());
        assert!(viewer.admits(&headers(&[(HOST, "rebound.example")])).is_err());
    }

    #[test]
    fn a_page_of_another_site_is_refused() {
        let viewer = served("127.0.0.1", "127.0.0.1:8080");
        let admits = |origin: &str| viewer.admits(&headers(&[(HOST, "localhost:8080"), (ORIGIN, origin)]));
        assert_eq!(admits("http://localhost:8080"), Ok(()));
        for origin in
            ["http://evil.example", "http://localhost:8081", "null", "file://", "http://127.0.0.1:8080"]
        {
            assert!(admits(origin).unwrap_err().contains("Origin"), "{origin}");
        }
    }
}
