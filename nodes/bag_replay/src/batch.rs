//! Messages on their way to the file, many at a time.

use std::ops::Range;

/// Messages that were fetched together: their bytes lie behind each other in one piece of memory.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    bytes: Vec<u8>,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    topic: usize,
    log_time_ns: u64,
    place: Range<usize>,
}

impl Batch {
    /// Appends a message of a topic.
    pub(crate) fn push(&mut self, topic: usize, log_time_ns: u64, data: &[u8]) {
        let begin = self.bytes.len();
        self.bytes.extend_from_slice(data);
        self.entries.push(Entry { topic, log_time_ns, place: begin..self.bytes.len() });
    }

    /// Number of messages.
    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Memory of the messages.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes.len()
    }

    /// Puts the messages in the order in which they were received; equal times keep theirs.
    pub(crate) fn sort(&mut self) {
        self.entries.sort_by_key(|entry| entry.log_time_ns);
    }

    /// Topic, log time and content of each message.
    pub(crate) fn messages(&self) -> impl Iterator<Item = (usize, u64, &[u8])> {
        self.entries.iter().map(|entry| {
            let data = self.bytes.get(entry.place.clone()).unwrap_or_default();
            (entry.topic, entry.log_time_ns, data)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_different_topics_get_into_the_order_of_their_times_with_their_own_bytes() {
        let mut batch = Batch::default();
        for (topic, time, data) in [(0, 10, "a"), (0, 30, ""), (1, 20, "bcd"), (1, 10, "e")] {
            batch.push(topic, time, data.as_bytes());
        }
        batch.sort();
        let sorted: Vec<_> = batch.messages().collect();
        let expected: [(usize, u64, &[u8]); 4] =
            [(0, 10, b"a"), (1, 10, b"e"), (1, 20, b"bcd"), (0, 30, b"")];
        assert_eq!(sorted, expected);
        assert_eq!((batch.len(), batch.bytes()), (4, 5));
    }
}
