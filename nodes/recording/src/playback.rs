//! The order in which a replay sends messages.

use std::collections::BTreeSet;

use crate::error::Error;
use crate::order::{Merge, Spot};
use crate::qos::Durability;
use crate::reader::{Message, MessageRef, Recording};

/// What is played. The default is everything.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Playback {
    /// Numbers of the topics in [`Recording::topics`]; none means all.
    pub topics: Vec<usize>,
    /// Where it begins, ns after the first log time of the recording.
    pub start_ns: u64,
    /// How long it lasts, ns: messages logged later than that after the start stay out. `None`: to the end.
    pub duration_ns: Option<u64>,
}

/// The messages of a playback; see [`Recording::playback`].
pub struct PlaybackMessages<'a> {
    recording: &'a Recording,
    from_ns: u64,
    /// The latched topics alone, from the first log time on; `None` once they are sent.
    early: Option<Merge<'a>>,
    /// Latched topics of which nothing was found yet.
    silent: BTreeSet<usize>,
    /// Sent before their turn.
    sent_early: BTreeSet<Spot>,
    rest: Merge<'a>,
}

impl Recording {
    /// The order in which a replay sends: first, for every selected latched topic (`transient_local`), what it said before
    /// the start, or its first message where that comes later, because subscribers take these for granted; then everything
    /// else from the start by log time, equal times in stored order. No message comes twice.
    ///
    /// An item is an error where stored messages cannot be read; the iterator then goes on behind them.
    pub fn playback(&self, playback: &Playback) -> PlaybackMessages<'_> {
        let all: Vec<usize> = (0..self.topics().len()).collect();
        let topics = if playback.topics.is_empty() { &all } else { &playback.topics };
        let first_ns = self.log_time_bounds_ns().map_or(0, |(first, _)| first);
        let from_ns = first_ns.saturating_add(playback.start_ns);
        let to_ns = playback.duration_ns.map_or(u64::MAX, |duration| from_ns.saturating_add(duration));
        let is_latched = |topic: &&usize| {
            self.topics().get(**topic).is_some_and(|topic| {
                topic.message_count > 0
                    && topic
                        .topic
                        .offered_qos
                        .iter()
                        .any(|offer| offer.durability == Durability::TransientLocal)
            })
        };
        let latched: Vec<usize> = topics.iter().filter(is_latched).copied().collect();
        PlaybackMessages {
            recording: self,
            from_ns,
            early: (!latched.is_empty()).then(|| self.merge(&latched, 0, u64::MAX)),
            silent: latched.into_iter().collect(),
            sent_early: BTreeSet::new(),
            rest: self.merge(topics, from_ns, to_ns),
        }
    }
}

impl PlaybackMessages<'_> {
    /// The next message, still in its place: for whoever only looks at it.
    pub fn next_ref(&mut self) -> Option<Result<MessageRef<'_>, Error>> {
        let found = match self.whose_turn()? {
            Ok(Turn::Early) => self.early.as_mut()?.take(),
            Ok(Turn::Rest) => self.rest.take(),
            Err(error) => return Some(Err(error)),
        };
        found.map(|found| Ok(MessageRef::of(&found)))
    }

    /// Where the next message comes from.
    fn whose_turn(&mut self) -> Option<Result<Turn, Error>> {
        while let Some(early) = &mut self.early {
            match early.peek() {
                Some(Ok(next)) if next.log_time_ns < self.from_ns => {
                    self.silent.remove(&next.topic);
                    return Some(Ok(Turn::Early));
                }
                Some(Ok(next)) if self.silent.remove(&next.topic) => {
                    self.sent_early.insert(next.spot);
                    return Some(Ok(Turn::Early));
                }
                Some(Ok(_)) if !self.silent.is_empty() => early.skip(),
                // What lies behind the start is met again by the rest.
                Some(Err((block, error))) if self.recording.ends_before(block, self.from_ns) => {
                    return Some(Err(error));
                }
                Some(Err(_)) => {}
                Some(Ok(_)) | None => self.early = None,
            }
        }
        loop {
            match self.rest.peek()? {
                Ok(next) if self.sent_early.remove(&next.spot) => self.rest.skip(),
                Ok(_) => return Some(Ok(Turn::Rest)),
                Err((_, error)) => return Some(Err(error)),
            }
        }
    }
}

impl Iterator for PlaybackMessages<'_> {
    type Item = Result<Message, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(self.next_ref()?.map(MessageRef::to_message))
    }
}

enum Turn {
    Early,
    Rest,
}
