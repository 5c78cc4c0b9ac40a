//! Commands on their way out. The newest wins, but a frame that is partly sent is finished first.

use super::wire::{COMMAND_FRAME, Frame};

/// The most commands waiting: one partly sent, and a pair.
const PLACES: usize = 3;

/// Bytes that the line has not taken yet, all of whole commands but for the beginning. RT safe.
#[derive(Clone, Debug)]
pub(super) struct Outbox {
    bytes: [u8; PLACES * COMMAND_FRAME],
    length: usize,
    sent: usize,
}

impl Outbox {
    pub(super) fn new() -> Outbox {
        Outbox { bytes: [0; PLACES * COMMAND_FRAME], length: 0, sent: 0 }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.sent == self.length
    }

    pub(super) fn rest(&self) -> &[u8] {
        &self.bytes[self.sent..self.length]
    }

    /// Notes that the line took `count` bytes of the rest.
    pub(super) fn took(&mut self, count: usize) {
        self.sent = (self.sent + count).min(self.length);
    }

    /// Puts commands, at most two, in place of those of which nothing was sent.
    pub(super) fn replace(&mut self, commands: &[Frame]) {
        // Every command has the same length, so frames begin at its multiples.
        let unfinished = (COMMAND_FRAME - self.sent % COMMAND_FRAME) % COMMAND_FRAME;
        // The part that is sent stays in front of the rest, so that the multiples stay the beginnings.
        self.bytes.copy_within(self.sent..self.sent + unfinished, COMMAND_FRAME - unfinished);
        let (mut end, sent) = match unfinished {
            0 => (0, 0),
            _ => (COMMAND_FRAME, COMMAND_FRAME - unfinished),
        };
        for command in commands.iter().take(PLACES - 1) {
            let bytes = command.bytes();
            self.bytes[end..end + bytes.len()].copy_from_slice(bytes);
            end += bytes.len();
        }
        (self.length, self.sent) = (end, sent);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::serial::wire::{Command, Message, Receiver};
    use proptest::prelude::*;

    fn command(sequence: u16) -> Frame {
        Command { sequence, force_n: [f32::from(sequence), 0.0, -1.0], ..Command::default() }.frame()
    }

    #[test]
    fn a_command_has_the_length_that_the_outbox_counts_with() {
        assert_eq!(command(0).bytes().len(), COMMAND_FRAME);
        assert_eq!(command(0xffff).bytes().len(), COMMAND_FRAME);
    }

    proptest! {
        #[test]
        fn whatever_the_line_takes_only_whole_commands_leave_and_the_newest_is_among_them(
            steps in prop::collection::vec((any::<bool>(), 0..80usize), 1..100),
        ) {
            let mut outbox = Outbox::new();
            let (mut wire, mut sequence) = (Vec::new(), 0);
            for (pair, taken) in steps {
                sequence += 1;
                if pair {
                    outbox.replace(&[command(sequence), command(sequence + 1)]);
                    sequence += 1;
                } else {
                    outbox.replace(&[command(sequence)]);
                }
                let taken = taken.min(outbox.rest().len());
                wire.extend(&outbox.rest()[..taken]);
                outbox.took(taken);
            }
            wire.extend(outbox.rest());
            let (mut receiver, mut input, mut last) = (Receiver::default(), &wire[..], 0);
            while let Some(payload) = receiver.next(&mut input) {
                let Ok(Message::Command(found)) = Message::decode(payload.unwrap()) else { panic!() };
                prop_assert!(found.sequence > last);
                last = found.sequence;
            }
            prop_assert_eq!(last, sequence);
        }
    }
}
