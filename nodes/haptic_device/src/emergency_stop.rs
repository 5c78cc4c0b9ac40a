//! The emergency stop: the device's own, and the session's where that has a namespace of its own.

use std::time::{Duration, Instant};

use devices::MotorLoop;
use node_kit::{Inbox, Level, NodeKit, RemotePublisher, StartError, Status, topics};
use r2r::std_msgs::msg::Bool;

use crate::sources::names;

/// Between two looks at who publishes.
const LOOK: Duration = Duration::from_secs(1);
/// How long what was said before the driver came is waited for, where somebody keeps it.
const KEPT: Duration = Duration::from_millis(300);
/// Longest wait for a message on the way there.
const TURN: Duration = Duration::from_millis(10);

/// Every topic that can stop this device. Any of them presses; each releases only what it has pressed.
pub(crate) struct EmergencyStop {
    topics: Vec<StopTopic>,
    looked: Option<Instant>,
}

struct StopTopic {
    /// The namespace, as [`topics::Topic::name_in`] takes it.
    namespace: String,
    inbox: Inbox<Bool>,
    /// What was said before this driver came; only where a publisher keeps it, because one that does not would warn of a
    /// reader that it cannot serve.
    kept: Option<Inbox<Bool>>,
    is_pressed: bool,
    publishers: Vec<RemotePublisher>,
}

impl EmergencyStop {
    /// Listens in the namespace of the node and in that of its session, which has `devices`.
    pub(crate) fn new(kit: &mut NodeKit, devices: &[String]) -> Result<EmergencyStop, StartError> {
        let session = scene::session_namespace(kit.namespace(), devices).to_owned();
        let mut namespaces = vec![String::new()];
        if session != kit.namespace() {
            namespaces.push(session);
        }
        let topics = namespaces.into_iter().map(|namespace| {
            Ok(StopTopic {
                inbox: kit.subscribe(&topics::EMERGENCY_STOP, &namespace)?,
                kept: None,
                namespace,
                is_pressed: false,
                publishers: Vec::new(),
            })
        });
        Ok(EmergencyStop { topics: topics.collect::<Result<_, StartError>>()?, looked: None })
    }

    /// Before motors go on: true when it was pressed already.
    ///
    /// # Errors
    /// rcl refuses a subscription.
    pub(crate) fn was_pressed_before(&mut self, kit: &mut NodeKit) -> Result<bool, StartError> {
        let mut was_pressed = self.hear(kit)?;
        let deadline = Instant::now() + KEPT;
        while !was_pressed
            && self.topics.iter().any(|topic| topic.kept.is_some())
            && Instant::now() < deadline
        {
            kit.spin_once(TURN);
            was_pressed = self.hear(kit)?;
        }
        Ok(was_pressed)
    }

    /// Hears what was said since the last time. To be called before anything else is looked at.
    ///
    /// # Errors
    /// rcl refuses a subscription.
    pub(crate) fn take(&mut self, kit: &mut NodeKit, motor: &MotorLoop) -> Result<(), StartError> {
        if self.hear(kit)? {
            motor.set_emergency_stop(true);
        }
        if !self.is_pressed() {
            motor.set_emergency_stop(false);
        }
        Ok(())
    }

    /// True when somebody pressed it, however short.
    fn hear(&mut self, kit: &mut NodeKit) -> Result<bool, StartError> {
        let mut was_pressed = false;
        for topic in &mut self.topics {
            was_pressed |= topic.hear(kit);
        }
        if self.looked.is_none_or(|looked| looked.elapsed() >= LOOK) {
            self.looked = Some(Instant::now());
            for topic in &mut self.topics {
                topic.look(kit);
                topic.ask_those_who_keep(kit)?;
            }
        }
        Ok(was_pressed)
    }

    fn is_pressed(&self) -> bool {
        self.topics.iter().any(|topic| topic.is_pressed)
    }

    /// The diagnostics: who can stop this device, and who tries and cannot.
    pub(crate) fn status(&self) -> Status {
        let is_pressed = self.is_pressed();
        let unheard = self.topics.iter().find_map(StopTopic::unheard);
        let (level, summary) = match (unheard, is_pressed) {
            (Some(unheard), _) => (Level::Error, unheard),
            (None, true) => (Level::Warn, "pressed".to_owned()),
            (None, false) => (Level::Ok, "not pressed".to_owned()),
        };
        let mut status = Status::new(level, "emergency stop", summary).with("is_pressed", is_pressed);
        for topic in &self.topics {
            status = status.with(topic.name(), names(&topic.publishers));
        }
        status
    }
}

impl StopTopic {
    fn name(&self) -> String {
        topics::EMERGENCY_STOP.name_in(&self.namespace)
    }

    fn hear(&mut self, kit: &NodeKit) -> bool {
        let mut was_pressed = false;
        while let Some(Bool { data }) = self.inbox.take().or_else(|| self.kept.as_mut()?.take()) {
            was_pressed |= data;
            self.turn(kit, data);
        }
        was_pressed
    }

    fn turn(&mut self, kit: &NodeKit, pressed: bool) {
        if pressed == self.is_pressed {
            return;
        }
        // Whose stop it was is not in the message; with several stops only all of them together may release it.
        if !pressed {
            // Where nobody can be looked up there may be several.
            if !self.look(kit) {
                return;
            }
            if self.publishers.len() > 1 {
                kit.log().error(&format!(
                    "{}: not released, because {} publish it; stop all but one",
                    self.name(),
                    names(&self.publishers)
                ));
                return;
            }
        }
        self.is_pressed = pressed;
        let how = if pressed { "pressed" } else { "released" };
        kit.log().warn(&format!("emergency stop {how} ({})", self.name()));
    }

    /// Looks who publishes; false when that is not to be learnt.
    fn look(&mut self, kit: &NodeKit) -> bool {
        let before = self.unheard();
        match kit.publishers_of(&topics::EMERGENCY_STOP, &self.namespace) {
            Ok(publishers) => self.publishers = publishers,
            Err(error) => {
                kit.log().error(&format!("{}: its publishers cannot be looked up: {error}", self.name()));
                return false;
            }
        }
        if let Some(unheard) = self.unheard()
            && before.is_none()
        {
            kit.log().error(&unheard);
        }
        true
    }

    fn ask_those_who_keep(&mut self, kit: &mut NodeKit) -> Result<(), StartError> {
        if self.kept.is_none() && self.publishers.iter().any(|publisher| publisher.keeps) {
            self.kept = Some(kit.subscribe_kept(&topics::EMERGENCY_STOP, &self.namespace)?);
        }
        Ok(())
    }

    /// A stop whose messages need not arrive.
    fn unheard(&self) -> Option<String> {
        let publisher = self.publishers.iter().find(|publisher| !publisher.is_reliable)?;
        Some(format!(
            "{}: {} publishes it best effort, and is not heard: it cannot stop this device until it is reliable",
            self.name(),
            publisher.node
        ))
    }
}
