//! Topic names, message types and quality of service: the one place where they are written down.
//!
//! Names are relative, so a node's namespace and remappings apply. Topics of a device stand in the device's
//! sub-namespace when one node serves several devices ("left/measured_cp").
//!
//! Three kinds of queue. What must all arrive, in order: reliable, 1000 deep on both sides. What is only interesting
//! while fresh: reliable, a few deep, so that it can also be recorded. What a late joiner needs: transient local.

use std::borrow::Cow;
use std::marker::PhantomData;

use r2r::QosProfile;
use r2r::crtk_msgs::msg::{OperatingState, StringStamped};
use r2r::diagnostic_msgs::msg::DiagnosticArray;
use r2r::geometry_msgs::msg::{PoseStamped, TwistStamped, WrenchStamped};
use r2r::lifecycle_msgs::msg::TransitionEvent;
use r2r::rcl_interfaces::msg::{Log, ParameterEvent};
use r2r::rhombus_haptics_msgs::msg::{ContactLaw, ContactState, SurfaceDisplacement};
use r2r::rosgraph_msgs::msg::Clock;
use r2r::sensor_msgs::msg::{JointState, Joy};
use r2r::shape_msgs::msg::Mesh;
use r2r::std_msgs::msg::{Bool, Empty, UInt64};
use r2r::tf2_msgs::msg::TFMessage;
use r2r::visualization_msgs::msg::MarkerArray;
use scene::topic;

/// A topic: name, message type and quality of service for both ends.
pub struct Topic<M> {
    name: Cow<'static, str>,
    qos: QosProfile,
    message: PhantomData<fn() -> M>,
}

impl<M> Topic<M> {
    const fn new(name: &'static str, qos: QosProfile) -> Topic<M> {
        Topic { name: Cow::Borrowed(name), qos, message: PhantomData }
    }

    /// The name as nodes know it before namespaces and remappings.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The name in the sub-namespace of one device; "" is the node's own namespace, "/" that of the whole graph.
    pub fn name_in(&self, sub_namespace: &str) -> String {
        match sub_namespace {
            "" => self.name().to_owned(),
            sub_namespace => format!("{}/{}", sub_namespace.trim_end_matches('/'), self.name),
        }
    }

    /// The same topic; in lockstep with a queue in which nothing is overwritten before who records it had time to ask for
    /// it again: such a session goes faster than it was lived through. Who follows live wants what is fresh.
    pub fn kept_in_lockstep(&self, lockstep: bool) -> Topic<M> {
        let qos = if lockstep { self.qos.clone().keep_last(1000) } else { self.qos.clone() };
        Topic { name: self.name.clone(), qos, message: PhantomData }
    }

    /// Quality of service, the same for publishers and for subscriptions that answer or record.
    pub fn qos(&self) -> QosProfile {
        self.qos.clone()
    }
}

const fn reliable(depth: usize) -> QosProfile {
    QosProfile::default().keep_last(depth).reliable().volatile()
}

const fn latched(depth: usize) -> QosProfile {
    QosProfile::default().keep_last(depth).reliable().transient_local()
}

/// Pose of the device's handle: device to deformation.
pub const MEASURED_CP: Topic<PoseStamped> = Topic::new(topic::MEASURED_CP, reliable(1000));
/// Velocity of the device's handle: device.
pub const MEASURED_CV: Topic<TwistStamped> = Topic::new("measured_cv", reliable(1000));
/// Positions of the device's joints, rad or m: device, where joints are reported.
pub const MEASURED_JS: Topic<JointState> = Topic::new("measured_js", reliable(1000));
/// Wrench that the motors were told to apply to the hand, in the device's base axes: device.
pub const MEASURED_CF: Topic<WrenchStamped> = Topic::new("measured_cf", reliable(1000));
/// The same as `measured_cf`.
pub const SPATIAL_MEASURED_CF: Topic<WrenchStamped> = Topic::new("spatial/measured_cf", reliable(1000));
/// The same wrench in the axes of the handle, or in base axes after `body/set_cf_orientation_absolute`: device.
pub const BODY_MEASURED_CF: Topic<WrenchStamped> = Topic::new("body/measured_cf", reliable(1000));
/// Opening of the gripper in position\[0\], rad: device to deformation.
pub const GRIPPER_MEASURED_JS: Topic<JointState> = Topic::new(topic::GRIPPER_MEASURED_JS, reliable(1000));
/// Hold the surface while true: anyone to deformation.
pub const GRASP: Topic<Bool> = Topic::new(topic::GRASP, reliable(10));
/// Clutch in buttons\[0\] (0 released, 1 pressed): device to deformation.
pub const CLUTCH: Topic<Joy> = Topic::new(topic::CLUTCH, latched(10));
/// Force on the hand, one for each pose, with the pose's stamp and frame: deformation to device.
pub const SERVO_CF: Topic<WrenchStamped> = Topic::new(topic::SERVO_CF, reliable(1000));
/// Wrench on the hand in the device's base axes: anyone to device.
pub const SPATIAL_SERVO_CF: Topic<WrenchStamped> = Topic::new("spatial/servo_cf", reliable(100));
/// Wrench on the hand in the axes of the handle, or in base axes after `body/set_cf_orientation_absolute`: anyone to device.
pub const BODY_SERVO_CF: Topic<WrenchStamped> = Topic::new("body/servo_cf", reliable(100));
/// Force of the gripper on the fingers in effort\[0\], positive opens: anyone to device, where the gripper has a motor.
pub const GRIPPER_SERVO_JF: Topic<JointState> = Topic::new("gripper/servo_jf", reliable(100));
/// Whether `body/` wrenches have base axes: anyone to device.
pub const BODY_SET_CF_ORIENTATION_ABSOLUTE: Topic<Bool> =
    Topic::new("body/set_cf_orientation_absolute", reliable(10));
/// No force, and none until a force is commanded anew: anyone to device.
pub const FREE: Topic<Empty> = Topic::new("free", reliable(10));
/// Stay here: anyone to device.
pub const HOLD: Topic<Empty> = Topic::new("hold", reliable(10));
/// Whether the device carries its own weight: anyone to device.
pub const USE_GRAVITY_COMPENSATION: Topic<Bool> = Topic::new("use_gravity_compensation", reliable(10));
/// enable, disable, pause, resume, home or unhome: anyone to device.
pub const STATE_COMMAND: Topic<StringStamped> = Topic::new("state_command", reliable(10));
/// The device's operating state, at every change and in answer to every command: device, latched.
pub const OPERATING_STATE: Topic<OperatingState> = Topic::new("operating_state", latched(10));
/// True takes the force away and latches a fault: anyone to device. Deep, because a stop that repeats its state must not
/// push the one message that counts out of the queue.
pub const EMERGENCY_STOP: Topic<Bool> = Topic::new("emergency_stop", reliable(1000));
/// Where the hand of a pointer device is asked to go: visualization or anyone to a pointer device.
pub const POINTER_TARGET: Topic<PoseStamped> = Topic::new(topic::POINTER_TARGET, reliable(10));
/// Changes of the device's lifecycle state: device.
pub const TRANSITION_EVENT: Topic<TransitionEvent> = Topic::new("~/transition_event", reliable(10));
/// What the device's motor loop needs until the next force: deformation to device.
pub const CONTACT_LAW: Topic<ContactLaw> = Topic::new(topic::CONTACT_LAW, reliable(10));
/// The contact, one for each pose: deformation.
pub const CONTACT_STATE: Topic<ContactState> = Topic::new(topic::CONTACT_STATE, reliable(1000));
/// How far the surface is from rest: deformation, at `surface.rate`.
pub const SURFACE_DISPLACEMENT: Topic<SurfaceDisplacement> =
    Topic::new(topic::SURFACE_DISPLACEMENT, reliable(10));
/// The rest surface: deformation, latched.
pub const BODY_MESH: Topic<Mesh> = Topic::new(topic::BODY_MESH, latched(1));
/// Messages on grasp, gripper and clutch of all devices that the model has taken into account since its start:
/// deformation, latched, for a replay in lockstep.
pub const BUTTONS_HEARD: Topic<UInt64> = Topic::new("buttons_heard", latched(1));
/// The same for messages on `/tf` and `/tf_static`.
pub const TRANSFORMS_HEARD: Topic<UInt64> = Topic::new("transforms_heard", latched(1));
/// What RViz draws: visualization.
pub const MARKERS: Topic<MarkerArray> = Topic::new("markers", reliable(10));
/// Health of every node at 1 Hz.
pub const DIAGNOSTICS: Topic<DiagnosticArray> = Topic::new("/diagnostics", reliable(10));
/// Log lines of every node.
pub const ROSOUT: Topic<Log> = Topic::new("/rosout", latched(1000));
/// Changes of parameters of every node.
pub const PARAMETER_EVENTS: Topic<ParameterEvent> =
    Topic::new("/parameter_events", QosProfile::parameter_events());
/// Simulated time, with `use_sim_time`.
pub const CLOCK: Topic<Clock> = Topic::new("/clock", QosProfile::default().keep_last(1).best_effort());
/// Transforms that move.
pub const TF: Topic<TFMessage> = Topic::new(topic::TF, reliable(100));
/// Transforms that stay.
pub const TF_STATIC: Topic<TFMessage> = Topic::new(topic::TF_STATIC, latched(100));

/// A button of a device in buttons\[0\] (0 released, 1 pressed, 2 clicked: pressed only briefly), by the name that the
/// device gives it: device, latched.
pub fn button(name: &str) -> Topic<Joy> {
    Topic { name: Cow::Owned(name.to_owned()), qos: latched(10), message: PhantomData }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Origin, Scene, Value};

    /// Name and "package/Type" of a topic.
    fn row<M>(topic: &Topic<M>) -> (String, String) {
        let path: Vec<&str> = std::any::type_name::<M>().split("::").collect();
        let [.., package, _, message] = path[..] else { panic!("{path:?} is no message") };
        (topic.name().to_owned(), format!("{package}/{message}"))
    }

    #[test]
    fn the_topics_that_a_scene_announces_are_these_with_these_types() {
        let one = |name: &str, x| (format!("chains.{name}"), Value::DoubleArray(vec![x]));
        let mut values = vec![one("rod_length", 0.01), one("angle", 0.5), one("ratio", 0.8)];
        values.extend([
            one("normal_stiffness", 500.0),
            one("tangential_stiffness", 0.0),
            one("tangential_growth", 1.0),
        ]);
        values.push(("chains.units".to_owned(), Value::IntegerArray(vec![3])));
        values.push(("body.mesh".to_owned(), Value::String("block".to_owned())));
        let scene = Scene::from_values(values, Origin::named("a test")).unwrap();
        let planned = scene.plan().unwrap().topics;
        let mut planned: Vec<_> =
            planned.into_iter().map(|topic| (topic.name, topic.message.to_owned())).collect();
        let mut ours = [
            row(&MEASURED_CP),
            row(&MEASURED_CV),
            row(&MEASURED_JS),
            row(&MEASURED_CF),
            row(&SPATIAL_MEASURED_CF),
            row(&BODY_MEASURED_CF),
            row(&GRIPPER_MEASURED_JS),
            row(&GRASP),
            row(&CLUTCH),
            row(&SERVO_CF),
            row(&SPATIAL_SERVO_CF),
            row(&BODY_SERVO_CF),
            row(&GRIPPER_SERVO_JF),
            row(&BODY_SET_CF_ORIENTATION_ABSOLUTE),
            row(&FREE),
            row(&HOLD),
            row(&USE_GRAVITY_COMPENSATION),
            row(&STATE_COMMAND),
            row(&OPERATING_STATE),
            row(&EMERGENCY_STOP),
            row(&POINTER_TARGET),
            row(&TRANSITION_EVENT),
            row(&CONTACT_LAW),
            row(&CONTACT_STATE),
            row(&SURFACE_DISPLACEMENT),
            row(&BODY_MESH),
            row(&BUTTONS_HEARD),
            row(&TRANSFORMS_HEARD),
            row(&MARKERS),
            row(&DIAGNOSTICS),
            row(&ROSOUT),
            row(&PARAMETER_EVENTS),
            row(&CLOCK),
            row(&TF),
            row(&TF_STATIC),
        ];
        planned.sort();
        ours.sort();
        assert_eq!(planned, ours);
    }

    #[test]
    fn in_lockstep_what_is_only_fresh_is_kept_as_long_as_what_must_arrive() {
        assert_eq!(CONTACT_LAW.kept_in_lockstep(true).qos().depth, SERVO_CF.qos().depth);
        assert_eq!(CONTACT_LAW.kept_in_lockstep(false).qos().depth, CONTACT_LAW.qos().depth);
        assert_eq!(CONTACT_LAW.kept_in_lockstep(true).name(), CONTACT_LAW.name());
    }

    #[test]
    fn a_devices_topics_stand_in_its_sub_namespace() {
        assert_eq!(MEASURED_CP.name_in(""), "measured_cp");
        assert_eq!(MEASURED_CP.name_in("left"), "left/measured_cp");
        assert_eq!(MEASURED_CP.name_in("/left/"), "/left/measured_cp");
        assert_eq!(MEASURED_CP.name_in("/"), "/measured_cp");
    }
}
