//! Pause, resume and step: what the services ask of the player, which may be another thread.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use node_kit::{NodeKit, Service, StartError, services};
use r2r::std_srvs::srv::Trigger;

/// What the player shall do now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Send what is due.
    Playing,
    /// Send nothing.
    Paused,
    /// Send what comes next, whenever it is due, until a step is complete.
    Stepping,
}

/// Shared by those who ask and the one who plays.
#[derive(Clone, Default)]
pub(crate) struct Control {
    shared: Arc<(Mutex<State>, Condvar)>,
}

#[derive(Default)]
struct State {
    paused: bool,
    steps: u64,
}

impl Control {
    pub(crate) fn new(paused: bool) -> Self {
        let control = Self::default();
        control.state().paused = paused;
        control
    }

    pub(crate) fn mode(&self) -> Mode {
        let state = self.state();
        match (state.paused, state.steps) {
            (false, _) => Mode::Playing,
            (true, 0) => Mode::Paused,
            (true, _) => Mode::Stepping,
        }
    }

    /// One step is complete.
    pub(crate) fn stepped(&self) {
        let mut state = self.state();
        state.steps = state.steps.saturating_sub(1);
    }

    /// Waits until somebody asks for something, at most for `longest`.
    pub(crate) fn wait(&self, longest: Duration) {
        let (_, changed) = &*self.shared;
        // A wake-up for no reason is none too many: the caller looks again.
        drop(changed.wait_timeout(self.state(), longest));
    }

    /// Whether anything changed by it, and a sentence.
    fn pause(&self) -> (bool, &'static str) {
        let was_paused = std::mem::replace(&mut self.state().paused, true);
        self.tell();
        match was_paused {
            true => (false, "the replay pauses already"),
            false => (true, "the replay pauses; ~/resume goes on, ~/step sends up to the next pose"),
        }
    }

    fn resume(&self) -> (bool, &'static str) {
        let mut state = self.state();
        let was_paused = std::mem::replace(&mut state.paused, false);
        state.steps = 0;
        drop(state);
        self.tell();
        match was_paused {
            true => (true, "the replay goes on"),
            false => (false, "the replay does not pause"),
        }
    }

    fn step(&self) -> (bool, &'static str) {
        let mut state = self.state();
        if !state.paused {
            return (false, "the replay does not pause; call ~/pause first");
        }
        state.steps += 1;
        drop(state);
        self.tell();
        (true, "sends what comes next, up to and including the next pose")
    }

    fn tell(&self) {
        self.shared.1.notify_all();
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // Nothing panics while it holds the lock, and two numbers are whole at any moment.
        self.shared.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The services that ask.
pub(crate) struct ControlServices {
    control: Control,
    pause: Service<Trigger::Service>,
    resume: Service<Trigger::Service>,
    step: Service<Trigger::Service>,
}

impl ControlServices {
    pub(crate) fn new(kit: &mut NodeKit, control: Control) -> Result<Self, StartError> {
        Ok(Self {
            control,
            pause: kit.serve(&services::PAUSE)?,
            resume: kit.serve(&services::RESUME)?,
            step: kit.serve(&services::STEP)?,
        })
    }

    /// Answers what was asked since the last turn.
    pub(crate) fn serve(&mut self) {
        type Action = fn(&Control) -> (bool, &'static str);
        let asked: [(&mut Service<Trigger::Service>, Action); 3] = [
            (&mut self.pause, Control::pause),
            (&mut self.resume, Control::resume),
            (&mut self.step, Control::step),
        ];
        for (service, action) in asked {
            while let Some(call) = service.take() {
                let (success, message) = action(&self.control);
                call.answer(Trigger::Response { success, message: message.to_owned() });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_count_only_in_a_pause_and_end_with_it() {
        let control = Control::new(false);
        assert_eq!(control.step(), (false, "the replay does not pause; call ~/pause first"));
        assert!(control.pause().0 && !control.pause().0);
        assert_eq!(control.mode(), Mode::Paused);
        assert!(control.step().0 && control.step().0);
        control.stepped();
        assert_eq!(control.mode(), Mode::Stepping);
        assert!(control.resume().0);
        assert_eq!(control.mode(), Mode::Playing);
        assert!(control.pause().0);
        assert_eq!(control.mode(), Mode::Paused);
    }

    #[test]
    fn who_waits_sees_a_request_at_once() {
        let control = Control::new(true);
        let waiting = control.clone();
        let waits = move || {
            while waiting.mode() == Mode::Paused {
                waiting.wait(Duration::from_secs(60));
            }
        };
        let thread = std::thread::Builder::new().name("waits".to_owned()).spawn(waits).unwrap();
        assert!(control.resume().0);
        thread.join().unwrap();
    }
}
