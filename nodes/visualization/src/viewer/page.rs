//! One page: what it is sent, what it may say, and when it is taken for gone.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use axum::body::Bytes;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, close_code};
use crossbeam::channel::TrySendError;
use futures::stream::{SplitSink, SplitStream};
use futures::{SinkExt, StreamExt};
use tokio::sync::mpsc;
use tokio::time::{MissedTickBehavior, interval, timeout};

use super::link::{Counts, Numbered, Page, Request, ServerEnd, Shown, Told};
use super::protocol::{self, Asked, MAX_FRAME};

/// Answers to one page that may wait for it.
const ANSWERS: usize = 64;
/// Refused messages after which a page is closed.
const MAX_REFUSED: u32 = 100;
/// Messages that a page may send in a second.
const MAX_RATE: u32 = 1000;
/// A page is asked this often whether it is still there.
const PING_PERIOD: Duration = Duration::from_secs(5);
/// A page that was silent for this long, or took this long for one message, is gone.
const PATIENCE: Duration = Duration::from_secs(30);
/// A page too many is told so within this time.
const FAREWELL: Duration = Duration::from_secs(2);

/// Where pages are received: there are only so many places.
#[derive(Clone, Debug)]
pub(crate) struct Hall {
    link: ServerEnd,
    max_pages: usize,
    ids: Arc<AtomicU64>,
}

impl Hall {
    pub(crate) fn new(link: ServerEnd, max_pages: usize) -> Hall {
        Hall { link, max_pages, ids: Arc::default() }
    }

    pub(crate) fn counts(&self) -> Arc<Counts> {
        self.link.counts.clone()
    }

    /// One page, from its first message to its end.
    pub(crate) async fn receive(self, socket: WebSocket) {
        let counts = self.counts();
        // One thread serves all pages: nobody else takes the last place in between.
        if counts.pages() >= self.max_pages {
            Counts::one_more(&counts.refused);
            let reason =
                format!("{} pages are open, and more are not served (viewer.max_pages)", self.max_pages);
            let _ = timeout(FAREWELL, farewell(socket, reason)).await;
            return;
        }
        counts.pages.fetch_add(1, Ordering::Release);
        let _place = Place(counts.clone());
        // A node that is too busy for this looks for new pages at its next turn anyway.
        let _ = self.link.requests.try_send(Request::Joined);
        let (told, answers) = mpsc::channel(ANSWERS);
        let page = Page { id: self.ids.fetch_add(1, Ordering::Relaxed), told };
        let (sink, stream) = socket.split();
        let mut reader =
            Reader { page, link: self.link.clone(), refused: 0, second: Instant::now(), heard: 0 };
        let writer = Writer { sink, link: self.link, seen: Seen::default() };
        tokio::select! {
            () = writer.write(answers) => {}
            () = reader.read(stream) => {}
        }
    }
}

/// A place in the hall, free again when it is dropped.
struct Place(Arc<Counts>);

impl Drop for Place {
    fn drop(&mut self) {
        self.0.pages.fetch_sub(1, Ordering::Release);
    }
}

async fn farewell(mut socket: WebSocket, reason: String) {
    let close = CloseFrame { code: close_code::AGAIN, reason: "no page is free".into() };
    // A page that has gone need not be told.
    let _ = socket.send(Message::Text(protocol::refused(&reason).into())).await;
    let _ = socket.send(Message::Close(Some(close))).await;
    while let Some(Ok(_)) = socket.recv().await {}
}

/// Numbers of what this page has been sent last.
#[derive(Debug, Default)]
struct Seen {
    chains: u64,
    parameters: u64,
    status: u64,
    mesh: Option<u32>,
    surface: Option<u32>,
    state: Option<u32>,
    dropped: u32,
}

/// Whether this is new to the page, which then has it.
fn is_new(seen: &mut Option<u32>, numbered: Option<&Numbered>) -> bool {
    numbered.is_some_and(|numbered| seen.replace(numbered.sequence) != Some(numbered.sequence))
}

/// Updates between the one that the page has and this one. What was before it came it does not miss.
fn missed(seen: Option<u32>, numbered: Option<&Numbered>) -> u32 {
    match (seen, numbered) {
        (Some(seen), Some(numbered)) => numbered.sequence.wrapping_sub(seen).saturating_sub(1),
        _ => 0,
    }
}

/// The page was not sent this message: it is gone, or takes too long.
struct Gone;

struct Writer {
    sink: SplitSink<WebSocket, Message>,
    link: ServerEnd,
    seen: Seen,
}

impl Writer {
    /// Send what is new to this page whenever something is, until the page is gone.
    async fn write(mut self, mut answers: mpsc::Receiver<Told>) {
        let mut pings = interval(PING_PERIOD);
        pings.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let first = self.link.shown.borrow_and_update().clone();
        let mut sent = match self.send(Message::Text(first.hello.clone())).await {
            Ok(()) => self.show(first).await,
            gone => gone,
        };
        while sent.is_ok() {
            sent = tokio::select! {
                biased;
                told = answers.recv() => match told {
                    Some(Told::Text(text)) => self.send(Message::Text(text)).await,
                    Some(Told::Close(code, reason)) => {
                        let close = CloseFrame { code, reason: reason.into() };
                        // The last message, whether or not it arrives. The reader ends the page.
                        let _ = self.send(Message::Close(Some(close))).await;
                        tokio::time::sleep(FAREWELL).await;
                        Err(Gone)
                    }
                    None => Err(Gone),
                },
                // Before the updates, of which a page that cannot keep up has always one more.
                _ = pings.tick() => self.send(Message::Ping(Bytes::new())).await,
                changed = self.link.shown.changed() => match changed {
                    Ok(()) => {
                        let shown = self.link.shown.borrow_and_update().clone();
                        self.show(shown).await
                    }
                    Err(_) => Err(Gone),
                },
            };
        }
    }

    async fn show(&mut self, shown: Shown) -> Result<(), Gone> {
        for (seen, text) in [
            (&mut self.seen.chains, &shown.chains),
            (&mut self.seen.parameters, &shown.parameters),
            (&mut self.seen.status, &shown.status),
        ] {
            if *seen != text.revision {
                *seen = text.revision;
                send(&mut self.sink, &self.link.counts, Message::Text(text.text.clone())).await?;
            }
        }
        self.count_dropped(&shown);
        if is_new(&mut self.seen.mesh, shown.mesh.as_ref())
            && let Some(mesh) = shown.mesh
        {
            self.send(Message::Binary(mesh.bytes)).await?;
        }
        if is_new(&mut self.seen.surface, shown.surface.as_ref())
            && let Some(surface) = shown.surface
        {
            self.send(Message::Binary(surface.bytes)).await?;
        }
        if is_new(&mut self.seen.state, shown.state.as_ref())
            && let Some(state) = shown.state
        {
            let bytes = protocol::at_page(&state.bytes, self.seen.dropped);
            self.send(Message::Binary(bytes.into())).await?;
        }
        Ok(())
    }

    /// Count the updates between what this page has and what is shown now. An old mesh is none: it misses nothing.
    fn count_dropped(&mut self, shown: &Shown) {
        let dropped =
            missed(self.seen.surface, shown.surface.as_ref()) + missed(self.seen.state, shown.state.as_ref());
        self.seen.dropped = self.seen.dropped.wrapping_add(dropped);
        self.link.counts.dropped.fetch_add(u64::from(dropped), Ordering::Relaxed);
    }

    async fn send(&mut self, message: Message) -> Result<(), Gone> {
        send(&mut self.sink, &self.link.counts, message).await
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        // What it was not sent any more, it did not get.
        let last = self.link.shown.borrow().clone();
        self.count_dropped(&last);
    }
}

async fn send(
    sink: &mut SplitSink<WebSocket, Message>,
    counts: &Counts,
    message: Message,
) -> Result<(), Gone> {
    match timeout(PATIENCE, sink.send(message)).await {
        Ok(Ok(())) => {
            Counts::one_more(&counts.sent);
            Ok(())
        }
        Ok(Err(_)) | Err(_) => Err(Gone),
    }
}

struct Reader {
    page: Page,
    link: ServerEnd,
    refused: u32,
    /// The second that is being counted, and what was heard in it.
    second: Instant,
    heard: u32,
}

impl Reader {
    /// Pass on what the page says until it ends, is silent for too long or says too much that is no sense.
    async fn read(&mut self, mut stream: SplitStream<WebSocket>) {
        while let Ok(Some(message)) = timeout(PATIENCE, stream.next()).await {
            let outcome = match message {
                Ok(Message::Text(text)) => self.take(&text).await,
                Ok(Message::Binary(bytes)) => {
                    Err(format!("{} bytes of binary; texts of the protocol are accepted", bytes.len()))
                }
                Ok(Message::Ping(_) | Message::Pong(_)) => Ok(()),
                Ok(Message::Close(_)) => return,
                Err(error) => {
                    // Where the next message begins can no longer be told.
                    let reason = format!("{error}; texts of at most {MAX_FRAME} bytes are accepted");
                    self.refuse(&reason).await;
                    return self.close(stream, close_code::SIZE, "this cannot be read").await;
                }
            };
            if let Err(reason) = outcome {
                self.refuse(&reason).await;
            }
            if self.refused >= MAX_REFUSED {
                return self.close(stream, close_code::POLICY, "100 messages were refused").await;
            }
        }
    }

    async fn take(&mut self, text: &Utf8Bytes) -> Result<(), String> {
        let now = Instant::now();
        if now.duration_since(self.second) >= Duration::from_secs(1) {
            (self.second, self.heard) = (now, 0);
        }
        self.heard += 1;
        if self.heard > MAX_RATE {
            return Err(format!("more than {MAX_RATE} messages in a second; fewer are accepted"));
        }
        let asked = match Asked::read(text)? {
            Asked::Ping { t } => {
                self.tell(protocol::pong(t)).await;
                return Ok(());
            }
            asked => asked,
        };
        match self.link.requests.try_send(Request::Asked(self.page.clone(), asked)) {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(_)) => Err("too many requests wait for the node; try again".to_owned()),
            Err(TrySendError::Disconnected(_)) => Err("the node is ending".to_owned()),
        }
    }

    /// Waits for a page that does not read its answers.
    async fn tell(&self, text: String) {
        // Closed: the page is gone, and the stream says so.
        let _ = self.page.told.send(Told::Text(text.into())).await;
    }

    async fn refuse(&mut self, reason: &str) {
        self.refused += 1;
        Counts::one_more(&self.link.counts.refused);
        self.tell(protocol::refused(reason)).await;
    }

    async fn close(&self, mut stream: SplitStream<WebSocket>, code: u16, reason: &'static str) {
        // What is not read would take the farewell back: a connection closed with bytes waiting is reset.
        let end = async {
            let _ = self.page.told.send(Told::Close(code, reason)).await;
            loop {
                match stream.next().await {
                    Some(Ok(Message::Close(_))) => break,
                    Some(Ok(_)) => {}
                    Some(Err(_)) | None => std::future::pending::<()>().await,
                }
            }
        };
        let _ = timeout(FAREWELL, end).await;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered(sequence: u32) -> Option<Numbered> {
        Some(Numbered { sequence, bytes: Bytes::new() })
    }

    #[test]
    fn updates_that_a_page_was_too_slow_for_are_counted() {
        let mut seen = None;
        assert_eq!(missed(seen, numbered(40).as_ref()), 0, "what was before it came is not missed");
        assert!(is_new(&mut seen, numbered(40).as_ref()));
        assert!(!is_new(&mut seen, numbered(40).as_ref()));
        assert_eq!([40, 41, 45].map(|n| missed(seen, numbered(n).as_ref())), [0, 0, 4]);
        assert!(is_new(&mut seen, numbered(45).as_ref()) && !is_new(&mut seen, None));
    }
}
