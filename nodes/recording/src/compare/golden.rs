//! Hands out the golden messages of each topic in their order, reading the recording once.
//!
//! One stream of all compared topics feeds a queue for each of them. When computed messages of one topic stay away, its
//! queue fills; at a bound it lets go of the common stream and reads on by itself later. Memory is bounded either way.

use std::collections::VecDeque;

use super::pairing::LOOK_AHEAD_BYTES;
use super::peek;
use crate::{Message, Messages, Recording};

/// Bytes a topic may have waiting, while another one is read, before it leaves the common stream.
const MOST_QUEUED_BYTES: usize = LOOK_AHEAD_BYTES;
/// What a message costs beyond its bytes.
const OVERHEAD_BYTES: usize = 48;
/// Reasons that are kept; the others are counted.
const MOST_REASONS: usize = 5;

/// A message that waits to be compared.
#[derive(Debug)]
pub(super) struct Waiting {
    /// Which message of its topic this is, from 0.
    pub(super) index: u64,
    pub(super) stamp_ns: i64,
    pub(super) data: Vec<u8>,
}

/// The golden messages of the compared topics.
pub(super) struct Golden<'a> {
    recording: &'a Recording,
    common: Messages<'a>,
    /// By topic of the recording.
    slot_of_topic: Vec<Option<usize>>,
    slots: Vec<Slot<'a>>,
    /// What could not be read from the recording.
    pub(super) damage: Reasons,
}

#[derive(Default)]
struct Slot<'a> {
    /// Topics of the recording; empty when it has none for this slot.
    topics: Vec<usize>,
    queue: VecDeque<Waiting>,
    queued_bytes: usize,
    /// Messages that came, readable or not.
    seen: u64,
    /// Messages that are too short or of another encoding.
    unreadable: Reasons,
    left_common: bool,
    ended: bool,
    own: Option<Messages<'a>>,
}

/// The first few of many reasons.
#[derive(Debug, Default)]
pub(super) struct Reasons {
    first: Vec<String>,
    count: u64,
}

impl<'a> Golden<'a> {
    /// A slot for each of `slots`, which lists topics of the recording.
    pub(super) fn new(recording: &'a Recording, slots: Vec<Vec<usize>>) -> Self {
        let mut slot_of_topic = vec![None; recording.topics().len()];
        for (slot, topics) in slots.iter().enumerate() {
            for topic in topics {
                if let Some(place) = slot_of_topic.get_mut(*topic) {
                    *place = Some(slot);
                }
            }
        }
        let mut damage = Reasons::default();
        recording.damage().iter().for_each(|error| damage.add(|| error.to_string()));
        let common = recording.messages_of(&slots.concat());
        let slots = slots.into_iter().map(|topics| Slot { topics, ..Slot::default() }).collect();
        Self { recording, common, slot_of_topic, slots, damage }
    }

    /// The next messages of a slot, as many as are wanted where there are as many and they are not too large.
    pub(super) fn ahead(&mut self, slot: usize, wanted: usize) -> &VecDeque<Waiting> {
        static NOTHING: VecDeque<Waiting> = VecDeque::new();
        while self.slots.get(slot).is_some_and(|slot| slot.wants(wanted)) {
            if !self.pull(slot)
                && let Some(slot) = self.slots.get_mut(slot)
            {
                slot.ended = true;
            }
        }
        self.slots.get(slot).map_or(&NOTHING, |slot| &slot.queue)
    }

    /// Whether nothing comes behind the messages of [`Self::ahead`].
    pub(super) fn ended(&self, slot: usize) -> bool {
        self.slots.get(slot).is_none_or(|slot| slot.ended)
    }

    /// Takes the next message of a slot.
    pub(super) fn pop(&mut self, slot: usize) -> Option<Waiting> {
        if self.ahead(slot, 1).is_empty() {
            return None;
        }
        let slot = self.slots.get_mut(slot)?;
        let message = slot.queue.pop_front()?;
        slot.queued_bytes -= message.data.len() + OVERHEAD_BYTES;
        Some(message)
    }

    /// Messages of a slot that came so far.
    pub(super) fn seen(&self, slot: usize) -> u64 {
        self.slots.get(slot).map_or(0, |slot| slot.seen)
    }

    /// Messages of a slot whose stamp cannot be read.
    pub(super) fn unreadable(&self, slot: usize) -> Option<String> {
        self.slots.get(slot)?.unreadable.said("not readable in the golden recording")
    }

    /// Reads until a message of `wanted` came; `false` at the end.
    fn pull(&mut self, wanted: usize) -> bool {
        let Some(slot) = self.slots.get_mut(wanted) else { return false };
        if slot.topics.is_empty() {
            return false;
        }
        if slot.left_common {
            return slot.pull_own(self.recording);
        }
        loop {
            let message = match self.common.next() {
                None => return false,
                Some(Err(error)) => {
                    self.damage.add(|| error.to_string());
                    continue;
                }
                Some(Ok(message)) => message,
            };
            let owner = self.slot_of_topic.get(message.topic).copied().flatten();
            let Some((owner, slot)) = owner.and_then(|owner| Some((owner, self.slots.get_mut(owner)?)))
            else {
                continue;
            };
            if slot.left_common {
                continue;
            }
            let is_queued = slot.push(message);
            if owner == wanted && is_queued {
                return true;
            }
            slot.left_common = owner != wanted && slot.queued_bytes > MOST_QUEUED_BYTES;
        }
    }
}

impl<'a> Slot<'a> {
    fn wants(&self, wanted: usize) -> bool {
        !self.ended
            && self.queue.len() < wanted
            && (self.queue.is_empty() || self.queued_bytes < LOOK_AHEAD_BYTES)
    }

    /// Whether the message has a stamp.
    fn push(&mut self, message: Message) -> bool {
        let index = self.seen;
        self.seen += 1;
        let Some(stamp_ns) = peek::stamp_ns(&message.data) else {
            self.unreadable.add(|| {
                let Message { log_time_ns, data, .. } = &message;
                format!(
                    "message #{index} (log time {log_time_ns} ns): {} bytes without a stamp in CDR",
                    data.len()
                )
            });
            return false;
        };
        self.queued_bytes += message.data.len() + OVERHEAD_BYTES;
        self.queue.push_back(Waiting { index, stamp_ns, data: message.data });
        true
    }

    fn pull_own(&mut self, recording: &'a Recording) -> bool {
        if self.own.is_none() {
            let mut messages = recording.messages_of(&self.topics);
            // What cannot be read was noted in the common stream.
            let mut skipped = 0;
            while skipped < self.seen {
                match messages.next() {
                    Some(message) => skipped += u64::from(message.is_ok()),
                    None => break,
                }
            }
            self.own = Some(messages);
        }
        while let Some(message) = self.own.as_mut().and_then(Iterator::next) {
            if let Ok(message) = message
                && self.push(message)
            {
                return true;
            }
        }
        false
    }
}

impl Reasons {
    pub(super) fn add(&mut self, reason: impl FnOnce() -> String) {
        self.count += 1;
        if self.first.len() < MOST_REASONS {
            self.first.push(reason());
        }
    }

    /// One sentence, if there is anything to say.
    pub(super) fn said(&self, what: &str) -> Option<String> {
        let more = self.count - self.first.len() as u64;
        let rest = if more > 0 { format!("; and {more} more") } else { String::new() };
        (self.count > 0).then(|| format!("{what}: {}{rest}", self.first.join("; ")))
    }
}
