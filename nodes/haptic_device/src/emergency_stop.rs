//! The emergency stop: the device's own, and the session's where that has a namespace of its own.

use std::time::{Duration, Instant};

use devices::MotorLoop;
use node_kit::{Inbox, Level, NodeKit, RemotePublisher, StartError, Status, topics};
use r2r::std_msgs::msg::Bool;

use crate::sources::names;

/// Between two looks at who publishes.
const LOOK: Duration = Duration::from_secs(1);

/// Every topic that can stop this device. Any of them presses; each releases only what it has pressed.
pub(crate) struct EmergencyStop {
    topics: Vec<StopTopic>,
    looked: Option<Instant>,
}

struct StopTopic {
    /// The namespace, as [`topics::Topic::name_in`] takes it.
    namespace: String,
    /// Those who publish for whoever is there, and those who keep their last word for whoever comes later.
    inboxes: [Inbox<Bool>; 2],
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
                inboxes: [
                    kit.subscribe(&topics::EMERGENCY_STOP, &namespace)?,
                    kit.subscribe_kept(&topics::EMERGENCY_STOP, &namespace)?,
                ],
                namespace,
                is_pressed: false,
                publishers: Vec::new(),
            })
        });
        Ok(EmergencyStop { topics: topics.collect::<Result<_, StartError>>()?, looked: None })
    }

    /// Hears what was said since the last time. True when somebody pressed it, however short.
    pub(crate) fn hear(&mut self, kit: &NodeKit) -> bool {
        let mut was_pressed = false;
        for topic in &mut self.topics {
            was_pressed |= topic.hear(kit);
        }
        if self.looked.is_none_or(|looked| looked.elapsed() >= LOOK) {
            self.looked = Some(Instant::now());
            self.topics.iter_mut().for_each(|topic| topic.look(kit));
        }
        was_pressed
    }

    /// The same, and the motors hear it as well. To be called before anything else is looked at.
    pub(crate) fn take(&mut self, kit: &NodeKit, motor: &MotorLoop) {
        if self.hear(kit) {
            motor.set_emergency_stop(true);
        }
        if !self.is_pressed() {
            motor.set_emergency_stop(false);
        }
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
        for i in 0..self.inboxes.len() {
            while let Some(Bool { data }) = self.inboxes[i].take() {
                was_pressed |= data;
                self.turn(kit, data);
            }
        }
        was_pressed
    }

    fn turn(&mut self, kit: &NodeKit, pressed: bool) {
        if pressed == self.is_pressed {
            return;
        }
        // Whose stop it was is not in the message; with several stops only all of them together may release it.
        if !pressed {
            self.look(kit);
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

    fn look(&mut self, kit: &NodeKit) {
        let before = self.unheard();
        match kit.publishers_of(&topics::EMERGENCY_STOP, &self.namespace) {
            Ok(publishers) => self.publishers = publishers,
            Err(error) => {
                kit.log().error(&format!("{}: its publishers cannot be looked up: {error}", self.name()));
            }
        }
        if let Some(unheard) = self.unheard()
            && before.is_none()
        {
            kit.log().error(&unheard);
        }
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
