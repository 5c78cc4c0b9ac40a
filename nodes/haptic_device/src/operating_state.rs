//! The operating state as CRTK's clients see it: a topic, two services, and commands by name.

use devices::{MotorStatus, OperatingState, StateCommand};
use node_kit::{NodeKit, PublishError, Publisher, Service, StartError, convert, services, topics};
use r2r::crtk_msgs::msg::OperatingState as StateMessage;
use r2r::crtk_msgs::srv::TriggerOperatingState;
use r2r::std_msgs::msg::Header;
use r2r::std_srvs::srv::Trigger;

/// The version of the CRTK interface that the topics follow.
const CRTK_VERSION: &str = "1.3.0";

/// What a message says of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Said {
    state: OperatingState,
    is_homed: bool,
    is_busy: bool,
}

impl From<MotorStatus> for Said {
    fn from(status: MotorStatus) -> Said {
        Said { state: status.operating, is_homed: status.is_homed, is_busy: status.is_busy }
    }
}

/// Makes messages, each stamped later than the one before: clients drop what is not newer than what they know.
#[derive(Debug, Default)]
struct Messages {
    last_stamp_ns: i64,
    frame_id: String,
}

impl Messages {
    fn make(&mut self, said: Said, now_ns: i64) -> StateMessage {
        self.last_stamp_ns = now_ns.max(self.last_stamp_ns + 1);
        StateMessage {
            header: Header { stamp: convert::stamp(self.last_stamp_ns), frame_id: self.frame_id.clone() },
            state: said.state.to_string(),
            is_homed: said.is_homed,
            is_busy: said.is_busy,
        }
    }
}

/// The topic and the services.
pub(crate) struct StateTopic {
    publisher: Publisher<StateMessage>,
    state: Service<TriggerOperatingState::Service>,
    version: Service<Trigger::Service>,
    messages: Messages,
    published: Option<Said>,
}

impl StateTopic {
    pub(crate) fn new(kit: &mut NodeKit, frame_id: String) -> Result<StateTopic, StartError> {
        Ok(StateTopic {
            publisher: kit.publish(&topics::OPERATING_STATE, "")?,
            state: kit.serve(&services::OPERATING_STATE)?,
            version: kit.serve(&services::CRTK_VERSION)?,
            messages: Messages { frame_id, ..Messages::default() },
            published: None,
        })
    }

    /// Publishes the state if it is another one than was published last.
    pub(crate) fn tell_change(&mut self, status: MotorStatus, now_ns: i64) -> Result<(), PublishError> {
        if self.published == Some(status.into()) {
            return Ok(());
        }
        self.tell(status, now_ns)
    }

    /// Publishes the state, changed or not: the answer to a command.
    pub(crate) fn tell(&mut self, status: MotorStatus, now_ns: i64) -> Result<(), PublishError> {
        self.published = Some(status.into());
        self.publisher.publish(&self.messages.make(status.into(), now_ns))
    }

    /// Answers the calls that wait.
    pub(crate) fn serve(&mut self, status: MotorStatus, now_ns: i64) {
        while let Some(call) = self.state.take() {
            let operating_state = self.messages.make(status.into(), now_ns);
            call.answer(TriggerOperatingState::Response { operating_state });
        }
        while let Some(call) = self.version.take() {
            call.answer(Trigger::Response { success: true, message: CRTK_VERSION.to_owned() });
        }
    }
}

/// Why a command changed nothing: this state has no such transition, or something is still wrong.
pub(crate) fn refusal(command: StateCommand, status: MotorStatus) -> String {
    let (word, state) = (command.word(), status.operating);
    match (state.after(command), status.barred_by) {
        (None, _) => format!("{word}: not accepted in state {state}"),
        (Some(_), Some(cause)) if command == StateCommand::Enable => format!("{word}: not now: {cause}"),
        (Some(_), _) => format!("{word}: this device does not do that"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use devices::safety::FaultCause;

    const ENABLED: Said = Said { state: OperatingState::Enabled, is_homed: true, is_busy: false };

    #[test]
    fn a_message_says_the_state_in_crtks_words() {
        let mut messages = Messages { frame_id: "device_base".to_owned(), ..Messages::default() };
        let message = messages.make(Said { is_busy: true, ..ENABLED }, 5_000_000_007);
        assert_eq!((message.state.as_str(), message.is_homed, message.is_busy), ("ENABLED", true, true));
        assert_eq!(convert::stamp_ns(&message.header.stamp), 5_000_000_007);
        assert_eq!(message.header.frame_id, "device_base");
    }

    #[test]
    fn stamps_strictly_rise_whatever_the_clock_does() {
        let mut messages = Messages::default();
        let stamps: Vec<i64> = [10, 10, 3, 11, i64::from(i32::MAX), 12]
            .map(|now_ns| convert::stamp_ns(&messages.make(ENABLED, now_ns).header.stamp))
            .to_vec();
        assert!(stamps.windows(2).all(|pair| pair[1] > pair[0]), "{stamps:?}");
    }

    #[test]
    fn a_refused_command_is_told_why() {
        let status = |operating, barred_by| MotorStatus { operating, barred_by, ..MotorStatus::default() };
        let fault = MotorStatus {
            fault: Some(FaultCause::Velocity),
            ..status(OperatingState::Fault, Some(FaultCause::EmergencyStop))
        };
        assert_eq!(refusal(StateCommand::Resume, fault), "resume: not accepted in state FAULT");
        assert!(refusal(StateCommand::Enable, fault).starts_with("enable: not now: emergency stop"));
        let enabled = status(OperatingState::Enabled, None);
        assert_eq!(refusal(StateCommand::Unhome, enabled), "unhome: this device does not do that");
    }
}
