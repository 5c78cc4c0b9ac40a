//! The order of the stamps in the headers of a topic's messages.

use serde::Serialize;

use crate::messages::Time;

/// How the stamps of a topic follow each other in stored order.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct StampOrder {
    /// Equal to the one before.
    pub repeats: u64,
    /// Earlier than the one before.
    pub back: u64,
    /// Zero: never filled in. Not compared with others.
    pub zeros: u64,
    /// Nanoseconds of a second or more, or before 1970: no moment.
    pub invalid: u64,
    /// The first of them all: number of the message in its topic, from 1.
    pub first_at: Option<u64>,
    #[serde(skip)]
    last_ns: Option<i128>,
}

impl StampOrder {
    /// `number` counts the messages of the topic from 1.
    pub(super) fn take(&mut self, number: u64, stamp: &Time) {
        let last_ns = self.last_ns;
        let stamp_ns = i128::from(stamp.sec) * 1_000_000_000 + i128::from(stamp.nanosec);
        let counter = if stamp.sec < 0 || stamp.nanosec >= 1_000_000_000 {
            &mut self.invalid
        } else if stamp_ns == 0 {
            &mut self.zeros
        } else {
            self.last_ns = Some(stamp_ns);
            match last_ns {
                Some(last) if stamp_ns == last => &mut self.repeats,
                Some(last) if stamp_ns < last => &mut self.back,
                _ => return,
            }
        };
        *counter += 1;
        self.first_at.get_or_insert(number);
    }

    /// `3 repeat, 1 jumps back`; `None` when each stamp is later than the one before.
    pub fn oddities(&self) -> Option<String> {
        let first_at = self.first_at?;
        let named = [
            (self.repeats, "repeat the one before"),
            (self.back, "jump back"),
            (self.zeros, "are zero"),
            (self.invalid, "are no moment since 1970"),
        ];
        let parts = named.iter().filter(|(count, _)| *count > 0);
        let parts: Vec<_> = parts.map(|(count, what)| format!("{count} {what}")).collect();
        Some(format!("{}; the first is that of message {first_at}", parts.join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeats_jumps_and_zeros_are_told_apart_and_the_first_is_named() {
        let mut order = StampOrder::default();
        let stamps = [(1, 0), (1, 5), (1, 5), (0, 0), (1, 4), (1, 6), (2, 1_000_000_000), (-1, 0), (2, 0)];
        for (number, (sec, nanosec)) in (1..).zip(stamps) {
            order.take(number, &Time { sec, nanosec });
        }
        assert_eq!((order.repeats, order.back, order.zeros, order.invalid), (1, 1, 1, 2));
        assert_eq!(order.first_at, Some(3));
        let said = order.oddities().unwrap();
        assert!(said.contains("1 jump back") && said.contains("message 3"), "{said}");
    }

    #[test]
    fn growing_stamps_are_nothing_to_speak_of() {
        let mut order = StampOrder::default();
        (1..9).for_each(|number| order.take(number, &Time { sec: number as i32, nanosec: 0 }));
        assert_eq!(order.oddities(), None);
    }
}
