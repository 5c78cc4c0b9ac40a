//! How the session is: what its nodes say of themselves, the state of its devices, and who publishes what.

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use node_kit::{Inbox, NodeKit, StartError, convert, topics};
use r2r::crtk_msgs::msg::OperatingState;
use r2r::diagnostic_msgs::msg::{DiagnosticArray, DiagnosticStatus};

use super::pointer::PointerState;
use super::protocol::{DeviceHealth, NodeHealth};
use crate::device_view::DeviceView;

/// Nodes say how they are once a second; one that has said nothing for this long does not.
const STALE_AFTER: Duration = Duration::from_millis(2500);
/// A driver whose last pose is older than this is not alive, and a model that has not answered poses for so long is
/// silent: a process that was killed stays in the graph for seconds, one that hangs for ever.
const SILENT_AFTER: Duration = Duration::from_millis(500);
/// More statuses than this are no session.
const MAX_STATUSES: usize = 64;
/// Of one status as many values are shown, each text no longer than this.
const MAX_VALUES: usize = 64;
const MAX_TEXT: usize = 400;

/// What was heard of the session's health.
pub(crate) struct Health {
    prefix: String,
    diagnostics: Inbox<DiagnosticArray>,
    statuses: BTreeMap<String, (Instant, NodeHealth)>,
    devices: Vec<Device>,
    graph: Graph,
}

struct Device {
    name: String,
    states: Inbox<OperatingState>,
    state: Option<OperatingState>,
}

/// What is known of the driver of one device.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Driver {
    /// Poses a second as it counts them; where it says nothing, as the model does, Hz.
    pub(crate) pose_rate_hz: Option<f32>,
    /// Somebody publishes what its motors apply.
    pub(crate) publishes_force: bool,
}

/// Who publishes what a page shows.
#[derive(Clone, Debug, Default)]
struct Graph {
    counts: BTreeMap<&'static str, usize>,
    /// Publishers of each device's contact.
    contacts: Vec<usize>,
    /// Publishers of each device's pose.
    poses: Vec<usize>,
    /// Publishers of what each device's motors apply.
    forces: Vec<usize>,
    /// Full names of the nodes that publish what the model does.
    model: BTreeSet<String>,
    nodes: BTreeSet<String>,
}

/// A device with what was heard of it, publishers of its pose, whether it takes targets, and a frame without a place.
type DeviceFacts<'a> = (((&'a Device, &'a DeviceView), usize), (PointerState, Option<String>));

impl Health {
    /// Subscribe.
    pub(crate) fn new(kit: &mut NodeKit, devices: &[String]) -> Result<Health, StartError> {
        let devices: Result<Vec<Device>, StartError> = devices
            .iter()
            .map(|name| {
                let states = kit.subscribe(&topics::OPERATING_STATE, name)?;
                Ok(Device { name: name.clone(), states, state: None })
            })
            .collect();
        Ok(Health {
            prefix: format!("{}/", kit.namespace().trim_end_matches('/')),
            diagnostics: kit.subscribe(&topics::DIAGNOSTICS, "")?,
            statuses: BTreeMap::new(),
            devices: devices?,
            graph: Graph::default(),
        })
    }

    /// Take over what arrived.
    pub(crate) fn hear(&mut self, now: Instant) {
        while let Some(array) = self.diagnostics.take() {
            let stamp_s = convert::stamp_ns(&array.header.stamp) as f64 * 1e-9;
            for status in &array.status {
                self.hear_status(now, stamp_s, status);
            }
        }
        for device in &mut self.devices {
            if let Some(state) = device.states.newest() {
                device.state = Some(state);
            }
        }
    }

    fn hear_status(&mut self, now: Instant, stamp_s: f64, status: &DiagnosticStatus) {
        let known = self.statuses.contains_key(&status.name);
        if status.name.starts_with(&self.prefix) && (known || self.statuses.len() < MAX_STATUSES) {
            self.statuses.insert(status.name.clone(), (now, health(stamp_s, status)));
        }
    }

    /// Ask the graph who publishes; a few times a second.
    pub(crate) fn look_around(&mut self, kit: &NodeKit) -> Result<(), r2r::Error> {
        let mut graph = Graph::default();
        let model = [
            ("body_mesh", kit.publishers_of(&topics::BODY_MESH, "")?),
            ("surface_displacement", kit.publishers_of(&topics::SURFACE_DISPLACEMENT, "")?),
        ];
        for (topic, publishers) in model {
            graph.counts.insert(topic, publishers.len());
            graph.model.extend(publishers.into_iter().map(|publisher| publisher.node));
        }
        for device in &self.devices {
            let contacts = kit.publishers_of(&topics::CONTACT_STATE, &device.name)?;
            let poses = kit.publishers_of(&topics::MEASURED_CP, &device.name)?;
            graph.contacts.push(contacts.len());
            graph.poses.push(poses.len());
            graph.forces.push(kit.publishers_of(&topics::MEASURED_CF, &device.name)?.len());
            graph.model.extend(contacts.into_iter().map(|publisher| publisher.node));
            graph.nodes.extend(poses.into_iter().map(|publisher| publisher.node));
        }
        graph.nodes.extend(graph.model.iter().cloned());
        graph.nodes.insert(kit.full_name().to_owned());
        self.graph = graph;
        Ok(())
    }

    /// Full names of the nodes of the session, as far as they are there.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = &str> {
        self.graph.nodes.iter().map(String::as_str).filter(|name| name.starts_with('/'))
    }

    /// What each node says, and whether it still does.
    pub(crate) fn statuses(&self, now: Instant) -> Vec<NodeHealth> {
        let fresh = |(when, status): &(Instant, NodeHealth)| {
            let mut status = status.clone();
            if now.duration_since(*when) > STALE_AFTER {
                status.level = "stale";
            }
            status
        };
        self.statuses.values().map(fresh).collect()
    }

    /// Number of publishers of each topic of the model. One that leaves poses unanswered has none; neither has one that is
    /// asked nothing, and no longer says how it is.
    pub(crate) fn publishers(&self, now: Instant, views: &[DeviceView]) -> BTreeMap<&'static str, usize> {
        let is_recent =
            |heard: Option<Instant>| heard.is_some_and(|when| now.duration_since(when) < SILENT_AFTER);
        let is_well = self.model_is_well(now);
        let speaks = |view: &DeviceView| match is_recent(view.pose_heard()) {
            // One that has not answered yet has just been found.
            true => view.contact_heard().is_none() || is_recent(view.contact_heard()),
            false => is_well,
        };
        let contacts = self.graph.contacts.iter().zip(views);
        let heard = contacts.filter(|(_, view)| speaks(view)).map(|(count, _)| count).sum();
        let is_silent = !views.is_empty() && !views.iter().any(speaks);
        let mut counts = self.graph.counts.clone();
        if is_silent {
            counts.values_mut().for_each(|count| *count = 0);
        }
        counts.insert("contact_state", heard);
        counts
    }

    /// Whether a node that publishes what the model does says how it is. Of one that never did, such as a recording that is
    /// played, only the graph is known.
    fn model_is_well(&self, now: Instant) -> bool {
        let is_of_model =
            |name: &str| name.rsplit_once(": ").is_some_and(|(node, _)| self.graph.model.contains(node));
        let mut said = self.statuses.values().filter(|(_, status)| is_of_model(&status.name)).peekable();
        said.peek().is_none() || said.any(|(when, _)| now.duration_since(*when) <= STALE_AFTER)
    }

    /// State of each device; `pointers` and `unplaced` have one entry for each.
    pub(crate) fn devices(
        &self,
        now: Instant,
        views: &[DeviceView],
        pointers: &[PointerState],
        unplaced: Vec<Option<String>>,
    ) -> Vec<DeviceHealth> {
        let poses = self.graph.poses.iter().copied().chain(std::iter::repeat(0));
        let devices = self.devices.iter().zip(views).zip(poses);
        let health = |(((device, view), publishers), (pointer, unplaced_frame)): DeviceFacts<'_>| {
            let age = view.pose_heard().map(|when| now.duration_since(when));
            let state = device.state.as_ref();
            DeviceHealth {
                name: device.name.clone(),
                operating_state: state.map(|state| state.state.clone()),
                homed: state.is_some_and(|state| state.is_homed),
                busy: state.is_some_and(|state| state.is_busy),
                pointer: pointer.takes_targets,
                held: pointer.is_held,
                out_of_reach: self.is_out_of_reach(now, device),
                pose_age_s: age.map(|age| age.as_secs_f64()),
                alive: publishers > 0 && age.is_some_and(|age| age < SILENT_AFTER),
                unplaced_frame,
            }
        };
        devices.zip(pointers.iter().copied().zip(unplaced)).map(health).collect()
    }

    /// What is known of each device's driver.
    pub(crate) fn drivers(&self, now: Instant) -> Vec<Driver> {
        let number = |status: &NodeHealth, key: &str| {
            status.values.get(key)?.parse::<f32>().ok().filter(|number| number.is_finite())
        };
        let forces = self.graph.forces.iter().copied().chain(std::iter::repeat(0));
        let driver = |(device, forces): (&Device, usize)| {
            let subject = if device.name.is_empty() { "device" } else { &device.name };
            let subject = format!(": {subject}");
            let driver = self.of_driver(now, device).find_map(|status| number(status, "pose_rate_hz"));
            let model = || {
                self.fresh(now)
                    .filter(|status| status.name.ends_with(&subject))
                    .find_map(|status| number(status, "rate_hz"))
            };
            Driver { pose_rate_hz: driver.or_else(model), publishes_force: forces > 0 }
        };
        self.devices.iter().zip(forces).map(driver).collect()
    }

    /// Whether the driver of a device says that what a pointer points at is outside its workspace.
    fn is_out_of_reach(&self, now: Instant, device: &Device) -> bool {
        let says_so =
            |status: &NodeHealth| status.values.get("is_out_of_reach").is_some_and(|value| value == "true");
        self.of_driver(now, device).any(says_so)
    }

    /// What was said lately.
    fn fresh(&self, now: Instant) -> impl Iterator<Item = &NodeHealth> {
        let is_fresh = move |when: &Instant| now.duration_since(*when) <= STALE_AFTER;
        self.statuses.values().filter(move |(when, _)| is_fresh(when)).map(|(_, status)| status)
    }

    /// What the driver of a device said lately.
    fn of_driver(&self, now: Instant, device: &Device) -> impl Iterator<Item = &NodeHealth> {
        let namespace = format!("{}{}", self.prefix, device.name);
        self.fresh(now).filter(move |status| {
            status.name.rsplit_once('/').is_some_and(|(of, _)| of == namespace.trim_end_matches('/'))
        })
    }
}

fn health(stamp_s: f64, status: &DiagnosticStatus) -> NodeHealth {
    let shortened = |text: &str| text.chars().take(MAX_TEXT).collect::<String>();
    let values = status.values.iter().take(MAX_VALUES);
    NodeHealth {
        name: shortened(&status.name),
        level: match status.level {
            0 => "ok",
            1 => "warn",
            2 => "error",
            _ => "stale",
        },
        summary: shortened(&status.message),
        stamp_s,
        values: values.map(|entry| (shortened(&entry.key), shortened(&entry.value))).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use r2r::diagnostic_msgs::msg::KeyValue;

    #[test]
    fn a_status_is_told_by_node_and_subject_and_cannot_be_endless() {
        let values = vec![KeyValue { key: "rate_hz".to_owned(), value: "9".repeat(1000) }; 100];
        let status = DiagnosticStatus {
            level: 1,
            name: "/left/deformation: right".to_owned(),
            message: "m".repeat(1000),
            hardware_id: String::new(),
            values,
        };
        let health = health(7.5, &status);
        assert_eq!((health.name.as_str(), health.level), ("/left/deformation: right", "warn"));
        assert_eq!(health.stamp_s, 7.5);
        assert_eq!((health.summary.len(), health.values["rate_hz"].len()), (MAX_TEXT, MAX_TEXT));
    }
}
