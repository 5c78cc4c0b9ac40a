//! Requests from the thread that owns a motor loop: a short queue in, and one number that says how far it was answered.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::{OperatingState, StateCommand, monotonic_ns};

/// More requests than this do not wait; a person presses no buttons faster.
const QUEUE: usize = 64;
/// Time after which a loop that does not answer is busy with something else: opening or homing a device.
const PATIENCE: Duration = Duration::from_millis(100);
/// Time between two looks at the answer.
const LOOK: Duration = Duration::from_micros(200);

/// What can be asked of a motor loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// A command to the operating state.
    State(StateCommand),
    /// No force from any source, until [`Request::Follow`] or a command that enables or resumes.
    Free,
    /// A spring to the place where the handle is now.
    Hold,
    /// Forces from the configured source again.
    Follow,
    /// The device carries its own weight, or not.
    GravityCompensation(bool),
}

/// What came of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Done, or begun where it takes time; the operating state after it.
    Accepted(OperatingState),
    /// Not accepted in this operating state.
    Refused(OperatingState),
    /// The loop is busy, or gone.
    Unanswered,
}

impl Answer {
    /// As one number beside the count of requests: never zero.
    fn code(self) -> u64 {
        let state = |state| match state {
            OperatingState::Disabled => 0,
            OperatingState::Enabled => 1,
            OperatingState::Paused => 2,
            OperatingState::Fault => 3,
        };
        match self {
            Answer::Accepted(after) => 1 + state(after),
            Answer::Refused(after) => 5 + state(after),
            Answer::Unanswered => 9,
        }
    }

    fn of_code(code: u64) -> Answer {
        use OperatingState::{Disabled, Enabled, Fault, Paused};
        let state = |place: u64| [Disabled, Enabled, Paused, Fault][(place & 3) as usize];
        match code {
            1..=4 => Answer::Accepted(state(code - 1)),
            5..=8 => Answer::Refused(state(code - 5)),
            _ => Answer::Unanswered,
        }
    }
}

/// An empty queue and its two ends.
pub(crate) fn requests() -> (Asker, Askee) {
    let (queue, waiting) = rtrb::RingBuffer::new(QUEUE);
    let answered = Arc::new(AtomicU64::new(0));
    (Asker { queue, answered: answered.clone(), asked: 0 }, Askee { waiting, answered, taken: 0 })
}

/// The asking end.
#[derive(Debug)]
pub(crate) struct Asker {
    queue: rtrb::Producer<(Request, u64)>,
    /// Number of requests answered, times 16, plus the code of the last answer.
    answered: Arc<AtomicU64>,
    asked: u64,
}

impl Asker {
    /// Asks, and waits a moment for the answer.
    pub(crate) fn ask(&mut self, request: Request) -> Answer {
        if self.queue.push((request, monotonic_ns())).is_err() {
            return Answer::Unanswered;
        }
        self.asked += 1;
        let give_up = Instant::now() + PATIENCE;
        loop {
            let answered = self.answered.load(Ordering::Acquire);
            if answered >> 4 >= self.asked {
                return Answer::of_code(answered & 15);
            }
            if Instant::now() >= give_up {
                return Answer::Unanswered;
            }
            std::thread::sleep(LOOK);
        }
    }
}

/// The answering end. Both calls are RT safe.
#[derive(Debug)]
pub(crate) struct Askee {
    waiting: rtrb::Consumer<(Request, u64)>,
    answered: Arc<AtomicU64>,
    taken: u64,
}

impl Askee {
    /// The next request and whether whoever asked has given up on it, at `now_ns`, without waiting. Every one taken must
    /// be answered before the next is taken.
    pub(crate) fn take(&mut self, now_ns: u64) -> Option<(Request, bool)> {
        let (request, asked_ns) = self.waiting.pop().ok()?;
        self.taken += 1;
        Some((request, now_ns.saturating_sub(asked_ns) > PATIENCE.as_nanos() as u64))
    }

    /// Answers the request taken last.
    pub(crate) fn answer(&mut self, answer: Answer) {
        self.answered.store((self.taken << 4) | answer.code(), Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_answer_survives_its_number() {
        use OperatingState::{Disabled, Enabled, Fault, Paused};
        for state in [Disabled, Enabled, Paused, Fault] {
            for answer in [Answer::Accepted(state), Answer::Refused(state), Answer::Unanswered] {
                assert_eq!(Answer::of_code(answer.code()), answer);
            }
        }
    }

    #[test]
    fn each_request_gets_its_own_answer_and_a_silent_loop_is_not_waited_for() {
        let (mut asker, mut askee) = requests();
        assert_eq!(asker.ask(Request::Hold), Answer::Unanswered);
        assert_eq!(askee.take(monotonic_ns()), Some((Request::Hold, true)), "nobody waits for it any more");
        askee.answer(Answer::Unanswered);
        let loop_thread = std::thread::Builder::new().spawn(move || {
            let mut seen = Vec::new();
            while seen.len() < 2 {
                let Some((request, false)) = askee.take(monotonic_ns()) else {
                    std::thread::yield_now();
                    continue;
                };
                seen.push(request);
                askee.answer(match request {
                    Request::State(StateCommand::Enable) => Answer::Accepted(OperatingState::Enabled),
                    _ => Answer::Refused(OperatingState::Fault),
                });
            }
            seen
        });
        let enable = Request::State(StateCommand::Enable);
        assert_eq!(asker.ask(enable), Answer::Accepted(OperatingState::Enabled));
        assert_eq!(asker.ask(Request::Free), Answer::Refused(OperatingState::Fault));
        assert_eq!(loop_thread.unwrap().join().unwrap(), [enable, Request::Free]);
    }
}
