//! Where orders come in that are no forces: state commands, hold and free, lifecycle transitions.
//! Each goes to the motor loop, which decides; what it decided is told.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use devices::{Answer, MotorLoop, MotorStatus, OperatingState, Request, StateCommand};
use node_kit::{Inbox, NodeKit, PublishError, Publisher, Service, StartError, services, topics};
use r2r::crtk_msgs::msg::StringStamped;
use r2r::lifecycle_msgs::msg::TransitionEvent;
use r2r::lifecycle_msgs::srv::{ChangeState, GetAvailableStates, GetAvailableTransitions, GetState};
use r2r::std_msgs::msg::{Bool, Empty};

use crate::lifecycle::{Phase, Step, all_states, all_transitions};
use crate::now::now_ns;
use crate::operating_state::{StateTopic, refusal};
use crate::shared::Shared;

/// The desk of one device.
pub(crate) struct Desk {
    state: StateTopic,
    lifecycle: Lifecycle,
    commands: Inbox<StringStamped>,
    /// Hold and free; none for a device without motors.
    modes: Option<[(Request, Inbox<Empty>); 2]>,
    /// None for a device that has nothing to switch.
    gravity: Option<Inbox<Bool>>,
    absolute: Inbox<Bool>,
    body_is_absolute: Arc<AtomicBool>,
    /// Whether a hold or free keeps the sources away.
    is_apart: bool,
    /// Whether the motor loop has left an order of this turn unanswered. The others of the turn are not asked then: each
    /// would keep this thread, and with it the emergency stop, for as long again.
    is_busy: bool,
    told: Option<MotorStatus>,
}

struct Lifecycle {
    events: Publisher<TransitionEvent>,
    change: Service<ChangeState::Service>,
    state: Service<GetState::Service>,
    states: Service<GetAvailableStates::Service>,
    transitions: Service<GetAvailableTransitions::Service>,
    graph: Service<GetAvailableTransitions::Service>,
}

impl Desk {
    /// Opens the desk for what the device can do.
    pub(crate) fn new(
        kit: &mut NodeKit,
        shared: &Shared,
        can_carry_itself: bool,
    ) -> Result<Desk, StartError> {
        let modes = match shared.has_motors() {
            true => Some([
                (Request::Hold, kit.subscribe(&topics::HOLD, "")?),
                (Request::Free, kit.subscribe(&topics::FREE, "")?),
            ]),
            false => None,
        };
        Ok(Desk {
            state: StateTopic::new(kit, shared.frames.base.clone())?,
            lifecycle: Lifecycle {
                events: kit.publish(&topics::TRANSITION_EVENT, "")?,
                change: kit.serve(&services::CHANGE_STATE)?,
                state: kit.serve(&services::GET_STATE)?,
                states: kit.serve(&services::GET_AVAILABLE_STATES)?,
                transitions: kit.serve(&services::GET_AVAILABLE_TRANSITIONS)?,
                graph: kit.serve(&services::GET_TRANSITION_GRAPH)?,
            },
            commands: kit.subscribe(&topics::STATE_COMMAND, "")?,
            modes,
            gravity: match can_carry_itself {
                true => Some(kit.subscribe(&topics::USE_GRAVITY_COMPENSATION, "")?),
                false => None,
            },
            absolute: kit.subscribe(&topics::BODY_SET_CF_ORIENTATION_ABSOLUTE, "")?,
            body_is_absolute: shared.body_is_absolute.clone(),
            is_apart: false,
            is_busy: false,
            told: None,
        })
    }

    /// Takes the orders that wait, answers the calls that wait, tells what has changed. True when the state has.
    pub(crate) fn take(&mut self, kit: &NodeKit, motor: &mut MotorLoop) -> Result<bool, PublishError> {
        self.is_busy = false;
        while let Some(message) = self.commands.take() {
            match message.string.parse() {
                Ok(command) => drop(self.command(kit, motor, command)),
                Err(text) => kit.log().warn(&text),
            }
            // Clients wait for a message, whatever came of the command.
            self.state.tell(motor.status(), now_ns())?;
        }
        for (request, inbox) in self.modes.iter_mut().flatten() {
            while inbox.take().is_some() {
                self.is_apart |= order(kit, motor, *request, &mut self.is_busy);
            }
        }
        if let Some(gravity) = &mut self.gravity {
            while let Some(message) = gravity.take() {
                order(kit, motor, Request::GravityCompensation(message.data), &mut self.is_busy);
            }
        }
        while let Some(message) = self.absolute.take() {
            self.body_is_absolute.store(message.data, Relaxed);
        }
        self.serve_lifecycle(kit, motor);
        let status = motor.status();
        self.state.serve(status, now_ns());
        self.tell_changes(kit, status)
    }

    /// Somebody commands a force anew: a hold or free has served its purpose.
    pub(crate) fn follow_again(&mut self, kit: &NodeKit, motor: &mut MotorLoop) {
        if std::mem::take(&mut self.is_apart) {
            order(kit, motor, Request::Follow, &mut self.is_busy);
        }
    }

    /// One state command; whether it was accepted.
    fn command(&mut self, kit: &NodeKit, motor: &mut MotorLoop, command: StateCommand) -> bool {
        match ask(motor, Request::State(command), &mut self.is_busy) {
            Answer::Accepted(_) => {
                if matches!(command, StateCommand::Enable | StateCommand::Resume) {
                    self.follow_again(kit, motor);
                }
                true
            }
            Answer::Refused(state) => {
                kit.log().warn(&refusal(command, MotorStatus { operating: state, ..motor.status() }));
                false
            }
            Answer::Unanswered => {
                kit.log().warn(&format!("{}: the motor loop is busy; try again", command.word()));
                false
            }
        }
    }

    fn serve_lifecycle(&mut self, kit: &NodeKit, motor: &mut MotorLoop) {
        while let Some(call) = self.lifecycle.change.take() {
            let phase = Phase::from(motor.status().operating);
            let success = match phase.step(&call.request().transition) {
                Some(Step::Command(command)) => {
                    let accepted = self.command(kit, motor, command);
                    // The same answer that a state command gets, before the caller's.
                    if let Err(error) = self.state.tell(motor.status(), now_ns()) {
                        kit.log().error(&error.to_string());
                    }
                    accepted
                }
                Some(Step::Shutdown) => {
                    kit.shutdown().request();
                    true
                }
                None => {
                    let label = &call.request().transition.label;
                    kit.log().warn(&format!(
                        "lifecycle: no transition \"{label}\" from {}",
                        phase.message().label
                    ));
                    false
                }
            };
            call.answer(ChangeState::Response { success });
        }
        let phase = Phase::from(motor.status().operating);
        while let Some(call) = self.lifecycle.state.take() {
            call.answer(GetState::Response { current_state: phase.message() });
        }
        while let Some(call) = self.lifecycle.states.take() {
            call.answer(GetAvailableStates::Response { available_states: all_states() });
        }
        while let Some(call) = self.lifecycle.transitions.take() {
            let available_transitions = phase.transitions();
            call.answer(GetAvailableTransitions::Response { available_transitions });
        }
        while let Some(call) = self.lifecycle.graph.take() {
            call.answer(GetAvailableTransitions::Response { available_transitions: all_transitions() });
        }
    }

    fn tell_changes(&mut self, kit: &NodeKit, status: MotorStatus) -> Result<bool, PublishError> {
        self.state.tell_change(status, now_ns())?;
        let before = self.told.replace(status);
        if before == Some(status) {
            return Ok(false);
        }
        let was = before.map(|before| before.operating);
        match (status.operating, status.fault) {
            _ if before.is_some_and(|it| (it.operating, it.fault) == (status.operating, status.fault)) => {}
            (OperatingState::Fault, Some(cause)) => kit.log().error(&format!("FAULT: {cause}")),
            (state, _) if was != Some(state) => kit.log().info(&format!("operating state {state}")),
            _ => {}
        }
        if let Some(was) = was
            && let Some(event) =
                Phase::from(was).event_to(Phase::from(status.operating), now_ns().unsigned_abs())
        {
            self.lifecycle.events.publish(&event)?;
        }
        Ok(true)
    }

    /// The node ends: what the tools for managed nodes hear last.
    pub(crate) fn tell_end(&self) -> Result<(), PublishError> {
        let Some(told) = self.told else { return Ok(()) };
        match Phase::from(told.operating).event_to(Phase::Finalized, now_ns().unsigned_abs()) {
            Some(event) => self.lifecycle.events.publish(&event),
            None => Ok(()),
        }
    }
}

/// Asks the motor loop for something, unless it `is_busy`.
fn ask(motor: &mut MotorLoop, request: Request, is_busy: &mut bool) -> Answer {
    // What takes force away is asked for whatever else waits.
    if *is_busy && request != Request::State(StateCommand::Disable) {
        return Answer::Unanswered;
    }
    let answer = motor.request(request);
    *is_busy |= answer == Answer::Unanswered;
    answer
}

/// Asks the motor loop for something and says when it does not do it; whether it does.
fn order(kit: &NodeKit, motor: &mut MotorLoop, request: Request, is_busy: &mut bool) -> bool {
    match ask(motor, request, is_busy) {
        Answer::Accepted(_) => true,
        Answer::Refused(state) => {
            kit.log().warn(&format!("{}: not in state {state}", words(request)));
            false
        }
        Answer::Unanswered => {
            kit.log().warn(&format!("{}: the motor loop is busy; try again", words(request)));
            false
        }
    }
}

fn words(request: Request) -> &'static str {
    match request {
        Request::Hold => "hold",
        Request::Free => "free",
        Request::Follow => "a force after hold or free",
        Request::GravityCompensation(_) => "use_gravity_compensation",
        Request::State(command) => command.word(),
    }
}
