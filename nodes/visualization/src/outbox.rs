//! Which drawings must be sent: what changed, what a new reader has not seen, what is to be removed.
//!
//! RViz keeps a marker until it is replaced or deleted and asks for none when it joins. So a drawing is sent when it
//! changed and otherwise once a second, and one that no longer belongs to the picture is deleted.

use std::time::{Duration, Instant};

use crate::drawing::Key;

/// A drawing that does not change is sent this often, for readers that joined unnoticed.
const REPEAT: Duration = Duration::from_secs(1);

/// What the readers have.
#[derive(Debug, Default)]
pub(crate) struct Outbox {
    shown: Vec<Shown>,
}

#[derive(Debug)]
struct Shown {
    key: Key,
    revision: u64,
    /// None: must be sent.
    sent: Option<Instant>,
    in_picture: bool,
}

impl Outbox {
    /// Everything is to be sent again: somebody new reads, or everything looks different.
    pub(crate) fn repeat_all(&mut self) {
        for shown in &mut self.shown {
            shown.sent = None;
        }
    }

    /// A drawing belongs to the present picture. True when it must be sent; it then counts as sent.
    pub(crate) fn wants(&mut self, key: Key, revision: u64, now: Instant) -> bool {
        let Some(shown) = self.shown.iter_mut().find(|shown| shown.key == key) else {
            self.shown.push(Shown { key, revision, sent: Some(now), in_picture: true });
            return true;
        };
        shown.in_picture = true;
        let fresh = shown.sent.is_some_and(|sent| now.duration_since(sent) < REPEAT);
        if shown.revision == revision && fresh {
            return false;
        }
        (shown.revision, shown.sent) = (revision, Some(now));
        true
    }

    /// The picture is complete: what was in the last one and is not in this one is to be deleted.
    pub(crate) fn finish(&mut self) -> Vec<Key> {
        let gone = self.shown.iter().filter(|shown| !shown.in_picture).map(|shown| shown.key).collect();
        self.shown.retain_mut(|shown| std::mem::take(&mut shown.in_picture));
        gone
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Thing;

    const BODY: Key = Key { thing: Thing::Body, id: 0 };
    const PROXY: Key = Key { thing: Thing::Proxy, id: 0 };

    #[test]
    fn an_unchanged_drawing_is_sent_once_a_second() {
        let (mut outbox, start) = (Outbox::default(), Instant::now());
        let mut sent = Vec::new();
        for turn in 0..90 {
            if outbox.wants(BODY, 7, start + turn * Duration::from_millis(33)) {
                sent.push(turn);
            }
            assert!(outbox.finish().is_empty());
        }
        assert_eq!(sent, [0, 31, 62]);
    }

    #[test]
    fn a_changed_drawing_and_one_for_a_new_reader_is_sent_at_once() {
        let (mut outbox, now) = (Outbox::default(), Instant::now());
        assert!(outbox.wants(BODY, 1, now));
        assert!(!outbox.wants(BODY, 1, now));
        assert!(outbox.wants(BODY, 2, now));
        outbox.repeat_all();
        assert!(outbox.wants(BODY, 2, now));
        assert!(!outbox.wants(BODY, 2, now));
    }

    #[test]
    fn what_leaves_the_picture_is_deleted_once_and_may_come_back() {
        let (mut outbox, now) = (Outbox::default(), Instant::now());
        outbox.wants(BODY, 1, now);
        outbox.wants(PROXY, 1, now);
        assert!(outbox.finish().is_empty());
        outbox.wants(BODY, 1, now);
        assert_eq!(outbox.finish(), [PROXY]);
        outbox.wants(BODY, 1, now);
        assert!(outbox.finish().is_empty());
        assert!(outbox.wants(PROXY, 1, now));
    }
}
