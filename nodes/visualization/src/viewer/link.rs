//! Between the node's thread and the server's: the present picture one way, newest wins; the pages' requests the other
//! way, bounded.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use crossbeam::channel::{Receiver, Sender, bounded};
use tokio::sync::{mpsc, watch};

use super::protocol::{self, Asked};

/// Requests of all pages that may wait for the node.
const REQUESTS: usize = 256;

/// A binary message and its number.
#[derive(Clone, Debug)]
pub(crate) struct Numbered {
    pub(crate) sequence: u32,
    pub(crate) bytes: Bytes,
}

/// A text and a number that grows when it changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Text {
    pub(crate) revision: u64,
    pub(crate) text: Utf8Bytes,
}

impl Text {
    /// Say something else from now on.
    pub(crate) fn set(&mut self, text: String) {
        self.revision += 1;
        self.text = text.into();
    }
}

/// Everything that a page shows, complete in itself: a page that comes late or reads slowly misses nothing but the past.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shown {
    pub(crate) hello: Utf8Bytes,
    pub(crate) chains: Text,
    pub(crate) parameters: Text,
    pub(crate) status: Text,
    pub(crate) mesh: Option<Numbered>,
    /// Belongs to the mesh beside it.
    pub(crate) surface: Option<Numbered>,
    pub(crate) state: Option<Numbered>,
}

/// What is said to one page alone.
#[derive(Debug)]
pub(crate) enum Told {
    Text(Utf8Bytes),
    /// The end, with its WebSocket code.
    Close(u16, &'static str),
}

/// One page, as the node knows it. Two are equal when they are the same connection.
#[derive(Clone, Debug)]
pub(crate) struct Page {
    pub(crate) id: u64,
    pub(crate) told: mpsc::Sender<Told>,
}

impl Page {
    /// Say something to this page alone, unless it reads so slowly that answers wait.
    pub(crate) fn tell(&self, text: String) {
        // A page that does not read its answers does without this one.
        let _ = self.told.try_send(Told::Text(text.into()));
    }

    pub(crate) fn refuse(&self, reason: &str) {
        self.tell(protocol::refused(reason));
    }

    pub(crate) fn is_gone(&self) -> bool {
        self.told.is_closed()
    }
}

impl PartialEq for Page {
    fn eq(&self, other: &Page) -> bool {
        self.id == other.id
    }
}

/// From a page to the node.
#[derive(Debug)]
pub(crate) enum Request {
    /// A page has come; its picture is due.
    Joined,
    /// It asks for something.
    Asked(Page, Asked),
}

/// What the server counts.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    /// Pages now.
    pub(crate) pages: AtomicUsize,
    /// Messages to pages.
    pub(crate) sent: AtomicU64,
    /// Updates that a page was too slow for.
    pub(crate) dropped: AtomicU64,
    /// Messages and connections that were not accepted.
    pub(crate) refused: AtomicU64,
}

impl Counts {
    pub(crate) fn one_more(counter: &AtomicU64) {
        counter.fetch_add(1, Ordering::Relaxed);
    }

    pub(crate) fn of(counter: &AtomicU64) -> u64 {
        counter.load(Ordering::Relaxed)
    }

    pub(crate) fn pages(&self) -> usize {
        self.pages.load(Ordering::Acquire)
    }
}

/// The node's end.
pub(crate) struct NodeEnd {
    pub(crate) shown: watch::Sender<Shown>,
    pub(crate) requests: Receiver<Request>,
    pub(crate) counts: Arc<Counts>,
}

/// The server's end.
#[derive(Clone, Debug)]
pub(crate) struct ServerEnd {
    pub(crate) shown: watch::Receiver<Shown>,
    pub(crate) requests: Sender<Request>,
    pub(crate) counts: Arc<Counts>,
}

/// Both ends.
pub(crate) fn link() -> (NodeEnd, ServerEnd) {
    let (shown, shown_there) = watch::channel(Shown::default());
    let (requests_there, requests) = bounded(REQUESTS);
    let counts = Arc::<Counts>::default();
    let server = ServerEnd { shown: shown_there, requests: requests_there, counts: counts.clone() };
    (NodeEnd { shown, requests, counts }, server)
}
