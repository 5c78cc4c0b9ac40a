//! The operating state as tools for managed nodes see it. Not a state machine of its own: the motor loop's, by other names.
//!
//! A device that is open is configured: the node starts inactive or active. Motors on is active. What the tools call
//! shutdown ends the node.

use devices::{OperatingState, StateCommand};
use r2r::lifecycle_msgs::msg::{State, Transition, TransitionDescription, TransitionEvent};

/// A primary state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// Motors off.
    Inactive,
    /// Motors on.
    Active,
    /// The node is ending.
    Finalized,
}

/// What a transition does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// As this state command.
    Command(StateCommand),
    /// The node ends.
    Shutdown,
}

/// Id, label, from, to, what it does.
type Row = (u8, &'static str, Phase, Phase, Step);

// r2r gives the constants of a message the type of C.
const TABLE: [Row; 4] = [
    (
        Transition::TRANSITION_ACTIVATE as u8,
        "activate",
        Phase::Inactive,
        Phase::Active,
        Step::Command(StateCommand::Enable),
    ),
    (
        Transition::TRANSITION_DEACTIVATE as u8,
        "deactivate",
        Phase::Active,
        Phase::Inactive,
        Step::Command(StateCommand::Disable),
    ),
    (
        Transition::TRANSITION_INACTIVE_SHUTDOWN as u8,
        "shutdown",
        Phase::Inactive,
        Phase::Finalized,
        Step::Shutdown,
    ),
    (
        Transition::TRANSITION_ACTIVE_SHUTDOWN as u8,
        "shutdown",
        Phase::Active,
        Phase::Finalized,
        Step::Shutdown,
    ),
];

impl From<OperatingState> for Phase {
    fn from(state: OperatingState) -> Phase {
        if state.has_motors_on() { Phase::Active } else { Phase::Inactive }
    }
}

impl Phase {
    /// The message for it.
    pub(crate) fn message(self) -> State {
        let (id, label) = match self {
            Phase::Inactive => (State::PRIMARY_STATE_INACTIVE as u8, "inactive"),
            Phase::Active => (State::PRIMARY_STATE_ACTIVE as u8, "active"),
            Phase::Finalized => (State::PRIMARY_STATE_FINALIZED as u8, "finalized"),
        };
        State { id, label: label.to_owned() }
    }

    /// The transition that is asked for, by id or, with id 0, by label; none: this state has no such one.
    pub(crate) fn step(self, asked: &Transition) -> Option<Step> {
        let is_asked =
            |id: u8, label: &str| if asked.id == 0 { asked.label == label } else { asked.id == id };
        TABLE
            .into_iter()
            .find(|(id, label, from, ..)| *from == self && is_asked(*id, label))
            .map(|(.., step)| step)
    }

    /// The transitions that this state has.
    pub(crate) fn transitions(self) -> Vec<TransitionDescription> {
        TABLE.into_iter().filter(|(_, _, from, ..)| *from == self).map(description).collect()
    }

    /// What happened between two states; none: nothing.
    pub(crate) fn event_to(self, to: Phase, stamp_ns: u64) -> Option<TransitionEvent> {
        let row = TABLE.into_iter().find(|(_, _, row_from, row_to, _)| (*row_from, *row_to) == (self, to))?;
        let TransitionDescription { transition, start_state, goal_state } = description(row);
        Some(TransitionEvent { timestamp: stamp_ns, transition, start_state, goal_state })
    }
}

/// Every state there is.
pub(crate) fn all_states() -> Vec<State> {
    [Phase::Inactive, Phase::Active, Phase::Finalized].map(Phase::message).to_vec()
}

/// Every transition there is.
pub(crate) fn all_transitions() -> Vec<TransitionDescription> {
    TABLE.into_iter().map(description).collect()
}

fn description((id, label, from, to, _): Row) -> TransitionDescription {
    TransitionDescription {
        transition: Transition { id, label: label.to_owned() },
        start_state: from.message(),
        goal_state: to.message(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(id: u8, label: &str) -> Transition {
        Transition { id, label: label.to_owned() }
    }

    #[test]
    fn motors_on_is_active() {
        use OperatingState::{Disabled, Enabled, Fault, Paused};
        assert_eq!([Enabled, Paused].map(Phase::from), [Phase::Active; 2]);
        assert_eq!([Disabled, Fault].map(Phase::from), [Phase::Inactive; 2]);
    }

    #[test]
    fn every_transition_is_a_command_that_the_operating_state_accepts() {
        use OperatingState::{Disabled, Enabled, Fault, Paused};
        for state in [Disabled, Enabled, Paused, Fault] {
            for description in Phase::from(state).transitions() {
                if let Some(Step::Command(command)) = Phase::from(state).step(&description.transition) {
                    let after = state.after(command).expect("accepted");
                    assert_eq!(Phase::from(after).message(), description.goal_state, "{state} {command:?}");
                }
            }
        }
    }

    #[test]
    fn a_transition_is_found_by_id_or_by_label_in_its_own_state_only() {
        let enable = Some(Step::Command(StateCommand::Enable));
        assert_eq!(Phase::Inactive.step(&asked(3, "")), enable);
        assert_eq!(Phase::Inactive.step(&asked(0, "activate")), enable);
        assert_eq!(Phase::Active.step(&asked(3, "activate")), None);
        assert_eq!(Phase::Active.step(&asked(0, "shutdown")), Some(Step::Shutdown));
        assert_eq!(Phase::Active.step(&asked(6, "")), None, "shutdown has another id in each state");
        for unknown in [asked(0, ""), asked(1, "configure"), asked(0, "fly")] {
            assert_eq!(Phase::Inactive.step(&unknown), None);
        }
        assert!(Phase::Finalized.transitions().is_empty());
    }

    #[test]
    fn an_event_names_both_states_and_what_led_from_one_to_the_other() {
        let event = Phase::Active.event_to(Phase::Inactive, 7).unwrap();
        assert_eq!((event.transition.label.as_str(), event.timestamp), ("deactivate", 7));
        assert_eq!(
            (event.start_state.label.as_str(), event.goal_state.label.as_str()),
            ("active", "inactive")
        );
        assert_eq!(Phase::Active.event_to(Phase::Active, 7), None);
    }
}
