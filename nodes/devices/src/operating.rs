//! The operating state of a device and the commands that change it: the table that clients of surgical robots know (CRTK).

use std::fmt;
use std::str::FromStr;

/// Whether the device's motors are on, and whether they may push.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OperatingState {
    /// Motors off.
    #[default]
    Disabled,
    /// Motors on; forces act.
    Enabled,
    /// Motors on; no force.
    Paused,
    /// Motors off because of a fault, until a command clears it.
    Fault,
}

impl OperatingState {
    /// Whether the motors are on in this state.
    pub fn has_motors_on(self) -> bool {
        matches!(self, OperatingState::Enabled | OperatingState::Paused)
    }

    /// The state after a command; none: the command is not accepted in this state, which stays. Leaving a fault takes
    /// more than this table: its cause must be gone. RT safe.
    ///
    /// `home` and `unhome` leave the state as it is and need motors that are on.
    pub fn after(self, command: StateCommand) -> Option<OperatingState> {
        use OperatingState::{Disabled, Enabled, Fault, Paused};
        match (self, command) {
            (_, StateCommand::Disable) => Some(Disabled),
            (Disabled | Enabled | Fault, StateCommand::Enable) => Some(Enabled),
            (Enabled | Paused, StateCommand::Pause) => Some(Paused),
            (Paused, StateCommand::Resume) => Some(Enabled),
            (Enabled | Paused, StateCommand::Home | StateCommand::Unhome) => Some(self),
            _ => None,
        }
    }
}

impl fmt::Display for OperatingState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            OperatingState::Disabled => "DISABLED",
            OperatingState::Enabled => "ENABLED",
            OperatingState::Paused => "PAUSED",
            OperatingState::Fault => "FAULT",
        })
    }
}

/// A command to the operating state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateCommand {
    /// Motors on.
    Enable,
    /// Motors off.
    Disable,
    /// No force; motors stay on.
    Pause,
    /// Forces again.
    Resume,
    /// Find the reference position.
    Home,
    /// Forget the reference position.
    Unhome,
}

impl StateCommand {
    /// Every command, in the order of the documentation.
    pub const ALL: [StateCommand; 6] = [
        StateCommand::Enable,
        StateCommand::Disable,
        StateCommand::Pause,
        StateCommand::Resume,
        StateCommand::Home,
        StateCommand::Unhome,
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            StateCommand::Enable => "enable",
            StateCommand::Disable => "disable",
            StateCommand::Pause => "pause",
            StateCommand::Resume => "resume",
            StateCommand::Home => "home",
            StateCommand::Unhome => "unhome",
        }
    }
}

/// As much of a word as a line of a log takes.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

impl FromStr for StateCommand {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let all = StateCommand::ALL;
        all.into_iter().find(|command| command.word() == text).ok_or_else(|| {
            let words = all.map(StateCommand::word).join(", ");
            format!("state command {:?}: accepted are {words}", shortened(text))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::OperatingState::{Disabled, Enabled, Fault, Paused};
    use super::StateCommand::{Disable, Enable, Home, Pause, Resume, Unhome};
    use super::*;

    #[test]
    fn the_table_is_that_of_the_documentation() {
        for (state, after) in [
            // enable, disable, pause, resume
            (Disabled, [Some(Enabled), Some(Disabled), None, None]),
            (Enabled, [Some(Enabled), Some(Disabled), Some(Paused), None]),
            (Paused, [None, Some(Disabled), Some(Paused), Some(Enabled)]),
            (Fault, [Some(Enabled), Some(Disabled), None, None]),
        ] {
            assert_eq!(
                [Enable, Disable, Pause, Resume].map(|command| state.after(command)),
                after,
                "{state}"
            );
        }
    }

    #[test]
    fn homing_needs_motors_and_keeps_the_state() {
        for command in [Home, Unhome] {
            assert_eq!([Enabled, Paused].map(|state| state.after(command)), [Some(Enabled), Some(Paused)]);
            assert_eq!([Disabled, Fault].map(|state| state.after(command)), [None, None]);
        }
    }

    #[test]
    fn no_command_leads_into_a_fault() {
        for state in [Disabled, Enabled, Paused, Fault] {
            for command in StateCommand::ALL {
                assert_ne!(state.after(command), Some(Fault));
            }
        }
    }

    #[test]
    fn commands_are_lower_case_words_and_others_are_refused_by_name() {
        for command in StateCommand::ALL {
            assert_eq!(command.word().parse(), Ok(command));
        }
        let refusal = "ENABLE".parse::<StateCommand>().unwrap_err();
        assert!(refusal.contains("\"ENABLE\"") && refusal.contains("unhome"), "{refusal}");
    }
}
